#include "io/store/export_csv.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_layout.hpp"
#include "io/tables/csv.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace stylobate {
namespace {

/// "normal_stiffness[3]" -> "input_normal_stiffness_n_m2[3]".
std::string input_column(const std::string& name)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> units{{
        {"normal_stiffness", "_n_m2"},
        {"tangential_stiffness", "_n_m"},
        {"drum_width", "_m"},
        {"drum_height", "_m"},
        {"drum_offset", "_m"},
        {"density", "_kg_m3"},
        {"tilt", "_rad"},
        {"phase", "_rad"},
        {"pulse_frequency", "_hz"},
    }};
    const std::string_view quantity = std::string_view(name).substr(0, name.find('['));
    for (const auto& [known, unit] : units)
        if (quantity == known)
            return fmt::format("input_{}{}{}", quantity, unit, std::string_view(name).substr(quantity.size()));
    return "input_" + name;
}

/// Calls f(name of the column, value) for the scalar outcomes, in the order of the store.
template <class F>
void visit_outcome(const ResultRow& row, F&& f)
{
    constexpr std::string_view group = "outcome/";
    visit_fields(row, [&](std::string_view path, const char*, const auto& value) {
        if (path.starts_with(group))
            f(path.substr(group.size()), without_none(path, value));
    });
}

/// An enumerator as its name, a number as it is.
template <class Value>
auto word(const Value& value)
{
    if constexpr (std::is_enum_v<Value>)
        return to_string(value);
    else
        return value;
}

std::string realizations_text(const ResultHeader& header, const std::vector<ResultRow>& rows, const Table& more)
{
    for (const Table::Column& column : more.columns())
        if (column.shape != Table::Shape{rows.size()})
            throw InputError(fmt::format("{} realizations do not have a value of '{}' each: the results are damaged.\n"
                                         "  Run the study again into a new file.",
                                         rows.size(), column.name));
    std::string text;
    {
        CsvRow line(text);
        line << "index"
             << "cell"
             << "frequency_hz"
             << "pga_m_s2";
        for (const Table::Column& column : more.columns())
            line << column.name;
        for (const std::string& name : header.input_names)
            line << input_column(name);
        visit_outcome(ResultRow{}, [&](std::string_view name, const auto&) { line << name; });
        for (std::size_t i = 0; i < header.block_names.size(); ++i)
            line << fmt::format("fall_time_s[{}]", i);
        for (std::size_t i = 0; i < header.bed_names.size(); ++i)
            line << fmt::format("bed_offset_m[{}]", i);
        for (std::size_t i = 0; !header.bed_names.empty() && i < header.block_names.size(); ++i)
            line << fmt::format("rotation_rad[{}]", i);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ResultRow& row = rows[i];
        if (row.inputs.size() != header.input_names.size())
            throw InputError(fmt::format("realization {} has {} inputs where {} are named: the results are damaged.\n"
                                         "  Run the study again into a new file.",
                                         row.index, row.inputs.size(), header.input_names.size()));
        if (row.outcome.fall_time_s.size() != header.block_names.size())
            throw InputError(fmt::format("realization {} has fall times of {} blocks where {} are named: the results "
                                         "are damaged.\n  Run the study again into a new file.",
                                         row.index, row.outcome.fall_time_s.size(), header.block_names.size()));
        CsvRow line(text);
        line << row.index << row.cell << row.frequency_hz << row.pga_m_s2;
        for (const Table::Column& column : more.columns())
            std::visit([&](const auto& values) { line << values[i]; }, column.values);
        for (const double value : row.inputs)
            line << value;
        visit_outcome(row, [&](std::string_view, const auto& value) { line << word(value); });
        for (const double value : row.outcome.fall_time_s)
            line << without_none(result_names::fall_time, value);
        if (!header.bed_names.empty())
            for (const auto* list : {&row.outcome.bed_offset_m, &row.outcome.rotation_rad})
                for (const double value : *list)
                    line << value;
    }
    return text;
}

/// Which block is which: the columns of the other tables have their numbers only.
std::string blocks_text(const ResultHeader& header)
{
    std::string text;
    CsvRow(text) << "block"
                 << "name";
    for (std::size_t i = 0; i < header.block_names.size(); ++i)
        CsvRow(text) << i << header.block_names[i];
    return text;
}

std::string surface_text(const SurfaceTable& surface)
{
    const std::size_t columns = surface.pga_m_s2.size();
    const std::size_t cells = surface.frequency_hz.size() * columns;
    if (surface.trials.size() != cells || surface.collapses.size() != cells || surface.probability.size() != cells ||
        surface.lower.size() != cells || surface.upper.size() != cells)
        throw InputError(fmt::format("the surface has {} x {} cells, but its tables have other sizes: the results are "
                                     "damaged.\n  Run the study again into a new file.",
                                     surface.frequency_hz.size(), columns));
    const bool adaptive = surface.method.size() == cells;
    std::string text;
    {
        CsvRow line(text);
        line << "cell"
             << "frequency_hz"
             << "pga_m_s2"
             << "trials"
             << "collapses"
             << "probability"
             << "lower"
             << "upper"
             << "interval";
        if (adaptive)
            line << "method";
    }
    for (std::size_t cell = 0; cell < cells; ++cell) {
        CsvRow line(text);
        line << cell << surface.frequency_hz[cell / columns] << surface.pga_m_s2[cell % columns] << surface.trials[cell]
             << surface.collapses[cell] << surface.probability[cell] << surface.lower[cell] << surface.upper[cell]
             << surface.interval;
        if (adaptive)
            line << to_string(surface.method[cell]);
    }
    return text;
}

std::string counts_text(const ResultHeader& header, const Tally& tally)
{
    const std::size_t columns = header.pga_m_s2.size();
    std::string text;
    {
        CsvRow line(text);
        line << "cell"
             << "frequency_hz"
             << "pga_m_s2"
             << "trials"
             << "invalid";
        for (const std::string& name : header.limit_states)
            line << name;
        for (std::size_t i = 0; i < tally.blocks; ++i)
            line << fmt::format("first_fallen[{}]", i);
        line << "first_together";
    }
    for (std::size_t cell = 0; cell < tally.cells(); ++cell) {
        CsvRow line(text);
        line << cell << header.frequency_hz[cell / columns] << header.pga_m_s2[cell % columns] << tally.trials[cell]
             << tally.invalid[cell];
        for (std::size_t i = 0; i < tally.limit_states; ++i)
            line << tally.reached[cell * tally.limit_states + i];
        for (std::size_t i = 0; i < tally.blocks; ++i)
            line << tally.first[cell * tally.blocks + i];
        line << tally.first_together[cell];
    }
    return text;
}

/// @param table a file of this name with this text, beside those that every result has
void write_tables(const std::filesystem::path& folder, const ResultHeader& header, const SurfaceTable& surface,
                  const char* table, const std::string& text)
{
    const bool has_surface = !surface.frequency_hz.empty() && !surface.pga_m_s2.empty();
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
    const std::size_t blocks = trajectory.blocks();
    const std::size_t samples = trajectory.time_s.size();
    if (trajectory.half_height_m.size() != blocks || trajectory.rest_x_m.size() != blocks ||
        trajectory.rest_y_m.size() != blocks || trajectory.base_x_m.size() != samples ||
        trajectory.x_m.size() != samples * blocks || trajectory.y_m.size() != samples * blocks ||
        trajectory.theta_rad.size() != samples * blocks)
        throw InputError(fmt::format("the trajectory of realization {} has tables of different sizes: it is damaged.\n"
                                     "  Replay the realization into a new file.",
                                     trajectory.index));
    std::string text;
    {
        CsvRow line(text);
        line << "time_s"
             << "base_x_m";
        for (std::size_t i = 0; i < blocks; ++i)
            line << fmt::format("x_m[{}]", i) << fmt::format("y_m[{}]", i) << fmt::format("theta_rad[{}]", i);
        for (std::size_t i = 0; i < blocks; ++i)
            line << fmt::format("rest_x_m[{}]", i) << fmt::format("rest_y_m[{}]", i)
                 << fmt::format("half_width_m[{}]", i) << fmt::format("half_height_m[{}]", i);
    }
    for (std::size_t t = 0; t < samples; ++t) {
        CsvRow line(text);
        line << trajectory.time_s[t] << trajectory.base_x_m[t];
        for (std::size_t i = t * blocks; i < (t + 1) * blocks; ++i)
            line << trajectory.x_m[i] << trajectory.y_m[i] << trajectory.theta_rad[i];
        for (std::size_t i = 0; i < blocks; ++i)
            line << trajectory.rest_x_m[i] << trajectory.rest_y_m[i] << trajectory.half_width_m[i]
                 << trajectory.half_height_m[i];
    }
    AtomicFile out(file);
    out.write(text);
    out.commit();
}

} // namespace stylobate
