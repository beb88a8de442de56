/// Fits, the influence of records on them, and their intervals by hand: of two stripes, where the curve passes through
/// both shares, so that all of it has a closed form.

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace stylobate;

namespace {

/// Trials and how many of them reached it.
struct Count {
    double n, k;
};
using Stripe = std::vector<Count>; // (records)

/// Four records at ln im = 0 (40 of 100 reached) and 1 (28 of 40).
const Stripe first = {{10, 2}, {20, 8}, {30, 9}, {40, 21}}, second = {{5, 2}, {10, 8}, {15, 9}, {10, 9}};

FragilityData two_stripes(const Stripe& low, const Stripe& high)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < low.size(); ++g) {
        runs.push_back({g, {1}, low[g].k, low[g].n});
        runs.push_back({g, {std::exp(1.0)}, high[g].k, high[g].n});
    }
    return grouped(runs);
}

Count sum_of(const Stripe& stripe, const std::vector<double>& weight)
{
    Count all{0, 0};
    for (std::size_t g = 0; g < stripe.size(); ++g) {
        all.n += weight[g] * stripe[g].n;
        all.k += weight[g] * stripe[g].k;
    }
    return all;
}

double logit(const Count& c)
{
    return std::log(c.k / (c.n - c.k));
}

/// The step of a stripe's logit with a record, whose score is k - n p and whose information n p (1 - p), from the fit
/// without its information: (k - n p) / ((N - n) p (1 - p)).
double step(const Count& record, const Count& all)
{
    const double p = all.k / all.n;
    return (record.k - record.n * p) / ((all.n - record.n) * p * (1 - p));
}

FittedCurve logit_curve()
{
    const FragilityData data = two_stripes(first, second);
    return fitted_curve(data, log_predictors(data), Link::logit);
}

const std::vector<double> once = {1, 1, 1, 1};
const Count all_first{100, 40}, all_second{40, 28};

/// Of the linear predictor at the first stripe.
CurveTarget at_first()
{
    return CurveTarget::sum((ParameterVector(2) << 1, 0).finished());
}

/// Twice the log likelihood of a stripe's share less that of another probability.
double deviance(const Count& all, double eta)
{
    const double p = 1 / (1 + std::exp(-eta)), share = all.k / all.n;
    return 2 * (all.k * std::log(share / p) + (all.n - all.k) * std::log((1 - share) / (1 - p)));
}

} // namespace

TEST(RecordInfluence, OfTwoStripesByHand)
{
    const FragilityData data = two_stripes(first, second);
    const Eigen::MatrixXd x = log_predictors(data);
    const BinomialFit fit = fit_binomial(Link::logit, x, counts_of(data));
    EXPECT_NEAR(fit.coefficients[0], std::log(2.0 / 3), 1e-9);
    EXPECT_NEAR(fit.coefficients[1], std::log(7.0 / 3) - std::log(2.0 / 3), 1e-9);
    // k - n p over (N - n) p (1 - p), of p = 0.4 and 0.7: the constant has the first one, the slope the difference
    const double low[] = {-2 / 21.6, 0, -3 / 16.8, 5 / 14.4}, high[] = {-1.5 / 7.35, 1 / 6.3, -1.5 / 5.25, 2 / 6.3};
    const Eigen::MatrixXd influence = record_influence(Link::logit, x, data, fit, {});
    for (Eigen::Index g = 0; g < 4; ++g) {
        EXPECT_NEAR(influence(g, 0), low[g], 1e-9) << g;
        EXPECT_NEAR(influence(g, 1), high[g] - low[g], 1e-9) << g;
    }
    // probit at shares of one half, where the density is 1 / sqrt(2 pi): (k - m) sqrt(pi / 2) / (N - n)
    const Stripe half = {{10, 7}, {20, 6}, {30, 17}};
    const FragilityData even = two_stripes(half, half);
    const BinomialFit flat = fit_binomial(Link::probit, x, counts_of(even));
    const Eigen::MatrixXd of_half = record_influence(Link::probit, x, even, flat, {});
    const double unit = std::sqrt(std::numbers::pi / 2), wanted[] = {4 * unit / 50, -8 * unit / 40, 4 * unit / 30};
    for (Eigen::Index g = 0; g < 3; ++g) {
        EXPECT_NEAR(of_half(g, 0), wanted[g], 1e-9) << g;
        EXPECT_NEAR(of_half(g, 1), 0, 1e-9) << g;
    }
}

/// A record of little weight: the fit less that without it is its influence, to the first order of its weight.
TEST(RecordInfluence, IsTheFitLessThatWithoutTheRecord)
{
    std::vector<FragilityRun> runs = FragilityTruth{.records = 12}.draw(5, 0);
    const double reached[] = {0.01, 0, 0.06, 0.02, 0.09, 0.05, 0.1, 0.08};
    for (std::size_t j = 0; j < 8; ++j)
        runs.push_back({12, {runs[j].intensity}, reached[j], 0.1});
    for (const Link link : {Link::probit, Link::logit}) {
        const FragilityData with = grouped(runs), without = grouped(std::span(runs).first(runs.size() - 8));
        const Eigen::MatrixXd x = log_predictors(with);
        const BinomialFit fit = fit_binomial(link, x, counts_of(with)),
                          rest = fit_binomial(link, x, counts_of(without));
        const Eigen::VectorXd influence = record_influence(link, x, with, fit, {}).row(12);
        const Eigen::VectorXd change = fit.coefficients - rest.coefficients;
        EXPECT_GT(change.norm(), 1e-4);
        EXPECT_LT((influence - change).norm(), 5e-3 * change.norm()) << to_string(link);
    }
}

TEST(RecordCovariance, IsTheSumOfSquaresTimesThreeQuarters)
{
    const FittedCurve curve = logit_curve();
    double b00 = 0, b01 = 0, b11 = 0;
    for (std::size_t g = 0; g < 4; ++g) {
        const double a = step(first[g], all_first), b = step(second[g], all_second) - a;
        b00 += 0.75 * a * a;
        b01 += 0.75 * a * b;
        b11 += 0.75 * b * b;
    }
    EXPECT_NEAR(curve.covariance(0, 0), b00, 1e-9);
    EXPECT_NEAR(curve.covariance(0, 1), b01, 1e-9);
    EXPECT_NEAR(curve.covariance(1, 0), b01, 1e-9);
    EXPECT_NEAR(curve.covariance(1, 1), b11, 1e-9);
}

/// A resample that has the first record twice and the second one not at all: each copy is left out by itself.
TEST(RecordCovariance, OfAResampleByHand)
{
    const FragilityData data = two_stripes(first, second);
    const Eigen::MatrixXd x = log_predictors(data);
    const Eigen::VectorXd weight = (Eigen::VectorXd(4) << 2, 0, 1, 1).finished();
    const BinomialFit fit = fit_binomial(Link::logit, x, counts_of(data, weight));
    const Count drawn = sum_of(first, {2, 0, 1, 1});
    EXPECT_EQ(drawn.n, 90);
    EXPECT_EQ(drawn.k, 34);
    EXPECT_NEAR(fit.coefficients[0], logit(drawn), 1e-9);
    const double d[] = {step(first[0], drawn), step(first[2], drawn), step(first[3], drawn)};
    EXPECT_NEAR(record_covariance(Link::logit, x, data, fit, weight)(0, 0),
                0.75 * (2 * d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), 1e-9);
}

TEST(CurveTarget, ValueAndGradientByHand)
{
    const ParameterVector b = (ParameterVector(2) << -2, 4).finished();
    EXPECT_EQ(CurveTarget::log_median().value(b), 0.5);
    EXPECT_EQ(CurveTarget::log_median().gradient(b)[0], -0.25);
    EXPECT_EQ(CurveTarget::log_median().gradient(b)[1], -0.125);
    EXPECT_EQ(CurveTarget::slope().value(b), 4);
    EXPECT_EQ(CurveTarget::sum((ParameterVector(2) << 1, 3).finished()).value(b), 10);
}

TEST(CurveTarget, SpreadOfARecordsShareByHand)
{
    const FittedCurve curve = logit_curve();
    const RecordSpread spread = record_spread(curve, at_first());
    double square = 0;
    for (const Count& record : first)
        square += std::pow(step(record, all_first), 2);
    EXPECT_NEAR(spread.variance, 0.75 * square, 1e-9);
    // each record's share of the information on the first stripe is that of its trials: 100^2 / (10^2 + ... + 40^2) - 1
    EXPECT_NEAR(spread.freedom, 10000.0 / 3000 - 1, 1e-9);
    // independent runs have the variance 1 / (N p (1 - p)) = 1 / 24
    EXPECT_NEAR(spread.inflation, 0.75 * square * 24, 1e-9);
}

TEST(CurveTarget, WaldLimitsByHand)
{
    const FittedCurve curve = logit_curve();
    const RecordSpread spread = record_spread(curve, at_first());
    const double reach = student_quantile(0.95, 7.0 / 3) * std::sqrt(spread.variance);
    const Limits limits = wald_limits(curve, at_first(), 0.9);
    EXPECT_NEAR(limits.lower, std::log(2.0 / 3) - reach, 1e-9);
    EXPECT_NEAR(limits.upper, std::log(2.0 / 3) + reach, 1e-9);
}

/// The other stripe keeps its share, so that the profile is the likelihood of the stripe alone.
TEST(CurveTarget, ProfilesHaveTheDevianceOfTheirQuantile)
{
    const FittedCurve curve = logit_curve();
    EXPECT_NEAR(profile_deviance(curve, at_first(), 0.3), deviance(all_first, 0.3), 1e-9);
    const Limits runs = profile_limits(curve, at_first(), 0.95);
    EXPECT_LT(runs.lower, std::log(2.0 / 3));
    EXPECT_GT(runs.upper, std::log(2.0 / 3));
    for (const double eta : {runs.lower, runs.upper}) // 1.959964^2, of chi-square
        EXPECT_NEAR(deviance(all_first, eta), 3.841459, 1e-5);
    const RecordSpread spread = record_spread(curve, at_first());
    const double t = student_quantile(0.975, 7.0 / 3);
    const Limits records = record_limits(curve, at_first(), 0.95);
    EXPECT_LT(records.lower, std::log(2.0 / 3));
    EXPECT_GT(records.upper, std::log(2.0 / 3));
    for (const double eta : {records.lower, records.upper})
        EXPECT_NEAR(deviance(all_first, eta) / (t * t * spread.inflation), 1, 1e-6);
}

/// The logarithm of the median, -b0 / b1, of the fits without each record: the logits of what is left.
TEST(CurveTarget, JackknifeLimitsByHand)
{
    const FittedCurve curve = logit_curve();
    const Jackknife without = jackknife(curve);
    ASSERT_EQ(without.coefficients.size(), 4U);
    const auto log_median = [](double low, double high) { return -low / (high - low); };
    std::vector<double> rest;
    for (std::size_t g = 0; g < 4; ++g) {
        std::vector<double> weight = once;
        weight[g] = 0;
        const double low = logit(sum_of(first, weight)), high = logit(sum_of(second, weight));
        EXPECT_NEAR(without.coefficients[g][0], low, 1e-7) << g;
        EXPECT_NEAR(without.coefficients[g][1], high - low, 1e-7) << g;
        rest.push_back(log_median(low, high));
    }
    const double low = std::log(2.0 / 3), high = std::log(7.0 / 3), value = log_median(low, high), b1 = high - low;
    double mean = 0, square = 0;
    for (const double r : rest)
        mean += r / 4;
    for (const double r : rest)
        square += (r - mean) * (r - mean);
    // the gradient over the two logits is (-high, low) / b1^2; a record has n p (1 - p) of the information on each
    double shares = 0, squares = 0;
    for (std::size_t g = 0; g < 4; ++g) {
        const double share = first[g].n * 0.24 * std::pow(high / (b1 * b1 * 24), 2) +
                             second[g].n * 0.21 * std::pow(low / (b1 * b1 * 8.4), 2);
        shares += share;
        squares += share * share;
    }
    const double freedom = shares * shares / squares - 1;
    EXPECT_NEAR(record_spread(curve, CurveTarget::log_median()).freedom, freedom, 1e-9);
    const double reach = student_quantile(0.975, freedom) * std::sqrt(0.75 * square);
    const Limits limits = jackknife_limits(curve, without, CurveTarget::log_median(), 0.95);
    EXPECT_NEAR(limits.lower, 4 * value - 3 * mean - reach, 1e-6);
    EXPECT_NEAR(limits.upper, 4 * value - 3 * mean + reach, 1e-6);
}

/// 39 resamples at level 0.9: the limits are the second smallest and the second largest. Each resample's logit is that
/// of its counts.
TEST(RecordBootstrap, LimitsByHand)
{
    constexpr std::size_t resamples = 39;
    const FittedCurve curve = logit_curve();
    const CurveTarget targets[] = {at_first()};
    const BootstrapLimits found = bootstrap_limits(curve, targets, 0.9, resamples, 3).front();
    EXPECT_EQ(found.without_maximum, 0U);
    const double value = std::log(2.0 / 3);
    double square = 0, cube = 0;
    for (const Count& record : first) {
        square += std::pow(step(record, all_first), 2);
        cube += std::pow(step(record, all_first), 3);
    }
    const double error = std::sqrt(0.75 * square);
    std::vector<double> values, studentized;
    double below = 0;
    for (std::uint64_t i = 0; i < resamples; ++i) {
        std::vector<double> weight(4, 0.0);
        for (std::uint64_t draw = 0; draw < 4; ++draw)
            weight[static_cast<std::size_t>(4 * uniform01(3, i, Stream::bootstrap, draw))] += 1;
        const Count drawn = sum_of(first, weight);
        double own = 0;
        for (std::size_t g = 0; g < 4; ++g)
            own += weight[g] > 0 ? 0.75 * weight[g] * std::pow(step(first[g], drawn), 2) : 0;
        values.push_back(logit(drawn));
        studentized.push_back((values.back() - value) / std::sqrt(own));
        below += values.back() < value - 1e-9;
    }
    std::sort(values.begin(), values.end());
    std::sort(studentized.begin(), studentized.end());
    EXPECT_NEAR(found.percentile.lower, values[1], 1e-7);
    EXPECT_NEAR(found.percentile.upper, values[37], 1e-7);
    EXPECT_NEAR(found.studentized.lower, value - error * studentized[37], 1e-6);
    EXPECT_NEAR(found.studentized.upper, value - error * studentized[1], 1e-6);
    // Efron's BCa: z0 of the share below, a = sum d^3 / (6 (sum d^2)^(3/2)), the point Phi(z0 + z / (1 - a z))
    const double z0 = normal_quantile((below + 0.5) / 40), a = cube / (6 * std::pow(square, 1.5));
    const auto corrected = [&](double z) {
        const double of_39 = 40 * std::erfc(-(z0 + (z0 + z) / (1 - a * (z0 + z))) / std::numbers::sqrt2) / 2 - 1;
        const double place = std::clamp(of_39, 0.0, 38.0); // beyond the largest there is none
        const auto at = std::min<std::size_t>(static_cast<std::size_t>(place), 37);
        return std::lerp(values[at], values[at + 1], place - static_cast<double>(at));
    };
    EXPECT_NEAR(found.accelerated.lower, corrected(-1.6448536), 1e-6);
    EXPECT_NEAR(found.accelerated.upper, corrected(1.6448536), 1e-6);
    EXPECT_GT(std::abs(a), 0.01);
    EXPECT_GT(std::abs(z0), 0.01);
}

/// The curve reports its targets in their own units: exp of the limits of ln median, 1 / slope, the probability.
TEST(FragilityCurve, LimitsAreThoseOfItsTargets)
{
    Stripe low = first, high = second;
    low.insert(low.end(), {{12, 5}, {18, 6}, {16, 9}, {14, 3}});
    high.insert(high.end(), {{10, 7}, {10, 6}, {10, 9}, {10, 7}});
    const FragilityData data = two_stripes(low, high);
    const FittedCurve fitted = fitted_curve(data, log_predictors(data), Link::probit);
    const FragilityCurve curve = fragility_curve(data, {.level = 0.8, .at = {{1}}});
    const Jackknife without = jackknife(fitted);
    const Limits median = jackknife_limits(fitted, without, CurveTarget::log_median(), 0.8),
                 slope = jackknife_limits(fitted, without, CurveTarget::slope(), 0.8),
                 eta = jackknife_limits(fitted, without, at_first(), 0.8);
    ASSERT_GT(slope.lower, 0);
    EXPECT_NEAR(curve.median.records.lower, std::exp(median.lower), 1e-12);
    EXPECT_NEAR(curve.median.records.upper, std::exp(median.upper), 1e-12);
    EXPECT_NEAR(curve.dispersion.records.lower, 1 / slope.upper, 1e-12);
    EXPECT_NEAR(curve.dispersion.records.upper, 1 / slope.lower, 1e-12);
    EXPECT_NEAR(curve.at[0].probability.records.lower, std::erfc(-eta.lower / std::numbers::sqrt2) / 2, 1e-12);
    EXPECT_NEAR(curve.at[0].probability.records.upper, std::erfc(-eta.upper / std::numbers::sqrt2) / 2, 1e-12);
    // 63 of 160 of the eight records at the first stripe: the curve passes through the share
    EXPECT_NEAR(curve.at[0].probability.value, 63.0 / 160, 1e-9);
}
