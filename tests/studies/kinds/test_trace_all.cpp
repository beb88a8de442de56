/// Realizations that are followed several at once have the trajectories and outcomes that each has alone.

#include "ensemble/planar/hand_over.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace stylobate {
namespace {

/// Step by step in one lane: the position at every step, and between two steps on the straight line. One that is handed
/// over goes on in another set.
std::vector<double> positions_alone(const Study& study, const Realization& r, Outcome& outcome)
{
    std::vector<double> x_m;
    const double rate_hz = study.output.trajectory_rate_hz;
    std::size_t samples = 0;
    const auto to_end = [&](LaneSet& lane) {
        const double step_s = lane.realization(0).step_s;
        std::uint64_t n = lane.steps(0);
        for (int k = 0; !lane.done(0); k = (k + 1) % chunk_steps, ++n) {
            const Snapshot before = lane.snapshot(0);
            lane.advance(k, k + 1);
            const Snapshot after = lane.snapshot(0);
            for (; static_cast<double>(samples) / rate_hz <= static_cast<double>(n + 1) * step_s; ++samples) {
                const double share = static_cast<double>(samples) / rate_hz / step_s - static_cast<double>(n);
                for (std::size_t i = 0; i < static_cast<std::size_t>(r.drums); ++i)
                    x_m.push_back(before.x_m[i] + share * (after.x_m[i] - before.x_m[i]));
            }
        }
    };
    LaneSet lane(study, nullptr, kernels(Isa::scalar), r);
    lane.load(0, r);
    to_end(lane);
    if (const auto& handed = lane.handed(0)) {
        LaneSet taker(study, nullptr, kernels(Isa::scalar), compliant_form(handed->realization));
        take_over(taker, 0, *handed);
        to_end(taker);
        outcome = *taker.outcome(0);
    } else {
        outcome = *lane.outcome(0);
    }
    return x_m;
}

void expect_as_alone(Study study, std::uint64_t realizations)
{
    study.realizations = realizations;
    study.output.trajectory_rate_hz = 97; // at no whole number of steps
    const Experiment experiment(study);
    std::vector<std::vector<double>> x_m;
    std::vector<Outcome> outcomes(realizations);
    for (std::uint64_t i = 0; i < realizations; ++i)
        x_m.push_back(positions_alone(study, experiment.sampler().realization(i), outcomes[i]));
    const std::uint64_t recorded = realizations - 2;
    for (const Isa isa : usable_isas())
        for (const int threads : {1, 3}) {
            TracePlan plan;
            plan.indices.resize(realizations);
            std::iota(plan.indices.begin(), plan.indices.end(), 0);
            plan.recorded = recorded;
            std::uint64_t next = 0;
            plan.sink = [&](const TracedRealization& f) {
                const std::uint64_t i = next++;
                ASSERT_EQ(f.realization.index, i);
                EXPECT_EQ(f.outcome.steps, outcomes[i].steps);
                EXPECT_EQ(f.outcome.state, outcomes[i].state);
                EXPECT_EQ(f.outcome.energy_residual, outcomes[i].energy_residual);
                EXPECT_EQ(f.outcome.sliding_path_m, outcomes[i].sliding_path_m);
                if (i < recorded)
                    EXPECT_EQ(f.trajectory["x_m"], x_m[i]);
                else
                    EXPECT_TRUE(f.trajectory.channels.empty());
            };
            EXPECT_TRUE(trace_all(experiment, {isa, threads}, plan));
            EXPECT_EQ(next, realizations) << to_string(isa) << ", " << threads << " threads";
        }
}

/// Two cycles, after which some are still standing.
Study shaken(Study study, double pga_m_s2)
{
    study.excitation.cycles = 2;
    study.excitation.frequency_hz = 2;
    study.excitation.pga_m_s2 = pga_m_s2;
    return study;
}

TEST(FollowAll, ARealizationIsTheSameAmongOthers)
{
    expect_as_alone(shaken(rocking_column(4), 5), 19);
}

TEST(FollowAll, WithTwoRegistersAtATime)
{
    expect_as_alone(shaken(rocking_column(2), 8), 37);
}

TEST(FollowAll, WithWatchedPairs)
{
    expect_as_alone(shaken(watched_column(4), 9), 11);
}

TEST(FollowAll, InSinglePrecision)
{
    Study study = shaken(rocking_column(4), 5);
    study.run.precision = Precision::single;
    expect_as_alone(study, 11);
}

/// Rigid blocks that fall and are followed to rest.
Study handed_over()
{
    Study study = shaken(formed_column(ContactForm::rigid), 20);
    study.contact.normal_stiffness_n_m2 = study.contact.tangential_stiffness_n_m = 0;
    study.outcome.follow = Follow::rest;
    study.excitation.frequency_hz = 1;
    return study;
}

TEST(FollowAll, WhatIsHandedOver)
{
    expect_as_alone(handed_over(), 5);
}

TEST(FollowAll, WhatIsHandedOverCanBeStopped)
{
    const Experiment experiment(handed_over());
    const Realization r = experiment.sampler().realization(0);
    LaneSet rigid(experiment.study(), nullptr, kernels(Isa::scalar), r);
    rigid.load(0, r);
    while (!rigid.done(0))
        rigid.advance();
    ASSERT_TRUE(rigid.handed(0));
    std::uint64_t asked = 0;
    const TracedRealization whole = trace(experiment, 0, Isa::scalar, [&] { return ++asked > 0; });
    EXPECT_GT(1024 * asked, whole.outcome.steps);
    const std::uint64_t of_rigid = rigid.steps(0) / 1024 + 1;
    ASSERT_GT(asked, of_rigid + 1);
    asked = 0;
    EXPECT_THROW(trace(experiment, 0, Isa::scalar, [&] { return ++asked <= of_rigid + 1; }), TraceStopped);
    TracePlan plan;
    plan.indices = {0};
    plan.sink = [](const TracedRealization&) { ADD_FAILURE() << "it had not ended"; };
    asked = 0;
    plan.stop = [&](double, const SimulatedTime&) { return ++asked > rigid.steps(0) / chunk_steps + 1; };
    EXPECT_FALSE(trace_all(experiment, {Isa::scalar, 1}, plan));
}

TEST(FollowAll, StopsAndDeliversWhatHasEnded)
{
    Study study = shaken(rocking_column(3), 5);
    study.realizations = 40;
    const Experiment experiment(study);
    TracePlan plan;
    plan.indices.resize(study.realizations);
    std::iota(plan.indices.begin(), plan.indices.end(), 0);
    std::uint64_t ended = 0, last = 0;
    plan.sink = [&](const TracedRealization& f) {
        EXPECT_TRUE(ended == 0 || f.realization.index > last);
        last = f.realization.index;
        ++ended;
    };
    plan.stop = [&](double occupancy, const SimulatedTime&) {
        EXPECT_GE(occupancy, 0);
        EXPECT_LE(occupancy, 1);
        return ended >= 5;
    };
    EXPECT_FALSE(trace_all(experiment, {Isa::scalar, 1}, plan));
    EXPECT_GE(ended, 5u);
    EXPECT_LT(ended, 40u);
}

} // namespace
} // namespace stylobate
