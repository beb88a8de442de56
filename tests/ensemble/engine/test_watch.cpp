/// The criterion of rest on a bundle filled by hand, and what the end of a realization makes of its motion.

#include "ensemble/planar/planar_model.hpp"
#include "ensemble/planar/planar_watch.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"
#include "kernels/isa.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace stylobate {
namespace {

/// A block on a fixed one, in a bundle of one lane.
struct OneBlock {
    TopologyJoint joint{0, 1};
    Topology topology{2, 1, 1, 1, &joint, 0, {}};
    std::vector<double> memory = std::vector<double>(bundle_registers(topology), 0.0);
    Bundle bundle = bind_bundle(topology, 1, memory.data());
    Watch watch;

    /// A check after another chunk, in which so much has slipped.
    bool check(double slipped_m, bool undecided = false)
    {
        watch.steps += chunk_steps;
        bundle.at(OfRealization::slip, 0) += slipped_m;
        return watch_rest(topology, bundle, 0, undecided, watch);
    }
};

/// At rest slips at most 1 mm between two checks, however much it has slipped before.
TEST(WatchRest, SlipIsThatSinceTheLastCheck)
{
    OneBlock one;
    one.watch.step_s = 1e-3;
    one.watch.rest_energy_j = 1;
    one.watch.rest_slip_m = 1e-3;
    one.watch.may_rest = 1;
    one.watch.rest_steps = 3 * chunk_steps;
    one.watch.last_step = 1000 * chunk_steps;
    one.check(0.2); // slides
    EXPECT_EQ(one.watch.quiet, 0U);
    for (int i = 0; i < 3; ++i) { // creeps: 0.9 mm between checks, 2.7 mm in all
        EXPECT_FALSE(one.check(0.9e-3));
        EXPECT_EQ(one.watch.quiet, 1U) << i;
        EXPECT_EQ(one.watch.quiet_since, 2U * chunk_steps) << i;
    }
    EXPECT_FALSE(one.check(1.1e-3)); // and slips once more: rest begins anew
    EXPECT_EQ(one.watch.quiet, 0U);
    EXPECT_FALSE(one.check(0));
    EXPECT_EQ(one.watch.quiet_since, 6U * chunk_steps);
    EXPECT_FALSE(one.check(0));
    EXPECT_FALSE(one.check(0));
    EXPECT_TRUE(one.check(0)) << "three chunks after it began";
}

/// Not during the shaking, not while a block may fall, and not with the energy of the rest or more: m v^2 / 2, with v
/// the increment of a step over its length.
TEST(WatchRest, NeitherShakenNorFallingNorMoving)
{
    OneBlock one;
    one.watch.step_s = 1e-3;
    one.watch.shaking_end_s = 3e-3 * chunk_steps;
    one.watch.rest_energy_j = 0.5;
    one.watch.last_step = 20 * chunk_steps;
    one.bundle.at(OfBlock::x, 1, 0) = 0.02;
    one.check(0);
    one.check(0);
    EXPECT_EQ(one.watch.quiet, 0U);
    one.check(0);
    EXPECT_EQ(one.watch.quiet, 1U);
    one.check(0, true);
    EXPECT_EQ(one.watch.quiet, 0U);
    one.bundle.at(OfRealization::kinetic, 0) = 0.99e-6; // twice the energy times dt^2
    one.check(0);
    EXPECT_EQ(one.watch.quiet, 1U);
    one.bundle.at(OfRealization::kinetic, 0) = 1.01e-6;
    one.check(0);
    EXPECT_EQ(one.watch.quiet, 0U);
    one.bundle.at(OfRealization::kinetic, 0) = 0;
    one.bundle.at(OfBlock::x, 1, 0) = 0.01;
    one.check(0);
    one.bundle.at(OfBlock::x, 1, 0) = 0.04;
    one.check(0);
    EXPECT_EQ(one.watch.quiet_checks, 2U);
    EXPECT_NEAR(one.watch.quiet_top_m, 0.05, 1e-15) << "the sum since rest began";
    for (int i = 0; i < 11; ++i)
        EXPECT_FALSE(one.check(0)) << "it may not end by rest";
    EXPECT_TRUE(one.check(0)) << "out of time";
}

Study study_of(const std::string& structure, const std::string& excitation, const std::string& more = {})
{
    return parse_study("[study]\nkind = \"single\"\n[structure]\ndepth_m = 1\ndensity_kg_m3 = 2700\n" + structure +
                           "\n[excitation]\n" + excitation + "\n" + more,
                       "watched.toml");
}

/// Half a sine of 0.1 Hz shakes for 5 s; a vertical motion of 20 s beside it ends later, one of 2 s does not.
TEST(LaneSet, NothingIsAtRestWhileTheBaseMovesUpAndDown)
{
    const Study study = study_of("blocks = 1\ndrum_width_m = 1\ndrum_height_m = 1", //
                                 "kind = \"half_sine\"\nfrequency_hz = 0.1\npga_m_s2 = 0.01",
                                 "[contact]\nnormal_stiffness_n_m2 = 1e7\nfriction = 0.7\n");
    const Experiment experiment(study);
    Realization r = experiment.sampler().realization(0);
    r.with_mechanisms = true;
    const auto end_s = [&](const Realization& moved) {
        LaneSet set(study, nullptr, kernels(Isa::scalar), moved);
        set.load(0, moved);
        while (!set.done(0))
            set.advance();
        EXPECT_EQ(set.outcome(0)->at_rest, 1);
        return set.outcome(0)->end_time_s;
    };
    // 2 / p of a block of 1 m, seen at whole checks
    const double rest = 2 / std::sqrt(0.75 * 9.81 / std::sqrt(0.5)), checks = 2 * chunk_steps * r.step_s;
    const auto expect_end = [&](double shaken_s) {
        const double end = end_s(r);
        EXPECT_GE(end, shaken_s + rest);
        EXPECT_LE(end, shaken_s + rest + checks);
    };
    expect_end(5);
    r.vertical = std::make_shared<Motion>(motion_of(std::vector<double>(201, 0.0), 0.1)); // 20 s
    expect_end(20);
    r.vertical = std::make_shared<Motion>(motion_of(std::vector<double>(21, 0.0), 0.1));
    expect_end(5);
}

/// Drums of 0.2 m that rock and slide: the state is that of the larger displacement at a drum's edge; of the rocking
/// that is its angles times the width. The thresholds are as good as 0.
TEST(LaneSet, TheLargerOfRockingAndSlidingIsTheState)
{
    const Study study =
        parse_study("[study]\nkind = \"surface\"\nrealizations = 1\n[structure]\nblocks = 3\ndrum_width_m = 0.2\n"
                    "drum_height_m = 0.2\ndepth_m = 1\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m2 = 3e7\n"
                    "friction = 0.3\n[excitation]\nkind = \"half_sine\"\n[surface]\nfrequency_hz = { from = 1, to = 6, "
                    "count = 6 }\npga_m_s2 = { from = 2, to = 8, count = 7 }\n[outcome]\nrocking_threshold_rad = 1e-6\n"
                    "sliding_threshold = 1e-6\n",
                    "both.toml");
    const Experiment experiment(study);
    int rocked = 0, slid = 0, by_the_width = 0;
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization&, const Outcome& o) {
        if (o.state == State::collapsed || o.state == State::invalid || o.max_relative_rotation_rad < 1e-6 ||
            o.total_sliding_m < 0.2e-6)
            return;
        const bool rocks = 0.2 * o.total_rocking_rad >= o.total_sliding_m;
        EXPECT_EQ(o.state, rocks ? State::rocked : State::slid) << o.total_rocking_rad << ' ' << o.total_sliding_m;
        ++(rocks ? rocked : slid);
        by_the_width += !rocks && o.total_rocking_rad >= o.total_sliding_m;
    };
    Observer nobody;
    run_ensemble(experiment, {best_isa(), 1}, plan, nobody);
    EXPECT_GT(rocked, 0);
    EXPECT_GT(slid, 0);
    EXPECT_GT(by_the_width, 0) << "of radians alone the state would be another one";
}

} // namespace
} // namespace stylobate
