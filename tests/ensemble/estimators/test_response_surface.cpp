/// The response surface of a search: its parts.

#include "ensemble/estimators/search/response_surface.hpp"
#include "ensemble/estimators/search/search_answer.hpp"
#include "tests/ensemble/estimators/search_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace stylobate {
namespace {

TEST(PairedNoise, IsTheCovarianceOfShares)
{
    // 4 realizations, 2 points: reached by (1, 1), (1, 0), (0, 0), (0, 0)
    const PairedNoise noise = paired_noise({1, 1, 1, 0, 0, 0, 0, 0}, {1, 1, 1, 1}, {0, 0, 0, 0}, 2);
    EXPECT_EQ(noise.share, (std::vector<double>{0.5, 0.25}));
    // 4/3 (1/4 sum of products - product of means) / 4
    EXPECT_NEAR(noise.covariance[1], 4.0 / 3 * (0.25 - 0.125) / 4, 1e-12);
    EXPECT_NEAR(noise.covariance[0], 4.0 / 3 * 0.25 / 4 + 0.5 / 16, 1e-12);
    // in two strata that are all or nothing there is no error but half a count
    const PairedNoise strata = paired_noise({1, 1, 1, 1, 0, 0, 0, 0}, {1, 1, 1, 1}, {0, 0, 1, 1}, 2);
    EXPECT_NEAR(strata.covariance[1], 0, 1e-12);
    EXPECT_NEAR(strata.covariance[3], 0.5 / 16, 1e-12);
}

/// Of so many realizations that the covariance is known.
PairedNoise known_noise(std::vector<double> share, std::vector<double> covariance)
{
    PairedNoise noise;
    noise.freedom.assign(share.size(), std::numeric_limits<double>::infinity());
    noise.share = std::move(share);
    noise.covariance = std::move(covariance);
    noise.groups = 1e9;
    noise.half = 1e-18;
    return noise;
}

TEST(ResponseSurface, GoesThroughPointsWithoutNoise)
{
    const std::vector<SearchPlace> points = {{0}, {0.25}, {0.5}, {0.75}, {1}};
    PairedNoise noise = known_noise({0.6, 0.35, 0.2, 0.3, 0.55}, std::vector<double>(25));
    for (std::size_t i = 0; i < 5; ++i)
        noise.covariance[i * 6] = 1e-8;
    const ResponseSurface surface(points, noise);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(surface.at(points[i]).mean, noise.share[i], 1e-3);
        EXPECT_LT(surface.at(points[i]).sd, 2e-3);
    }
    EXPECT_GT(surface.at({0.375}).sd, surface.at({0.25}).sd);
    EXPECT_NEAR(surface.difference({0.25}, {0.5}).mean, 0.15, 1e-3);
    const SearchAnswer answer = search_answer(surface, candidate_places(1), 0.95);
    EXPECT_NEAR(answer.best[0], 0.55, 0.1);
    EXPECT_LE(answer.from[0], answer.best[0]);
    EXPECT_GE(answer.to[0], answer.best[0]);
}

double matern(double distance, double length)
{
    const double a = std::sqrt(5.0) * distance / length;
    return (1 + a + a * a / 3) * std::exp(-a);
}

/// Two points without noise, where a process with a flat mean has closed forms: with the correlation r of the points
/// and the correlations p +- q of a place with them
///
///   mean = y0 + q (y2 - y1) / (1 - r),   variance = s2 (own - 2 p2 / (1 + r) - 2 q2 / (1 - r) + (one - 2 p / (1 +
///   r))^2 (1 + r) / 2)
///
/// own = one = 1; of a difference of two places own = 2 (1 - their correlation), one = 0, p and q differences. A model
/// has the weight exp(-(rest2 + ln det K + ln(1' K^-1 1)) / 2); those below a thousandth of all are left out.
TEST(ResponseSurface, OfTwoPointsByHand)
{
    PairedNoise noise = known_noise({0.3, 0.5}, {1e-14, 0, 0, 1e-14});
    const ResponseSurface surface({{0}, {1}}, noise);
    struct Model {
        double weight, s2, length, r;
    };
    std::vector<Model> models;
    double all = 0;
    for (const double length : {0.1, 0.15, 0.25, 0.4, 0.7, 1.2, 2.0})
        for (const double times : {0.35, 0.7, 1.4, 2.8}) {
            const double s2 = times * times * 0.02, r = matern(1, length); // spread: (0.1^2 + 0.1^2) / (2 - 1)
            const double rest = 2 * 0.01 / (s2 * (1 - r)), det = s2 * s2 * (1 - r * r), ones = 2 / (s2 * (1 + r));
            models.push_back({std::exp(-0.5 * (rest + std::log(det) + std::log(ones))), s2, length, r});
            all += models.back().weight;
        }
    double kept = 0;
    for (Model& model : models) {
        model.weight = model.weight < 1e-3 * all ? 0 : model.weight;
        kept += model.weight;
    }
    // of a place, or of its difference from another one
    const auto by_hand = [&](double x, const double* from) {
        double mean = 0, square = 0;
        for (const Model& m : models) {
            const auto k = [&](double at) {
                return matern(std::abs(x - at), m.length) - (from ? matern(std::abs(*from - at), m.length) : 0);
            };
            const double p = (k(0) + k(1)) / 2, q = (k(1) - k(0)) / 2, one = from ? 0 : 1;
            const double own = from ? 2 * (1 - matern(std::abs(x - *from), m.length)) : 1;
            const double value = one * 0.4 + 0.2 * q / (1 - m.r);
            const double variance = m.s2 * (own - 2 * p * p / (1 + m.r) - 2 * q * q / (1 - m.r) +
                                            std::pow(one - 2 * p / (1 + m.r), 2) * (1 + m.r) / 2);
            mean += m.weight / kept * value;
            square += m.weight / kept * (value * value + variance);
        }
        return ResponseSurface::Value{mean, std::sqrt(square - mean * mean)};
    };
    const auto expect = [](const ResponseSurface::Value& found, const ResponseSurface::Value& want) {
        EXPECT_NEAR(found.mean, want.mean, 1e-6);
        EXPECT_NEAR(found.sd, want.sd, 1e-6);
    };
    for (const double x : {0.5, 0.25, 0.9})
        expect(surface.at({x}), by_hand(x, nullptr));
    const double from = 0.6;
    expect(surface.difference({0.2}, {from}), by_hand(0.2, &from));
}

/// An error that all points have in common cancels in differences.
TEST(ResponseSurface, CommonErrorsCancelInDifferences)
{
    const std::vector<SearchPlace> points = {{0}, {0.5}, {1}};
    PairedNoise common = known_noise({0.4, 0.3, 0.4}, std::vector<double>(9, 1e-3));
    PairedNoise own = known_noise(common.share, std::vector<double>(9));
    for (std::size_t i = 0; i < 3; ++i) {
        common.covariance[i * 4] += 1e-6;
        own.covariance[i * 4] = 1e-3;
    }
    EXPECT_LT(ResponseSurface(points, common).difference({0}, {0.5}).sd,
              0.2 * ResponseSurface(points, own).difference({0}, {0.5}).sd);
}

TEST(ResponseSurface, FirstPlacesFillTheCube)
{
    for (const std::size_t d : {1, 2, 3})
        for (const SearchPlace& place : first_places(d))
            for (const double x : place) {
                EXPECT_GE(x, 0);
                EXPECT_LE(x, 1);
            }
    EXPECT_EQ(first_places(3).size(), 12U);
    EXPECT_EQ(candidate_places(2).size(), 1681U);
}

/// Draws have the means and deviations that the surface states, of values and of differences.
TEST(ResponseSurface, DrawsAreThoseOfTheSurface)
{
    const KnownFunction f = known_functions(2).front();
    CommonRealizations realizations(300, 0, true, 3);
    const std::vector<SearchPlace> points = first_places(2);
    for (const SearchPlace& place : points)
        realizations.add(f.p(place), place);
    const ResponseSurface surface(points, realizations.noise());
    const std::vector<SearchPlace> places = {{0.1, 0.2}, {0.15, 0.2}, {0.9, 0.4}};
    constexpr std::size_t number = 20000;
    const auto draws = surface.draws(places, number, 5);
    ASSERT_EQ(draws.size(), number);
    const auto expect = [&](const ResponseSurface::Value& want, auto&& of) {
        double mean = 0, square = 0;
        for (const auto& draw : draws) {
            mean += of(draw) / number;
            square += of(draw) * of(draw) / number;
        }
        EXPECT_NEAR(mean, want.mean, 5 * want.sd / std::sqrt(number));
        EXPECT_NEAR(std::sqrt(square - mean * mean), want.sd, 0.03 * want.sd);
    };
    for (std::size_t i = 0; i < places.size(); ++i)
        expect(surface.at(places[i]), [&](const auto& draw) { return draw[i]; });
    expect(surface.difference(places[0], places[1]), [](const auto& draw) { return draw[0] - draw[1]; });
    expect(surface.difference(places[2], places[1]), [](const auto& draw) { return draw[2] - draw[1]; });
}

/// Of one realization by itself at p = 0.5 all is known: v = y (1 - y) / n, and half a count.
TEST(PairedNoise, SmoothedFollowsTheSurface)
{
    std::vector<double> reached(400 * 2), size(400, 1);
    for (std::size_t r = 0; r < 400; ++r) {
        reached[2 * r] = r % 10 == 0;    // 0.1
        reached[2 * r + 1] = r % 2 == 0; // 0.5
    }
    const PairedNoise noise = paired_noise(reached, size, std::vector<std::size_t>(400), 2);
    const PairedNoise same = smoothed_noise(noise, noise.share);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(same.covariance[i], noise.covariance[i], 0.02 * noise.covariance[3]);
    const PairedNoise other = smoothed_noise(noise, {0.2, 0.5});
    EXPECT_NEAR(other.covariance[0], 0.2 * 0.8 / 400, 0.02 * 0.16 / 400);
    // twenty motions of one design effect: few groups lend each other's
    std::vector<double> motions(20 * 2);
    for (std::size_t g = 0; g < 20; ++g) {
        motions[2 * g] = g < 4 ? 20 : 0; // all or nothing
        motions[2 * g + 1] = 10;         // no scatter at all, by chance
    }
    const PairedNoise few = paired_noise(motions, std::vector<double>(20, 20), std::vector<std::size_t>(20), 2);
    EXPECT_DOUBLE_EQ(few.freedom[0], 3);
    EXPECT_DOUBLE_EQ(few.freedom[1], 19);
    EXPECT_GT(smoothed_noise(few, few.share).covariance[3], 10 * few.covariance[3]);
    EXPECT_TRUE(std::isinf(noise.freedom[0]));
}

/// Three points, seven groups: the prior of 3 x 3 groups has the weight 9 / (6 + 9).
TEST(PairedNoise, SmoothedByHand)
{
    PairedNoise noise;
    noise.share = {0.2, 0.5, 0.9};
    noise.covariance = {0.010, 0.005, 0.001, 0.005, 0.010, -0.001, 0.001, -0.001, 0.0025};
    noise.groups = 7;
    const double weight = 6.0 / 15;
    // v / (y (1 - y)) of each, and of all: 0.0225 / (0.16 + 0.25 + 0.09); correlations 0.5, 0.2, -0.2: mean 1/6
    const double ratio[] = {weight * 0.010 / 0.16 + (1 - weight) * 0.045, weight * 0.010 / 0.25 + (1 - weight) * 0.045,
                            weight * 0.0025 / 0.09 + (1 - weight) * 0.045};
    const double mean[] = {0.3, 0.5, 0.8}, found[3][3] = {{1, 0.5, 0.2}, {0.5, 1, -0.2}, {0.2, -0.2, 1}};
    const PairedNoise smooth = smoothed_noise(noise, {0.3, 0.5, 0.8});
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const auto sd = [&](std::size_t k) { return std::sqrt(ratio[k] * mean[k] * (1 - mean[k])); };
            const double correlation = i == j ? 1 : weight * found[i][j] + (1 - weight) / 6;
            EXPECT_NEAR(smooth.covariance[3 * i + j], sd(i) * sd(j) * correlation, 1e-12) << i << j;
        }
}

/// On the scale of ln(p / (1 - p)): of 0.2 -+ 0.05 with the quantile q from odds of 1/4 to exp(-+ q 0.05 / 0.16) of
/// them.
TEST(PairedNoise, LimitsOfMeansByHand)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    const auto expect = [](const MeanLimits& found, double q_sd) {
        const double reach = std::exp(q_sd / 0.16);
        EXPECT_NEAR(found.lower, 0.25 / reach / (1 + 0.25 / reach), 1e-7);
        EXPECT_NEAR(found.upper, 0.25 * reach / (1 + 0.25 * reach), 1e-7);
    };
    expect(mean_limits(0.2, 0.05, 1, none, 20, 0.95), 1.9599640 * 0.05);
    expect(mean_limits(0.2, 0.05, 1, 9, 20, 0.95), 2.2621572 * 0.05); // Student's of nine degrees of freedom
    // of few degrees half a group is added to the variance, 0.5 / 20^2
    expect(mean_limits(0.2, 0.05, 1, 6, 20, 0.95), 1.9599640 * std::sqrt(0.0025 + 0.5 / 400));
    EXPECT_EQ(mean_limits(0.02, 0.05, 1, none, 20, 0.95).lower, 0);
    EXPECT_EQ(mean_limits(0.98, 0.05, 1, none, 20, 0.95).upper, 1);
}

/// The expected improvement of a place is the mean of max(0, p(best point) - p(place)) by quadrature.
TEST(ResponseSurface, NextPlaceHasTheLargestExpectedImprovement)
{
    const std::vector<SearchPlace> points = {{0}, {0.5}, {1}};
    PairedNoise noise = known_noise({0.4, 0.3, 0.35}, std::vector<double>(9));
    for (std::size_t i = 0; i < 3; ++i)
        noise.covariance[i * 4] = 4e-4;
    const ResponseSurface surface(points, noise);
    const std::vector<SearchPlace> candidates = {{0.25}, {0.5}, {0.6}, {0.75}, {0.9}};
    double most = 0, at = 0;
    for (const SearchPlace& place : candidates) {
        if (place == points[1])
            continue;
        const ResponseSurface::Value d = surface.difference(place, points[1]);
        double improvement = 0;
        for (int i = -8000; i < 8000; ++i) {
            const double z = (i + 0.5) / 1000;
            improvement += std::max(0.0, -(d.mean + z * d.sd)) * std::exp(-z * z / 2) / std::sqrt(2 * M_PI) / 1000;
        }
        if (improvement > most) {
            most = improvement;
            at = place[0];
        }
    }
    const NextPlace next = next_place(surface, candidates);
    EXPECT_EQ(next.place[0], at);
    EXPECT_NEAR(next.improvement / most, 1, 1e-5);
}

/// From the joint draws over the candidates, of which there are few enough that all take part.
TEST(ResponseSurface, AnswerIsThatOfTheDraws)
{
    const std::vector<SearchPlace> points = {{0}, {0.5}, {1}};
    PairedNoise noise = known_noise({0.4, 0.3, 0.35}, std::vector<double>(9));
    for (std::size_t i = 0; i < 3; ++i)
        noise.covariance[i * 4] = 4e-4;
    const ResponseSurface surface(points, noise);
    const std::vector<SearchPlace> candidates = {{0.3}, {0.5}, {0.6}, {0.7}, {0.8}, {1}};
    const SearchAnswer answer = search_answer(surface, candidates, 0.9);
    std::size_t best = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        best = surface.at(candidates[i]).mean < surface.at(candidates[best]).mean ? i : best;
    ASSERT_EQ(answer.best, candidates[best]);
    std::vector<double> excess, of_draws;
    for (const SearchPlace& place : candidates) {
        const ResponseSurface::Value d = surface.difference(place, candidates[best]);
        excess.push_back(place == candidates[best] ? 0 : d.mean / d.sd);
        ASSERT_LT(excess.back(), 4);
    }
    double regret = 0;
    for (const std::vector<double>& draw : surface.draws(candidates, 1000, 1)) {
        const auto least = static_cast<std::size_t>(std::min_element(draw.begin(), draw.end()) - draw.begin());
        of_draws.push_back(excess[least]);
        regret += (draw[best] - draw[least]) / 1000;
    }
    std::sort(of_draws.begin(), of_draws.end());
    const double critical = std::min(of_draws[899], 1.6448536); // the smallest that holds 900 of 1000
    EXPECT_NEAR(answer.critical, critical, 1e-6);
    std::vector<SearchPlace> flat;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (excess[i] <= critical)
            flat.push_back(candidates[i]);
    EXPECT_EQ(answer.flat, flat);
    const ResponseSurface::Value at = surface.at(candidates[best]);
    const MeanLimits limits =
        mean_limits(at.mean, at.sd, 1, std::numeric_limits<double>::infinity(), noise.groups, 0.9);
    EXPECT_NEAR(answer.lower, limits.lower, 1e-12);
    EXPECT_NEAR(answer.upper, limits.upper + regret, 1e-12);
    EXPECT_GT(regret, 1e-3);
    // half of the mean spacing of the candidates, 0.7 / 5 / 2, on each side
    EXPECT_NEAR(answer.from[0], std::max(0.0, flat.front()[0] - 0.07), 1e-12);
    EXPECT_NEAR(answer.to[0], std::min(1.0, flat.back()[0] + 0.07), 1e-12);
}

/// Against exact limits (Clopper & Pearson) of counts of 300: 5 % of 0.05 to 0.95, which those of a normal
/// approximation do not hold at small counts.
TEST(PairedNoise, LimitsOfMeansHoldAtSmallCounts)
{
    for (const double p : {0.004, 0.01, 0.03, 0.1, 0.3, 0.5}) {
        double covered = 0, term = std::pow(1 - p, 300);
        for (int count = 0; count <= 300; ++count) {
            const double share = count / 300.0, v = share * (1 - share) / 300 + 0.5 / (300.0 * 300);
            const MeanLimits limits =
                mean_limits(share, std::sqrt(v), 1, std::numeric_limits<double>::infinity(), 300, 0.95);
            covered += limits.lower <= p && p <= limits.upper ? term : 0;
            term *= (300.0 - count) / (count + 1) * p / (1 - p);
        }
        EXPECT_GE(covered, 0.93) << p;
        EXPECT_LE(covered, 0.9999) << p;
    }
    // of another unit
    const MeanLimits one = mean_limits(0.1, 0.02, 1, 30, 40, 0.95), two = mean_limits(0.2, 0.04, 2, 30, 40, 0.95);
    EXPECT_NEAR(two.lower, 2 * one.lower, 1e-12);
    EXPECT_NEAR(two.upper, 2 * one.upper, 1e-12);
    EXPECT_EQ(mean_limits(0, 0, 1, 30, 40, 0.95).upper, 0);
}

/// A unit changes nothing but the unit.
TEST(ResponseSurface, DoesNotDependOnTheUnit)
{
    const KnownFunction f = known_functions(1).front();
    CommonRealizations realizations(300, 20, false, 3);
    const std::vector<SearchPlace> points = first_places(1);
    for (const SearchPlace& place : points)
        realizations.add(f.p(place), place);
    PairedNoise noise = realizations.noise();
    const std::vector<SearchPlace> candidates = candidate_places(1);
    const SearchAnswer one = search_answer(ResponseSurface(points, noise), candidates, 0.95);
    constexpr double unit = 1e-4;
    for (double& share : noise.share)
        share *= unit;
    for (double& v : noise.covariance)
        v *= unit * unit;
    noise.most *= unit;
    noise.half *= unit * unit;
    const SearchAnswer other = search_answer(ResponseSurface(points, noise), candidates, 0.95);
    EXPECT_EQ(one.best, other.best);
    EXPECT_EQ(one.flat, other.flat);
    EXPECT_NEAR(other.value, unit * one.value, 1e-9 * unit);
    EXPECT_NEAR(other.upper, unit * one.upper, 1e-9 * unit);
}

} // namespace
} // namespace stylobate
