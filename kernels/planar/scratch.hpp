#pragma once
/// Intermediate values between the phases of a step (`step.hpp`), and their common constants.

#include "kernels/planar/bed.hpp"
#include "kernels/planar/mechanisms/points.hpp"

namespace stylobate::detail {

/// Joints that go through the phases together.
inline constexpr int joint_group = 8;

/// The two kinds of joints, as types for the phases.
struct Bed {
    static constexpr bool at_rest = true;
};
struct Pair {
    static constexpr bool at_rest = false;
};

/// Additional intermediate values of a contact form: none where it has no points of its own.
template <class Real, int count>
struct PointScratch {
    FormPoints<Real, count> points; // overlap -> forces: shares of the force, and places along the contact
};
template <class Real>
struct PointScratch<Real, 0> {
};

/// The intermediate values of one joint.
template <class Real, int points>
struct JointScratch : PointScratch<Real, points>, Touch<Real> { // (what touches: faces -> forces)
    PentagonFrame<Real> frame;                                  // geometry -> overlap: of a bed of the baseline
    Placement<Real> place;                                      // geometry -> overlap: of the others
    Real apart_x, apart_y; // geometry -> forces: upper centre - lower centre, frame of the base
    Overlap<Real> met;     // overlap -> faces
};

} // namespace stylobate::detail
