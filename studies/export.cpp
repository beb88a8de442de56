/// `stylobate export`: results in other tools' formats.

#include "ensemble/input_error.hpp"
#include "io/export_csv.hpp"
#include "io/plot_sensitivity.hpp"
#include "io/plot_slice.hpp"
#include "io/plot_surface.hpp"
#include "io/result_store.hpp"
#include "studies/command.hpp"
#include "studies/json.hpp"
#include "studies/limit_state.hpp"
#include "studies/output_path.hpp"
#include "studies/result_picture.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

fs::path export_png(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    const ResultReader reader(results);
    std::string picture = wanted.picture;
    if (picture.empty())
        picture = wanted.cell >= 0                                                  ? "order"
                  : wanted.realization < 0 && reader.header().kind == "sensitivity" ? "sensitivity"
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
        strip_picture(options, reader, results, index, png);
    } else if (picture == "order") {
        order_picture(reader, results, wanted.cell, png);
    } else if (picture == "sensitivity") {
        plot_sensitivity(finished_sensitivity(reader, results), "What it depends on: " + name, png);
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
    if (reader.complete() && !reader.sensitivity().empty())
        write_sensitivity_csv(folder / "sensitivity.csv", reader.sensitivity());
    for (const std::uint64_t index : reader.trajectory_indices())
        write_trajectory_csv(folder / fmt::format("trajectory_{}.csv", index), reader.trajectory(index));
    return folder;
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
