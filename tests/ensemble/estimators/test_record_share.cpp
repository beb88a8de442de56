/// The interval of a share by records: Clopper's and Pearson's where records are all or nothing, never narrower on the
/// side of damage where damage appears, and its coverage where few records are damaged.

#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <boost/math/distributions/beta.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace stylobate;

namespace {

std::vector<RecordCount> records(std::size_t number, double trials, const std::vector<double>& reached)
{
    std::vector<RecordCount> all(number, {trials, 0});
    for (std::size_t i = 0; i < reached.size(); ++i)
        all[i].reached = reached[i];
    return all;
}

/// Runs of one record at one stripe.
FragilityData stripe(const std::vector<RecordCount>& counts)
{
    std::vector<FragilityRun> runs;
    for (std::size_t g = 0; g < counts.size(); ++g)
        runs.push_back({static_cast<std::uint32_t>(g), {1}, counts[g].reached, counts[g].trials});
    return grouped(runs);
}

} // namespace

TEST(RecordShare, IsClopperAndPearsonWhereRecordsAreAllOrNothing)
{
    using Beta = boost::math::beta_distribution<double>;
    for (const int n : {1, 2, 8, 30, 100, 400})
        for (const int k : {0, 1, n / 3, n - 1, n}) {
            const std::vector<double> reached(static_cast<std::size_t>(k), 12);
            for (const double level : {0.95, 0.999}) {
                const Limits limits = record_share_limits(records(static_cast<std::size_t>(n), 12, reached), level);
                const double lower = k > 0 ? quantile(Beta(k, n - k + 1), (1 - level) / 2) : 0;
                const double upper = k < n ? quantile(Beta(k + 1, n - k), (1 + level) / 2) : 1;
                EXPECT_NEAR(limits.lower, lower, 3e-7) << k << " of " << n;
                EXPECT_NEAR(limits.upper, upper, 3e-7) << k << " of " << n;
            }
        }
    EXPECT_EQ(record_share_limits({}, 0.95).upper, 1);
    // all have reached it, but for the rounding of sums of weights
    const std::vector<RecordCount> rounded = {{0.1 + 0.2, 0.3}, {0.1 + 0.2, 0.3}, {0.3, 0.3}};
    ASSERT_LT(rounded[0].reached, rounded[0].trials);
    EXPECT_EQ(record_share_limits(rounded, 0.95).upper, 1);
    EXPECT_NEAR(record_share_limits(rounded, 0.95).lower, record_share_limits(records(3, 1, {1, 1, 1}), 0.95).lower,
                1e-6);
}

/// Against a million draws of the weights, where records have any share and any number of trials.
TEST(RecordShare, IsTheQuantileOfTheWeightedMean)
{
    const std::vector<RecordCount> counts = {{30, 1}, {30, 0}, {10, 10}, {30, 17}, {25, 3}, {30, 0}, {30, 2}, {30, 0}};
    double trials = 0;
    for (const RecordCount& c : counts)
        trials += c.trials / 8;
    std::mt19937_64 random(3);
    std::exponential_distribution<double> weight;
    std::vector<double> with_reached, with_missed;
    for (int i = 0; i < 1000000; ++i) {
        const double own = weight(random) * trials;
        double sum = own, reached = 0;
        for (const RecordCount& c : counts) {
            const double w = weight(random);
            sum += w * c.trials;
            reached += w * c.reached;
        }
        with_reached.push_back((reached + own) / sum);
        with_missed.push_back(reached / sum);
    }
    std::sort(with_reached.begin(), with_reached.end());
    std::sort(with_missed.begin(), with_missed.end());
    const Limits limits = record_share_limits(counts, 0.95);
    EXPECT_NEAR(limits.upper, with_reached[975000], 1e-3);
    EXPECT_NEAR(limits.lower, with_missed[25000], 1e-3);
}

/// At 0 of 30 motions the upper limit is 0.116. It was 0.064 at the next stripe, where 10 of 900 runs were damaged.
TEST(RecordShare, NoLimitFallsWhereDamageAppears)
{
    const Limits none = stripe_shares(stripe(records(30, 30, {}))).stripes[0].limits;
    EXPECT_NEAR(none.upper, 1 - std::pow(0.025, 1.0 / 30), 1e-7);
    EXPECT_EQ(none.lower, 0);
    const Limits some = stripe_shares(stripe(records(30, 30, {4, 3, 2, 1}))).stripes[0].limits;
    EXPECT_GT(some.upper, none.upper);
    EXPECT_GT(some.lower, 0);

    std::mt19937_64 random(5);
    for (int walk = 0; walk < 20; ++walk) { // damage at any record, until all is damaged
        std::vector<RecordCount> counts = records(12, 6, {});
        Limits before = record_share_limits(counts, 0.95);
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < 72; ++i)
            order.push_back(i % 12);
        if (walk > 0)
            std::shuffle(order.begin(), order.end(), random);
        for (const std::size_t g : order) {
            counts[g].reached += 1;
            const Limits after = record_share_limits(counts, 0.95);
            EXPECT_GE(after.upper, before.upper - 1e-7);
            EXPECT_GE(after.lower, before.lower - 1e-7);
            before = after;
        }
        EXPECT_EQ(before.upper, 1);
    }
}

/// 400 repeats of each: three deviations below 0.95 are 0.917.
TEST(RecordShare, HoldsWhereFewRecordsAreDamaged)
{
    for (const double within : {0.05, 0.2, 0.38}) // the records' part: nearly all, most, little
        for (const std::size_t n : {10, 30, 100})
            for (const double p : {0.005, 0.05}) {
                FragilityTruth truth{.between = std::sqrt(0.16 - within * within), .within = within, .records = n};
                truth.runs = 30;
                truth.stripes = {std::exp(truth.dispersion() * link_quantile(Link::probit, p))};
                int held = 0;
                for (std::uint64_t r = 0; r < 400; ++r) {
                    std::vector<RecordCount> counts;
                    for (const FragilityRun& run : truth.draw(61, r))
                        counts.push_back({run.trials, run.reached});
                    const Limits limits = record_share_limits(counts, 0.95);
                    held += limits.lower <= p && p <= limits.upper;
                }
                EXPECT_GE(held, 367) << within << ' ' << n << ' ' << p;
            }
}
