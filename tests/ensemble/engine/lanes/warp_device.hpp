#pragma once
/// The processor as a device whose warps step structures with a lane for every bed (`slot_warp.hpp`), and everything
/// else with a thread for every realization.

#include "ensemble/planar/device/slot_warp.hpp"
#include "tests/ensemble/engine/forwarding_device.hpp"
#include "tests/ensemble/engine/lanes/host_warp.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace stylobate {

/// Steps slots 0 .. count - 1. @pre lanes_serve(m)
inline void advance_in_lanes(const SlotMemory& m, int chunks, int count)
{
    with_lanes(m, [&]<int width, bool lists>() {
        using Memory = WarpMemory<width, lists>;
        const auto shared = std::make_unique<Memory>();
        const HostWarp warp;
        for (int first = 0; first < count; first += Memory::groups)
            SlotWarp<HostWarp, width, lists>(warp, m, *shared, first, count).run(chunks);
    });
}

class WarpDevice : public test::ForwardingDevice {
public:
    /// Steps slots 0 .. count - 1 by lanes.
    using Step = std::function<void(const SlotMemory&, int chunks, int count)>;
    explicit WarpDevice(Step step = advance_in_lanes) : step_(std::move(step)) {}

    std::string name() const override { return "the processor, in warps"; }
    std::string why_slow(const SlotMemory& memory) const override
    {
        const char* const why = why_no_lanes(memory);
        return why == nullptr ? "" : why;
    }
    void advance(const SlotMemory& memory, int chunks, int count) override
    {
        if (!lanes_serve(memory))
            return ForwardingDevice::advance(memory, chunks, count);
        ++by_lanes_;
        step_(memory, chunks, count);
    }

    /// Launches so far.
    int by_lanes() const { return by_lanes_; }
    int by_threads() const { return launches(); }

private:
    Step step_;
    int by_lanes_ = 0;
};

} // namespace stylobate
