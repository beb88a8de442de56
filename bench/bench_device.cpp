/// GPUs: whole studies as `BM_Ensemble` runs them on the processor, by number of slots, and what the device could do at
/// the most. Where there is no device, one line says so.

#include "bench/counted.hpp"
#include "bench/scenes.hpp"
#include "ensemble/engine/executor.hpp"
#include "ensemble/engine/slot_tasks.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

using namespace stylobate;

namespace {

/// A surface on all devices, many realizations for each slot. slots = 0: as many as the device likes.
void on_devices(benchmark::State& state, int slots)
{
    const Study study = small_surface(20'000);
    const Experiment experiment(study);
    RunOptions options{best_isa(), static_cast<int>(std::thread::hardware_concurrency())};
    options.devices = open_cuda_devices();
    options.slots = slots;
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    Progress progress;
    double seconds = 0, realizations = 0, block_steps = 0;
    for (auto _ : state) {
        progress = run_ensemble(experiment, options, plan, observer);
        seconds += progress.seconds;
        realizations += static_cast<double>(progress.done);
        block_steps += static_cast<double>(progress.block_steps);
    }
    state.counters["realizations_per_second"] = realizations / seconds;
    state.counters["block_steps_per_second"] = block_steps / seconds;
    state.counters["flops_per_second"] =
        block_steps / seconds * static_cast<double>(operations_per_block_step(7).flops());
    state.counters["occupancy"] = progress.occupancy;
}

/// Rate of multiply-adds in registers on the first device, two operations each.
void peak_fma(benchmark::State& state)
{
    const std::vector<std::shared_ptr<Device>> devices = open_cuda_devices();
    Device& device = *devices.front();
    constexpr int threads = 1 << 18;
    constexpr long count = 480'000;
    auto* const out = static_cast<double*>(device.allocate(threads * sizeof(double)));
    double last = 0;
    const auto run = [&] {
        device.run(MultiplyAdds{out, count}, threads);
        device.download(&last, out, sizeof last);
        benchmark::DoNotOptimize(last);
    };
    run();
    double seconds = 0;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        run();
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    device.release(out);
    state.counters["flops_per_second"] =
        2.0 * static_cast<double>(count) * threads * static_cast<double>(state.iterations()) / seconds;
}

const bool registered = [] {
    const CudaDevices found = cuda_devices();
    if (found.names.empty()) {
        benchmark::RegisterBenchmark("BM_Cuda", [reason = found.reason](benchmark::State& state) {
            state.SkipWithError(("not run: " + reason).c_str());
        });
        return true;
    }
    benchmark::RegisterBenchmark("BM_CudaPeakFma", peak_fma)->Unit(benchmark::kMillisecond);
    for (const int slots : {0, 4096, 8192, 16384, 32768, 65536})
        benchmark::RegisterBenchmark(("BM_Cuda/" + std::to_string(slots)).c_str(), on_devices, slots)
            ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace
