/// Lack of fit, shares by stripe, and monotony: right sizes under true curves, power against curves with a dip.

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/lack_of_fit.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/model/input_error.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <gtest/gtest.h>

using namespace stylobate;

namespace {

LackOfFit fit_of(const FragilityTruth& truth, std::uint64_t repeat)
{
    const FragilityData data = grouped(truth.draw(21, repeat));
    return lack_of_fit(fitted_curve(data, log_predictors(data), Link::probit));
}

bool covers(const Limits& limits, double value)
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
            covered[j] += covers(shares.stripes[j].limits, p) ? 1 : 0;
            all = all && covers(shares.stripes[j].band, p);
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
