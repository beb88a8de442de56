#pragma once
/// The processor as a device whose warps step columns with a lane for every block (`column_warp.hpp`), and everything
/// else with a thread for every realization.

#include "ensemble/planar/device/column_warp.hpp"
#include "ensemble/planar/device/host_device.hpp"
#include "tests/ensemble/engine/lanes/host_warp.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace stylobate {

/// Steps slots 0 .. count - 1. @pre lanes_serve(m)
inline void advance_columns(const SlotMemory& m, int chunks, int count)
{
    with_lane_blocks(m, [&]<int blocks>() {
        const auto shared = std::make_unique<WarpMemory<blocks>>();
        const HostWarp warp;
        for (int first = 0; first < count; first += WarpMemory<blocks>::groups)
            ColumnWarp<HostWarp, blocks>(warp, m, *shared, first, count).run(chunks);
    });
}

class WarpDevice : public Device {
public:
    /// Steps slots 0 .. count - 1 by lanes.
    using Step = std::function<void(const SlotMemory&, int chunks, int count)>;
    explicit WarpDevice(Step step = advance_columns) : step_(std::move(step)) {}

    std::string name() const override { return "the processor, in warps"; }
    int best_slots(const SlotMemory& memory, std::size_t bytes) const override
    {
        return inner_->best_slots(memory, bytes);
    }
    void* allocate(std::size_t bytes) override { return inner_->allocate(bytes); }
    void release(void* memory) noexcept override { inner_->release(memory); }
    void* allocate_host(std::size_t bytes) override { return inner_->allocate_host(bytes); }
    void release_host(void* memory) noexcept override { inner_->release_host(memory); }
    void upload(void* to, const void* from, std::size_t bytes) override { inner_->upload(to, from, bytes); }
    void download(void* to, const void* from, std::size_t bytes) override { inner_->download(to, from, bytes); }
    void advance(const SlotMemory& memory, int chunks, int count) override
    {
        const bool by_lanes = lanes_serve(memory);
        ++(by_lanes ? by_lanes_ : by_threads_);
        by_lanes ? step_(memory, chunks, count) : inner_->advance(memory, chunks, count);
    }
    void run(const MoveColumns& task, int count) override { inner_->run(task, count); }
    void run(const MoveSingleColumns& task, int count) override { inner_->run(task, count); }
    void run(const MarkSlots& task, int count) override { inner_->run(task, count); }
    void run(const MultiplyAdds& task, int count) override { inner_->run(task, count); }

    /// Launches so far.
    int by_lanes() const { return by_lanes_; }
    int by_threads() const { return by_threads_; }

private:
    Step step_;
    std::shared_ptr<Device> inner_ = host_device();
    int by_lanes_ = 0, by_threads_ = 0;
};

} // namespace stylobate
