#pragma once
/// A set of ground motions, and how strong each is by every intensity measure, as plain data.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace stylobate {

/// "pga_m_s2", "sa_1s_m_s2": its name with its unit.
std::string measure_name(IntensityMeasure measure, double period_s);

/// One intensity measure of all motions.
struct MotionMeasure {
    std::string name;          ///< with its unit: "pga_m_s2", "sa_1s_m_s2"
    double exponent = 0;       ///< a motion s times as strong has s^exponent of it; 0: what scaling does not change
    std::vector<double> value; ///< (motions) of each as it stands
};

struct MotionSet {
    std::vector<std::shared_ptr<const Motion>> motions;
    /// (motions) Second horizontal and vertical components in space, null of a motion without; empty: no motion has
    /// one.
    std::vector<std::shared_ptr<const Motion>> seconds, verticals;
    std::vector<std::string> names; ///< (motions)
    std::vector<MotionMeasure> measures;
    std::vector<std::vector<double>> ends_s; ///< (motions x shakings) of sequences: when each shaking is over

    std::size_t size() const { return motions.size(); }
    /// Null: it has none.
    std::shared_ptr<const Motion> second(std::size_t motion) const
    {
        return seconds.empty() ? nullptr : seconds[motion];
    }
    std::shared_ptr<const Motion> vertical(std::size_t motion) const
    {
        return verticals.empty() ? nullptr : verticals[motion];
    }
    /// @throws std::invalid_argument if there is none of this name
    const MotionMeasure& measure(const std::string& name) const;
};

/// How many times as strong as it stands a motion is in a stripe.
double motion_scale(const MotionSetSpec& spec, const MotionSet& set, std::size_t motion, int stripe);

} // namespace stylobate
