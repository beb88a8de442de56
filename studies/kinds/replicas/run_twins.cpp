#include "studies/kinds/replicas/run_twins.hpp"

#include "ensemble/replicas/twins.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/round.hpp"

#include <numeric>

namespace stylobate {

TwinsRun run_twins(const LoadedStudy& loaded, const RunOptions& options, const ResultWriter& writer,
                   const std::function<void(const ResultRow&)>& sink, Observer& observer)
{
    const Study& study = loaded.study();
    TwinsRun run;
    run.progress.total = study.total();
    for (const TwinRange& range : twin_ranges(study)) {
        std::vector<std::uint64_t> indices(range.end - range.begin);
        std::iota(indices.begin(), indices.end(), range.begin);
        RunPlan plan;
        plan.total = indices.size();
        plan.indices = indices;
        plan.as = &range.study;
        plan.mark_done([&](std::uint64_t index) { return writer.state(index); });
        plan.sink = [&](const Realization& realization, const Outcome& outcome) {
            sink(result_row(study, realization, outcome));
        };
        RoundObserver observed(observer, run.progress, range.begin == 0); // twins are no further trials
        const Progress progress = run_ensemble(loaded.experiment(), options, plan, observed);
        run.progress = observed.joined(progress);
        if (progress.done < plan.total)
            return run;
    }
    run.followed = follow_twins(loaded.experiment(), options, observer);
    run.complete = !observer.stop_requested();
    return run;
}

} // namespace stylobate
