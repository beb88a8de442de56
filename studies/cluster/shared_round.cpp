#include "studies/cluster/shared_round.hpp"

#include "ensemble/run/deal.hpp"
#include "io/store/result_layout.hpp"
#include "io/store/result_seal.hpp"
#include "studies/experiment/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// Rows as bytes between processes: each as a results file has it.
class RowBytes {
public:
    explicit RowBytes(const ResultHeader& header) : layout_(header), row_(layout_.row_bytes()) {}

    void append(std::string& bytes, const ResultRow& row)
    {
        layout_.encode(0, row, row_);
        bytes.append(reinterpret_cast<const char*>(row_.data()), row_.size());
    }

    /// @pre the bytes are whole rows
    template <class F>
    void each(std::string_view bytes, const F& f)
    {
        for (; !bytes.empty(); bytes.remove_prefix(row_.size())) {
            std::memcpy(row_.data(), bytes.data(), row_.size());
            f(layout_.decode(0, row_));
        }
    }

private:
    const ResultLayout layout_;
    std::vector<std::byte> row_;
};

/// What rank 0 knows of the whole round: it takes the rows, and makes of its own progress that of all ranks.
class Whole : public Observer {
public:
    Whole(const RunPlan& plan, const RunOrder& order, const TakeRow& take, Observer& observer)
        : order_(order), places_(order.places(plan.shard)),
          done_(plan.done.parts().empty() ? DoneSet(order) : plan.done), take_(take), observer_(observer)
    {
        for (std::size_t number = 0; number < plan.indices.size(); ++number)
            number_of_.emplace(plan.indices[number], number);
    }

    /// @param block_steps of another rank's row; of its own the executor counts them
    void add(const ResultRow& row, std::uint64_t block_steps)
    {
        const std::lock_guard lock(mutex_);
        take_(row);
        const std::uint64_t number = number_of_.empty() ? row.index : number_of_.at(row.index);
        done_.add(order_.place(number), row.outcome.state == State::collapsed, row.outcome.state == State::invalid);
        block_steps_ += block_steps;
        ++run_;
    }

    Progress all(Progress own) const
    {
        const std::lock_guard lock(mutex_);
        const DoneSet::Part part = done_.all(), sample = done_.sample(places_.begin);
        own.done = part.end;
        own.collapsed = part.collapsed;
        own.invalid = part.invalid;
        own.block_steps += block_steps_;
        own.rate = own.seconds > 0 ? static_cast<double>(run_) / own.seconds : 0;
        if (sample.end > 0)
            estimate_share(own, sample.done(places_.begin) - sample.invalid, sample.collapsed);
        return own;
    }
    void progress(const Progress& own) override { observer_.progress(all(own)); }

private:
    const RunOrder& order_;
    const RunOrder::Places places_;
    std::unordered_map<std::uint64_t, std::uint64_t> number_of_; ///< by index, where the plan has a list of them
    mutable std::mutex mutex_; ///< guards what follows: rows come from the executor and from the deal
    DoneSet done_;
    std::uint64_t block_steps_ = 0, run_ = 0;
    const TakeRow& take_;
    Observer& observer_;
};

/// Reports the progress of the round to its observer, if there is one, and ends the round once any rank is asked to
/// stop.
class DealObserver : public Observer {
public:
    DealObserver(Deal& deal, Observer* told, Observer& asked) : deal_(deal), told_(told), asked_(asked) {}
    void progress(const Progress& own) override
    {
        if (told_)
            told_->progress(own);
    }
    void warn(const std::string& text) override { asked_.warn(text); }
    bool stop_requested() override
    {
        if (asked_.stop_requested())
            deal_.stop();
        return deal_.stopped();
    }

private:
    Deal& deal_;
    Observer* told_;
    Observer& asked_;
};

/// Ranks on machines of different kinds could choose different realizations: that is an error, not a result.
void check_same(Ranks& ranks, const RunPlan& plan)
{
    const std::vector<std::string> all = ranks.of_all(
        fmt::format("{} realizations, checksum {:08x}", plan.total, crc32_of(std::as_bytes(std::span(plan.indices)))));
    const auto other =
        std::find_if(all.begin(), all.end(), [&](const std::string& of_rank) { return of_rank != all[0]; });
    if (other != all.end())
        throw std::runtime_error(fmt::format("the ranks have chosen different realizations for the next round (rank 0: "
                                             "{}; rank {}: {}): run them on machines of one kind, with one program",
                                             all[0], other - all.begin(), *other));
}

} // namespace

SharedRun run_on_ranks(const Experiment& experiment, const RunOptions& options, RunPlan plan,
                       const ResultHeader& header, bool heard, const TakeRow& take, Observer& observer)
{
    Ranks& ranks = *options.ranks;
    const Study& study = experiment.study();
    const bool leads = ranks.leads();
    check_same(ranks, plan);
    const RunOrder order(plan.total);
    const RunOrder::Places places = order.places(plan.shard);
    RowBytes bytes(header), received(header);
    std::string rows; // of the round, where all are to hear them
    const TakeRow take_here = [&](const ResultRow& row) {
        take(row);
        if (heard)
            bytes.append(rows, row);
    };
    Whole whole(plan, order, take_here, observer);

    std::uint64_t next = places.begin;
    Deal deal(ranks, {[&] { return plan.next_undone(next, places.end); }, places.size() - plan.done.all().end},
              2 * static_cast<std::size_t>(options.threads), [&](std::string_view content) {
                  std::uint64_t block_steps = 0;
                  std::memcpy(&block_steps, content.data(), sizeof block_steps);
                  received.each(content.substr(sizeof block_steps),
                                [&](const ResultRow& row) { whole.add(row, block_steps); });
              });
    plan.next_place = [&] { return deal.next(); };
    plan.processes = ranks.size();
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const ResultRow row = result_row(study, realization, outcome);
        if (leads)
            return whole.add(row, 0);
        const std::uint64_t block_steps = realization.free_blocks() * outcome.steps;
        std::string content(reinterpret_cast<const char*>(&block_steps), sizeof block_steps);
        bytes.append(content, row);
        deal.give(std::move(content));
    };
    DealObserver observed(deal, leads ? &whole : nullptr, observer);
    Progress progress = run_ensemble(experiment, options, plan, observed);
    observed.stop_requested(); // it may have been asked at the very end
    const bool complete = deal.finish();
    if (leads)
        observer.progress(progress = whole.all(progress)); // the others may have ended after this one
    if (complete && heard) {
        const std::string all = ranks.of_first(rows);
        if (!leads)
            received.each(all, take);
    }
    return {progress, complete};
}

void share_rows(Ranks& ranks, const ResultHeader& header, const std::function<void(const TakeRow&)>& each,
                const TakeRow& take)
{
    RowBytes bytes(header);
    std::string rows;
    if (ranks.leads())
        each([&](const ResultRow& row) { bytes.append(rows, row); });
    const std::string all = ranks.of_first(rows);
    if (!ranks.leads())
        bytes.each(all, take);
}

} // namespace stylobate
