#include "ensemble/estimators/paired/paired_allocation.hpp"

#include <optional>

namespace stylobate {

PairedAllocation::PairedAllocation(const PairedBudget& budget, std::size_t cells, std::uint64_t most, double level)
    : budget_(budget), looks_(budget.minimum, most, level), rounds_(budget.pairs, cells)
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
    return rounds_.next(looks_.pairs(), [&](std::size_t cell) -> std::optional<double> {
        return decided(counts[cell]) ? std::nullopt : std::optional(interval(counts[cell]).half_width());
    });
}

} // namespace stylobate
