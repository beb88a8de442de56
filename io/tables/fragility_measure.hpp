#pragma once
/// Units of intensity measures in NRML.

#include <string>

namespace stylobate {

/// What one SI unit is in the unit of OpenQuake's hazard library (`openquake.hazardlib.imt`): PGA and SA in g, PGV in
/// cm/s, PGD in cm, IA in m/s, CAV in g s. @throws InputError for an unknown measure
double per_si_unit(const std::string& measure);
/// That unit: "g", "cm/s", "g s". @throws InputError for an unknown measure
const char* openquake_unit(const std::string& measure);

} // namespace stylobate
