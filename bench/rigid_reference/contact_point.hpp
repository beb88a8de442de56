#pragma once
/// Where two blocks of a column may touch: the corners of each against the face of the other one.

#include "bench/rigid_reference/body.hpp"

namespace stylobate::reference {

/// The lower corners of the upper block against the upper face of the lower one, and the upper corners of the lower
/// block against the lower face of the upper one.
enum class Corner { upper_left, upper_right, lower_left, lower_right };
inline constexpr int corners_of_bed = 4;

/// A corner and the face of the other block.
struct Meeting {
    double gap = 0;       ///< from the face to the corner [m]
    double along = 0;     ///< place of the upper block along the face, up to a constant [m]
    bool on_face = false; ///< the corner is beside the face, not beyond its ends
};
Meeting meeting(const Body& lower, const Body& upper, const Twist& at_lower, const Twist& at_upper, Corner corner);

/// Changes of gap and sliding with the velocities of the blocks: dot(normal_lower, v_lower) + dot(normal_upper,
/// v_upper). An impulse p at the point moves the blocks with the same rows.
struct ContactRows {
    Twist normal_lower, normal_upper, along_lower, along_upper;
};
ContactRows rows(const Body& lower, const Body& upper, const Twist& at_lower, const Twist& at_upper, Corner corner);

} // namespace stylobate::reference
