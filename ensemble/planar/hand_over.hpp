#pragma once
/// How a realization goes from rigid contacts to contacts that yield.

#include "ensemble/planar/planar_model.hpp"

namespace stylobate {

/// Puts a realization into a free lane that a set of the rigid form has handed over.
/// @param set made from the `compliant_form` of that set's pattern
void take_over(LaneSet& set, int lane, const HandOver& handed);

} // namespace stylobate
