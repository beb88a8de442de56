#pragma once
/// How long a step of the rigid form is: by the accuracy it is to have, as nothing vibrates that could be unstable.

#include "ensemble/model/realization.hpp"

namespace stylobate {

/// Default error of a collapse probability: measured for six rocking drums
/// (`docs/rigid_limit.md`).
inline constexpr double usual_accuracy = 0.05;

/// A part of the time in which the smallest free block falls over, and of the shortest period of the shaking: the
/// shorter of the two. It is in proportion to the accuracy: the measured errors of collapse probabilities fall at least
/// so fast where they are smaller than the usual accuracy (`docs/rigid_limit.md`).
/// @param accuracy of a collapse probability   @return [s]
double rigid_step_s(const Realization& realization, double accuracy = usual_accuracy);

} // namespace stylobate
