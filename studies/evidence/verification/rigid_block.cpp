#include "studies/evidence/verification/rigid_block.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace stylobate::verification {

namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;

struct Motion {
    Real theta = 0, rate = 0;
};

/// Where `yes` begins between two ends of which the upper one is it.
double edge(const std::function<bool(double)>& yes, double low, double high)
{
    for (int i = 0; i < 60 && high - low > 1e-8; ++i) {
        const double middle = 0.5 * (low + high);
        (yes(middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

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

RigidBlock rigid_block(Real width, Real height, Real gravity)
{
    return {std::atan(width / height), std::sqrt(0.75L * gravity / (0.5L * std::hypot(width, height)))};
}

RigidBlock rigid_frame(Real width, Real height, Real gamma, Real gravity)
{
    RigidBlock block = rigid_block(width, height, gravity);
    block.p *= std::sqrt((1 + 2 * gamma) / (1 + 3 * gamma));
    return block;
}

Real housner_restitution(Real alpha, Real gamma)
{
    const Real s = std::sin(alpha);
    return (1 - 1.5L * s * s + 3 * gamma * std::cos(2 * alpha)) / (1 + 3 * gamma);
}

Real quarter_period(const RigidBlock& block, Real start)
{
    // theta'2 / 2 = p2 [cos(alpha - start) - cos(alpha - theta)]; the bracket as a product, so that nothing cancels
    const auto slope = [&](Real s) {
        if (s == 0) // the limit
            return std::sqrt(2 / std::sin(block.alpha - start)) / block.p;
        const Real theta = start - s * s;
        const Real bracket = 2 * std::sin(block.alpha - 0.5L * (theta + start)) * std::sin(0.5L * (start - theta));
        return 2 * s / (block.p * std::sqrt(2 * bracket));
    };
    const int n = 20000;
    const Real h = std::sqrt(start) / n;
    Real sum = slope(0) + slope(std::sqrt(start));
    for (int i = 1; i < n; ++i)
        sum += (i % 2 ? 4 : 2) * slope(h * i);
    return sum * h / 3;
}

PulseEnd respond(const RigidBlock& block, Real eta, Real rate, Real cycles, Real restitution)
{
    PulseEnd end;
    if (eta <= 1)
        return end;
    const Real w = rate * block.p, amplitude = eta * std::tan(block.alpha), last = cycles * 2 * pi / w;
    int side = 1; // the pulse's first half turns it to this side
    const auto second = [&](Real t, const Motion& m) {
        const Real push = t < last ? amplitude * std::sin(w * t) : 0;
        const Real angle = side * block.alpha - m.theta;
        return -block.p * block.p * (std::sin(angle) - push * std::cos(angle));
    };
    const auto step = [&](Real t, const Motion& m, Real dt) {
        const auto after = [&](const Motion& k, Real part) {
            return Motion{m.theta + part * dt * k.theta, m.rate + part * dt * k.rate};
        };
        const Motion k1{m.rate, second(t, m)};
        const Motion a = after(k1, 0.5L), k2{a.rate, second(t + 0.5L * dt, a)};
        const Motion b = after(k2, 0.5L), k3{b.rate, second(t + 0.5L * dt, b)};
        const Motion c = after(k3, 1), k4{c.rate, second(t + dt, c)};
        return Motion{m.theta + dt / 6 * (k1.theta + 2 * k2.theta + 2 * k3.theta + k4.theta),
                      m.rate + dt / 6 * (k1.rate + 2 * k2.rate + 2 * k3.rate + k4.rate)};
    };
    Real t = std::asin(1 / eta) / w;
    Motion m;
    const Real whole = std::min(2 * pi / w, 1 / block.p) / 600;
    while (t < last + 40 / block.p) {
        // the pulse's last instant is the end of a step: its slope jumps there
        Real dt = t < last ? std::min(whole, last - t) : whole;
        if (t < last && dt < 1e-12L * last) {
            t = last;
            continue;
        }
        Motion next = step(t, m, dt);
        if (side * next.theta < 0) {
            Real low = 0;
            for (int i = 0; i < 60; ++i) {
                const Real middle = 0.5L * (low + dt);
                const Motion there = step(t, m, middle);
                if (side * there.theta < 0) {
                    dt = middle;
                    next = there;
                } else {
                    low = middle;
                }
            }
            next = {0, restitution * next.rate};
            side = -side;
            if (++end.impacts > 20)
                return end;
        }
        t += dt;
        m = next;
        if (std::fabs(m.theta) > pi / 2) {
            end.overturned = true;
            return end;
        }
        // the centre is at R cos(alpha - |theta|) above the base, and R / g = 3 / (4 p2)
        const Real angle = block.alpha - std::fabs(m.theta),
                   up = 0.75L / (block.p * block.p) *
                        (std::sin(angle) * side * second(t, m) - std::cos(angle) * m.rate * m.rate);
        end.least_pressure = std::min(end.least_pressure, static_cast<double>(1 + up));
        // free: what it has must not carry it over
        const Real lean = std::fabs(m.theta);
        if (t >= last && lean < block.alpha &&
            0.5L * m.rate * m.rate < block.p * block.p * (1 - std::cos(block.alpha - lean)))
            return end;
    }
    end.overturned = std::fabs(m.theta) > block.alpha;
    return end;
}

double half_sine_edge(const RigidBlock& block, double rate)
{
    return edge([&](double eta) { return respond(block, eta, rate, 0.5L, 0).overturned; }, 1, 2 + rate);
}

FullSineEdges full_sine_edges(const RigidBlock& block, double rate, double restitution)
{
    const auto end = [&](double eta) { return respond(block, eta, rate, 1, restitution); };
    FullSineEdges edges;
    edges.direct = edge(
        [&](double eta) {
            const PulseEnd e = end(eta);
            return e.overturned && e.impacts == 0;
        },
        1, 2 + rate * rate);
    edges.direct_pressure = end(edges.direct + 1e-6).least_pressure;
    double before = 1;
    const auto once = [&](double eta) {
        const PulseEnd e = end(eta);
        return e.overturned && e.impacts == 1;
    };
    const double stride = std::min(0.02, 0.2 * (edges.direct - 1));
    for (double eta = 1 + stride; eta < edges.direct; before = eta, eta += stride)
        if (once(eta)) {
            edges.after_impact = true;
            edges.low = edge(once, before, eta);
            edges.high = edge([&](double x) { return !once(x); }, eta, edges.direct - 1e-6);
            break;
        }
    return edges;
}

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

const char* to_string(Regime regime)
{
    switch (regime) {
    case Regime::rest:
        return "rest";
    case Regime::slide:
        return "slide";
    case Regime::rock:
        return "rock";
    default:
        return "slide and rock";
    }
}

double rock_friction(double a, double slenderness)
{
    const double B = slenderness;
    return (a * (1 + 4 * B * B) + 3 * B) / (4 + B * B + 3 * a * B);
}

Regime shenton(double a, double mu, double slenderness)
{
    if (a <= std::min(mu, slenderness))
        return Regime::rest;
    if (mu < slenderness)
        return Regime::slide;
    return mu >= rock_friction(a, slenderness) ? Regime::rock : Regime::slide_rock;
}

Start two_block_start(const TwoBlocks& k, double a)
{
    // Inertia forces point to +x, and a turn that way (clockwise) is positive: the lower block turns about its corner
    // at (b1, 0), the upper one against it about the corner of its foot at corner x b2. Lagrange's equations
    // M (lower, upper)'' = Q of that pair of hinges:
    struct Pair {
        double M11, M12, M22, Q1, Q2;
    };
    const double g = k.gravity;
    const auto pair = [&](double corner) {
        const double c = corner * k.b2, d = k.b1 - c; // lifts of the upper centre per turn of the upper and lower block
        const double I1 = k.m1 * (k.b1 * k.b1 + k.h1 * k.h1) / 3, I2 = k.m2 * (k.b2 * k.b2 + k.h2 * k.h2) / 3;
        return Pair{I1 + k.m1 * (k.b1 * k.b1 + k.h1 * k.h1) + k.m2 * (4 * k.h1 * k.h1 + d * d),
                    k.m2 * (2 * k.h1 * k.h2 + d * c), I2 + k.m2 * (k.h2 * k.h2 + c * c),
                    k.m1 * (a * k.h1 - g * k.b1) + k.m2 * (2 * a * k.h1 - g * d), k.m2 * (a * k.h2 - g * c)};
    };
    const auto both = [](const Pair& p) {
        const double det = p.M11 * p.M22 - p.M12 * p.M12;
        return Start{(p.M22 * p.Q1 - p.M12 * p.Q2) / det, (p.M11 * p.Q2 - p.M12 * p.Q1) / det};
    };
    const Pair front = pair(1), back = pair(-1);

    if (front.Q2 <= 0 && front.Q1 + front.Q2 <= 0)
        return {};
    const double upper = front.Q2 / front.M22;
    if (upper > 0 && front.Q1 - front.M12 * upper <= 0)
        return {0, upper};
    const double one = (front.Q1 + front.Q2) / (front.M11 + 2 * front.M12 + front.M22);
    if (one > 0 && front.Q2 - (front.M12 + front.M22) * one <= 0 && back.Q2 - (back.M12 + back.M22) * one >= 0)
        return {one, one};
    // where two patterns meet they are the same, and rounding may refuse both: so not too strict
    const double slack = 1e-9 * g / (k.h1 + k.h2);
    const Start same = both(front);
    if (same.lower > -slack && same.upper > same.lower - slack)
        return same;
    const Start opposite = both(back);
    if (opposite.lower > 0 && opposite.upper < opposite.lower + slack)
        return opposite;
    throw std::logic_error("no pattern of two blocks fits this acceleration");
}

} // namespace stylobate::verification
