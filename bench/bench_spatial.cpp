/// The spatial step alone, with what the machine could do at the most in `BM_PeakFma`.

#include "bench/counted.hpp"
#include "bench/spatial_column.hpp"
#include "ensemble/numerics/aligned.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

using namespace stylobate;

namespace {

void kernel(benchmark::State& state, Isa isa, spatial::BedKind kind)
{
    const spatial::Column column(kind);
    const int lanes = kernels(isa).lanes;
    const std::size_t size = spatial::bundle_registers(column.topology()) * static_cast<std::size_t>(lanes);
    const AlignedArray<double> memory = aligned_array<double>(size);
    const spatial::Bundle bundle = spatial::bind_bundle(column.topology(), lanes, memory.get());
    int left = 0; // chunks until it starts again: it must not walk away in time
    for (auto _ : state) {
        if (left-- == 0) {
            state.PauseTiming();
            std::fill_n(memory.get(), size, 0.0);
            for (int lane = 0; lane < lanes; ++lane)
                column.load(bundle, lane);
            left = 50;
            state.ResumeTiming();
        }
        kernels(isa).spatial.run(column.topology(), bundle, 0, chunk_steps);
    }
    const OperationCounts per = operations_per_spatial_step(kind);
    const double body_steps = static_cast<double>(lanes) * spatial::Column::drums * chunk_steps;
    using benchmark::Counter;
    state.counters["block_steps_per_second"] = Counter(body_steps, Counter::kIsIterationInvariantRate);
    state.counters["flops_per_second"] =
        Counter(body_steps * static_cast<double>(per.flops()), Counter::kIsIterationInvariantRate);
    state.counters["flops_per_block_step"] = static_cast<double>(per.flops());
    state.counters["divisions_per_block_step"] = static_cast<double>(per.div + per.sqrt);
}

const bool registered = [] {
    const std::pair<const char*, spatial::BedKind> beds[] = {{"disc", spatial::BedKind::disc},
                                                             {"rectangle", spatial::BedKind::rectangle},
                                                             {"round", spatial::BedKind::round}};
    for (const Isa isa : usable_isas())
        for (const auto& [name, kind] : beds)
            benchmark::RegisterBenchmark(("BM_Spatial/" + std::string(to_string(isa)) + "/" + name).c_str(), kernel,
                                         isa, kind);
    return true;
}();

} // namespace
