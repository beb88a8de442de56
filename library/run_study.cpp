#include "library/run_study.hpp"

#include "io/store/result_store.hpp"
#include "library/inside.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/adaptive/run_adaptive.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/kinds/rare/run_rare.hpp"
#include "studies/kinds/replicas/run_twins.hpp"
#include "studies/kinds/sensitivity/sensitivity.hpp"
#include "studies/kinds/single/kept_trajectories.hpp"
#include "studies/kinds/surface/run_counted.hpp"
#include "studies/kinds/surface/surface.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <filesystem>

namespace stylobate::api {

namespace {

/// Draws every realization once, so that one that cannot be run is refused before anything is written.
void check_realizations(const inner::LoadedStudy& loaded)
{
    const std::uint64_t total = loaded.study().rare ? 10 * loaded.study().rare->samples : loaded.study().total();
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, total, 256), [&](const auto& range) {
        for (std::uint64_t index = range.begin(); index != range.end(); ++index)
            loaded.sampler().realization(index);
    });
}

/// The run of a study that keeps rows.
class RowsRun {
public:
    RowsRun(const inner::LoadedStudy& loaded, const inner::RunOptions& options, const std::string& results, bool found,
            inner::Observer& observer)
        : loaded_(loaded), study_(loaded.study()), options_(options), results_(results), observer_(observer),
          header_(loaded.result_header()), cells_(header_.frequency_hz, header_.pga_m_s2),
          outcomes_(header_.frequency_hz.size(), header_.pga_m_s2.size(), study_.realizations),
          writer_(found ? inner::ResultWriter::resume(results, header_) : inner::ResultWriter::create(results, header_))
    {
        if (study_.sensitivity)
            factors_.emplace(study_, header_.input_names);
        if (found)
            inner::ResultReader(results).for_each_row([&](const inner::ResultRow& row) {
                count(row);
                if (study_.surface && study_.surface->adaptive)
                    outcomes_.add(row);
                if (study_.rare)
                    chains_.add(row);
            });
    }

    /// @param kept trajectories of a single study
    void run(std::uint64_t kept)
    {
        const auto sink = [&](const inner::ResultRow& row) {
            writer_->add(row);
            count(row);
        };
        if (study_.rare) {
            const inner::RareRun ran = inner::run_rare(loaded_, options_, chains_, sink, observer_);
            finish(ran.complete, nullptr, &ran.table, nullptr);
        } else if (study_.twins) {
            const inner::TwinsRun ran = inner::run_twins(loaded_, options_, *writer_, sink, observer_);
            const inner::SurfaceTable table = cells_.table();
            finish(ran.complete, &table, nullptr, ran.followed.empty() ? nullptr : &ran.followed);
        } else if (study_.surface && study_.surface->adaptive) {
            const inner::AdaptiveRun ran = inner::run_adaptive(loaded_, options_, outcomes_, sink, observer_);
            finish(ran.complete, ran.table ? &*ran.table : nullptr, nullptr, nullptr);
        } else {
            const bool complete = study_.kind == inner::StudyKind::single ? run_single(kept, sink) : run_many(sink);
            const inner::SurfaceTable table = cells_.table();
            finish(complete, study_.surface ? &table : nullptr, nullptr, nullptr);
        }
    }

private:
    void count(const inner::ResultRow& row)
    {
        if (row.index < study_.originals())
            cells_.add(row);
        if (factors_)
            factors_->add(row);
    }

    template <class Sink>
    bool run_many(const Sink& sink)
    {
        inner::RunPlan plan;
        plan.total = study_.total();
        plan.mark_done([&](std::uint64_t index) { return writer_->state(index); });
        plan.sink = [&](const inner::Realization& realization, const inner::Outcome& outcome) {
            sink(inner::result_row(study_, realization, outcome));
        };
        const inner::Progress progress = inner::run_ensemble(loaded_.experiment(), options_, plan, observer_);
        return progress.done == progress.total;
    }

    template <class Sink>
    bool run_single(std::uint64_t kept, const Sink& sink)
    {
        const auto begin = std::chrono::steady_clock::now();
        inner::Progress progress;
        progress.total = study_.total();
        for (std::uint64_t index = 0; index < progress.total && !observer_.stop_requested(); ++index) {
            std::optional<inner::State> state = writer_->state(index);
            if (!state) {
                const inner::FollowedRealization f = inner::follow(loaded_.experiment(), index, options_.isa);
                if (index < kept)
                    writer_->add(f.trajectory); // before its row: where the row is, it is
                sink(inner::result_row(study_, f.realization, f.outcome));
                state = f.outcome.state;
            }
            ++progress.done;
            progress.collapsed += state == inner::State::collapsed;
            progress.invalid += state == inner::State::invalid;
            progress.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            inner::estimate_share(progress, progress.done - progress.invalid, progress.collapsed);
            observer_.progress(progress);
        }
        return progress.done == progress.total;
    }

    void finish(bool complete, const inner::SurfaceTable* surface, const inner::RareTable* rare,
                const std::vector<inner::FollowedTwin>* followed)
    {
        if (!complete) {
            writer_->flush();
            return;
        }
        std::optional<inner::SensitivityTable> indices;
        if (factors_)
            indices = factors_->table();
        std::optional<inner::FragilityTable> curves;
        if (study_.fragility)
            curves = inner::fragility_table(inner::fragility_of(inner::ResultReader(results_), results_));
        writer_->finish(surface, indices ? &*indices : nullptr, rare, followed, curves ? &*curves : nullptr);
    }

    const inner::LoadedStudy& loaded_;
    const inner::Study& study_;
    const inner::RunOptions& options_;
    const std::string& results_;
    inner::Observer& observer_;
    inner::ResultHeader header_;
    inner::SurfaceCounts cells_;
    inner::CellOutcomes outcomes_;
    inner::RareOutcomes chains_;
    std::optional<inner::SensitivityOutcomes> factors_;
    std::unique_ptr<inner::ResultWriter> writer_;
};

} // namespace

void run_study(const inner::LoadedStudy& loaded, const inner::RunOptions& options, const std::string& results,
               const std::string& name, inner::Observer& observer)
{
    const inner::KeptTrajectories kept = loaded.study().kind == inner::StudyKind::single
                                             ? inner::plan_trajectories(loaded, name)
                                             : inner::KeptTrajectories{};
    const bool found = std::filesystem::exists(results);
    if (!found) // else it has been done before the file was made
        check_realizations(loaded);
    const inner::ResultHeader header = loaded.result_header();
    if (found && inner::ResultWriter::is_finished(results, header))
        return;
    if (header.has_rows())
        RowsRun(loaded, options, results, found, observer).run(kept.count);
    else
        inner::run_counted(loaded, options, results, found, observer);
}

} // namespace stylobate::api
