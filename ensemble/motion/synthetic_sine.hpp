#pragma once
/// Sines with smooth start and end, in closed form: of one frequency, and swept from one to another.
///
/// Each has unit amplitude and begins at t = 0; the caller must not pass times outside [0, duration_s]. The bits of the
/// values are the same on every machine (`elementary.hpp`).

#include "ensemble/model/study.hpp"

#include <array>

namespace stylobate {

/// The displacement of degree 5 that starts at rest from zero and has the given displacement, velocity and acceleration
/// at the end of a motion (quintic Hermite interpolation; own derivation of the coefficients). Subtracted from the
/// motion it brings it to rest at zero, without changing its acceleration at the start.
struct RestPolynomial {
    double duration = 1;
    std::array<double, 3> coefficients{}; ///< of x3, x4, x5 in x = t / duration

    RestPolynomial() = default;
    RestPolynomial(double duration, double displacement, double velocity, double acceleration);
    double displacement(double t) const;
    double acceleration(double t) const;
};

/// A harmonic whose *acceleration* is tapered (cosine taper, Tukey window):
///
///   a = w(c) sin(2 pi c + phase) - rest,   c = f t,   w = (1 - cos(pi c / ramp)) / 2 where it rises, and so where it
///                                                      falls, 1 between
///
/// The kind `harmonic` tapers the displacement: it ends at rest without a correction, but its acceleration overshoots
/// in the ramp (by up to 2.0 % for two cycles, 61 % for half a one: `ramp_overshoot`) and is no longer the plain
/// amplitude. Here no peak of the
/// ramp is above the plateau. The taper causes a drift, which `rest`, a polynomial of degree 5 in the displacement,
/// removes over the whole duration; the tests measure how small it is.
struct TaperedSine {
    /// @pre ramp_cycles >= 1 (a shorter ramp has a component of no or negative frequency), 2 ramps fit into cycles
    TaperedSine(double frequency_hz, double cycles, double ramp_cycles, double phase_cycles);

    double duration_s() const { return cycles_ / frequency_hz_; }
    double fastest_hz() const { return frequency_hz_ * 1.5; }
    double displacement(double t) const; ///< [m] for 1 m/s2
    double acceleration(double t) const;
    /// Its largest acceleration stands to the sine's as this to 1.
    const RestPolynomial& rest() const { return rest_; }

private:
    struct Term {
        double amplitude, rate, phase; ///< amplitude sin(2 pi (rate c + phase))
    };
    struct Segment {
        double start = 0;                      ///< in cycles, as all of it
        double velocity = 0, displacement = 0; ///< at its start, and what the terms' integrals lack there
        std::array<Term, 3> terms{};
        int count = 3; ///< of the terms
    };
    static double slope_part(const Segment& segment, double c);
    static double value_part(const Segment& segment, double c);
    const Segment& at(double c) const;
    static double moved(const Segment& segment, double c);

    double frequency_hz_, cycles_, ramp_, phase_;
    std::array<Segment, 3> segments_; ///< up, plateau, down
    RestPolynomial rest_;             ///< in cycles
};

/// A sine sweep of nearly constant acceleration (own derivation):
///
///   U = s(phi / ramp) s((phi_end - phi) / ramp) sin(2 pi phi) / (2 pi f)2,   phi = integral of f dt
///   s = 10x3 - 15x4 + 6x5
///
/// with f going from `from_hz` to `to_hz` linearly or as an exponential (equal times for equal ratios). The
/// displacement is given, so the motion is at rest at both ends exactly. Its acceleration overshoots in the ramps as
/// that of `harmonic` does (by up to 2.0 % for two cycles); on the plateau its amplitude differs from 1 in the second
/// order of f' / f2 (less than 1 % in a sweep over four octaves in a minute, which the tests check).
struct SineSweep {
    SineSweep(double from_hz, double to_hz, Spacing spacing, double duration_s, double ramp_cycles);

    double duration_s() const { return duration_; }
    double fastest_hz() const { return from_ < to_ ? to_ : from_; }
    /// The whole sweep, in cycles.
    double cycles() const { return cycles_; }
    double displacement(double t) const; ///< [m] for 1 m/s2
    double acceleration(double t) const;

private:
    struct Instant {
        double cycles, frequency, slope, bend; ///< phi, f, f', f''
    };
    Instant at(double t) const;

    double from_, to_, duration_, ramp_;
    double rate_;  ///< logarithmic: ln(to / from) / duration; linear: 0
    double slope_; ///< linear: f'
    double cycles_;
};

/// Largest acceleration of a sine whose displacement is ramped as that of `harmonic`, over that of its plateau, at the
/// phase at which it is largest. With k = 2 pi ramp_cycles and x = c / ramp_cycles the acceleration over the plateau's
/// is
///
///   (s - s'' / k2) sin - (2 s' / k) cos,      so that the factor is the maximum of hypot(s - s'' / k2, 2 s' / k) over
///   x
///
/// (own derivation). At a given phase it is less: kernels/THEORY.md, section 4. @pre ramp_cycles > 0
double ramp_overshoot(double ramp_cycles);

} // namespace stylobate
