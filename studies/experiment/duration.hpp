#pragma once
/// How long a realization lasts at most.

#include "ensemble/experiment.hpp"

namespace stylobate {

/// The end of its shaking [s].
double shaking_s(const Experiment& experiment, const Realization& realization);

/// The end of its shaking and of what is watched after it: one that falls or comes to rest ends earlier [s].
double longest_s(const Experiment& experiment, const Realization& realization);

} // namespace stylobate
