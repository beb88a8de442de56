#include "studies/results/study_run.hpp"

#include "studies/cluster/together.hpp"
#include "studies/results/kinds.hpp"

#include <filesystem>
#include <limits>
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

ResultHeader header_of(const LoadedStudy& loaded, const Shard& shard)
{
    ResultHeader header = loaded.result_header();
    header.shard = shard;
    return header;
}

} // namespace

StudyRun::StudyRun(LoadedStudy loaded, ResultHeader header, std::string name, std::string results, Ranks* ranks,
                   std::vector<std::string> warnings)
    : loaded_(std::move(loaded)), name_(std::move(name)), results_(std::move(results)), header_(std::move(header)),
      ranks_(ranks), warnings_(std::move(warnings)), kind_(make_kind(loaded_.study(), header_)),
      notice_(results_.empty() && kind_->prepares_file_alone() ? "" : kind_->prepare(loaded_.experiment(), name_)),
      found_(leads() && std::filesystem::exists(results_)),
      finished_(found_ && ResultWriter::is_finished(results_, header_))
{
}

StudyRun::StudyRun(LoadedStudy loaded, std::string name, std::string results, const Shard& shard, Ranks* ranks)
    : StudyRun(loaded, header_of(loaded, shard), name, results, ranks, loaded.warnings(name))
{
}

StudyRun::~StudyRun() = default;

void StudyRun::agree()
{
    if (!ranks_)
        return;
    const std::string first = ranks_->of_first(finished_ ? "finished" : found_ ? "found" : "");
    finished_ = first == "finished";
    found_ = !first.empty();
}

void StudyRun::check_drawn() const
{
    if (!found_) // else it has been done before the file was made
        check_realizations(loaded_.sampler(), *kind_, ranks_ ? part_of(*ranks_) : header_.shard);
}

void StudyRun::open(std::unique_ptr<RunStore> store)
{
    if (store_)
        return;
    store_ = store ? std::move(store) : leads() ? open_store(results_, header_, found_) : std::make_unique<RunStore>();
    found_ = true;
}

RunEnd StudyRun::run(const RunOptions& options, Observer& observer)
{
    if (finished_)
        return {{}, true};
    open();
    store_->give_to(*kind_);
    RunEnd end = run_study(loaded_.experiment(), *kind_, *store_, options, observer, header_.shard);
    if (leads() && end.complete && header_.shard.whole()) {
        kind_->conclude();
        store_->finish(*kind_);
        finished_ = true;
    } else {
        store_->flush();
    }
    store_.reset();
    return end;
}

bool StudyRun::run_some(std::span<const std::uint64_t> indices, const RunOptions& options, Observer& observer)
{
    if (finished_)
        return true;
    open();
    ChosenKind chosen(loaded_.study(), header_, indices);
    const bool complete = run_study(loaded_.experiment(), chosen, *store_, options, observer).complete;
    store_->flush();
    return complete;
}

void StudyRun::keep()
{
    store_->give_to(*kind_);
    store_->flush();
    store_.reset();
}

Progress StudyRun::restore()
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Progress progress{.seconds = unknown, .rate = unknown, .occupancy = unknown};
    const ResultReader reader(results_);
    progress.done = progress.total = reader.done();
    reader.for_each_row([&](const ResultRow& row) {
        kind_->add(row);
        progress.collapsed += row.outcome.state == State::collapsed;
        progress.invalid += row.outcome.state == State::invalid;
    });
    if (const Tally* tally = reader.tally()) {
        kind_->add(*tally);
        progress.collapsed = tally->all_reached(static_cast<std::size_t>(LimitState::collapse));
        progress.invalid = tally->all_invalid();
    }
    kind_->restore(reader);
    kind_->share(progress);
    return progress;
}

void StudyRun::for_each_row(const std::function<void(const ResultRow&)>& f) const
{
    if (store_)
        store_->for_each_row(f);
    else if (std::filesystem::exists(results_))
        ResultReader(results_).for_each_row(f);
}

std::uint64_t StudyRun::invalid() const
{
    std::uint64_t rows = 0;
    for_each_row([&](const ResultRow& row) { rows += row.outcome.state == State::invalid; });
    return rows;
}

std::uint64_t StudyRun::done() const
{
    if (store_) {
        std::uint64_t rows = 0;
        store_->for_each_row([&](const ResultRow&) { ++rows; });
        return rows;
    }
    return std::filesystem::exists(results_) ? ResultReader(results_).done() : 0;
}

} // namespace stylobate
