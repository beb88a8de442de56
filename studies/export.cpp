/// `stylobate export`: results in other tools' formats.

#include "ensemble/input_error.hpp"
#include "io/export_csv.hpp"
#include "io/plot_slice.hpp"
#include "io/plot_strip.hpp"
#include "io/plot_surface.hpp"
#include "io/result_store.hpp"
#include "studies/command.hpp"
#include "studies/json.hpp"
#include "studies/loaded_study.hpp"
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

/// The trajectory that the file holds, or else the realization run again.
Trajectory trajectory_of(const CommonOptions& options, const ResultReader& reader, const std::string& results,
                         std::uint64_t index)
{
    const std::vector<std::uint64_t> stored = reader.trajectory_indices();
    if (std::find(stored.begin(), stored.end(), index) != stored.end())
        return reader.trajectory(index);
    const ResultHeader& header = reader.header();
    if (index < header.first || index >= header.first + header.total)
        throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", index, results, header.first,
                                     header.first + header.total - 1));
    return follow(LoadedStudy::from_results(header, results, options.set), index, options.isa()).trajectory;
}

SurfaceTable finished_surface(const ResultReader& reader, const std::string& results)
{
    if (reader.header().frequency_hz.empty())
        throw InputError(fmt::format("{}: a result of kind '{}' has no surface; use --picture strip", results,
                                     reader.header().kind));
    if (!reader.complete())
        throw InputError(fmt::format("{}: the run is not complete; run the same study again to continue it", results));
    return reader.surface();
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

fs::path export_png(const CommonOptions& options, const std::string& results, std::string picture,
                    const std::string& output, long long realization, const std::vector<double>& frequencies)
{
    const ResultReader reader(results);
    if (picture.empty())
        picture = reader.header().frequency_hz.empty() || realization >= 0 ? "strip" : "surface";
    const fs::path png = output.empty() ? beside(results, "_" + picture + ".png") : fs::path(output);
    const std::string name = fs::path(results).stem().string();
    if (picture == "strip") {
        const std::uint64_t index = realization >= 0 ? static_cast<std::uint64_t>(realization) : reader.header().first;
        plot_strip(trajectory_of(options, reader, results, index), strip_title(reader, results, index), png);
    } else if (picture == "slice") {
        plot_slice(finished_surface(reader, results), frequencies, "Probability of collapse: " + name, png);
    } else {
        plot_surface(finished_surface(reader, results), "Probability of collapse: " + name, png);
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

int export_command(const CommonOptions& options, const std::string& results, const std::string& format,
                   const std::string& picture, const std::string& output, long long realization,
                   const std::vector<double>& frequencies)
{
    check_output(results, output);
    const fs::path written = format == "csv" ? export_csv(results, output)
                                             : export_png(options, results, picture, output, realization, frequencies);
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", written.string()).text());
    else if (!options.quiet)
        fmt::print("{}\n", written.string());
    return exit_done;
}

} // namespace stylobate
