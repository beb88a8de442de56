#include "studies/workflow/check.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/study_run.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

constexpr std::uint64_t usual_pilot = 1024, least_pilot = 16, most_pilot = 10'000'000;
constexpr double most_trial_seconds = 3600, most_law_seconds = 86400;

/// Why a part of the study cannot be run twice; nullopt: it can.
std::optional<std::string> no_pilot(const Study& study)
{
    if (const StudyDesign design = study.design(); !design.selected && design.factors == nullptr)
        return std::nullopt; // a realization is drawn by its index alone
    return fmt::format("the realizations of study.kind = \"{}\"{} are chosen by what others did. Check the same "
                       "structure and shaking as a surface.",
                       word_for(study_kind_names, study.kind), study.surface ? " with surface.adaptive" : "");
}

/// How many realizations are run twice.
std::uint64_t pilot_of(const CheckRequest& request, const Study& study, const std::string& file)
{
    const std::uint64_t pilot = request.pilot.value_or(usual_pilot);
    if (pilot != 0 && (pilot < least_pilot || pilot > most_pilot))
        throw InputError(
            fmt::format("--pilot {}: a pilot has {} to {} realizations; 0: none", pilot, least_pilot, most_pilot));
    if (const auto why = no_pilot(study); request.pilot && pilot > 0 && why)
        throw InputError(fmt::format("{}: --pilot runs a part of a study twice: {}", file, *why));
    return pilot;
}

void check_seconds(const CheckRequest& request)
{
    if (!(request.trial_seconds >= 0 && request.trial_seconds <= most_trial_seconds))
        throw InputError(fmt::format("--trial-seconds {}: a trial takes 0 to {} s; 0: none", request.trial_seconds,
                                     most_trial_seconds));
    if (!(request.law_seconds >= 0 && request.law_seconds <= most_law_seconds))
        throw InputError(fmt::format("--law-seconds {}: other contact laws take 0 to {} s; 0: none",
                                     request.law_seconds, most_law_seconds));
}

/// Runs a part of the study twice, and under other contact laws.
void run_pilot(const Experiment& experiment, std::uint64_t pilot, double law_seconds, CheckReport& report,
               WorkObserver& observer)
{
    observer.stage(fmt::format("pilot of {} realizations, run twice", pilot));
    const PartRun plain = run_part(experiment, report.run, spread_evenly(pilot, experiment.study().total()), observer);
    if (!observer.stop_requested())
        report.pilot = check_numerics(experiment, report.run, plain, observer);
    if (!observer.stop_requested() && law_seconds > 0)
        report.laws = measure_law_share(
            experiment, report.run, plain, law_seconds, [&](const std::string& costs) { observer.note(costs); },
            observer);
    else
        report.laws.why_none = "--law-seconds 0.";
}

} // namespace

std::optional<CheckReport> check_study(LoadedStudy loaded, const std::string& file, const CheckRequest& request,
                                       const Machine& machine, WorkObserver& observer)
{
    CheckReport report{.file = file, .study = loaded.study(), .run = machine.run_options()};
    check_seconds(request);
    report.warnings = loaded.warnings(file);
    const std::uint64_t pilot = pilot_of(request, report.study, file);
    report.why_no_pilot = pilot == 0 ? "--pilot 0." : no_pilot(report.study);
    const ResultHeader header = loaded.result_header();
    const std::unique_ptr<Kind> kind = make_kind(loaded.study(), header);
    report.notice = kind->prepare(loaded.experiment(), file);
    const std::uint64_t trajectories = kind->trajectories();
    if (request.drawing)
        check_output(file, *request.drawing, request.force);
    observer.begin();
    const double before_s = processor_seconds();
    if (!check_realizations(loaded.sampler(), *kind, observer)) // draws every one once, as a run does
        return std::nullopt;
    const double drawing_s = processor_seconds() - before_s;
    for (const std::string& warning : report.warnings) // nothing is refused any more
        observer.warn(warning);
    if (request.drawing) {
        draw_study(report.study, file, *request.drawing);
        report.picture = request.drawing->string();
    }
    if (request.trial_seconds > 0) {
        observer.stage(fmt::format("trial of {:.3g} s", request.trial_seconds));
        report.trial = try_study(loaded.experiment(), report.run, request.trial_seconds, trajectories, observer);
    }
    if (observer.stop_requested())
        return std::nullopt;
    const Trial* trial = report.trial ? &*report.trial : nullptr;
    report.size = size_of_run(loaded, *kind, trial);
    if (trial && !trial->unfinished)
        report.time = time_of_run(loaded, *trial, report.size, drawing_s);
    else if (trial && trial->lane_s_per_step > 0)
        report.time = longest_time_of_run(*trial, report.size);
    report.memory_bytes = memory_of_run(report.study, report.size, peak_memory_bytes());
    observer.stage("weak spots");
    report.counted = counted_trials(loaded);
    report.free = free_motion(report.study);
    report.weak = weak_spots(loaded, loaded.implausibilities(), trial, &report.free);
    report.not_looked_for = not_looked_for(loaded, trial, report.free);
    if (!report.why_no_pilot)
        run_pilot(loaded.experiment(), pilot, request.law_seconds, report, observer);
    else
        report.laws.why_none = pilot == 0 ? "--pilot 0." : "There is no pilot.";
    if (observer.stop_requested())
        return std::nullopt;
    return report;
}

} // namespace stylobate
