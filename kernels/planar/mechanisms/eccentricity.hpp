#pragma once
/// A centre of mass beside the geometric centre, at the distance e along the width.
///
///   x_centre = x_mass + e (1 - cos theta)      y_centre = y_mass - e sin theta
///
/// The step with mechanisms moves centres of mass (Eqs. 4 to 6 hold for these) and takes the faces from the geometric
/// ones; both as displacements relative to the reference stack. The moment of inertia given is that about the centre of
/// mass.
///
/// Source: own derivation (rigid-body kinematics).
///
/// Parameter: e [m].  Neutral: 0.  Acts in the geometry of a block.
/// Signature: uplift at g (b - e) / h to one side, g (b + e) / h to the other; drift and residual tilt to one side.
/// Confounded with `wedge`, a tilted base and `table_pitch` as a bias.

#include "kernels/real.hpp"

namespace stylobate {

template <class Real>
STYLOBATE_INLINE Real centre_from_mass_x(Real x, Real eccentricity, Real versine)
{
    return fma(eccentricity, versine, x);
}
template <class Real>
STYLOBATE_INLINE Real centre_from_mass_y(Real y, Real eccentricity, Real sine)
{
    return fnma(eccentricity, sine, y);
}

} // namespace stylobate
