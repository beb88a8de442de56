/// `stylobate export`: results in other tools' formats.

#include "ensemble/input_error.hpp"
#include "io/export_csv.hpp"
#include "io/plot_order.hpp"
#include "io/plot_slice.hpp"
#include "io/plot_strip.hpp"
#include "io/plot_surface.hpp"
#include "io/result_store.hpp"
#include "io/study_file.hpp"
#include "studies/command.hpp"
#include "studies/json.hpp"
#include "studies/limit_state.hpp"
#include "studies/loaded_study.hpp"
#include "studies/surface.hpp"
#include "studies/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

fs::path beside(const std::string& results, const std::string& ending)
{
    const fs::path path(results);
    return path.parent_path() / (path.stem().string() + ending);
}

struct Followed {
    Trajectory trajectory;
    std::vector<double> fall_time_s; ///< (blocks)
};

/// The trajectory that the file holds, or else the realization run again.
Followed trajectory_of(const CommonOptions& options, const ResultReader& reader, const std::string& results,
                       std::uint64_t index)
{
    const std::vector<std::uint64_t> stored = reader.trajectory_indices();
    if (std::find(stored.begin(), stored.end(), index) != stored.end())
        return {reader.trajectory(index), reader.row(index).outcome.fall_time_s};
    const ResultHeader& header = reader.header();
    if (index < header.first || index >= header.first + header.total)
        throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", index, results, header.first,
                                     header.first + header.total - 1));
    FollowedRealization f = follow(LoadedStudy::from_results(header, results, options.set), index, options.isa());
    return {std::move(f.trajectory), std::move(f.outcome.fall_time_s)};
}

void check_complete(const ResultReader& reader, const std::string& results)
{
    if (!reader.complete())
        throw InputError(fmt::format("{}: the run is not complete; run the same study again to continue it", results));
}

/// Whether the realizations were followed beyond the first fall.
bool followed_to_rest(const ResultReader& reader, const std::string& results)
{
    return parse_study(reader.header().study_toml, results + " (its study)").outcome.follow == Follow::rest;
}

/// The surface of the store, or that of another limit state from the rows.
SurfaceTable finished_surface(const ResultReader& reader, const std::string& results, LimitState limit)
{
    const ResultHeader& header = reader.header();
    if (header.frequency_hz.empty())
        throw InputError(fmt::format("{}: a result of kind '{}' has no surface; use --picture strip or order", results,
                                     header.kind));
    check_complete(reader, results);
    if (limit == LimitState::collapse)
        return reader.surface();
    if (limit == LimitState::total && !followed_to_rest(reader, results))
        throw InputError(fmt::format("--limit total: {} followed each realization until its first fall only. Run the "
                                     "study again with outcome.follow = \"rest\".",
                                     results));
    SurfaceCounts counts(header.frequency_hz, header.pga_m_s2, limit);
    for (const ResultRow& row : reader.rows())
        counts.add(row);
    return counts.table();
}

std::string strip_title(const ResultReader& reader, const std::string& results, std::uint64_t index)
{
    std::string title = fmt::format("{}, realization {}", fs::path(results).stem().string(), index);
    if (reader.has(index)) {
        const ResultRow row = reader.row(index);
        if (row.frequency_hz > 0)
            title += fmt::format(": {:.3g} Hz, {:.3g} m/s²", row.frequency_hz, row.pga_m_s2);
        title += fmt::format(", {}", to_string(row.outcome.state));
    }
    return title;
}

/// Which blocks fall, in which order and when: of all realizations, or of one cell.
void export_order(const ResultReader& reader, const std::string& results, long long cell, const fs::path& png)
{
    const ResultHeader& header = reader.header();
    check_complete(reader, results);
    std::vector<ResultRow> rows = reader.rows();
    std::string title = "Falls: " + fs::path(results).stem().string();
    const std::size_t np = header.pga_m_s2.size();
    const std::size_t cells = header.frequency_hz.size() * np;
    if (cell >= 0) {
        const auto wanted = static_cast<std::size_t>(cell);
        if (cells == 0)
            throw InputError(
                fmt::format("--cell {}: a result of kind '{}' has no cells; leave --cell out", cell, header.kind));
        if (wanted >= cells)
            throw InputError(fmt::format("--cell {}: {} has the cells 0 to {} (frequency number x {} + PGA number)",
                                         cell, results, cells - 1, np));
        std::erase_if(rows, [&](const ResultRow& row) { return row.cell != wanted; });
        title +=
            fmt::format(", {:.3g} Hz, {:.3g} m/s²", header.frequency_hz[wanted / np], header.pga_m_s2[wanted % np]);
    } else if (cells > 1) {
        title += ", all cells";
    }
    const std::string note =
        followed_to_rest(reader, results) ? "" : "each realization was followed until its first fall only";
    plot_order(fall_order(header.block_names, rows), title, note, png);
}

fs::path export_png(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    const ResultReader reader(results);
    std::string picture = wanted.picture;
    if (picture.empty())
        picture = wanted.cell >= 0                                                  ? "order"
                  : reader.header().frequency_hz.empty() || wanted.realization >= 0 ? "strip"
                                                                                    : "surface";
    const bool of_surface = picture == "surface" || picture == "slice";
    if (!wanted.limit.empty() && !of_surface)
        throw InputError(fmt::format("--limit {}: the picture '{}' shows no limit state; surface and slice do",
                                     wanted.limit, picture));
    if (wanted.cell >= 0 && picture != "order")
        throw InputError(fmt::format("--cell {}: only --picture order is of one cell", wanted.cell));

    const std::string name = fs::path(results).stem().string();
    const std::string suffix = wanted.limit.empty() ? "" : "_" + wanted.limit;
    const fs::path png =
        wanted.output.empty() ? beside(results, "_" + picture + suffix + ".png") : fs::path(wanted.output);
    if (picture == "strip") {
        const std::uint64_t index =
            wanted.realization >= 0 ? static_cast<std::uint64_t>(wanted.realization) : reader.header().first;
        const Followed f = trajectory_of(options, reader, results, index);
        plot_strip(f.trajectory, f.fall_time_s, strip_title(reader, results, index), png);
    } else if (picture == "order") {
        export_order(reader, results, wanted.cell, png);
    } else {
        const LimitState limit = wanted.limit.empty() ? LimitState::collapse : limit_state_of(wanted.limit);
        const SurfaceTable surface = finished_surface(reader, results, limit);
        const std::string title = fmt::format("Probability of {}: {}", describe(limit), name);
        if (picture == "slice")
            plot_slice(surface, wanted.frequencies, describe(limit), title, png);
        else
            plot_surface(surface, describe(limit), title, png);
    }
    return png;
}

fs::path export_csv(const std::string& results, const std::string& output)
{
    const ResultReader reader(results);
    const fs::path folder = output.empty() ? beside(results, "_csv") : fs::path(output);
    write_csv(folder, reader.header(), reader.rows(), reader.complete() ? reader.surface() : SurfaceTable{});
    for (const std::uint64_t index : reader.trajectory_indices())
        write_trajectory_csv(folder / fmt::format("trajectory_{}.csv", index), reader.trajectory(index));
    return folder;
}

/// Results are never lost, not even to a slip in the name of the output.
void check_output(const std::string& results, const std::string& output)
{
    std::error_code none;
    if (!output.empty() && fs::equivalent(results, output, none))
        throw InputError(fmt::format("-o {}: is the results file itself; choose another output", output));
}

} // namespace

int export_command(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    check_output(results, wanted.output);
    const bool csv = wanted.format == "csv";
    if (csv && !(wanted.limit.empty() && wanted.picture.empty() && wanted.cell < 0))
        throw InputError(fmt::format("{}: is for --to png; the tables hold every realization and every limit state",
                                     !wanted.limit.empty()     ? "--limit " + wanted.limit
                                     : !wanted.picture.empty() ? "--picture " + wanted.picture
                                                               : fmt::format("--cell {}", wanted.cell)));
    const fs::path written = csv ? export_csv(results, wanted.output) : export_png(options, results, wanted);
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", written.string()).text());
    else if (!options.quiet)
        fmt::print("{}\n", written.string());
    return exit_done;
}

} // namespace stylobate
