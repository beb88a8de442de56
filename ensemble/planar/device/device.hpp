#pragma once
/// A device that steps many realizations at once, with a lane for every block (`column_warp.hpp`) or a thread for every
/// realization (`slot_tasks.hpp`): memory, copies, and launches. All else about it is ordinary code (`slots.hpp`), the
/// same for every device.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace stylobate {

struct SlotMemory;
template <class Number>
struct MoveColumnsOf;
struct MarkSlots;
struct MultiplyAdds;

/// One queue of work. Calls return at once and are done in order; `download` waits for them. Used by one thread at a
/// time. Every member throws std::runtime_error where the device fails.
class Device {
public:
    virtual ~Device() = default;
    /// What it is, for people.
    virtual std::string name() const = 0;
    /// How many realizations it steps best at a time.
    /// @param memory its topology, model and precision say which step will run;  @param bytes of memory for each
    virtual int best_slots(const SlotMemory& memory, std::size_t bytes) const = 0;

    /// @return memory of the device, all zero
    virtual void* allocate(std::size_t bytes) = 0;
    virtual void release(void* memory) noexcept = 0;
    /// @return memory of the host that can be copied from and to without detours
    virtual void* allocate_host(std::size_t bytes) = 0;
    virtual void release_host(void* memory) noexcept = 0;

    /// `from` is to stay as it is until the next `download`.
    virtual void upload(void* to, const void* from, std::size_t bytes) = 0;
    virtual void download(void* to, const void* from, std::size_t bytes) = 0;

    /// Why these slots are not stepped as fast as the device can, for people; empty where they are.
    virtual std::string why_slow(const SlotMemory& memory) const
    {
        static_cast<void>(memory);
        return {};
    }
    /// `AdvanceSlot` for slots 0 .. count - 1.
    virtual void advance(const SlotMemory& memory, int chunks, int count) = 0;
    virtual void run(const MoveColumnsOf<double>& task, int count) = 0;
    virtual void run(const MoveColumnsOf<float>& task, int count) = 0;
    virtual void run(const MarkSlots& task, int count) = 0;
    virtual void run(const MultiplyAdds& task, int count) = 0;
};

/// What there is to compute on.
struct CudaDevices {
    std::vector<std::string> names; ///< of each device: model, compute capability, memory
    std::string reason;             ///< why there are none, if so
};
CudaDevices cuda_devices();

/// Which devices of a machine one of the processes there takes, so that each is used and none of them does without.
/// @param local_rank of the process, 0 .. local_size - 1
std::vector<int> devices_of_rank(int devices, int local_rank, int local_size);

/// How a device steps columns.
enum class ColumnStep {
    by_lanes, ///< where lanes serve them
    by_threads
};

/// Queues of those that this process takes: two for each, so that one computes while the host serves the other.
/// @throws InputError if there is no device
std::vector<std::shared_ptr<Device>> open_cuda_devices(int local_rank = 0, int local_size = 1,
                                                       ColumnStep step = ColumnStep::by_lanes);

} // namespace stylobate
