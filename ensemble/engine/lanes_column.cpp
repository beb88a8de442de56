/// Lanes whose realizations a device steps (`lanes.hpp`): the same state, watch and limit states, packed as its slots
/// have them.

#include "ensemble/engine/lanes.hpp"
#include "ensemble/engine/slot_tasks.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

// What the host and a device may compute otherwise of a height, as a part of it: the alarm is to be on the safe side.
constexpr double height_tolerance = 1e-9;

} // namespace

void LaneSet::write_column(int lane, double* column, const double* samples) const
{
    const Place& place = places_[static_cast<std::size_t>(lane)];
    const auto at = static_cast<std::size_t>(lane);
    const std::size_t state = bundle_registers(topology_) - table_registers(topology_);
    for (std::size_t i = 0; i < state; ++i)
        *column++ = memory_[i * lanes_ + at];
    for (std::size_t i = 0; i < formula_rows; ++i) // they lie one behind the other
        *column++ = parameters_.cycles_per_step[i * lanes_ + at];
    SampledMotion motion;
    if (samples != nullptr) {
        motion = place.motion.samples();
        motion.sample = samples;
    }
    detail::store_rows(column, 1, 0, motion);
    column += sampled_rows;
    detail::store_rows(column, 1, 0, place.watch);
    column += watch_rows;
    for (int k = 0; k < topology_.blocks; ++k) {
        const auto i = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
        const Block& block = place.realization.blocks[i];
        const bool over = k < topology_.fixed || place.limits.fallen(i); // nothing more is to come of it
        const double infinite = std::numeric_limits<double>::infinity();
        const double safe = height_tolerance * std::fabs(block.y_m) + 2.001 * std::fabs(block.extension.eccentricity_m);
        *column++ = over ? -infinite : place.limits.lowest_m(block) + safe;
        *column++ = over ? infinite : place.limits.turn_limit_rad(i);
    }
}

void LaneSet::read_column(int lane, const double* column)
{
    const std::size_t state = bundle_registers(topology_) - table_registers(topology_);
    for (std::size_t i = 0; i < state; ++i)
        memory_[i * lanes_ + static_cast<std::size_t>(lane)] = *column++;
    column += formula_rows + sampled_rows;
    Watch& watch = places_[static_cast<std::size_t>(lane)].watch;
    watch = detail::load_rows<Watch>(column, 1, 0);
    first_step_[lane] = static_cast<double>(watch.steps);
}

bool LaneSet::tables_given(int lane) const
{
    const Place& place = places_[static_cast<std::size_t>(lane)];
    const BaseExtension& base = place.realization.base;
    const bool on_device = !BaseMotion::on_host(study_) || BaseMotion::along_shared_samples(study_);
    return !on_device || place.vertical || base.vertical_ratio != 0 || base.pitch_rad_s2_m != 0;
}

void LaneSet::write_tables(int lane, std::uint64_t step, double* tables)
{
    assert(lanes_ == 1 && "the tables of all lanes are made at once");
    first_step_[lane] = static_cast<double>(step);
    fill_tables();
    const std::size_t state = bundle_registers(topology_) - table_registers(topology_);
    for (std::size_t i = 0; i < table_registers(topology_); ++i)
        tables[i] = memory_[state + i];
}

} // namespace stylobate
