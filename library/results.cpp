#include "library/results.hpp"

#include "library/outcomes.hpp"

#include <algorithm>

namespace stylobate::api {

Result::Data::Data(inner::ResultHeader of, inner::Study from, std::string called)
    : header(std::move(of)), study(std::move(from)), name(std::move(called)),
      limits(header.block_names.size(),
             header.kind == "replay" ? inner::MotionGroups{} : inner::motion_groups(study, header.motions)),
      trials_(header.kind == "replay" ? study.total() : study.originals())
{
    if (!header.frequency_hz.empty())
        for (std::size_t i = 0; i < inner::limit_state_names().size(); ++i)
            counts_.emplace_back(header.frequency_hz, header.pga_m_s2, static_cast<inner::LimitState>(i));
}

void Result::Data::count_the_first(const std::function<bool(std::uint64_t)>& has)
{
    if (header.selected || study.kind == inner::StudyKind::single)
        return; // their realizations begin in another order
    order_.emplace(trials_);
    while (places_ < trials_ && has(order_->index(places_)))
        ++places_;
    places_ = order_->fair(places_);
}

bool Result::Data::counts(std::uint64_t index) const
{
    return index < trials_ && (!order_ || order_->place(index) < places_);
}

void Result::Data::add(const inner::ResultRow& row)
{
    ++done;
    invalid += row.outcome.state == inner::State::invalid;
    if (header.has_rows())
        outcomes.push_back(outcome_of(row));
    if (!counts(row.index))
        return;
    limits.add(row);
    for (inner::SurfaceCounts& each : counts_)
        each.add(row);
}

void Result::Data::add(const inner::Tally& tally)
{
    limits = inner::LimitCounts(tally);
    invalid = tally.all_invalid();
    for (std::size_t i = 0; i < counts_.size(); ++i)
        counts_[i] = inner::SurfaceCounts(inner::surface_of(header, tally, static_cast<inner::LimitState>(i)));
}

void Result::Data::finish(std::optional<inner::SurfaceTable> surface, const inner::Table& of_rare,
                          const inner::Table& of_fragility)
{
    std::sort(outcomes.begin(), outcomes.end(), [](const Outcome& a, const Outcome& b) { return a.index < b.index; });
    for (const inner::SurfaceCounts& each : counts_)
        surfaces.push_back(each.table());
    counts_.clear();
    if (surface && !surfaces.empty())
        surfaces[static_cast<std::size_t>(inner::LimitState::collapse)] = std::move(*surface);
    rare = inner::rare_table(of_rare);
    fragility = inner::fragility_table(of_fragility);
}

} // namespace stylobate::api
