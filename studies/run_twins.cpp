#include "studies/run_twins.hpp"

#include "ensemble/twins.hpp"
#include "studies/round.hpp"
#include "studies/trajectory.hpp"

namespace stylobate {

TwinsRun run_twins(const LoadedStudy& loaded, const RunOptions& options, const ResultWriter& writer,
                   const std::function<void(const ResultRow&)>& sink, Observer& observer)
{
    const Study& study = loaded.study();
    const std::vector<std::uint64_t> states = writer.rows_by_state();
    TwinsRun run;
    run.progress.total = study.total();
    run.progress.done = writer.rows();
    run.progress.collapsed = states[static_cast<std::size_t>(State::collapsed)];
    run.progress.invalid = states[static_cast<std::size_t>(State::invalid)];
    for (const TwinRange& range : twin_ranges(study)) {
        std::vector<std::uint64_t> left;
        for (std::uint64_t index = range.begin; index < range.end; ++index)
            if (!writer.has(index))
                left.push_back(index);
        if (left.empty())
            continue;
        RunPlan plan;
        plan.total = left.size();
        plan.indices = left;
        plan.sink = [&](const Realization& realization, const Outcome& outcome) {
            sink(result_row(study, realization, outcome));
        };
        RoundObserver observed(observer, run.progress);
        const Progress progress = run_ensemble(range.study, loaded.sampler(), loaded.record(), options, plan, observed);
        run.progress = observed.joined(progress);
        if (progress.done < plan.total)
            return run;
    }
    run.followed = follow_twins(study, loaded.sampler(), loaded.record(), options, observer);
    run.complete = !observer.stop_requested();
    return run;
}

} // namespace stylobate
