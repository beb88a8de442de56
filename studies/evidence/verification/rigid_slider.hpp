#pragma once
/// A rigid block that can only slide on its base, with Coulomb friction: the oracle of sliding.
///
/// Units in which mu g = 1 and w = 1: the base's acceleration is eta sin t, slip is in mu g / w2. The velocity r of the
/// base against the block obeys r' = eta sin t - sgn r while it slides; it sticks where r = 0 and |eta sin t| <= 1.

namespace stylobate::verification {

/// Slip, and the base's way less the block's.
struct Slip {
    double total = 0, net = 0;
};

/// Under `cycles` (0.5 or 1) of the sine; the base then keeps its velocity.
Slip pulse_slip(double eta, double cycles);

/// Slip path over the base's path in the steady state under a harmonic without end.
double steady_slip_ratio(double eta);

} // namespace stylobate::verification
