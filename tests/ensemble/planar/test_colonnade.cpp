/// Structures that are no stack: their rest, contacts between blocks that were no neighbours, falls.

#include "ensemble/planar/limit_states.hpp"
#include "ensemble/planar/structure/settle.hpp"
#include "ensemble/planar/structure/static_state.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "studies/evidence/verification/model.hpp"
#include "tests/kernels/uneven_drums.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

using namespace stylobate;
using namespace stylobate::model;

namespace {

/// Step of a colonnade: 0.9 of its safe bound.
Realization with_safe_step(Realization r)
{
    r.step_s = 0.9 * step_bound(r).dt_s;
    return r;
}

Realization paper(int drums, double xi = 0.1)
{
    Bed bed;
    bed.xi = xi;
    return with_safe_step(colonnade(paper_colonnade(drums), bed, 1));
}

/// Four columns of two drums, an epistyle over each bay, flush with the next one.
Realization row_of_four()
{
    Colonnade c = paper_colonnade(2);
    c.columns = 4;
    c.one_epistyle = false;
    c.epistyle = {0.09, 0.06, 0.684};
    Bed bed;
    bed.xi = 0.1;
    return with_safe_step(colonnade(c, bed, 1));
}

Study shaken(double cycles)
{
    Study study = harmonic(cycles, 1);
    study.outcome.follow = Follow::rest;
    return study;
}

} // namespace

TEST(Settle, WeightsGoDownThroughTheColumns)
{
    for (const int drums : {1, 2, 4}) {
        const Realization r = paper(drums);
        const StaticState rest = static_state(r);
        // by hand: each bed of a column carries what is above it and half the epistyle
        const double B = 0.06, K = 1e8, drum = 0.75 / drums;
        double sunk = 0;
        for (int i = 0; i < drums; ++i) {
            sunk -= (drum * (drums - i) + 1.14 / 2) * gravity / (K * B);
            for (const int column : {0, 1})
                EXPECT_NEAR(rest.y_m[static_cast<std::size_t>(column * drums + i)], sunk, 1e-9 * std::fabs(sunk));
        }
        sunk -= 1.14 / 2 * gravity / (K * B);
        EXPECT_NEAR(rest.y_m[static_cast<std::size_t>(2 * drums)], sunk, 1e-9 * std::fabs(sunk));
        for (std::size_t i = 0; i < r.blocks.size(); ++i) {
            EXPECT_NEAR(rest.x_m[i], 0, 1e-13);
            EXPECT_NEAR(rest.theta_rad[i], 0, 1e-12);
        }
    }
}

/// A single column is settled bed by bed; the general way finds the same rest.
TEST(Settle, AgreesWithTheStack)
{
    for (const double tilt : {0.0, 0.002, -0.02}) {
        Bed bed;
        Realization r = stack(uneven_drums(3), bed, 1, 0.1);
        r.base_tilt_rad = tilt;
        for (Block& block : r.blocks)
            block.role = block.fixed ? BlockRole::ground : BlockRole::drum;
        const StaticState want = static_state(r);
        std::vector<Pose> poses;
        for (const Block& block : r.blocks)
            poses.push_back({block.x_m, block.y_m, 0});
        std::vector<double> spring;
        EXPECT_LT(settle(r, beds_at_rest(r), poses, spring), 1e-10) << tilt;
        double height = 0;
        for (std::size_t i = 1; i < r.blocks.size(); ++i) {
            height += 2 * r.blocks[i].half_height_m;
            // the stack does without the elastic sliding, weight x tilt / K_T in each bed, and what it adds up to
            const double slid = 0.01 * std::fabs(tilt) * 1e-3 + 1e-9;
            EXPECT_NEAR(poses[i].y - r.blocks[i].y_m, want.y_m[i], 0.02 * std::fabs(want.y_m[i]) + 1e-9) << i;
            EXPECT_NEAR(poses[i].theta, want.theta_rad[i], 0.02 * std::fabs(want.theta_rad[i]) + 1e-8) << i;
            EXPECT_NEAR(poses[i].x - r.blocks[i].x_m, want.x_m[i],
                        0.03 * std::fabs(want.x_m[i]) + slid + height * 1e-8 + 7 * std::fabs(tilt) * 1.67e-6)
                << i;
            // nor does it know that the faces it lies on have turned, by 4e-5 rad here
            EXPECT_NEAR(spring[i - 1], want.spring_n[i - 1], 8 * (4e-5 + 2e-3 * std::fabs(tilt))) << i;
        }
    }
}

/// What stands is in equilibrium: it does not bounce, creep or rock when it is left alone.
TEST(Settle, ARestIsARest)
{
    for (const double tilt : {0.0, 0.003})
        for (const int which : {0, 1, 2, 3}) {
            Realization r = which == 3 ? row_of_four() : paper(1 << which);
            r.base_tilt_rad = tilt;
            for (std::size_t i = 0; i + 1 < r.blocks.size(); ++i) // nothing stands exactly on its axis
                if (r.blocks[i].role == BlockRole::drum)
                    r.blocks[i].x_m += 1e-4 * std::sin(7.0 * static_cast<double>(i + 1));
            Study study = still(0.5);
            study.outcome.follow = Follow::rest;
            const Outcome o = run_one(study, r);
            EXPECT_EQ(o.state, State::stood);
            EXPECT_LT(std::fabs(o.energy_kinetic_j), 1e-13) << which << ' ' << tilt;
            EXPECT_LT(std::fabs(o.residual_top_displacement_m), 2e-9) << which << ' ' << tilt;
            EXPECT_LT(o.total_sliding_m, 1e-9) << which << ' ' << tilt;
        }
}

/// The colonnade leans as a frame: every column about its own corner, the epistyle level on the risen corners.
TEST(Settle, AFrameLeansOnItsCorners)
{
    for (const double lean : {0.05, -0.1}) {
        // an epistyle that reaches beyond the columns: flush corners are another test
        Colonnade c = paper_colonnade(1);
        c.epistyle.width = 0.17;
        Realization r = with_safe_step(colonnade(c, {}, 1));
        r.initial_tilt_rad = lean;
        const StaticState s = static_state(r);
        const double b = 0.03, H = 0.1, side = lean > 0 ? 1 : -1, turn = std::fabs(lean);
        // The top corner away from the pivot rises and moves with the rotation about the other bottom corner. Edges
        // sink in until the triangle under them carries the weight: N = K d2 / (2 tan).
        const auto depth = [&](double N) { return std::sqrt(2 * N * std::tan(turn) / 1e8); };
        const double x = -side * (H * std::sin(turn) + 2 * b * (1 - std::cos(turn)));
        const double y =
            2 * b * std::sin(turn) - H * (1 - std::cos(turn)) - depth((0.75 + 0.57) * gravity) - depth(0.57 * gravity);
        EXPECT_NEAR(s.x_m[2], x, 2e-6);
        EXPECT_NEAR(s.y_m[2], y, 2e-6);
        EXPECT_NEAR(s.theta_rad[2], 0, 1e-9);
        EXPECT_NEAR(s.theta_rad[0], lean, 1e-6);
        EXPECT_NEAR(s.theta_rad[1], lean, 1e-6);
        // and every contact carries its part of the weight at once
        BareColumn frame(r);
        for (int i = 0; i < 3; ++i) {
            frame.at(OfBlock::x, i) = s.x_m[static_cast<std::size_t>(i)];
            frame.at(OfBlock::y, i) = s.y_m[static_cast<std::size_t>(i)];
            frame.at(OfBlock::theta, i) = s.theta_rad[static_cast<std::size_t>(i)];
        }
        frame.step();
        EXPECT_NEAR(frame.at(OfBlock::force_y, 2), 1.14 * gravity, 1e-9);
        for (const int i : {0, 1})
            EXPECT_NEAR(frame.at(OfBlock::force_y, i), 0.75 * gravity, 1e-9);
    }
}

/// Two corners that meet: it is undecided whose face carries. The direction lies between the two faces' normals, so it
/// is off by the rotation between the blocks at the most, and goes over from one to the other without a jump while the
/// one corner passes the other, within the depth of the contact.
TEST(Pairs, FlushCornersHaveADirectionBetweenTheFaces)
{
    const Block seat{0.03, 0.05, 1, 1, 0, -0.05, true}, epistyle{0.075, 0.03, 1, 1, 0, 0.03, false};
    const double turn = 0.06, depth = 1e-5; // the column leans to the left, its right top corner carries
    const double corner_x = 0.03 * std::cos(turn) - 0.05 * std::sin(turn);
    const double corner_y = 0.03 * std::sin(turn) + 0.05 * std::cos(turn);
    double before = 0, least = HUGE_VAL, most = -HUGE_VAL, jump = 0;
    const double step = depth / 200;
    for (double past = -20 * depth; past < 3 * depth; past += step) {
        // the epistyle's right end lies this far beyond the column's corner
        const Pose upper{corner_x + past - 0.075, corner_y - depth + 0.03, 0};
        const Overlap<double> o = overlap_of(seat, {0, 0, turn}, epistyle, upper);
        const double direction = turn + std::atan2(-o.normal_x, o.normal_y); // against the vertical
        least = std::min(least, direction);
        most = std::max(most, direction);
        if (past > -20 * depth)
            jump = std::max(jump, std::fabs(direction - before));
        before = direction;
    }
    EXPECT_NEAR(before, 0, 1e-6); // well beyond: the epistyle's face
    EXPECT_GT(least, -1e-6);
    EXPECT_LT(most, turn + 1e-6);
    EXPECT_LT(jump, 1.5 * turn / 200 * 20);
}

/// Two free blocks thrown into each other in any position: forces and moments are opposite to rounding.
TEST(Pairs, ActionIsReaction)
{
    Realization r = paper(1);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    int touched = 0;
    for (int round = 0; round < 400; ++round) {
        BareColumn pair(r, 1e-3);
        // column 0 far above the ground, column 1 somewhere about it, both away from the epistyle
        const double y = 5, x = 0.02 * any(random);
        pair.at(OfBlock::y, 0) = y;
        pair.at(OfBlock::y, 1) = y + 0.09 * any(random);
        pair.at(OfBlock::x, 1) = -0.09 + x + 0.08 * any(random);
        pair.at(OfBlock::theta, 0) = 3 * any(random);
        pair.at(OfBlock::theta, 1) = 3 * any(random);
        pair.at(OfBlock::x, 2) = 20;
        pair.step();
        const double fx = pair.at(OfBlock::force_x, 0), fy = pair.at(OfBlock::force_y, 0);
        const double gx = pair.at(OfBlock::force_x, 1), gy = pair.at(OfBlock::force_y, 1);
        const double size = std::hypot(fx, fy);
        touched += size > 0 ? 1 : 0;
        EXPECT_EQ(fx, -gx);
        EXPECT_EQ(fy, -gy);
        // (the step has moved the blocks by dt2 F / m, which is where the moments are taken)
        const double back_x = r.step_s * r.step_s * (fx / 0.75 - gx / 0.75);
        const double back_y = r.step_s * r.step_s * (fy / 0.75 - gy / 0.75);
        const double apart_x =
            r.blocks[1].x_m - r.blocks[0].x_m + pair.at(OfBlock::x, 1) - pair.at(OfBlock::x, 0) + back_x;
        const double apart_y = pair.at(OfBlock::y, 1) - pair.at(OfBlock::y, 0) + back_y;
        const double moment = pair.at(OfBlock::moment, 0) + pair.at(OfBlock::moment, 1) + apart_x * gy - apart_y * gx;
        EXPECT_NEAR(moment, 0, 1e-12 * size + 1e-15);
    }
    EXPECT_GT(touched, 100);
    EXPECT_LT(touched, 400);
}

/// Which pairs are listed as close, and how often they are looked for, changes no bit: no contact is missed. With a
/// skin of nothing the pairs are looked for in every step, with a huge one all of them are worked on in every step.
TEST(Pairs, NoContactIsMissed)
{
    const Realization r = paper(2);
    const auto end_of = [&](double skin) {
        BareColumn heap(r, skin);
        std::mt19937 random(11);
        std::uniform_real_distribution<double> any(-1, 1);
        for (int i = 0; i < r.drums; ++i) { // thrown about and let fall
            heap.at(OfBlock::dx, i) = 1.2 * r.step_s * any(random);
            heap.at(OfBlock::dtheta, i) = 12 * r.step_s * any(random);
            heap.at(OfBlock::dy, i) = 0.8 * r.step_s;
        }
        for (int step = 0; step < 12000; ++step)
            heap.step();
        std::vector<double> state;
        for (int i = 0; i < r.drums; ++i)
            for (const auto field : {OfBlock::x, OfBlock::y, OfBlock::theta, OfBlock::dx, OfBlock::dy, OfBlock::dtheta})
                state.push_back(heap.at(field, i));
        int pressed = 0; // pairs, other than those on the ground
        for (int j = r.beds(); j < heap.joints(); ++j)
            pressed += heap.at(OfJoint::dashpot_force, j) != 0 ? 1 : 0;
        state.push_back(pressed);
        return state;
    };
    const std::vector<double> want = end_of(0);
    double fallen = 0;
    for (int i = 0; i < r.drums; ++i)
        fallen = std::max(fallen, std::fabs(want[static_cast<std::size_t>(6 * i + 2)]));
    EXPECT_GT(fallen, 1.0);
    EXPECT_GE(want.back(), 1);
    for (const double skin : {1e-3, 5e-3, 2e-2, 100.0}) {
        const std::vector<double> got = end_of(skin);
        for (std::size_t i = 0; i < want.size(); ++i)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(got[i]), std::bit_cast<std::uint64_t>(want[i])) << skin << ' ' << i;
    }
}

/// A block dropped without damping and friction on the ground beside its column comes back to its height.
TEST(Pairs, AFlatFallOnTheGroundKeepsItsEnergy)
{
    Bed bed;
    bed.mu = 0;
    Realization r = colonnade(paper_colonnade(2), bed, 1e-6);
    BareColumn fall(r, 1e-3);
    const int drum = 1; // the upper drum of the left column, whose pair with the ground is watched
    fall.at(OfBlock::x, drum) = -1;
    fall.at(OfBlock::y, drum) = 0.01 - 0.05; // its bottom 10 mm above the ground
    const double start = fall.at(OfBlock::y, drum);
    double lowest = start, highest = -1;
    const double period = 2 * std::sqrt(2 * 0.01 / gravity);
    for (int step = 0; step < static_cast<int>(1.1 * period / r.step_s); ++step) {
        fall.step();
        const double y = fall.at(OfBlock::y, drum);
        if (y < lowest) {
            lowest = y;
            highest = y;
        }
        highest = std::max(highest, y);
    }
    // a spring of K_N B under the falling mass: the greatest depth is that of m g (h + d) = k d2 / 2
    const double m = 0.375, k = 1e8 * 0.06, mg = m * gravity;
    const double depth = mg / k + std::sqrt(mg * mg / (k * k) + 2 * mg * 0.01 / k);
    EXPECT_NEAR(start - lowest, 0.01 + depth, 2e-3 * depth);
    EXPECT_NEAR(highest, start, 1e-5);
}

/// Everything that falls ends on the ground, inside nothing, and the energy balances on the way.
TEST(Heap, LiesOnTheGround)
{
    for (const Realization& pattern : {paper(1), paper(2), paper(4), row_of_four()}) {
        std::vector<Realization> all;
        for (int i = 0; i < 8; ++i) {
            all.push_back(pattern);
            all.back().frequency_hz = 2;
            all.back().pga_m_s2 = 12 + 0.2 * i;
        }
        const Study study = shaken(6);
        LaneSet set(study, nullptr, kernels(Isa::scalar), pattern);
        int fallen = 0;
        for (const Realization& r : all) {
            set.load(0, r);
            while (!set.outcome(0))
                set.advance();
            const Outcome o = *set.outcome(0);
            const Snapshot s = set.snapshot(0);
            EXPECT_NE(o.state, State::invalid);
            EXPECT_LT(std::fabs(o.energy_residual), 0.02);
            fallen += o.fallen_blocks;
            for (std::size_t i = 0; i < static_cast<std::size_t>(r.drums); ++i) {
                const Block& block = r.blocks[i];
                const double low = s.y_m[i] - block.half_width_m * std::fabs(std::sin(s.theta_rad[i])) -
                                   block.half_height_m * std::fabs(std::cos(s.theta_rad[i]));
                // a block that leans stands on a corner, which sinks in by sqrt(N / K) at 45 degrees: .4 mm of 20 N
                EXPECT_GT(low, -6e-4) << "block " << i << " is in the ground";
                for (std::size_t k = 0; k < i; ++k) {
                    const auto pose = [&](std::size_t b) { return Pose{s.x_m[b], s.y_m[b], s.theta_rad[b]}; };
                    const double area = overlap_of(r.blocks[k], pose(k), block, pose(i)).area;
                    EXPECT_LT(area, 1e-4 * 0.06) << i << " is in " << k; // by less than 0.1 mm over a face
                }
            }
            set.clear(0);
        }
        EXPECT_GT(fallen, 8);
    }
}

/// Fewer blocks are followed with `Follow::collapse`: it ends with the first fall, which is the same one.
TEST(Heap, TheFirstFallIsTheSameWhetherItIsFollowedOrNot)
{
    Study on = shaken(6), stop = on;
    stop.outcome.follow = Follow::collapse;
    for (int i = 0; i < 6; ++i) {
        Realization r = paper(2);
        r.frequency_hz = 2;
        r.pga_m_s2 = 10 + 0.5 * i;
        const Outcome a = run_one(on, r), b = run_one(stop, r);
        ASSERT_EQ(a.state, b.state);
        if (a.state != State::collapsed)
            continue;
        EXPECT_GE(a.fallen_blocks, b.fallen_blocks);
        EXPECT_GE(a.end_time_s, b.end_time_s);
        // a block that has turned, and is called fallen later, may have begun to earlier
        EXPECT_LE(a.collapse_time_s, b.collapse_time_s);
        EXPECT_EQ(a.fall_time_s.size(), 5u);
        double first = HUGE_VAL;
        for (const double t : a.fall_time_s)
            if (t >= 0)
                first = std::min(first, t);
        EXPECT_EQ(first, a.collapse_time_s);
        if (a.first_collapse_block != several_blocks) {
            EXPECT_EQ(a.fall_time_s[static_cast<std::size_t>(a.first_collapse_block)], first);
        }
        if (a.total_collapse_time_s >= 0) {
            EXPECT_GE(a.total_collapse_time_s, first);
        }
    }
}

/// Scripted motions: what counts as fallen, in which order, and when all is down.
TEST(LimitStates, FollowAScript)
{
    const Realization r = paper(2); // 0, 1: left column; 2, 3: right column; 4: epistyle
    OutcomeSpec spec;
    LimitStates limits(r, spec, 0, 128);
    std::vector<BlockMotion> moved(r.blocks.size());
    const std::vector<int> inside(r.blocks.size(),
                                  chunk_steps - 1); // what is outside at a check is so by its last step
    const auto check = [&](std::uint64_t steps) { limits.check(r, steps, moved, inside, chunk_steps); };
    check(64);
    EXPECT_FALSE(limits.fallen());
    moved[1].theta_rad = 1.0; // beyond atan(60 / 50) = 0.876, and back in time
    check(128);
    EXPECT_TRUE(limits.undecided());
    moved[1].theta_rad = 0.5;
    check(192);
    EXPECT_FALSE(limits.undecided());
    EXPECT_FALSE(limits.fallen());
    moved[4].x_m = 0.046; // the left seat ends at 0.03, the epistyle's left end lies at -0.03 + 0.046
    check(256);
    moved[4].x_m = 0.061; // beyond it
    check(320);
    moved[3].theta_rad = -1.2; // to stay
    check(384);
    check(448);
    EXPECT_FALSE(limits.fallen());
    check(512);
    EXPECT_TRUE(limits.fallen());
    moved[4].y_m = -0.1; // low: at once
    check(576);
    moved[0].y_m = -0.011; // of 0.025: below 0.6 of it
    check(640);
    Outcome o;
    limits.write(r.step_s, r.drums, o);
    const double dt = r.step_s;
    EXPECT_EQ(o.fall_time_s, (std::vector<double>{640 * dt, -1, -1, 384 * dt, 576 * dt}));
    EXPECT_EQ(o.first_collapse_block, 3);
    EXPECT_EQ(o.collapse_time_s, 384 * dt);
    EXPECT_EQ(o.fallen_blocks, 3);
    EXPECT_EQ(o.unseated_block, 4);
    EXPECT_EQ(o.unseating_time_s, 320 * dt);
    EXPECT_EQ(o.total_collapse_time_s, 640 * dt);
}

/// The epistyle (0.15 x 0.06 m) lies on two columns (0.06 m wide), its middle 0.045 m from the left one's. Turned by 60
/// degrees its bottom face reaches 0.075 cos 60 = 0.0375 m to either side of its middle, which has moved by its half
/// height x sin 60; it has a seat while this middle is within 0.03 + 0.0375 m of the column's.
TEST(LimitStates, ATurnedEpistyleReachesOverLess)
{
    const Realization r = paper(2);
    const Block &left = r.blocks[1], &epistyle = r.blocks[4];
    const double turn = std::numbers::pi / 3, reach = left.half_width_m + epistyle.half_width_m * std::cos(turn);
    ASSERT_LT(turn, std::atan(epistyle.half_width_m / epistyle.half_height_m));
    const double middle = epistyle.x_m - left.x_m + epistyle.half_height_m * std::sin(turn);
    for (const double beyond : {-1e-6, 1e-6}) {
        LimitStates limits(r, {}, 0, 1 << 20);
        std::vector<BlockMotion> moved(r.blocks.size());
        moved[4].theta_rad = turn;
        moved[4].x_m = reach - middle + beyond;
        moved[3].x_m = moved[4].x_m; // the right column goes with it
        limits.check(r, 64, moved, std::vector<int>(r.blocks.size(), chunk_steps - 1), chunk_steps);
        EXPECT_EQ(limits.unseated(), beyond > 0);
        // turned with its seat it does not reach over less
        LimitStates together(r, {}, 0, 1 << 20);
        moved[1].theta_rad = turn;
        moved[4].x_m = moved[4].y_m = 0;
        const double along = face_offset(left, moved[1], epistyle, moved[4]);
        moved[4].x_m = (left.half_width_m + epistyle.half_width_m - along + beyond) * std::cos(turn);
        moved[4].y_m = (left.half_width_m + epistyle.half_width_m - along + beyond) * std::sin(turn);
        moved[3].x_m = moved[4].x_m;
        together.check(r, 64, moved, std::vector<int>(r.blocks.size(), chunk_steps - 1), chunk_steps);
        EXPECT_EQ(together.unseated(), beyond > 0);
    }
}

TEST(LimitStates, WhatHasTurnedAtTheEndHasFallen)
{
    const Realization r = paper(1);
    LimitStates limits(r, {}, 0, 1 << 20);
    std::vector<BlockMotion> moved(r.blocks.size());
    moved[0].theta_rad = 0.6; // beyond atan(60 / 100) = 0.540
    moved[2].theta_rad = 1.0; // not beyond atan(150 / 60) = 1.190
    limits.check(r, 64, moved, std::vector<int>(r.blocks.size(), chunk_steps - 1), chunk_steps);
    EXPECT_FALSE(limits.fallen());
    limits.conclude();
    Outcome o;
    limits.write(r.step_s, r.drums, o);
    EXPECT_EQ(o.fallen_blocks, 1);
    EXPECT_EQ(o.first_collapse_block, 0);
    EXPECT_EQ(o.total_collapse_time_s, -1);
}

/// With watched pairs the bound holds for a block that is caught between two others on its long faces.
TEST(StepBoundOfPairs, ABlockCaughtBetweenTwo)
{
    for (const double xi : {0.0, 0.1, 0.5}) {
        Bed bed;
        bed.xi = xi;
        const Realization r = colonnade(paper_colonnade(1), bed, 1);
        const StepBound all = step_bound(r);
        Realization alone = r;
        alone.joints.resize(static_cast<std::size_t>(r.beds()));
        alone.watched = 0;
        EXPECT_LE(all.dt_s, step_bound(alone).dt_s);
        for (int i = 0; i < r.drums; ++i) {
            // the same block between two slabs on its long faces, vibrating by itself: exact step from its matrices
            const Block& block = r.blocks[static_cast<std::size_t>(i)];
            const double face = 2 * std::max(block.half_width_m, block.half_height_m);
            const double thick = 2 * std::min(block.half_width_m, block.half_height_m);
            Realization press;
            press.gravity_m_s2 = 0;
            press.blocks = {{face / 2, 0.01, 1, 1, 0, -0.01, true},
                            {face / 2, thick / 2, block.mass_kg, block.inertia_kg_m2, 0, thick / 2, false},
                            {face / 2, 0.01, 1, 1, 0, thick + 0.01, true}};
            Joint joint = r.joints.back();
            joint.damping_chord_m = face;
            joint.lower = 0;
            joint.upper = 1;
            Joint above = joint;
            above.lower = 1;
            above.upper = 2;
            press.joints = {joint, above};
            EXPECT_LE(all.dt_s, linear_response(press).step_s) << i << ' ' << xi;
        }
    }
}
