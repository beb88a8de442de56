#pragma once
/// Linear vibrations of a stack on its beds, assembled from discrete springs: the oracle of frequencies and of the
/// stability of the step.

#include "ensemble/realization/realization.hpp"

#include <vector>

namespace stylobate::verification {

/// Undamped natural frequencies, ascending [Hz].
///
/// Each bed is two springs at Gauss points of the face (exact for a gap that is linear along it) and one tangential
/// spring at its middle. The weight on a bed presses along the normal of the lower face, in the middle of the overlap
/// at rest: with a shear of the bed it turns the lower block.
/// @pre a stack of centred blocks on a fixed one, first to last
std::vector<double> frequencies_hz(const Realization& realization);

/// Step at which the central difference with the dashpots at the velocity of the step before begins to grow [s]. It is
/// stable while no vector makes 4 M - 2 dt C - dt2 K negative; at the limit a shape changes its sign in each step and
/// keeps its size.
double critical_step_s(const Realization& realization);

} // namespace stylobate::verification
