#include "ensemble/motion/synthetic_pulse.hpp"

#include "ensemble/numerics/elementary.hpp"

#include <numbers>

namespace stylobate {

namespace {

using std::numbers::pi;

double bell_argument(double frequency_hz, double t)
{
    const double x = pi * (frequency_hz * t - 2);
    return x * x;
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

VelocityPulse::VelocityPulse(double frequency_hz, double phase_cycles, double gamma)
    : frequency_hz_(frequency_hz), phase_cycles_(phase_cycles), gamma_(gamma), half_s_(gamma / (2 * frequency_hz)),
      // the product of cosines as a sum of three
      terms_{{{0.5, frequency_hz, 0},
              {0.25, frequency_hz * (1 + 1 / gamma), 0},
              {0.25, frequency_hz * (1 - 1 / gamma), 0}}}
{
    for (Term& term : terms_)
        term.at_start = sine_of(term.rate * half_s_ - phase_cycles_);
}

/// Integral of a term from 0 to t.
double VelocityPulse::swing(const Term& term, double t) const
{
    if (term.rate > 0.1 * frequency_hz_)
        return term.weight / (2 * pi * term.rate) *
               (sine_of(term.rate * (t - half_s_) + phase_cycles_) + term.at_start);
    // gamma near 1: a rate near 0. As t sinc(pi rate t) cos(in the middle), in which nothing cancels
    const double x = pi * term.rate * t;
    const double width = x < 1e-4 ? t * (1 - x * x / 6) : sine_of(term.rate * t / 2) / (pi * term.rate);
    return term.weight * width * cosine_of(term.rate * (t / 2 - half_s_) + phase_cycles_);
}

double VelocityPulse::displacement(double t) const
{
    return swing(terms_[0], t) + swing(terms_[1], t) + swing(terms_[2], t);
}

double VelocityPulse::acceleration(double t) const
{
    const double c = frequency_hz_ * t - gamma_ / 2;
    return -pi * frequency_hz_ / gamma_ *
           (sine_of(c / gamma_) * cosine_of(c + phase_cycles_) +
            gamma_ * sine_of(c + phase_cycles_) * (1 + cosine_of(c / gamma_)));
}

} // namespace stylobate
