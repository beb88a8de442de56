#include "studies/evidence/verification/rigid_slider.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate::verification {

namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;

/// From stick to stick, piece by piece; each piece in closed form, its end by halving.
class Slider {
public:
    Slider(Real eta, Real last) : eta_(eta), last_(last) {}

    /// Slides and sticks until `end`; sums up.
    void run_to(Real end)
    {
        while (t_ < end) {
            if (r_ == 0 && std::fabs(push(t_)) <= 1 + 1e-15L) {
                t_ = std::min(next_break(end), end);
                if (t_ >= end)
                    return;
            }
            slide(end);
        }
    }
    Real total = 0, net = 0;

private:
    Real push(Real t) const { return t < last_ ? eta_ * std::sin(t) : 0; }

    /// Time at which the push exceeds the friction.
    Real next_break(Real end) const
    {
        if (eta_ <= 1)
            return end;
        const Real half = std::floor(t_ / pi), phase = t_ - half * pi, first = std::asin(1 / eta_);
        const Real begins = phase <= first ? half * pi + first : (half + 1) * pi + first;
        return begins < last_ ? begins : end;
    }

    /// Velocity a time after the piece began, in the direction `sign`, and its integral.
    Real velocity(Real sign, Real t) const
    {
        const Real u = t < last_ ? t : last_; // the push is over then
        return r_ + (t_ < last_ ? eta_ * (std::cos(t_) - std::cos(u)) : 0) - sign * (t - t_);
    }
    Real way(Real sign, Real t) const
    {
        const Real span = t - t_;
        Real s = r_ * span - 0.5L * sign * span * span;
        if (t_ < last_) {
            const Real u = t < last_ ? t : last_;
            s += eta_ * (std::cos(t_) * (u - t_) - (std::sin(u) - std::sin(t_)));
            s += eta_ * (std::cos(t_) - std::cos(u)) * (t - u);
        }
        return s;
    }

    void slide(Real end)
    {
        const Real sign = r_ != 0 ? std::copysign(Real(1), r_) : std::copysign(Real(1), eta_ * std::sin(t_ + 1e-9L));
        // the first sign change of the velocity, in strides far shorter than a cycle
        const Real stride = 2 * pi / 400;
        Real before = t_, after = t_;
        bool stops = false;
        while (!stops && after < end) {
            before = after;
            after = after + stride < end ? after + stride : end;
            stops = sign * velocity(sign, after) < 0;
        }
        if (stops) {
            for (int i = 0; i < 80; ++i) {
                const Real middle = 0.5L * (before + after);
                (sign * velocity(sign, middle) < 0 ? after : before) = middle;
            }
        }
        const Real s = way(sign, after);
        total += std::fabs(s);
        net += s;
        r_ = stops ? 0 : velocity(sign, after);
        t_ = after;
    }

    Real eta_, last_;
    Real t_ = 0, r_ = 0;
};

} // namespace

Slip pulse_slip(double eta, double cycles)
{
    const Real last = 2 * pi * static_cast<Real>(cycles);
    Slider slider(eta, last);
    slider.run_to(last + 4 * eta);
    return {static_cast<double>(slider.total), static_cast<double>(slider.net)};
}

double steady_slip_ratio(double eta)
{
    // where it sticks, the start is forgotten at once; else it fades by some 4 / eta in a cycle
    Slider slider(eta, 1e30L);
    const Real cycles = 30 + std::ceil(5 * static_cast<Real>(eta));
    slider.run_to(cycles * 2 * pi);
    const Real before = slider.total;
    slider.run_to((cycles + 1) * 2 * pi);
    return static_cast<double>((slider.total - before) / (4 * static_cast<Real>(eta)));
}

} // namespace stylobate::verification
