/// The shares of the dispersion: known components, unequal counts, a direct sum over pairs, coverage.

#include "ensemble/estimators/fragility/dispersion_shares.hpp"
#include "ensemble/model/input_error.hpp"
#include "tests/ensemble/estimators/nested_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace stylobate;

namespace {

std::vector<NestedRun> nested(std::uint64_t seed, std::uint64_t repeat, std::size_t records,
                              const std::array<double, 4>& sd, bool binary, bool unequal = false)
{
    return NestedTruth{.sd = sd, .binary = binary, .records = records, .unequal = unequal}.draw(seed, repeat);
}

double sum_of_shares(const DispersionShares& shares)
{
    double sum = 0;
    for (const DispersionShare& level : shares.levels)
        sum += level.share;
    return sum;
}

} // namespace

TEST(DispersionShares, EqualHalfMeanSquaredDifferencesOfPairs)
{
    const auto runs = nested(1, 0, 12, {1, 0.7, 0.5, 0.4}, false); // equal counts: all pairs weigh alike
    std::array<double, 4> sum{}, pairs{};
    for (const NestedRun& a : runs)
        for (const NestedRun& b : runs) {
            if (&a == &b)
                continue;
            const std::size_t level = a.record != b.record               ? 0
                                      : a.imperfection != b.imperfection ? 1
                                      : a.contact != b.contact           ? 2
                                                                         : 3;
            sum[level] += (a.response - b.response) * (a.response - b.response) / 2;
            pairs[level] += 1;
        }
    const DispersionShares shares = dispersion_shares(runs);
    EXPECT_NEAR(shares.total, sum[0] / pairs[0], 1e-12);
    for (std::size_t l = 0; l < 4; ++l) {
        const double below = l < 3 ? sum[l + 1] / pairs[l + 1] : 0;
        EXPECT_NEAR(shares.levels[l].variance, sum[l] / pairs[l] - below, 1e-12) << l;
    }
    EXPECT_NEAR(sum_of_shares(shares), 1, 1e-12);
}

TEST(DispersionShares, KnownComponentsWithUnequalCounts)
{
    const std::array<double, 4> sd = {0.5, 0.3, 0.2, 0.1};
    const DispersionShares shares = dispersion_shares(nested(2, 0, 4000, sd, false, true));
    for (std::size_t l = 0; l < 4; ++l) {
        EXPECT_NEAR(shares.levels[l].variance, sd[l] * sd[l], 0.1 * sd[l] * sd[l]) << l;
        EXPECT_LT(shares.levels[l].share_limits.lower, sd[l] * sd[l] / 0.39) << l;
        EXPECT_GT(shares.levels[l].share_limits.upper, sd[l] * sd[l] / 0.39) << l;
    }
    EXPECT_NEAR(sum_of_shares(shares), 1, 1e-12);
}

TEST(DispersionShares, UnbiasedWithFewRecords)
{
    const std::array<double, 4> sd = {0.5, 0.3, 0.2, 0.1};
    std::array<double, 4> mean{};
    const int repeats = 4000;
    for (std::uint64_t r = 0; r < repeats; ++r) {
        const DispersionShares shares = dispersion_shares(nested(3, r, 5, sd, false, true));
        for (std::size_t l = 0; l < 4; ++l)
            mean[l] += (shares.levels[l].known ? shares.levels[l].variance : sd[l] * sd[l]) / repeats;
    }
    for (std::size_t l = 0; l < 4; ++l)
        EXPECT_NEAR(mean[l], sd[l] * sd[l], 0.02 * 0.39) << l;
}

TEST(DispersionShares, IntervalsCover)
{
    // 600 repeats: four standard errors of a coverage of .95 are .036
    const std::array<double, 4> sd = {0.5, 0.4, 0.3, 0.3};
    for (const bool binary : {false, true}) {
        const DispersionShares truth = dispersion_shares(nested(9, 0, 60000, sd, binary));
        std::array<int, 4> covered{};
        for (std::uint64_t r = 0; r < 600; ++r) {
            const DispersionShares shares = dispersion_shares(nested(4, r, 40, sd, binary));
            for (std::size_t l = 0; l < 4; ++l)
                covered[l] += shares.levels[l].share_limits.lower <= truth.levels[l].share &&
                                      truth.levels[l].share <= shares.levels[l].share_limits.upper
                                  ? 1
                                  : 0;
        }
        for (std::size_t l = 0; l < 4; ++l)
            EXPECT_NEAR(covered[l] / 600.0, 0.95, 0.036) << l << (binary ? " binary" : "");
    }
}

/// Eight records, few runs of each: unbiased estimates of a variance that is 0 are negative in half of the cases.
TEST(DispersionShares, SharesAndTheirIntervalsAreWithinTheWhole)
{
    int negative = 0, determined = 0, undetermined = 0;
    for (std::uint64_t r = 0; r < 300; ++r) {
        const DispersionShares shares = dispersion_shares(nested(11, r, 8, {0.5, 0.0, 0.4, 0.0}, true));
        EXPECT_NEAR(sum_of_shares(shares), 1, 1e-12);
        for (const DispersionShare& level : shares.levels) {
            negative += level.variance < 0;
            EXPECT_GE(level.share, 0);
            EXPECT_LE(level.share, 1);
            if (!level.determined()) {
                ++undetermined;
                EXPECT_TRUE(std::isinf(level.share_limits.lower) && std::isinf(level.share_limits.upper));
                continue;
            }
            ++determined;
            EXPECT_LE(level.share_limits.lower, level.share);
            EXPECT_GE(level.share_limits.upper, level.share);
        }
    }
    EXPECT_GT(negative, 100);
    EXPECT_GT(determined, 300);
    EXPECT_GT(undetermined, 10);
}

/// Two records with two structures each, responses 0 2 | 1 3: half the mean squared difference within the records is 2,
/// between them 3 / 2, so that the record's variance is -1 / 2. The nearest possible ones have 0 for it.
TEST(DispersionShares, TheNearestPossibleVariancesByHand)
{
    const DispersionShares shares =
        dispersion_shares(std::vector<NestedRun>{{0, 0, 0, 0, 0}, {0, 1, 1, 0, 2}, {1, 0, 0, 0, 1}, {1, 1, 1, 0, 3}});
    // pairs of different records: 0-1, 0-3, 2-1, 2-3: (1 + 9 + 1 + 1) / 4 / 2
    EXPECT_NEAR(shares.total, 1.5, 1e-12);
    EXPECT_NEAR(shares.levels[1].variance, 2, 1e-12);
    EXPECT_NEAR(shares.levels[0].variance, -0.5, 1e-12);
    EXPECT_NEAR(shares.levels[0].share, 0, 1e-12);
    EXPECT_NEAR(shares.levels[1].share, 1, 1e-12);
}

/// Nine records of two twins. Estimates without each record by sums over pairs; the limits of a variance are Student's
/// of the pseudo-values, those of a share s the numbers at which the mean of (variance - s total) is t standard errors
/// from 0. Student's quantile of eight degrees of freedom is 2.306004.
TEST(DispersionShares, LimitsAreTheJackknifeByHand)
{
    const double y[9][2] = {{1, 2}, {4, 4}, {0, 1}, {7, 5}, {3, 6}, {2, 2}, {8, 6}, {5, 5}, {1, 3}};
    std::vector<NestedRun> runs;
    for (std::uint32_t g = 0; g < 9; ++g)
        for (const double each : y[g])
            runs.push_back({g, g, g, 0, each});
    struct Pair {
        double total, chaos;
    };
    const auto without = [&](std::size_t left_out) {
        double between = 0, pairs = 0, within = 0, records = 0;
        for (std::size_t g = 0; g < 9; ++g) {
            if (g == left_out)
                continue;
            within += (y[g][0] - y[g][1]) * (y[g][0] - y[g][1]) / 2;
            records += 1;
            for (std::size_t h = 0; h < g; ++h)
                for (int i = 0; i < 4 && h != left_out; ++i) {
                    const double d = y[g][i / 2] - y[h][i % 2];
                    between += d * d / 2;
                    pairs += 1;
                }
        }
        return Pair{between / pairs, within / records};
    };
    const Pair all = without(9);
    const DispersionShares shares = dispersion_shares(runs, 0.95);
    EXPECT_NEAR(shares.total, all.total, 1e-12);
    EXPECT_NEAR(shares.levels[0].variance, all.total - all.chaos, 1e-12);
    EXPECT_NEAR(shares.levels[3].variance, all.chaos, 1e-12);
    EXPECT_FALSE(shares.levels[1].known || shares.levels[2].known);
    // (estimate, standard error) of a combination of the pseudo-values 9 all - 8 without
    const auto error = [&](auto&& of) {
        double sum = 0, square = 0;
        for (std::size_t g = 0; g < 9; ++g) {
            const double pseudo = 9 * of(all) - 8 * of(without(g));
            sum += pseudo;
            square += pseudo * pseudo;
        }
        return std::sqrt((square - sum * sum / 9) / 8 / 9);
    };
    const auto record = [](const Pair& p) { return p.total - p.chaos; };
    const auto chaos = [](const Pair& p) { return p.chaos; };
    constexpr double t = 2.306004135;
    EXPECT_NEAR(shares.total_limits.upper - all.total, t * error([](const Pair& p) { return p.total; }), 1e-6);
    EXPECT_NEAR(shares.levels[0].variance_limits.upper - record(all), t * error(record), 1e-6);
    EXPECT_NEAR(shares.levels[3].variance_limits.lower - chaos(all), -t * error(chaos), 1e-6);
    const auto expect = [&](const Limits& limits, auto&& part) {
        for (const double s : {limits.lower, limits.upper})
            if (s > 0 && s < 1) { // else cut
                const auto of = [&](const Pair& p) { return part(p) - s * p.total; };
                EXPECT_NEAR(std::abs(of(all)) / error(of), t, 1e-6) << s;
            }
    };
    expect(shares.levels[0].share_limits, record);
    expect(shares.levels[3].share_limits, chaos);
    EXPECT_NEAR(shares.levels[3].share, all.chaos / all.total, 1e-12);
    EXPECT_GT(shares.levels[0].share_limits.lower, 0);
    EXPECT_LT(shares.levels[3].share_limits.upper, 1);
}

TEST(DispersionShares, WithoutDispersionNoShareIsANumber)
{
    std::vector<NestedRun> runs = nested(12, 0, 20, {1, 1, 1, 1}, false);
    for (NestedRun& run : runs)
        run.response = 1;
    const DispersionShares shares = dispersion_shares(runs);
    for (const DispersionShare& level : shares.levels) {
        EXPECT_TRUE(std::isnan(level.share));
        EXPECT_FALSE(level.determined());
    }
}

TEST(DispersionShares, StripesAreNotCompared)
{
    auto runs = nested(5, 0, 30, {1, 0.5, 0.5, 0.5}, false);
    const DispersionShares one = dispersion_shares(runs);
    const std::size_t n = runs.size();
    for (std::size_t i = 0; i < n; ++i) {
        NestedRun again = runs[i];
        again.stripe = 1;
        again.response += 100; // another stripe, far away
        runs.push_back(again);
    }
    EXPECT_NEAR(dispersion_shares(runs).total, one.total, 1e-9);
}

TEST(DispersionShares, LevelsThatWereNotVariedAreSaid)
{
    auto runs = nested(6, 0, 30, {1, 0.5, 0.5, 0.5}, false);
    std::erase_if(runs, [](const NestedRun& run) { return run.contact > 0; });
    const DispersionShares shares = dispersion_shares(runs);
    EXPECT_FALSE(shares.levels[2].known);
    EXPECT_EQ(shares.levels[2].variance, 0);
    EXPECT_NEAR(sum_of_shares(shares), 1, 1e-12);
    ASSERT_FALSE(shares.says.empty());
    EXPECT_NE(shares.says[0].find("contact"), std::string::npos);
}

TEST(DispersionShares, TooFewRecordsAndBadNumbers)
{
    EXPECT_THROW(dispersion_shares({}), InputError);
    EXPECT_THROW(dispersion_shares(nested(7, 0, 1, {1, 1, 1, 1}, false)), InputError);
    auto runs = nested(7, 0, 5, {1, 1, 1, 1}, false);
    EXPECT_TRUE(std::isinf(dispersion_shares(runs).levels[0].share_limits.upper));
    runs[3].response = std::nan("");
    EXPECT_THROW(dispersion_shares(runs), InputError);
}
