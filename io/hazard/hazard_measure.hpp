#pragma once
/// Names and units of the intensity measures of hazard curves.

#include <string>
#include <string_view>

namespace stylobate {

struct HazardMeasure {
    std::string name;    ///< as of a fragility study, with its SI unit: "pga_m_s2"; empty: not known
    double per_unit = 1; ///< SI units in one of the unit that was named
};

/// Of a name with its unit, "pga_g".
HazardMeasure measure_of_column(std::string_view name);
/// Of a name without its unit, "pga" or "sa_1s", in SI.
HazardMeasure measure_without_unit(std::string_view name);
/// Of OpenQuake's name, "SA(1.0)", in its unit.
HazardMeasure measure_of_openquake(const std::string& imt);

/// Names with units that are known, for messages.
std::string known_hazard_measures();

} // namespace stylobate
