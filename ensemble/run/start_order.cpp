#include "ensemble/run/start_order.hpp"

#include "ensemble/numerics/in_parallel.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace stylobate {

std::vector<std::uint64_t> longest_places(RunOrder::Places places, const DoneSet& done, std::size_t most,
                                          const std::function<double(std::uint64_t place)>& most_steps)
{
    std::vector<std::uint64_t> waiting;
    for (std::uint64_t place = places.begin; place < places.end && waiting.size() < most_looked_at; ++place)
        if (!done.has(place))
            waiting.push_back(place);
    if (most == 0 || waiting.size() < 2)
        return {};
    std::vector<double> steps(waiting.size());
    in_parallel(std::size_t{0}, waiting.size(), [&](std::size_t i) { steps[i] = most_steps(waiting[i]); });
    const double mean = std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
    if (*std::max_element(steps.begin(), steps.end()) <= equally_long * mean)
        return {};
    std::vector<std::size_t> order(waiting.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    most = std::min(most, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                      [&](std::size_t a, std::size_t b) { return std::pair(-steps[a], a) < std::pair(-steps[b], b); });
    std::vector<std::uint64_t> longest;
    for (std::size_t i = 0; i < most; ++i)
        longest.push_back(waiting[order[i]]);
    return longest;
}

void StartOrder::start_first(std::vector<std::uint64_t> longest, std::size_t apart)
{
    const std::lock_guard lock(mutex_);
    longest_ = std::move(longest);
    apart_begin_ = 0;
    apart_end_ = longest_begin_ = std::min(apart, longest_.size());
    moved_ = longest_;
    std::sort(moved_.begin(), moved_.end());
}

std::optional<std::uint64_t> StartOrder::next()
{
    {
        const std::lock_guard lock(mutex_);
        if (!returned_.empty()) {
            const std::uint64_t place = returned_.back();
            returned_.pop_back();
            return place;
        }
        if (longest_begin_ < longest_.size())
            return longest_[longest_begin_++];
    }
    std::optional<std::uint64_t> place = next_(); // it may wait: without the lock
    while (place && std::binary_search(moved_.begin(), moved_.end(), *place))
        place = next_();
    return place;
}

std::optional<std::uint64_t> StartOrder::next_apart()
{
    const std::lock_guard lock(mutex_);
    if (apart_begin_ == apart_end_)
        return std::nullopt;
    return longest_[apart_begin_++];
}

void StartOrder::give_back(std::uint64_t place)
{
    const std::lock_guard lock(mutex_);
    returned_.push_back(place);
}

} // namespace stylobate
