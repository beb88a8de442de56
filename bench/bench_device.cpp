/// GPUs: whole studies as `BM_Ensemble` runs them on the processor, by number of slots, and what the device could do at
/// the most. Where there is no device, one line says so.

#include "bench/counted.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/planar/device/slot_tasks.hpp"
#include "ensemble/planar/device/slots.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

using namespace stylobate;

namespace {

/// Realizations of a cell: many for each slot.
constexpr int realizations = 20'000;

Study single_surface()
{
    Study study = small_surface(realizations);
    study.run.precision = Precision::single;
    return study;
}

Study rigid_surface()
{
    Study study = small_surface(realizations);
    make_rigid(study, usual_accuracy);
    return study;
}

/// A surface on all devices. slots = 0: the device's own choice.
void on_devices(benchmark::State& state, const Study& study, int slots, DeviceStep step)
{
    const Experiment experiment(study);
    RunOptions options{best_isa(), static_cast<int>(std::thread::hardware_concurrency())};
    options.devices = open_cuda_devices(0, 1, step);
    options.slots = slots;
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    Progress progress;
    double seconds = 0, done = 0, block_steps = 0;
    for (auto _ : state) {
        progress = run_ensemble(experiment, options, plan, observer);
        seconds += progress.seconds;
        done += static_cast<double>(progress.done);
        block_steps += static_cast<double>(progress.block_steps);
    }
    state.counters["realizations_per_second"] = done / seconds;
    state.counters["block_steps_per_second"] = block_steps / seconds;
    if (study.contact.form == ContactForm::area && study.run.precision == Precision::double_)
        state.counters["flops_per_second"] =
            block_steps / seconds * static_cast<double>(operations_per_block_step(7).flops());
    state.counters["occupancy"] = progress.occupancy;
}

/// The step alone: columns that rock without an end, in one queue of the first device.
/// @param slots 0: as many as both queues have by the device's own choice
void steps(benchmark::State& state, const Study& study, int slots, DeviceStep step)
{
    constexpr int launches = 20;
    const Sampler sampler(study, nullptr);
    const std::vector<std::shared_ptr<Device>> devices = open_cuda_devices(0, 1, step);
    if (slots == 0)
        slots = 2 * SlotSet(study, nullptr, sampler.realization(0), *devices.front(), 0, 1 << 20).lanes();
    SlotSet set(study, nullptr, sampler.realization(0), *devices.front(), slots, slots);
    in_parallel(0, slots, [&](int slot) { set.load(slot, sampler.realization(static_cast<std::uint64_t>(slot))); });
    set.advance();
    double seconds = 0, launched = 0;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < launches; ++i)
            set.advance();
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        launched += launches;
    }
    const double block_steps = launched * SlotSet::chunks_per_launch * chunk_steps * set.active() *
                               static_cast<double>(sampler.realization(0).free_blocks());
    state.counters["block_steps_per_second"] = block_steps / seconds;
    state.counters["flops_per_second"] =
        block_steps / seconds * static_cast<double>(operations_per_block_step(7).flops());
    state.counters["launch_ms"] = 1000 * seconds / launched;
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
    const auto add = [](const std::string& name, const auto& run, const Study& study, int slots, DeviceStep step) {
        return benchmark::RegisterBenchmark(name.c_str(), run, study, slots, step)->Unit(benchmark::kMillisecond);
    };
    using enum DeviceStep;
    for (const int slots :
         {0, 2640, 5280, 7920, 15840}) // one to three warps a scheduler of 132 multiprocessors, and more
        add("BM_CudaStep/lanes/" + std::to_string(slots), steps, rocking_column(7), slots, by_lanes)->Iterations(1);
    for (const int slots : {1024, 4096, 16384, 33792})
        add("BM_CudaStep/threads/" + std::to_string(slots), steps, rocking_column(7), slots, by_threads)->Iterations(1);
    for (const int slots : {0, 15840})
        add("BM_Cuda/" + std::to_string(slots), on_devices, small_surface(realizations), slots, by_lanes);
    add("BM_Cuda/threads", on_devices, small_surface(realizations), 0, by_threads);
    add("BM_Cuda/single", on_devices, single_surface(), 0, by_threads);
    add("BM_Cuda/rigid", on_devices, rigid_surface(), 0, by_threads);
    return true;
}();

} // namespace
