#include "ensemble/estimators/surface/adaptive.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace stylobate {

AdaptiveAllocation::AdaptiveAllocation(const AdaptiveSpec& spec, std::size_t rows, std::size_t columns,
                                       std::uint64_t most)
    : spec_(spec), analyses_(spec.minimum, most, spec.half_width, adaptive_level), model_(adaptive_level),
      asked_(rows * columns, 0)
{
    assert(spec.minimum * asked_.size() <= spec.budget && "checked where the study is read");
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
        if (spec_.borrow && surface[cell].believed &&
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
    if (rounds_ == 0) {
        std::fill(asked_.begin(), asked_.end(), analyses_.trials().front());
        ++rounds_;
        return asked_;
    }
    const std::vector<CellEstimate> estimates = estimate(data);
    const auto width = [&](std::size_t cell) {
        return estimates[cell].interval.upper - estimates[cell].interval.lower;
    };
    std::vector<std::size_t> wide;
    for (std::size_t cell = 0; cell < asked_.size(); ++cell)
        if (!analyses_.narrow(estimates[cell].interval) && asked_[cell] < analyses_.trials().back())
            wide.push_back(cell);
    std::stable_sort(wide.begin(), wide.end(), [&](std::size_t a, std::size_t b) { return width(a) > width(b); });
    std::uint64_t left = spec_.budget - std::accumulate(asked_.begin(), asked_.end(), std::uint64_t{0});
    bool more = false;
    for (const std::size_t cell : wide) {
        const std::uint64_t add = analyses_.after(asked_[cell]) - asked_[cell];
        if (add > left)
            break;
        asked_[cell] += add;
        left -= add;
        more = true;
    }
    rounds_ += more;
    return asked_;
}

} // namespace stylobate
