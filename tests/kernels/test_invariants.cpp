/// What must hold for any structure and any motion: it stays where it rests, contacts only push, friction keeps its
/// cone, and left is as right.

#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/reference_solver.hpp"
#include "studies/evidence/verification/trials.hpp"

#include "ensemble/planar/structure/static_state.hpp"
#include "tests/kernels/uneven_drums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace stylobate {

namespace {

// ---------------------------------------------------------------- rest

TEST(StaticRest, TheSpecimenStaysThere)
{
    // Flush drums: where the sides coincide the contact direction is off by overlap / width, so that the drums may
    // move sideways by (W overlap / B) / K_T = 6e-11 m at the bottom joint, and less at the others. The base does not
    // move in 1000 steps of a harmonic of no amplitude.
    Realization r = model::spec({1e8, 0.1}, 6e-5);
    r.frequency_hz = 1;
    const Study study = model::harmonic(10, 2);
    for (Isa isa : usable_isas()) {
        LaneSet set(study, nullptr, kernels(isa), r);
        set.load(0, r);
        const Snapshot start = set.snapshot(0);
        for (int chunk = 0; chunk < 16; ++chunk) {
            set.advance();
            const Snapshot now = set.snapshot(0);
            for (std::size_t i = 1; i < r.blocks.size(); ++i) {
                EXPECT_NEAR(now.x_m[i], start.x_m[i], 1e-9);
                EXPECT_NEAR(now.y_m[i], start.y_m[i], 1e-12); // a part in 10^6 of the overlap
                EXPECT_NEAR(now.theta_rad[i], 0, 1e-8);
            }
        }
    }
}

TEST(StaticRest, ALeanedStackPressesTheBaseWithItsWeight)
{
    // by exact clipping; the start is found by halving the way, so it should hold to rounding
    for (double tilt : {0.05, -0.05, 0.134}) {
        Realization r = model::spec({1e8, 0.1}, 6e-5, 1e-4);
        r.initial_tilt_rad = tilt;
        const StaticState rest = static_state(r);
        const auto state = [&](std::size_t i) {
            return reference::State{{r.blocks[i].x_m + rest.x_m[i], r.blocks[i].y_m + rest.y_m[i]}, rest.theta_rad[i]};
        };
        const auto area = reference::Solver::overlap_of(r.blocks[0], state(0), r.blocks[1], state(1)).area;
        EXPECT_NEAR(static_cast<double>(1e8L * area), 6 * 0.1355 * 9.81, 1e-6) << "tilt " << tilt;
    }
}

// ---------------------------------------------------------------- left and right

/// Position of the top block in time: the start, then after each step.
std::vector<double> top_history(const Study& study, const Realization& r, int steps)
{
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    std::vector<double> x{set.snapshot(0).x_m.back()};
    for (int n = 0; n < steps; ++n) {
        set.advance(n % chunk_steps, n % chunk_steps + 1);
        x.push_back(set.snapshot(0).x_m.back());
    }
    return x;
}

TEST(LeftAndRight, FreeRockingIsTheSame)
{
    Realization left = verification::leaned_block(model::mono_stone, 1e8, 0.5, 0.2), right = left;
    right.initial_tilt_rad = -left.initial_tilt_rad;
    const auto a = top_history(model::still(1), left, 4000), b = top_history(model::still(1), right, 4000);
    for (std::size_t i = 0; i < a.size(); i += 100) // the start is found by halving, to rounding
        EXPECT_NEAR(a[i], -b[i], 1e-11) << "step " << i;
}

// ---------------------------------------------------------------- invariants

Realization uneven_specimen(unsigned seed, double step_s)
{
    const std::vector<model::Stone> stones = model::uneven_drums(seed);
    return model::stack(stones, {1e8, 0.1, 0.68}, step_s);
}

TEST(Invariants, NoTensionAndFrictionInItsCone)
{
    for (unsigned seed : {1u, 2u, 3u}) {
        const double dt = 5e-5;
        const Realization r = uneven_specimen(seed, dt);
        model::BareColumn column(r);
        const StaticState rest = static_state(r);
        for (int i = 0; i < column.blocks(); ++i) {
            column.at(OfBlock::x, i) = rest.x_m[static_cast<std::size_t>(i)];
            column.at(OfBlock::y, i) = rest.y_m[static_cast<std::size_t>(i)];
            column.at(OfBlock::theta, i) = rest.theta_rad[static_cast<std::size_t>(i)];
        }
        std::mt19937 random(seed);
        std::normal_distribution<double> force(0, 1);
        double push = 0, largest_rotation = 0;
        int slipping = 0, apart = 0;
        for (int n = 0; n < 6000; ++n) {
            std::vector<reference::State> states;
            for (int i = 0; i < column.blocks(); ++i) {
                const Block& block = r.blocks[static_cast<std::size_t>(i)];
                states.push_back({{block.x_m + column.at(OfBlock::x, i), block.y_m + column.at(OfBlock::y, i)},
                                  column.at(OfBlock::theta, i)});
                largest_rotation = std::max(largest_rotation, std::fabs(column.at(OfBlock::theta, i)));
            }
            push += 0.01 * (-push + 80 * force(random)); // coloured noise of some 6 m/s2
            column.step(push * dt * dt);

            // the force through a joint is the sum of the contact forces on all that is above
            reference::Vector through(0, 0);
            for (int j = column.joints() - 1; j >= 0; --j) {
                through += reference::Vector(column.at(OfBlock::force_x, j + 1), column.at(OfBlock::force_y, j + 1));
                const auto k = static_cast<std::size_t>(j);
                const auto area = reference::Solver::overlap_of(r.blocks[k], states[k], r.blocks[k + 1], states[k + 1]);
                if (area.area < 1e-14L) { // a force in the air would be an error; 1e-14 m2 makes 1e-6 N
                    EXPECT_LT(through.norm(), 1e-4L) << "step " << n << " joint " << j;
                    ++apart;
                    continue;
                }
                // Sums of forces of tens of N round to 1e-14; absolute positions here to 1e-17 m of overlaps of 1e-7 m,
                // which turn the direction by 1e-9 at the worst.
                const auto normal = through.dot(area.normal());
                const auto tangential = std::fabs(reference::cross(area.normal(), through));
                EXPECT_GE(normal, -1e-6L) << "step " << n << " joint " << j;
                EXPECT_LE(tangential, 0.68L * normal + 1e-6L) << "step " << n << " joint " << j;
                slipping += tangential > 0.6799L * normal;
            }
        }
        EXPECT_GT(largest_rotation, 0.02) << "it should rock";
        EXPECT_GT(slipping, 10) << "it should slip";
        EXPECT_GT(apart, 10) << "some drums should part";
    }
}

TEST(Invariants, MirroredExcitationGivesTheMirroredHistory)
{
    // every operation of the kernel is odd or even in the mirrored quantities, so not even rounding differs
    for (Isa isa : usable_isas()) {
        Realization one = uneven_specimen(5, 5e-5);
        one.frequency_hz = 5;
        one.pga_m_s2 = 4;
        Realization other = one;
        other.pga_m_s2 = -4;
        for (Block& block : other.blocks)
            block.x_m = -block.x_m;
        const Study study = model::harmonic(8, 2);
        LaneSet a(study, nullptr, kernels(isa), one), b(study, nullptr, kernels(isa), other);
        a.load(0, one);
        b.load(0, other);
        double largest = 0;
        for (int chunk = 0; chunk < 300 && !a.outcome(0); ++chunk) {
            a.advance();
            b.advance();
            const Snapshot s = a.snapshot(0), t = b.snapshot(0);
            for (std::size_t i = 1; i < s.x_m.size(); ++i) {
                ASSERT_NEAR(s.x_m[i], -t.x_m[i], 1e-12) << to_string(isa) << " chunk " << chunk;
                ASSERT_NEAR(s.y_m[i], t.y_m[i], 1e-12);
                ASSERT_NEAR(s.theta_rad[i], -t.theta_rad[i], 1e-10);
                largest = std::max(largest, std::fabs(s.theta_rad[i]));
            }
        }
        EXPECT_GT(largest, 0.02);
    }
}

} // namespace

} // namespace stylobate
