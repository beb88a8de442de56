#include "studies/results/whole_run.hpp"

#include "studies/results/kinds.hpp"
#include "studies/results/run_store.hpp"
#include "studies/results/run_study.hpp"

#include <filesystem>
#include <utility>

namespace stylobate {

namespace {

/// Runs the realizations that it is given; concludes nothing.
class ChosenKind : public Kind {
public:
    ChosenKind(const Study& study, const ResultHeader& header, std::span<const std::uint64_t> indices)
        : Kind(study, header), indices_(indices)
    {
    }
    bool plan(Rounds& rounds) override { return indices_.empty() || rounds.run({.indices = indices_}); }

private:
    std::span<const std::uint64_t> indices_;
};

} // namespace

WholeRun::WholeRun(LoadedStudy loaded, std::string name, std::string results)
    : loaded_(std::move(loaded)), name_(std::move(name)), results_(std::move(results)),
      header_(loaded_.result_header()), warnings_(loaded_.warnings(name_)), kind_(make_kind(loaded_.study(), header_))
{
    if (const std::string notice = kind_->prepare(loaded_.experiment(), name_); !notice.empty())
        warnings_.push_back(notice);
    found_ = std::filesystem::exists(results_);
    finished_ = found_ && ResultWriter::is_finished(results_, header_);
}

WholeRun::~WholeRun() = default;

void WholeRun::check_drawn() const
{
    if (!found_)
        check_realizations(loaded_.sampler(), *kind_);
}

void WholeRun::open()
{
    if (!store_) {
        store_ = open_store(results_, header_, found_);
        found_ = true;
    }
}

bool WholeRun::run(const RunOptions& options, Observer& observer)
{
    if (finished_)
        return true;
    open();
    store_->give_to(*kind_);
    const StudyRun ran = run_study(loaded_.experiment(), *kind_, *store_, options, observer);
    if (ran.complete) {
        kind_->conclude();
        store_->finish(*kind_);
        finished_ = true;
    } else {
        store_->flush();
    }
    store_.reset();
    return ran.complete;
}

bool WholeRun::run_some(std::span<const std::uint64_t> indices, const RunOptions& options, Observer& observer)
{
    if (finished_)
        return true;
    open();
    ChosenKind chosen(loaded_.study(), header_, indices);
    const bool complete = run_study(loaded_.experiment(), chosen, *store_, options, observer).complete;
    store_->flush();
    return complete;
}

void WholeRun::for_each_row(const std::function<void(const ResultRow&)>& f) const
{
    if (store_)
        store_->for_each_row(f);
    else if (std::filesystem::exists(results_))
        ResultReader(results_).for_each_row(f);
}

std::uint64_t WholeRun::invalid() const
{
    std::uint64_t rows = 0;
    for_each_row([&](const ResultRow& row) { rows += row.outcome.state == State::invalid; });
    return rows;
}

std::uint64_t WholeRun::done() const
{
    if (store_) {
        std::uint64_t rows = 0;
        store_->for_each_row([&](const ResultRow&) { ++rows; });
        return rows;
    }
    return std::filesystem::exists(results_) ? ResultReader(results_).done() : 0;
}

} // namespace stylobate
