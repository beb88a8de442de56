/// The integration in time: order, period, what it conserves, when it grows, and the balance of energy.

#include "ensemble/planar/structure/static_state.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/stack_vibration.hpp"

#include <fmt/format.h>

#include <random>

namespace stylobate::verification {

namespace {

constexpr const char* scheme_subject = "Time integration";

Finding damped_oscillation()
{
    const double w = 2 * model::pi, xi = 0.05, size = 0.01;
    const double wd = w * std::sqrt(1 - xi * xi);
    const double exact = std::exp(-xi * w) * (std::cos(wd) + xi * w / wd * std::sin(wd));
    const auto at_one_second = [&](int n) {
        const double dt = 1.0 / n, rest = -model::gravity / (w * w);
        model::BareColumn column(model::oscillator(w, xi, dt));
        column.at(OfBlock::y, 1) = rest + size;
        column.at(OfBlock::dy, 1) = 0.5 * w * w * size * dt * dt; // U(-dt) = U0 + a0 dt2 / 2
        for (int i = 0; i < n; ++i)
            column.step();
        return (column.at(OfBlock::y, 1) - rest) / size;
    };
    std::vector<double> steps, values;
    for (int n : {100, 200, 400, 800, 1600, 3200}) {
        steps.push_back(1.0 / n);
        values.push_back(at_one_second(n));
    }
    Finding f;
    f.equals("u(1 s) with 100 steps", 0.729786860, values[0], 1e-9);
    f.equals("u(1 s) with 200 steps", 0.729941218, values[1], 1e-9);
    f.equals("u(1 s), extrapolated from the two smallest steps", exact, 2 * values[5] - values[4], 1e-7);
    f.convergences.push_back(convergence("dt [s]", "u(1 s)", steps, values, exact));
    f.equals("order in dt", 1, f.convergences.back().order, 0.02);
    return f;
}

Finding undamped_oscillation()
{
    Finding f;
    for (const double h : {0.1, 1.0}) {
        const double w = 20 * model::pi, dt = h / w, rest = -model::gravity / (w * w), size = 0.001;
        model::BareColumn column(model::single({1, 0.2, 1}, {w * w, 0, 1}, dt, 2)); // too low to lean aside
        column.at(OfBlock::y, 1) = rest + size;
        column.at(OfBlock::dy, 1) = 0.5 * w * w * size * dt * dt;
        const auto conserved = [&](double before, double now) {
            return 0.5 * (now - before) * (now - before) / (dt * dt) + 0.5 * w * w * (now - rest) * (before - rest);
        };
        // period by zero crossings: the samples lie on a cosine, so the phase between two of them is exact
        const double rate = 2 / h * std::asin(0.5 * h), phase = rate * h;
        const double start = conserved(rest + size - column.at(OfBlock::dy, 1), rest + size);
        double drift = 0, first = -1, last = -1;
        int crossings = 0;
        for (int n = 1; n <= 6000; ++n) {
            const double before = column.at(OfBlock::y, 1);
            column.step();
            const double now = column.at(OfBlock::y, 1);
            drift = std::max(drift, std::fabs(conserved(before, now) / start - 1));
            if (before < rest && now >= rest) {
                // size cos(phase n) through two samples: the sine's argument at each
                const double part =
                    std::atan2(-(before - rest) * std::sin(phase), (now - rest) - (before - rest) * std::cos(phase)) /
                    phase;
                last = n - 1 + part;
                if (first < 0)
                    first = last;
                else
                    ++crossings;
            }
        }
        const double period = (last - first) / crossings;
        f.equals(fmt::format("w_num / w at w dt = {}", h), h == 0.1 ? 1.000417136 : 1.047197551,
                 2 * model::pi / (period * h), 1e-9);
        f.equals(
            fmt::format("largest drift of m v(n+1/2)2 / 2 + k u(n) u(n+1) / 2 in 6000 steps at w dt = {}, relative", h),
            0, drift, 1e-10);
    }
    return f;
}

/// Largest displacement against the static rest, late in a run that starts 1e-11 m beside it [m].
double late_displacement(const Realization& r, int steps)
{
    model::BareColumn column(r);
    const StaticState rest = static_state(r);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> aside(-1e-11, 1e-11);
    const double half_width = r.blocks[1].half_width_m;
    for (int i = 1; i < column.blocks(); ++i) {
        column.at(OfBlock::x, i) = aside(random);
        column.at(OfBlock::y, i) = rest.y_m[static_cast<std::size_t>(i)] + aside(random);
        column.at(OfBlock::theta, i) = aside(random) / half_width;
    }
    double largest = 0;
    for (int n = 0; n < steps; ++n) {
        column.step();
        for (int i = 1; i < column.blocks() && n >= steps - 200; ++i)
            largest = std::max({largest, std::fabs(column.at(OfBlock::x, i)),
                                std::fabs(column.at(OfBlock::y, i) - rest.y_m[static_cast<std::size_t>(i)]),
                                half_width * std::fabs(column.at(OfBlock::theta, i))});
    }
    return largest;
}

/// Least step at which the displacement has grown beyond what a stable one could have [s].
double measured_limit(const std::function<Realization(double)>& at, double guess, int steps)
{
    double low = 0.99 * guess, high = 1.01 * guess;
    while (high - low > 1e-4 * guess) {
        const double middle = 0.5 * (low + high);
        (late_displacement(at(middle), steps) > 5e-9 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

Finding stability()
{
    Finding f;
    const auto drum = [](double dt) { return model::single(model::spec_drum, {1e8, 0, 10}, dt, 0.06); };
    const double one = critical_step_s(drum(1));
    f.equals("one drum, xi = 0: dt [s]", one, measured_limit(drum, one, 4000), 2e-4 * one);
    for (const double xi : {0.0, 0.1, 0.3, 0.5}) {
        const auto column = [xi](double dt) { return model::spec({1e8, xi, 10}, dt, 1e-6); };
        const double critical = critical_step_s(column(1));
        // 1e-4 beyond the limit the undamped column grows by 3 % a step, the damped ones by some 5e-4
        f.equals(fmt::format("SPEC, xi = {}: dt [s]", xi), critical,
                 measured_limit(column, critical, xi == 0 ? 4000 : 60000), 4e-4 * critical);
    }
    Realization light = model::spec({1e8, 0, 10}, 1);
    f.equals("the oracle against the reference value of SPEC, xi = 0 [s]", 1.601231e-4, critical_step_s(light), 1e-10);
    light.gravity_m_s2 = 0;
    for (const auto& [xi, digits] : {std::pair{0.1, 1.349618e-4}, {0.3, 0.952181e-4}, {0.5, 0.700472e-4}}) {
        Realization damped = model::spec({1e8, xi, 10}, 1);
        damped.gravity_m_s2 = 0;
        f.equals(fmt::format("the oracle against the reference value of SPEC without weight, xi = {} [s]", xi), digits,
                 critical_step_s(damped), 1e-10);
    }
    return f;
}

Finding energy_balance()
{
    const auto residual = [](double rate, double xi) {
        const model::Bed bed{1e8, xi, 5, true};
        Realization r = model::single(model::mono_stone, bed, rate / model::bed_rate(bed, model::mono_stone), 0.1);
        r.initial_tilt_rad = 0.5 * model::slenderness(model::mono_stone);
        return std::fabs(model::run_one(model::still(0.5), r).energy_residual);
    };
    const std::vector<double> rates{0.4, 0.2, 0.1, 0.05, 0.025, 0.0125};
    Finding f;
    for (const double xi : {0.1, 0.0}) {
        std::vector<double> values;
        for (double rate : rates)
            values.push_back(residual(rate, xi));
        f.at_most(fmt::format("residual of the balance at dt w1 = 0.4, xi = {}, over the energy transferred", xi),
                  xi > 0 ? 3e-3 : 1e-3, values.front());
        f.at_most(fmt::format("the same at dt w1 = 0.0125, xi = {}", xi), xi > 0 ? 1e-4 : 1e-5, values.back());
        f.convergences.push_back(convergence("dt w1", fmt::format("energy residual, xi = {}", xi), rates, values, 0));
        f.at_least(fmt::format("order in dt, xi = {}", xi), xi > 0 ? 0.8 : 1.0, f.convergences.back().order);
    }
    return f;
}

} // namespace

Cases scheme_cases()
{
    return {
        {"DampedOscillation", scheme_subject,
         "u'' + 2 xi w u' + w2 u = 0, w = 2 pi, xi = 0.05, from u = 1 at rest: the displacement after one second.",
         "the closed form; and for the scheme with the velocity of the last step its recurrence, run by "
         "`reference_values.py`.",
         "the nine digits of that value; the velocity of the last step makes the scheme first order.",
         damped_oscillation},
        {"UndampedOscillation", scheme_subject,
         "Period of a mass on its bed, and the quantity that central differences conserve.",
         "w_num / w = (2 / h) asin(h / 2), h = w dt; m v2 / 2 + k u(n) u(n+1) / 2 is constant.",
         "rounding over 6000 steps.", undamped_oscillation},
        {"StepLimit", scheme_subject,
         "Smallest time step at which a disturbance of SPEC (K_N = 1e8) of 1e-11 m grows, found by bisection.",
         "the step at which 4 M - 2 dt C - dt2 K is no longer positive definite, with matrices assembled from discrete "
         "springs; reference values (`reference_values.py`).",
         "the excess over the limit that is needed for visible growth within the run.", stability},
        {"EnergyBalance", scheme_subject,
         "Kinetic + potential + spring + dissipated energy minus the work of the base over three impacts of MONO, "
         "released from half its slenderness angle.",
         "0.",
         "the work is computed with the contact centroid at one end of a step, and contacts open and close within a "
         "step. The error is of first order, with a larger constant where there are dashpots.",
         energy_balance},
    };
}

} // namespace stylobate::verification
