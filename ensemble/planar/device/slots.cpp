#include "ensemble/planar/device/slots.hpp"

#include "ensemble/planar/device/slot_column.hpp"
#include "ensemble/planar/device/slot_warp.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <numeric>

namespace stylobate {

struct SlotSet::Memory {
    using Doubles = DeviceArray<double>;
    using Singles = DeviceArray<float>;
    using Ints = DeviceArray<int>;
    using States = DeviceArray<SlotState>;

    /// @param rigid_numbers of the rigid form's order
    /// @param single_rows of the bundle in single precision; 0: there is none
    Memory(Device& device, std::size_t slots, std::size_t rows, std::size_t table_rows, const Topology& topology,
           std::size_t rigid_numbers, std::size_t single_rows)
        : columns(device, rows * slots), close(device, static_cast<std::size_t>(topology.watched) * slots),
          state(device, slots), tables(device, chunks_per_launch * table_rows * slots),
          joints(device, static_cast<std::size_t>(topology.joints)),
          bed_lists(device, static_cast<std::size_t>(bed_lists_size(topology))), rigid_order(device, rigid_numbers),
          seats(device, static_cast<std::size_t>(topology.beds())),
          lane_beds(device, static_cast<std::size_t>(topology.beds())),
          lane_owners(device, static_cast<std::size_t>(topology.blocks)), packed(device, rows * slots),
          list(device, slots), singles(device, single_rows * slots), packed_singles(device, single_rows * slots),
          host_packed(device, rows * slots, Doubles::Where::host), host_list(device, slots, Ints::Where::host),
          host_state(device, slots, States::Where::host)
    {
    }
    Doubles columns; ///< (rows x slots)
    Ints close;      ///< (watched x slots)
    States state;
    Doubles tables;
    DeviceArray<TopologyJoint> joints;
    Ints bed_lists, rigid_order, seats;
    DeviceArray<LaneBed> lane_beds; ///< `list_lanes`
    Ints lane_owners;
    Doubles packed; ///< columns on their way, one after the other
    Ints list;
    Singles singles, packed_singles; ///< (single_rows x slots), and on their way
    Doubles host_packed;
    Ints host_list;
    States host_state;
    std::unique_ptr<Doubles> packed_tables, host_tables;       ///< once they are needed
    std::unique_ptr<Ints> all;                                 ///< 0, 1, 2 and so on
    std::map<const double*, std::unique_ptr<Doubles>> samples; ///< of base motions, by where the host has them
};

void SlotSet::each(std::size_t count, const std::function<void(std::size_t)>& f)
{
    in_parallel(std::size_t{0}, count, f);
}

namespace {

/// What lanes hold, on the host.
struct HostLists {
    std::vector<LaneBed> bed;
    std::vector<int> owner;
};

/// Which step the realizations of a study take: without slots, and with pointers of the host alone.
SlotMemory kind_of_step(const Study& study, const Topology& topology, HostLists& lists)
{
    SlotMemory memory;
    if (plain_stack(topology)) {
        memory.lane_width = topology.free_blocks();
    } else {
        lists.bed.resize(static_cast<std::size_t>(topology.beds()));
        lists.owner.resize(static_cast<std::size_t>(topology.blocks));
        if (list_lanes(topology, lists.bed.data(), lists.owner.data())) {
            memory.lane_width = lanes_of_group(topology.beds());
            memory.lists = {lists.bed.data(), lists.owner.data(), lists.owner[static_cast<std::size_t>(topology.top)]};
        }
    }
    memory.topology = topology;
    memory.motion = BaseMotion::formula(study.excitation.kind);
    memory.base = BaseMotion::along_shared_samples(study) ? BaseTables::along_samples : BaseTables::by_formula;
    memory.in_single = study.run.precision == Precision::single;
    return memory;
}

} // namespace

FewRealizations SlotSet::few_a_thread(const Study& study, const Motion* record, const Realization& pattern,
                                      const Device& device)
{
    const LaneSet one(study, record, kernels(Isa::scalar), pattern);
    HostLists lists;
    return device.few_a_thread(kind_of_step(study, one.model().topology(), lists));
}

SlotSet::SlotSet(const Study& study, const Motion* record, const Realization& pattern, Device& device, int slots,
                 int most)
    : study_(study), record_(record), pattern_(pattern), device_(device),
      lanes_([this] { return LaneSet(study_, record_, kernels(Isa::scalar), pattern_); })
{
    const PlanarModel& first = lane().model();
    const Topology& host = first.topology();
    rows_ = static_cast<int>(column_rows(host));
    tables_ = static_cast<int>(table_registers(host));
    HostLists lists;
    memory_ = kind_of_step(study, host, lists);
    if (memory_.in_single)
        single_rows_ = static_cast<int>(bundle_registers<float>(host));
    const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(2 * rows_ + chunks_per_launch * tables_) +
                              sizeof(float) * static_cast<std::size_t>(2 * single_rows_);
    if (slots <= 0)
        slots = device.best_slots(memory_, bytes);
    // a place within the rows is counted by an int
    slots = std::clamp(std::min(slots, most), 1, std::numeric_limits<int>::max() / std::max(rows_, 1));
    slots_.resize(static_cast<std::size_t>(slots));

    own_ = std::make_unique<Memory>(device, static_cast<std::size_t>(slots), static_cast<std::size_t>(rows_),
                                    static_cast<std::size_t>(tables_), host, first.rigid_order_size(),
                                    static_cast<std::size_t>(single_rows_));
    Memory& own = *own_;
    std::vector<int> seats;
    for (int j = 0; j < host.beds(); ++j)
        if (pattern.blocks[static_cast<std::size_t>(pattern.joints[static_cast<std::size_t>(j)].upper)].role ==
            BlockRole::epistyle)
            seats.push_back(j);
    const auto upload = [&device](auto& to, const auto* from, std::size_t count) {
        if (count > 0)
            device.upload(to.data(), from, count * sizeof(*from));
    };
    upload(own.joints, host.joint, static_cast<std::size_t>(host.joints));
    upload(own.bed_lists, host.bed_lists, static_cast<std::size_t>(bed_lists_size(host)));
    upload(own.rigid_order, host.rigid_order, first.rigid_order_size());
    upload(own.seats, seats.data(), seats.size());
    upload(own.lane_beds, lists.bed.data(), lists.bed.size());
    upload(own.lane_owners, lists.owner.data(), lists.owner.size());

    memory_.slots = slots;
    memory_.topology.joint = own.joints.data();
    memory_.topology.bed_lists = own.bed_lists.data();
    memory_.topology.rigid_order = own.rigid_order.data();
    if (memory_.lists.bed != nullptr) {
        memory_.lists.bed = own.lane_beds.data();
        memory_.lists.owner = own.lane_owners.data();
    }
    memory_.bundle = bind_bundle(memory_.topology, slots, own.columns.data(), own.close.data());
    if (memory_.in_single)
        memory_.single = bind_bundle(memory_.topology, slots, own.singles.data(), own.close.data());
    const auto stride = static_cast<std::ptrdiff_t>(slots);
    double* at =
        own.columns.data() + static_cast<std::ptrdiff_t>(bundle_registers(host) - table_registers(host)) * stride;
    FormulaParameters& f = memory_.formula;
    for (double** row : {&f.cycles_per_step, &f.amplitude_m, &f.cycles, &f.phase_cycles, &f.offset,
                         &f.start_ramps_per_cycle, &f.end_ramps_per_cycle, &f.end_velocity}) {
        *row = at;
        at += stride;
    }
    memory_.samples = at;
    at += sampled_rows * stride;
    memory_.watch = at;
    memory_.alarms = at + watch_rows * stride;
    memory_.tables = own.tables.data();
    memory_.state = own.state.data();
    memory_.seats = own.seats.data();
    memory_.seat_count = static_cast<int>(seats.size());
    // the copies above are from memory that goes away with this call
    device.download(own.host_state.data(), own.state.data(), sizeof(SlotState));
}

SlotSet::~SlotSet() = default;

int SlotSet::active() const
{
    int busy = 0;
    for (int slot = 0; slot < lanes(); ++slot)
        busy += !free(slot);
    return busy;
}

void SlotSet::load(int slot, Realization realization)
{
    Slot& s = slots_[static_cast<std::size_t>(slot)];
    if (on_host_) {
        if (!s.lane)
            s.lane = std::make_unique<LaneSet>(study_, record_, kernels(Isa::scalar), pattern_);
        return s.lane->load(0, std::move(realization));
    }
    s = made(std::move(realization));
}

SlotSet::Slot SlotSet::made(Realization realization)
{
    Slot slot;
    LaneSet& one = lane();
    one.load(0, std::move(realization));
    slot.column.resize(static_cast<std::size_t>(rows_));
    write_column(one, slot.column.data());
    slot.place = one.take(0);
    return slot;
}

bool SlotSet::fill(int slot)
{
    assert(!on_host_ && "what has left the device is not filled again");
    {
        const std::lock_guard lock(preparing_);
        if (!prepared_.empty()) {
            slots_[static_cast<std::size_t>(slot)] = std::move(prepared_.front());
            prepared_.pop_front();
            return true;
        }
    }
    std::optional<Realization> next = source_();
    if (!next) {
        exhausted_ = true;
        return false;
    }
    load(slot, std::move(*next));
    return true;
}

/// Called while the device steps.
void SlotSet::prepare()
{
    expected_ = std::max(ended_, expected_ - expected_ / slots_a_prepared); // (the last maximum is forgotten slowly)
    ended_ = 0;
    if (!source_ || exhausted_)
        return;
    const std::size_t want = std::min(expected_, slots_.size() / slots_a_prepared), have = prepared_.size();
    each(want - std::min(want, have), [this](std::size_t) {
        std::optional<Realization> next = source_();
        if (!next)
            return;
        Slot slot = made(std::move(*next));
        const std::lock_guard lock(preparing_);
        prepared_.push_back(std::move(slot));
    });
}

std::vector<std::uint64_t> SlotSet::unfinished() const
{
    std::vector<std::uint64_t> indices;
    for (int slot = 0; slot < lanes(); ++slot)
        if (!free(slot))
            indices.push_back(realization(slot).index);
    for (const Slot& slot : prepared_)
        indices.push_back(slot.place.realization.index);
    return indices;
}

void SlotSet::clear(int slot)
{
    Slot& s = slots_[static_cast<std::size_t>(slot)];
    if (s.lane)
        s.lane->clear(0);
    s.place = {};
    s.column.clear();
    ++ended_;
}

void SlotSet::advance()
{
    if (on_host_)
        return advance_on_host();
    close_gaps();
    upload_columns();
    if (tables_given_)
        upload_tables();
    device_.advance(memory_, chunks_per_launch, used_);
    prepare();
    check_stopped_slots();
}

/// The list on the device. Waits for the device only where the host's copy of another list may still be on its way.
void SlotSet::upload_list(const std::vector<int>& which)
{
    std::copy(which.begin(), which.end(), own_->host_list.data());
    device_.upload(own_->list.data(), own_->host_list.data(), which.size() * sizeof(int));
}

/// Columns of the slots that the device's list names.
void SlotSet::move(std::size_t count, bool into_slots)
{
    const MoveColumns task{
        own_->packed.data(), own_->columns.data(), own_->list.data(), static_cast<int>(count), rows_, memory_.slots,
        into_slots};
    device_.run(task, task.count());
}

/// What is stepped in single precision, where it is: it stays on the device.
void SlotSet::move_singles(std::size_t count, bool into_slots)
{
    const MoveSingleColumns task{own_->packed_singles.data(),
                                 own_->singles.data(),
                                 own_->list.data(),
                                 static_cast<int>(count),
                                 single_rows_,
                                 memory_.slots,
                                 into_slots};
    device_.run(task, task.count());
}

void SlotSet::mark(const std::vector<int>& which, SlotState state)
{
    device_.run(MarkSlots{own_->state.data(), own_->list.data(), state}, static_cast<int>(which.size()));
}

/// Once there is nothing left to fill slots with, the busy ones move together: threads side by side then all work.
void SlotSet::close_gaps()
{
    int end = lanes();
    while (end > 0 && free(end - 1))
        --end;
    const int busy = active();
    if (2 * busy > end) {
        used_ = end;
        return;
    }
    std::vector<int> from, to;
    for (int i = busy; i < end; ++i)
        if (!free(i))
            from.push_back(i);
    for (int i = 0; i < busy; ++i)
        if (free(i))
            to.push_back(i);
    assert(from.size() == to.size());
    used_ = busy;
    if (from.empty())
        return;
    upload_list(from);
    move(from.size(), false);
    move_singles(from.size(), false);
    mark(from, SlotState::empty);
    // (waits: the list is to be written again)
    device_.download(own_->host_state.data(), own_->state.data(), sizeof(SlotState));
    upload_list(to);
    move(to.size(), true);
    move_singles(to.size(), true);
    mark(to, SlotState::busy);
    device_.download(own_->host_state.data(), own_->state.data(), sizeof(SlotState));
    for (std::size_t i = 0; i < from.size(); ++i)
        std::swap(slots_[static_cast<std::size_t>(from[i])], slots_[static_cast<std::size_t>(to[i])]);
}

/// The samples that a slot's base goes along come to the device once, and stay there.
void SlotSet::keep_samples(int slot)
{
    const SampledMotion motion = place(slot).motions[0].samples();
    std::unique_ptr<Memory::Doubles>& kept = own_->samples[motion.sample];
    if (kept)
        return;
    const auto count = static_cast<std::size_t>(motion.last) + 1;
    kept = std::make_unique<Memory::Doubles>(device_, count);
    device_.upload(kept->data(), motion.sample, count * sizeof(double));
}

void SlotSet::upload_columns()
{
    std::vector<int> changed;
    for (int i = 0; i < used_; ++i)
        if (!slots_[static_cast<std::size_t>(i)].column.empty())
            changed.push_back(i);
    if (changed.empty())
        return;
    const auto rows = static_cast<std::size_t>(rows_);
    const bool sampled = BaseMotion::along_shared_samples(study_);
    for (const int slot : changed) {
        if (sampled)
            keep_samples(slot);
        tables_given_ = tables_given_ || tables_given(study_, place(slot));
    }
    each(changed.size(), [&](std::size_t i) {
        Slot& s = slots_[static_cast<std::size_t>(changed[i])];
        if (sampled) {
            const SampledMotion motion = s.place.motions[0].samples();
            write_samples(memory_.topology, motion, own_->samples.at(motion.sample)->data(), s.column.data());
        }
        std::copy(s.column.begin(), s.column.end(), own_->host_packed.data() + i * rows);
        s.column = {};
    });
    device_.upload(own_->packed.data(), own_->host_packed.data(), changed.size() * rows * sizeof(double));
    upload_list(changed);
    move(changed.size(), true);
    mark(changed, SlotState::busy);
}

/// Tables that the host makes, for all chunks of a launch.
void SlotSet::upload_tables()
{
    Memory& own = *own_;
    const auto slots = static_cast<std::size_t>(memory_.slots), tables = static_cast<std::size_t>(tables_);
    const std::size_t column = chunks_per_launch * tables;
    if (!own.packed_tables) {
        using Doubles = Memory::Doubles;
        own.packed_tables = std::make_unique<Doubles>(device_, column * slots);
        own.host_tables = std::make_unique<Doubles>(device_, column * slots, Doubles::Where::host);
        own.all = std::make_unique<Memory::Ints>(device_, slots);
        std::vector<int> all(slots);
        std::iota(all.begin(), all.end(), 0);
        device_.upload(own.all->data(), all.data(), slots * sizeof(int));
        device_.download(own.host_state.data(), own.state.data(), sizeof(SlotState));
        memory_.base = BaseTables::given;
    }
    each(static_cast<std::size_t>(used_), [&](std::size_t slot) {
        Slot& s = slots_[slot];
        if (!s.place.busy)
            return;
        LaneSet& one = lane();
        one.put(0, std::move(s.place));
        for (std::size_t chunk = 0; chunk < chunks_per_launch; ++chunk)
            write_tables(one, s.steps + chunk * steps_of_chunk(),
                         own.host_tables->data() + slot * column + chunk * tables);
        s.place = one.take(0);
    });
    const auto used = static_cast<std::size_t>(used_);
    device_.upload(own.packed_tables->data(), own.host_tables->data(), used * column * sizeof(double));
    const MoveColumns task{own.packed_tables->data(),
                           own.tables.data(),
                           own.all->data(),
                           used_,
                           static_cast<int>(column),
                           memory_.slots,
                           true};
    device_.run(task, task.count());
}

/// From slots, which are then empty, to lanes of the host.
/// @param take (slot, column) called on several threads
template <class Take>
void SlotSet::take_columns(const std::vector<int>& which, const Take& take)
{
    const auto rows = static_cast<std::size_t>(rows_);
    upload_list(which);
    move(which.size(), false);
    mark(which, SlotState::empty);
    device_.download(own_->host_packed.data(), own_->packed.data(), which.size() * rows * sizeof(double));
    each(which.size(),
         [&](std::size_t i) { take(slots_[static_cast<std::size_t>(which[i])], own_->host_packed.data() + i * rows); });
}

void SlotSet::leave_device()
{
    if (on_host_ || memory_.in_single)
        return;
    on_host_ = true;
    const auto to_lane = [this](Slot& s, const double* column) {
        s.lane = std::make_unique<LaneSet>(study_, record_, kernels(Isa::scalar), pattern_);
        s.lane->put(0, std::move(s.place));
        s.lane->bases().store(0, s.lane->place(0).motions);
        read_column(*s.lane, column);
        s.place = {};
    };
    std::vector<int> there;
    for (std::size_t i = 0; i < slots_.size(); ++i)
        if (slots_[i].place.busy && slots_[i].column.empty())
            there.push_back(static_cast<int>(i));
    if (!there.empty())
        take_columns(there, to_lane);
    for (Slot& s : slots_)
        if (!s.column.empty()) {
            to_lane(s, s.column.data());
            s.column = {};
        }
}

void SlotSet::advance_on_host()
{
    std::vector<int> busy;
    for (int slot = 0; slot < lanes(); ++slot)
        if (!free(slot))
            busy.push_back(slot);
    used_ = static_cast<int>(busy.size());
    each(busy.size(), [&](std::size_t i) {
        LaneSet& one = *slots_[static_cast<std::size_t>(busy[i])].lane;
        for (int chunk = 0; chunk < chunks_on_host && !one.done(0); ++chunk)
            one.advance();
    });
}

void SlotSet::check_stopped_slots()
{
    const auto used = static_cast<std::size_t>(used_);
    device_.download(own_->host_state.data(), own_->state.data(), used * sizeof(SlotState));
    std::vector<int> stopped;
    for (std::size_t i = 0; i < used; ++i) {
        if (own_->host_state[i] == SlotState::asks)
            stopped.push_back(static_cast<int>(i));
        slots_[i].steps += chunks_per_launch * steps_of_chunk();
    }
    if (stopped.empty())
        return;
    take_columns(stopped, [this](Slot& s, const double* column) {
        LaneSet& one = lane();
        one.put(0, std::move(s.place));
        one.bases().store(0, one.place(0).motions);
        read_column(one, column);
        one.check(0, check_steps(memory_.topology));
        s.steps = one.steps(0);
        if (!one.done(0)) { // it goes on: the device needs the result of the check
            s.column.resize(static_cast<std::size_t>(rows_));
            write_column(one, s.column.data());
        }
        s.place = one.take(0);
    });
}

} // namespace stylobate
