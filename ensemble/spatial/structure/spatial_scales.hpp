#pragma once
/// Scales of a structure in space, which decide when a realization has ended.

#include "ensemble/realization/realization.hpp"

namespace stylobate {

/// p, R half the diagonal of a whole column in the direction of its narrowest face; the least energy that overturns
/// any part of a column, or an epistyle, about the rim of the face on which it stands, over the edge nearest to its
/// centre of mass; the mean width of the free drums; the smallest half size of the free bodies.
///
/// @pre the realization is in space, with at least one free drum and one bed; each free drum is the upper body of
///      exactly one bed, and the beds of a column come from the bottom up
Scales spatial_scales(const Realization& realization);

} // namespace stylobate
