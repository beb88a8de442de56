/// The response surface of a search: its parts.

#include "ensemble/estimators/search/response_surface.hpp"
#include "ensemble/estimators/search/search_answer.hpp"
#include "tests/ensemble/estimators/search_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
