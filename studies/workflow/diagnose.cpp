#include "studies/workflow/diagnose.hpp"

#include "io/measured/campaign_writer.hpp"
#include "io/measured/measured_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/joint_tests/procedures.hpp"
#include "studies/measured/loop/laboratory_loop.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace stylobate {

namespace {

/// A diagnosis of a campaign without shake runs: what it is of.
Diagnosis without_shakes(const Campaign& campaign, const Study& study, std::uint64_t seed)
{
    Diagnosis d;
    d.measured_file = campaign.source;
    d.specimen = campaign.specimen.name;
    d.study_toml = study.text;
    d.code_version = code_version();
    d.seed = seed;
    d.verdict_text = "There are no shake runs, so that there is no first diagnosis.";
    d.missing.push_back({"base and sensors; joints and blocks as they move together", "there are no shake runs"});
    for (const Finding& finding : campaign.findings)
        d.data_findings.push_back(finding.place + ": " + finding.text);
    return d;
}

bool any_joint_alone(const Specimen& specimen)
{
    for (int joint = 0; joint < static_cast<int>(specimen.joints.size()); ++joint)
        if (stands_alone(specimen, joint))
            return true;
    return false;
}

/// The tests of single joints after the first diagnosis. @returns false: the observer stopped it
bool tell_tests(const DiagnosisRequest& request, const Campaign& campaign, const Study& study, const RunOptions& run,
                Diagnosis& diagnosis, WorkObserver& observer)
{
    if ((!request.plan && campaign.tests.empty()) || !any_joint_alone(campaign.specimen))
        return true;
    LoopOptions how;
    how.plan.seed = request.seed;
    how.plan.healthy = request.specimens;
    how.cache = request.tests_cache;
    how.planned = campaign.tests.empty() ? 3 : 1;
    how.run = run;
    how.run.ranks = nullptr; // rank 0 alone: there are a few thousand short runs
    const auto begun = std::chrono::steady_clock::now();
    how.progress = [&](std::uint64_t done, std::uint64_t total) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
        Progress progress{.done = done, .total = total, .seconds = passed.count()};
        progress.rate = static_cast<double>(done) / std::max(passed.count(), 1e-9);
        observer.counted("simulated tests", fmt::format("{} of {} simulated tests", done, total), progress);
    };
    StopOnly quiet(observer);
    diagnosis.tests = laboratory_loop(campaign, study, prior_shares(diagnosis), how, quiet);
    if (!diagnosis.tests)
        return false;
    diagnosis.cost.simulations += diagnosis.tests->simulations;
    diagnosis.cost.seconds += diagnosis.tests->seconds;
    diagnosis.cost.threads = run.threads;
    if (TestStory& story = *diagnosis.tests; request.next_test && !story.next.empty())
        if (const Campaign plan = planned_campaign(campaign, story.next); !plan.tests.empty()) {
            write_campaign(plan, *request.next_test);
            story.sheet.push_back(fmt::format("Set-up of each run, and the motion of the table or the board: {}.",
                                              request.next_test->string()));
        }
    return true;
}

} // namespace

std::optional<Diagnosis> diagnose_measured(const DiagnosisRequest& request, const Machine& machine,
                                           WorkObserver& observer)
{
    DiagnosisOptions how;
    how.seed = request.seed;
    how.plan = EnsemblePlan::with(request.nulls);
    how.cache = request.cache;
    Campaign campaign;
    Study study;
    together(machine.ranks, [&] {
        check_kind(request.measured, "diagnose");
        campaign = read_campaign(request.measured);
        for (const std::string& file : request.tests) {
            check_kind(file, "diagnose");
            add_tests_of(read_campaign(file), campaign);
        }
        study = request.start ? *request.start
                              : parse_study(default_study(campaign).text, "the default start study of a diagnosis",
                                            request.settings);
        demand_double(study, request.start_name, "a diagnosis");
        demand_plane(study, request.start_name, "a diagnosis");
        how.run = machine.run_options();
        if (!campaign.runs.empty() || (campaign.tests.empty() && !request.plan))
            campaign_scales(campaign); // refuses data that cannot be diagnosed
        if (!how.run.leads())
            return;
        if (request.check_outputs)
            request.check_outputs();
        check_cache(how);
    });
    observer.begin();
    how.campaigns = [&](const std::string& line, const Progress& p) {
        observer.counted("simulated campaigns", line, p);
    };
    StopOnly quiet(observer); // no progress in realizations: the notes are the stages
    std::optional<Diagnosis> found;
    if (campaign.runs.empty())
        found = without_shakes(campaign, study, request.seed);
    else
        found = diagnose(
            campaign, study, how, [&](const std::string& line) { observer.note(line); }, quiet);
    if (!found || (how.run.leads() && !tell_tests(request, campaign, study, how.run, *found, observer)))
        return std::nullopt;
    found->measured_fingerprint = fingerprint(request.measured);
    return found;
}

} // namespace stylobate
