#include "ensemble/estimators/paired/paired_allocation.hpp"

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
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

namespace {

std::vector<std::uint64_t> half_more(std::uint64_t first, std::uint64_t most)
{
    std::vector<std::uint64_t> pairs = {first};
    while (pairs.back() < most) {
        const std::uint64_t next = (pairs.back() * 3 / 2 + 3) / 4 * 4;
        pairs.push_back(std::min(most, std::max(next, pairs.back() + 1)));
    }
    return pairs;
}

} // namespace

RepeatedLooks::RepeatedLooks(std::uint64_t first, std::uint64_t most, double level)
    : RepeatedLooks(half_more(first, most), level)
{
}

RepeatedLooks::RepeatedLooks(std::vector<std::uint64_t> pairs, double level) : pairs_(std::move(pairs))
{
    double low = 0.1, high = 8;
    for (int i = 0; i < 30; ++i) {
        const double middle = (low + high) / 2;
        (inside(middle) < level ? low : high) = middle;
    }
    quantile_ = (low + high) / 2;
}

double RepeatedLooks::p_value(double z) const
{
    return z <= 0 ? 1 : 1 - inside(std::min(z, 12.0));
}

/// Looks that follow each other are few and far enough apart for the trapezoidal rule on a fixed number of points.
double RepeatedLooks::inside(double c) const
{
    constexpr int points = 241;
    const auto bound = [&](std::size_t k) { return c * std::sqrt(static_cast<double>(pairs_[k])); };
    const auto place = [](double b, int i) { return b * (2.0 * i / (points - 1) - 1); };
    const auto weight = [](double b, int i) { return 2 * b / (points - 1) * (i == 0 || i == points - 1 ? 0.5 : 1); };
    std::vector<double> before(points), now(points);
    const double first = std::sqrt(static_cast<double>(pairs_.front()));
    for (int i = 0; i < points; ++i)
        before[static_cast<std::size_t>(i)] = normal_density(place(bound(0), i) / first) / first;
    for (std::size_t k = 1; k < pairs_.size(); ++k) {
        const double step = std::sqrt(static_cast<double>(pairs_[k] - pairs_[k - 1]));
        for (int i = 0; i < points; ++i) {
            double sum = 0;
            for (int j = 0; j < points; ++j)
                sum += weight(bound(k - 1), j) * before[static_cast<std::size_t>(j)] *
                       normal_density((place(bound(k), i) - place(bound(k - 1), j)) / step);
            now[static_cast<std::size_t>(i)] = sum / step;
        }
        before = now;
    }
    double all = 0;
    for (int i = 0; i < points; ++i)
        all += weight(bound(pairs_.size() - 1), i) * before[static_cast<std::size_t>(i)];
    return std::clamp(all, 0.0, 1.0);
}

} // namespace stylobate
