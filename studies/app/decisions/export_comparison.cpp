/// `stylobate export` of a comparison: its picture, or its numbers as a table.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "studies/app/command.hpp"
#include "studies/app/output_path.hpp"
#include "studies/decisions/compare/comparison_file.hpp"
#include "studies/decisions/compare/comparison_picture.hpp"
#include "studies/decisions/compare/comparison_text.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

/// Options that belong to single realizations or to the pictures of results.
void check_options(const CommonOptions& options, const std::string& file, const ExportOptions& wanted)
{
    const std::string other = !options.set.empty()          ? "--set"
                              : !wanted.picture.empty()     ? "--picture"
                              : wanted.cell >= 0            ? "--cell"
                              : wanted.realization >= 0     ? "--realization"
                              : !wanted.frequencies.empty() ? "--frequency"
                                                            : "";
    if (!other.empty())
        throw InputError(fmt::format("{}: {} is a comparison, whose export has the options --to, --limit, --title and "
                                     "-o",
                                     other, file));
}

} // namespace

std::string export_comparison(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                              const std::string& format)
{
    check_options(options, file, wanted);
    const Comparison comparison = read_comparison(file);
    if (is_picture_format(format)) {
        const std::string limit = limit_of(comparison.variants.front(), wanted.limit).name;
        const std::string to =
            wanted.output.empty() ? beside(file, fmt::format("_{}.{}", limit, format)).string() : wanted.output;
        check_output(file, to, options.force);
        comparison_picture(comparison, limit, wanted.title, to);
        return to;
    }
    if (format != "csv")
        throw InputError(fmt::format("--to {}: a comparison is exported to png, svg, pdf or csv; compare --json prints "
                                     "it as JSON",
                                     format));
    if (!wanted.limit.empty() || !wanted.title.empty())
        throw InputError(fmt::format("--{}: applies to --to png, svg or pdf; the table contains every limit state",
                                     wanted.limit.empty() ? "title" : "limit"));
    const std::string to = wanted.output.empty() ? beside(file, ".csv").string() : wanted.output;
    check_output(file, to, options.force);
    write_whole(to, csv_text(comparison_rows(comparison)));
    return to;
}

} // namespace stylobate
