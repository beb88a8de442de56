/// The past of a structure: exclusions and posteriors against closed forms and quadrature by independent code;
/// intervals on simulated counts; simulated monuments of a process whose likelihood is known.

#include "ensemble/estimators/past/exclusion.hpp"
#include "ensemble/estimators/past/hazard_update.hpp"
#include "ensemble/estimators/past/past_posterior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

using namespace stylobate;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<double> log_axis(double from, double to, std::size_t n)
{
    std::vector<double> axis;
    for (std::size_t i = 0; i < n; ++i)
        axis.push_back(from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(n - 1)));
    return axis;
}

/// The probability of collapse of a known structure: logistic in ln a.
struct Logistic {
    double median = 4, s = 0.2;
    double collapse(double a) const { return 1 / (1 + std::exp(-std::log(a / median) / s)); }
};

/// Counts so large that they are the probabilities.
template <class Probability>
std::vector<CellCount> exact_counts(const PastAxes& axes, const Probability& p)
{
    constexpr double n = 4e9;
    std::vector<CellCount> counts;
    for (std::size_t c = 0; c < axes.cells(); ++c) {
        const std::size_t ni = axes.intensity.size();
        const double probability =
            p(c / axes.cells_of_one() + 1, axes.frequency_hz[c % axes.cells_of_one() / ni], axes.intensity[c % ni]);
        counts.push_back({n, std::round(probability * n)});
    }
    return counts;
}

/// The rate k0 a^-k, by two of its points.
HazardCurve power_hazard(double k0, double k)
{
    const std::vector<double> intensity = {1, 10}, rate = {k0, k0 * std::pow(10, -k)};
    return HazardCurve(intensity, rate);
}

PriorDensity flat()
{
    return [](double) { return 1.0; };
}

/// With Wilks' part as threshold.
Exclusion excluded(const PastLikelihood& likelihood, std::size_t events, const PriorDensity& prior,
                   std::optional<std::size_t> frequency = {})
{
    return exclusion(likelihood, events, prior, 0.95, asymptotic_thresholds(likelihood.axes, 0.95), frequency);
}

/// Simpson's rule, by itself.
template <class F>
double simpson(const F& f, double from, double to, int n = 20000)
{
    const double h = (to - from) / n;
    double sum = f(from) + f(to);
    for (int i = 1; i < n; ++i)
        sum += f(from + i * h) * (i % 2 == 1 ? 4 : 2);
    return sum * h / 3;
}

} // namespace

TEST(Past, ALogisticStructureExcludesWhatTheClosedFormsSay)
{
    const Logistic truth;
    const PastAxes axes{{1.0}, log_axis(0.5, 20, 400), 1};
    const PastLikelihood likelihood = past_likelihood(
        axes, exact_counts(axes, [&](auto, auto, double a) { return 1 - truth.collapse(a); }), 1, PastUse::means);
    const Exclusion e = excluded(likelihood, 1, flat());
    ASSERT_TRUE(e.excludes() && e.surely());
    // by the ratio: 1 / (1 + (a / m)^(1/s)) = t L(0.5), t = exp(-1.959964^2 / 2)
    const double t = std::exp(-1.959963984540054 * 1.959963984540054 / 2);
    EXPECT_NEAR(e.rule.part.front(), t, 1e-12);
    EXPECT_NEAR(e.rule.part.front(), 0.1465, 5e-5);
    const double limit = t * (1 - truth.collapse(0.5));
    EXPECT_NEAR(e.by_likelihood.value, truth.median * std::pow(1 / limit - 1, truth.s), 1e-3);
    EXPECT_EQ(e.weaker.value, 0) << "weak shaking leaves it standing";
    // with a flat prior: the integral of 1 - collapse over x = ln(a / m) is x - s ln(1 + e^(x / s))
    const auto mass = [&](double a) {
        const double x = std::log(a / truth.median);
        return x - truth.s * std::log1p(std::exp(x / truth.s));
    };
    const double wanted = mass(0.5) + 0.95 * (mass(20) - mass(0.5));
    EXPECT_NEAR(mass(e.by_posterior.value), wanted, 1e-4);
    EXPECT_NEAR(e.by_prior, 0.5 * std::pow(40, 0.95), 1e-9);
    EXPECT_LT(e.by_posterior.upper - e.by_posterior.lower, 1e-3);
}

TEST(Past, AnotherPriorMovesThePosteriorAsQuadratureSays)
{
    const Logistic truth;
    const PastAxes axes{{1.0}, log_axis(0.5, 20, 400), 1};
    const PastLikelihood likelihood = past_likelihood(
        axes, exact_counts(axes, [&](auto, auto, double a) { return 1 - truth.collapse(a); }), 1, PastUse::means);
    const HazardCurve rates = power_hazard(0.02, 2.3);
    const auto posterior_mass = [&](double upto, const auto& density) {
        return simpson([&](double x) { return (1 - truth.collapse(std::exp(x))) * density(std::exp(x)); },
                       std::log(0.5), std::log(upto));
    };
    const auto uniform = [](double a) { return a; };
    const auto by_rates = [&](double a) { return rates.density(std::log(a)); };
    for (const PriorDensity& prior : {PriorDensity(uniform), PriorDensity(by_rates)}) {
        const Exclusion e = excluded(likelihood, 1, prior);
        EXPECT_NEAR(posterior_mass(e.by_posterior.value, prior) / posterior_mass(20, prior), 0.95, 2e-5);
    }
    EXPECT_NEAR(rates.density(std::log(3)), 2.3 * 0.02 * std::pow(3, -2.3), 1e-15);
}

TEST(Past, NothingIsExcludedWhereTheLikelihoodHasNotFallen)
{
    const PastAxes axes{{1.0, 2.0}, log_axis(1, 10, 8), 1};
    const PastLikelihood flat_one = past_likelihood(axes, std::vector<CellCount>(16, {64, 60}), 1, PastUse::means);
    const Exclusion none = excluded(flat_one, 1, flat());
    EXPECT_FALSE(none.excludes());
    EXPECT_EQ(none.by_likelihood.value, infinite);
    EXPECT_EQ(none.drawn_with_limit, 0U);
    EXPECT_NEAR(none.top_ratio.value, 1, 1e-12);
    EXPECT_GT(none.top_ratio.lower, none.rule.part.front());
    // a state that three in sixty-four reach: what a count of 0 excludes is not sure
    std::vector<CellCount> few(16, {64, 0});
    few[1] = few[9] = {64, 3};
    const Exclusion weak = excluded(past_likelihood(axes, few, 1, PastUse::means), 1, flat());
    EXPECT_TRUE(weak.excludes());
    EXPECT_FALSE(weak.surely());
    EXPECT_EQ(weak.by_likelihood.upper, infinite);
}

TEST(Past, TheDrawsOfACellAreJeffreysPosterior)
{
    const PastAxes axes{{1.0}, {1, 2, 3, 4}, 1};
    const std::vector<CellCount> counts = {{64, 0}, {64, 64}, {64, 10}, {0, 0}};
    const PastLikelihood likelihood = past_likelihood(axes, counts, 7, PastUse::cells);
    for (std::size_t c = 0; c < counts.size(); ++c) {
        const double a = counts[c].successes + 0.5, b = counts[c].trials - counts[c].successes + 0.5;
        double mean = 0, square = 0;
        for (const std::vector<double>& draw : likelihood.drawn) {
            mean += draw[c] / past_draws;
            square += draw[c] * draw[c] / past_draws;
        }
        EXPECT_NEAR(mean, a / (a + b), 2e-3 * a / (a + b) + 1e-4) << c;
        const double variance = a * b / ((a + b) * (a + b) * (a + b + 1));
        EXPECT_NEAR(square - mean * mean, variance, 0.02 * variance) << c;
    }
    // other draws for another index, the same for the same
    EXPECT_EQ(likelihood.drawn, past_likelihood(axes, counts, 7, PastUse::cells).drawn);
    EXPECT_NE(likelihood.drawn, past_likelihood(axes, counts, 7, PastUse::cells, 100).drawn);
}

/// 3 of 10 with the prior count c = 1 / (2 x 2) of a mean over two frequencies: 3.25 / 10.5; of rates the share itself.
TEST(Past, TheValueOfACellIsTheMeanOfItsPosterior)
{
    const PastAxes axes{{1, 2}, {1}, 1};
    const std::vector<CellCount> counts = {{10, 3}, {0, 0}};
    EXPECT_EQ(past_likelihood(axes, counts, 1, PastUse::means).value, (std::vector<double>{3.25 / 10.5, 0.5}));
    EXPECT_EQ(past_likelihood(axes, counts, 1, PastUse::cells).value, (std::vector<double>{3.5 / 11, 0.5}));
    EXPECT_EQ(past_likelihood(axes, counts, 1, PastUse::rates).value[0], 0.3);
    // over ln f of 1, 2 and 8 Hz: halves of a third and of two thirds of the whole
    const std::vector<double> weights = frequency_weights({1, 2, 8});
    for (const auto& [found, want] : {std::pair{weights[0], 1.0 / 6}, {weights[1], 0.5}, {weights[2], 1.0 / 3}})
        EXPECT_NEAR(found, want, 1e-15);
}

/// 1001 draws 0, 1, ..., 1000. Half of them below the value: 2.5 and 97.5 %, that is draws 25 (floor of 25.025) and
/// 975. 691.5 of 1002 below it: z0 = 0.49619, and Phi(2 z0 -+ 1.959964) of 1001 are 166.8 and 999.4. At 900.5 z0 = 1.28
/// is limited to 0.5: 168.7 and 999.5; at the least draw to -0.5: 1.5 and 832.3. The interval holds the value.
TEST(Past, IntervalsAreCorrectedPercentilesByHand)
{
    PastLikelihood likelihood{{{1}, {1}, 1}, {500}, {}};
    for (int b = 0; b <= 1000; ++b)
        likelihood.drawn.push_back({static_cast<double>((b * 8) % 1001)}); // in any order
    const auto estimate = [&](double value) {
        likelihood.value = {value};
        return past_estimate(likelihood, [](auto cells) { return cells[0]; });
    };
    for (const auto& [value, lower, upper] :
         {std::array{500.0, 25.0, 975.0}, {690.5, 166.0, 999.0}, {900.5, 168.0, 999.0}, {0.0, 0.0, 832.0}}) {
        EXPECT_EQ(estimate(value).value, value);
        EXPECT_EQ(estimate(value).lower, lower) << value;
        EXPECT_EQ(estimate(value).upper, upper) << value;
    }
}

TEST(Past, TheRatesOfAHazardCurveAreUpdatedAsQuadratureSays)
{
    const Logistic truth;
    const PastAxes axes{{1.0}, log_axis(0.5, 60, 600), 1};
    const PastLikelihood collapse = past_likelihood(
        axes, exact_counts(axes, [&](auto, auto, double a) { return truth.collapse(a); }), 1, PastUse::rates);
    const double k0 = 0.05, k = 2.5, years = 2400, sigma = 1.0;
    const HazardUpdate update = hazard_update(collapse, power_hazard(k0, k), years, sigma, 0.95);
    // over a itself, not its logarithm
    const double rate =
        simpson([&](double a) { return truth.collapse(a) * k0 * k * std::pow(a, -k - 1); }, 0.5, 60, 200000) +
        truth.collapse(60) * k0 * std::pow(60, -k);
    EXPECT_NEAR(update.collapse_rate.value, rate, 1e-4 * rate);
    EXPECT_NEAR(update.stands.value, std::exp(-rate * years), 1e-3 * std::exp(-rate * years));
    // over c itself
    const auto density = [&](double c) {
        return c <= 0 ? 0.0 : std::exp(-std::log(c) * std::log(c) / (2 * sigma * sigma) - c * rate * years) / c;
    };
    const double whole = simpson(density, 0, 10, 400000);
    for (const auto& [quantile, p] : {std::pair{update.factor_lower, 0.025}, std::pair{update.factor_median, 0.5},
                                      std::pair{update.factor_upper, 0.975}})
        EXPECT_NEAR(simpson(density, 0, quantile.value, 400000) / whole, p, 1e-4);
    EXPECT_NEAR(update.prior_upper, std::exp(1.959964), 1e-5);
    // without exposure the posterior is the prior
    EXPECT_NEAR(factor_quantile(0, 0.7, 0.975), std::exp(0.7 * 1.959963984540054), 1e-4);
    EXPECT_EQ(update.beyond_hazard.upper, 0) << "a power law has no range";
    // of a curve whose points are within the axis, and of one whose last point is beyond its end
    for (const auto& [from, to] : {std::pair{2.0, 20.0}, std::pair{1.0, 100.0}}) {
        double known = simpson([&](double a) { return truth.collapse(a) * k0 * k * std::pow(a, -k - 1); }, from,
                               std::min(to, 60.0), 200000);
        if (to > 60)
            known += truth.collapse(60) * k0 * (std::pow(60, -k) - std::pow(to, -k));
        const HazardUpdate cut =
            hazard_update(collapse, power_hazard(k0, k), years, sigma, 0.95, IntensityRange{from, to});
        EXPECT_NEAR(cut.beyond_hazard.value, 1 - known / rate, 3e-3);
        EXPECT_EQ(cut.collapse_rate.value, update.collapse_rate.value);
    }
    // beyond the axis
    EXPECT_NEAR(update.beyond.value, truth.collapse(60) * k0 * std::pow(60, -k) / rate, 1e-5);
}

TEST(Past, ThePosteriorFindsThePastThatMadeTheState)
{
    // the likelihood is a normal bump at 2 events, 2 Hz, 4 m/s2
    const PastAxes axes{{1, 2, 4}, log_axis(1, 16, 9), 3};
    const auto bump = [](std::size_t events, double f, double a) {
        const double e = static_cast<double>(events) - 2, x = std::log(f / 2), y = std::log(a / 4);
        return 0.8 * std::exp(-2 * e * e - 4 * x * x - 8 * y * y);
    };
    const PastLikelihood likelihood = past_likelihood(axes, exact_counts(axes, bump), 1, PastUse::means);
    const PastPosterior p = past_posterior(likelihood, flat(), 0.95);
    EXPECT_EQ(p.best, axes.cells_of_one() + axes.intensity.size() + 4);
    // the mean over a fine grid of the same piecewise linear function
    double mean = 0, cells = 0;
    const std::vector<double> f_weights = frequency_weights(axes.frequency_hz);
    for (std::size_t events = 1; events <= 3; ++events)
        for (std::size_t k = 0; k < 3; ++k)
            for (int i = 0; i < 8000; ++i) {
                const double at = (i + 0.5) / 1000;
                const auto below = static_cast<std::size_t>(at);
                const double t = at - static_cast<double>(below), f = axes.frequency_hz[k];
                mean += f_weights[k] * std::lerp(bump(events, f, axes.intensity[below]),
                                                 bump(events, f, axes.intensity[below + 1]), t);
                cells += f_weights[k];
            }
    EXPECT_NEAR(p.evidence.value, mean / cells, 1e-6);
    EXPECT_LT(p.evidence.lower, p.evidence.upper);
    // a state that is left by shaking about 4 m/s2 excludes what is weaker as what is stronger
    const Exclusion e = excluded(likelihood, 2, flat());
    EXPECT_NEAR(e.weaker.value * e.by_likelihood.value, 16, 1e-3);
    EXPECT_GT(e.weaker.value, 1);
    EXPECT_LT(e.weaker.value, 4);
    double sum = 0;
    for (const double each : p.cells)
        sum += each;
    EXPECT_NEAR(sum, 1, 1e-12);
    // over the number of events alone
    const double one = std::exp(-2.0), two = 1;
    EXPECT_NEAR(p.events[1].value, two / (two + 2 * one), 1e-6);
    EXPECT_NEAR(p.events[0].value, p.events[2].value, 1e-6);
    EXPECT_NEAR(p.intensity_median.value, 4, 1e-3);
    EXPECT_NEAR(std::log(p.intensity_upper.value / 4), std::log(4 / p.intensity_lower.value), 1e-3);
    const std::vector<double> prior = past_prior(axes, flat());
    EXPECT_NEAR(std::accumulate(prior.begin(), prior.end(), 0.0), 1, 1e-12);
}

TEST(PastStatistics, TheIntervalOfAnExclusionContainsTheTruthLong)
{
    // counts of 48 in each cell of six frequencies by twelve intensities, 200 times
    const Logistic truth{4, 0.35};
    const PastAxes axes{{1, 1.5, 2, 3, 4, 6}, log_axis(0.8, 16, 12), 1};
    const auto stands = [&](auto, double f, double a) { return 1 - truth.collapse(a / std::pow(f, 0.2)); };
    const Exclusion exact = excluded(past_likelihood(axes, exact_counts(axes, stands), 1, PastUse::means), 1, flat());
    std::mt19937_64 random(20261125);
    int by_likelihood = 0, by_posterior = 0, one_likelihood = 0, one_posterior = 0;
    const auto contains = [](const PastEstimate& e, double truth) { return e.lower <= truth && truth <= e.upper; };
    const Exclusion of_one =
        excluded(past_likelihood(axes, exact_counts(axes, stands), 1, PastUse::cells), 1, flat(), 2);
    constexpr int repeats = 200;
    for (int r = 0; r < repeats; ++r) {
        std::vector<CellCount> counts;
        for (const double f : axes.frequency_hz)
            for (const double a : axes.intensity)
                counts.push_back(
                    {48, static_cast<double>(std::binomial_distribution<int>(48, stands(1, f, a))(random))});
        const Exclusion e =
            excluded(past_likelihood(axes, counts, static_cast<std::uint64_t>(r), PastUse::means), 1, flat());
        by_likelihood += contains(e.by_likelihood, exact.by_likelihood.value);
        by_posterior += contains(e.by_posterior, exact.by_posterior.value);
        const Exclusion one =
            excluded(past_likelihood(axes, counts, static_cast<std::uint64_t>(r), PastUse::cells), 1, flat(), 2);
        one_likelihood += contains(one.by_likelihood, of_one.by_likelihood.value);
        one_posterior += contains(one.by_posterior, of_one.by_posterior.value);
    }
    RecordProperty("by_likelihood", by_likelihood);
    RecordProperty("by_posterior", by_posterior);
    // 95 % of 200 are 190; 180 or fewer come by chance in 1 of 400 runs
    EXPECT_GE(by_likelihood, 181);
    EXPECT_GE(by_posterior, 181);
    // of a single frequency
    RecordProperty("one_likelihood", one_likelihood);
    RecordProperty("one_posterior", one_posterior);
    EXPECT_GE(one_likelihood, 181);
    EXPECT_GE(one_posterior, 181);
}

namespace {

/// A structure whose offset is c a^1.5 n^0.7, times e^(0.5 N), and that falls by a logistic in ln a.
struct Toy {
    PastAxes axes{{1, 2, 4}, log_axis(1, 10, 10), 3};
    std::vector<double> trials;
    StandingStates standing;
    MeasuredState measured{{0}, {0.004}, false};

    explicit Toy(std::uint64_t seed, int n = 150, std::size_t events = 3)
    {
        axes.events = events;
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> uniform;
        const Logistic falls{6, 0.25};
        for (std::size_t c = 0; c < axes.cells(); ++c) {
            trials.push_back(n);
            const double a = axes.intensity[c % 10], f = axes.frequency_hz[c % 30 / 10];
            for (int k = 0; k < n; ++k) {
                if (uniform(random) < falls.collapse(a / std::sqrt(f)))
                    continue;
                standing.cell.push_back(c);
                standing.value.push_back(0.002 * std::pow(a / f, 1.5) *
                                         std::pow(static_cast<double>(c / 30) + 1.0, 0.7) *
                                         std::exp(0.5 * normal(random)));
            }
        }
    }
};

} // namespace

TEST(PastStatistics, CredibleIntervalsCoverTwoHundredMonumentsAtTheirLevel)
{
    const Toy toy(5);
    const MonumentTest test =
        test_monuments(toy.axes, toy.trials, toy.standing, AgreeingStates(toy.standing, toy.measured), toy.measured,
                       past_prior(toy.axes, flat()), 200, 9);
    ASSERT_GE(test.intensity.size(), 198U);
    for (const std::vector<double>* u : {&test.intensity, &test.frequency, &test.events}) {
        const auto n = static_cast<double>(u->size());
        // 95 %: at least 178 of 200 in all but 1 of 500 runs; 50 %: 78 to 122 in all but 1 of 500
        EXPECT_GE(static_cast<double>(MonumentTest::inside(*u, 0.95)), 0.89 * n);
        EXPECT_NEAR(static_cast<double>(MonumentTest::inside(*u, 0.5)), 0.5 * n, 22);
        double mean = 0;
        for (const double each : *u)
            mean += each / n;
        EXPECT_NEAR(mean, 0.5, 3.1 / std::sqrt(12 * n));
    }
}

/// Of four monuments two lie within the middle 95 %, from 0.025 to 0.975.
TEST(Past, MonumentsInsideAreCounted)
{
    EXPECT_EQ(MonumentTest::inside({0.02, 0.03, 0.97, 0.98}, 0.95), 2U);
    EXPECT_EQ(MonumentTest::inside({0.24, 0.26, 0.5, 0.76}, 0.5), 2U);
}

TEST(PastStatistics, TheTestFindsAPriorThatIsWrong)
{
    // monuments of which strong pasts are as frequent as weak ones, judged by a prior that expects weak ones
    const Toy toy(5);
    const auto places = [&](const PriorDensity& of_monuments, const PriorDensity& believed) {
        const std::vector<double> truth = past_prior(toy.axes, of_monuments), prior = past_prior(toy.axes, believed);
        const StandingStates& states = toy.standing;
        double mean = 0, count = 0;
        std::mt19937_64 random(3);
        std::vector<double> weight;
        for (const std::size_t cell : states.cell)
            weight.push_back(truth[cell]);
        std::discrete_distribution<std::size_t> choose(weight.begin(), weight.end());
        for (int m = 0; m < 200; ++m) {
            const std::size_t itself = choose(random);
            const MeasuredState seen{{states.value[itself]}, {0.004}, false};
            double below = 0, here = 0, all = 0;
            for (std::size_t r = 0; r < states.cell.size(); ++r) {
                if (r == itself || !distance(seen, std::span(states.value).subspan(r, 1)).agrees())
                    continue;
                const double p = prior[states.cell[r]];
                all += p;
                below += states.cell[r] % 10 < states.cell[itself] % 10 ? p : 0;
                here += states.cell[r] % 10 == states.cell[itself] % 10 ? p : 0;
            }
            mean += all > 0 ? (below + here / 2) / all : 0;
            count += all > 0;
        }
        return mean / count;
    };
    const auto weak = [](double a) { return std::pow(a, -2.5); };
    EXPECT_NEAR(places(flat(), flat()), 0.5, 3.1 / std::sqrt(12 * 200.0));
    EXPECT_GT(places(flat(), weak), 0.5 + 3.1 / std::sqrt(12 * 200.0));
}

namespace {

/// The likelihood of a state over the intensities, by the realizations of a study of one event: the mean over three
/// frequencies with the weights of a density that is flat in their logarithm, by itself.
std::vector<double> likelihood_of(const Toy& toy, double seen)
{
    std::vector<double> count(30, 0), curve(10, 0);
    for (std::size_t r = 0; r < toy.standing.cell.size(); ++r)
        count[toy.standing.cell[r]] += std::fabs(toy.standing.value[r] - seen) <= 0.004;
    constexpr std::array weight{0.25, 0.5, 0.25}; // of 1, 2, 4 Hz
    constexpr double c = 1.0 / 6;                 // 1 / (2 nf)
    for (std::size_t cell = 0; cell < 30; ++cell)
        curve[cell % 10] += weight[cell / 10] * (count[cell] + c) / (toy.trials[cell] + 2 * c);
    return curve;
}

} // namespace

/// Monuments of another study, at four true intensities, are judged by the thresholds and realizations of the first
/// one. With 1000 realizations in a cell and 1000 monuments the share that is excluded wrongly is 5 % with a standard
/// deviation of 1 %: 0.7 % each of what calibrates and of what is tested.
TEST(PastStatistics, ACalibratedThresholdExcludesTheTruthAsOftenAsItsLevelLeaves)
{
    const Toy toy(5, 1000, 1), other(6, 1000, 1);
    const AgreeingStates agreeing(toy.standing, toy.measured);
    const RatioThresholds found =
        ratio_thresholds(toy.axes, toy.trials, toy.standing, agreeing, toy.measured, 1, 1000, 0.95, 3);
    ASSERT_TRUE(found.mean.calibrated);
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> error(-0.004, 0.004);
    constexpr std::array weight{0.25, 0.5, 0.25};
    double asymptotic_worst = 0;
    for (const std::size_t i : {std::size_t{2}, std::size_t{4}, std::size_t{6}, std::size_t{8}}) {
        std::vector<std::size_t> rows;
        std::vector<double> chance;
        for (std::size_t r = 0; r < other.standing.cell.size(); ++r)
            if (other.standing.cell[r] % 10 == i) {
                rows.push_back(r);
                chance.push_back(weight[other.standing.cell[r] / 10]);
            }
        ASSERT_GT(rows.size(), 300U);
        std::discrete_distribution<std::size_t> choose(chance.begin(), chance.end());
        constexpr int monuments = 1000;
        int wrong = 0, asymptotic = 0;
        for (int m = 0; m < monuments; ++m) {
            const std::vector<double> curve =
                likelihood_of(toy, other.standing.value[rows[choose(random)]] + error(random));
            const double ratio = curve[i] / *std::max_element(curve.begin(), curve.end());
            wrong += ratio < found.mean.part[i];
            asymptotic += ratio < 0.1465;
        }
        // as often as the level leaves where Wilks' part would exclude it more often, and less often elsewhere
        EXPECT_LE(wrong, (0.05 + 3.5 * 0.01) * monuments) << toy.axes.intensity[i];
        if (found.mean.part[i] < 0.1465) {
            EXPECT_GE(wrong, (0.05 - 3.5 * 0.01) * monuments) << toy.axes.intensity[i];
        }
        EXPECT_LE(static_cast<double>(found.coverage[i].excluded), 85) << toy.axes.intensity[i];
        asymptotic_worst = std::max(asymptotic_worst, asymptotic / static_cast<double>(monuments));
    }
    EXPECT_GT(asymptotic_worst, 0.06) << "the toy has an intensity at which Wilks' part excludes the truth too often";
}

TEST(Past, ThresholdsOfFewMonumentsAreWilks)
{
    const Toy toy(5);
    const AgreeingStates agreeing(toy.standing, toy.measured);
    const RatioThresholds found =
        ratio_thresholds(toy.axes, toy.trials, toy.standing, agreeing, toy.measured, 1, 18, 0.95, 3);
    EXPECT_FALSE(found.mean.calibrated) << "no place of 18 leaves 5 %";
    EXPECT_NEAR(found.mean.part.front(), 0.1465, 5e-5);
    // of 19 the smallest is the place
    EXPECT_TRUE(
        ratio_thresholds(toy.axes, toy.trials, toy.standing, agreeing, toy.measured, 1, 19, 0.95, 3).mean.calibrated);
}

/// That it stands has the probability 1 - collapse: where that is 5 %, ln(a / m) = s ln 19.
TEST(Past, AStructureOfWhichOnlyItsStandingIsKnownExcludesWhereFewStand)
{
    const Logistic truth;
    const PastAxes axes{{1.0}, log_axis(0.5, 20, 400), 1};
    const PastLikelihood likelihood = past_likelihood(
        axes, exact_counts(axes, [&](auto, auto, double a) { return 1 - truth.collapse(a); }), 1, PastUse::means);
    const Exclusion e = exclusion(likelihood, 1, flat(), 0.95, standing_thresholds(axes, 0.95));
    EXPECT_NEAR(e.by_likelihood.value, truth.median * std::pow(19, truth.s), 1e-3);
}

/// A likelihood exp(-4 ln(f / 2)^2 - 8 ln(a / 4)^2): its largest value over the frequencies is the second factor, at 2
/// Hz.
TEST(Past, TheProfileLikelihoodNeedsNoPriorOverTheFrequency)
{
    const PastAxes axes{{0.5, 1, 2, 4, 8}, log_axis(1, 16, 400), 1};
    const auto bump = [](auto, double f, double a) {
        const double x = std::log(f / 2), y = std::log(a / 4);
        return 0.8 * std::exp(-4 * x * x - 8 * y * y);
    };
    const Exclusion e = excluded(past_likelihood(axes, exact_counts(axes, bump), 1, PastUse::means), 1, flat());
    const double y = std::sqrt(1.959963984540054 * 1.959963984540054 / 2 / 8);
    EXPECT_NEAR(std::log(e.by_profile.value / 4), y, 1e-4);
    EXPECT_NEAR(std::log(e.by_likelihood.value / 4), y, 1e-4) << "the factors separate";
    EXPECT_NEAR(e.highest_frequency.value, std::exp(-4 * std::log(4) * std::log(4)), 1e-6);
    EXPECT_FALSE(e.open_below());
    EXPECT_FALSE(e.open_above());
}

/// The same on an axis that ends where the likelihood is largest.
TEST(Past, AnAxisThatEndsBeforeTheLikelihoodFallsIsOpen)
{
    const PastAxes axes{{0.5, 1, 2}, log_axis(1, 16, 30), 1};
    const auto bump = [](auto, double f, double a) {
        const double x = std::log(f / 2), y = std::log(a / 4);
        return 0.8 * std::exp(-4 * x * x - 8 * y * y);
    };
    const Exclusion e = excluded(past_likelihood(axes, exact_counts(axes, bump), 1, PastUse::means), 1, flat());
    EXPECT_FALSE(e.open_below());
    EXPECT_TRUE(e.open_above());
    EXPECT_NEAR(e.highest_frequency.value, 1, 1e-12);
}

/// With structures that fall independently given nothing, all_stand of m is P^(m - 1), and one that stands of N built
/// says less than one that was chosen before.
TEST(Past, AStructureThatIsAskedBecauseItStandsSaysLessOfTheRates)
{
    const Logistic truth;
    const PastAxes axes{{1.0}, log_axis(0.5, 60, 60), 1};
    const PastLikelihood collapse = past_likelihood(
        axes, exact_counts(axes, [&](auto, auto, double a) { return truth.collapse(a); }), 1, PastUse::rates);
    // p is 0 or 1 given the motion: they fall together
    AlikeStructures one_of_two{2, 1, std::vector<double>(2 * axes.intensity.size(), 1)};
    const HazardUpdate together =
        hazard_update(collapse, power_hazard(0.05, 2.5), 1000, 1, 0.95, {}, {2, 2, one_of_two.all_stand});
    EXPECT_NEAR(together.alike_median.value, together.factor_median.value, 1e-9) << "two that fall together are one";
    for (std::size_t i = 0; i < axes.intensity.size(); ++i)
        one_of_two.all_stand[2 * i + 1] = 1 - truth.collapse(axes.intensity[i]);
    const HazardUpdate alone = hazard_update(collapse, power_hazard(0.05, 2.5), 1000, 1, 0.95, {}, one_of_two);
    EXPECT_GT(alone.alike_median.value, alone.factor_median.value);
    // by quadrature over c itself
    const auto rate = [&](int m) {
        return simpson(
                   [&](double a) { return (1 - std::pow(1 - truth.collapse(a), m)) * 0.05 * 2.5 * std::pow(a, -3.5); },
                   0.5, 60, 200000) +
               0.05 * std::pow(60, -2.5);
    };
    const double l1 = 1000 * rate(1), l2 = 1000 * rate(2);
    const auto density = [&](double c) {
        return c <= 0 ? 0.0 : std::exp(-std::log(c) * std::log(c) / 2) / c * (std::exp(-c * l1) - std::exp(-c * l2));
    };
    EXPECT_NEAR(simpson(density, 0, alone.alike_median.value, 100000) / simpson(density, 0, 30, 400000), 0.5, 3e-3);
}
