#pragma once
/// Every number of every column, by lanes and by threads.

#include "ensemble/planar/device/slots.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/engine/lanes/warp_device.hpp"
#include "tests/ensemble/engine/slot_studies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace stylobate {

/// Steps everything by lanes, and by threads beforehand, from the same numbers; compares all numbers of the columns,
/// and what is to be asked, after every launch.
class BothWays : public WarpDevice {
public:
    using WarpDevice::WarpDevice;
    void advance(const SlotMemory& m, int chunks, int count) override
    {
        const auto slots = static_cast<std::size_t>(m.slots);
        double* const columns = m.bundle.begin[0];
        const std::vector<double> before(columns, columns + column_rows(m.topology) * slots);
        const std::vector<SlotState> states_before(m.state, m.state + slots);
        threads_->advance(m, chunks, count);
        const std::vector<double> want(columns, columns + before.size());
        const std::vector<SlotState> states(m.state, m.state + slots);
        std::copy(before.begin(), before.end(), columns);
        std::copy(states_before.begin(), states_before.end(), m.state);
        WarpDevice::advance(m, chunks, count);
        for (std::size_t slot = 0; slot < slots; ++slot) {
            EXPECT_EQ(m.state[slot], states[slot]) << "slot " << slot;
            asked += m.state[slot] == SlotState::asks;
            if (states_before[slot] != SlotState::busy)
                continue;
            for (std::size_t row = 0; row < column_rows(m.topology); ++row) {
                if (nobody_reads(m.topology, row))
                    continue;
                const std::size_t at = row * slots + slot;
                ++compared;
                const bool same = std::bit_cast<std::uint64_t>(columns[at]) == std::bit_cast<std::uint64_t>(want[at]) ||
                                  (std::isnan(columns[at]) && std::isnan(want[at])); // (of either sign)
                if (!same && ++differ <= 20)
                    ADD_FAILURE() << "slot " << slot << ", row " << row << ": " << columns[at] << ", wanted "
                                  << want[at];
            }
        }
    }
    long compared = 0, differ = 0, asked = 0;

private:
    /// What pairs do to fixed blocks.
    static bool nobody_reads(const Topology& topology, std::size_t row)
    {
        const std::size_t field = row % OfBlock::count;
        return row < static_cast<std::size_t>(topology.fixed) * OfBlock::count && field >= OfBlock::force_x &&
               field <= OfBlock::moment;
    }
    std::shared_ptr<Device> threads_ = host_device();
};

/// Runs a study both ways, a few slots at a time, and against the processor's lanes.
/// @return the device that it ran on
inline std::shared_ptr<BothWays> same_in_lanes(const Study& study, const Motions& motions = {},
                                               const WarpDevice::Step& step = advance_in_lanes)
{
    const EnsembleRun want = run_all(study, {best_isa(), 2}, motions);
    const auto device = std::make_shared<BothWays>(step);
    RunOptions options{Isa::scalar, 2};
    options.devices = {device};
    options.slots = 23;
    options.few = 0;
    options.longest_on_host = 0;
    EXPECT_EQ(run_all(study, options, motions).outcomes, want.outcomes);
    EXPECT_EQ(device->differ, 0);
    EXPECT_GT(device->compared, 0);
    EXPECT_EQ(device->by_threads(), 0);
    return device;
}

/// A column of so many free drums, as slender as one of six, under a few cycles.
inline Study of_blocks(int free, std::vector<std::string> settings)
{
    settings.insert(settings.begin(), {"excitation.cycles=4", "excitation.ramp_cycles=1",
                                       "surface.frequency_hz={ from = 2.5, to = 5.0, count = 2 }"});
    settings.push_back("structure.blocks=" + std::to_string(free + 1));
    settings.push_back("structure.drum_height_m=" + std::to_string(0.174 / free));
    return column(settings);
}

/// So many columns of so many drums each, under epistyles: what falls is followed to its rest.
inline Study colonnade_of(int columns, int drums, std::vector<std::string> settings)
{
    settings.insert(settings.begin(),
                    {"structure.columns=" + std::to_string(columns), "structure.blocks=" + std::to_string(drums)});
    if (columns > 3) // epistyles of one mass have one length
        settings.emplace_back("structure.epistyle_length_m=0.09");
    return colonnade(settings);
}

/// The first launches of a few realizations from all over a ready study, both ways.
/// @param file in studies/inputs
/// @return the device; null: its realizations are not stepped by lanes
inline std::unique_ptr<BothWays> begin_in_lanes(const std::string& file, int launches,
                                                const WarpDevice::Step& step = advance_in_lanes)
{
    constexpr int slots = 7;
    if (file == "record.toml") // it waits for a record of the user's
        return nullptr;
    const LoadedStudy loaded = LoadedStudy::from_file(inputs + file, {});
    if (loaded.study().structure.spatial() || loaded.study().kind == StudyKind::single)
        return nullptr;
    const Realization pattern = loaded.sampler().realization(0);
    auto device = std::make_unique<BothWays>(step);
    SlotSet set(loaded.study(), loaded.record(), pattern, *device, slots, slots);
    if (!set.why_slow().empty())
        return nullptr;
    for (int slot = 0; slot < slots; ++slot)
        set.load(slot, loaded.sampler().realization(static_cast<std::uint64_t>(slot) * (loaded.study().total() - 1) /
                                                    (slots - 1)));
    for (int launch = 0; launch < launches; ++launch)
        set.advance();
    EXPECT_EQ(device->differ, 0) << file;
    EXPECT_EQ(device->by_lanes(), launches) << file;
    return device;
}

/// What is not a number, and a balance of energy out of bounds, stop a lane as they stop a thread: steps of up to four
/// times their length, and a motion that is no number.
inline void broken_are_set_aside(const WarpDevice::Step& step = advance_in_lanes)
{
    constexpr int slots = 16;
    const Study study = of_blocks(6, {"study.realizations=3"});
    const Sampler sampler(study, nullptr);
    BothWays device(step);
    SlotSet set(study, nullptr, sampler.realization(0), device, slots, slots);
    for (int slot = 0; slot < slots; ++slot) {
        Realization r = sampler.realization(static_cast<std::uint64_t>(slot));
        r.step_s *= 1 + 0.2 * slot;
        if (slot == 4)
            r.pga_m_s2 = std::numeric_limits<double>::quiet_NaN();
        set.load(slot, r);
    }
    int invalid = 0;
    while (set.active() > 0) {
        set.advance();
        for (int slot = 0; slot < set.lanes(); ++slot)
            if (!set.free(slot) && set.done(slot)) {
                invalid += set.outcome(slot)->state == State::invalid;
                set.clear(slot);
            }
    }
    EXPECT_GT(invalid, 5);
    EXPECT_EQ(device.differ, 0);
}

} // namespace stylobate
