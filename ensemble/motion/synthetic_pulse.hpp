#pragma once
/// Near-fault pulses in closed form: Ricker's wavelet, and the velocity pulse of Mavroeidis and Papageorgiou.
///
/// Each has unit amplitude and begins at t = 0; the caller must not pass times outside [0, duration_s].
/// The bits of the values are the same on every machine (`elementary.hpp`).

#include <array>

namespace stylobate {

/// Ricker, "The form and laws of propagation of seismic wavelets", Geophysics 18 (1953) 10: a = (1 - 2 q) exp(-q), q =
/// (pi f (t - t0))2, f the peak of its Fourier amplitude; |a| is largest at t0, where it is 1. Its displacement, u =
/// -exp(-q) / (2 pi2 f2), returns to zero, and so does its velocity. t0 = 2 / f and the motion lasts 4 / f: the
/// truncated part at both ends is 7e-18 of the largest displacement.
struct RickerWavelet {
    double frequency_hz = 1;

    double duration_s() const { return 4 / frequency_hz; }
    double fastest_hz() const { return frequency_hz; }
    double displacement(double t) const; ///< [m] for 1 m/s2
    double acceleration(double t) const;
};

/// Mavroeidis & Papageorgiou, "A mathematical representation of near-fault ground motions", Bulletin of the
/// Seismological Society of America 93 (2003) 1099, Eq. 3:
///
///   v = 1/2 [1 + cos(2 pi f s / gamma)] cos(2 pi f s + nu),   |s| <= gamma / (2 f),   s = t - gamma / (2 f)
///
/// f is the pulse's frequency, nu its phase, gamma >= 1 its oscillatory character: cycles within the envelope. Velocity
/// and acceleration are zero at both ends. The displacement ends at cos(nu) sin(pi gamma) / (2 pi f (1 - gamma2)) (own
/// derivation, by integration), which is zero for nu = +-pi/2 and for integer gamma > 1 only: the remainder is the
/// permanent displacement of the fault (fling) and is kept. Only the second difference drives a structure, so it has no
/// side effect.
class VelocityPulse {
public:
    /// @param phase_cycles nu / 2 pi
    VelocityPulse(double frequency_hz, double phase_cycles, double gamma);

    double duration_s() const { return gamma_ / frequency_hz_; }
    double fastest_hz() const { return frequency_hz_ * (1 + 1 / gamma_); }
    double displacement(double t) const; ///< [m] for a velocity of 1 m/s
    double acceleration(double t) const;

private:
    /// The velocity is the sum of three of these: weight cos(2 pi (rate s + nu)).
    struct Term {
        double weight, rate;
        double at_start; ///< sine at t = 0, turned around
    };
    double swing(const Term& term, double t) const;

    double frequency_hz_, phase_cycles_, gamma_, half_s_;
    std::array<Term, 3> terms_;
};

} // namespace stylobate
