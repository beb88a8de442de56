/// The kernel alone, and what the machine could do at the most.

#include "bench/counted.hpp"
#include "bench/scenes.hpp"
#include "ensemble/lanes.hpp"
#include "kernels/step.hpp"

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

/// What a block costs in one step: the step counted on a bundle of one realization that rocks.
OperationCounts operations_per_block_step(int blocks)
{
    const Study study = rocking_column(blocks);
    const Sampler sampler(study, nullptr);
    std::vector<TopologyJoint> joints;
    for (int i = 1; i < blocks; ++i)
        joints.push_back({i - 1, i});
    Topology topology{blocks, 1, blocks - 1, blocks - 1, joints.data()};
    std::vector<int> bed_lists(static_cast<std::size_t>(bed_lists_size(topology)));
    list_beds(topology, bed_lists.data());
    std::vector<double> memory(bundle_registers(topology), 0.0);
    const Bundle b = bind_bundle(topology, 1, memory.data());
    const Realization r = sampler.realization(0);
    for (int i = 0; i < blocks; ++i) {
        const Block& block = r.blocks[static_cast<std::size_t>(i)];
        b.at(OfBlock::half_width, i, 0) = block.half_width_m;
        b.at(OfBlock::half_height, i, 0) = block.half_height_m;
        b.at(OfBlock::y, i, 0) = -1e-6 * i;
    }
    for (int j = 0; j < blocks - 1; ++j) {
        b.at(OfJoint::height, j, 0) = 0.029;
        b.at(OfJoint::depth_limit, j, 0) = 0.001;
        b.at(OfJoint::K_n, j, 0) = 1e8;
    }
    counted = {};
    Stepper<Counted, Baseline, false, true>(topology, b).run(0, 16);
    const long block_steps = 16L * (blocks - 1);
    return {counted.add / block_steps,  counted.mul / block_steps,  counted.fma / block_steps,
            counted.div / block_steps,  counted.sqrt / block_steps, counted.load / block_steps,
            counted.store / block_steps};
}

/// A bundle as the ensemble runs it: base motion, steps, and the look at each realization after every chunk.
/// @param warm chunks before the clock starts
/// @return block-steps of one chunk
double chunks(benchmark::State& state, Isa isa, const Study& study, int warm)
{
    const Sampler sampler(study, nullptr);
    LaneSet lanes(study, nullptr, kernels(isa), sampler.realization(0));
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
    const auto free = std::count_if(r.blocks.begin(), r.blocks.end(), [](const Block& block) { return !block.fixed; });
    const double block_steps = static_cast<double>(lanes.lanes()) * static_cast<double>(free) * chunk_steps;
    state.counters["block_steps_per_second"] =
        benchmark::Counter(block_steps, benchmark::Counter::kIsIterationInvariantRate);
    return block_steps;
}

/// The steps alone, without base motion and looks: what of `chunks` is the kernel's.
void kernel(benchmark::State& state, Isa isa, int blocks)
{
    static Topology topology;
    static Bundle bundle;
    static const KernelTable* table;
    table = &kernels(isa);
    KernelTable seen = *table;
    seen.run = [](const Topology& t, const Bundle& b, int first, int last) {
        topology = t;
        bundle = b;
        table->run(t, b, first, last);
    };
    const Study study = rocking_column(blocks);
    const Sampler sampler(study, nullptr);
    LaneSet lanes(study, nullptr, seen, sampler.realization(0));
    for (int lane = 0; lane < lanes.lanes(); ++lane)
        lanes.load(lane, sampler.realization(static_cast<std::uint64_t>(lane)));
    for (int chunk = 0; chunk < 100; ++chunk)
        lanes.advance();
    const std::size_t size = bundle_registers(topology) * static_cast<std::size_t>(bundle.lanes);
    const std::vector<double> start(bundle.blocks, bundle.blocks + size);
    int left = 50; // the same chunk of base motion again and again: not for long
    for (auto _ : state) {
        table->run(topology, bundle, 0, chunk_steps);
        if (--left == 0) {
            state.PauseTiming();
            std::copy(start.begin(), start.end(), bundle.blocks);
            left = 50;
            state.ResumeTiming();
        }
    }
    const double block_steps = static_cast<double>(lanes.lanes()) * (blocks - 1) * chunk_steps;
    const OperationCounts per = operations_per_block_step(blocks);
    using benchmark::Counter;
    state.counters["block_steps_per_second"] = Counter(block_steps, Counter::kIsIterationInvariantRate);
    state.counters["flops_per_second"] =
        Counter(block_steps * static_cast<double>(per.flops()), Counter::kIsIterationInvariantRate);
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
        for (const int blocks : {2, 4, 7, 13, 25, 49}) {
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
