/// Sobol's indices and Morris' effects of functions whose indices are known in closed form, and how often the
/// intervals hold them.

#include "ensemble/estimators/designs/sobol_indices.hpp"
#include "tests/ensemble/estimators/sensitivity_functions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace stylobate;
using namespace stylobate::testing;

namespace {

TEST(SobolIndices, SharesAreCutToWhatIsPossible)
{
    const double none = std::nan("");
    SobolIndices found{{0.4, 0.3, 0.5}, {1.02, 0.9, 1.1}, {{{-0.05, -0.1, 0.01}, {0.94, 0.85, 1.04}}}, {}, {true}};
    found.of_mean.push_back({{-0.3, -0.4, -0.01}, {0, 0, 0}});
    found.of_mean.push_back({{none, none, none}, {1.2, 1.1, 1.3}});
    const SobolIndices cut = possible_shares(found);
    const auto is = [](const Estimate& e, double value, double lower, double upper) {
        EXPECT_EQ(e.value, value);
        EXPECT_EQ(e.lower, lower);
        EXPECT_EQ(e.upper, upper);
    };
    is(cut.mean, 0.4, 0.3, 0.5);
    is(cut.explained, 1, 0.9, 1);
    is(cut.of_mean[0].first, 0, 0, 0.01);
    is(cut.of_mean[0].total, 0.94, 0.85, 1);
    is(cut.of_mean[1].total, 0, 0, 0);
    for (const Estimate& e : {cut.of_mean[1].first, cut.of_mean[2].first, cut.of_mean[2].total})
        EXPECT_TRUE(std::isnan(e.value) && std::isnan(e.lower) && std::isnan(e.upper));
}

/// Eight rows of two factors, two draws of the rest: y = 3 x1 + (1 + w) x2. The numbers are from exact fractions, with
/// <y z> as the mean of y_i z_j over i != j, written out from the formulas of sobol_indices.hpp outside of this
/// program.
TEST(SobolIndices, OfASmallDesignByHand)
{
    const DesignValues design{8, 2, 2, {18, 15, 6,  4,  9, 6, 15, 13, 15, 11, 15, 11, 15, 11, 15, 11, //
                                        9,  7,  3,  3,  9, 7, 3,  3,  9,  7,  0,  0,  6,  4,  3,  3,  //
                                        9,  9,  12, 15, 6, 6, 15, 18, 6,  12, 11, 15, 12, 18, 5,  9,  //
                                        0,  0,  9,  9,  9, 9, 0,  0,  7,  9,  6,  6,  7,  9,  6,  6}};
    const SobolIndices found = sobol_indices(design, {.resamples = 9});
    EXPECT_NEAR(found.mean.value, 8.375, 1e-12);
    EXPECT_NEAR(found.explained.value, 0.8519315228107914, 1e-12);        // the bias Var(m) = 1.54 of m^2 is removed
    EXPECT_NEAR(found.of_mean[0].first.value, 0.5872836230486206, 1e-12); // 0.577 without the control variate
    EXPECT_NEAR(found.of_mean[0].total.value, 0.6362966859547606, 1e-12);
    EXPECT_NEAR(found.of_mean[1].first.value, 0.574937634951757, 1e-12);
    EXPECT_NEAR(found.of_mean[1].total.value, 0.33582325092056814, 1e-12);
    ASSERT_EQ(found.of_value.size(), 3U);
    EXPECT_NEAR(found.of_value[0].first.value, 0.3973652478617941, 1e-12);
    EXPECT_NEAR(found.of_value[0].total.value, 0.5420812046248992, 1e-12);
    EXPECT_NEAR(found.of_value[1].first.value, 0.6624897584422146, 1e-12);
    EXPECT_NEAR(found.of_value[1].total.value, 0.31872367123778794, 1e-12);
    EXPECT_NEAR(found.of_value[2].first.value, 0.11544321950345075, 1e-12);
    EXPECT_NEAR(found.of_value[2].total.value, 0.14806847718920857, 1e-12);
    // of the mean the jackknife is its standard error: the rows' halves of A and B are 10.75, 13, 5.5, 4, 11.25,
    // 11, 4.5 and 7, with the sum 67 and squares about the mean of 86.5; Student's quantile of seven degrees
    // is 2.364624
    EXPECT_NEAR(found.mean.upper - found.mean.value, 2.364624 * std::sqrt(86.5 / 7 / 8), 1e-5);
    EXPECT_NEAR(found.mean.value - found.mean.lower, 2.364624 * std::sqrt(86.5 / 7 / 8), 1e-5);
}

/// How often intervals hold the truth, one count for each index: first indices, then total ones.
struct Coverage {
    std::vector<int> held;
    std::vector<double> sum; ///< of the estimates
    int designs = 0;

    void add(const std::vector<FactorIndices>& found, const std::vector<double>& first,
             const std::vector<double>& total)
    {
        held.resize(2 * found.size());
        sum.resize(2 * found.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
            held[k] += found[k].first.contains(first[k]);
            held[found.size() + k] += found[k].total.contains(total[k]);
            sum[k] += found[k].first.value;
            sum[found.size() + k] += found[k].total.value;
        }
        ++designs;
    }
    double worst() const { return *std::min_element(held.begin(), held.end()) / double(designs); }
    double mean() const
    {
        double all = 0;
        for (const int h : held)
            all += h;
        return all / static_cast<double>(held.size()) / designs;
    }
    std::string text() const
    {
        std::string text = fmt::format("coverage of {} designs:", designs);
        for (std::size_t i = 0; i < held.size(); ++i)
            text += fmt::format(" {:.3f}", held[i] / double(designs));
        return text;
    }
};

constexpr int designs = 200;

/// @param make a design from a generator
template <class Make>
Coverage cover(const std::vector<double>& first, const std::vector<double>& total, Make make, bool of_value = false)
{
    Coverage coverage;
    std::mt19937_64 random(7);
    for (int i = 0; i < designs; ++i) {
        const SobolIndices found = sobol_indices(make(random), {.resamples = 400, .seed = 1000 + std::uint64_t(i)});
        coverage.add(of_value ? found.of_value : found.of_mean, first, total);
    }
    return coverage;
}

// A share of 0.95 of 200 designs has a deviation of 0.015; over the indices of a function these are dependent.

TEST(SobolIndices, IshigamiIsCovered)
{
    const IshigamiIndices truth;
    EXPECT_NEAR(truth.first[0], 0.3139, 1e-4);
    EXPECT_NEAR(truth.total[2], 0.2437, 1e-4);
    const Coverage c =
        cover(truth.first, truth.total, [](auto& random) { return sobol_design(500, 3, 1, random, ishigami); });
    RecordProperty("coverage", c.text());
    EXPECT_GT(c.mean(), 0.92) << c.text();
    EXPECT_GT(c.worst(), 0.89) << c.text();
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(c.sum[k] / designs, truth.first[k], 0.01);
        EXPECT_NEAR(c.sum[3 + k] / designs, truth.total[k], 0.01);
    }
}

TEST(SobolIndices, GFunctionIsCovered)
{
    const GFunction g{{0, 1, 4.5, 9, 99, 99}};
    std::vector<double> first, total;
    for (std::size_t k = 0; k < g.a.size(); ++k) {
        first.push_back(g.first(k));
        total.push_back(g.total(k));
    }
    EXPECT_NEAR(first[0], 0.716, 1e-3); // Saltelli et al. (2010), table 3
    const Coverage c = cover(first, total, [&](auto& random) { return sobol_design(500, 6, 1, random, g); });
    EXPECT_GT(c.mean(), 0.92) << c.text();
    EXPECT_GT(c.worst(), 0.88) << c.text();
}

/// Of 0 and 1: the indices of the probability, whatever the noise of the rest.
TEST(SobolIndices, ProbabilityIsCoveredUnderTheNoiseOfItsTrials)
{
    for (const bool chaos : {false, true}) {
        const Coverage c = cover(Falls::first(), Falls::total(),
                                 [&](auto& random) { return sobol_design(500, 3, 4, random, Falls{chaos}); });
        EXPECT_GT(c.mean(), 0.92) << c.text();
        EXPECT_GT(c.worst(), 0.88) << c.text();
        // without effect, and told so, where the mean over four trials would have an index of about 0.6
        EXPECT_NEAR(c.sum[5] / designs, 0, 0.02) << c.text();
    }
}

/// What the mean over M trials would say of a factor without effect, if its noise were left in it.
TEST(SobolIndices, NoiseLeftInWouldBeTakenForAnEffect)
{
    std::mt19937_64 random(3);
    DesignValues values = sobol_design(4000, 3, 4, random, Falls{true});
    const SobolIndices right = sobol_indices(values, {});
    DesignValues means{values.rows, 3, 1, {}};
    for (std::size_t i = 0; i < values.value.size(); i += 4)
        means.value.push_back((values.value[i] + values.value[i + 1] + values.value[i + 2] + values.value[i + 3]) / 4);
    const SobolIndices wrong = sobol_indices(means, {});
    EXPECT_TRUE(right.of_mean[2].total.contains(0)) << right.of_mean[2].total.value;
    EXPECT_GT(wrong.of_mean[2].total.lower, 0.3);
}

/// The rest is a factor of the value: of falls by w < p it interacts with all, of chaos every factor with it.
TEST(SobolIndices, ValueHasTheRestAsAFactor)
{
    std::mt19937_64 random(5);
    const SobolIndices found = sobol_indices(sobol_design(20000, 3, 4, random, Falls{}), {});
    const double v = Falls::variance(), all = Falls::variance_of_value();
    ASSERT_EQ(found.of_value.size(), 4U);
    EXPECT_TRUE(found.explained.contains(v / all)) << found.explained.value;
    EXPECT_TRUE(found.mean.contains(Falls::mean()));
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_TRUE(found.of_value[k].first.contains(Falls::first()[k] * v / all)) << k;
    EXPECT_NEAR(found.of_value[3].total.value, 1 - v / all, 0.01);
    // first index of the rest: E[y|w] = P(p > w); its variance by a sum over a fine grid
    std::vector<double> p;
    const int n = 1000;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            p.push_back(Falls::probability({(i + .5) / n, (j + .5) / n}));
    std::sort(p.begin(), p.end());
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
        const double above = static_cast<double>(p.end() - std::upper_bound(p.begin(), p.end(), (i + .5) / n)) /
                             static_cast<double>(p.size());
        sum += above / n;
        squares += above * above / n;
    }
    EXPECT_TRUE(found.of_value[3].first.contains((squares - sum * sum) / all)) << found.of_value[3].first.value;
    EXPECT_EQ(found.acts, (std::vector<bool>{true, true, false}));

    const SobolIndices chaos = sobol_indices(sobol_design(20000, 3, 4, random, Falls{true}), {});
    EXPECT_GT(chaos.of_value[2].total.lower, 0.5) << "it decides single outcomes";
    EXPECT_LT(chaos.of_mean[2].total.upper, 0.05) << "and does not move the probability";
}

TEST(SobolIndices, NothingIsToldWhereNothingVaries)
{
    std::mt19937_64 random(1);
    const SobolIndices same =
        sobol_indices(sobol_design(100, 2, 2, random, [](const Point&, double) { return 1.0; }), {});
    EXPECT_EQ(same.mean.value, 1);
    for (const FactorIndices& factor : same.of_mean)
        for (const Estimate& e : {factor.first, factor.total})
            EXPECT_TRUE(std::isnan(e.value) && std::isnan(e.lower) && std::isnan(e.upper));
    EXPECT_EQ(same.acts, (std::vector<bool>{false, false}));
    // the probability is the same everywhere: its variance is noise about 0, and nothing is told of it
    const SobolIndices coin =
        sobol_indices(sobol_design(300, 2, 2, random, [](const Point&, double w) { return w < 0.5 ? 1.0 : 0.0; }), {});
    EXPECT_TRUE(std::isnan(coin.of_mean[0].total.value));
    EXPECT_TRUE(coin.of_value[2].total.contains(1)) << coin.of_value[2].total.value;
}

/// The indices do not depend on unit or origin.
TEST(SobolIndices, ShiftAndScaleChangeNothing)
{
    std::mt19937_64 one(2), two(2);
    const SobolIndices a = sobol_indices(sobol_design(200, 3, 1, one, ishigami), {});
    const SobolIndices b = sobol_indices(
        sobol_design(200, 3, 1, two, [](const Point& u, double) { return 1e6 + 1e-3 * ishigami(u); }), {});
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(a.of_mean[k].first.value, b.of_mean[k].first.value, 1e-6);
        EXPECT_NEAR(a.of_mean[k].total.lower, b.of_mean[k].total.lower, 1e-6);
    }
}

/// The control is worth its name: of a strong factor as sure as without it or surer, of one without effect 20 times.
TEST(SobolIndices, IsSureOfWhatHasNoEffect)
{
    const GFunction g{{0, 99}};
    std::mt19937_64 random(11);
    const SobolIndices found = sobol_indices(sobol_design(1000, 2, 1, random, g), {});
    EXPECT_LT(found.of_mean[1].first.upper - found.of_mean[1].first.lower, 0.01);
    EXPECT_LT(found.of_mean[0].first.upper - found.of_mean[0].first.lower, 0.08);
}

TEST(SobolIndices, RefusesWhatIsNoDesign)
{
    EXPECT_THROW(sobol_indices({10, 2, 1, std::vector<double>(39)}, {}), std::invalid_argument);
    EXPECT_THROW(elementary_effects({10, 2, 1, std::vector<double>(30)}, std::vector<double>(19), {}),
                 std::invalid_argument);
}

/// Effects (2, 4) and (-2, 0) of two rows with two draws of the rest: means 3 and -1; products of the two draws 8 and
/// 0.
TEST(ElementaryEffects, OfTwoRowsByHand)
{
    const ElementaryEffects found =
        elementary_effects({2, 1, 2, {1, 3, 2, 5, 2, 2, 1, 2}}, {1, 1}, {.resamples = 50})[0];
    EXPECT_NEAR(found.mu.value, 1, 1e-12);
    EXPECT_NEAR(found.mu_star.value, 2, 1e-12);
    EXPECT_NEAR(found.rms.value, 2, 1e-12);
    EXPECT_NEAR(found.sigma.value, std::sqrt(6.0), 1e-12); // (4 - 1) 2 / (2 - 1)
    // against the factor's direction in the second row
    EXPECT_NEAR(elementary_effects({2, 1, 2, {1, 3, 2, 5, 2, 2, 1, 2}}, {1, -1}, {.resamples = 50})[0].mu.value, 2,
                1e-12);
}

/// y = 3 u_1 + 2 u_2^2 + noise, u_3 without effect: e = 3; 2 (2 u + 1/2) of u < 1/2, so mu = 2, sigma^2 = 1/3 and rms^2
/// = 4 + 1/3.
TEST(ElementaryEffects, OfAKnownFunction)
{
    constexpr std::size_t rows = 4000, inner = 3;
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal(0, 1);
    DesignValues values{rows, 3, inner, {}};
    std::vector<double> direction;
    for (std::size_t r = 0; r < rows; ++r) {
        const Point a = {uniform(random), uniform(random), uniform(random)};
        for (std::size_t point = 0; point < 4; ++point) {
            Point u = a;
            if (point > 0) {
                u[point - 1] += u[point - 1] < 0.5 ? 0.5 : -0.5;
                direction.push_back(u[point - 1] > a[point - 1] ? 1 : -1);
            }
            for (std::size_t i = 0; i < inner; ++i)
                values.value.push_back(3 * u[0] + 2 * u[1] * u[1] + normal(random));
        }
    }
    const std::vector<ElementaryEffects> found = elementary_effects(values, direction, {});
    EXPECT_TRUE(found[0].mu.contains(3)) << found[0].mu.value;
    EXPECT_TRUE(found[0].rms.contains(3));
    EXPECT_LT(found[0].sigma.lower, 0.3) << "it is linear";
    EXPECT_TRUE(found[1].mu.contains(2)) << found[1].mu.value;
    EXPECT_TRUE(found[1].sigma.contains(std::sqrt(1.0 / 3))) << found[1].sigma.value;
    EXPECT_TRUE(found[1].rms.contains(std::sqrt(4 + 1.0 / 3)));
    EXPECT_LT(found[2].rms.lower, 0.05) << "no effect";
    EXPECT_GT(found[2].mu_star.lower, 1) << "but noise in mu_star: sqrt(8 / 3) sqrt(2 / pi) = 1.3";
    EXPECT_TRUE(found[2].mu.contains(0));

    for (std::size_t i = 0; i < direction.size(); i += 3)
        direction[i] = std::numeric_limits<double>::quiet_NaN();
    const std::vector<ElementaryEffects> vector = elementary_effects(values, direction, {});
    EXPECT_TRUE(std::isnan(vector[0].mu.value) && std::isnan(vector[0].sigma.value));
    EXPECT_EQ(vector[0].mu_star.value, found[0].mu_star.value);
}

} // namespace
