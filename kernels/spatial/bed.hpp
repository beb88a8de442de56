#pragma once
/// A bed: the joint of two plane faces, one of each body. What every bed law takes and gives.
///
/// Frame of a joint: the axes of the lower body in cyclic order so that the normal of its face is the third one. The
/// normal points from the lower to the upper body. A bed law takes where the upper face lies in this frame, and gives
/// the elastic load, which is the gradient of its energy
///
///   E = k/2 integral of depth^2 over the part of the upper face above the lower one        [J], k in N/m3
///
/// and the moments of the part of the upper face that presses ("patch"), from which the dashpot and friction are
/// computed. Each law has its own coordinates p on the upper face, with the origin in the anchor P: those of a disc do
/// not turn with it (a disc has no direction), those of a polygon do. The point p lies in the joint's frame at
///
///   P + (t11 p_x + t12 p_y,  t21 p_x + t22 p_y,  -(slope_x p_x + slope_y p_y)),   depth = slope . p - P_z

#include "kernels/spatial/rotation.hpp"

namespace stylobate::spatial {

/// Pose of the upper face in the joint's frame.
template <class Real>
struct BedPose {
    Matrix<Real> turn;  ///< R(r) - 1 of the rotation r of the upper body as seen from the lower one
    Vector<Real> place; ///< P: anchor of the upper face as seen from that of the lower one [m]
};

/// What a bed law gives: the elastic load on the upper body, and the patch. All in the joint's frame, except moments
/// of the face, which are in the law's coordinates p on the upper face.
template <class Real>
struct BedLoad {
    Real force;                           ///< N >= 0 along the normal [N]
    Real lateral_x, lateral_y;            ///< G: the elastic force across the normal [N]
    Vector<Real> torque;                  ///< of the elastic force about P [N m]
    Real moment_x, moment_y;              ///< first moments of the pressure about P, on the upper face [N m]
    Real energy;                          ///< E [J]
    Real area;                            ///< of the patch [m2]
    Real first_x, first_y;                ///< first moments of the patch about P [m3]
    Real second_xx, second_xy, second_yy; ///< second moments of the patch about P [m4]
    Real friction_radius;                 ///< rho_f: the torque of friction of a pure spin is mu N rho_f [m]
    Real t11, t12, t21, t22;              ///< from the upper face to the joint's frame
    Real slope_x, slope_y;                ///< a: how the depth grows on the upper face
};

/// v in the frame of a joint whose normal is `normal`.
template <Axis normal, class Real>
STYLOBATE_INLINE Vector<Real> to_joint(const Vector<Real>& v)
{
    if constexpr (normal == Axis::x)
        return {v.y, v.z, v.x};
    else if constexpr (normal == Axis::y)
        return {v.z, v.x, v.y};
    else
        return v;
}

/// The reverse of `to_joint`.
template <Axis normal, class Real>
STYLOBATE_INLINE Vector<Real> from_joint(const Vector<Real>& v)
{
    if constexpr (normal == Axis::x)
        return {v.z, v.x, v.y};
    else if constexpr (normal == Axis::y)
        return {v.y, v.z, v.x};
    else
        return v;
}

/// The same for an axis that is known at run time, the same one for all lanes.
template <class Real>
STYLOBATE_INLINE Vector<Real> to_joint(const Vector<Real>& v, Axis normal)
{
    return normal == Axis::y ? to_joint<Axis::y>(v) : normal == Axis::x ? to_joint<Axis::x>(v) : to_joint<Axis::z>(v);
}
template <class Real>
STYLOBATE_INLINE Vector<Real> from_joint(const Vector<Real>& v, Axis normal)
{
    return normal == Axis::y   ? from_joint<Axis::y>(v)
           : normal == Axis::x ? from_joint<Axis::x>(v)
                               : from_joint<Axis::z>(v);
}

/// One of the two bodies of a joint.
template <class Real>
struct BedBody {
    Vector<Real> displacement; ///< u: of the centre of mass from its place in the reference state [m]
    Quaternion<Real> q;
    Matrix<Real> turn;   ///< R(q) - 1
    Vector<Real> anchor; ///< from the centre of mass to the point where the faces meet in the reference state, in the
                         ///< body's frame [m]
};

/// Where the upper face lies in the joint's frame, from what is known in the frame of the base.
/// @param apart displacement of the upper anchor against the lower one since the reference state, where they coincide
/// @param r     `relative_rotation` of the two bodies
/// @param turn  R - 1 of the lower body
template <class Real>
STYLOBATE_INLINE BedPose<Real> bed_pose(const Vector<Real>& apart, const Quaternion<Real>& r, const Matrix<Real>& turn,
                                        Axis normal)
{
    const Vector<Real> e = to_joint(Vector<Real>{r.x, r.y, r.z}, normal);
    return {minus_identity(Quaternion<Real>{r.w, e.x, e.y, e.z}), to_joint(rotated_back(turn, apart), normal)};
}

/// The same from the two bodies:
///
///   P = R_l^T [(u_u - u_l) + (R_u - 1) a_u - (R_l - 1) a_l]
///
/// The two anchors coincide in the reference state, so that only displacements are subtracted from each other; or the
/// upper one is farther along the normal by the gap of a butt joint, which is added in the brackets.
template <class Real>
STYLOBATE_INLINE BedPose<Real> bed_pose(const BedBody<Real>& lower, const BedBody<Real>& upper, Axis normal,
                                        Real gap = Real(0.0))
{
    const Vector<Real> apart = (upper.displacement - lower.displacement) +
                               (displaced(upper.turn, upper.anchor) - displaced(lower.turn, lower.anchor)) +
                               from_joint(Vector<Real>{Real(0.0), Real(0.0), gap}, normal);
    return bed_pose(apart, relative_rotation(lower.q, upper.q), lower.turn, normal);
}

} // namespace stylobate::spatial
