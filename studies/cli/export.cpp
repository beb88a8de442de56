/// `stylobate export`: results in other tools' formats.

#include "io/store/export.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/table.hpp"
#include "studies/cli/command.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/compare/law_runs.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/motion_film.hpp"
#include "studies/results/result_picture.hpp"
#include "studies/results/results.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

/// The format to write: by --to, or by the ending of the output.
/// @throws InputError if neither is given, or if the two contradict each other
std::string format_of(const ExportOptions& wanted)
{
    const std::string ending = ending_of(wanted.output.value_or(""));
    const std::string of_picture = "The file extension of a picture is .png, .svg or .pdf.";
    if (!wanted.format && !is_picture_format(ending))
        throw InputError(
            !wanted.output
                ? "no output format is given: give --to png, svg, pdf, csv, nrml, json or vtk; html, gif, mp4 or "
                  "webm.\n  Or name a picture by -o: its file extension selects the format."
                : fmt::format("-o {}: its file extension is not a known format.\n  {} Of a realization in motion it is "
                              ".html, .gif, .mp4 or .webm. Tables need --to csv, nrml or json; ParaView --to vtk.",
                              *wanted.output, of_picture));
    if (!wanted.format)
        return ending;
    const std::string& format = *wanted.format;
    if (!wanted.output)
        return format;
    if (is_picture_format(format) && ending != format)
        throw InputError(fmt::format(
            "--to {} and -o {}: the file extension is not that of {}.\n  {} It selects the format: omit --to.", format,
            *wanted.output, format, of_picture));
    const auto files = {"png", "svg", "pdf", "csv", "xml", "nrml", "json", "html", "h5", "vtk", "pvd", "vtp"};
    if (!is_picture_format(format) && std::find(files.begin(), files.end(), ending) != files.end())
        throw InputError(fmt::format(
            "--to {} and -o {}: these are several files, in a folder.\n  Name a folder, without a file extension.",
            format, *wanted.output));
    return format;
}

/// The pictures that all results have.
constexpr PictureKind strip{"strip", "any study"}, order{"order", "any study"};

/// The picture of that name.
/// @throws InputError with what these results have, and which results have it
PictureKind picture_named(const std::string& name, const Results& results)
{
    std::vector<PictureKind> all(results.kind().pictures().begin(), results.kind().pictures().end());
    all.insert(all.end(), {strip, order});
    if (const auto found = std::ranges::find(all, name, &PictureKind::name); found != all.end())
        return *found;
    std::vector<std::string> names;
    for (const PictureKind& each : all)
        names.emplace_back(each.name);
    const std::vector<PictureKind> of_kinds = kind_pictures();
    const auto meant = std::ranges::find(of_kinds, name, &PictureKind::name);
    throw InputError(fmt::format("--picture {}: {} is a result of kind '{}', which has the pictures {}.{}", name,
                                 results.file(), results.header().kind, fmt::join(names, ", "),
                                 meant == of_kinds.end() ? "" : fmt::format("\n  That one is of {}.", meant->of)));
}

/// The selected picture, or else the default one of the results.
/// @throws InputError for a picture that they do not have, and for an option that the picture does not use
PictureKind picture_of(const Results& results, const ExportOptions& wanted)
{
    const std::span<const PictureKind> own = results.kind().pictures();
    const auto of_slices = std::ranges::find(own, true, &PictureKind::slices);
    const PictureKind picture = wanted.picture                           ? picture_named(*wanted.picture, results)
                                : wanted.cell >= 0                       ? order
                                : wanted.realization >= 0 || own.empty() ? strip
                                : wanted.rows_option() && of_slices != own.end() ? *of_slices
                                                                                 : own.front();
    if (wanted.limit && !picture.limit)
        throw InputError(fmt::format(
            "--limit {}: the picture '{}' shows no limit state; limit states are shown by surface, slice and fragility",
            *wanted.limit, picture.name));
    if (wanted.cell >= 0 && picture.name != order.name)
        throw InputError(fmt::format("--cell {}: applies to --picture order only", wanted.cell));
    if (wanted.realization >= 0 && picture.name != strip.name)
        throw InputError(fmt::format("--realization {}: applies to --picture strip only", wanted.realization));
    if (const auto rows = wanted.rows_option(); rows && !picture.slices)
        throw InputError(fmt::format("{} {}: applies to --picture slice only", *rows, fmt::join(wanted.rows(), ",")));
    return picture;
}

std::uint64_t realization_of(const Results& results, const ExportOptions& wanted)
{
    return wanted.realization >= 0 ? static_cast<std::uint64_t>(wanted.realization) : results.header().first;
}

/// The file that is asked for, or the one beside the results. @throws InputError if it is there and may not be replaced
fs::path place_of(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                  const std::string& ending)
{
    const fs::path to = wanted.output ? fs::path(*wanted.output) : beside(file, ending);
    check_output(file, to, options.force);
    return to;
}

fs::path export_picture(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                        const std::string& format)
{
    const Results results(file, options.set);
    const PictureKind asked = picture_of(results, wanted);
    const std::uint64_t realization = realization_of(results, wanted);
    const std::optional<LawBand> laws = law_band_beside(file, results.study(), results.header());
    Picture picture;
    if (asked.name == strip.name) {
        picture.name = fmt::format("strip_realization_{}", realization);
        picture.draw = [&](const std::string&, const fs::path& to) {
            strip_picture(results, traced_motion(results, options.isa(), realization), wanted.title, to);
        };
    } else if (asked.name == order.name) {
        picture.name = wanted.cell >= 0 ? fmt::format("order_cell_{}", wanted.cell) : "order";
        picture.draw = [&](const std::string&, const fs::path& to) {
            order_picture(results, wanted.cell, wanted.title, to);
        };
    } else {
        const bool all = results.kind().pictures_want_all(asked.name);
        picture =
            (all ? results.concluded() : results.kind())
                .picture(results.reader(), file,
                         {asked.name, wanted.limit, wanted.rows(), wanted.rows_option(), laws ? &*laws : nullptr});
    }
    // two pictures of one result differ in their names
    const fs::path to = place_of(options, file, wanted, "_" + picture.name + "." + format);
    picture.draw(wanted.title.value_or(picture.title + ": " + results.title()) + picture.partial, to);
    return to;
}

/// One that is refused leaves nothing half-written: all texts are there before the first file.
void write_files(const std::vector<std::pair<std::string, std::string>>& files, const fs::path& folder)
{
    make_folder(folder);
    for (const auto& [name, text] : files)
        write_whole(folder / name, text);
}

void export_csv(const Results& results, const std::string& name, const fs::path& folder)
{
    const ResultReader& reader = results.reader();
    const bool complete = reader.complete();
    const SurfaceTable surface = complete ? reader.surface() : SurfaceTable{};
    const auto files =
        complete ? results.concluded().files("csv", name) : std::vector<std::pair<std::string, std::string>>{};
    if (const Tally* tally = reader.tally()) {
        write_counts_csv(folder, reader.header(), *tally, surface);
    } else {
        const std::vector<ResultRow> rows = reader.rows();
        write_csv(folder, reader.header(), rows, surface, results.kind().columns(rows));
    }
    write_files(files, folder);
    for (const std::uint64_t index : reader.trajectory_indices())
        write_trajectory_csv(folder / fmt::format("trajectory_{}.csv", index), reader.trajectory(index));
}

/// One realization for ParaView.
fs::path export_vtk(const CommonOptions& options, const std::string& file, const ExportOptions& wanted)
{
    if (wanted.limit || wanted.picture || wanted.title || wanted.cell >= 0 || wanted.rows_option())
        throw InputError("--to vtk: writes one realization through time; of the options of pictures only --realization "
                         "applies to it");
    const Results results(file, options.set);
    const std::uint64_t index = realization_of(results, wanted);
    const fs::path folder =
        wanted.output ? fs::path(*wanted.output) : beside(file, fmt::format("_realization_{}_vtk", index));
    check_not_input(file, folder);
    write_vtk(folder, fmt::format("realization_{}", index), traced_motion(results, options.isa(), index).trajectory);
    Console(options.quiet).note("Forces and openings of joints are not part of a trajectory; they are left out.");
    return folder;
}

fs::path export_tables(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                       const std::string& format)
{
    const std::optional<std::string> of_picture =
        wanted.limit              ? "--limit " + *wanted.limit
        : wanted.picture          ? "--picture " + *wanted.picture
        : wanted.title            ? "--title " + *wanted.title
        : wanted.cell >= 0        ? fmt::format("--cell {}", wanted.cell)
        : wanted.realization >= 0 ? fmt::format("--realization {}", wanted.realization)
        : wanted.rows_option()    ? fmt::format("{} {}", *wanted.rows_option(), fmt::join(wanted.rows(), ","))
                                  : std::optional<std::string>();
    if (of_picture)
        throw InputError(
            *of_picture +
            ": applies to --to png, svg or pdf; the tables contain every realization and every limit state");
    const Results results(file, options.set);
    const fs::path folder = wanted.output ? fs::path(*wanted.output) : beside(file, "_" + format);
    check_output_folder(file, folder, options.force);
    const std::string name = fs::path(file).stem().string();
    if (format == "csv")
        export_csv(results, name, folder);
    else
        write_files(results.concluded().files(format, name), folder);
    if (const std::optional<LawBand> laws = law_band_beside(file, results.study(), results.header()); laws) {
        if (format == "csv")
            write_whole(folder / "contact_laws.csv", csv_text(law_band_rows(*laws)));
        else if (format == "json")
            write_whole(folder / "contact_laws.json", law_band_json(*laws).text() + "\n");
    }
    return folder;
}

/// The format of a realization in motion, by --to or by the ending of the output; nullopt: another format.
/// @throws InputError if the two contradict each other
std::optional<std::string> motion_format_of(const ExportOptions& wanted)
{
    const std::string ending = ending_of(wanted.output.value_or(""));
    if (!wanted.format)
        return is_motion_format(ending) ? std::optional(ending) : std::nullopt;
    if (!is_motion_format(*wanted.format))
        return std::nullopt;
    if (wanted.output && ending != *wanted.format)
        throw InputError(
            fmt::format("--to {0} and -o {1}: the file extension is not .{0}", *wanted.format, *wanted.output));
    return wanted.format;
}

/// @returns nothing if it was interrupted
std::optional<fs::path> export_motion(const CommonOptions& options, const std::string& file,
                                      const ExportOptions& wanted, const std::string& format)
{
    const std::optional<std::string> of_picture = wanted.limit       ? "--limit " + *wanted.limit
                                                  : wanted.picture   ? "--picture " + *wanted.picture
                                                  : wanted.cell >= 0 ? fmt::format("--cell {}", wanted.cell)
                                                                     : wanted.rows_option();
    if (of_picture)
        throw InputError(*of_picture + ": does not apply to --to html, gif, mp4 or webm, which show one realization; "
                                       "--realization selects it");
    const Results results(file, options.set);
    const std::uint64_t realization = realization_of(results, wanted);
    const fs::path to = place_of(options, file, wanted, fmt::format("_realization_{}.{}", realization, format));
    Console console = options.console("export");
    console.begin(); // from here on an interrupt leaves no file
    if (write_motion(results, options.isa(), realization, wanted.title, format, to, console)) {
        console.end(exit_done);
        return to;
    }
    console.warn(fmt::format("interrupted: '{}' was not written", to.string()));
    console.end(exit_interrupted);
    return std::nullopt;
}

/// The picture of a risk estimate, or its tables.
fs::path export_risk(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                     const std::string& format)
{
    const bool picture = is_picture_format(format);
    if (!picture && format != "csv")
        throw InputError(fmt::format(
            "--to {}: {} is a risk estimate; it has a picture (png, svg, pdf) and tables (csv)", format, file));
    if (wanted.picture || wanted.cell >= 0 || wanted.realization >= 0 || wanted.rows_option() ||
        (!picture && (wanted.limit || wanted.title)))
        throw InputError(fmt::format("{} is a risk estimate: of the options of pictures only --limit and --title apply "
                                     "to its picture, none to its tables",
                                     file));
    check_no_settings(options.set, file);
    if (!picture) {
        const fs::path folder = wanted.output ? fs::path(*wanted.output) : beside(file, "_" + format);
        check_output_folder(file, folder, options.force);
        write_files(risk_csv(read_any_risk(file)), folder);
        return folder;
    }
    const std::string name = wanted.limit ? "_" + *wanted.limit + "." : ".";
    const fs::path to = place_of(options, file, wanted, name + format);
    plot_risk(read_any_risk(file), wanted.limit, wanted.title, to);
    return to;
}

/// Options that belong to single realizations or to the pictures of results.
void check_comparison_options(const CommonOptions& options, const std::string& file, const ExportOptions& wanted)
{
    const std::optional<std::string> other = !options.set.empty()      ? "--set"
                                             : wanted.picture          ? "--picture"
                                             : wanted.cell >= 0        ? "--cell"
                                             : wanted.realization >= 0 ? "--realization"
                                                                       : wanted.rows_option();
    if (other)
        throw InputError(fmt::format("{}: {} is a comparison, whose export has the options --to, --limit, --title and "
                                     "-o",
                                     *other, file));
}

/// @param format "png", "csv", ...   @returns the file
fs::path export_comparison(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                           const std::string& format)
{
    check_comparison_options(options, file, wanted);
    const Comparison comparison = read_comparison(file);
    if (is_picture_format(format)) {
        const std::string limit = limit_of(comparison.variants.front(), wanted.limit).name;
        const fs::path to = place_of(options, file, wanted, fmt::format("_{}.{}", limit, format));
        comparison_picture(comparison, limit, wanted.title, to);
        return to;
    }
    if (format != "csv")
        throw InputError(fmt::format("--to {}: a comparison is exported to png, svg, pdf or csv; compare --json prints "
                                     "it as JSON",
                                     format));
    if (wanted.limit || wanted.title)
        throw InputError(fmt::format("--{}: applies to --to png, svg or pdf; the table contains every limit state",
                                     wanted.limit ? "limit" : "title"));
    const fs::path to = place_of(options, file, wanted, ".csv");
    write_whole(to, csv_text(comparison_rows(comparison)));
    return to;
}

} // namespace

std::vector<std::string> picture_names()
{
    std::vector<std::string> names;
    for (const PictureKind& picture : kind_pictures())
        names.emplace_back(picture.name);
    names.insert(names.end(), {std::string(strip.name), std::string(order.name)});
    return names;
}

int export_command(const CommonOptions& options, const std::string& results, const ExportOptions& wanted)
{
    check_kind(results, "export");
    if (wanted.output)
        check_not_input(results, *wanted.output);
    const FileKind kind = recognise(results).kind;
    if (kind == FileKind::comparison) {
        const bool csv = wanted.format == "csv" || (!wanted.format && ending_of(wanted.output.value_or("")) == "csv");
        print_written(options, export_comparison(options, results, wanted, csv ? "csv" : format_of(wanted)).string());
        return exit_done;
    }
    const std::optional<std::string> motion = motion_format_of(wanted);
    const std::string format = motion ? *motion : format_of(wanted);
    const std::optional<fs::path> written = kind == FileKind::risk ? export_risk(options, results, wanted, format)
                                            : motion               ? export_motion(options, results, wanted, format)
                                            : is_picture_format(format)
                                                ? export_picture(options, results, wanted, format)
                                            : format == "vtk" ? export_vtk(options, results, wanted)
                                                              : export_tables(options, results, wanted, format);
    if (!written)
        return exit_interrupted;
    print_written(options, written->string());
    return exit_done;
}

} // namespace stylobate
