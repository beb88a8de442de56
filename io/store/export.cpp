#include "io/store/export.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_layout.hpp"
#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// The numbers of a row: those of its outcome, or its own.
template <class Of, class F>
void add_numbers(Table& table, const std::vector<ResultRow>& rows, const F& of)
{
    visit_fields(std::type_identity<Of>(), [&](const char* name, auto field, const FieldFacts& facts) {
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
        if (row.inputs.size() != header.input_names.size())
            refuse_damaged(fmt::format("realization {} has {} inputs where {} are named", row.index, row.inputs.size(),
                                       header.input_names.size()));
        if (row.outcome.fall_time_s.size() != header.block_names.size())
            refuse_damaged(fmt::format("realization {} has fall times of {} blocks where {} are named", row.index,
                                       row.outcome.fall_time_s.size(), header.block_names.size()));
    }
    Table table("realizations");
    add_numbers<ResultRow>(table, rows, [](const ResultRow& row) -> const ResultRow& { return row; });
    for (const Table::Column& column : more.columns())
        table.add(column.name, column.values);
    for (std::size_t k = 0; k < header.input_names.size(); ++k) {
        const std::string_view name = header.input_names[k], base = name.substr(0, name.find('['));
        add(table, fmt::format("input_{}{}{}", base, unit_ending_of_input(base), name.substr(base.size())), rows.size(),
            [&](std::size_t i) { return rows[i].inputs[k]; });
    }
    add_numbers<Outcome>(table, rows, [](const ResultRow& row) -> const Outcome& { return row.outcome; });
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

/// A table with a row for each cell, frequency by frequency.
Table table_of_cells(const std::vector<double>& frequency_hz, const std::vector<double>& pga_m_s2)
{
    Table table("cells");
    const std::size_t columns = pga_m_s2.size(), cells = frequency_hz.size() * columns;
    add(table, "cell", cells, [](std::size_t cell) { return std::uint64_t{cell}; });
    add(table, "frequency_hz", cells, [&](std::size_t cell) { return frequency_hz[cell / columns]; });
    add(table, "pga_m_s2", cells, [&](std::size_t cell) { return pga_m_s2[cell % columns]; });
    return table;
}

std::string surface_text(const SurfaceTable& surface)
{
    if (!has_all_cells(surface))
        refuse_damaged(fmt::format("the surface has {} x {} cells, but its tables have other sizes",
                                   surface.frequency_hz.size(), surface.pga_m_s2.size()));
    Table table = table_of_cells(surface.frequency_hz, surface.pga_m_s2);
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
    Table table = table_of_cells(header.frequency_hz, header.pga_m_s2);
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

namespace {

constexpr char head[] = "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\">\n";

void check(const Trajectory& t)
{
    if (t.time_s.empty() || !lists_fit(t))
        throw InputError(
            fmt::format("the trajectory of realization {} has tables of different sizes, or no times: it is "
                        "damaged.\n  Replay the realization into a new file.",
                        t.index));
}

/// The slab that is drawn for the base, in its own frame.
struct Slab {
    double left = 0, right = 0, height = 0;
};

/// As wide as the structure ever lies, and a twentieth more on both sides.
Slab slab_of(const Trajectory& t)
{
    Slab slab;
    for (std::size_t k = 0; k < t.time_s.size(); ++k)
        for (std::size_t i = 0; i < t.blocks(); ++i) {
            const Rectangle block = rectangle_of(t, k, i);
            slab.left = std::min(slab.left, block.x - block.reach());
            slab.right = std::max(slab.right, block.x + block.reach());
        }
    slab.height = 0.05 * (slab.right - slab.left);
    slab.left -= slab.height;
    slab.right += slab.height;
    return slab;
}

/// The text of one time.
class Polygons {
public:
    void add(const std::array<Rectangle::Corner, 4>& corners, std::int64_t id, double rotation, double vx, double vy)
    {
        for (const auto& [x, y] : corners)
            fmt::format_to(std::back_inserter(points_), "{:.10g} {:.10g} 0\n", x, y);
        fmt::format_to(std::back_inserter(ids_), "{} ", id);
        fmt::format_to(std::back_inserter(rotations_), "{:.10g} ", rotation);
        fmt::format_to(std::back_inserter(velocities_), "{:.10g} {:.10g} 0\n", vx, vy);
        ++count_;
    }

    std::string text() const
    {
        const auto array = [](const char* type, const char* name, int components, const std::string& values) {
            return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n"
                               "</DataArray>\n",
                               type, name, components, values);
        };
        std::string connectivity, offsets;
        for (std::size_t i = 0; i < count_; ++i) {
            fmt::format_to(std::back_inserter(connectivity), "{} {} {} {}\n", 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
            fmt::format_to(std::back_inserter(offsets), "{} ", 4 * i + 4);
        }
        return fmt::format(head, "PolyData") +
               fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                           "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<Points>\n",
                           4 * count_, count_) +
               array("Float64", "Points", 3, points_) + "</Points>\n<Polys>\n" +
               array("Int64", "connectivity", 1, connectivity) + array("Int64", "offsets", 1, offsets) +
               "</Polys>\n<CellData Scalars=\"block_id\" Vectors=\"velocity\">\n" +
               array("Int64", "block_id", 1, ids_) + array("Float64", "rotation", 1, rotations_) +
               array("Float64", "velocity", 3, velocities_) + "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    }

private:
    std::string points_, ids_, rotations_, velocities_;
    std::size_t count_ = 0;
};

/// Between the samples before and after number k.
struct Difference {
    std::size_t before, after;
    double time_s;

    Difference(const std::vector<double>& times_s, std::size_t k)
        : before(k > 0 ? k - 1 : k), after(std::min(k + 1, times_s.size() - 1)),
          time_s(times_s[after] - times_s[before])
    {
    }
    double of(const std::vector<double>& values, std::size_t width, std::size_t i) const
    {
        return time_s > 0 ? (values[after * width + i] - values[before * width + i]) / time_s : 0;
    }
};

std::string polygons_at(const Trajectory& t, std::size_t k, const Slab& slab)
{
    Polygons polygons;
    const std::size_t n = t.blocks();
    const Difference rate(t.time_s, k);
    const double base = t["base_x_m"][k], base_velocity = rate.of(t["base_x_m"], 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        Rectangle block = rectangle_of(t, k, i);
        block.x = base + block.x;
        polygons.add(block.corners(), static_cast<std::int64_t>(i), block.turned_rad,
                     base_velocity + rate.of(t["x_m"], n, i), rate.of(t["y_m"], n, i));
    }
    const double left = base + slab.left, right = base + slab.right;
    polygons.add({{{left, -slab.height}, {right, -slab.height}, {right, 0}, {left, 0}}}, -1, 0, base_velocity, 0);
    return polygons.text();
}

} // namespace

void write_vtk(const std::filesystem::path& folder, const std::string& name, const Trajectory& trajectory)
{
    check(trajectory);
    const Slab slab = slab_of(trajectory);
    AtomicFolder out(folder);
    std::string list = fmt::format(head, "Collection") + "<Collection>\n";
    for (std::size_t k = 0; k < trajectory.time_s.size(); ++k) {
        const std::string file = fmt::format("{}_{:05}.vtp", name, k);
        out.write(file, polygons_at(trajectory, k, slab));
        fmt::format_to(std::back_inserter(list), "<DataSet timestep=\"{:.10g}\" part=\"0\" file=\"{}\"/>\n",
                       trajectory.time_s[k], file);
    }
    out.write(name + ".pvd", list + "</Collection>\n</VTKFile>\n");
    out.commit();
}

} // namespace stylobate
