#pragma once
/// Many realizations on a device: put into its slots, stepped together, looked at where it matters, and taken out.
///
/// What begins and ends a realization is the host's `LaneSet`, of which each thread has one, of one lane: it makes the
/// state that the device steps from. After every chunk the device determines whether a check would only count
/// (`slot_tasks.hpp`). If not, the slot stops, its column comes back, and a lane of the host takes it over and checks
/// it. So every decision, and every number of an outcome, is made by the code that the processor's own runs are made
/// by.

#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/planar/device/device.hpp"
#include "ensemble/planar/device/slot_tasks.hpp"
#include "ensemble/planar/planar_model.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

/// Memory of a device, or of the host for its copies.
template <class T>
class DeviceArray {
public:
    enum class Where { device, host };
    DeviceArray() = default;
    DeviceArray(Device& device, std::size_t size, Where where = Where::device) : device_(&device), where_(where)
    {
        const std::size_t bytes = (size > 0 ? size : 1) * sizeof(T);
        data_ = static_cast<T*>(where == Where::device ? device.allocate(bytes) : device.allocate_host(bytes));
    }
    DeviceArray(const DeviceArray&) = delete;
    DeviceArray& operator=(const DeviceArray&) = delete;
    ~DeviceArray()
    {
        if (data_ != nullptr)
            where_ == Where::device ? device_->release(data_) : device_->release_host(data_);
    }
    T* data() const { return data_; }
    T& operator[](std::size_t i) const { return data_[i]; }

private:
    Device* device_ = nullptr;
    T* data_ = nullptr;
    Where where_ = Where::device;
};

class SlotSet {
public:
    /// Gives the next realization; nothing: there is none left. Called on several threads at once.
    using Source = std::function<std::optional<Realization>()>;

    /// How few realizations of a study are better left to the host.
    static FewRealizations few_a_thread(const Study& study, const Motion* record, const Realization& pattern,
                                        const Device& device);

    /// @param record as in `LaneSet`
    /// @param slots 0: the number that the device chooses;  @param most upper limit
    SlotSet(const Study& study, const Motion* record, const Realization& pattern, Device& device, int slots, int most);
    ~SlotSet();

    int lanes() const { return memory_.slots; }
    /// `Device::why_slow` of what is stepped here.
    std::string why_slow() const { return device_.why_slow(memory_); }
    /// Slots below this number are the ones that the device goes through: those above have been emptied for good.
    int used() const { return used_; }
    int active() const;
    bool free(int slot) const { return !place(slot).busy; }
    /// Whether its realization has ended or was handed over.
    bool done(int slot) const { return outcome(slot) || handed(slot); }
    const Realization& realization(int slot) const { return place(slot).realization; }

    /// Puts a realization into a slot that is free or has ended. Different slots may be loaded at the same time.
    void load(int slot, Realization realization);
    /// Makes realizations of a source ahead: while the device steps, as many as slots have recently become free in a
    /// launch, and at most one for every `slots_a_prepared` slots.
    void prepare_from(Source source) { source_ = std::move(source); }
    /// Puts one that was made ahead into a free slot, or else the source's next one. Different slots may be filled at
    /// the same time.
    /// @return false: there is none left; none is made ahead any more   @pre `prepare_from`
    bool fill(int slot);
    /// Indices of what has been begun here and has not ended; of all that the source gave and no `clear` has taken out.
    std::vector<std::uint64_t> unfinished() const;
    /// Frees a slot. What is busy may move to other slots in the next `advance`, to close the gaps.
    void clear(int slot);

    /// Steps all busy slots by `chunks_per_launch` chunks, those that end in between by less.
    void advance();
    /// From now on the host's lanes step what is busy, `chunks_on_host` chunks in a call of `advance`. What is stepped
    /// in single precision stays on the device.
    void leave_device();
    const std::optional<Outcome>& outcome(int slot) const { return place(slot).outcome; }
    const std::optional<HandOver>& handed(int slot) const { return place(slot).handed; }

    /// A slot that has ended waits for the end of the launch: at the most 7 of the hundreds of chunks of a realization.
    static constexpr int chunks_per_launch = 8;
    static constexpr int chunks_on_host = 64;
    static constexpr int slots_a_prepared = 8;

private:
    struct Slot {
        LaneSet::Place place;          ///< as the last check has left it
        std::vector<double> column;    ///< that the device has not yet; empty: it has
        std::unique_ptr<LaneSet> lane; ///< that steps it, once it has left the device; the place is then there
        std::uint64_t steps = 0;       ///< done
    };

    const LaneSet::Place& place(int slot) const
    {
        const Slot& s = slots_[static_cast<std::size_t>(slot)];
        return s.lane ? s.lane->place(0) : s.place;
    }
    /// A realization at its static rest, and the column that a device starts from.
    Slot made(Realization realization);
    void prepare();
    /// A set of one lane, of the calling thread alone.
    LaneSet& lane() { return lanes_.local(); }
    std::uint64_t steps_of_chunk() const { return static_cast<std::uint64_t>(check_steps(memory_.topology)); }
    /// Calls f(i) for i from 0 to count - 1, on several threads of the host.
    static void each(std::size_t count, const std::function<void(std::size_t)>& f);
    void close_gaps();
    void keep_samples(int slot);
    void upload_columns();
    void upload_tables();
    void check_stopped_slots();
    void advance_on_host();
    template <class Take>
    void take_columns(const std::vector<int>& which, const Take& take);
    void move(std::size_t count, bool into_slots);
    void move_singles(std::size_t count, bool into_slots);
    void mark(const std::vector<int>& which, SlotState state);
    void upload_list(const std::vector<int>& which);

    const Study& study_;
    const Motion* record_;
    const Realization pattern_;
    Device& device_;
    std::vector<Slot> slots_;
    int used_ = 0;
    int rows_ = 0;        ///< of a column
    int single_rows_ = 0; ///< of one in single precision; 0: there is none
    int tables_ = 0;      ///< numbers of the tables of one chunk
    bool tables_given_ = false;
    bool on_host_ = false;
    tbb::enumerable_thread_specific<LaneSet> lanes_;
    SlotMemory memory_;
    Source source_;
    std::atomic<bool> exhausted_ = false; ///< the source; what it gives later is not for this set
    std::mutex preparing_;                ///< guards `prepared_`
    std::deque<Slot> prepared_;           ///< made ahead
    std::size_t ended_ = 0;               ///< slots that were freed since the last launch
    std::size_t expected_ = 0;            ///< about as many as the next launch will free

    struct Memory; ///< what `memory_` points to, and the host's copies
    std::unique_ptr<Memory> own_;
};

/// Calls f(slot) for each slot that `when` picks, on several threads.
template <class When, class F>
void each_lane(SlotSet& set, const When& when, const F& f)
{
    std::vector<int> picked;
    for (int slot = 0; slot < set.lanes(); ++slot)
        if (when(slot))
            picked.push_back(slot);
    in_parallel(std::size_t{0}, picked.size(), [&](std::size_t i) { f(picked[i]); });
}

} // namespace stylobate
