/// `stylobate compare`: studies run under the same draws, and what differs between them.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/study/study_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/app/run_report.hpp"
#include "studies/decisions/adaptive/adaptive_comparison.hpp"
#include "studies/decisions/compare/compare_studies.hpp"
#include "studies/decisions/compare/comparison_file.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/search/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

std::string default_output(const std::string& base)
{
    return fs::path(base).stem().string() + "_comparison.h5";
}

/// What the studies are called in the comparison: the base by its file, a variant by its own name; results of one name
/// in several folders by their paths.
std::vector<std::string> names_of(const CompareOptions& wanted, const std::vector<std::string>& results)
{
    std::vector<std::string> names;
    const std::string base = fs::path(wanted.files.front()).stem().string();
    for (const std::string& file : results) {
        std::string name = fs::path(file).stem().string();
        if (wanted.files.size() == 1 && !names.empty())
            name = name.substr(base.size() + 1);
        names.push_back(name);
    }
    if (std::set(names.begin(), names.end()).size() < names.size())
        for (std::size_t i = 0; i < names.size(); ++i)
            names[i] = fs::path(results[i]).replace_extension().string();
    return names;
}

/// Whether a comparison may take the place of what is there: that of the same studies may, as `run` continues a file.
void check_place(const CommonOptions& options, const std::string& output, const std::vector<std::string>& files,
                 const std::vector<std::string>& texts)
{
    const auto place = [](const std::string& file) { return fs::absolute(file).lexically_normal(); };
    for (const std::string& file : files) {
        check_not_input(file, output);
        if (place(file) == place(output)) // though neither is there yet
            throw InputError(
                fmt::format("-o {}: is the results file of one of the studies; choose another output", output));
    }
    AtomicFile::check(output);
    std::error_code none;
    if (!fs::exists(output, none))
        return;
    check_option_kind(output, FileKind::comparison, "-o");
    if (options.force)
        return;
    const Comparison old = read_comparison(output);
    std::vector<std::string> known = {old.base_toml};
    for (const VariantComparison& variant : old.variants)
        known.push_back(variant.study_toml);
    if (known != texts)
        throw InputError(output, 0,
                         "is the comparison of other studies, and nothing was written.\n  Give --force to replace it, "
                         "or name another file by -o.");
}

/// Writes the comparison and prints it.
int conclude(const CommonOptions& options, const Comparison& comparison, const std::string& output)
{
    write_comparison(comparison, output);
    if (options.json) {
        Json json = comparison_json(comparison);
        json.member("comparison", output).member("complete", true);
        fmt::print("{}\n", json.text());
    } else {
        fmt::print("{}: {}", output, comparison_text(comparison));
    }
    return exit_done;
}

int interrupted(const CommonOptions& options, const WholeRuns& studies, const std::string& output)
{
    std::uint64_t done = 0, total = 0;
    for (const auto& study : studies) {
        done += study->done();
        total += study->header().total;
    }
    if (options.json)
        fmt::print("{}\n", Json::object()
                               .member("comparison", output)
                               .member("complete", false)
                               .member("realizations", done)
                               .member("total", total)
                               .text());
    else
        fmt::print("Interrupted; {} of {} realizations are kept. The same command continues the comparison.\n", done,
                   total);
    return exit_interrupted;
}

int compare_study_files(const CommonOptions& options, const CompareOptions& wanted, const std::string& output)
{
    const WholeRuns studies = studies_to_compare({wanted.files, options.set, fs::path(output).parent_path().string()});
    std::vector<std::string> files, texts;
    for (const auto& study : studies) {
        files.push_back(study->results());
        texts.push_back(study->header().study_toml);
        check_option_kind(study->results(), FileKind::results, "compare: the results");
    }
    check_place(options, output, files, texts);
    if (wanted.adaptive)
        check_adaptive(studies.front()->study(), wanted.files.front(), {*wanted.adaptive, wanted.margin});
    options.run_options(); // refuses an instruction set that is not there
    check_can_run(options, studies);
    const std::vector<std::string> names = names_of(wanted, files);
    std::optional<Comparison> comparison;
    {
        Console console(options.quiet); // from here on an interrupt leaves files to be continued
        for (const auto& study : studies)
            for (const std::string& warning : study->warnings())
                console.warn(study->name() + ": " + warning);
        if (wanted.adaptive)
            comparison = compare_adaptively(studies, names, {*wanted.adaptive, wanted.margin}, wanted.level,
                                            options.run_options(), console);
        else if (run_all(options, studies, console))
            comparison = comparison_of(names, files, wanted.level);
    }
    if (!comparison)
        return interrupted(options, studies, output);
    const int status = conclude(options, *comparison, output);
    return status == exit_done ? report_invalid(studies) : status;
}

int compare_results(const CommonOptions& options, const CompareOptions& wanted, const std::string& output)
{
    if (!options.set.empty())
        throw InputError(fmt::format("--set {}: the studies of results are fixed", options.set.front()));
    if (wanted.adaptive)
        throw InputError(fmt::format("--adaptive {}: {} is finished; give study files instead", *wanted.adaptive,
                                     wanted.files.front()));
    if (wanted.files.size() < 2)
        throw InputError(wanted.files.front(), 0,
                         "is one result.\n  Give those of its variants too: compare BASE.h5 VARIANT.h5 ...");
    for (const std::string& file : wanted.files)
        if (std::ranges::count(wanted.files, file) > 1)
            throw InputError(fmt::format("compare: {} is given twice; give each study once", file));
    std::vector<std::string> texts;
    for (const auto& results : results_to_compare(wanted.files))
        texts.push_back(results->header().study_toml);
    check_place(options, output, wanted.files, texts);
    return conclude(options, comparison_of(names_of(wanted, wanted.files), wanted.files, wanted.level), output);
}

int search_study(const CommonOptions& options, const CompareOptions& wanted)
{
    if (wanted.files.size() > 1)
        throw InputError(
            fmt::format("--search: takes one study file with [optimise], not {} files", wanted.files.size()));
    if (wanted.adaptive)
        throw InputError("--adaptive: does not go with --search, whose points are run whole");
    if (!wanted.output.empty()) {
        if (!is_picture_format(ending_of(wanted.output)))
            throw InputError(fmt::format("-o {}: --search writes a picture there (png, svg or pdf); its points have "
                                         "results files of their own",
                                         wanted.output));
        check_output(wanted.files.front(), wanted.output, options.force);
        AtomicFile::check(wanted.output);
        find_gnuplot(); // refuses before anything is run
    }
    const SearchFiles files{wanted.files.front(), options.set, ""};
    check_search(files);
    const RunOptions run = options.run_options();
    std::optional<SearchResult> result;
    {
        Console console(options.quiet); // from here on an interrupt leaves files to be continued
        result = search(files, wanted.level, run, console);
    }
    if (!result) {
        if (options.json)
            fmt::print("{}\n", Json::object().member("complete", false).text());
        else
            fmt::print("Interrupted; what was run is kept. The same command continues the search.\n");
        return exit_interrupted;
    }
    if (!wanted.output.empty())
        plot_search(*result, wanted.output);
    if (options.json)
        fmt::print("{}\n", search_json(*result).member("complete", true).text());
    else
        fmt::print("{}", search_text(*result));
    const LoadedStudy study = LoadedStudy::from_file(files.study, files.settings);
    int status = exit_done;
    for (const SearchedRun& searched : result->runs)
        if (status == exit_done)
            status = report_invalid(study.study(), searched.invalid, searched.total, searched.results);
    return status;
}

} // namespace

int compare_command(const CommonOptions& options, const CompareOptions& wanted)
{
    for (const std::string& file : wanted.files)
        check_kind(file, "compare");
    const FileKind kind = recognise(wanted.files.front()).kind;
    for (const std::string& file : wanted.files)
        if (recognise(file).kind != kind)
            throw InputError(fmt::format(
                "compare: {} is {}, and {} is {}.\n  Give study files, or results of them all.", wanted.files.front(),
                describe(recognise(wanted.files.front())), file, describe(recognise(file))));
    if (wanted.search && kind != FileKind::results)
        return search_study(options, wanted);
    if (wanted.search)
        throw InputError(fmt::format("--search: {} is a result; give the study file", wanted.files.front()));
    const std::string output = wanted.output.empty() ? default_output(wanted.files.front()) : wanted.output;
    return kind == FileKind::results ? compare_results(options, wanted, output)
                                     : compare_study_files(options, wanted, output);
}

} // namespace stylobate
