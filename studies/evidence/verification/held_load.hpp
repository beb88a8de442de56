#pragma once
/// Loads that are reached slowly and held: what the engine's contacts can carry at rest.

#include "ensemble/model/realization.hpp"

#include <vector>

namespace stylobate::verification {

/// Where a trial has led.
struct HeldState {
    bool stays = false;             ///< nothing has turned by more than its slenderness, or slipped by more than a
                                    ///< hundredth of its width in all
    std::vector<double> pressure_n; ///< (beds) K_N times the overlap
};

/// Starts at the static rest; the acceleration of the base rises smoothly in a time of 10 / p and is held for 60 / p. A
/// drag takes velocities at the rate 2 p (p: of the whole structure as one block), so that nothing is carried over by
/// its swing; it vanishes at rest.
HeldState hold(const Realization& realization, double acceleration_m_s2);

/// Largest horizontal acceleration of the base under which the structure stays, by bisection.
/// @throws std::runtime_error if `low` is not held, or `high` is
double largest_held_acceleration(const Realization& realization, double low, double high, double tolerance);

} // namespace stylobate::verification
