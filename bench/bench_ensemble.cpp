/// Whole studies: sampling, stepping, refilling of lanes, everything but the results file.

#include "bench/scenes.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <benchmark/benchmark.h>

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

/// README's first command without its files: once, on two threads.
void main_job(benchmark::State& state, Isa isa)
{
    const LoadedStudy main_job =
        LoadedStudy::from_file(std::string(STYLOBATE_SOURCE) + "/studies/inputs/small_scale_column.toml", {});
    RunPlan plan;
    plan.total = main_job.study().total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    for (auto _ : state)
        state.counters["seconds"] = run_ensemble(main_job.experiment(), {isa, 2}, plan, observer).seconds;
}

const bool registered = [] {
    benchmark::RegisterBenchmark((std::string("BM_MainJob/") + to_string(best_isa())).c_str(), main_job, best_isa())
        ->Unit(benchmark::kSecond)
        ->Iterations(1)
        ->Repetitions(1);
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    for (const Isa isa : usable_isas())
        for (int threads = 1; threads <= cores; threads *= 2)
            benchmark::RegisterBenchmark(
                (std::string("BM_Ensemble/") + to_string(isa) + "/" + std::to_string(threads)).c_str(), ensemble, isa,
                threads)
                ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace
