#include "studies/kinds/surface/run_counted.hpp"

#include "io/store/tally_store.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/surface/surface.hpp"

namespace stylobate {

CountedRun run_counted(const LoadedStudy& loaded, const RunOptions& options, const std::string& results, bool found,
                       Observer& observer)
{
    const Study& study = loaded.study();
    const ResultHeader header = loaded.result_header();
    const std::unique_ptr<TallyWriter> writer =
        found ? TallyWriter::resume(results, header) : TallyWriter::create(results, header);
    RunPlan plan;
    plan.total = study.total();
    plan.done = writer->done();
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        writer->add(tally_entry(result_row(study, realization, outcome)));
    };
    const Tally& tally = writer->tally();
    const Progress progress = run_ensemble(loaded.experiment(), options, plan, observer);
    const bool complete = progress.done == progress.total;
    if (complete)
        writer->finish(surface_of(header, tally, LimitState::collapse));
    else
        writer->flush();
    return {progress, complete, LimitCounts(tally)};
}

} // namespace stylobate
