#include "studies/experiment/limit_state.hpp"

#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/numerics/interval.hpp"
#include "io/files/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

namespace stylobate {

std::string interval_name()
{
    return fmt::format("jeffreys {}", interval_level);
}

const std::vector<std::string>& limit_state_names()
{
    static const std::vector<std::string> names = {"collapse", "total", "unseated", "rocked", "slid", "moving"};
    return names;
}

LimitState limit_state_of(std::string_view name)
{
    const auto found = std::find(limit_state_names().begin(), limit_state_names().end(), name);
    assert(found != limit_state_names().end() && "the command line lets no other word pass");
    return static_cast<LimitState>(found - limit_state_names().begin());
}

const char* describe(LimitState limit)
{
    switch (limit) {
    case LimitState::collapse:
        return "collapse";
    case LimitState::total:
        return "total collapse";
    case LimitState::unseated:
        return "an unseated epistyle";
    case LimitState::rocked:
        return "rocking without collapse";
    case LimitState::slid:
        return "sliding without collapse";
    case LimitState::moving:
        return "still moving at the end, without collapse";
    }
    return "unknown";
}

bool reached(LimitState limit, const Outcome& outcome)
{
    switch (limit) {
    case LimitState::collapse:
        return outcome.state == State::collapsed;
    case LimitState::total:
        return outcome.total_collapse_time_s >= 0;
    case LimitState::unseated:
        return outcome.unseating_time_s >= 0;
    case LimitState::rocked:
        return outcome.state == State::rocked;
    case LimitState::slid:
        return outcome.state == State::slid;
    case LimitState::moving:
        return outcome.state != State::collapsed && outcome.at_rest == 0;
    }
    return false;
}

TallyEntry tally_entry(const ResultRow& row)
{
    const Outcome& o = row.outcome;
    TallyEntry entry;
    entry.index = row.index;
    entry.cell = row.cell;
    entry.invalid = o.invalid_reason;
    entry.energy_residual = o.energy_residual;
    for (std::size_t limit = 0; limit < limit_state_names().size(); ++limit)
        entry.reached |= static_cast<std::uint32_t>(reached(static_cast<LimitState>(limit), o)) << limit;
    if (reached(LimitState::collapse, o)) {
        entry.first_block = o.first_collapse_block;
        entry.collapse_time_s = o.collapse_time_s;
    }
    entry.total_collapse_time_s = o.total_collapse_time_s;
    return entry;
}

Share share_of(std::uint64_t trials, std::uint64_t count)
{
    const BinomialInterval interval = jeffreys(trials, count, interval_level);
    const double probability = trials > 0 ? static_cast<double>(count) / static_cast<double>(trials)
                                          : std::numeric_limits<double>::quiet_NaN();
    return {trials, count, probability, interval.lower, interval.upper};
}

void LimitCounts::add(const ResultRow& row)
{
    const Outcome& o = row.outcome;
    if (o.state == State::invalid)
        return;
    ++trials_;
    const bool fell = reached(LimitState::collapse, o);
    if (fell)
        collapse_time_s_.add(o.collapse_time_s);
    OfMotion none;
    OfMotion& m = groups_.cells > 0 ? of_motion(groups_.of_cell(row.cell)) : none;
    ++m.trials;
    const auto count = [](std::vector<std::uint64_t>& all, std::vector<std::uint64_t>& of_motion, std::size_t i) {
        ++all[i];
        if (!of_motion.empty())
            ++of_motion[i];
    };
    for (std::size_t limit = 0; limit < reached_.size(); ++limit)
        if (reached(static_cast<LimitState>(limit), o))
            count(reached_, m.reached, limit);
    if (fell && o.first_collapse_block >= 0 && static_cast<std::size_t>(o.first_collapse_block) < first_.size())
        count(first_, m.first, static_cast<std::size_t>(o.first_collapse_block));
    if (fell && o.first_collapse_block == several_blocks) {
        ++first_together_;
        ++m.first_together;
    }
    for (std::size_t i = 0; i < std::min(fallen_.size(), o.fall_time_s.size()); ++i)
        if (o.fall_time_s[i] >= 0)
            count(fallen_, m.fallen, i);
    if (reached(LimitState::total, o))
        total_collapse_time_s_.add(o.total_collapse_time_s);
}

LimitCounts::LimitCounts(const Tally& tally)
    : trials_(tally.all_trials()), first_(tally.blocks), fallen_(tally.blocks), collapse_time_s_(tally.collapse_time_s),
      total_collapse_time_s_(tally.total_collapse_time_s)
{
    for (std::size_t limit = 0; limit < reached_.size(); ++limit)
        reached_[limit] = tally.all_reached(limit);
    for (std::size_t i = 0; i < tally.first.size(); ++i)
        first_[i % tally.blocks] += tally.first[i];
    for (const std::uint64_t together : tally.first_together)
        first_together_ += together;
}

Share LimitCounts::share(std::uint64_t count, const std::function<std::uint64_t(const OfMotion&)>& of_motion) const
{
    Share share = share_of(trials_, count);
    if (groups_.cells == 0)
        return share;
    if (groups_.groups < least_records) {
        share.lower = share.upper = std::nan("");
        return share;
    }
    std::vector<RecordCount> counts;
    for (const OfMotion& m : motions_)
        counts.push_back({static_cast<double>(m.trials), static_cast<double>(of_motion(m))});
    const Limits limits = record_share_limits(counts, interval_level);
    share.lower = limits.lower;
    share.upper = limits.upper;
    return share;
}

Share LimitCounts::share(LimitState limit) const
{
    const auto i = static_cast<std::size_t>(limit);
    return share(reached_[i], [i](const OfMotion& m) { return m.reached[i]; });
}

Share LimitCounts::share_first(std::size_t block) const
{
    return share(first_[block], [block](const OfMotion& m) { return m.first[block]; });
}

Share LimitCounts::share_first_together() const
{
    return share(first_together_, [](const OfMotion& m) { return m.first_together; });
}

Share LimitCounts::share_fallen(std::size_t block) const
{
    return share(fallen_[block], [block](const OfMotion& m) { return m.fallen[block]; });
}

LimitCounts::OfMotion& LimitCounts::of_motion(std::size_t motion)
{
    while (motions_.size() <= motion)
        motions_.push_back({0, std::vector<std::uint64_t>(reached_.size()), std::vector<std::uint64_t>(first_.size()),
                            std::vector<std::uint64_t>(fallen_.size()), 0});
    return motions_[motion];
}

std::string LimitCounts::interval() const
{
    if (groups_.cells == 0)
        return interval_name();
    return groups_.groups < least_records ? "none" : fmt::format("motions {}", interval_level);
}

std::optional<std::string> LimitCounts::moving_text() const
{
    const std::uint64_t moving = reached_[static_cast<std::size_t>(LimitState::moving)];
    if (moving == 0)
        return std::nullopt;
    const std::uint64_t standing = trials_ - reached_[static_cast<std::size_t>(LimitState::collapse)];
    return fmt::format("{} of {} without collapse still moved at the end.", moving, counted(standing, "realization"));
}

double LimitCounts::median_collapse_time_s() const
{
    return collapse_time_s_.median();
}

double LimitCounts::median_total_collapse_time_s() const
{
    return total_collapse_time_s_.median();
}

} // namespace stylobate
