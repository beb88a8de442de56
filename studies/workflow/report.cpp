#include "studies/workflow/report.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/compare/law_runs.hpp"
#include "studies/measured/calibration/calibration_text.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/results/result_page.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"
#include "studies/workflow/risk.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace stylobate {

namespace {

AnimationOptions animation_options(const PageRequest& request, const Machine& machine)
{
    for (const auto& [option, value] :
         {std::pair("--animate-mb", request.animate_mb), std::pair("--animate-seconds", request.animate_seconds)})
        if (value && std::isnan(*value)) // the command line's range lets it pass
            throw InputError(fmt::format("{} nan: a number is needed", option));
    AnimationOptions animations;
    animations.each = request.animate.value_or(animations.each);
    animations.budget_mb = request.animate_mb.value_or(animations.budget_mb);
    animations.seconds = request.animate_seconds.value_or(animations.seconds);
    animations.wanted = (request.animate && *request.animate > 0) || request.animate_mb || request.animate_seconds;
    animations.threads = machine.thread_count();
    return animations;
}

/// Diagnoses and calibrations have no realizations, and no study whose keys could be set.
void check_no_realizations(const PageRequest& request, const char* kind)
{
    check_no_settings(request.settings, request.file);
    if (request.web)
        throw InputError(
            fmt::format("--web: {} is a {}, whose page has no study to open in the browser", request.file, kind));
    if (request.animate || request.animate_mb || request.animate_seconds)
        throw InputError(
            fmt::format("--animate{}: {} is a {} and contains no realizations to choose from; its page has "
                        "the windows in motion that the file has",
                        request.animate      ? ""
                        : request.animate_mb ? "-mb"
                                             : "-seconds",
                        request.file, kind));
}

/// Without a file a page is asked for.
bool is_page(const PageRequest& request)
{
    return !request.output || is_page_name(*request.output);
}

std::string written(const PageRequest& request, const Document& document)
{
    return request.output ? document_as(document, *request.output) : html_of(document);
}

MadePage page_of_results(const PageRequest& request, const Machine& machine, WorkObserver& observer)
{
    const Results results(request.file, request.settings);
    check_complete(results.reader(), request.file);
    if (request.output)
        AtomicFile::check(*request.output); // refuses before realizations are run and pictures drawn
    MadePage page;
    AnimationOptions options = animation_options(request, machine);
    if (!is_page(request)) {
        if (options.wanted)
            throw InputError(fmt::format("-o {}: only a page (.html) shows realizations in motion.\n  Leave out "
                                         "--animate, --animate-mb and --animate-seconds.",
                                         *request.output));
        options.each = 0;
    }
    const KeptAnimations animations = keep_animations(results, machine.isa(), options, observer);
    if (animations.warning)
        page.warnings.push_back(*animations.warning);
    if (!observer.stop_requested())
        page.text = written(request, result_page(results, machine.isa(), request.title, animations,
                                                 law_band_beside(request.file, results.study(), results.header()),
                                                 request.web, page.warnings));
    return page;
}

} // namespace

std::optional<MadePage> make_page(const PageRequest& request, const Machine& machine, WorkObserver& observer)
{
    const std::string& file = request.file;
    check_kind(file, "report");
    if (request.output) {
        check_output(file, *request.output, request.force);
        check_document_ending(*request.output);
    }
    observer.begin();
    MadePage page;
    const FileKind kind = recognise(file).kind;
    if (kind == FileKind::diagnosis) {
        check_no_realizations(request, "diagnosis");
        page.text = written(request, diagnosis_page(read_diagnosis(file), file, request.title));
    } else if (kind == FileKind::comparison) {
        check_no_realizations(request, "comparison");
        page.text = written(request, comparison_page(read_comparison(file), file, request.title, page.warnings));
    } else if (kind == FileKind::calibration) {
        check_no_realizations(request, "calibration");
        page.text = written(request, calibration_page(read_calibration(file), file, request.title));
    } else if (kind == FileKind::risk) {
        check_no_realizations(request, "risk estimate");
        page.text = written(request, risk_page(read_any_risk(file), file, request.title));
    } else {
        page = page_of_results(request, machine, observer);
    }
    if (observer.stop_requested())
        return std::nullopt;
    if (request.output)
        write_whole(*request.output, page.text);
    for (const std::string& warning : page.warnings)
        observer.warn(warning);
    return page;
}

} // namespace stylobate
