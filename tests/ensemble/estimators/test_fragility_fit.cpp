/// Lack of fit, shares by stripe, and monotony: right sizes under true curves, power against curves with a dip.

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/model/input_error.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace stylobate;

namespace {

/// Of a logistic curve: (records x stripes) counts of `trials` at each of the ln im.
LackOfFit logistic_fit(const std::vector<double>& log_im, const std::vector<std::vector<double>>& reached,
                       double trials)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < reached.size(); ++g)
        for (std::size_t j = 0; j < log_im.size(); ++j)
            runs.push_back({g, {std::exp(log_im[j])}, reached[g][j], trials});
    const FragilityData data = grouped(runs);
    return lack_of_fit(fitted_curve(data, log_predictors(data), Link::logit));
}

/// P(F > f) with d1 and d2 degrees of freedom: Simpson's rule over b = d1 F / (d1 F + d2), whose density is that of
/// Beta(d1 / 2, d2 / 2), in b = sin2(t).
double f_tail(double f, double d1, double d2)
{
    const auto mass = [&](double from) {
        constexpr int n = 2000;
        const double h = (std::acos(0.0) - from) / n;
        double sum = 0;
        for (int i = 0; i <= n; ++i) {
            const double t = from + i * h;
            sum += (i == 0 || i == n ? 1
                    : i % 2 == 1     ? 4
                                     : 2) *
                   std::pow(std::sin(t), d1 - 1) * std::pow(std::max(std::cos(t), 0.0), d2 - 1);
        }
        return sum * h / 3;
    };
    return mass(std::asin(std::sqrt(d1 * f / (d1 * f + d2)))) / mass(0);
}

LackOfFit fit_of(const FragilityTruth& truth, std::uint64_t repeat)
{
    const FragilityData data = grouped(truth.draw(21, repeat));
    return lack_of_fit(fitted_curve(data, log_predictors(data), Link::probit));
}

bool contains(const Limits& limits, double value)
{
    return limits.lower <= value && value <= limits.upper;
}

} // namespace

TEST(LackOfFit, RejectsTrueCurvesNoMoreOftenThanItSays)
{
    // 600 repeats: four standard errors of .05 are .036
    int rejected = 0;
    const FragilityTruth truth;
    for (std::uint64_t r = 0; r < 600; ++r)
        rejected += fit_of(truth, r).p_value < 0.05 ? 1 : 0;
    EXPECT_LT(rejected / 600.0, 0.05 + 0.036);
    EXPECT_GT(rejected, 5);
}

/// Ten records of ten runs at ln im = -1, 0, 1. The counts 22, 46, 82 of 100 leave 2, -4, 2 beside the curve with p =
/// 0.2, 0.5, 0.8, which are orthogonal to (1, ln im): it is the fit. The one additional term that is orthogonal to it
/// for the weights p (1 - p) is in proportion to 1/0.16, -2/0.25, 1/0.16, so that a record scores 6.25 (k1 - 2) - 8 (k2
/// - 5) + 6.25 (k3 - 8): 0, 14.25, 0, 8, 12.5, 9.75, 10.75, 1.75, -6.25, 6.25. Their t-test: mean 5.7,
/// variance 43.358333, F = 10 x 5.7^2 / 43.358333 with 1 and 9 degrees of freedom.
TEST(LackOfFit, OfOneTermByHand)
{
    const LackOfFit found = logistic_fit(
        {-1, 0, 1},
        {{2, 5, 8}, {3, 4, 8}, {1, 5, 9}, {2, 4, 8}, {3, 5, 9}, {2, 3, 7}, {4, 6, 9}, {1, 4, 8}, {2, 5, 7}, {2, 5, 9}},
        10);
    EXPECT_EQ(found.terms, 1);
    EXPECT_NEAR(found.statistic, 7.49336921, 1e-6);
    EXPECT_NEAR(found.p_value, 0.02294491, 1e-7); // by the continued fraction of the incomplete beta function
}

/// Twelve records of nine runs at ln im = -3, -1, 1, 3; p = 1/9, 1/3, 2/3, 8/9. With what a record has beside 1, 3, 6,
/// 8, the two terms score 9 e1 - 4 e2 - 4 e3 + 9 e4 and -9 e1 + 12 e2 - 12 e3 + 9 e4 (the contrasts 1 -1 -1 1 and -1 3
/// -3 1 over the weights p (1 - p)). Hotelling's T2 of their means is 31.681380; (12 - 2) / (2 x 11) T2 = 14.400627.
TEST(LackOfFit, OfTwoTermsByHand)
{
    const LackOfFit found = logistic_fit({-3, -1, 1, 3},
                                         {{3, 4, 8, 8},
                                          {1, 1, 6, 8},
                                          {3, 4, 7, 8},
                                          {0, 4, 8, 8},
                                          {2, 3, 7, 9},
                                          {1, 2, 6, 8},
                                          {1, 3, 7, 9},
                                          {0, 2, 6, 7},
                                          {0, 1, 6, 7},
                                          {2, 1, 5, 8},
                                          {2, 3, 7, 8},
                                          {0, 1, 4, 7}},
                                         9);
    EXPECT_EQ(found.terms, 2);
    EXPECT_NEAR(found.statistic, 14.40062722, 1e-5);
    EXPECT_NEAR(found.p_value / std::pow(1 + 2 * found.statistic / 10, -5), 1, 1e-9); // tail of F(2, 10)
}

/// Three terms and twenty records: F(3, 17), whose tail beyond 2.5 is 0.0943.
TEST(LackOfFit, TailIsThatOfTermsAndRecordsLessTerms)
{
    EXPECT_NEAR(f_tail(2.5, 3, 17), 0.0943, 5e-5);
    for (std::uint64_t repeat = 0; repeat < 4; ++repeat) {
        const FragilityTruth truth{.records = 20, .stripes = {0.5, 0.8, 1, 1.25, 1.9}};
        const LackOfFit found = fit_of(truth, repeat);
        ASSERT_EQ(found.terms, 3);
        EXPECT_NEAR(found.p_value, f_tail(found.statistic, 3, 17), 1e-7);
    }
}

TEST(LackOfFit, SaysWhereADipIs)
{
    FragilityTruth truth;
    truth.dip_stripe = 5;
    truth.dip = 0.5;
    int found = 0;
    for (std::uint64_t r = 0; r < 100; ++r) {
        const LackOfFit fit = fit_of(truth, r);
        found += fit.p_value < 0.05 && fit.says.find("at intensity 1.55") != std::string::npos ? 1 : 0;
    }
    EXPECT_GT(found, 90);
}

TEST(LackOfFit, SaysWhatItCannotTest)
{
    FragilityTruth truth;
    truth.stripes = {0.8, 1.3};
    EXPECT_EQ(fit_of(truth, 0).terms, 0);
    EXPECT_NE(fit_of(truth, 0).says.find("cannot be tested"), std::string::npos);
    EXPECT_EQ(fit_of(FragilityTruth{.records = 6}, 0).terms, 0);
}

TEST(StripeShares, MonotoneShareIsThatOfPooledNeighbours)
{
    // 3 records of 10 runs: shares .2 .5 .3 .4 .9; the three in the middle pool to .4
    std::vector<FragilityRun> runs;
    const double share[] = {.2, .5, .3, .4, .9};
    for (std::uint32_t g = 0; g < 3; ++g)
        for (int j = 0; j < 5; ++j)
            runs.push_back({g, {1.0 + j}, std::round(10 * share[j]), 10});
    const StripeShares shares = stripe_shares(grouped(runs));
    const double want[] = {.2, .4, .4, .4, .9};
    for (std::size_t j = 0; j < 5; ++j) {
        EXPECT_NEAR(shares.stripes[j].share, share[j], 1e-12);
        EXPECT_NEAR(shares.stripes[j].monotone, want[j], 1e-12);
    }
    EXPECT_THROW(stripe_shares(grouped(std::vector<FragilityRun>{{0, {1, 2}, 0, 1}})), InputError);
}

/// Nothing reached under twenty records: the exact limit 1 - tail^(1/20), of the band with a third of the tail at each
/// of three stripes. At the next ones the band keeps what weaker or stronger shaking implies.
TEST(StripeShares, BandByHand)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < 20; ++g)
        for (const auto& [im, reached] : {std::pair{1.0, 0.0}, std::pair{2.0, 0.0}, std::pair{3.0, 4.0}})
            if (im != 1 || g < 5)
                runs.push_back({g, {im}, reached, 4});
    const StripeShares shares = stripe_shares(grouped(runs), 0.95);
    const double limit = 1 - std::pow(0.025, 1.0 / 20), band = 1 - std::pow(0.025 / 3, 1.0 / 20);
    for (std::size_t j = 0; j < 2; ++j) { // five records alone would leave 1 - 0.025^(1/5)
        EXPECT_NEAR(shares.stripes[j].limits.upper, limit, 1e-7) << j;
        EXPECT_NEAR(shares.stripes[j].band.upper, band, 1e-7) << j;
    }
    EXPECT_NEAR(shares.stripes[2].limits.lower, 1 - limit, 1e-7);
    EXPECT_NEAR(shares.stripes[2].band.lower, 1 - band, 1e-7);
    EXPECT_EQ(shares.stripes[1].band.lower, 0);
}

/// The p-value of the largest decrease against all signs of eight records; 1999 of them are drawn.
TEST(StripeShares, DecreaseAgainstAllSigns)
{
    constexpr std::size_t records = 8, stripes = 3;
    const std::array<std::array<double, stripes>, records> reached = {
        {{3, 8, 4}, {5, 6, 6}, {2, 7, 7}, {4, 9, 5}, {6, 5, 6}, {1, 8, 3}, {5, 7, 8}, {3, 6, 5}}};
    std::vector<FragilityRun> runs;
    std::array<double, stripes> share{};
    for (std::uint32_t g = 0; g < records; ++g)
        for (std::size_t j = 0; j < stripes; ++j) {
            runs.push_back({g, {1.0 + static_cast<double>(j)}, reached[g][j], 10});
            share[j] += reached[g][j] / 80;
        }
    // contributions of the records to the decreases, in standard errors with n / (n - 1)
    struct Decrease {
        double size;
        std::array<double, records> part;
    };
    std::vector<Decrease> all;
    for (std::size_t i = 0; i < stripes; ++i)
        for (std::size_t j = i + 1; j < stripes; ++j) {
            Decrease d{share[i] - share[j], {}};
            double square = 0;
            for (std::size_t g = 0; g < records; ++g) {
                d.part[g] = (reached[g][i] / 10 - share[i] - reached[g][j] / 10 + share[j]) / records;
                square += d.part[g] * d.part[g] * 8 / 7;
            }
            d.size /= std::sqrt(square);
            for (double& part : d.part)
                part /= std::sqrt(square);
            all.push_back(d);
        }
    const double largest = std::max({all[0].size, all[1].size, all[2].size});
    int as_large = 0;
    for (unsigned signs = 0; signs < 256; ++signs)
        as_large += std::any_of(all.begin(), all.end(), [&](const Decrease& d) {
            double sum = 0;
            for (std::size_t g = 0; g < records; ++g)
                sum += (signs >> g & 1U) != 0 ? d.part[g] : -d.part[g];
            return sum >= largest;
        });
    const double want = as_large / 256.0, found = stripe_shares(grouped(runs)).p_monotone;
    EXPECT_NEAR(found, want, 4 * std::sqrt(want * (1 - want) / 1999)) << largest;
    EXPECT_GT(want, 0.02);
}

TEST(StripeShares, IntervalsCoverAndTheBandCoversAllAtOnce)
{
    const FragilityTruth truth;
    std::vector<int> covered(truth.stripes.size(), 0);
    int band = 0;
    for (std::uint64_t r = 0; r < 400; ++r) {
        const StripeShares shares = stripe_shares(grouped(truth.draw(22, r)));
        bool all = true;
        for (std::size_t j = 0; j < covered.size(); ++j) {
            const double p = truth.probability(truth.stripes[j]);
            covered[j] += contains(shares.stripes[j].limits, p) ? 1 : 0;
            all = all && contains(shares.stripes[j].band, p);
        }
        band += all ? 1 : 0;
    }
    for (const int count : covered)
        EXPECT_NEAR(count / 400.0, 0.95, 0.044); // four standard errors
    EXPECT_GT(band / 400.0, 0.95 - 0.044);
}

TEST(StripeShares, StrongerButLessDangerousIsSaid)
{
    FragilityTruth truth;
    truth.dip_stripe = 5;
    truth.dip = 0.6;
    const StripeShares dip = stripe_shares(grouped(truth.draw(23, 0)));
    EXPECT_LT(dip.p_monotone, 0.05);
    EXPECT_NE(dip.says.find("to 1.55 the share"), std::string::npos) << dip.says;
    // the worst case for chance falls: no dependence on the intensity at all; four standard errors of .05 are .05
    truth.dip = 0;
    truth.stripes = {0.999, 1, 1.001, 1.002};
    int rejected = 0;
    for (std::uint64_t r = 0; r < 300; ++r)
        rejected += stripe_shares(grouped(truth.draw(24, r)), 0.95, r).p_monotone < 0.05 ? 1 : 0;
    EXPECT_LT(rejected / 300.0, 0.10);
}
