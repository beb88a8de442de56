#pragma once
/// The three motions of a base in space: the first component of the shaking, the second one across it, the vertical
/// one.
///
/// The first component is the motion that a study in the plane has, with its formulas, its samples and its bits; it is
/// along the horizontal direction of azimuth d, from x towards z: clockwise, seen from above. The second one is along
/// azimuth d + 90 degrees. The base moves by
///
///   x = u1 cos d - u2 sin d        y = u3        z = u1 sin d + u2 cos d
///
///                  second component                              vertical component
///   formulas       `second_ratio` times the first one; of a      `vertical_ratio` times the first one
///                  harmonic, tapered or pulse with
///                  `second_phase_deg` added to its phase
///   noise          `second_ratio` times noise of the same         `vertical_ratio` times independent noise of the same
///                  spectrum and envelope, of a stream of its      spectrum and envelope
///                  own or correlated with the first one
///   records        another record, in the time and with the       another record, as the second one; or
///                  factor of the first one                        `vertical_ratio` times the first one

#include "ensemble/model/motion.hpp"
#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/base_motion.hpp"

#include <array>

namespace stylobate {

/// Along the direction of the shaking, across it, upwards. A component that the shaking does not have is at rest; by
/// the kernels' formulas its amplitude is 0. A gain and an overtone of the base change both horizontal components, an
/// offset in time all three.
/// @param record the first component of a study with a record or table (except in a fragility study), and must outlive
///        what is returned
std::array<BaseMotion, 3> motions_in_space(const ExcitationSpec& excitation, const RealizationHeader& realization,
                                           const Motion* record);

/// The PGA of two components that have the shape of the excitation (no noise, no samples) over the PGA of the first
/// one, by `excitation.pga_of_pair`. Of a harmonic, whose PGA is that of its plateau, on the plateau:
///
///   largest length of (sin t, r sin(t + f)) = sqrt((1 + r2 + sqrt(1 + r4 + 2 r2 cos 2f)) / 2)
double pga_of_pair_over_first(const ExcitationSpec& excitation, const RealizationHeader& realization);

/// The first component of a shaking by itself: `pga_m_s2` is its own PGA.
RealizationHeader first_component(const RealizationHeader& realization);
/// The second component of a motion in closed form.
/// @param first `first_component`
RealizationHeader second_component(const ExcitationSpec& excitation, const RealizationHeader& first);

} // namespace stylobate
