#pragma once
/// A device that steps many realizations at once, with a lane for every bed (`slot_warp.hpp`) or a thread for every
/// realization (`slot_tasks.hpp`): memory, copies, and launches. All else about it is ordinary code (`slots.hpp`), the
/// same for every device.

#include <atomic>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace stylobate {

struct SlotMemory;
template <class Number>
struct MoveColumnsOf;
struct MarkSlots;
struct MultiplyAdds;

/// A device has failed: what it was stepping is lost, and it can do nothing more.
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Numbers of realizations, for each thread of the host, that its lanes end sooner than a device, one of whose
/// realizations takes longer than one in a lane, however few run beside it.
struct FewRealizations {
    int run = 64;  ///< a run of no more is not given to the device at all
    int last = 16; ///< once nothing is left to begin, the host's lanes take over as many from the slots
};

/// One queue of work. Calls return at once and are done in order; `download` waits for them. Used by one thread at a
/// time. Every member throws DeviceError where the device fails.
class Device {
public:
    virtual ~Device() = default;
    /// What it is, for people; known of one that has failed, too.
    virtual std::string name() const = 0;
    /// Whether it has failed: it is then not used any more.
    bool failed() const { return failed_; }
    void give_up() { failed_ = true; }
    /// Whether the user has not been told of its slower way yet (`why_slow`), in this run or one before.
    bool tell_slow() { return !told_slow_.exchange(true); }

    /// How many realizations it steps best at a time.
    /// @param memory its topology, model and precision say which step will run;  @param bytes of memory for each
    virtual int best_slots(const SlotMemory& memory, std::size_t bytes) const = 0;
    /// How few realizations are better left to the host. The default is measured for devices that step a realization
    /// by one thread, 11.5 us a step (`docs/gpu.md`).
    /// @param memory as of `best_slots`, without slots and pointers
    virtual FewRealizations few_a_thread(const SlotMemory& memory) const
    {
        static_cast<void>(memory);
        return {};
    }

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

private:
    std::atomic<bool> failed_ = false, told_slow_ = false;
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

/// How a device steps what lanes serve.
enum class DeviceStep {
    by_lanes, ///< a lane of a warp for every bed
    by_threads
};

/// Queues of those that this process takes: two for each, so that one computes while the host serves the other.
/// @throws InputError if there is no device
std::vector<std::shared_ptr<Device>> open_cuda_devices(int local_rank = 0, int local_size = 1,
                                                       DeviceStep step = DeviceStep::by_lanes);

} // namespace stylobate
