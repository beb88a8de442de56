/// The response surface of a search: known functions with binomial noise.

#include "ensemble/estimators/search/response_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace stylobate {
namespace {

/// Realizations that are the same at all points: half of what decides is common.
class Realizations {
public:
    Realizations(std::size_t number, double common, std::uint64_t seed) : random_(seed), common_(common)
    {
        std::normal_distribution<double> normal;
        for (std::size_t r = 0; r < number; ++r)
            level_.push_back(normal(random_));
    }
    /// One point more.
    void add(double p)
    {
        std::normal_distribution<double> normal;
        std::vector<char> column;
        for (const double level : level_) {
            const double z = std::sqrt(common_) * level + std::sqrt(1 - common_) * normal(random_);
            column.push_back(0.5 * std::erfc(-z / std::sqrt(2.0)) < p);
        }
        reached_.push_back(std::move(column));
    }
    PairedNoise noise() const
    {
        const std::size_t n = level_.size(), m = reached_.size();
        std::vector<double> reached(n * m), size(n, 1);
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t i = 0; i < m; ++i)
                reached[r * m + i] = reached_[i][r];
        return paired_noise(reached, size, std::vector<std::size_t>(n), m);
    }

private:
    std::mt19937_64 random_;
    double common_;
    std::vector<double> level_;
    std::vector<std::vector<char>> reached_;
};

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

TEST(ResponseSurface, GoesThroughPointsWithoutNoise)
{
    const std::vector<SearchPlace> points = {{0}, {0.25}, {0.5}, {0.75}, {1}};
    PairedNoise noise{{0.6, 0.35, 0.2, 0.3, 0.55}, std::vector<double>(25)};
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
}

/// An error that all points have in common cancels in differences.
TEST(ResponseSurface, CommonErrorsCancelInDifferences)
{
    const std::vector<SearchPlace> points = {{0}, {0.5}, {1}};
    PairedNoise common{{0.4, 0.3, 0.4}, std::vector<double>(9, 1e-3)}, own{common.share, std::vector<double>(9)};
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

struct Repeats {
    double place = 0, value = 0, excess = 0;
};
/// Searches of a known function: how often the range that is not shown to be worse holds the optimum, how often the
/// interval holds the probability at the answer, and how much larger that is than the least one.
Repeats searches(std::size_t d, const std::function<double(const SearchPlace&)>& p, const SearchPlace& optimum,
                 std::size_t points, int repeats)
{
    Repeats found;
    std::vector<SearchPlace> candidates = candidate_places(d);
    if (d == 2) // every other row and column: a fourth of the time
        std::erase_if(candidates, [](const SearchPlace& place) {
            return std::llround(40 * place[0]) % 2 != 0 || std::llround(40 * place[1]) % 2 != 0;
        });
    for (int repeat = 0; repeat < repeats; ++repeat) {
        Realizations realizations(300, 0.5, static_cast<std::uint64_t>(repeat) + 1);
        std::vector<SearchPlace> places = first_places(d);
        for (const SearchPlace& place : places)
            realizations.add(p(place));
        while (places.size() < points) {
            const NextPlace next = next_place(ResponseSurface(places, realizations.noise()), candidates, places);
            if (next.place.empty())
                break;
            places.push_back(next.place);
            realizations.add(p(next.place));
        }
        const ResponseSurface surface(places, realizations.noise());
        const SearchAnswer answer = search_answer(surface, candidates, 0.95);
        bool inside = true;
        for (std::size_t k = 0; k < d; ++k) {
            double from = 1, to = 0;
            for (const SearchPlace& place : answer.flat) {
                from = std::min(from, place[k]);
                to = std::max(to, place[k]);
            }
            inside = inside && from <= optimum[k] && optimum[k] <= to;
        }
        found.place += inside / static_cast<double>(repeats);
        found.value +=
            (std::abs(p(answer.best) - answer.value.mean) <= 1.96 * answer.value.sd) / static_cast<double>(repeats);
        found.excess += (p(answer.best) - p(optimum)) / repeats;
    }
    return found;
}

TEST(ResponseSurfaceStatistics, FindsTheOptimumOfOneNumber)
{
    const auto p = [](const SearchPlace& x) { return 0.15 + 1.2 * (x[0] - 0.37) * (x[0] - 0.37); };
    const Repeats found = searches(1, p, {0.37}, 12, 200);
    EXPECT_GE(found.place, 0.93);
    EXPECT_GE(found.value, 0.91);
    EXPECT_LT(found.excess, 0.01);
}

TEST(ResponseSurfaceStatistics, FindsTheOptimumOfTwoNumbers)
{
    const auto p = [](const SearchPlace& x) {
        return 0.1 + 0.8 * (x[0] - 0.6) * (x[0] - 0.6) + 0.5 * (x[1] - 0.3) * (x[1] - 0.3);
    };
    const Repeats found = searches(2, p, {0.6, 0.3}, 16, 30);
    EXPECT_GE(found.place, 0.9);
    EXPECT_GE(found.value, 0.85);
    EXPECT_LT(found.excess, 0.03);
}

} // namespace
} // namespace stylobate
