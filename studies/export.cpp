/// `stylobate export`: results in other tools' formats.

#include "ensemble/input_error.hpp"
#include "io/atomic_file.hpp"
#include "io/export_csv.hpp"
#include "io/plot_rare.hpp"
#include "io/plot_sensitivity.hpp"
#include "io/plot_slice.hpp"
#include "io/plot_surface.hpp"
#include "io/result_store.hpp"
#include "studies/command.hpp"
#include "studies/file_kind.hpp"
#include "studies/fragility/exchange.hpp"
#include "studies/fragility/fragility_text.hpp"
#include "studies/json.hpp"
#include "studies/limit_state.hpp"
#include "studies/output_path.hpp"
#include "studies/result_picture.hpp"
#include "studies/twins/twins_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

fs::path export_png(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    const ResultReader reader(results);
    std::string picture = wanted.picture;
    const bool of_fragility = reader.header().kind == "fragility";
    if (picture.empty() && of_fragility && wanted.cell < 0 && wanted.realization < 0)
        picture = "fragility";
    if (picture.empty())
        picture = wanted.cell >= 0                                                  ? "order"
                  : wanted.realization < 0 && reader.header().kind == "sensitivity" ? "sensitivity"
                  : wanted.realization < 0 && reader.header().kind == "rare"        ? "rare"
                  : reader.header().frequency_hz.empty() || wanted.realization >= 0 ? "strip"
                                                                                    : "surface";
    const bool of_surface = picture == "surface" || picture == "slice" || picture == "fragility";
    if (!wanted.limit.empty() && !of_surface)
        throw InputError(
            fmt::format("--limit {}: the picture '{}' shows no limit state; surface, slice and fragility do",
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
    } else if (picture == "fragility") {
        std::vector<std::string> limits;
        if (!wanted.limit.empty())
            limits.push_back(wanted.limit);
        plot_fragility(fragility_of(reader, results), limits, "Fragility: " + name, png);
    } else if (picture == "order") {
        order_picture(reader, results, wanted.cell, png);
    } else if (picture == "sensitivity") {
        plot_sensitivity(finished_sensitivity(reader, results), "What it depends on: " + name, png);
    } else if (picture == "rare") {
        plot_rare(finished_rare(reader, results), "Probability of collapse: " + name, png);
    } else if (picture == "twins") {
        plot_flips(twins_of(reader, results), "How sure the verdict is: " + name, png);
    } else if (picture == "predictability") {
        plot_growth(twins_of(reader, results), "How long the motion can be foretold: " + name, png);
    } else {
        if (!wanted.limit.empty() && std::find(limit_state_names().begin(), limit_state_names().end(), wanted.limit) ==
                                         limit_state_names().end())
            throw InputError(
                fmt::format("--limit {}: a surface knows {}", wanted.limit, fmt::join(limit_state_names(), ", ")));
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
    const SurfaceTable surface = reader.complete() ? reader.surface() : SurfaceTable{};
    if (const Tally* tally = reader.tally())
        write_counts_csv(folder, reader.header(), *tally, surface);
    else
        write_csv(folder, reader.header(), reader.rows(), surface);
    if (reader.header().kind == "fragility" && reader.complete()) {
        write_whole(folder / "motions.csv", motions_csv(reader.header().motions));
        const Fragility fragility = fragility_of(reader, results);
        if (!fragility.states.empty())
            write_models(fragility_models(fragility, fs::path(results).stem().string()), "csv", folder);
    }
    if (reader.complete() && !reader.sensitivity().empty())
        write_sensitivity_csv(folder / "sensitivity.csv", reader.sensitivity());
    if (has_twins(reader, results))
        write_twins_csv(folder, twins_of(reader, results));
    for (const std::uint64_t index : reader.trajectory_indices())
        write_trajectory_csv(folder / fmt::format("trajectory_{}.csv", index), reader.trajectory(index));
    return folder;
}

/// Fragility functions for other tools.
fs::path export_models(const std::string& results, const ExportOptions& wanted)
{
    const ResultReader reader(results);
    if (!reader.complete())
        throw InputError(results + ": the study is not finished; run it again to go on");
    const fs::path folder = wanted.output.empty() ? beside(results, "_" + wanted.format) : fs::path(wanted.output);
    write_models(fragility_models(fragility_of(reader, results), fs::path(results).stem().string()), wanted.format,
                 folder);
    return folder;
}

} // namespace

int export_command(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    check_kind(results, "export");
    check_output(results, wanted.output);
    const bool csv = wanted.format == "csv", png = wanted.format == "png";
    if (!png && !(wanted.limit.empty() && wanted.picture.empty() && wanted.cell < 0))
        throw InputError(fmt::format("{}: is for --to png; the tables hold every realization and every limit state",
                                     !wanted.limit.empty()     ? "--limit " + wanted.limit
                                     : !wanted.picture.empty() ? "--picture " + wanted.picture
                                                               : fmt::format("--cell {}", wanted.cell)));
    const fs::path written = png   ? export_png(options, results, wanted)
                             : csv ? export_csv(results, wanted.output)
                                   : export_models(results, wanted);
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", written.string()).text());
    else if (!options.quiet)
        fmt::print("{}\n", written.string());
    return exit_done;
}

} // namespace stylobate
