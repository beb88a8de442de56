/// The kernel alone, and what the machine could do at the most.

#include "bench/counted.hpp"
#include "studies/workflow/bench/warm_kernel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

using namespace stylobate;

namespace {

/// Rate of multiply-adds on registers, two operations each.
void peak_fma(benchmark::State& state, Isa isa)
{
    constexpr long count = 12'000'000;
    for (auto _ : state)
        benchmark::DoNotOptimize(kernels(isa).peak_fma(count));
    const double flops = 2.0 * count * kernels(isa).lanes;
    state.counters["flops_per_second"] =
        benchmark::Counter(flops, benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1000);
}

/// A bundle as the ensemble runs it: base motion, steps, and the termination check of each realization after every
/// chunk.
/// @param warm chunks before the clock starts
/// @return block-steps of one chunk
double chunks(benchmark::State& state, Isa isa, const Study& study, int warm)
{
    const Sampler sampler(study, nullptr);
    LaneSet lanes(study, nullptr, kernels(isa), sampler.realization(0), study.realizations);
    std::uint64_t next = 0;
    const auto start = [&](int lane) {
        lanes.clear(lane);
        lanes.load(lane, sampler.realization(next++));
    };
    int left = 0; // chunks until all are started again: what is timed must not walk away in time
    for (auto _ : state) {
        if (left-- == 0) {
            state.PauseTiming();
            for (int lane = 0; lane < lanes.lanes(); ++lane)
                start(lane);
            for (int chunk = 0; chunk < warm; ++chunk)
                lanes.advance();
            left = 2000;
            state.ResumeTiming();
        }
        lanes.advance();
        for (int lane = 0; lane < lanes.lanes(); ++lane)
            if (lanes.outcome(lane)) {
                state.PauseTiming();
                start(lane);
                state.ResumeTiming();
            }
    }
    const Realization& r = lanes.realization(0);
    const double block_steps = static_cast<double>(lanes.lanes()) * static_cast<double>(r.free_blocks()) * chunk_steps;
    state.counters["block_steps_per_second"] =
        benchmark::Counter(block_steps, benchmark::Counter::kIsIterationInvariantRate);
    return block_steps;
}

/// The steps alone, without base motion and checks: what of `chunks` is the kernel's.
void kernel(benchmark::State& state, Isa isa, int blocks)
{
    const WarmKernel warm(isa, blocks);
    int left = 50;
    for (auto _ : state) {
        warm.run();
        if (--left == 0) {
            state.PauseTiming();
            warm.restart();
            left = 50;
            state.ResumeTiming();
        }
    }
    const OperationCounts per = operations_per_block_step(blocks);
    using benchmark::Counter;
    state.counters["block_steps_per_second"] = Counter(warm.block_steps(), Counter::kIsIterationInvariantRate);
    state.counters["flops_per_second"] =
        Counter(warm.block_steps() * static_cast<double>(per.flops()), Counter::kIsIterationInvariantRate);
}

void step(benchmark::State& state, Isa isa, int blocks, Precision precision)
{
    Study study = rocking_column(blocks);
    study.run.precision = precision;
    const double block_steps = chunks(state, isa, study, 100);
    if (precision == Precision::single) // whose compensated sums are not in the count
        return;
    const OperationCounts per = operations_per_block_step(blocks);
    using benchmark::Counter;
    state.counters["flops_per_second"] =
        Counter(block_steps * static_cast<double>(per.flops()), Counter::kIsIterationInvariantRate);
    state.counters["flops_per_block_step"] = static_cast<double>(per.flops());
    state.counters["divisions_per_block_step"] = static_cast<double>(per.div + per.sqrt);
}

const bool registered = [] {
    for (const Isa isa : usable_isas()) {
        const std::string name = to_string(isa);
        benchmark::RegisterBenchmark(("BM_PeakFma/" + name).c_str(), peak_fma, isa);
        for (const int blocks : {2, 3, 4, 7, 13, 25, 49}) {
            const std::string tail = "/" + name + "/" + std::to_string(blocks);
            benchmark::RegisterBenchmark(("BM_Kernel" + tail).c_str(), kernel, isa, blocks);
            benchmark::RegisterBenchmark(("BM_Step" + tail).c_str(), step, isa, blocks, Precision::double_);
            benchmark::RegisterBenchmark(("BM_StepSingle" + tail).c_str(), step, isa, blocks, Precision::single);
        }
        const std::string structure = "BM_Structure/" + name + "/";
        const auto add = [&](const char* scene, const Study& study, int warm) {
            benchmark::RegisterBenchmark((structure + scene).c_str(), [isa, study, warm](benchmark::State& state) {
                chunks(state, isa, study, warm);
            });
        };
        add("column", rocking_column(7), 100);
        add("column_two_corner", formed_column(ContactForm::two_corner), 100);
        add("column_points", formed_column(ContactForm::points), 100);
        add("column_watched", watched_column(7), 100);
        add("colonnade_2x1", shaken_colonnade(2, 1, 4), 100);
        add("colonnade_2x2", shaken_colonnade(2, 2, 4), 100);
        add("colonnade_4x4", shaken_colonnade(4, 4, 4), 100);
        add("heap_2x2", shaken_colonnade(2, 2, 12), 600);
        add("heap_4x4", shaken_colonnade(4, 4, 12), 600);
    }
    return true;
}();

} // namespace
