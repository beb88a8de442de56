#pragma once
/// The trials of the cases by the second solver (`reference_solver.hpp`), with the same start, step and shaking as in
/// the engine: oracles for what depends on the contact law, where no closed form is known.

#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"

#include <vector>

namespace stylobate::verification {

/// Time at which the mean rotation of these blocks is 0 for the first time [s].
/// @throws std::runtime_error if that takes more than 5 / p of the first of them
double reference_upright_time(const Realization& leaned, const std::vector<int>& blocks = {1});

/// e of the first impact, as `impact_restitution` defines it.
double reference_restitution(const Realization& leaned);

/// Whether it rocks by this rotation between two neighbours, or falls (a centre below `height_fraction` of its height),
/// before the shaking has ended.
struct ReferenceShaken {
    bool rocks = false, falls = false;
};
ReferenceShaken reference_shaken(const Study& study, const Realization& shaken, double rotation_rad = 0.01,
                                 double height_fraction = 0.6);

/// How a block under a pulse falls: 0 it stands, else 1 + the number of times it had crossed over before.
int reference_way(const Study& study, const Realization& shaken);

} // namespace stylobate::verification
