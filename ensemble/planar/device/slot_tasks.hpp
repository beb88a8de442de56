#pragma once
/// What a device does with its slots: functors that are run once for each index, on the processor in a loop (tests) or
/// by as many threads of a device. `SlotSet` decides when.
///
/// A slot is a place for one realization. Its numbers are a column of the device's memory: row r of slot s is number
/// r * slots + s, so that threads side by side read and write side by side.

#include "ensemble/planar/planar_watch.hpp"
#include "ensemble/planar/single_lanes.hpp"
#include "kernels/base_motion.hpp"
#include "kernels/instances/instantiate.hpp"
#include "kernels/lanes/lane_list.hpp"
#include "kernels/sampled_motion.hpp"

#include <bit>
#include <cstdint>
#include <type_traits>

namespace stylobate {

/// Rows of a column behind those of the bundle's state.
inline constexpr int formula_rows = 8;
inline constexpr int sampled_rows = static_cast<int>(sizeof(SampledMotion) / 8);
static_assert(sizeof(SampledMotion) == 8 * sampled_rows);
inline constexpr int watch_rows = static_cast<int>(sizeof(Watch) / 8);
static_assert(sizeof(Watch) % 8 == 0);
/// Rows of alarms, of each block: by which a device detects that the limit states must be evaluated.
struct OfAlarm {
    enum Field : int {
        low,    ///< displacement upwards below which the block may have fallen [m]
        turned, ///< |rotation| above which it may have [rad]
        count
    };
};

/// Rows of a column in all.
inline std::size_t column_rows(const Topology& topology)
{
    return bundle_registers(topology) - table_registers(topology) + formula_rows + sampled_rows + watch_rows +
           static_cast<std::size_t>(topology.blocks * OfAlarm::count);
}

enum class SlotState : int {
    empty,
    busy,
    asks ///< the host is to check it: its watch is that of before the last chunk's check
};

/// Where the tables of the base's motion come from.
enum class BaseTables : int {
    by_formula,
    along_samples,
    given ///< the host has made them
};

/// A device's memory. Every pointer is the device's.
struct SlotMemory {
    int slots = 0;
    Topology topology{};
    Bundle bundle{};
    bool in_single = false;
    BundleOf<float> single{};    ///< what is stepped, in single precision; `bundle` is then what a check reads
    FormulaParameters formula{}; ///< each (slots)
    MotionFormula motion{};      ///< by which the base's tables are made, if by one
    BaseTables base = BaseTables::by_formula;
    double* samples = nullptr;  ///< (sampled_rows x slots) `SampledMotion`, number by number
    double* watch = nullptr;    ///< (watch_rows x slots) `Watch`, number by number
    double* alarms = nullptr;   ///< (blocks x OfAlarm::count x slots)
    double* tables = nullptr;   ///< (chunks of a launch x table_registers x slots)
    SlotState* state = nullptr; ///< (slots)
    const int* seats = nullptr; ///< (seat_count) the beds on which epistyles lie
    int seat_count = 0;
    int lane_width = 0; ///< lanes of a group where lanes step this structure (`kernels/lanes/`); 0: they do not
    LaneLists lists{};  ///< what they hold; of a plain stack: none
};

namespace detail {

/// The numbers of a plain struct of 8-byte members, whatever they stand for.
template <class Plain>
struct Words {
    static_assert(sizeof(Plain) % 8 == 0);
    std::uint64_t word[sizeof(Plain) / 8];
};

/// One slot's struct from, and to, its rows.
template <class Plain>
STYLOBATE_INLINE Plain load_rows(const double* rows, int slots, int slot)
{
    Words<Plain> words;
    long at = slot;
    for (std::uint64_t& word : words.word) {
        word = std::bit_cast<std::uint64_t>(rows[at]);
        at += slots;
    }
    return std::bit_cast<Plain>(words);
}

template <class Plain>
STYLOBATE_INLINE void store_rows(double* rows, int slots, int slot, const Plain& plain)
{
    long at = slot;
    for (const std::uint64_t word : std::bit_cast<Words<Plain>>(plain).word) {
        rows[at] = std::bit_cast<double>(word);
        at += slots;
    }
}

/// Whether an epistyle may have lost a seat: as `LimitStates` has it, with an eye to what the two compute otherwise.
/// @param l, u displacement of the bed's lower and upper block's geometric centre
STYLOBATE_INLINE bool unseats(const Topology& topology, const Bundle& b, int bed, int lane, const Planar<double>& l,
                              const Planar<double>& u)
{
    const int lower = topology.joint[bed].lower, upper = topology.joint[bed].upper;
    const Angle<double> al = angle(l.theta), au = angle(u.theta), turn = angle(u.theta - l.theta);
    const double hu = b.at(OfBlock::half_height, upper, lane);
    const double x = b.at(OfJoint::reference_x, bed, lane) + (u.x - l.x) + hu * au.sine;
    const double y = b.at(OfJoint::height, bed, lane) + (u.y - l.y) - hu * (1 - au.versine);
    const double offset = x * (1 - al.versine) + y * al.sine;
    const double wu = b.at(OfBlock::half_width, upper, lane);
    const double reach = b.at(OfBlock::half_width, lower, lane) + wu * abs_of(1 - turn.versine);
    return !(abs_of(offset) < reach - 1e-6 * wu);
}

/// Whether `LimitStates::check` might find anything: never false where it does.
STYLOBATE_INLINE bool alarmed(const SlotMemory& m, int slot, const Watch& w)
{
    if (w.undecided != 0)
        return true;
    for (int k = m.topology.fixed; k < m.topology.blocks; ++k) {
        const long row = static_cast<long>(k) * OfAlarm::count;
        if (m.bundle.at(OfBlock::y, k, slot) < m.alarms[(row + OfAlarm::low) * m.slots + slot] ||
            abs_of(m.bundle.at(OfBlock::theta, k, slot)) > m.alarms[(row + OfAlarm::turned) * m.slots + slot])
            return true;
    }
    if (w.seated != 0)
        for (int i = 0; i < m.seat_count; ++i) {
            const auto [lower, upper] = m.topology.joint[m.seats[i]];
            if (unseats(m.topology, m.bundle, m.seats[i], slot, centre_of(m.topology, m.bundle, lower, slot),
                        centre_of(m.topology, m.bundle, upper, slot)))
                return true;
        }
    return false;
}

/// The check after a chunk, as far as it is the same every time.
/// @return whether the host is to check instead; `w` is then not to be used
template <class Mechanism>
STYLOBATE_INLINE bool asks(const SlotMemory& m, int slot, Watch& w)
{
    w.steps += static_cast<std::uint64_t>(check_steps(m.topology));
    if constexpr (Mechanism::form == ContactForm::rigid)
        if (leaves_beds(m.topology, m.bundle, slot, w))
            return true;
    return !is_finite(m.topology, m.bundle, slot) || alarmed(m, slot, w) || unbalanced(m.topology, m.bundle, slot, w) ||
           watch_rest(m.topology, m.bundle, slot, false, w);
}

} // namespace detail

/// Steps a slot by up to `chunks` chunks, of as many steps as lie between two checks: less if the host is to check it.
/// @tparam Real, Mechanism, watching, stack as in `Stepper`
template <class Real, class Mechanism, bool watching, bool stack>
struct AdvanceSlot {
    static constexpr bool single = std::is_same_v<Real, float>;
    SlotMemory m;
    int chunks = 1;

    STYLOBATE_INLINE void operator()(int slot) const
    {
        if (m.state[slot] != SlotState::busy)
            return;
        Watch w = detail::load_rows<Watch>(m.watch, m.slots, slot);
        if constexpr (single)
            if (w.steps == 0) // it has just been loaded
                round_lanes(m.topology, m.bundle, m.single, slot, slot + 1);
        for (int chunk = 0; chunk < chunks; ++chunk) {
            step(slot, chunk, w.steps);
            Watch next = w;
            if (detail::asks<Mechanism>(m, slot, next)) {
                m.state[slot] = SlotState::asks;
                break;
            }
            w = next;
        }
        detail::store_rows(m.watch, m.slots, slot, w);
    }

    /// A chunk from the realization's step `done` on.
    STYLOBATE_INLINE void step(int slot, int chunk, std::uint64_t done) const
    {
        const int tables = chunk_steps * (m.topology.model.has_mechanism_rows() ? 2 + OfPitch::count : 1);
        Bundle all = m.bundle;
        bind_tables(m.topology, all, m.tables + static_cast<long>(chunk) * tables * m.slots);
        const Bundle b = lane_of(all, slot);
        const int begin = fill_base(slot, done, b.rows<OfBase::Field>());
        if constexpr (single) {
            const BundleOf<float> rounded = lane_of(m.single, slot);
            for (long k = 0; k < check_steps(m.topology); ++k)
                rounded.rows<OfBase::Field>()[k * m.slots] =
                    static_cast<float>(b.rows<OfBase::Field>()[(begin + k) * m.slots]);
            run(rounded);
            give_lanes(m.topology, m.single, m.bundle, slot, slot + 1, true);
        } else {
            run(b);
        }
    }

    /// @return the row that step `done` has: the recurrence for single precision goes through tables as lanes have them
    STYLOBATE_INLINE int fill_base(int slot, std::uint64_t done, double* table) const
    {
        const double first = static_cast<double>(done);
        if (m.base == BaseTables::by_formula) {
            const FormulaParameters mine = m.formula.of_lane(slot);
            if constexpr (single) {
                const int begin = static_cast<int>(done % chunk_steps);
                detail::fill_base_rows_fast<double, Mechanism>(m.motion, mine, first - begin, table, m.slots);
                return begin;
            } else {
                fill_base_rows<double>(m.motion, mine, first, table, m.slots);
            }
        } else if (m.base == BaseTables::along_samples) {
            fill_sampled_rows(detail::load_rows<SampledMotion>(m.samples, m.slots, slot), first, table, m.slots);
        }
        return 0;
    }

    STYLOBATE_INLINE void run(const BundleOf<Real>& b) const
    {
        if constexpr (Mechanism::form == ContactForm::rigid)
            RigidStepper<Real, Mechanism, Strided>(m.topology, b).run(0, check_steps(m.topology));
        else
            Stepper<Real, Mechanism, watching, stack, Strided>(m.topology, b).run(0, chunk_steps);
    }
};

/// Between packed columns, one whole column after the other, and those of slots; index i is row i / columns of column
/// i % columns.
template <class Number>
struct MoveColumnsOf {
    Number* packed = nullptr;        ///< (columns x rows)
    Number* rows_of_slots = nullptr; ///< (rows x slots)
    const int* slot = nullptr;       ///< (columns) the slot of each
    int columns = 0, rows = 0, slots = 0;
    bool into_slots = false;

    int count() const { return columns * rows; }
    STYLOBATE_INLINE void operator()(int i) const
    {
        const int row = i / columns, column = i % columns;
        Number& one = packed[static_cast<long>(column) * rows + row];
        Number& other = rows_of_slots[static_cast<long>(row) * slots + slot[column]];
        if (into_slots)
            other = one;
        else
            one = other;
    }
};

using MoveColumns = MoveColumnsOf<double>;
using MoveSingleColumns = MoveColumnsOf<float>;

/// Marks slots.
struct MarkSlots {
    SlotState* state = nullptr; ///< (slots)
    const int* slot = nullptr;  ///< (count)
    SlotState mark = SlotState::empty;
    STYLOBATE_INLINE void operator()(int i) const { state[slot[i]] = mark; }
};

/// What a device can do at the most: `count` multiply-adds for each index.
struct MultiplyAdds {
    double* out = nullptr;
    long count = 0;
    STYLOBATE_INLINE void operator()(int i) const { out[i] = multiply_adds<double>(count); }
};

/// Calls f(AdvanceSlot<...>) of the precision, model and topology that the memory has.
/// @tparam Here as in `kernel_table`
template <class Here, class F>
void with_model(const SlotMemory& m, int chunks, F&& f)
{
    const Topology& t = m.topology;
    const bool single = m.in_single; // it has the paper's model and rigid blocks
    const auto of_pairs = [&]<class Real, class Mechanism, bool stack>() {
        using Own = OfFile<Here, Mechanism>;
        t.watched > 0 ? f(AdvanceSlot<Real, Own, true, stack>{m, chunks})
                      : f(AdvanceSlot<Real, Own, false, stack>{m, chunks});
    };
    const auto plain = [&]<class Real, ContactForm form>() {
        t.stack ? of_pairs.template operator()<Real, Plain<form>, true>()
                : of_pairs.template operator()<Real, Plain<form>, false>();
    };
    const auto of_form = [&]<ContactForm form>() {
        if (t.model.mechanisms)
            of_pairs.template operator()<double, Mechanisms<form>, false>();
        else
            plain.template operator()<double, form>();
    };
    using Rigid = OfFile<Here, Plain<ContactForm::rigid>>;
    switch (t.model.form) {
    case ContactForm::area:
        return single ? plain.template operator()<float, ContactForm::area>()
                      : of_form.template operator()<ContactForm::area>();
    case ContactForm::two_corner:
        return of_form.template operator()<ContactForm::two_corner>();
    case ContactForm::points:
        return of_form.template operator()<ContactForm::points>();
    case ContactForm::rigid:
        return single ? f(AdvanceSlot<float, Rigid, false, false>{m, chunks})
                      : f(AdvanceSlot<double, Rigid, false, false>{m, chunks});
    }
}

} // namespace stylobate
