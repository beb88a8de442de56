#pragma once
/// Linear vibrations of a stack on its beds, assembled from discrete springs: the oracle of frequencies and of the
/// stability of the step.

#include "ensemble/model/realization.hpp"

#include <vector>

namespace stylobate::verification {

/// Undamped natural frequencies, ascending [Hz].
///
/// Each bed is two springs at Gauss points of the face (exact for a gap that is linear along it) and one tangential
/// spring at its middle. The weight N on a bed takes N h / 2 of energy for each of its two blocks that turns by 1 rad,
/// h the half height, since their faces then lie lower than their centres.
/// @pre a stack of centred blocks on a fixed one, first to last
std::vector<double> frequencies_hz(const Realization& realization);

/// Step at which the central difference with the dashpots at the velocity of the step before begins to grow [s]. It is
/// stable while no vector makes 4 M - 2 dt C - dt2 K negative; at the limit a shape changes its sign in each step and
/// keeps its size.
double critical_step_s(const Realization& realization);

} // namespace stylobate::verification
