#pragma once
/// Units of intensity measures in NRML.

#include <string>

namespace stylobate {

/// What one SI unit is in the unit that OpenQuake takes the measure in. @throws InputError for an unknown measure
double per_si_unit(const std::string& measure);

} // namespace stylobate
