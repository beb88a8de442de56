#include "ensemble/synthetic_pulse.hpp"

#include "ensemble/elementary.hpp"

#include <numbers>

namespace stylobate {

namespace {

constexpr double pi = std::numbers::pi;

double bell_argument(double frequency_hz, double t)
{
    const double x = pi * (frequency_hz * t - 2);
    return x * x;
}

/// Integral from 0 to t of cos(2 pi g (s - half) + phase), g >= 0 small or not: t sinc(pi g t) cos(its middle).
double swing(double g, double t, double half, double phase_cycles)
{
    const double x = pi * g * t;
    const double width = x < 1e-4 ? t * (1 - x * x / 6) : sine_of(g * t / 2) / (pi * g);
    return width * cosine_of(g * (t / 2 - half) + phase_cycles);
}

} // namespace

double RickerWavelet::displacement(double t) const
{
    return -exp_of(-bell_argument(frequency_hz, t)) / (2 * (pi * frequency_hz) * (pi * frequency_hz));
}

double RickerWavelet::acceleration(double t) const
{
    const double q = bell_argument(frequency_hz, t);
    return (1 - 2 * q) * exp_of(-q);
}

double VelocityPulse::displacement(double t) const
{
    // the product of cosines as a sum of three
    const double half = duration_s() / 2, f = frequency_hz;
    return swing(f, t, half, phase_cycles) / 2 +
           (swing(f * (1 + 1 / gamma), t, half, phase_cycles) + swing(f * (1 - 1 / gamma), t, half, phase_cycles)) / 4;
}

double VelocityPulse::acceleration(double t) const
{
    const double c = frequency_hz * t - gamma / 2;
    return -pi * frequency_hz / gamma *
           (sine_of(c / gamma) * cosine_of(c + phase_cycles) +
            gamma * sine_of(c + phase_cycles) * (1 + cosine_of(c / gamma)));
}

} // namespace stylobate
