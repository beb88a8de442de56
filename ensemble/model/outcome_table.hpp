#pragma once
/// Measured outcomes without histories: what shook a specimen, and whether it fell. Plain data, SI units.

#include "ensemble/model/campaign.hpp"

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace stylobate {

struct MeasuredOutcome {
    long line = 0;                        ///< of the file, for messages
    std::string motion_file;              ///< the base motion's record; empty: not given
    std::optional<double> amplitude_m;    ///< of a harmonic displacement
    std::optional<double> frequency_hz;   ///< of it
    std::optional<double> pga_m_s2;       ///< peak acceleration of the base
    std::optional<double> pgv_over_pga_s; ///< peak velocity over peak acceleration
    int motion_id = 0;                    ///< rows with the same one had one motion
    int repeat = 0;                       ///< which of them, from 0
    bool fell = false;

    /// What a motion is known by: rows in which it is equal repeat one motion.
    auto motion() const
    {
        return std::tuple(motion_file, amplitude_m.value_or(0), frequency_hz.value_or(0), pga_m_s2.value_or(0),
                          pgv_over_pga_s.value_or(0));
    }
};

struct OutcomeTable {
    std::string source; ///< file, for messages
    std::vector<MeasuredOutcome> rows;
    std::vector<Finding> findings;
};

} // namespace stylobate
