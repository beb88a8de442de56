#include "ensemble/estimators/paired/paired_allocation.hpp"

#include "ensemble/estimators/surface/widest_first.hpp"

#include <algorithm>
#include <utility>

namespace stylobate {

PairedAllocation::PairedAllocation(const PairedBudget& budget, std::size_t cells, std::uint64_t most, double level)
    : budget_(budget), looks_(budget.minimum, most, level), asked_(cells, 0)
{
}

PairedDifference PairedAllocation::interval(const PairedCounts& counts) const
{
    if (counts.pairs() == 0)
        return {};
    return score_interval(static_cast<double>(counts.pairs()), static_cast<double>(counts.base_only),
                          static_cast<double>(counts.variant_only), looks_.quantile());
}

bool PairedAllocation::decided(const PairedCounts& counts) const
{
    const PairedDifference found = interval(counts);
    return found.lower > 0 || found.upper < 0 || (found.lower >= -budget_.margin && found.upper <= budget_.margin);
}

const std::vector<std::uint64_t>& PairedAllocation::next(std::span<const PairedCounts> counts)
{
    if (rounds_ == 0) {
        std::fill(asked_.begin(), asked_.end(), looks_.pairs().front());
        ++rounds_;
        return asked_;
    }
    std::vector<std::pair<double, std::size_t>> open; // by width
    for (std::size_t cell = 0; cell < asked_.size(); ++cell)
        if (asked_[cell] < looks_.pairs().back() && !decided(counts[cell]))
            open.emplace_back(interval(counts[cell]).half_width(), cell);
    rounds_ += proceed_widest_first(
        std::move(open), budget_.pairs, [this](std::uint64_t asked) { return looks_.after(asked); }, asked_);
    return asked_;
}

} // namespace stylobate
