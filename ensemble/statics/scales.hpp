#pragma once
/// Scales of a structure that decide when a realization has ended (p: Housner, "The behavior of inverted pendulum
/// structures during earthquakes", Bulletin of the Seismological Society of America 53 (1963) 403).

#include "ensemble/model/realization.hpp"

namespace stylobate {

struct Scales {
    double p_rad_s = 0;      ///< sqrt(3 g / (4 R)), R half the diagonal of a whole column of the free drums
    double barrier_j = 0;    ///< least energy that overturns any part of a column, or an epistyle, about its edge
    double width_m = 0;      ///< mean width of the free drums
    double least_size_m = 0; ///< smallest half size of the free blocks
};

/// @pre at least one free drum and one bed; each free drum is the upper block of exactly one bed, and the beds of a
///      column come from the bottom up
Scales scales_of(const Realization& realization);

} // namespace stylobate
