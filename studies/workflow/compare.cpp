#include "studies/workflow/compare.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/picture_file.hpp"
#include "studies/decisions/compare/compare_studies.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"
#include "studies/workflow/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

/// What the studies are called in the comparison: the base by its file, a variant by its own name; results of one name
/// in several folders by their paths.
std::vector<std::string> names_of(const ComparisonRequest& request, const std::vector<std::string>& results)
{
    std::vector<std::string> names;
    const std::string base = fs::path(request.files.front()).stem().string();
    for (const std::string& file : results) {
        std::string name = fs::path(file).stem().string();
        if (request.files.size() == 1 && !names.empty())
            name = name.substr(base.size() + 1);
        names.push_back(name);
    }
    if (std::set(names.begin(), names.end()).size() < names.size())
        for (std::size_t i = 0; i < names.size(); ++i)
            names[i] = fs::path(results[i]).replace_extension().string();
    return names;
}

/// Whether a comparison may take the place of what is there: that of the same studies may, as `run` continues a file.
void check_place(const ComparisonRequest& request, const std::vector<std::string>& files,
                 const std::vector<std::string>& texts)
{
    if (!request.output)
        return;
    const std::string& output = *request.output;
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
    if (request.force)
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

ComparisonEnd compare_study_files(const ComparisonRequest& request, const Machine& machine, WorkObserver& observer)
{
    const StudyRuns studies = studies_to_compare({request.files, request.settings, request.folder});
    std::vector<std::string> files, texts;
    for (const auto& study : studies) {
        files.push_back(study->results());
        texts.push_back(study->header().study_toml);
        check_option_kind(study->results(), FileKind::results, "compare: the results");
    }
    check_place(request, files, texts);
    const AdaptiveChoice choice{request.adaptive.value_or(0), request.margin};
    if (request.adaptive)
        check_adaptive(studies.front()->study(), request.files.front(), choice);
    const RunOptions run = machine.run_options();
    check_can_run(studies, machine.backend);
    const std::vector<std::string> names = names_of(request, files);
    observer.begin();
    for (const auto& study : studies) {
        for (const std::string& warning : study->warnings())
            observer.warn(study->name() + ": " + warning);
        if (study->notice())
            observer.warn(study->name() + ": " + *study->notice());
    }
    ComparisonEnd end;
    if (request.adaptive)
        end.comparison = compare_adaptively(studies, names, choice, request.level, run, observer);
    else if (run_all(studies, run, observer))
        end.comparison = comparison_of(names, files, request.level);
    if (end.comparison) {
        end.invalid = too_many_invalid(studies);
        return end;
    }
    for (const auto& study : studies) {
        end.done += study->done();
        end.total += study->header().total;
    }
    return end;
}

ComparisonEnd compare_results(const ComparisonRequest& request)
{
    const std::string& base = request.files.front();
    if (!request.settings.empty())
        throw InputError(fmt::format("--set {}: the studies of results are fixed", request.settings.front()));
    if (request.adaptive)
        throw InputError(
            fmt::format("--adaptive {}: {} is finished; give study files instead", *request.adaptive, base));
    if (request.files.size() < 2)
        throw InputError(base, 0, "is one result.\n  Give those of its variants too: compare BASE.h5 VARIANT.h5 ...");
    for (const std::string& file : request.files)
        if (std::ranges::count(request.files, file) > 1)
            throw InputError(fmt::format("compare: {} is given twice; give each study once", file));
    std::vector<std::string> texts;
    for (const auto& results : results_to_compare(request.files))
        texts.push_back(results->header().study_toml);
    check_place(request, request.files, texts);
    return {.comparison = comparison_of(names_of(request, request.files), request.files, request.level)};
}

} // namespace

bool are_study_files(const std::vector<std::string>& files)
{
    for (const std::string& file : files)
        check_kind(file, "compare");
    const RecognisedFile first = recognise(files.front());
    for (const std::string& file : files)
        if (const RecognisedFile other = recognise(file); other.kind != first.kind)
            throw InputError(
                fmt::format("compare: {} is {}, and {} is {}.\n  Give study files, or results of them all.",
                            files.front(), describe(first), file, describe(other)));
    return first.kind != FileKind::results;
}

ComparisonEnd compare_files(const ComparisonRequest& request, const Machine& machine, WorkObserver& observer)
{
    if (!(request.level >= 0.5 && request.level <= 0.9999))
        throw InputError(fmt::format("--level {}: is outside [0.5, 0.9999].", request.level));
    if (!(request.margin >= 0.001 && request.margin <= 0.5))
        throw InputError(fmt::format("--margin {}: is outside [0.001, 0.5].", request.margin));
    ComparisonEnd end =
        are_study_files(request.files) ? compare_study_files(request, machine, observer) : compare_results(request);
    if (end.comparison && request.output)
        write_comparison(*end.comparison, *request.output);
    return end;
}

SearchEnd search_study_file(const SearchRequest& request, const Machine& machine, WorkObserver& observer)
{
    if (request.picture) {
        if (!is_picture_format(ending_of(*request.picture)))
            throw InputError(fmt::format("-o {}: --search writes a picture there (png, svg or pdf); its points have "
                                         "results files of their own",
                                         *request.picture));
        check_output(request.study, *request.picture, request.force);
        AtomicFile::check(*request.picture);
        check_picture(*request.picture); // refuses before anything is run
    }
    const SearchFiles files{request.study, request.settings, ""};
    check_search(files);
    const RunOptions run = machine.run_options();
    observer.begin();
    SearchEnd end{search(files, request.level, run, observer), {}};
    if (!end.result)
        return end;
    if (request.picture)
        plot_search(*end.result, *request.picture);
    const LoadedStudy study = LoadedStudy::from_file(request.study, request.settings);
    for (const SearchedRun& searched : end.result->runs)
        if (!end.invalid)
            end.invalid = too_many_invalid(study.study(), searched.invalid, searched.total, searched.results);
    return end;
}

} // namespace stylobate
