#pragma once
/// A face out of square: the lower face of a joint is turned about a point of it.
///
///   W = exp(w),  P' = c + W^T (P - c),  R' = W^T R        forces and torques back: W F, W T
///
/// w is a vector along the face: the axis of the rotation times its angle. c is the point, the middle of the lower
/// body's face. The bed is that of the turned face; a force at P on both bodies is one at the same point of space, so
/// the load remains the gradient of its energy.
///
/// Source: own derivation (geometry).
///
/// Parameters: w about z and x [rad].  Neutral: 0.  Acts in the pose of a bed.
/// Signature: the structure rests at a tilt, the rotations of the wedges under it one after the other; residual tilt
/// and drift to that side.
/// Confounded with `eccentricity` and a tilted base as a bias.

#include "kernels/spatial/bed.hpp"

namespace stylobate::spatial {

template <class Real>
struct Wedge {
    Real e_1, e_2;   ///< vector part of the rotation's quaternion, along the first two axes of the joint
    Real at_1, at_2; ///< c, from the lower anchor [m]

    /// Of the face against the lower body.
    STYLOBATE_INLINE Quaternion<Real> rotation() const
    {
        return {sqrt_of(fnma(e_1, e_1, fnma(e_2, e_2, Real(1.0)))), e_1, e_2, Real(0.0)};
    }
};

/// The pose as seen from the turned face, the origin still in the lower anchor.
/// @param r rotation of the upper body as seen from the lower one, in the joint's axes
template <class Real>
STYLOBATE_INLINE BedPose<Real> onto_wedge(const BedPose<Real>& pose, const Quaternion<Real>& r,
                                          const Wedge<Real>& wedge)
{
    const Quaternion<Real> w = wedge.rotation();
    const Vector<Real> from{pose.place.x - wedge.at_1, pose.place.y - wedge.at_2, pose.place.z};
    const Vector<Real> seen = rotated_back(minus_identity(w), from);
    return {minus_identity(relative_rotation(w, r)), {seen.x + wedge.at_1, seen.y + wedge.at_2, seen.z}};
}

} // namespace stylobate::spatial
