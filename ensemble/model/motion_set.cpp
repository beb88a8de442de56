#include "ensemble/model/motion_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stylobate {

std::string measure_name(IntensityMeasure measure, double period_s)
{
    switch (measure) {
    case IntensityMeasure::pga:
        return "pga_m_s2";
    case IntensityMeasure::pgv:
        return "pgv_m_s";
    case IntensityMeasure::pgd:
        return "pgd_m";
    case IntensityMeasure::arias:
        return "arias_m_s";
    case IntensityMeasure::cav:
        return "cav_m_s";
    case IntensityMeasure::sa:
        return fmt::format("sa_{:g}s_m_s2", period_s);
    }
    throw std::invalid_argument("a measure that is not in the enumeration");
}

const MotionMeasure& MotionSet::measure(const std::string& name) const
{
    const auto at = std::find_if(measures.begin(), measures.end(), [&](const auto& m) { return m.name == name; });
    if (at == measures.end())
        throw std::invalid_argument("the motions were not measured by " + name);
    return *at;
}

double motion_scale(const MotionSetSpec& spec, const MotionSet& set, std::size_t motion, int stripe)
{
    if (spec.method == FragilityMethod::cloud)
        return spec.scale;
    const MotionMeasure& measure = set.measure(measure_name(spec.measure, spec.period_s));
    return std::pow(spec.intensity.value(stripe) / measure.value[motion], 1 / measure.exponent);
}

} // namespace stylobate
