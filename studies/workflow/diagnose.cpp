#include "studies/workflow/diagnose.hpp"

#include "io/measured/measured_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/workflow/file_kind.hpp"

namespace stylobate {

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
        study = request.start ? *request.start
                              : parse_study(default_study(campaign).text, "the default start study of a diagnosis",
                                            request.settings);
        demand_double(study, request.start_name, "a diagnosis");
        demand_plane(study, request.start_name, "a diagnosis");
        how.run = machine.run_options();
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
    std::optional<Diagnosis> found = diagnose(
        campaign, study, how, [&](const std::string& line) { observer.note(line); }, quiet);
    if (found)
        found->measured_fingerprint = fingerprint(request.measured);
    return found;
}

} // namespace stylobate
