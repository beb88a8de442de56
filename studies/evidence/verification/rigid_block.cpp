#include "studies/evidence/verification/rigid_block.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

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

} // namespace stylobate::verification
