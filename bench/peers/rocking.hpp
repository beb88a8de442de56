#pragma once
/// Test (a): a block leaned by half its slenderness and let go; the time until it is upright.

#include "bench/peers/engine.hpp"

namespace stylobate::peers {

/// The specimen's drums as one block: 48 x 174 mm, 0.813 kg.
struct Monolith {
    static constexpr double width_m = 0.048, height_m = 0.174, depth_m = 0.048, mass_kg = 0.813;
    static constexpr double friction = 5; ///< none of the tests is one of sliding
    static constexpr double lean = 0.5;   ///< of its slenderness
};

/// The monolith on a wide ground, leaned counter-clockwise about its lower left corner; bodies: ground, monolith.
Scene monolith_scene(double lean_rad);

/// @return [s], on the straight line between the two steps around it, by a clock that is set right
///         (`Engine::ahead_steps`); NaN if it takes more than 5 / p
double quarter_period(const Engine& engine, std::size_t setting, double step_s);

/// Housner's, exactly: the integral over the rigid block's energy [s].
double exact_quarter_period();

// Test (b): the least amplitude of half a sine of base acceleration that overturns the monolith, as
// eta = a / (g tan alpha); w = 4 p.

inline constexpr double pulse_rate = 4; ///< w / p
/// Between which amplitudes it is looked for, and how closely.
inline constexpr double eta_low = 1.5, eta_high = 4.5, eta_tolerance = 4e-4;

/// @return NaN where one end overturns as the other does
double overturning_eta(const Engine& engine, std::size_t setting, double step_s);

/// Of the rigid block: Housner's equation, integrated in extended precision.
double exact_overturning_eta();

} // namespace stylobate::peers
