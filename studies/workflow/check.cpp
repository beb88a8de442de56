#include "studies/workflow/check.hpp"

#include "studies/workflow/output_path.hpp"

#include <utility>

namespace stylobate {

std::optional<CheckReport> check_study(LoadedStudy loaded, const std::string& file, const CheckRequest& request,
                                       const Machine& machine, WorkObserver& observer)
{
    StudyCheck check(std::move(loaded), file,
                     {.pilot = request.pilot,
                      .trial_seconds = request.trial_seconds,
                      .law_seconds = request.law_seconds,
                      .stage = [&](const std::string& stage) { observer.stage(stage); },
                      .costs = [&](const std::string& costs) { observer.note(costs); }},
                     machine.run_options());
    if (request.drawing)
        check_output(file, *request.drawing, request.force);
    observer.begin();
    if (!check.draw_realizations(observer))
        return std::nullopt;
    for (const std::string& warning : check.warnings()) // nothing is refused any more
        observer.warn(warning);
    if (request.drawing)
        draw_study(check.study(), file, *request.drawing);
    std::optional<CheckReport> report = check.run(observer);
    if (report && request.drawing)
        report->picture = request.drawing->string();
    return report;
}

} // namespace stylobate
