#pragma once
/// Trials of the cases: rocking blocks and slowly held loads in the engine, and rocking blocks by the second solver
/// (`reference_solver.hpp`) with the start, step and shaking of the engine, an oracle for what depends on the contact
/// law, where no closed form is known.

#include "studies/evidence/verification/model.hpp"

#include <vector>

namespace stylobate::verification {

/// A block leaned by a part of its slenderness on a wide base; mu = 5, dashpots per chord.
/// @param step_rate dt times sqrt(K_N B / m)
Realization leaned_block(const model::Stone& stone, double K_n, double part, double step_rate, double xi = 0.1);

/// Time at which the mean rotation of these blocks is 0 for the first time [s], in the engine and by the second solver.
/// @throws std::runtime_error if that takes more than 5 / p of the first of them
double upright_time(const Realization& leaned, const std::vector<int>& blocks = {1});
double reference_upright_time(const Realization& leaned, const std::vector<int>& blocks = {1});

/// e of the first impact, in the engine and by the second solver: e2 is the ratio of the energies of the rigid block,
/// leaned as at the peak after and before.
/// @param contact its form, and where its dashpots are   @throws std::runtime_error if there is none within 8 / p
double impact_restitution(const Realization& leaned, const ContactSpec& contact = {}, int block = 1);
double reference_restitution(const Realization& leaned);

/// By the second solver: whether it rocks by this rotation between two neighbours, or falls (a centre below
/// `height_fraction` of its height), before the shaking has ended.
struct ReferenceShaken {
    bool rocks = false, falls = false;
};
ReferenceShaken reference_shaken(const Study& study, const Realization& shaken, double rotation_rad = 0.01,
                                 double height_fraction = 0.6);

/// How a block under a pulse falls by the second solver: 0 it stands, else 1 + the number of times it had crossed over
/// before.
int reference_way(const Study& study, const Realization& shaken);

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
