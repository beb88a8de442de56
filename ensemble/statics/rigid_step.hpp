#pragma once
/// How long a step of the rigid form is: by the accuracy it is to have, as nothing vibrates that could be unstable.

#include "ensemble/model/realization.hpp"

namespace stylobate {

/// A part of the time in which the smallest free block falls over, and of the shortest period of the shaking.
/// (`docs/rigid_limit.md` shows what other steps make of collapse probabilities.)
/// @return [s]
double rigid_step_s(const Realization& realization);

} // namespace stylobate
