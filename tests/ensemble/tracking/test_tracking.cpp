/// The model along measured motion: free windows continue as the observer would have, bit by bit; the nudging is the
/// oscillator of its documentation; and neighbours have no effect.

#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/tracking/tracked_lanes.hpp"
#include "ensemble/tracking/tracking.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

using namespace stylobate;

namespace {

constexpr double unseen = std::numeric_limits<double>::quiet_NaN();

/// Three small drums on a fixed one under noise that rocks them.
Study noise_study(double pga_m_s2 = 5)
{
    Study study;
    study.realizations = 1000;
    study.structure = equal_column(4, 1, 0.048, 0.029, 0.048, 0.1355);
    study.contact.normal_stiffness_n_m2 = 1e7;
    study.contact.tangential_stiffness_n_m = 4.8e5;
    study.contact.friction = 0.68;
    study.excitation.kind = ExcitationKind::noise;
    study.excitation.frequency_hz = 3;
    study.excitation.pga_m_s2 = pga_m_s2;
    study.excitation.rise_s = 0.2;
    study.excitation.strong_s = 1.2;
    study.excitation.decay_s = 0.2;
    Perturbation friction;
    friction.per = Per::joint;
    friction.cov = 0.1;
    study.perturbations = {friction};
    return study;
}

/// No motion at all, over two seconds.
std::shared_ptr<const Motion> still()
{
    auto motion = std::make_shared<Motion>();
    motion->dt_s = 0.01;
    for (auto* v : {&motion->acceleration_m_s2, &motion->velocity_m_s, &motion->displacement_m})
        v->assign(201, 0.0);
    return motion;
}

std::shared_ptr<const std::vector<FreeWindow>> windows_every(double spacing_s, int count, double length_s)
{
    auto windows = std::make_shared<std::vector<FreeWindow>>();
    for (int i = 1; i <= count; ++i)
        windows->push_back({spacing_s * i, {spacing_s * i + length_s / 2, spacing_s * i + length_s}});
    return windows;
}

std::shared_ptr<const std::vector<double>> times(double from, double to, double spacing)
{
    auto t = std::make_shared<std::vector<double>>();
    for (int i = 0; from + i * spacing <= to; ++i)
        t->push_back(from + i * spacing);
    return t;
}

/// Targets along what a model did, with central differences for the velocities.
std::shared_ptr<Targets> targets_of(const Readings& seen, const std::vector<double>& t, std::size_t blocks)
{
    auto targets = std::make_shared<Targets>();
    targets->start_s = t.front();
    targets->spacing_s = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    targets->blocks = blocks;
    targets->x_m = seen.x_m;
    targets->theta_rad = seen.theta_rad;
    const auto slope = [&](const std::vector<double>& q) {
        std::vector<double> v(q.size(), 0.0);
        for (std::size_t i = blocks; i + blocks < q.size(); ++i)
            v[i] = (q[i + blocks] - q[i - blocks]) / (2 * targets->spacing_s);
        return v;
    };
    targets->velocity_m_s = slope(seen.x_m);
    targets->rotation_rad_s = slope(seen.theta_rad);
    return targets;
}

using Bits = std::vector<std::uint64_t>;

void add_bits(const Readings& readings, Bits& bits)
{
    for (const auto* v : {&readings.x_m, &readings.y_m, &readings.theta_rad})
        for (const double value : *v)
            bits.push_back(std::bit_cast<std::uint64_t>(value));
}

Bits bits_of(const TrackingResult& result)
{
    Bits bits;
    for (const Readings& window : result.windows)
        add_bits(window, bits);
    add_bits(result.watched, bits);
    return bits;
}

std::vector<TrackingResult> run(const std::vector<TrackingJob>& jobs, const RunOptions& options = {best_isa(), 1})
{
    Observer observer;
    const TrackingReport report = track(jobs, options, observer);
    EXPECT_TRUE(report.complete);
    return report.results;
}

TrackingJob alone(const Study& study, std::uint64_t index)
{
    TrackingJob job;
    job.realization = Sampler(study, nullptr).realization(index);
    return job;
}

/// Jobs of different steps, targets and lengths; each is nudged towards what another realization did.
std::vector<TrackingJob> mixed_jobs(int count)
{
    const Study study = noise_study();
    const Sampler sampler(study, nullptr);
    const auto seen_at = times(0, 1.8, 0.002);
    std::vector<TrackingJob> jobs;
    TrackingJob truth = alone(study, 0);
    truth.watched_s = seen_at;
    const std::shared_ptr<Targets> targets =
        targets_of(run({truth}).front().watched, *seen_at, truth.realization.blocks.size());
    for (int i = 0; i < count; ++i) {
        TrackingJob job = alone(study, 0);
        for (Joint& joint : job.realization.joints) {
            joint.friction *= 1 + 0.05 * i;
            joint.normal_stiffness_n_m2 *= 1 + 0.3 * i;
        }
        job.realization.step_s /= 1 + 0.2 * i;
        job.targets = targets;
        job.nudge_rad_s = 60;
        job.windows = windows_every(0.15 + 0.02 * (i % 3), 9, 0.2);
        jobs.push_back(job);
    }
    return jobs;
}

class StopAtOnce : public Observer {
public:
    bool stop_requested() override { return true; }
};

} // namespace

TEST(Tracking, AFreeWindowIsTheContinuedRunBitByBit)
{
    TrackingJob job = alone(noise_study(7), 3);
    job.windows = windows_every(0.31, 5, 0.2);
    auto watched = std::make_shared<std::vector<double>>();
    for (const FreeWindow& window : *job.windows)
        watched->insert(watched->end(), window.times_s.begin(), window.times_s.end());
    job.watched_s = watched;
    const TrackingResult result = run({job}).front();
    Bits together;
    Readings joined;
    for (const Readings& window : result.windows) {
        joined.x_m.insert(joined.x_m.end(), window.x_m.begin(), window.x_m.end());
        joined.y_m.insert(joined.y_m.end(), window.y_m.begin(), window.y_m.end());
        joined.theta_rad.insert(joined.theta_rad.end(), window.theta_rad.begin(), window.theta_rad.end());
    }
    Bits want;
    add_bits(joined, together);
    add_bits(result.watched, want);
    EXPECT_EQ(together, want);
    double largest = 0;
    for (const double theta : joined.theta_rad)
        largest = std::max(largest, std::fabs(theta));
    EXPECT_GT(largest, 0.01) << "nothing rocks: the test says nothing";
}

TEST(Tracking, WithoutPullItIsTheModelAsTheEnsembleRunsIt)
{
    const Study study = noise_study();
    TrackingJob job = alone(study, 1);
    const double dt = job.realization.step_s;
    constexpr int apart = 7; // steps: in the middle of what `follow` does at a time, and at its ends
    job.watched_s = times(apart * dt, 150 * chunk_steps * dt, apart * dt);
    const TrackingResult result = run({job}).front();
    LaneSet lanes(study, nullptr, kernels(Isa::scalar), job.realization);
    lanes.load(0, job.realization);
    const std::size_t blocks = job.realization.blocks.size();
    int steps = 0;
    for (std::size_t k = 0; k < job.watched_s->size(); ++k) {
        for (int i = 0; i < apart; ++i, ++steps)
            lanes.advance(steps % chunk_steps, steps % chunk_steps + 1);
        const Snapshot s = lanes.snapshot(0);
        for (std::size_t i = 0; i < blocks; ++i) {
            EXPECT_NEAR(result.watched.x_m[k * blocks + i], s.x_m[i] - job.realization.blocks[i].x_m, 1e-12);
            EXPECT_NEAR(result.watched.theta_rad[k * blocks + i], s.theta_rad[i], 1e-12);
        }
    }
}

/// What is read of the steps of one run of the kernel is what one run for each of them shows.
TEST(Tracking, EveryStepOfARunCanBeReadAfterwards)
{
    const Study study = noise_study();
    Realization r = Sampler(study, nullptr).realization(1);
    r.with_mechanisms = true;
    r.base.pitch_rad_s2_m = 1e-3;
    r.blocks[2].mechanisms.eccentricity_m = 2e-3;
    TrackedLanes together(study, nullptr, kernels(best_isa()), r), one_by_one(study, nullptr, kernels(best_isa()), r);
    for (TrackedLanes* lanes : {&together, &one_by_one})
        lanes->load(1, r, 0);
    const auto bits = [&](const TrackedLanes& lanes, int phase) {
        Bits out;
        for (int block = 0; block < static_cast<int>(r.blocks.size()); ++block)
            for (const BlockMotion& m :
                 {lanes.moved(1, block, phase), lanes.moved(1, block, phase, 0.3), lanes.increment(1, block, phase)})
                for (const double value : {m.x_m, m.y_m, m.theta_rad})
                    out.push_back(std::bit_cast<std::uint64_t>(value));
        return out;
    };
    for (int chunk = 0; chunk < 40; ++chunk) // until the drums rock
        for (const auto& [first, last] : {std::pair{0, 16}, {16, 17}, {17, 60}, {60, chunk_steps}}) {
            together.step(first, last);
            for (int step = first; step < last; ++step) {
                one_by_one.step(step, step + 1);
                ASSERT_EQ(bits(together, step + 1), bits(one_by_one, step + 1)) << chunk << ", " << step;
            }
        }
    EXPECT_GT(std::fabs(one_by_one.moved(1, 3, chunk_steps).theta_rad), 1e-3) << "nothing rocks: the test says nothing";
}

/// Each job by itself or among the others, in any lane: the same bits.
void expect_same_everywhere(const std::vector<TrackingJob>& jobs)
{
    std::vector<Bits> want;
    for (const TrackingJob& job : jobs)
        want.push_back(bits_of(run({job}, {Isa::scalar, 1}).front())); // each by itself
    for (const Isa isa : usable_isas())
        for (const int threads : {1, 3}) {
            const std::vector<TrackingResult> got = run(jobs, {isa, threads});
            for (std::size_t i = 0; i < jobs.size(); ++i)
                EXPECT_EQ(bits_of(got[i]), want[i]) << "job " << i << ", " << to_string(isa) << ", " << threads;
        }
    const std::vector<TrackingResult> reversed = run({jobs.rbegin(), jobs.rend()});
    for (std::size_t i = 0; i < jobs.size(); ++i)
        EXPECT_EQ(bits_of(reversed[jobs.size() - 1 - i]), want[i]) << "job " << i;
}

TEST(Tracking, LaneNeighboursInstructionSetAndThreadsDoNotMatter)
{
    expect_same_everywhere(mixed_jobs(11));
}

TEST(Tracking, NorDoTheyOnATableThatPitches)
{
    std::vector<TrackingJob> jobs = mixed_jobs(11);
    for (std::size_t i = 0; i < jobs.size(); i += 2)
        jobs[i].realization.base.pitch_rad_s2_m = 1e-3;
    expect_same_everywhere(jobs);
}

TEST(Tracking, ThePullIsADampedOscillator)
{
    // One block without friction on a table at rest, 1 mm beside its target: x'' = w2 (1 mm - x) - 1.4 w x'.
    Study study = noise_study();
    study.structure = equal_column(2, 1, 0.048, 0.029, 0.048, 0.1355);
    study.perturbations.clear();
    TrackingJob job = alone(study, 0);
    job.realization.motion = still();
    job.realization.joints.front().friction = 0;
    auto targets = std::make_shared<Targets>();
    targets->spacing_s = 0.1;
    targets->blocks = 2;
    const std::size_t values = 2 * 11;
    targets->x_m.assign(values, 1e-3);
    for (auto* v : {&targets->theta_rad, &targets->velocity_m_s, &targets->rotation_rad_s})
        v->assign(values, 0.0);
    job.targets = targets;
    job.nudge_rad_s = 20;
    job.watched_s = times(0.01, 0.4, 0.01);
    const TrackingResult result = run({job}).front();
    const double w = 20, z = 0.7, wd = w * std::sqrt(1 - z * z);
    for (std::size_t k = 0; k < job.watched_s->size(); ++k) {
        const double t = (*job.watched_s)[k];
        const double x = 1e-3 * (1 - std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t)));
        // held over 8 steps of .3 ms
        EXPECT_NEAR(result.watched.x_m[2 * k + 1], x, 0.02e-3) << t;
        EXPECT_EQ(result.watched.x_m[2 * k], 0) << "the fixed block";
    }
}

TEST(Tracking, ReadsAlongTheLaboratoryWhereTheBaseTurns)
{
    // pushed so slowly that nothing rocks: the blocks turn and shift with the base, phi = k U'' about its middle
    Study study = noise_study(0.5);
    study.contact.normal_stiffness_n_m2 = 1e9;
    study.contact.tangential_stiffness_n_m = 4.8e7;
    TrackingJob job = alone(study, 0);
    auto motion = std::make_shared<Motion>();
    motion->dt_s = 0.005;
    const auto acceleration = [](double t) { return 0.25 * (1 - std::cos(2 * std::numbers::pi * t)); };
    for (int i = 0; i <= 200; ++i)
        motion->acceleration_m_s2.push_back(acceleration(0.005 * i));
    motion->velocity_m_s.assign(201, 0.0);
    motion->displacement_m.assign(201, 0.0);
    job.realization.motion = motion;
    job.realization.base.pitch_rad_s2_m = 0.01;
    job.watched_s = times(0.1, 0.9, 0.013);
    const TrackingResult result = run({job}).front();
    for (std::size_t k = 0; k < job.watched_s->size(); ++k) {
        const double phi = 0.01 * acceleration((*job.watched_s)[k]); // up to 5 mrad
        for (std::size_t b = 1; b < 4; ++b) {
            EXPECT_NEAR(result.watched.theta_rad[4 * k + b], phi, 5e-5);
            EXPECT_NEAR(result.watched.x_m[4 * k + b], -phi * job.realization.blocks[b].y_m, 5e-6);
        }
    }
}

TEST(Tracking, HowOftenThePullIsSetMakesNoDifference)
{
    std::vector<TrackingJob> often = mixed_jobs(2), seldom = often;
    for (TrackingJob* job : {&often[0], &often[1]}) {
        job->nudge_steps = 1;
        job->watched_s = times(0.1, 1.5, 0.05);
    }
    for (TrackingJob* job : {&seldom[0], &seldom[1]})
        job->watched_s = times(0.1, 1.5, 0.05);
    const std::vector<TrackingResult> a = run(often), b = run(seldom);
    for (std::size_t j = 0; j < a.size(); ++j) {
        double x = 0, theta = 0;
        for (std::size_t k = 0; k < a[j].watched.x_m.size(); ++k) {
            x = std::max(x, std::fabs(a[j].watched.x_m[k] - b[j].watched.x_m[k]));
            theta = std::max(theta, std::fabs(a[j].watched.theta_rad[k] - b[j].watched.theta_rad[k]));
        }
        EXPECT_LT(x, 1e-4) << "job " << j;     // twice the noise of a camera
        EXPECT_LT(theta, 2e-3) << "job " << j; //
    }
}

TEST(Tracking, TheObserverTracksWhatAFreeRunLoses)
{
    // the truth, and a model of another friction and half the stiffness that is nudged along it
    const Study study = noise_study(6);
    const auto seen_at = times(0, 1.8, 0.002);
    TrackingJob truth = alone(study, 2);
    truth.watched_s = seen_at;
    const Readings seen = run({truth}).front().watched;
    const std::size_t blocks = truth.realization.blocks.size();
    TrackingJob loose = truth;
    for (Joint& joint : loose.realization.joints) {
        joint.friction *= 0.9;
        joint.normal_stiffness_n_m2 *= 0.5;
    }
    TrackingJob nudged = loose;
    nudged.targets = targets_of(seen, *seen_at, blocks);
    nudged.nudge_rad_s = 60;
    const std::vector<TrackingResult> results = run({loose, nudged});
    const auto apart = [&](const Readings& r) {
        double sum = 0;
        for (std::size_t k = 0; k < seen.x_m.size(); ++k)
            sum += (r.x_m[k] - seen.x_m[k]) * (r.x_m[k] - seen.x_m[k]);
        return std::sqrt(sum / static_cast<double>(seen.x_m.size()));
    };
    const double free_apart = apart(results[0].watched), nudged_apart = apart(results[1].watched);
    EXPECT_LT(nudged_apart, 0.5e-3);
    EXPECT_GT(free_apart, 4 * nudged_apart);
}

TEST(Tracking, NothingPullsWhereNothingWasSeen)
{
    std::vector<TrackingJob> jobs = mixed_jobs(1);
    TrackingJob blind = jobs.front(), none = jobs.front();
    auto gone = std::make_shared<Targets>(*jobs.front().targets);
    std::fill(gone->x_m.begin(), gone->x_m.end(), unseen);
    std::fill(gone->theta_rad.begin(), gone->theta_rad.end(), unseen);
    blind.targets = gone;
    none.targets = nullptr;
    // a gap after .5 s, and the same targets cut off there
    TrackingJob gap = jobs.front(), cut = jobs.front();
    auto gap_targets = std::make_shared<Targets>(*jobs.front().targets);
    auto cut_targets = std::make_shared<Targets>(*jobs.front().targets);
    const std::size_t from = 250 * gap_targets->blocks;
    std::fill(gap_targets->x_m.begin() + static_cast<long>(from), gap_targets->x_m.end(), unseen);
    std::fill(gap_targets->theta_rad.begin() + static_cast<long>(from), gap_targets->theta_rad.end(), unseen);
    for (auto* v :
         {&cut_targets->x_m, &cut_targets->theta_rad, &cut_targets->velocity_m_s, &cut_targets->rotation_rad_s})
        v->resize(from);
    gap.targets = gap_targets;
    cut.targets = cut_targets;
    const std::vector<TrackingResult> r = run({blind, none, gap, cut, jobs.front()});
    EXPECT_EQ(bits_of(r[0]), bits_of(r[1]));
    EXPECT_EQ(bits_of(r[2]), bits_of(r[3]));
    EXPECT_NE(bits_of(r[2]), bits_of(r[4]));
}

TEST(Tracking, WhatIsNoLongerFiniteIsNaNAndHurtsNobody)
{
    std::vector<TrackingJob> jobs = mixed_jobs(9);
    std::vector<Bits> want;
    for (const TrackingResult& result : run(jobs))
        want.push_back(bits_of(result));
    jobs[4].realization.joints.front().friction = unseen;
    const std::vector<TrackingResult> got = run(jobs);
    for (std::size_t i = 0; i < jobs.size(); ++i)
        if (i != 4) {
            EXPECT_EQ(bits_of(got[i]), want[i]) << "job " << i;
        }
    EXPECT_TRUE(std::isnan(got[4].windows.back().x_m.back()));
}

TEST(Tracking, AStoppedRunSaysSo)
{
    StopAtOnce observer;
    EXPECT_FALSE(track(mixed_jobs(12), {Isa::scalar, 2}, observer).complete);
}

TEST(Tracking, CountsWhatItDid)
{
    const std::vector<TrackingJob> jobs = mixed_jobs(3);
    Observer observer;
    const TrackingReport report = track(jobs, {best_isa(), 1}, observer);
    EXPECT_EQ(report.windows, 3U * 9U);
    double block_steps = 0; // of three free blocks: the observer up to its last window, and .2 s for each window
    for (const TrackingJob& job : jobs)
        block_steps += 3 * (job.windows->back().start_s + 9 * 0.2) / job.realization.step_s;
    EXPECT_NEAR(static_cast<double>(report.block_steps), block_steps, 0.01 * block_steps);
    EXPECT_GT(report.occupancy, 0);
    EXPECT_LE(report.occupancy, 1);
}
