#pragma once
/// What a warp of a device does with slots (`kernels/lanes/`): it makes the base's motion of a chunk, steps it, and
/// checks the realizations, as `AdvanceSlot` does with one thread for each.

#include "ensemble/planar/device/slot_tasks.hpp"
#include "kernels/lanes/bed_lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace stylobate {

/// Why lanes do not step what is in these slots, for people; null: they do. (Everything else is stepped by threads.)
constexpr const char* why_no_lanes(const SlotMemory& m)
{
    const Topology& t = m.topology;
    if (t.model.rigid())
        return "blocks with rigid contacts are faster on the processor: leave --backend cuda out";
    if (m.in_single)
        return "lanes step in double precision only";
    if (t.model.form != ContactForm::area)
        return "lanes have the contact form area only";
    if (t.model != StepModel{})
        return "lanes have no mechanisms";
    if (m.lane_width == 0)
        return "lanes step structures of 1 to 31 beds, whose blocks have 1 to 4 of them each";
    return nullptr;
}
static_assert(most_lane_beds == 31 && most_beds_of_block == 4);
constexpr bool lanes_serve(const SlotMemory& m)
{
    return why_no_lanes(m) == nullptr;
}

/// Whether the structure is a stack of blocks alone, without watched pairs, and lanes need no lists of it.
constexpr bool plain_stack(const Topology& t)
{
    return t.stack && t.watched == 0 && t.fixed == 1 && t.free_blocks() <= most_lane_blocks && t.top == t.blocks - 1;
}

/// Calls f.operator()<width, lists>() of `BedLanes` for the structure that these slots have. @pre lanes_serve(m)
template <class F>
void with_lanes(const SlotMemory& m, F&& f)
{
    const auto of_widths = [&]<bool lists, int... widths>(std::integer_sequence<int, widths...>)
    {
        ((m.lane_width == widths ? f.template operator()<widths, lists>() : void()), ...);
    };
    if (m.lists.bed != nullptr)
        of_widths.template operator()<true>(std::integer_sequence<int, 6, 7, 10, 15, 31>());
    else
        of_widths.template operator()<false>(std::integer_sequence<int, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12>());
}
static_assert(most_lane_blocks == 12);

/// Warps of a block of a device's threads: one for each scheduler of a multiprocessor.
inline constexpr int block_warps = 4;
/// Slots of such a block, and its shared memory.
template <int width, bool lists>
inline constexpr int block_slots = block_warps* WarpMemory<width, lists>::groups;
template <int width, bool lists>
inline constexpr std::size_t block_shared_bytes = block_warps * sizeof(WarpMemory<width, lists>);

/// A warp's slots: `first_slot` and those behind it, one for each group of its lanes, as far as they are below `count`.
template <class W, int width, bool lists>
class SlotWarp {
public:
    using Lanes = BedLanes<W, width, lists>;
    using Memory = WarpMemory<width, lists>;
    template <class T>
    using Each = typename W::template Each<T>;

    STYLOBATE_LANES SlotWarp(const W& warp, const SlotMemory& m, Memory& shared, int first_slot, int count)
        : w_(warp), m_(m), lanes_(warp, m.topology, m.lists, m.bundle, shared, first_slot,
                                  [&](int slot) { return slot < count && m.state[slot] == SlotState::busy; })
    {
        w_.each([&](int lane) {
            const bool on = lanes_.busy()[lane];
            const int slot = lanes_.slot(lane);
            steps_[lane] = on ? whole(m_.watch[steps_row * m_.slots + slot]) : 0;
            for (int f = 0; f < OfAlarm::count; ++f)
                alarm_[f][lane] =
                    lanes_.moves(lane)
                        ? m_.alarms[(static_cast<long>(lanes_.row(lane)) * OfAlarm::count + f) * m_.slots + slot]
                        : 0;
            if constexpr (lists) {
                seat_[lane] = false;
                for (int i = 0; i < m_.seat_count; ++i)
                    seat_[lane] = seat_[lane] || m_.seats[i] == lanes_.number(lane);
            }
        });
    }

    /// `AdvanceSlot` for all of them.
    STYLOBATE_LANES void run(int chunks)
    {
        if (!w_.any(lanes_.busy()))
            return;
        lanes_.load();
        for (int chunk = 0; chunk < chunks; ++chunk) {
            fill_base(chunk);
            lanes_.run_chunk();
            if (!check(chunk + 1 == chunks))
                continue;
            if (!w_.any(lanes_.busy()))
                return;
            lanes_.load(); // those that have stopped rest from now on: a fall would take the long way of the step
        }
    }

private:
    static constexpr long steps_row = offsetof(Watch, steps) / 8;
    STYLOBATE_LANES static std::uint64_t whole(double word) { return std::bit_cast<std::uint64_t>(word); }

    /// Every displacement of the base is a function of its step alone: the lanes of a realization share them out.
    STYLOBATE_LANES void fill_base(int chunk)
    {
        w_.sync(); // what was in its place has been read
        w_.each([&](int lane) {
            if (!lanes_.busy()[lane])
                return;
            const int slot = lanes_.slot(lane);
            const double first = static_cast<double>(steps_[lane]);
            double* const base = lanes_.base(lane) + 1;
            if (m_.base == BaseTables::by_formula) {
                const FormulaParameters mine = m_.formula.of_lane(slot);
                STYLOBATE_ROLLED
                for (int k = lanes_.number(lane); k < chunk_steps + 2; k += width)
                    lanes_.displacement(lane)[k] =
                        base_displacement<double>(m_.motion, mine, first + static_cast<double>(k - 1));
            } else if (m_.base == BaseTables::along_samples) {
                const SampledMotion motion = detail::load_rows<SampledMotion>(m_.samples, m_.slots, slot);
                STYLOBATE_ROLLED
                for (int k = lanes_.number(lane); k < chunk_steps; k += width)
                    base[k] = sampled_difference(motion, (first + k) * motion.ratio);
            } else {
                const double* const table = m_.tables + static_cast<long>(chunk) * chunk_steps * m_.slots + slot;
                STYLOBATE_ROLLED
                for (int k = lanes_.number(lane); k < chunk_steps; k += width)
                    base[k] = table[static_cast<long>(k) * m_.slots];
            }
        });
        w_.sync();
        if (m_.base != BaseTables::by_formula)
            return;
        w_.each([&](int lane) {
            if (!lanes_.busy()[lane])
                return;
            const double first = static_cast<double>(steps_[lane]);
            const double* const u = lanes_.displacement(lane);
            const double end = motion_end<double>(m_.motion, m_.formula.of_lane(lanes_.slot(lane)));
            STYLOBATE_ROLLED
            for (int k = lanes_.number(lane); k < chunk_steps; k += width)
                lanes_.base(lane)[1 + k] =
                    second_difference(u[k], u[k + 1], u[k + 2], first + static_cast<double>(k), end);
        });
        w_.sync();
    }

    /// The check after a chunk: a lane looks at its block, the lowest one of a realization at its rest. The column is
    /// written where somebody is going to read it.
    /// @param last of the launch
    /// @return whether a realization has stopped, for the host to check
    STYLOBATE_LANES bool check(bool last)
    {
        Each<bool> alarms, asks, writes;
        w_.each([&](int lane) {
            constexpr double most = 1e300; // so many of these have a finite sum (`is_finite`)
            steps_[lane] += chunk_steps;
            const Planar<double> at = of(lanes_.position(), lane);
            const bool finite = abs_of(at.x) < most && abs_of(at.y) < most && abs_of(at.theta) < most &&
                                abs_of(lanes_.kinetic(lane)) < most;
            alarms[lane] = lanes_.moves(lane) && (!finite || at.y < alarm_[OfAlarm::low][lane] ||
                                                  abs_of(at.theta) > alarm_[OfAlarm::turned][lane]);
            asks[lane] = false;
        });
        const Each<bool> alarmed = any_of_group(alarms);
        const Each<bool> unseated = unseats();
        Each<Watch> next; // the slot's is as before the check until it is known that the host need not see it
        lanes_.slip_and_top([&](int lane, double slip, double top) {
            if (!lanes_.busy()[lane])
                return;
            Watch& w = next[lane];
            w = detail::load_rows<Watch>(m_.watch, m_.slots, lanes_.slot(lane));
            w.steps = steps_[lane];
            asks[lane] = alarmed[lane] || (unseated[lane] && w.seated != 0) || w.undecided != 0 ||
                         watch_rest(RestSigns{lanes_.kinetic(lane), lanes_.potential(lane), slip, top}, false, w);
        });
        const Each<bool> asked = any_of_group(asks); // only the lowest lanes do
        w_.each([&](int lane) { writes[lane] = lanes_.busy()[lane] && (last || asked[lane] || audit_due(lane)); });
        const bool written = w_.any(writes);
        if (written)
            lanes_.store();
        w_.each([&](int lane) {
            if (!lanes_.busy()[lane] || lanes_.number(lane) != 0)
                return;
            const int slot = lanes_.slot(lane);
            asks[lane] = asks[lane] || (written && unbalanced(m_.topology, m_.bundle, slot, next[lane]));
            if (asks[lane])
                m_.state[slot] = SlotState::asks;
            else
                detail::store_rows(m_.watch, m_.slots, slot, next[lane]);
        });
        const bool some = w_.any(asks);
        if (some)
            lanes_.stop(any_of_group(asks));
        return some;
    }

    STYLOBATE_LANES Each<bool> any_of_group(const Each<bool>& flags) const
    {
        const Each<std::uint32_t> votes = w_.votes_of_group(flags, lanes_.group(), width);
        Each<bool> found;
        w_.each([&](int lane) { found[lane] = votes[lane] != 0; });
        return found;
    }

    template <class Real>
    STYLOBATE_LANES static Planar<double> of(Planar<Real> all, int lane)
    {
        return {W::of(all.x, lane), W::of(all.y, lane), W::of(all.theta, lane)};
    }

    /// Whether an epistyle of the lane's realization may have lost a seat.
    STYLOBATE_LANES Each<bool> unseats() const
    {
        Each<bool> found;
        w_.each([&](int lane) { found[lane] = false; });
        if constexpr (lists) {
            if (m_.seat_count == 0)
                return found;
            const auto below = lanes_.position_below();
            w_.each([&](int lane) {
                if (seat_[lane] && lanes_.moves(lane))
                    found[lane] = detail::unseats(m_.topology, m_.bundle, lanes_.number(lane), lanes_.slot(lane),
                                                  of(below, lane), of(lanes_.position(), lane));
            });
            return any_of_group(found);
        }
        return found;
    }

    STYLOBATE_LANES bool audit_due(int lane) const
    {
        return steps_[lane] % (audit_chunks * chunk_steps) < static_cast<std::uint64_t>(chunk_steps);
    }

    const W& w_;
    const SlotMemory& m_;
    Lanes lanes_;
    Each<std::uint64_t> steps_;
    Each<double> alarm_[OfAlarm::count];
    Each<bool> seat_; ///< whether an epistyle lies on the lane's bed
};

} // namespace stylobate
