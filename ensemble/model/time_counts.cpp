#include "ensemble/model/time_counts.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>

namespace stylobate {

namespace {

/// The middle of the interval in which all times have the same leading bits: sign, exponent and 12 of the fraction.
double rounded(double time_s)
{
    constexpr int dropped = 52 - 12;
    const auto bits = std::bit_cast<std::uint64_t>(time_s);
    return std::bit_cast<double>((bits >> dropped << dropped) | (std::uint64_t{1} << (dropped - 1)));
}

} // namespace

void TimeCounts::add(double time_s)
{
    const double time = exact_ ? time_s : rounded(time_s);
    const auto at = std::lower_bound(counts_.begin(), counts_.end(), time,
                                     [](const auto& known, double value) { return known.first < value; });
    if (at != counts_.end() && at->first == time)
        ++at->second;
    else
        counts_.insert(at, {time, 1});
    limit(false);
}

void TimeCounts::add(const TimeCounts& other)
{
    limit(!other.exact_);
    TimeCounts more = other;
    more.limit(!exact_);
    Counts all;
    std::merge(counts_.begin(), counts_.end(), more.counts_.begin(), more.counts_.end(), std::back_inserter(all));
    counts_.clear();
    for (const auto& [time, count] : all)
        if (!counts_.empty() && counts_.back().first == time)
            counts_.back().second += count;
        else
            counts_.emplace_back(time, count);
    limit(false);
}

void TimeCounts::limit(bool round)
{
    if (!exact_ || (!round && counts_.size() <= most_exact))
        return;
    exact_ = false;
    Counts all;
    for (const auto& [value, count] : counts_)
        if (const double middle = rounded(value); !all.empty() && all.back().first == middle)
            all.back().second += count;
        else
            all.emplace_back(middle, count);
    counts_ = std::move(all);
}

std::uint64_t TimeCounts::total() const
{
    std::uint64_t total = 0;
    for (const auto& [time, count] : counts_)
        total += count;
    return total;
}

double TimeCounts::median() const
{
    const std::uint64_t n = total();
    if (n == 0)
        return std::numeric_limits<double>::quiet_NaN();
    double lower = 0;
    bool found = false;
    std::uint64_t before = 0;
    for (const auto& [time, count] : counts_) {
        before += count;
        if (!found && before > (n - 1) / 2) {
            lower = time;
            found = true;
        }
        if (before > n / 2)
            return n % 2 == 1 ? time : (lower + time) / 2;
    }
    return lower;
}

} // namespace stylobate
