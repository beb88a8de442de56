/// Terms of the safe step by hand: dashpots that grow with the load, clamps.

#include "ensemble/planar/structure/step_bound.hpp"
#include "tests/ensemble/planar/equal_drums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace stylobate;

/// F = K A (1 + lambda v) is a dashpot lambda F. At ten times the load at rest, F = m g, its coefficient is 10 lambda m
/// g; at full contact it acts on the mass alone, at an edge on 1 / (1/m + b2/I).
TEST(StepBound, DashpotThatGrowsWithTheLoad)
{
    Realization r = make(with(mono, 1e8));
    const Block& block = r.blocks[1];
    const double edge = 1 / 0.813 + 0.024 * 0.024 / block.inertia_kg_m2;
    for (const double lambda : {1.0, 1e4}) {
        r.joints[0].mechanisms.rate_s_m = lambda;
        const double C = 10 * lambda * 0.813 * 9.81;
        const StepBound got = step_bound(r);
        EXPECT_NEAR(got.edge_s * C * edge, 1, 1e-9) << lambda;
        // 4 - 2 dt c - dt2 w2 = 0 with c = 2 C / m
        const double c = 2 * C / 0.813, dt = got.dashpot_s;
        EXPECT_NEAR(2 * dt * c + 4 * dt * dt / (got.stiffness_s * got.stiffness_s), 4, 1e-9) << lambda;
        EXPECT_EQ(got.governed_by, lambda > 1 ? StepLimit::edge_dashpot : StepLimit::dashpot);
    }
}

/// A clamp much stiffer than the contacts, at the height y above the middle of the left block and at half its width b:
/// it may turn, so that it holds its end in both directions and the block has 1/m and 1/m + (b2 + y2)/I. The right
/// block's end lies y_left + y - y_right above its middle.
TEST(StepBound, ClampsCountAtTheirHeight)
{
    Realization r = make(with(spec, 1e6));
    r.blocks.resize(3); // the ground and two blocks beside each other on it
    r.joints.resize(2);
    r.joints[1].lower = 0;
    r.drums = 3;
    Block &left = r.blocks[1], &right = r.blocks[2];
    r.blocks[0].half_width_m = 0.1;
    left.x_m = -0.03;
    right.x_m = 0.03;
    right.half_height_m = 0.04;
    right.y_m = left.y_m - left.half_height_m + 0.04;
    left.strengthening.clamp_to = 2;
    left.strengthening.clamp_n_m = 1e13;
    left.strengthening.clamp_strength_n = 1;
    for (const double height : {-0.01, 0.0, 0.012}) {
        left.strengthening.clamp_height_m = height;
        const double at_right = left.y_m + height - right.y_m;
        const auto rate = [](const Block& block, double y) {
            return 1e13 * (1 / block.mass_kg + (block.half_width_m * block.half_width_m + y * y) / block.inertia_kg_m2);
        };
        const double most = std::max(rate(left, height), rate(right, at_right));
        const StepBound got = step_bound(r);
        EXPECT_NEAR(got.stiffness_s / (2 / std::sqrt(2 * most)), 1, 1e-5) << height;
        EXPECT_EQ(got.block, rate(left, height) > rate(right, at_right) ? 1 : 2) << height;
    }
    right.fixed = true; // then the left end alone
    left.strengthening.clamp_height_m = 0.02;
    const double alone = 1e13 * (1 / left.mass_kg + (0.024 * 0.024 + 0.02 * 0.02) / left.inertia_kg_m2);
    EXPECT_NEAR(step_bound(r).stiffness_s / (2 / std::sqrt(2 * alone)), 1, 1e-5);
}
