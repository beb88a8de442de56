#include "ensemble/estimators/surface/interim_analyses.hpp"

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::uint64_t unit = 4;
/// Of p, for the average: the midpoints of this many parts of (0, 1/2); Jeffreys' interval is the same for 1 - p.
constexpr int parts = 100;
/// A path with less than this is left out: of all of them together it is far below what is asked.
constexpr double negligible = 1e-14;

/// Probabilities of 0 ... n collapses.
std::vector<double> binomial(std::uint64_t n, double p)
{
    std::vector<double> probability(n + 1);
    const double log_p = std::log(p);
    const double log_q = std::log1p(-p);
    const double top = log_gamma(static_cast<double>(n) + 1);
    for (std::uint64_t s = 0; s <= n; ++s) {
        const auto k = static_cast<double>(s);
        const auto rest = static_cast<double>(n - s);
        probability[s] = std::exp(top - log_gamma(k + 1) - log_gamma(rest + 1) + k * log_p + rest * log_q);
    }
    return probability;
}

} // namespace

InterimAnalyses::InterimAnalyses(std::uint64_t first, std::uint64_t most, double half_width, double level)
    : half_width_(half_width), level_(level), interval_level_(level)
{
    assert(first >= 1 && first <= most && half_width > 0 && half_width < 0.5 && level > 0 && level < 1);
    trials_.push_back(first);
    while (trials_.back() < most) {
        const std::uint64_t last = trials_.back();
        const std::uint64_t next = (std::max(last + unit, last + last / 5) + unit - 1) / unit * unit;
        trials_.push_back(std::min(most, next));
    }
    const double step = std::min(0.001, (1 - level) / 20);
    for (rule_ = rule_at(interval_level_); !is_right(rule_) && interval_level_ + step < 1;) {
        interval_level_ += step;
        rule_ = rule_at(interval_level_);
    }
    trials_.resize(rule_.size());
}

BinomialInterval InterimAnalyses::interval(std::uint64_t trials, std::uint64_t collapses) const
{
    return jeffreys(trials, collapses, interval_level_);
}

InterimAnalyses::Rule InterimAnalyses::rule_at(double interval_level) const
{
    Rule rule;
    for (const std::uint64_t n : trials_) {
        std::vector<Count>& counts = rule.emplace_back(n + 1);
        for (std::uint64_t s = 0; s <= n / 2; ++s) {
            const BinomialInterval interval = jeffreys(n, s, interval_level);
            counts[s] = {narrow(interval), interval};
            counts[n - s] = {narrow(interval), {1 - interval.upper, 1 - interval.lower}};
        }
        // no path continues
        if (std::all_of(counts.begin(), counts.end(), [](const Count& count) { return count.stops; }))
            break;
    }
    return rule;
}

std::vector<InterimAnalyses::Expected> InterimAnalyses::expected_by_analyses(const Rule& rule, double p) const
{
    std::vector<Expected> by_analyses;
    Expected stopped;                  // at the analyses before
    std::vector<double> reaches = {1}; // each count of collapses, not stopped before
    std::uint64_t n_before = 0;
    for (std::size_t k = 0; k < rule.size(); ++k) {
        const std::uint64_t n = trials_[k];
        const std::vector<double> more = binomial(n - n_before, p);
        std::vector<double> now(n + 1, 0);
        for (std::size_t s = 0; s < reaches.size(); ++s)
            if (reaches[s] > negligible)
                for (std::size_t j = 0; j < more.size(); ++j)
                    now[s + j] += reaches[s] * more[j];
        Expected ends = stopped;
        for (std::size_t s = 0; s <= n; ++s) {
            const Count& count = rule[k][s];
            const double covered = count.interval.lower <= p && p <= count.interval.upper ? now[s] : 0;
            ends.coverage += covered;
            ends.trials += static_cast<double>(n) * now[s];
            if (count.stops) {
                stopped.coverage += covered;
                stopped.trials += static_cast<double>(n) * now[s];
                now[s] = 0;
            }
        }
        by_analyses.push_back(ends);
        reaches = std::move(now);
        n_before = n;
    }
    return by_analyses;
}

bool InterimAnalyses::is_right(const Rule& rule) const
{
    std::vector<double> sum(rule.size(), 0);
    for (int i = 0; i < parts; ++i) {
        const std::vector<Expected> expected = expected_by_analyses(rule, 0.5 * (i + 0.5) / parts);
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += expected[k].coverage;
    }
    return *std::min_element(sum.begin(), sum.end()) >= level_ * parts;
}

InterimAnalyses::Expected InterimAnalyses::expected(double p, std::size_t analyses) const
{
    assert(analyses >= 1 && analyses <= trials_.size());
    return expected_by_analyses(rule_, p)[analyses - 1];
}

std::uint64_t uniform_trials(double half_width, double level)
{
    std::uint64_t n = 1;
    while (true) {
        const BinomialInterval interval = jeffreys(n, n / 2, level);
        if (interval.upper - interval.lower <= 2 * half_width)
            return n;
        ++n;
    }
}

} // namespace stylobate
