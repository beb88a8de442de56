/// Whole studies: sampling, stepping, refilling of lanes, everything but the results file. And measured motion followed
/// in lockstep against one at a time: the same jobs, code and results, by lanes in a register.

#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/tracking.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <benchmark/benchmark.h>

#include <set>
#include <string>
#include <thread>

using namespace stylobate;

namespace {

void ensemble(benchmark::State& state, Isa isa, int threads)
{
    const Study study = small_surface(isa == Isa::scalar ? 4 : 32);
    const Experiment experiment(study);
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    // by the clock on the wall: the processor time of one thread says nothing of several
    Progress progress;
    double seconds = 0;
    std::uint64_t realizations = 0, block_steps = 0;
    for (auto _ : state) {
        progress = run_ensemble(experiment, {isa, threads}, plan, observer);
        seconds += progress.seconds;
        realizations += progress.done;
        block_steps += progress.block_steps;
    }
    state.counters["realizations_per_second"] = static_cast<double>(realizations) / seconds;
    state.counters["block_steps_per_second"] = static_cast<double>(block_steps) / seconds;
    state.counters["occupancy"] = progress.occupancy;
    state.counters["collapsed_share"] = static_cast<double>(progress.collapsed) / static_cast<double>(progress.done);
}

/// README's first command without its files: once.
void main_job(benchmark::State& state, Isa isa, int threads)
{
    const LoadedStudy main_job =
        LoadedStudy::from_file(std::string(STYLOBATE_SOURCE) + "/studies/inputs/small_scale_column.toml", {});
    RunPlan plan;
    plan.total = main_job.study().total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    for (auto _ : state)
        state.counters["seconds"] = run_ensemble(main_job.experiment(), {isa, threads}, plan, observer).seconds;
}

/// Sixty-four parameter sets of the specimen along what one of them did under an earthquake of two seconds, with nine
/// free windows each.
std::vector<TrackingJob> jobs()
{
    Study study = rocking_column(5);
    study.contact.normal_stiffness_n_m2 = 1e7;
    study.contact.tangential_stiffness_n_m = 4.8e5;
    study.excitation.kind = ExcitationKind::noise;
    study.excitation.frequency_hz = 3;
    study.excitation.pga_m_s2 = 5;
    study.excitation.rise_s = 0.2;
    study.excitation.strong_s = 1.5;
    study.excitation.decay_s = 0.2;
    study.perturbations.clear();
    const Sampler sampler(study, nullptr);
    TrackingJob job;
    job.realization = sampler.realization(0);
    auto times = std::make_shared<std::vector<double>>();
    for (int i = 0; i <= 1000; ++i)
        times->push_back(0.002 * i);
    job.watched_s = times;
    Observer observer;
    const Readings seen = track({job}, {best_isa(), 1}, observer).results.front().watched;
    auto targets = std::make_shared<Targets>();
    targets->spacing_s = 0.002;
    targets->blocks = job.realization.blocks.size();
    targets->x_m = seen.x_m;
    targets->theta_rad = seen.theta_rad;
    targets->velocity_m_s.assign(seen.x_m.size(), 0.0);
    targets->rotation_rad_s.assign(seen.x_m.size(), 0.0);
    for (std::size_t k = targets->blocks; k + targets->blocks < seen.x_m.size(); ++k) {
        targets->velocity_m_s[k] = (seen.x_m[k + targets->blocks] - seen.x_m[k - targets->blocks]) / 0.004;
        targets->rotation_rad_s[k] =
            (seen.theta_rad[k + targets->blocks] - seen.theta_rad[k - targets->blocks]) / 0.004;
    }
    auto windows = std::make_shared<std::vector<FreeWindow>>();
    for (int i = 0; i < 9; ++i)
        windows->push_back({0.1 + 0.2 * i, {0.2 + 0.2 * i, 0.3 + 0.2 * i}});
    job.watched_s = nullptr;
    job.targets = targets;
    job.windows = windows;
    job.nudge_rad_s = 60;
    std::vector<TrackingJob> all(64, job);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (Joint& joint : all[i].realization.joints)
            joint.friction *= 0.7 + 0.01 * static_cast<double>(i);
    return all;
}

void following(benchmark::State& state, Isa isa)
{
    const std::vector<TrackingJob> all = jobs();
    Observer observer;
    TrackingReport report;
    double seconds = 0, block_steps = 0;
    for (auto _ : state) {
        report = track(all, {isa, 1}, observer);
        seconds += report.seconds;
        block_steps += static_cast<double>(report.block_steps);
    }
    state.counters["block_steps_per_second"] = block_steps / seconds;
    state.counters["occupancy"] = report.occupancy;
}

/// The ratio in one run: both take turns, so that what else the machine does hits them alike.
void following_ratio(benchmark::State& state)
{
    const std::vector<TrackingJob> all = jobs();
    Observer observer;
    double alone = 0, lockstep = 0;
    for (auto _ : state) {
        lockstep += track(all, {best_isa(), 1}, observer).seconds;
        alone += track(all, {Isa::scalar, 1}, observer).seconds;
    }
    state.counters["speedup"] = alone / lockstep;
    state.counters["lanes"] = kernels(best_isa()).lanes;
}

const bool registered = [] {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    benchmark::RegisterBenchmark((std::string("BM_MainJob/") + to_string(best_isa())).c_str(), main_job, best_isa(),
                                 cores)
        ->Unit(benchmark::kSecond)
        ->Iterations(1)
        ->Repetitions(1);
    std::set<int> counts = {cores};
    for (int threads = 1; threads < cores; threads *= 2)
        counts.insert(threads);
    for (const Isa isa : usable_isas())
        for (const int threads : counts)
            benchmark::RegisterBenchmark(
                (std::string("BM_Ensemble/") + to_string(isa) + "/" + std::to_string(threads)).c_str(), ensemble, isa,
                threads)
                ->Unit(benchmark::kMillisecond);
    for (const Isa isa : usable_isas())
        benchmark::RegisterBenchmark((std::string("BM_Following/") + to_string(isa)).c_str(), following, isa)
            ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("BM_FollowingLockstepOverOneAtATime", following_ratio)->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace
