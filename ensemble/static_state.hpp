#pragma once
/// Where a structure rests under its own weight, or leans, before the shaking.

#include "ensemble/realization.hpp"

#include <vector>

namespace stylobate {

/// Displacements against the reference stack, block by block, and the elastic part of the friction forces.
struct StaticState {
    std::vector<double> x_m;       ///< (blocks)
    std::vector<double> y_m;       ///< (blocks)
    std::vector<double> theta_rad; ///< (blocks)
    std::vector<double> spring_n;  ///< (joints) elastic part of F_T
};

/// Each joint presses by the weight above it, with the tilt that its eccentricity gives a bed without tension; the
/// friction carries the slope of a base out of level. Starting from the reference stack instead would make it bounce.
///
/// With `initial_tilt_rad` the free blocks then turn as one rigid body about the lower corner of the lowest one, which
/// sinks in until the base carries the weight.
///
/// @pre the joints are a stack from the bottom up: each free block is the upper block of exactly one joint
StaticState static_state(const Realization& realization);

} // namespace stylobate
