/// Fragility curves: published fits, known truths, coverage of the intervals, and data that bear no curve.

#include "ensemble/estimators/fragility/binomial_regression.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/model/input_error.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

using namespace stylobate;

namespace {

/// Mortality of beetles after five hours of carbon disulphide: Bliss, "The calculation of the dosage-mortality curve"
/// (1935); the usual example of Dobson & Barnett, "An introduction to generalized linear models".
std::vector<FragilityRun> beetles()
{
    const double log_dose[] = {1.6907, 1.7242, 1.7552, 1.7842, 1.8113, 1.8369, 1.8610, 1.8839};
    const double n[] = {59, 60, 62, 56, 63, 59, 62, 60}, killed[] = {6, 13, 18, 28, 52, 53, 61, 60};
    std::vector<FragilityRun> runs;
    for (std::uint32_t i = 0; i < 8; ++i)
        runs.push_back({i, {std::exp(log_dose[i])}, killed[i], n[i]});
    return runs;
}

/// 2 (log likelihood of the shares themselves - of the fit).
double deviance(const FragilityCurve& curve, const std::vector<FragilityRun>& runs)
{
    double saturated = 0;
    for (const FragilityRun& run : runs) {
        const double k = run.reached, m = run.trials - run.reached;
        saturated += (k > 0 ? k * std::log(k / run.trials) : 0) + (m > 0 ? m * std::log(m / run.trials) : 0);
    }
    return 2 * (saturated - curve.log_likelihood);
}

FragilityRun run(std::uint32_t record, double intensity, double reached, double trials)
{
    return {record, {intensity}, reached, trials};
}

/// All of `records` at each of `intensities`, reached or not as the whole stripe.
FragilityData stripes(std::uint32_t records, const std::vector<double>& intensities, const std::vector<double>& share)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < records; ++g)
        for (std::size_t j = 0; j < share.size(); ++j)
            runs.push_back(run(g, intensities[j], 10 * share[j], 10));
    return grouped(runs);
}

std::string joined(const std::vector<std::string>& says)
{
    std::string all;
    for (const std::string& sentence : says)
        all += sentence + '\n';
    return all;
}

/// One stripe that is reached in part, and none below: the steeper the likelier, for ever.
TEST(BinomialRegression, OneStripeInPartIsNoCurve)
{
    Eigen::MatrixXd predictors(5, 2);
    BinomialCounts counts{Eigen::VectorXd::Constant(5, 108), Eigen::VectorXd::Zero(5)};
    for (Eigen::Index i = 0; i < 5; ++i)
        predictors.row(i) << 1, 0.75 * static_cast<double>(i);
    counts.reached[4] = 44;
    for (const Link link : {Link::probit, Link::logit})
        EXPECT_EQ(fit_binomial(link, predictors, counts).maximum, Maximum::separated);
    counts.reached[3] = 1;
    EXPECT_EQ(fit_binomial(Link::probit, predictors, counts).maximum, Maximum::inside);
}

/// A start where the curve is so steep that hardly a point says anything leads to the same maximum.
TEST(BinomialRegression, AStartFarAwayChangesNothing)
{
    Eigen::MatrixXd predictors(6, 2);
    BinomialCounts counts{Eigen::VectorXd::Constant(6, 40), Eigen::VectorXd(6)};
    for (Eigen::Index i = 0; i < 6; ++i)
        predictors.row(i) << 1, 0.3 * static_cast<double>(i);
    counts.reached << 0, 2, 11, 25, 38, 40;
    const BinomialFit cold = fit_binomial(Link::probit, predictors, counts);
    const ParameterVector steep = (ParameterVector(2) << -4e4, 5e4).finished();
    const BinomialFit warm = fit_binomial(Link::probit, predictors, counts, {}, steep);
    ASSERT_EQ(warm.maximum, Maximum::inside);
    EXPECT_NEAR(warm.coefficients[0], cold.coefficients[0], 1e-8);
    EXPECT_NEAR(warm.coefficients[1], cold.coefficients[1], 1e-8);
}

double probit_log_likelihood(const Eigen::MatrixXd& predictors, const BinomialCounts& counts, const ParameterVector& b)
{
    const Eigen::VectorXd eta = predictors * b;
    double sum = 0;
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
        const LinkValue at = link_at(Link::probit, eta[i]);
        sum += counts.reached[i] * std::log(at.below) + (counts.trials[i] - counts.reached[i]) * std::log(at.above);
    }
    return sum;
}

} // namespace

TEST(FragilityCurve, PublishedFitsOfTheBeetles)
{
    const auto runs = beetles();
    const FragilityData data = grouped(runs);
    const FragilityCurve logit = fragility_curve(data, {.link = Link::logit});
    EXPECT_NEAR(logit.coefficients[0].value, -60.717, 5e-4);
    EXPECT_NEAR(logit.coefficients[1].value, 34.270, 5e-4);
    EXPECT_NEAR(deviance(logit, runs), 11.232, 5e-4);
    const FragilityCurve probit = fragility_curve(data, {.link = Link::probit});
    EXPECT_NEAR(probit.coefficients[0].value, -34.935, 5e-4);
    EXPECT_NEAR(probit.coefficients[1].value, 19.728, 5e-4);
    EXPECT_NEAR(deviance(probit, runs), 10.12, 5e-3);
    EXPECT_NEAR(std::log(probit.median.value), 34.935 / 19.728, 1e-4);
    EXPECT_NEAR(probit.dispersion.value, 1 / 19.728, 1e-5);
}

TEST(FragilityCurve, ProfileLimitsLieWhereTheLikelihoodHasFallen)
{
    // the beetles by a search over the other coefficient, on a grid that the estimator does not know
    const FragilityData data = grouped(beetles());
    const FragilityCurve curve = fragility_curve(data, {.link = Link::probit, .at = {{std::exp(1.75)}}});
    const Eigen::MatrixXd x = log_predictors(data);
    const BinomialCounts counts = counts_of(data);
    const auto best_with_median = [&](double log_median) {
        double best = -1e300;
        for (double slope = 10; slope < 30; slope += 0.001) {
            const ParameterVector b = (ParameterVector(2) << -slope * log_median, slope).finished();
            best = std::max(best, probit_log_likelihood(x, counts, b));
        }
        return best;
    };
    for (const double limit : {curve.median.profile_runs.lower, curve.median.profile_runs.upper})
        EXPECT_NEAR(2 * (curve.log_likelihood - best_with_median(std::log(limit))), 3.841459, 1e-3);
    EXPECT_LT(curve.median.profile_runs.lower, curve.median.value);
    EXPECT_GT(curve.median.profile_runs.upper, curve.median.value);
    EXPECT_LT(curve.at[0].probability.profile_runs.lower, curve.at[0].probability.value);
    EXPECT_GT(curve.at[0].probability.profile_runs.upper, curve.at[0].probability.value);
}

TEST(FragilityCurve, FindsTheTruthInManyRecords)
{
    const FragilityTruth truth{.median = 1.1, .between = 0.35, .within = 0.2, .records = 20000, .runs = 2};
    const FragilityCurve curve = fragility_curve(grouped(truth.draw(1, 0)), {.at = {{1.5}}});
    EXPECT_NEAR(std::log(curve.median.value / truth.median), 0, 4 * truth.dispersion() / std::sqrt(20000.0));
    EXPECT_NEAR(curve.dispersion.value, truth.dispersion(), 0.01);
    EXPECT_NEAR(curve.at[0].probability.value, truth.probability(1.5), 0.01);
}

TEST(FragilityCurve, TwoMeasuresAndTheirIntervals)
{
    // the truth is a plane in both logarithms
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < 4000; ++g) {
        const auto u = [&](std::uint64_t e) { return uniform01(3, g, Stream::virtual_specimen, e); };
        const double a = std::exp(2 * u(0) - 1), b = std::exp(2 * u(1) - 1);
        const double p = link_at(Link::logit, -0.5 + 2 * std::log(a) + 1 * std::log(b)).below;
        runs.push_back({g, {a, b}, u(2) < p ? 1.0 : 0.0, 1});
    }
    const FragilityCurve curve = fragility_curve(grouped(runs), {.link = Link::logit, .at = {{1, 1}}});
    const double want[] = {-0.5, 2, 1};
    for (std::size_t j = 0; j < 3; ++j) {
        const double half = (curve.coefficients[j].records.upper - curve.coefficients[j].records.lower) / 2;
        EXPECT_NEAR(curve.coefficients[j].value, want[j], 2 * half) << j; // four standard errors
        EXPECT_LT(half, 0.25);
        // one run each: what the records say and what the runs say is the same
        EXPECT_NEAR((curve.coefficients[j].profile_runs.upper - curve.coefficients[j].profile_runs.lower) / 2, half,
                    0.1 * half);
    }
    EXPECT_TRUE(std::isnan(curve.median.value));
}

TEST(FragilityCurve, IntervalsCover)
{
    // 600 repeats: three standard errors of a coverage of .95 are .027
    const FragilityTruth truth{.records = 40};
    int records = 0, runs = 0, at = 0;
    const int repeats = 600;
    for (std::uint64_t r = 0; r < repeats; ++r) {
        const FragilityCurve curve = fragility_curve(grouped(truth.draw(2, r)), {.at = {{0.7}}});
        const auto covers = [](const Limits& limits, double value) {
            return limits.lower <= value && value <= limits.upper ? 1 : 0;
        };
        records += covers(curve.median.records, truth.median);
        runs += covers(curve.median.profile_runs, truth.median);
        at += covers(curve.at[0].probability.records, truth.probability(0.7));
    }
    EXPECT_NEAR(records / double(repeats), 0.95, 0.027);
    EXPECT_NEAR(at / double(repeats), 0.95, 0.027);
    EXPECT_LT(runs / double(repeats), 0.8) << "runs of one record are not independent, and it must show";
}

TEST(FragilityCurve, BootstrapIsTheSameForTheSameSeedAndLikeTheOthers)
{
    const FragilityData data = grouped(FragilityTruth{.records = 60}.draw(4, 0));
    const FragilityCurve one = fragility_curve(data, {.resamples = 1000, .seed = 7});
    const FragilityCurve same = fragility_curve(data, {.resamples = 1000, .seed = 7});
    const FragilityCurve other = fragility_curve(data, {.resamples = 1000, .seed = 8});
    EXPECT_EQ(one.median.bootstrap.lower, same.median.bootstrap.lower);
    EXPECT_NE(one.median.bootstrap.lower, other.median.bootstrap.lower);
    const double width = one.median.records.upper - one.median.records.lower;
    EXPECT_NEAR(one.median.bootstrap.upper - one.median.bootstrap.lower, width, 0.25 * width);
}

TEST(FragilityCurve, ManyRunsTakeSeconds)
{
    const FragilityTruth truth{.records = 60, .runs = 125}; // 60,000 runs
    const auto runs = truth.draw(5, 0);
    const auto start = std::chrono::steady_clock::now();
    const FragilityCurve curve = fragility_curve(grouped(runs), {.resamples = 2000});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_EQ(curve.trials, 60000);
    EXPECT_TRUE(std::isfinite(curve.median.bootstrap.lower));
    EXPECT_LT(seconds, 10);
}

TEST(FragilityCurve, SeparatedDataGiveBoundsAndNoCurve)
{
    const FragilityCurve curve = fragility_curve(stripes(20, {1, 2, 3, 4}, {0, 0, 1, 1}), {.at = {{1}, {2.5}, {4}}});
    EXPECT_EQ(curve.maximum, Maximum::separated);
    EXPECT_TRUE(std::isnan(curve.median.value));
    EXPECT_EQ(curve.median.records.lower, 2);
    EXPECT_EQ(curve.median.records.upper, 3);
    // with 20 records each, p <= 1 - .025^(1/20) at 2 and p >= .025^(1/20) at 3, the exact binomial bounds
    EXPECT_NEAR(curve.at[0].probability.records.upper, 1 - std::pow(0.025, 0.05), 1e-12);
    EXPECT_EQ(curve.at[1].probability.records.upper, 1);
    EXPECT_NEAR(curve.at[2].probability.records.lower, std::pow(0.025, 0.05), 1e-12);
    // a lognormal curve rises from one bound to the other between 2 and 3: ln(3 / 2) over twice 0.960374, the normal
    // quantile of 0.025^(1/20) = 0.83157
    EXPECT_NEAR(curve.dispersion.records.upper, std::log(1.5) / (2 * 0.960374), 1e-5);
    EXPECT_EQ(curve.dispersion.records.lower, 0);
    EXPECT_NE(joined(curve.says).find("no maximum"), std::string::npos) << joined(curve.says);
    // two records say little: no bound on the median
    const FragilityCurve few = fragility_curve(stripes(2, {1, 2, 3, 4}, {0, 0, 1, 1}), {});
    EXPECT_EQ(few.median.records.lower, 0);
    EXPECT_TRUE(std::isinf(few.median.records.upper));
}

/// The search for the maximum used to end at a steep curve between two stripes, by rounding, with no width.
TEST(FragilityCurve, TwoStripesThatSeparateHaveNoMaximum)
{
    for (const double upper : {0.12, 0.775, 6.0, 1e4}) {
        const FragilityCurve curve = fragility_curve(stripes(20, {0.1, upper}, {0, 1}), {.at = {{0.1}, {upper}}});
        EXPECT_EQ(curve.maximum, Maximum::separated) << upper;
        EXPECT_TRUE(std::isnan(curve.median.value) && std::isnan(curve.dispersion.value)) << upper;
        EXPECT_EQ(curve.median.records.lower, 0.1) << upper;
        EXPECT_EQ(curve.median.records.upper, upper);
        EXPECT_NE(joined(curve.says).find("The stripes separate"), std::string::npos) << joined(curve.says);
    }
    // a stripe that is reached in part between them: any share of it, a slope without end
    for (const double share : {0.1, 0.5, 0.9}) {
        const FragilityCurve curve = fragility_curve(stripes(20, {1, 2, 3}, {0, share, 1}), {});
        EXPECT_EQ(curve.maximum, Maximum::separated) << share;
        EXPECT_EQ(curve.median.records.lower, 1);
        EXPECT_EQ(curve.median.records.upper, 3);
    }
    EXPECT_EQ(fragility_curve(stripes(20, {1, 2, 3, 4}, {0, 0.4, 0.6, 1}), {}).maximum, Maximum::inside);
}

TEST(FragilityCurve, WeakerShakingThatDamagesMoreBearsNoCurve)
{
    const FragilityCurve curve = fragility_curve(stripes(20, {1, 2}, {1, 0}), {.at = {{1.5}}});
    EXPECT_EQ(curve.maximum, Maximum::separated);
    EXPECT_LE(curve.median.records.lower, curve.median.records.upper);
    EXPECT_LE(curve.at[0].probability.records.lower, curve.at[0].probability.records.upper);
    EXPECT_NE(joined(curve.says).find("no curve that rises"), std::string::npos) << joined(curve.says);
}

TEST(FragilityCurve, OneRecordIsOneRecord)
{
    const std::string none = joined(fragility_curve(stripes(1, {1, 2, 3}, {0, 0, 0}), {}).says);
    EXPECT_EQ(none.find("None of 30 runs of 1 record reached"), 0U) << none;
    const std::string few = joined(fragility_curve(stripes(1, {1, 2, 3}, {0.2, 0.5, 0.7}), {}).says);
    EXPECT_NE(few.find("1 record is too few for an interval"), std::string::npos) << few;
}

/// Equal records (the same motion several times) show no scatter, and an interval without a width would be false.
TEST(FragilityCurve, EqualRecordsHaveNoInterval)
{
    const FragilityCurve curve = fragility_curve(stripes(20, {1, 2, 3}, {0.2, 0.5, 0.7}), {});
    EXPECT_EQ(curve.maximum, Maximum::inside);
    EXPECT_EQ(curve.median.records.lower, 0);
    EXPECT_TRUE(std::isinf(curve.median.records.upper));
    EXPECT_NE(joined(curve.says).find("same outcomes"), std::string::npos) << joined(curve.says);
}

/// A slope that may be 0 bounds no median.
TEST(FragilityCurve, ASlopeThatIsNotSignificantBoundsNoMedian)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < 20; ++g)
        for (const double im : {1.0, 1.1, 1.2})
            runs.push_back(run(g, im, (g * 7 + static_cast<std::uint32_t>(10 * im)) % 11 < 5 ? 1 : 0, 1));
    const FragilityCurve curve = fragility_curve(grouped(runs), {});
    ASSERT_EQ(curve.maximum, Maximum::inside);
    ASSERT_LT(curve.coefficients[1].records.lower, 0);
    EXPECT_EQ(curve.median.records.lower, 0);
    EXPECT_TRUE(std::isinf(curve.median.records.upper));
}

TEST(FragilityCurve, SeparatedInTwoMeasures)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < 60; ++g) {
        const double a = std::exp(uniform01(1, g, Stream::virtual_specimen, 0));
        const double b = std::exp(uniform01(1, g, Stream::virtual_specimen, 1));
        runs.push_back({g, {a, b}, a * b > std::exp(1.0) ? 1.0 : 0.0, 1});
    }
    const FragilityCurve curve = fragility_curve(grouped(runs), {});
    EXPECT_EQ(curve.maximum, Maximum::separated);
    EXPECT_TRUE(std::isnan(curve.coefficients[1].value));
}

TEST(FragilityCurve, NothingOrEverythingFalls)
{
    const FragilityCurve none = fragility_curve(stripes(30, {1, 2}, {0, 0}), {.at = {{2}, {3}}});
    EXPECT_EQ(none.maximum, Maximum::none);
    EXPECT_EQ(none.at[0].probability.records.lower, 0);
    EXPECT_NEAR(none.at[0].probability.records.upper, 1 - std::pow(0.025, 1.0 / 30), 1e-12);
    EXPECT_EQ(none.at[1].probability.records.upper, 1) << "nothing is known above the strongest shaking";
    EXPECT_NE(joined(none.says).find("Increase the intensities"), std::string::npos);
    const FragilityCurve all = fragility_curve(stripes(30, {1, 2}, {1, 1}), {.at = {{1}}});
    EXPECT_EQ(all.maximum, Maximum::all);
    EXPECT_NEAR(all.at[0].probability.records.lower, std::pow(0.025, 1.0 / 30), 1e-12);
}

TEST(FragilityCurve, FewRecordsHaveNoIntervalAndSaySo)
{
    const FragilityCurve few = fragility_curve(grouped(FragilityTruth{.records = 5}.draw(1, 0)), {});
    EXPECT_TRUE(std::isinf(few.median.records.upper));
    EXPECT_NE(joined(few.says).find("too few"), std::string::npos);
    const FragilityCurve some = fragility_curve(grouped(FragilityTruth{.records = 9}.draw(1, 0)), {});
    EXPECT_TRUE(std::isfinite(some.median.records.upper));
    EXPECT_NE(joined(some.says).find("fewer than 10"), std::string::npos);
}

TEST(FragilityCurve, AShareThatFallsWithIntensityHasNoMedian)
{
    const FragilityCurve curve = fragility_curve(stripes(30, {1, 2, 3}, {0.8, 0.5, 0.3}), {});
    EXPECT_TRUE(std::isnan(curve.median.value));
    EXPECT_NE(joined(curve.says).find("does not grow"), std::string::npos);
    const FragilityCurve at = fragility_curve(stripes(30, {1, 2, 3}, {0.8, 0.5, 0.3}), {.at = {{2}}});
    EXPECT_TRUE(std::isnan(at.at[0].probability.value)) << "no curve is drawn";
}

TEST(FragilityData, RefusesWhatIsNoOutcome)
{
    EXPECT_THROW(grouped({}), InputError);
    EXPECT_THROW(grouped(std::vector{run(0, 0, 1, 1)}), InputError);
    EXPECT_THROW(grouped(std::vector{run(0, 1, 2, 1)}), InputError);
    EXPECT_THROW(grouped(std::vector<FragilityRun>{{0, {1}, 0, 1}, {0, {1, 2}, 0, 1}}), InputError);
    EXPECT_THROW(fragility_curve(grouped(std::vector{run(0, 1, 1, 2), run(1, 1, 1, 2)}), {}), InputError);
}
