#pragma once
/// Scales of a structure: those that decide when a realization has ended, and the step of the rigid form (p: Housner,
/// "The behavior of inverted pendulum structures during earthquakes", Bulletin of the Seismological Society of America
/// 53 (1963) 403).

#include "ensemble/realization/realization.hpp"

namespace stylobate {

/// @pre at least one free drum and one bed; each free drum is the upper block of exactly one bed, and the beds of a
///      column come from the bottom up
Scales scales_of(const Realization& realization);

/// Default error of a collapse probability: measured for six rocking drums (`docs/rigid_limit.md`).
inline constexpr double usual_accuracy = 0.05;

/// How long a step of the rigid form is, by the accuracy it is to have, as nothing vibrates that could be unstable: a
/// part of the time in which the smallest free block falls over, and of the shortest period of the shaking: the
/// shorter of the two. It is in proportion to the accuracy: the measured errors of collapse probabilities fall at least
/// so fast where they are smaller than the usual accuracy (`docs/rigid_limit.md`).
/// @param accuracy of a collapse probability   @return [s]
double rigid_step_s(const Realization& realization, double accuracy = usual_accuracy);

} // namespace stylobate
