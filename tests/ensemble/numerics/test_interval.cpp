/// Binomial intervals: exact coverage by summing probabilities, limits, closed forms.

#include "ensemble/numerics/interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace stylobate;

namespace {

/// Wilson's score interval, which interval.hpp compares with: all probabilities that a two-sided normal test with the
/// true variance does not reject (Wilson, "Probable inference, the law of succession, and statistical inference",
/// Journal of the American Statistical Association 22 (1927) 209).
BinomialInterval wilson(std::uint64_t trials, std::uint64_t successes, double level)
{
    if (trials == 0)
        return {};
    const double z = -normal_quantile((1 - level) / 2);
    const double n = static_cast<double>(trials);
    const double p = static_cast<double>(successes) / n;
    const double centre = p + z * z / (2 * n);
    const double reach = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    const double scale = 1 + z * z / n;
    return {successes == 0 ? 0 : std::max(0.0, (centre - reach) / scale),
            successes == trials ? 1 : std::min(1.0, (centre + reach) / scale)};
}

using Method = BinomialInterval (*)(std::uint64_t, std::uint64_t, double);

std::vector<BinomialInterval> all(Method method, int n, double level)
{
    std::vector<BinomialInterval> intervals;
    for (int x = 0; x <= n; ++x)
        intervals.push_back(method(static_cast<std::uint64_t>(n), static_cast<std::uint64_t>(x), level));
    return intervals;
}

double probability(int n, int x, double p)
{
    return std::exp(std::lgamma(n + 1.0) - std::lgamma(x + 1.0) - std::lgamma(n - x + 1.0) + x * std::log(p) +
                    (n - x) * std::log1p(-p));
}

double coverage(const std::vector<BinomialInterval>& intervals, double p)
{
    const int n = static_cast<int>(intervals.size()) - 1;
    double sum = 0;
    for (int x = 0; x <= n; ++x) {
        const BinomialInterval& interval = intervals[static_cast<std::size_t>(x)];
        if (interval.lower <= p && p <= interval.upper)
            sum += probability(n, x, p);
    }
    return sum;
}

/// Average over p, uniform, by the midpoint rule.
double average_coverage(const std::vector<BinomialInterval>& intervals)
{
    const int cells = 8192;
    double sum = 0;
    for (int i = 0; i < cells; ++i)
        sum += coverage(intervals, (i + 0.5) / cells);
    return sum / cells;
}

/// The smallest coverage of any p: coverage is lowest just outside a limit of one of the intervals.
double worst_coverage(const std::vector<BinomialInterval>& intervals)
{
    double worst = 1;
    for (const BinomialInterval& interval : intervals)
        for (const double limit : {interval.lower, interval.upper})
            for (const double p : {limit * (1 - 1e-9), limit * (1 + 1e-9)})
                if (p > 0 && p < 1)
                    worst = std::min(worst, coverage(intervals, p));
    return worst;
}

double average_width(const std::vector<BinomialInterval>& intervals)
{
    double sum = 0;
    for (const BinomialInterval& interval : intervals)
        sum += interval.upper - interval.lower;
    return sum / static_cast<double>(intervals.size());
}

} // namespace

TEST(Interval, ExactCoverage)
{
    // the table of interval.hpp: the reasons for the choice
    struct Row {
        int n;
        double average_j, average_w, worst_j, worst_w, width_j, width_w;
    };
    for (const Row& row :
         {Row{16, .9516, .9533, .8962, .8362, .3556, .3587}, Row{64, .9500, .9515, .8822, .8377, .1882, .1892},
          Row{256, .9499, .9506, .8777, .8381, .0957, .0958}}) {
        const auto j = all(jeffreys, row.n, 0.95);
        const auto w = all(wilson, row.n, 0.95);
        EXPECT_NEAR(average_coverage(j), row.average_j, 2e-4) << row.n;
        EXPECT_NEAR(average_coverage(w), row.average_w, 2e-4) << row.n;
        EXPECT_NEAR(worst_coverage(j), row.worst_j, 1e-4) << row.n;
        EXPECT_NEAR(worst_coverage(w), row.worst_w, 1e-4) << row.n;
        EXPECT_NEAR(average_width(j), row.width_j, 1e-4) << row.n;
        EXPECT_NEAR(average_width(w), row.width_w, 1e-4) << row.n;
    }
    for (const double level : {0.68, 0.9, 0.99}) {
        EXPECT_NEAR(average_coverage(all(jeffreys, 64, level)), level, 0.01);
        EXPECT_NEAR(average_coverage(all(wilson, 64, level)), level, 0.01);
    }
}

TEST(Interval, LimitsAtNoneAndAll)
{
    for (const Method method : {&wilson, &jeffreys}) {
        for (const std::uint64_t n : {1U, 2U, 16U, 256U, 100000U}) {
            const BinomialInterval none = method(n, 0, 0.95);
            const BinomialInterval every = method(n, n, 0.95);
            EXPECT_EQ(none.lower, 0);
            EXPECT_EQ(every.upper, 1);
            EXPECT_GT(none.upper, 0);
            EXPECT_LT(none.upper, 1);
            EXPECT_NEAR(every.lower, 1 - none.upper, 1e-12);
        }
        EXPECT_EQ(method(0, 0, 0.95).lower, 0);
        EXPECT_EQ(method(0, 0, 0.95).upper, 1);
    }
    const double z2 = 1.959963984540054 * 1.959963984540054;
    EXPECT_NEAR(wilson(256, 0, 0.95).upper, z2 / (256 + z2), 1e-14);
}

TEST(Interval, HoldsTheEstimateAndGrowsWithIt)
{
    for (const Method method : {&wilson, &jeffreys}) {
        for (const int n : {1, 5, 16, 256}) {
            const auto intervals = all(method, n, 0.95);
            for (int x = 0; x <= n; ++x) {
                const auto& interval = intervals[static_cast<std::size_t>(x)];
                EXPECT_LE(interval.lower, static_cast<double>(x) / n);
                EXPECT_GE(interval.upper, static_cast<double>(x) / n);
                const auto& mirror = intervals[static_cast<std::size_t>(n - x)];
                EXPECT_NEAR(interval.lower, 1 - mirror.upper, 1e-12);
                if (x > 0) {
                    EXPECT_GT(interval.lower, intervals[static_cast<std::size_t>(x - 1)].lower);
                    EXPECT_GT(interval.upper, intervals[static_cast<std::size_t>(x - 1)].upper);
                }
                const BinomialInterval wide =
                    method(static_cast<std::uint64_t>(n), static_cast<std::uint64_t>(x), 0.99);
                EXPECT_LE(wide.lower, interval.lower);
                EXPECT_GE(wide.upper, interval.upper);
            }
        }
        double last = 1;
        for (const std::uint64_t n : {4U, 16U, 64U, 256U, 1024U}) {
            const BinomialInterval interval = method(n, n / 4, 0.95);
            EXPECT_LT(interval.upper - interval.lower, last);
            last = interval.upper - interval.lower;
        }
    }
}

TEST(Interval, WilsonInvertsTheScoreTest)
{
    const double z = 1.959963984540054;
    for (int x = 1; x < 64; ++x) {
        const BinomialInterval interval = wilson(64, static_cast<std::uint64_t>(x), 0.95);
        for (const double p : {interval.lower, interval.upper})
            EXPECT_NEAR(std::abs(x / 64.0 - p) / std::sqrt(p * (1 - p) / 64), z, 1e-12);
    }
}

TEST(Interval, JeffreysHasTheTailsOfItsPosterior)
{
    // the posterior's probability by integration over p = sin2(t), which takes the singular ends away:
    // p^(x-1/2) (1-p)^(n-x-1/2) dp = 2 sin(t)^(2x) cos(t)^(2(n-x)) dt
    const auto integral = [](int n, int x, double from, double to) {
        const int cells = 4000;
        const double a = std::asin(std::sqrt(from)), step = (std::asin(std::sqrt(to)) - a) / cells;
        double sum = 0;
        for (int i = 0; i < cells; ++i) {
            const double t = a + (i + 0.5) * step;
            sum += 2 * std::pow(std::sin(t), 2 * x) * std::pow(std::cos(t), 2 * (n - x));
        }
        return sum * step;
    };
    for (const int n : {4, 16, 64}) {
        for (const int x : {1, 2, n / 2, n - 1}) {
            const BinomialInterval interval =
                jeffreys(static_cast<std::uint64_t>(n), static_cast<std::uint64_t>(x), 0.9);
            const double whole = integral(n, x, 0, 1);
            EXPECT_NEAR(integral(n, x, 0, interval.lower) / whole, 0.05, 1e-6) << n << ' ' << x;
            EXPECT_NEAR(integral(n, x, interval.upper, 1) / whole, 0.05, 1e-6) << n << ' ' << x;
        }
    }
}
