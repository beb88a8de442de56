/// `stylobate export`: results in other tools' formats.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/plot_rare.hpp"
#include "io/plots/plot_sensitivity.hpp"
#include "io/plots/plot_slice.hpp"
#include "io/plots/plot_surface.hpp"
#include "io/store/export_csv.hpp"
#include "io/store/result_store.hpp"
#include "studies/app/command.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/kinds/fragility/exchange.hpp"
#include "studies/kinds/fragility/fragility_text.hpp"
#include "studies/kinds/replicas/twins_text.hpp"
#include "studies/pages/result_picture.hpp"
#include "studies/report/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <vector>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

bool is_picture_format(std::string_view format)
{
    return format == "png" || format == "svg" || format == "pdf";
}

/// What is to be written: said by --to, or by the ending of the output.
/// @throws InputError if nothing says it, or if the two contradict each other
std::string format_of(const ExportOptions& wanted)
{
    std::string ending = fs::path(wanted.output).extension().string();
    ending.erase(0, ending.empty() ? 0 : 1);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    const std::string of_picture = "A picture's ending is .png, .svg or .pdf.";
    if (wanted.format.empty() && !is_picture_format(ending))
        throw InputError(
            wanted.output.empty()
                ? "what to write is not said: give --to png, svg, pdf, csv, nrml or json.\n  Or name a "
                  "picture by -o: its ending says the format."
                : fmt::format("-o {}: its ending says no format.\n  {} Tables need --to csv, nrml or json.",
                              wanted.output, of_picture));
    if (wanted.format.empty())
        return ending;
    if (wanted.output.empty())
        return wanted.format;
    if (is_picture_format(wanted.format) && ending != wanted.format)
        throw InputError(
            fmt::format("--to {} and -o {}: the ending of the file does not say {}.\n  {} It decides: leave "
                        "out --to.",
                        wanted.format, wanted.output, wanted.format, of_picture));
    const auto files = {"png", "svg", "pdf", "csv", "xml", "nrml", "json", "html", "h5"};
    if (!is_picture_format(wanted.format) && std::find(files.begin(), files.end(), ending) != files.end())
        throw InputError(fmt::format("--to {} and -o {}: these are several files, in a folder.\n  Name a folder, "
                                     "without the ending of a file.",
                                     wanted.format, wanted.output));
    return wanted.format;
}

/// The picture that is asked for, or else the one that suits the results.
/// @throws InputError for an option that this picture does not use
std::string picture_of(const ResultHeader& header, const ExportOptions& wanted)
{
    std::string picture = wanted.picture;
    if (picture.empty())
        picture = wanted.cell >= 0               ? "order"
                  : wanted.realization >= 0      ? "strip"
                  : !wanted.frequencies.empty()  ? "slice"
                  : header.kind == "fragility"   ? "fragility"
                  : header.kind == "sensitivity" ? "sensitivity"
                  : header.kind == "rare"        ? "rare"
                  : header.frequency_hz.empty()  ? "strip"
                                                 : "surface";
    const bool of_surface = picture == "surface" || picture == "slice" || picture == "fragility";
    if (!wanted.limit.empty() && !of_surface)
        throw InputError(
            fmt::format("--limit {}: the picture '{}' shows no limit state; surface, slice and fragility do",
                        wanted.limit, picture));
    if (wanted.cell >= 0 && picture != "order")
        throw InputError(fmt::format("--cell {}: only --picture order is of one cell", wanted.cell));
    if (wanted.realization >= 0 && picture != "strip")
        throw InputError(
            fmt::format("--realization {}: only --picture strip is of one realization", wanted.realization));
    if (!wanted.frequencies.empty() && picture != "slice")
        throw InputError(fmt::format("--frequency {}: only --picture slice is of some frequencies",
                                     fmt::join(wanted.frequencies, ",")));
    return picture;
}

/// "surface", "slice_2Hz_4Hz_slid", "strip_realization_7": two pictures of one result differ in their names.
std::string picture_name(const std::string& picture, const ExportOptions& wanted, const SurfaceTable& surface,
                         std::uint64_t realization)
{
    std::string name = picture;
    if (picture == "strip")
        name += fmt::format("_realization_{}", realization);
    if (wanted.cell >= 0)
        name += fmt::format("_cell_{}", wanted.cell);
    if (!wanted.frequencies.empty())
        for (const std::size_t row : slice_rows(surface, wanted.frequencies))
            name += fmt::format("_{:.4g}Hz", surface.frequency_hz[row]);
    return wanted.limit.empty() ? name : name + "_" + wanted.limit;
}

fs::path export_picture(const CommonOptions& options, const std::string& results, const ExportOptions& wanted,
                        const std::string& format)
{
    const ResultReader reader(results);
    check_settings(reader.header(), results, options.set);
    const std::string picture = picture_of(reader.header(), wanted);
    LimitState limit = LimitState::collapse;
    SurfaceTable surface;
    if (picture == "surface" || picture == "slice") {
        const std::vector<std::string>& known = limit_state_names();
        if (!wanted.limit.empty() && std::find(known.begin(), known.end(), wanted.limit) == known.end())
            throw InputError(fmt::format("--limit {}: a surface knows {}", wanted.limit, fmt::join(known, ", ")));
        if (!wanted.limit.empty())
            limit = limit_state_of(wanted.limit);
        surface = surface_so_far(reader, results, limit);
    }
    const std::uint64_t realization =
        wanted.realization >= 0 ? static_cast<std::uint64_t>(wanted.realization) : reader.header().first;
    const std::string name = picture_name(picture, wanted, surface, realization);
    const fs::path file = wanted.output.empty() ? beside(results, "_" + name + "." + format) : fs::path(wanted.output);
    check_output(results, file, options.force);

    const auto title = [&](const std::string& of) {
        const std::string partial = surface.trials.empty() ? "" : partial_words(reader, results, surface);
        return (wanted.title.empty() ? of + ": " + title_of(reader, results) : wanted.title) + partial;
    };
    if (picture == "strip") {
        strip_picture({options.set, options.isa()}, reader, results, realization, wanted.title, file);
    } else if (picture == "fragility") {
        std::vector<std::string> limits;
        if (!wanted.limit.empty())
            limits.push_back(wanted.limit);
        plot_fragility(fragility_of(reader, results), limits, title("Fragility"), file);
    } else if (picture == "order") {
        order_picture(reader, results, wanted.cell, wanted.title, file);
    } else if (picture == "sensitivity") {
        plot_sensitivity(finished_sensitivity(reader, results), title("What it depends on"), file);
    } else if (picture == "rare") {
        plot_rare(finished_rare(reader, results), title("Probability of collapse"), file);
    } else if (picture == "twins") {
        plot_flips(twins_of(reader, results), title("How sure the verdict is"), file);
    } else if (picture == "predictability") {
        plot_growth(twins_of(reader, results), title("How long the motion can be foretold"), file);
    } else if (picture == "slice") {
        plot_slice(surface, wanted.frequencies, describe(limit),
                   title("Probability of " + std::string(describe(limit))), file);
    } else {
        plot_surface(surface, describe(limit), title("Probability of " + std::string(describe(limit))), file);
    }
    return file;
}

void export_csv(const ResultReader& reader, const std::string& results, const fs::path& folder)
{
    const SurfaceTable surface = reader.complete() ? reader.surface() : SurfaceTable{};
    if (const Tally* tally = reader.tally())
        write_counts_csv(folder, reader.header(), *tally, surface);
    else
        write_csv(folder, reader.header(), reader.rows(), surface, reader.fragility());
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
}

/// Fragility functions for other tools.
void export_models(const ResultReader& reader, const std::string& results, const std::string& format,
                   const fs::path& folder)
{
    if (!reader.complete())
        throw InputError(results + ": the study is not finished; run it again to go on");
    write_models(fragility_models(fragility_of(reader, results), fs::path(results).stem().string()), format, folder);
}

fs::path export_tables(const CommonOptions& options, const std::string& results, const ExportOptions& wanted,
                       const std::string& format)
{
    const std::string of_picture = !wanted.limit.empty()     ? "--limit " + wanted.limit
                                   : !wanted.picture.empty() ? "--picture " + wanted.picture
                                   : !wanted.title.empty()   ? "--title " + wanted.title
                                   : wanted.cell >= 0        ? fmt::format("--cell {}", wanted.cell)
                                   : wanted.realization >= 0 ? fmt::format("--realization {}", wanted.realization)
                                   : !wanted.frequencies.empty()
                                       ? fmt::format("--frequency {}", fmt::join(wanted.frequencies, ","))
                                       : "";
    if (!of_picture.empty())
        throw InputError(of_picture +
                         ": is for --to png, svg or pdf; the tables hold every realization and every limit state");
    const ResultReader reader(results);
    check_settings(reader.header(), results, options.set);
    const fs::path folder = wanted.output.empty() ? beside(results, "_" + format) : fs::path(wanted.output);
    check_output_folder(results, folder, options.force);
    if (format == "csv")
        export_csv(reader, results, folder);
    else
        export_models(reader, results, format, folder);
    return folder;
}

} // namespace

int export_command(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    check_kind(results, "export");
    check_not_input(results, wanted.output);
    const std::string format = format_of(wanted);
    const fs::path written = is_picture_format(format) ? export_picture(options, results, wanted, format)
                                                       : export_tables(options, results, wanted, format);
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", written.string()).text());
    else if (!options.quiet)
        fmt::print("{}\n", written.string());
    return exit_done;
}

} // namespace stylobate
