#pragma once
/// Runs of one rocking block in the engine.

#include "studies/evidence/verification/model.hpp"

#include <vector>

namespace stylobate::verification {

/// A block leaned by a part of its slenderness on a wide base; mu = 5, dashpots per chord.
/// @param step_rate dt times sqrt(K_N B / m)
Realization leaned_block(const model::Stone& stone, double K_n, double part, double step_rate, double xi = 0.1);

/// Time at which the mean rotation of these blocks is 0 for the first time [s].
/// @throws std::runtime_error if that takes more than 5 / p of the first of them
double upright_time(const Realization& leaned, const std::vector<int>& blocks = {1});

/// e of the first impact: e2 is the ratio of the energies of the rigid block, leaned as at the peak after and before.
/// @param contact its form, and where its dashpots are
double impact_restitution(const Realization& leaned, const ContactSpec& contact = {});

} // namespace stylobate::verification
