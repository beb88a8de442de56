#include "ensemble/planar/device/slot_column.hpp"

#include "ensemble/planar/device/slot_tasks.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

// What the host and a device may compute otherwise of a height, as a part of it: the alarm is to be on the safe side.
constexpr double height_tolerance = 1e-9;

} // namespace

void write_column(const LaneSet& one, double* column)
{
    assert(one.lanes() == 1);
    const LaneSet::Place& place = one.place(0);
    const Topology& topology = one.model().topology();
    const std::size_t state = bundle_registers(topology) - table_registers(topology);
    for (std::size_t i = 0; i < state; ++i)
        *column++ = one.model().memory()[i];
    for (std::size_t i = 0; i < formula_rows; ++i) // they lie one behind the other
        *column++ = one.bases().parameters(0).cycles_per_step[i];
    detail::store_rows(column, 1, 0, SampledMotion{});
    column += sampled_rows;
    detail::store_rows(column, 1, 0, place.watch);
    column += watch_rows;
    const LimitStates& limits = place.measured.limits;
    for (int k = 0; k < topology.blocks; ++k) {
        const auto i = static_cast<std::size_t>(one.model().order()[static_cast<std::size_t>(k)]);
        const Block& block = place.realization.blocks[i];
        const bool over = k < topology.fixed || limits.fallen(i); // nothing more is to come of it
        const double infinite = std::numeric_limits<double>::infinity();
        const double safe =
            height_tolerance * std::fabs(block.y_m) + 2.001 * std::fabs(block.mechanisms.eccentricity_m);
        *column++ = over ? -infinite : limits.lowest_m(block) + safe;
        *column++ = over ? infinite : limits.turn_limit_rad(i);
    }
}

void write_samples(const Topology& topology, SampledMotion motion, const double* samples, double* column)
{
    motion.sample = samples;
    detail::store_rows(column + (bundle_registers(topology) - table_registers(topology)) + formula_rows, 1, 0, motion);
}

void read_column(LaneSet& one, const double* column)
{
    const Topology& topology = one.model().topology();
    const std::size_t state = bundle_registers(topology) - table_registers(topology);
    for (std::size_t i = 0; i < state; ++i)
        one.model().memory()[i] = *column++;
    column += formula_rows + sampled_rows;
    Watch& watch = one.place(0).watch;
    watch = detail::load_rows<Watch>(column, 1, 0);
    one.bases().first_step(0) = static_cast<double>(watch.steps);
}

bool tables_given(const Study& study, const LaneSet::Place& place)
{
    const BaseMechanisms& base = place.realization.base;
    const bool on_device = !BaseMotion::on_host(study) || BaseMotion::along_shared_samples(study);
    return !on_device || place.realization.vertical != nullptr || place.realization.tilt != nullptr ||
           base.vertical_ratio != 0 || base.pitch_rad_s2_m != 0;
}

void write_tables(LaneSet& one, std::uint64_t step, double* tables)
{
    one.bases().store(0, one.place(0).motions);
    one.bases().first_step(0) = static_cast<double>(step);
    one.model().fill_tables(one.bases(), one.places());
    const Topology& topology = one.model().topology();
    const std::size_t state = bundle_registers(topology) - table_registers(topology);
    const std::size_t registers = table_registers(topology);
    for (std::size_t i = 0; i < registers; ++i)
        tables[i] = one.model().memory()[state + i];
}

} // namespace stylobate
