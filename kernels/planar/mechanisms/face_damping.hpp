#pragma once
/// Dashpots at points along the contact instead of one at its centroid: they damp rocking too.
///
///   F_i = max(0, lambda_i F_b + c_i v_i)      F_N = sum F_i      couple = sum F_i a_i
///
/// F_b: elastic force and the remaining dashpot at the centroid; lambda_i: the point's part of the elastic force; a_i:
/// its place along the contact from the point where the elastic force acts; v_i: closing velocity there. No point
/// pulls, and the dashpots only dissipate.
///
/// Source: own derivation.
///
/// With `area` the points are the two ends, lambda_i by the lever rule, c_i = share C_N L / (2 B) with B the contact
/// length at rest. Parameter: share of the normal dashpot at the ends.  Neutral: 0.  Acts in the normal force of a bed.
/// The other forms have all of it at their points: c_i = C_N / 2 at corners, C_N w_i / 2 at Gauss-Lobatto points.
/// Signature: rocking decays faster while the vertical vibration does not change.
/// Confounded with C_N and `rate_damping` in the decay of rocking.

#include "kernels/real.hpp"

namespace stylobate {

/// Points of the contact; `count` of them.
template <class Real, int count>
struct FacePoints {
    Real share[count > 0 ? count : 1];   ///< of the elastic force; sum 1
    Real arm[count > 0 ? count : 1];     ///< from where the elastic force acts, along the contact [m]
    Real dashpot[count > 0 ? count : 1]; ///< c_i / dt [N/m]
};

template <class Real>
struct FaceForce {
    Real normal; ///< [N]
    Real couple; ///< on the upper block, about where the elastic force acts [N m]
};

/// Part of the elastic force at the right end, by the lever rule: 1/2 for a face that is pressed evenly, 1/3 or 2/3 for
/// a triangle. From the moment of a trapezoid whose ends differ in depth by L times the sine of the rotation.
template <class Real>
STYLOBATE_INLINE Real lever_share(Real area, Real length, Real sine)
{
    const Real aside = length * length * sine / (Real(12.0) * area);
    return clamp(Real(0.5) - aside, Real(1.0 / 3.0), Real(2.0 / 3.0));
}

/// @param force F_b [N];  @param closing of this step where the elastic force acts [m]
/// @param turning rotation of the upper block against the lower one in this step [rad]
template <class Real, int count>
STYLOBATE_INLINE FaceForce<Real> face_force(const FacePoints<Real, count>& points, Real force, Real closing,
                                            Real turning)
{
    FaceForce<Real> sum{Real(0.0), Real(0.0)};
    for (int i = 0; i < count; ++i) {
        const Real closes = fnma(turning, points.arm[i], closing);
        const Real push = max_of(fma(points.dashpot[i], closes, points.share[i] * force), Real(0.0));
        sum.normal = sum.normal + push;
        sum.couple = fma(push, points.arm[i], sum.couple);
    }
    return sum;
}

} // namespace stylobate
