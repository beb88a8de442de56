/// The kernel against the slow solver of `reference_solver.hpp`, step by step, on stacks that rock, slide and fly.

#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/reference_solver.hpp"

#include "ensemble/planar/structure/static_state.hpp"
#include "tests/kernels/uneven_drums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace stylobate {

namespace {

using reference::Number;
using reference::Solver;
using reference::State;

constexpr double step_s = 5e-5;
constexpr double frequency_hz = 30, pga_m_s2 = 25;

/// Six drums of unequal widths, a little out of line: no two sides are flush.
Realization uneven_stack(unsigned seed, bool per_chord)
{
    const std::vector<model::Stone> stones = model::uneven_drums(seed);
    Realization r = model::stack(stones, {1e8, 0.1, 0.4, per_chord}, step_s);
    r.frequency_hz = frequency_hz;
    r.pga_m_s2 = pga_m_s2;
    return r;
}

/// The start of the ensemble in absolute positions; the reference stack is built up in extended precision.
std::vector<State> start_of(const Realization& r)
{
    const StaticState rest = static_state(r);
    std::vector<State> states;
    Number top = -2 * Number(r.blocks.front().half_height_m);
    for (std::size_t i = 0; i < r.blocks.size(); ++i) {
        const Number h = r.blocks[i].half_height_m;
        states.push_back({{Number(r.blocks[i].x_m) + rest.x_m[i], top + h + rest.y_m[i]}, rest.theta_rad[i]});
        top += 2 * h;
    }
    return states;
}

/// Displacement of the base under a full sine of acceleration [m].
Number base_displacement_at(int step)
{
    const Number w = 2 * std::numbers::pi_v<Number> * frequency_hz, amplitude = pga_m_s2 / (w * w);
    const Number c = std::clamp<Number>(w * step_s * step, 0, 2 * std::numbers::pi_v<Number>);
    return amplitude * (c - std::sin(c));
}

Number base_acceleration_at(int step)
{
    const Number difference =
        base_displacement_at(step + 1) - 2 * base_displacement_at(step) + base_displacement_at(step - 1);
    return difference / (Number(step_s) * step_s);
}

struct Differences {
    double position_m = 0, rotation_rad = 0, largest_rotation_rad = 0, largest_slip_m = 0;
};

void compare(const Snapshot& kernel, const std::vector<State>& states, Number base, Differences& d)
{
    for (std::size_t i = 1; i < states.size(); ++i) {
        const auto far = [](Number a, double b) { return static_cast<double>(std::fabs(a - Number(b))); };
        d.position_m =
            std::max({d.position_m, far(states[i].at.x() - base, kernel.x_m[i]), far(states[i].at.y(), kernel.y_m[i])});
        d.rotation_rad = std::max(d.rotation_rad, far(states[i].angle, kernel.theta_rad[i]));
        d.largest_rotation_rad =
            std::max(d.largest_rotation_rad, std::fabs(kernel.theta_rad[i] - kernel.theta_rad[i - 1]));
    }
}

/// Steps the kernel and the reference together, in the laboratory frame or in the frame of the base.
Differences run_together(const Realization& r, Isa isa, bool laboratory, int steps = 12 * chunk_steps)
{
    const Study study = model::pulse(ExcitationKind::full_sine);
    LaneSet set(study, nullptr, kernels(isa), r);
    const int lane = set.lanes() - 1;
    set.load(lane, r);
    Solver solver(r, start_of(r));
    Differences d;
    for (int n = 0; n < steps; ++n) {
        set.advance(n % chunk_steps, n % chunk_steps + 1);
        if (laboratory)
            solver.step(base_displacement_at(n + 1));
        else
            solver.step(0, base_acceleration_at(n));
        compare(set.snapshot(lane), solver.blocks(), laboratory ? base_displacement_at(n + 1) : Number(0), d);
    }
    return d;
}

class Reference : public testing::TestWithParam<bool> {};

// What the two may differ by: they start from the same numbers, and the kernel's displacements, of up to 10 mm, are
// rounded to 1e-18 m at each step. Shaken, the two stay within 5e-17 m and 2e-15 rad for 768 steps, while one part in
// 10^6 in K_T alone makes them differ by 2e-11 m and 1e-9 rad.
constexpr double allowed_m = 1e-14, allowed_rad = 2e-13;
// Each impact of a falling stack multiplies what is there by 10 to 100: 5e-12 after the first 256 steps.
constexpr double allowed_after_impacts = 1e-9;

} // namespace

TEST_P(Reference, RockingStackInTheLaboratoryFrame)
{
    for (Isa isa : usable_isas())
        for (unsigned seed : {1u, 2u, 3u}) {
            const Differences d = run_together(uneven_stack(seed, GetParam()), isa, true);
            EXPECT_GT(d.largest_rotation_rad, 0.01) << "the stack should rock, or little is compared";
            EXPECT_LT(d.position_m, allowed_m) << to_string(isa) << " seed " << seed;
            EXPECT_LT(d.rotation_rad, allowed_rad) << to_string(isa) << " seed " << seed;
        }
}

TEST_P(Reference, RockingStackInTheFrameOfTheBase)
{
    for (unsigned seed : {4u, 5u}) {
        const Differences d = run_together(uneven_stack(seed, GetParam()), best_isa(), false);
        EXPECT_GT(d.largest_rotation_rad, 0.01);
        EXPECT_LT(d.position_m, allowed_m) << "seed " << seed;
        EXPECT_LT(d.rotation_rad, allowed_rad) << "seed " << seed;
    }
}

TEST_P(Reference, StackDroppedOnItsEdge)
{
    // leaned as one body: it hits the base with its other edge, and the drums fly apart
    for (unsigned seed : {6u, 7u}) {
        Realization r = uneven_stack(seed, GetParam());
        r.initial_tilt_rad = seed % 2 ? 0.05 : -0.05;
        const Differences d = run_together(r, best_isa(), true, 4 * chunk_steps);
        EXPECT_GT(d.largest_rotation_rad, 0.04);
        EXPECT_LT(d.position_m, allowed_after_impacts) << "seed " << seed;
        EXPECT_LT(d.rotation_rad, allowed_after_impacts / 0.0145) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Dashpot, Reference, testing::Bool(),
                         [](const auto& which) { return which.param ? "PerChord" : "PerContact"; });

} // namespace stylobate
