#include "io/store/export.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_layout.hpp"
#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// A column with a value of each row.
template <class F>
void add(Table& table, std::string name, std::size_t rows, const F& value)
{
    std::vector<std::decay_t<decltype(value(0))>> values;
    for (std::size_t i = 0; i < rows; ++i)
        values.push_back(value(i));
    table.add(std::move(name), std::move(values));
}

/// An enumerator as its name, a number as it is; that of a row as files have it.
template <class Value>
auto in_table(const FieldFacts& facts, const Value& value)
{
    if constexpr (std::is_enum_v<Value>)
        return std::string(to_string(value));
    else
        return without_none(facts, value);
}

/// The numbers of a row that the model has: those of its outcome, or its own.
template <class Of, class F>
void add_numbers(Table& table, int dimensions, const std::vector<ResultRow>& rows, const F& of)
{
    visit_fields(std::type_identity<Of>(), [&](const char* name, auto field, const FieldFacts& facts) {
        if (has_model(facts.models, dimensions))
            add(table, name, rows.size(), [&](std::size_t i) { return in_table(facts, of(rows[i]).*field); });
    });
}

[[noreturn]] void refuse_damaged(const std::string& text)
{
    throw InputError(text + ": the results are damaged.\n  Run the study again into a new file.");
}

std::string realizations_text(const ResultHeader& header, const std::vector<ResultRow>& rows, const Table& more)
{
    for (const Table::Column& column : more.columns())
        if (column.shape != Table::Shape{rows.size()})
            refuse_damaged(fmt::format("{} realizations do not have a value of '{}' each", rows.size(), column.name));
    for (const ResultRow& row : rows) {
        if (header.cells() > 0 && row.cell >= header.cells())
            refuse_damaged(fmt::format("realization {} is in cell {} of {}", row.index, row.cell, header.cells()));
        if (row.inputs.size() != header.input_names.size())
            refuse_damaged(fmt::format("realization {} has {} inputs where {} are named", row.index, row.inputs.size(),
                                       header.input_names.size()));
        if (row.outcome.fall_time_s.size() != header.block_names.size())
            refuse_damaged(fmt::format("realization {} has fall times of {} blocks where {} are named", row.index,
                                       row.outcome.fall_time_s.size(), header.block_names.size()));
    }
    Table table("realizations");
    add_numbers<ResultRow>(table, header.dimensions, rows,
                           [](const ResultRow& row) -> const ResultRow& { return row; });
    if (!header.direction_deg.empty())
        add(table, direction_rows.key, rows.size(),
            [&](std::size_t i) { return header.direction_deg[rows[i].cell / header.pga_m_s2.size()]; });
    for (const Table::Column& column : more.columns())
        table.add(column.name, column.values);
    for (std::size_t k = 0; k < header.input_names.size(); ++k) {
        const std::string_view name = header.input_names[k], base = name.substr(0, name.find('['));
        add(table, fmt::format("input_{}{}{}", base, unit_ending_of_input(base), name.substr(base.size())), rows.size(),
            [&](std::size_t i) { return rows[i].inputs[k]; });
    }
    add_numbers<Outcome>(table, header.dimensions, rows,
                         [](const ResultRow& row) -> const Outcome& { return row.outcome; });
    visit_lists(header, [&](const char* name, auto field, std::size_t width, const FieldFacts& facts) {
        for (std::size_t k = 0; k < width; ++k)
            add(table, fmt::format("{}[{}]", name, k), rows.size(),
                [&](std::size_t i) { return without_none(facts, (rows[i].outcome.*field)[k]); });
    });
    return csv_text(table);
}

/// Which block is which: the columns of the other tables have their numbers only.
std::string blocks_text(const ResultHeader& header)
{
    Table table("blocks");
    add(table, "block", header.block_names.size(), [](std::size_t i) { return std::uint64_t{i}; });
    table.add("name", header.block_names);
    return csv_text(table);
}

/// A table with a row for each cell, row by row.
Table table_of_cells(const SurfaceAxes& axes)
{
    Table table("cells");
    const std::size_t columns = axes.pga_m_s2.size(), cells = axes.cells();
    add(table, "cell", cells, [](std::size_t cell) { return std::uint64_t{cell}; });
    add(table, axes.row_quantity().key, cells, [&](std::size_t cell) { return axes.rows()[cell / columns]; });
    add(table, "pga_m_s2", cells, [&](std::size_t cell) { return axes.pga_m_s2[cell % columns]; });
    return table;
}

std::string surface_text(const SurfaceTable& surface)
{
    if (!has_all_cells(surface))
        refuse_damaged(fmt::format("the surface has {} x {} cells, but its tables have other sizes",
                                   surface.rows().size(), surface.pga_m_s2.size()));
    Table table = table_of_cells(surface);
    visit_fields(std::type_identity<SurfaceTable>(),
                 [&](const char* name, auto field, auto) { table.add(name, surface.*field); });
    const std::size_t cells = surface.trials.size();
    table.add("interval", std::vector<std::string>(cells, surface.interval));
    if (surface.method.size() == cells)
        add(table, "method", cells, [&](std::size_t cell) { return std::string(to_string(surface.method[cell])); });
    return csv_text(table);
}

std::string counts_text(const ResultHeader& header, const Tally& tally)
{
    Table table = table_of_cells(header);
    visit_fields(std::type_identity<Tally>(), [&](const std::string& name, auto field, std::string_view by, auto) {
        const std::size_t width = tally.width(by);
        for (std::size_t k = 0; k < width; ++k)
            add(table,
                by == "limit_state" ? header.limit_states[k]
                : by == "block"     ? fmt::format("{}[{}]", name, k)
                                    : name,
                tally.cells(), [&](std::size_t cell) { return (tally.*field)[cell * width + k]; });
    });
    return csv_text(table);
}

/// @param table a file of this name with this text, beside those that every result has
void write_tables(const std::filesystem::path& folder, const ResultHeader& header, const SurfaceTable& surface,
                  const char* table, const std::string& text)
{
    const bool has_surface = surface.cells() > 0;
    const std::string cells = has_surface ? surface_text(surface) : std::string();

    make_folder(folder);
    AtomicFile table_file(folder / table);
    table_file.write(text);
    AtomicFile blocks_file(folder / "blocks.csv");
    blocks_file.write(blocks_text(header));
    if (has_surface) {
        AtomicFile surface_file(folder / "surface.csv");
        surface_file.write(cells);
        surface_file.commit();
    }
    blocks_file.commit();
    table_file.commit();
}

} // namespace

void write_csv(const std::filesystem::path& folder, const ResultHeader& header, const std::vector<ResultRow>& rows,
               const SurfaceTable& surface, const Table& more)
{
    write_tables(folder, header, surface, "realizations.csv", realizations_text(header, rows, more));
}

void write_counts_csv(const std::filesystem::path& folder, const ResultHeader& header, const Tally& tally,
                      const SurfaceTable& surface)
{
    write_tables(folder, header, surface, "counts.csv", counts_text(header, tally));
}

void write_trajectory_csv(const std::filesystem::path& file, const Trajectory& trajectory)
{
    if (!lists_fit(trajectory))
        throw InputError(fmt::format("the trajectory of realization {} has tables of different sizes: it is damaged.\n"
                                     "  Replay the realization into a new file.",
                                     trajectory.index));
    const std::size_t blocks = trajectory.blocks(), samples = trajectory.time_s.size();
    Table table("trajectory");
    const auto add_lists = [&](ListOf of, std::size_t block) {
        visit_lists(trajectory, [&](const TrajectoryChannel& channel, const std::vector<double>& list) {
            if (channel.of == of)
                add(table, of == ListOf::times ? channel.name : fmt::format("{}[{}]", channel.name, block), samples,
                    [&](std::size_t t) {
                        return list[of == ListOf::times ? t : of == ListOf::blocks ? block : t * blocks + block];
                    });
        });
    };
    add_lists(ListOf::times, 0);
    for (const ListOf of : {ListOf::poses, ListOf::blocks})
        for (std::size_t block = 0; block < blocks; ++block)
            add_lists(of, block);
    AtomicFile out(file);
    out.write(csv_text(table));
    out.commit();
}

} // namespace stylobate
