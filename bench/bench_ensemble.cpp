/// Whole studies: sampling, stepping, refilling of lanes, everything but the results file.

#include "bench/scenes.hpp"
#include "ensemble/executor.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <thread>

using namespace stylobate;

namespace {

void ensemble(benchmark::State& state, Isa isa, int threads)
{
    const Study study = small_surface(isa == Isa::scalar ? 4 : 32);
    const Sampler sampler(study, nullptr);
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    Progress progress;
    for (auto _ : state)
        progress = run_ensemble(study, sampler, nullptr, {isa, threads}, plan, observer);
    using benchmark::Counter;
    state.counters["realizations_per_second"] =
        Counter(static_cast<double>(plan.total), Counter::kIsIterationInvariantRate);
    state.counters["block_steps_per_second"] =
        Counter(static_cast<double>(progress.block_steps), Counter::kIsIterationInvariantRate);
    state.counters["occupancy"] = progress.occupancy;
    state.counters["collapsed_share"] = static_cast<double>(progress.collapsed) / static_cast<double>(progress.done);
}

const bool registered = [] {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    for (const Isa isa : usable_isas())
        for (int threads = 1; threads <= cores; threads *= 2)
            benchmark::RegisterBenchmark(
                (std::string("BM_Ensemble/") + to_string(isa) + "/" + std::to_string(threads)).c_str(), ensemble, isa,
                threads)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime()
                ->MeasureProcessCPUTime();
    return true;
}();

} // namespace
