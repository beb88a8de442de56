#include "ensemble/estimators/surface/adaptive.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>

namespace stylobate {

AdaptiveAllocation::AdaptiveAllocation(const AdaptiveSpec& spec, std::size_t rows, std::size_t columns,
                                       std::uint64_t most)
    : spec_(spec), analyses_(spec.minimum, most, spec.half_width, adaptive_level), model_(adaptive_level),
      rounds_(spec.budget, rows * columns)
{
    assert(spec.minimum * asked().size() <= spec.budget && "checked where the study is read");
}

std::vector<CellEstimate> AdaptiveAllocation::estimate(const SurfaceTrials& data)
{
    if (!estimates_.empty() && known_.trials == data.trials && known_.collapses == data.collapses)
        return estimates_;
    std::vector<SurfaceEstimate> surface;
    if (spec_.borrow)
        surface = model_.estimate(data);
    std::vector<CellEstimate> estimates;
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        const std::uint64_t n = data.trials[cell];
        const BinomialInterval own = analyses_.interval(n, data.collapses[cell]);
        // a rough surface can make it wider: then it does not keep a cell going that its own trials have finished
        if (spec_.borrow && surface[cell].agrees_with_neighbours &&
            (analyses_.narrow(surface[cell].interval) || !analyses_.narrow(own)))
            estimates.push_back({surface[cell].probability, surface[cell].interval, IntervalMethod::surface});
        else
            estimates.push_back({n > 0 ? static_cast<double>(data.collapses[cell]) / static_cast<double>(n)
                                       : std::numeric_limits<double>::quiet_NaN(),
                                 own, IntervalMethod::own});
    }
    known_ = data;
    estimates_ = estimates;
    return estimates;
}

const std::vector<std::uint64_t>& AdaptiveAllocation::next(const SurfaceTrials& data)
{
    if (rounds() > 0)
        estimate(data);
    return rounds_.next(analyses_.trials(), [this](std::size_t cell) -> std::optional<double> {
        const BinomialInterval& interval = estimates_[cell].interval;
        return analyses_.narrow(interval) ? std::nullopt : std::optional(interval.upper - interval.lower);
    });
}

} // namespace stylobate
