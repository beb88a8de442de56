#pragma once
/// Scales of a structure that decide when a realization has ended.

#include "ensemble/realization.hpp"

namespace stylobate {

struct Scales {
    double p_rad_s = 0;      ///< sqrt(3 g / (4 R)), R half the diagonal of the whole free structure
    double barrier_j = 0;    ///< least energy that topples any part of the stack as one body about its edge
    double rotation_rad = 0; ///< largest slenderness angle atan(b / h) of the free blocks
    double width_m = 0;      ///< mean width of the free blocks
};

/// @pre at least one free block and one joint
Scales scales_of(const Realization& realization);

} // namespace stylobate
