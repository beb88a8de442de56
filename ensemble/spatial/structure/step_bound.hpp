#pragma once
/// The largest safe step of a structure in space.

#include "ensemble/realization/realization.hpp"

namespace stylobate {

/// The largest step with which no body of the realization is unstable, held by its neighbours, in any state of its beds
/// [s].
double spatial_step_bound_s(const Realization& realization);

} // namespace stylobate
