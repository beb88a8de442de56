#pragma once
/// What the numbers of a study file may be: wide enough for any structure of stone, narrow enough for a slip of units.

#include "io/files/key_reader.hpp"

#include <numbers>

namespace stylobate {

inline constexpr double degree = std::numbers::pi / 180;

// Units in which numbers are given by mistake, beside those of lengths, velocities and accelerations (unit_slip.hpp).
inline constexpr UnitSlip from_ms[] = {{1e-3, "ms"}};
inline constexpr UnitSlip from_grams[] = {{1e-3, "g"}};
inline constexpr UnitSlip from_percent[] = {{1e-2, "%"}};
inline constexpr UnitSlip from_degrees[] = {{degree, "degrees"}};

/// Of a record.
inline const std::vector<std::string> acceleration_units = {"m/s2", "cm/s2", "gal", "mm/s2", "g"};

/// Of blocks: the highest obelisks that stand have 32 m.
inline const Range length_range{0, 40, true, "Lengths are in metres.", from_lengths};
inline const Range spacing_range{0, 100, true, "Lengths are in metres.", from_lengths};
inline const Range position_range{-1000, 1000, false, "Positions are in metres.", from_lengths};
inline const Range mass_range{0, 3e7, true, "Masses are in kilograms.", from_grams};
inline const Range density_range{0, 30000, true, "Densities are in kg/m3; marble has about 2700."};
inline const Range gravity_range{0, 100, true, "Gravity is in m/s2; on Earth 9.81."};
inline const Range normal_stiffness_range{0, 1e15, true,
                                          "K_N is the force per overlap area for the whole depth, in N/m2."};
inline const Range tangential_stiffness_range{0, 1e16, true, "K_T is in N/m."};
inline const Range bed_stiffness_range{0, 1e15, true,
                                       "The stiffness of a bed is the force per area and depth, in N/m3; dry beds of "
                                       "stone have 1e9 to 1e10."};
inline const Range inner_ratio_range{0, 0.95, false, "A fraction of the size of the face.", from_percent};
inline const Range damping_ratio_range{0, 2, false, "Ratios are fractions of the critical damping: 10 % is 0.1.",
                                       from_percent};
inline const Range damping_range{0, 1e12, false, "Damping coefficients are in N s/m."};
inline const Range restitution_range{0, 0.99, false, "A part of what there is before the impact."};
inline const Range friction_range{0, 10, true, "Stone on stone has about 0.4 to 0.8.", from_percent};
inline const Range frequency_range{0.001, 1000, false, "Frequencies are in Hz."};
inline const Range acceleration_range{0, 10000, true, "Accelerations are in m/s2.", from_accelerations};
inline const Range corner_range{0.01, 1000, false, "Frequencies are in Hz."};
inline const Range noise_frequency_range{0.05, 25, false, "The frequency of the ground, in Hz; firm soil has 2 to 3."};
inline const Range filter_damping_range{0.05, 0.95, false, "A fraction of the critical damping; 60 % is 0.6.",
                                        from_percent};
inline const Range low_cut_ratio_range{0.01, 0.5, false, "The low-cut frequency as a fraction of the ground's."};
inline const Range rise_range{0, 60, true, "Times are in seconds.", from_ms};
inline const Range strong_range{0, 300, false, "Times are in seconds.", from_ms};
inline const Range gamma_range{1, 20, false, "The cycles in the envelope of a pulse; near faults mostly 1 to 3."};
inline const Range taper_range{1, 5000, false, "A shorter ramp is equivalent to an abrupt start."};
inline const Range cycles_range{0, 10000, true, ""};
inline const Range motion_cycles_range{0.1, 10000, false, "Less than a tenth of a cycle is no motion."};
inline const Range duration_range{0, 10000, true, "Times are in seconds."};
inline const Range tail_range{0, 10000, false,
                              "Times are in seconds; or give \"structure\" (12 / p) or \"rest\" (until the realization "
                              "lies still, at most 240 / p)."};
inline const Range time_scale_range{0.001, 1000, false, "2 makes the record twice as long."};
inline const Range phase_range{-100, 100, false, "Angles are in radians.", from_degrees};
inline const Range azimuth_range{-360, 360, false,
                                 "Directions are in degrees from x towards z: clockwise, seen from above."};
inline const Range component_ratio_range{0, 10, false, "A component over the first one.", from_percent};
inline const Range correlation_range{-1, 1, false, "A coefficient of correlation.", from_percent};
inline const Range tilt_range{-0.5, 0.5, false, "Angles are in radians.", from_degrees};
inline const Range initial_tilt_range{-1.5, 1.5, false, "Angles are in radians.", from_degrees};
inline const Range cov_range{0, 5, true, "A coefficient of variation is a fraction of the nominal value: 10 % is 0.1.",
                             from_percent};
inline const Range sigma_ln_range{0, 3, true, ""};

} // namespace stylobate
