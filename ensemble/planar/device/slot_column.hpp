#pragma once
/// A realization as the numbers of a slot's column (`slot_tasks.hpp`): from a set of one lane, and back into one.

#include "ensemble/planar/planar_model.hpp"

namespace stylobate {

/// State, formula of the base motion, watch and alarms of the set's lane.
/// @param column (column_rows)
void write_column(const LaneSet& one, double* column);
/// What the base goes along, into a column.
/// @param samples where the device has them
void write_samples(const Topology& topology, SampledMotion motion, const double* samples, double* column);
/// Takes state and watch over from a column.
void read_column(LaneSet& one, const double* column);
/// Whether the tables of a realization's base motion are made on the host.
bool tables_given(const Study& study, const LaneSet::Place& place);
/// Makes them, for the chunk that begins at a step.
/// @param tables (table_registers)
void write_tables(LaneSet& one, std::uint64_t step, double* tables);

} // namespace stylobate
