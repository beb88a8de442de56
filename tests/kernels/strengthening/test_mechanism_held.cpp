/// What holds of all strengthening: energy that they store, steps that are safe for them, and how they begin.

#include "ensemble/planar/structure/static_state.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "tests/kernels/mechanism_runs.hpp"
#include "tests/kernels/strengthening/strengthened_runs.hpp"

#include <gtest/gtest.h>

#include <string>

using namespace stylobate;
using namespace stylobate::model;

namespace {

struct Held {
    std::string name;
    std::function<void(Realization&)> set;
};

/// Each so strong that it stays elastic. Block 1 lies on bed 0.
std::vector<Held> elastic(double k)
{
    const auto joint = [](Realization& r) -> JointStrengthening& { return r.joints[0].strengthening; };
    return {{"tendon",
             [k](Realization& r) {
                 r.blocks[1].strengthening.tendon_n_m = k;
                 r.blocks[1].strengthening.tendon_prestress_n = r.blocks[1].mass_kg * gravity;
             }},
            {"bearing", [k, joint](Realization& r) { joint(r).bearing_n_m = k; }},
            {"pull_out",
             [k, joint](Realization& r) {
                 joint(r) = {.hold_n = 1e9, .hold_stiffness_n_m = k, .hold_length_m = 10, .hold_spread_m = 0.01};
             }},
            {"clamp", [k](Realization& r) {
                 r.blocks[1].strengthening.clamp_n_m = k;
                 r.blocks[1].strengthening.clamp_strength_n = 1e9;
                 r.blocks[1].strengthening.clamp_height_m = 0.3 * r.blocks[1].half_height_m;
                 r.blocks[1].strengthening.clamp_to = 2;
             }}};
}

/// A block that stands on the ground, and a fixed one beside it, which touches nothing.
Realization beside_another(const Stone& stone, const Bed& bed)
{
    Realization r = stack({stone}, bed, 1);
    r.blocks.push_back(r.blocks[1]);
    r.blocks[2].x_m = 1.5 * stone.width;
    r.blocks[2].column = 1;
    r.blocks[2].fixed = true;
    return r;
}

/// Of runs of several durations: the largest energy that the springs store and what is then called a loss.
struct Losses {
    double stored = 0, lost = 0, residual = 0;
    void add(const Outcome& o)
    {
        stored = std::max(stored, std::fabs(o.energy_spring_j));
        lost = std::max(lost, std::fabs(o.energy_damping_j));
        residual = std::max(residual, std::fabs(o.energy_residual));
    }
};

} // namespace

TEST(MechanismHeld, WhatIsElasticLosesNothingInRocking)
{
    // a block without dashpots is let go from a tilt; the work of what holds it is stored, all of it
    for (const Held& held : elastic(1e4)) {
        if (held.name == "bearing")
            continue; // the next test
        Realization r = beside_another(mono_stone, {1e9, 0, 5});
        held.set(r);
        r.initial_tilt_rad = 0.3 * slenderness(mono_stone);
        r.step_s = 0.2 * step_bound(r).dt_s;
        Losses losses;
        for (const double duration : {0.02, 0.04, 0.06, 0.08, 0.1})
            losses.add(run_one(still(duration), r));
        EXPECT_GT(losses.stored, 0.02) << held.name;
        EXPECT_LT(losses.lost, 0.01 * losses.stored) << held.name;
        EXPECT_LT(losses.residual, 1e-3) << held.name;
    }
}

TEST(MechanismHeld, WhatIsElasticLosesNothingOnItsBed)
{
    // a slab is pushed to the side, up and round for a moment
    const std::vector<Held> ways = {
        {"mortar",
         [](Realization& r) {
             r.joints[0].strengthening.bond_tension_n_m = r.joints[0].strengthening.bond_cohesion_n_m = 1e9;
         }},
        {"bearing", [](Realization& r) { r.joints[0].strengthening = {.bearing_n_m = 1e5, .bearing_per_m = 5}; }}};
    for (const Held& held : ways) {
        const bool bond = held.name == "mortar";
        Realization r = single({0.2, 0.05, 4.0}, {1e6, 0, bond ? 0.5 : 0}, 1, 1);
        held.set(r);
        r.step_s = 0.02 * step_bound(r).dt_s;
        Losses losses;
        for (const double duration : {0.01, 0.02, 0.03, 0.04}) {
            const auto outcome = pushed(
                r, duration,
                [&](int, double time) {
                    return time < 0.002 ? Push{40, bond ? 60.0 : 0, bond ? 600.0 : 0} : Push{};
                },
                [](double, const Snapshot&) { return true; });
            losses.add(*outcome);
        }
        EXPECT_GT(losses.stored, 0.01) << held.name;
        EXPECT_LT(losses.lost, 0.01 * losses.stored) << held.name;
        EXPECT_LT(losses.residual, 1e-3) << held.name;
    }
}

TEST(MechanismHeld, StepsAreSafeWhereItIsStifferThanTheBed)
{
    // of one block the bound takes twice the stiffness or, as the velocity is that of the last step, twice the dashpot:
    // that step is safe, and so is the structure's; one that is longer by more than the root of two, or than two, is
    // not
    std::vector<Held> all = elastic(1e8);
    all.push_back({"dashpot", [](Realization& r) { r.joints[0].strengthening.bearing_n_s_m = 2e4; }});
    for (const Held& held : all) {
        Realization r = beside_another({0.2, 0.05, 4.0}, {1e6, 0, 0});
        held.set(r);
        for (Joint& joint : r.joints)
            joint.mechanisms.face_damping = 1;
        const double lift = held.name == "pull_out" ? 3 * gravity : 0; // so that dowels hold
        const auto range = [&](double step_s) {
            r.step_s = step_s;
            double least = HUGE_VAL, most = -HUGE_VAL;
            const auto push = [&](int, double time) {
                return time > 0 ? Push{0, lift, 0} : Push{0.01, lift + 0.01, 0.01};
            };
            const auto outcome = pushed(r, 1500 * step_s, push, [&](double, const Snapshot& s) {
                const double at = s.x_m[1] + s.y_m[1] + 0.1 * s.theta_rad[1];
                least = std::min(least, at);
                most = std::max(most, at);
                return true;
            });
            return outcome->state == State::invalid ? HUGE_VAL : most - least;
        };
        const StepBound bound = step_bound(r);
        EXPECT_LT(range(0.999 * bound.dt_s), 0.01) << held.name;
        EXPECT_LT(range(0.95 * structure_step_bound(r, bound).dt_s), 0.01) << held.name;
        if (held.name != "tendon" && held.name != "clamp") { // taken as if they held in both directions
            EXPECT_GT(range((held.name == "dashpot" ? 2.5 : 1.6) * bound.dt_s), 0.01) << held.name;
        }
    }
}

TEST(MechanismHeld, EccentricBlocksRestAsTheyDoWithoutIt)
{
    // what was put in at rest without prestress holds nothing there
    for (const Held& held : elastic(1e6)) {
        Realization r = beside_another({0.2, 0.1, 4.0}, {1e7, 0.3, 0.7});
        r.blocks[1].mechanisms.eccentricity_m = 0.01;

        const StaticState without = static_state(r);
        held.set(r);
        r.blocks[1].strengthening.tendon_prestress_n = 0;
        r.step_s = 0.5 * step_bound(r).dt_s;
        double moved = 0;
        pushed(
            r, 0.02, [](int, double) { return Push{}; },
            [&](double, const Snapshot& s) {
                moved = std::max({moved, std::fabs(s.x_m[1] - without.x_m[1]), std::fabs(s.y_m[1] - without.y_m[1]),
                                  0.1 * std::fabs(s.theta_rad[1] - without.theta_rad[1])});
                return true;
            });
        EXPECT_LT(moved, 1e-9) << held.name;
    }
}

TEST(MechanismHeld, ATendonPullsAtTheMiddleOfAnEccentricBlock)
{
    // so does the equation of rest: with a prestress nothing moves either
    Realization r = single({0.2, 0.1, 4.0}, {1e7, 0.3, 0.7}, 1, 2);
    r.blocks[1].mechanisms.eccentricity_m = 0.01;
    r.blocks[1].strengthening.tendon_n_m = 1e5;
    r.blocks[1].strengthening.tendon_prestress_n = 5 * 4 * gravity;
    r.step_s = 0.5 * step_bound(r).dt_s;
    const StaticState rest = static_state(r);
    double moved = 0;
    pushed(
        r, 0.05, [](int, double) { return Push{}; },
        [&](double, const Snapshot& s) {
            moved = std::max({moved, std::fabs(s.x_m[1] - rest.x_m[1]), std::fabs(s.y_m[1] - rest.y_m[1]),
                              0.1 * std::fabs(s.theta_rad[1] - rest.theta_rad[1])});
            return true;
        });
    EXPECT_LT(moved, 1e-9);
}

TEST(MechanismHeld, AFixedBlockThatNothingTouchesChangesNoClamp)
{
    // it is no block of the kernel
    const Study study = harmonic(4, 0.5);
    Bed bed;
    bed.xi = 0.1;
    Realization r = colonnade(paper_colonnade(2), bed, 3e-5);
    r.frequency_hz = 2;
    r.pga_m_s2 = 9;
    std::vector<int> drums;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        if (!r.blocks[i].fixed && r.blocks[i].role == BlockRole::drum)
            drums.push_back(static_cast<int>(i));
    ASSERT_EQ(drums.size(), 4u);
    BlockStrengthening& clamp = r.blocks[static_cast<std::size_t>(drums[1])].strengthening;
    clamp.clamp_to = drums[3];
    clamp.clamp_n_m = 2e4;
    clamp.clamp_strength_n = 50;
    Realization buried = r;
    for (int i = 0; i < 2; ++i) {
        buried.blocks.push_back(r.blocks.front());
        buried.blocks.back().fixed = true;
        buried.blocks.back().y_m -= 1 + i;
    }
    const auto where = [&](const Realization& of) { // of the first blocks, after some chunks
        LaneSet set(study, nullptr, kernels(best_isa()), of);
        set.load(0, of);
        for (int i = 0; i < 200; ++i)
            set.advance();
        Snapshot s = set.snapshot(0);
        s.x_m.resize(r.blocks.size());
        return s.x_m;
    };
    EXPECT_EQ(where(buried), where(r));
    Realization loose = r;
    loose.blocks[static_cast<std::size_t>(drums[1])].strengthening = {};
    EXPECT_NE(where(loose), where(r));
}
