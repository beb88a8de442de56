// The devices of CUDA. Compiled only where there is a CUDA compiler, with --fmad=false and IEEE division and roots:
// what is to be fused is written as fma, so that a step has the bits of the processor's.

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/device/device.hpp"
#include "ensemble/planar/device/slot_kernel.cuh"
#include "ensemble/planar/device/slot_tasks.hpp"

#include <cuda_runtime.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <type_traits>
#include <utility>

namespace stylobate {

namespace {

// Threads of a block: one warp for each of a multiprocessor's four schedulers.
constexpr int block_threads = 128;
// Number of threads of a multiprocessor for which registers must suffice.
constexpr int resident_threads = 256;
// Slots for each multiprocessor, of both queues together, where a thread steps a realization: their states stay in its
// first-level cache (`docs/gpu.md`).
constexpr int cached_slots = 128;

void check(cudaError_t status, const char* what)
{
    if (status != cudaSuccess)
        throw DeviceError(std::string("the GPU failed: ") + what + ": " + cudaGetErrorString(status));
}

} // namespace

/// Whose file the kernels are of.
struct OnCuda {};

template <class Task>
__global__ void __launch_bounds__(block_threads, resident_threads / block_threads) run_task(const Task task, int count)
{
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count)
        task(i);
}

namespace {

class CudaQueue : public Device {
public:
    CudaQueue(int device, DeviceStep step) : device_(device), step_(step)
    {
        use();
        cudaDeviceProp p{};
        check(cudaGetDeviceProperties(&p, device_), "its properties cannot be read");
        char text[400];
        std::snprintf(text, sizeof text, "%s (compute capability %d.%d, %d multiprocessors, %.0f GiB)", p.name, p.major,
                      p.minor, p.multiProcessorCount, static_cast<double>(p.totalGlobalMem) / (1 << 30));
        name_ = text; // now, as it cannot be asked for any more once the device has failed
        check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "a queue cannot be made");
    }
    ~CudaQueue() override
    {
        if (cudaSetDevice(device_) == cudaSuccess)
            cudaStreamDestroy(stream_);
    }

    std::string name() const override { return name_; }

    int best_slots(const SlotMemory& memory, std::size_t bytes) const override
    {
        use();
        int processors = 0;
        check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device_),
              "its properties cannot be read");
        int slots = lane_slots(memory);
        if (slots == 0)
            with_model<OnCuda>(memory, 1, [&](const auto& task) {
                using Task = std::decay_t<decltype(task)>;
                int blocks = 0;
                check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, run_task<Task>, block_threads, 0),
                      "the kernel does not fit");
                slots = std::min(cached_slots, blocks * block_threads);
            });
        std::size_t free = 0, total = 0;
        check(cudaMemGetInfo(&free, &total), "its memory cannot be read");
        const std::size_t fit = free / 4 / std::max<std::size_t>(bytes, 1); // of two queues, half of the memory
        // half of the slots: the other queue computes meanwhile
        return static_cast<int>(std::clamp<std::size_t>(fit, 1, static_cast<std::size_t>(processors * slots / 2)));
    }

    /// A step by lanes takes a tenth of the time of one by a thread.
    FewRealizations few_a_thread(const SlotMemory& memory) const override
    {
        return lane_slots(memory) > 0 ? FewRealizations{.run = 8, .last = 2} : FewRealizations{};
    }

    std::string why_slow(const SlotMemory& memory) const override
    {
        if (const char* const why = why_no_lanes(memory))
            return why;
        return lane_slots(memory) > 0 ? "" : "its multiprocessors have too little shared memory for lanes";
    }

    void* allocate(std::size_t bytes) override
    {
        use();
        void* memory = nullptr;
        check(cudaMalloc(&memory, bytes), "no memory");
        check(cudaMemsetAsync(memory, 0, bytes, stream_), "its memory cannot be written");
        return memory;
    }
    void release(void* memory) noexcept override
    {
        if (cudaSetDevice(device_) == cudaSuccess)
            cudaFree(memory);
    }
    void* allocate_host(std::size_t bytes) override
    {
        use();
        void* memory = nullptr;
        check(cudaMallocHost(&memory, bytes), "no memory of the host for its copies");
        return memory;
    }
    void release_host(void* memory) noexcept override { cudaFreeHost(memory); }

    void upload(void* to, const void* from, std::size_t bytes) override
    {
        use();
        check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream_), "a copy to it");
    }
    void download(void* to, const void* from, std::size_t bytes) override
    {
        use();
        check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream_), "a copy from it");
        check(cudaStreamSynchronize(stream_), "a kernel or a copy");
    }

    void advance(const SlotMemory& memory, int chunks, int count) override
    {
        if (lane_slots(memory) == 0)
            return with_model<OnCuda>(memory, chunks, [&](const auto& task) { launch(task, count); });
        if (count <= 0)
            return;
        use();
        with_lanes(memory, [&]<int width, bool lists>() {
            constexpr int slots = block_slots<width, lists>;
            step_slots<width, lists><<<static_cast<unsigned>((count + slots - 1) / slots), warp_lanes * block_warps,
                                       block_shared_bytes<width, lists>, stream_>>>(memory, chunks, count);
        });
        check(cudaGetLastError(), "a kernel does not start");
    }
    void run(const MoveColumns& task, int count) override { launch(task, count); }
    void run(const MoveSingleColumns& task, int count) override { launch(task, count); }
    void run(const MarkSlots& task, int count) override { launch(task, count); }
    void run(const MultiplyAdds& task, int count) override { launch(task, count); }

private:
    void use() const { check(cudaSetDevice(device_), "it cannot be used"); }

    /// Slots for each multiprocessor where lanes step the blocks; 0 where they do not serve, or where the
    /// multiprocessor has too little shared memory for a block of threads.
    int lane_slots(const SlotMemory& memory) const
    {
        if (!lanes_serve(memory) || step_ == DeviceStep::by_threads)
            return 0;
        const std::pair kind{memory.lane_width, memory.lists.bed != nullptr};
        if (lane_slots_ < 0 || lane_kind_ != kind) {
            use();
            lane_kind_ = kind;
            with_lanes(memory, [&]<int width, bool lists>() {
                constexpr int bytes = static_cast<int>(block_shared_bytes<width, lists>);
                const auto kernel = step_slots<width, lists>;
                int most = 0, residents = 0;
                check(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device_),
                      "its properties cannot be read");
                if (bytes <= most) {
                    check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes),
                          "the kernel does not fit");
                    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&residents, kernel, warp_lanes * block_warps,
                                                                        bytes),
                          "the kernel does not fit");
                }
                lane_slots_ = residents * block_slots<width, lists>;
            });
        }
        return lane_slots_;
    }

    template <class Task>
    void launch(const Task& task, int count)
    {
        if (count <= 0)
            return;
        use();
        run_task<<<static_cast<unsigned>((count + block_threads - 1) / block_threads), block_threads, 0, stream_>>>(
            task, count);
        check(cudaGetLastError(), "a kernel does not start");
    }

    int device_ = 0;
    std::string name_;
    DeviceStep step_ = DeviceStep::by_lanes;
    cudaStream_t stream_ = nullptr;
    mutable int lane_slots_ = -1;                      ///< of `lane_slots`
    mutable std::pair<int, bool> lane_kind_{0, false}; ///< that it is for: lanes of a group, whether with lists
};

/// Devices that this program has code for. @param reason why there are none, if so
std::vector<int> usable_devices(std::string& reason)
{
    int count = 0;
    const cudaError_t status = cudaGetDeviceCount(&count);
    if (status != cudaSuccess || count == 0) {
        reason = status == cudaSuccess || status == cudaErrorNoDevice
                     ? std::string("no CUDA device is found")
                     : std::string("no CUDA device can be used: ") + cudaGetErrorString(status);
        return {};
    }
    std::vector<int> usable;
    for (int device = 0; device < count; ++device) {
        cudaFuncAttributes attributes{};
        cudaError_t found = cudaSetDevice(device);
        const bool there = found == cudaSuccess;
        if (there)
            found = cudaFuncGetAttributes(&attributes, run_task<MarkSlots>);
        if (found == cudaSuccess)
            usable.push_back(device);
        else if (there && (found == cudaErrorNoKernelImageForDevice || found == cudaErrorInvalidDeviceFunction))
            reason = "this program has no code for " + CudaQueue(device, DeviceStep::by_threads).name() +
                     ". Build it with -DCMAKE_CUDA_ARCHITECTURES of its compute capability, without the point";
        else
            reason = std::string("no CUDA device can be used: ") + cudaGetErrorString(found);
    }
    return usable;
}

} // namespace

CudaDevices cuda_devices()
{
    CudaDevices found;
    for (const int device : usable_devices(found.reason))
        found.names.push_back(CudaQueue(device, DeviceStep::by_lanes).name());
    return found;
}

std::vector<std::shared_ptr<Device>> open_cuda_devices(int local_rank, int local_size, DeviceStep step)
{
    std::string reason;
    const std::vector<int> usable = usable_devices(reason);
    if (usable.empty())
        throw InputError("--backend cuda: " + reason);
    std::vector<std::shared_ptr<Device>> queues;
    for (int half = 0; half < 2; ++half)
        for (const int i : devices_of_rank(static_cast<int>(usable.size()), local_rank, local_size))
            queues.push_back(std::make_shared<CudaQueue>(usable[static_cast<std::size_t>(i)], step));
    return queues;
}

} // namespace stylobate
