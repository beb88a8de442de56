#pragma once
/// Fragility functions as files for other tools: NRML 0.5 of GEM's OpenQuake, JSON, CSV.
///
/// NRML has no place for intervals; they go into comments and the description, and whole into JSON and CSV. It takes
/// PGA and SA in g, PGV in cm/s, PGD in cm, and of a lognormal function not median and dispersion but mean and
/// standard deviation of the intensity itself,
///
///   mean = median exp(dispersion^2 / 2),   stddev = mean sqrt(exp(dispersion^2) - 1)
///
/// (openquake.risklib.scientific.FragilityFunctionContinuous).

#include "ensemble/model/fragility_model.hpp"

#include <string>

namespace stylobate {

// Units of intensity measures in NRML.

/// What one SI unit is in the unit of OpenQuake's hazard library (`openquake.hazardlib.imt`): PGA and SA in g, PGV in
/// cm/s, PGD in cm, IA in m/s, CAV in g s. @throws InputError for an unknown measure
double per_si_unit(const std::string& measure);
/// That unit: "g", "cm/s", "g s". @throws InputError for an unknown measure
const char* openquake_unit(const std::string& measure);

/// The requirements of OpenQuake for a model, and more: that no limit state is more probable than the one before it,
/// and that no number stands without its interval.
/// @throws InputError naming function, limit state, value and range
void check_fragility_model(const FragilityModel& model);

/// The texts of the files. @throws InputError as above
std::string fragility_nrml(const FragilityModel& model);
std::string fragility_json(const FragilityModel& model);
/// A line for each limit state (lognormal) or limit state and intensity (discrete).
std::string fragility_csv(const FragilityModel& model);

} // namespace stylobate
