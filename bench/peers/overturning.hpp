#pragma once
/// Test (b): the least amplitude of half a sine of base acceleration that overturns the monolith, as
/// eta = a / (g tan alpha); w = 4 p.

#include "bench/peers/engine.hpp"

namespace stylobate::peers {

inline constexpr double pulse_rate = 4; ///< w / p
/// Between which amplitudes it is looked for, and how closely.
inline constexpr double eta_low = 1.5, eta_high = 4.5, eta_tolerance = 4e-4;

/// @return NaN where one end overturns as the other does
double overturning_eta(const Engine& engine, std::size_t setting, double step_s);

/// Of the rigid block: Housner's equation, integrated in extended precision.
double exact_overturning_eta();

} // namespace stylobate::peers
