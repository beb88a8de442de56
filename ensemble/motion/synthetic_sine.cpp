#include "ensemble/motion/synthetic_sine.hpp"

#include "ensemble/numerics/elementary.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace stylobate {

namespace {

using std::numbers::pi;

/// s = 10 x3 - 15 x4 + 6 x5 and its first two derivatives; 0 below 0, 1 above 1.
struct Ramp {
    double value, slope, bend;

    explicit Ramp(double x)
    {
        const double t = std::clamp(x, 0.0, 1.0), left = 1 - t;
        value = t * t * t * (10 + t * (6 * t - 15));
        slope = 30 * t * t * left * left;
        bend = 60 * t * left * (1 - 2 * t);
    }
};

} // namespace

RestPolynomial::RestPolynomial(double end, double u, double v, double a) : duration(end)
{
    const double v1 = v * end, a2 = a * end * end / 2;
    coefficients = {10 * u - 4 * v1 + a2, -15 * u + 7 * v1 - 2 * a2, 6 * u - 3 * v1 + a2};
}

double RestPolynomial::displacement(double t) const
{
    const double x = t / duration;
    return x * x * x * (coefficients[0] + x * (coefficients[1] + x * coefficients[2]));
}

double RestPolynomial::acceleration(double t) const
{
    const double x = t / duration;
    return x * (6 * coefficients[0] + x * (12 * coefficients[1] + x * 20 * coefficients[2])) / (duration * duration);
}

// ---- tapered

TaperedSine::TaperedSine(double frequency_hz, double cycles, double ramp_cycles, double phase_cycles)
    : frequency_hz_(frequency_hz), cycles_(cycles), ramp_(ramp_cycles), phase_(phase_cycles)
{
    assert(ramp_cycles >= 1 && 2 * ramp_cycles <= cycles && "the ramps fit");
    // (1 - cos(pi c / ramp)) / 2 sin(2 pi c + phase) as a sum of three sines; falling, c counts from the end
    const double bell = 1 / (2 * ramp_), from_end = cycles_ * bell;
    segments_[0].terms = {{{0.5, 1, phase_}, {-0.25, 1 + bell, phase_}, {-0.25, 1 - bell, phase_}}};
    segments_[1].terms = {{{1, 1, phase_}}};
    segments_[2].terms = {
        {{0.5, 1, phase_}, {-0.25, 1 - bell, phase_ + from_end}, {-0.25, 1 + bell, phase_ - from_end}}};
    segments_[1].start = ramp_;
    segments_[2].start = cycles_ - ramp_;
    segments_[1].count = 1;
    const auto velocity_at = [](const Segment& segment, double c) { return segment.velocity - slope_part(segment, c); };
    for (std::size_t k = 0; k < segments_.size(); ++k) {
        Segment& segment = segments_[k];
        const double c = segment.start;
        const double u = k > 0 ? moved(segments_[k - 1], c) : 0, v = k > 0 ? velocity_at(segments_[k - 1], c) : 0;
        segment.displacement = u + value_part(segment, c);
        segment.velocity = v + slope_part(segment, c);
    }
    rest_ = RestPolynomial(cycles_, moved(segments_.back(), cycles_), velocity_at(segments_.back(), cycles_), 0);
}

/// Minus the integral of the terms.
double TaperedSine::slope_part(const Segment& segment, double c)
{
    double sum = 0;
    for (int i = 0; i < segment.count; ++i) {
        const Term& term = segment.terms[static_cast<std::size_t>(i)];
        sum += term.amplitude / (2 * pi * term.rate) * cosine_of(term.rate * c + term.phase);
    }
    return sum;
}

/// Minus the integral of that.
double TaperedSine::value_part(const Segment& segment, double c)
{
    double sum = 0;
    for (int i = 0; i < segment.count; ++i) {
        const Term& term = segment.terms[static_cast<std::size_t>(i)];
        sum += term.amplitude / (4 * pi * pi * term.rate * term.rate) * sine_of(term.rate * c + term.phase);
    }
    return sum;
}

/// Displacement at c, in a segment, without the polynomial.
double TaperedSine::moved(const Segment& segment, double c)
{
    return segment.displacement + segment.velocity * (c - segment.start) - value_part(segment, c);
}

const TaperedSine::Segment& TaperedSine::at(double c) const
{
    return segments_[c < segments_[1].start ? 0 : c < segments_[2].start ? 1 : 2];
}

double TaperedSine::displacement(double t) const
{
    const double c = frequency_hz_ * t;
    return (moved(at(c), c) - rest_.displacement(c)) / (frequency_hz_ * frequency_hz_);
}

double TaperedSine::acceleration(double t) const
{
    const double c = frequency_hz_ * t;
    double sum = 0;
    for (const Term& term : at(c).terms)
        sum += term.amplitude * sine_of(term.rate * c + term.phase); // of the plateau two are nothing
    return sum - rest_.acceleration(c);
}

// ---- swept

SineSweep::SineSweep(double from_hz, double to_hz, Spacing spacing, double duration_s, double ramp_cycles)
    : from_(from_hz), to_(to_hz), duration_(duration_s), ramp_(ramp_cycles),
      rate_(spacing == Spacing::log ? log_of(to_hz / from_hz) / duration_s : 0),
      slope_(spacing == Spacing::log ? 0 : (to_hz - from_hz) / duration_s),
      cycles_(spacing == Spacing::log ? (to_hz - from_hz) / rate_ : duration_s * (from_hz + to_hz) / 2)
{
}

SineSweep::Instant SineSweep::at(double t) const
{
    if (rate_ == 0)
        return {t * (from_ + slope_ * t / 2), from_ + slope_ * t, slope_, 0};
    const double f = from_ * exp_of(rate_ * t);
    return {(f - from_) / rate_, f, rate_ * f, rate_ * rate_ * f};
}

double SineSweep::displacement(double t) const
{
    const Instant i = at(t);
    const double turn = 2 * pi * i.frequency;
    return Ramp(i.cycles / ramp_).value * Ramp((cycles_ - i.cycles) / ramp_).value * sine_of(i.cycles) / (turn * turn);
}

double SineSweep::acceleration(double t) const
{
    const auto [c, f, slope, bend] = at(t);
    // U = h sin(2 pi c) / 4 pi2 with h = q(c) / f2 and dc/dt = f
    const Ramp up(c / ramp_), down((cycles_ - c) / ramp_);
    const double q = up.value * down.value, q1 = (up.slope * down.value - up.value * down.slope) / ramp_,
                 q2 = (up.bend * down.value - 2 * up.slope * down.slope + up.value * down.bend) / (ramp_ * ramp_);
    const double h = q / (f * f), h1 = q1 / f - 2 * q * slope / (f * f * f),
                 h2 = q2 - (3 * q1 * slope + 2 * q * bend / f - 6 * q * slope * slope / (f * f)) / (f * f);
    const double turn = 2 * pi * f, sine = sine_of(c), cosine = cosine_of(c);
    return ((h2 - h * turn * turn) * sine + (2 * h1 * turn + 2 * pi * h * slope) * cosine) / (4 * pi * pi);
}

// ---- overshoot

double ramp_overshoot(double ramp_cycles)
{
    const double k = 2 * pi * ramp_cycles;
    const auto envelope = [k](double x) {
        const Ramp s(x);
        return std::hypot(s.value - s.bend / (k * k), 2 * s.slope / k);
    };
    double largest = 1;
    constexpr int parts = 20000; // within 1e-8 of the maximum for ramps of 0.01 cycles and more
    for (int i = 1; i < parts; ++i)
        largest = std::max(largest, envelope(static_cast<double>(i) / parts));
    return largest;
}

} // namespace stylobate
