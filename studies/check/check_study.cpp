#include "studies/check/check_study.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "io/plots/plot_structure.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/run_study.hpp"

#include <fmt/format.h>

#include <utility>

namespace stylobate {

namespace {

constexpr std::uint64_t usual_pilot = 1024, least_pilot = 16, most_pilot = 10'000'000;
constexpr double most_trial_seconds = 3600, most_law_seconds = 86400;

/// Why a part of the study cannot be run twice; empty: it can.
std::string no_pilot(const Study& study)
{
    if (study.kind == StudyKind::single || study.kind == StudyKind::fragility || study.kind == StudyKind::survival ||
        (study.kind == StudyKind::surface && !study.surface->adaptive))
        return {}; // a realization is drawn by its index alone
    return fmt::format("the realizations of study.kind = \"{}\"{} are chosen by what others did. Check the same "
                       "structure and shaking as a surface.",
                       word_for(study_kind_names, study.kind), study.surface ? " with surface.adaptive" : "");
}

/// How many realizations are run twice.
std::uint64_t pilot_of(const CheckPlan& plan, const Study& study, const std::string& file)
{
    const std::uint64_t pilot = plan.pilot.value_or(usual_pilot);
    if (pilot != 0 && (pilot < least_pilot || pilot > most_pilot))
        throw InputError(
            fmt::format("--pilot {}: a pilot has {} to {} realizations; 0: none", pilot, least_pilot, most_pilot));
    if (const std::string why = no_pilot(study); plan.pilot && pilot > 0 && !why.empty())
        throw InputError(fmt::format("{}: --pilot runs a part of a study twice: {}", file, why));
    return pilot;
}

} // namespace

StudyCheck::StudyCheck(LoadedStudy loaded, std::string file, CheckPlan plan, const RunOptions& run)
    : loaded_(std::move(loaded)),
      plan_(std::move(plan)), report_{.file = std::move(file), .study = loaded_.study(), .run = run}
{
    if (!(plan_.trial_seconds >= 0 && plan_.trial_seconds <= most_trial_seconds))
        throw InputError(fmt::format("--trial-seconds {}: a trial takes 0 to {} s; 0: none", plan_.trial_seconds,
                                     most_trial_seconds));
    if (!(plan_.law_seconds >= 0 && plan_.law_seconds <= most_law_seconds))
        throw InputError(fmt::format("--law-seconds {}: other contact laws take 0 to {} s; 0: none", plan_.law_seconds,
                                     most_law_seconds));
    report_.warnings = loaded_.warnings(report_.file);
    pilot_ = pilot_of(plan_, report_.study, report_.file);
    report_.why_no_pilot = pilot_ == 0 ? "--pilot 0." : no_pilot(report_.study);
    header_ = loaded_.result_header();
    kind_ = make_kind(loaded_.study(), header_);
    report_.notice = kind_->prepare(loaded_.experiment(), report_.file);
    trajectories_ = trajectories_of_run(loaded_, report_.file);
}

bool StudyCheck::draw_realizations(Observer& observer)
{
    const double before_s = processor_seconds();
    const bool all = check_realizations(loaded_.sampler(), *kind_, observer);
    drawing_s_ = processor_seconds() - before_s;
    return all;
}

std::optional<CheckReport> StudyCheck::run(Observer& observer)
{
    const auto tell = [&](const std::string& stage) {
        if (plan_.stage)
            plan_.stage(stage);
    };
    CheckReport report = report_;
    if (plan_.trial_seconds > 0) {
        tell(fmt::format("trial of {:.3g} s", plan_.trial_seconds));
        report.trial = try_study(loaded_.experiment(), report.run, plan_.trial_seconds, trajectories_, observer);
    }
    if (observer.stop_requested())
        return std::nullopt;
    const Trial* trial = report.trial ? &*report.trial : nullptr;
    report.size = size_of_run(loaded_, trajectories_, trial);
    if (trial && !trial->unfinished)
        report.time = time_of_run(loaded_, *trial, report.size, drawing_s_);
    else if (trial && trial->lane_s_per_step > 0)
        report.time = longest_time_of_run(*trial, report.size);
    report.memory_bytes = memory_of_run(report.study, report.size, peak_memory_bytes());
    tell("weak spots");
    report.counted = counted_trials(loaded_);
    report.free = free_motion(report.study);
    report.weak = weak_spots(loaded_, loaded_.implausibilities(), trial, &report.free);
    report.not_looked_for = not_looked_for(loaded_, trial, report.free);
    if (report.why_no_pilot.empty()) {
        tell(fmt::format("pilot of {} realizations, run twice", pilot_));
        const Experiment& experiment = loaded_.experiment();
        const PartRun plain =
            run_part(experiment, report.run, spread_evenly(pilot_, experiment.study().total()), observer);
        if (!observer.stop_requested())
            report.pilot = check_numerics(experiment, report.run, plain, observer);
        if (!observer.stop_requested() && plan_.law_seconds > 0)
            report.laws = measure_law_share(experiment, report.run, plain, plan_.law_seconds,
                                            plan_.costs ? plan_.costs : plan_.stage, observer);
        else
            report.laws.why_none = "--law-seconds 0.";
    } else {
        report.laws.why_none = pilot_ == 0 ? "--pilot 0." : "There is no pilot.";
    }
    if (observer.stop_requested())
        return std::nullopt;
    return report;
}

void draw_study(const Study& study, const std::string& file, const std::filesystem::path& picture)
{
    plot_structure(study, study.title.empty() ? std::filesystem::path(file).stem().string() : study.title, picture);
}

} // namespace stylobate
