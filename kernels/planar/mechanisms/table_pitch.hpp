#pragma once
/// Rotation of the base about a point O on it, by an angle phi(t).
///
/// The state stays in the frame of the base, which turns with it. With r the place of a centre of mass from O, there
///
///   r''     = F / m + R(-phi) (g - U'') - phi'' k x r + phi'2 r - 2 phi' k x r'
///   theta'' = M / I - phi''
///
/// (gravity turned, Euler's, centrifugal and Coriolis' term). In the laboratory a point is at U + R(phi) r, and a
/// block has turned by theta + phi.
///
/// Source: motion in a rotating frame (Goldstein, Poole & Safko, "Classical Mechanics", 3rd edition (2002), section
/// 4.10).
///
/// phi(t) may be given too, by samples (`table_tilt`, `RealizationHeader::tilt`): nothing of it is left out.
///
/// Parameter: k_p with phi = k_p U'' [rad s2/m].  Neutral: 0.  Acts in the update of all blocks.
/// Signature: as a gain of the base motion that grows with the square of the frequency; g phi at low frequency.
/// Confounded with `sensor_gain` at one frequency.

#include "kernels/trig.hpp"

namespace stylobate {

template <class Real>
struct Pitch {
    Real angle;     ///< phi [rad]
    Real increment; ///< dt phi'
    Real second;    ///< dt2 phi''
};

template <class Real>
struct Pull {
    Real x, y;
};

/// dt2 x an acceleration of the laboratory frame, in the turned frame.
template <class Real>
STYLOBATE_INLINE Pull<Real> turned_pull(const Pitch<Real>& pitch, Real x, Real y)
{
    const Angle<Real> a = angle(pitch.angle);
    const Real cosine = Real(1.0) - a.versine;
    return {fma(y, a.sine, x * cosine), fnma(x, a.sine, y * cosine)};
}

/// dt2 x the other inertial accelerations.
/// @param x, y place from O [m];  @param dx, dy displacement of the last step [m]
template <class Real>
STYLOBATE_INLINE Pull<Real> turning_pull(const Pitch<Real>& pitch, Real x, Real y, Real dx, Real dy)
{
    const Real w = pitch.increment, square = w * w, twice = w + w;
    return {fma(pitch.second, y, fma(square, x, twice * dy)), fnma(pitch.second, x, fnma(twice, dx, square * y))};
}

} // namespace stylobate
