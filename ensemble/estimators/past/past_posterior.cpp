#include "ensemble/estimators/past/past_posterior.hpp"

#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace stylobate {

std::vector<double> past_prior(const PastAxes& axes, const PriorDensity& prior)
{
    const std::vector<double> over_f = frequency_weights(axes.frequency_hz);
    const std::vector<double> over_i = IntensityIntegral(axes.intensity, prior).weights();
    const double whole = std::accumulate(over_i.begin(), over_i.end(), 0.0) * static_cast<double>(axes.events);
    std::vector<double> mass;
    for (std::size_t e = 0; e < axes.events; ++e)
        for (const double f : over_f)
            for (const double i : over_i)
                mass.push_back(f * i / whole);
    return mass;
}

PastPosterior past_posterior(const PastLikelihood& likelihood, const PriorDensity& prior, double level)
{
    const PastAxes& axes = likelihood.axes;
    const std::vector<double> mass = past_prior(axes, prior);
    const std::size_t ni = axes.intensity.size(), of_one = axes.cells_of_one();
    const auto share = [&](std::span<const double> cells, const auto& belongs) {
        double all = 0, in = 0;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const double p = mass[c] * cells[c];
            all += p;
            in += belongs(c) ? p : 0;
        }
        return in / all;
    };
    PastPosterior result;
    result.evidence = past_estimate(likelihood, [&](std::span<const double> cells) {
        return std::inner_product(cells.begin(), cells.end(), mass.begin(), 0.0);
    });
    for (std::size_t e = 0; e < axes.events; ++e)
        result.events.push_back(past_estimate(
            likelihood, [&](auto cells) { return share(cells, [&](std::size_t c) { return c / of_one == e; }); }));
    for (std::size_t f = 0; f < axes.frequency_hz.size(); ++f)
        result.frequency.push_back(past_estimate(
            likelihood, [&](auto cells) { return share(cells, [&](std::size_t c) { return c % of_one / ni == f; }); }));
    const IntensityIntegral integral(axes.intensity, prior);
    const std::vector<double> weights = frequency_weights(axes.frequency_hz);
    const auto quantile = [&](double p) {
        return past_estimate(likelihood, [&](std::span<const double> cells) {
            std::vector<double> curve(ni, 0);
            for (std::size_t e = 0; e < axes.events; ++e) {
                const std::vector<double> one = over_frequencies(cells.subspan(e * of_one, of_one), weights);
                std::transform(curve.begin(), curve.end(), one.begin(), curve.begin(), std::plus<>());
            }
            return integral.quantile(curve, p);
        });
    };
    result.intensity_median = quantile(0.5);
    result.intensity_lower = quantile((1 - level) / 2);
    result.intensity_upper = quantile((1 + level) / 2);
    double all = 0;
    for (std::size_t c = 0; c < mass.size(); ++c) {
        result.cells.push_back(mass[c] * likelihood.value[c]);
        all += result.cells.back();
    }
    for (double& p : result.cells)
        p /= all;
    result.best =
        static_cast<std::size_t>(std::max_element(result.cells.begin(), result.cells.end()) - result.cells.begin());
    result.best_probability = past_estimate(
        likelihood, [&](auto cells) { return share(cells, [&](std::size_t c) { return c == result.best; }); });
    return result;
}

namespace {

constexpr std::size_t parts = 64; // of a piece between two values of the axis

} // namespace

IntensityIntegral::IntensityIntegral(const std::vector<double>& intensity, const PriorDensity& prior)
    : weights_(intensity.size(), 0)
{
    assert(intensity.size() >= 2 && "an axis of one value has no integral");
    for (const double value : intensity)
        log_intensity_.push_back(std::log(value));
    for (std::size_t i = 0; i + 1 < intensity.size(); ++i)
        for (std::size_t k = 0; k < parts; ++k)
            prior_.push_back(prior(std::exp(std::lerp(log_intensity_[i], log_intensity_[i + 1],
                                                      static_cast<double>(k) / static_cast<double>(parts)))));
    prior_.push_back(prior(intensity.back()));
    std::vector<double> one(intensity.size(), 0);
    for (std::size_t i = 0; i < intensity.size(); ++i) {
        one[i] = 1;
        weights_[i] = total(one);
        one[i] = 0;
    }
}

double IntensityIntegral::total(std::span<const double> likelihood) const
{
    double sum = 0;
    for (std::size_t i = 0; i + 1 < log_intensity_.size(); ++i) {
        const double width = (log_intensity_[i + 1] - log_intensity_[i]) / static_cast<double>(parts);
        if (likelihood[i] == 0 && likelihood[i + 1] == 0)
            continue;
        for (std::size_t k = 0; k <= parts; ++k) {
            const double at = std::lerp(likelihood[i], likelihood[i + 1], static_cast<double>(k) / parts);
            sum += (k == 0 || k == parts ? 0.5 : 1.0) * width * at * prior_[i * parts + k];
        }
    }
    return sum;
}

double IntensityIntegral::quantile(std::span<const double> likelihood, double p) const
{
    const double wanted = p * total(likelihood);
    if (!(wanted > 0))
        return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (std::size_t i = 0; i + 1 < log_intensity_.size(); ++i) {
        const double width = (log_intensity_[i + 1] - log_intensity_[i]) / static_cast<double>(parts);
        for (std::size_t k = 0; k < parts; ++k) {
            const auto at = [&](std::size_t part) {
                return std::lerp(likelihood[i], likelihood[i + 1], static_cast<double>(part) / parts) *
                       prior_[i * parts + part];
            };
            const double more = 0.5 * width * (at(k) + at(k + 1));
            if (sum + more >= wanted && more > 0)
                return std::exp(log_intensity_[i] + width * (static_cast<double>(k) + (wanted - sum) / more));
            sum += more;
        }
    }
    return std::exp(log_intensity_.back());
}

double likelihood_limit(const std::vector<double>& intensity, std::span<const double> likelihood,
                        std::span<const double> threshold)
{
    const auto above = [&](std::size_t i) { return likelihood[i] - threshold[i]; };
    std::size_t i = intensity.size() - 1;
    if (!(above(i) < 0))
        return std::numeric_limits<double>::infinity();
    while (i > 0 && above(i - 1) < 0)
        --i;
    if (i == 0)
        return intensity.front();
    const double t = above(i - 1) / (above(i - 1) - above(i));
    return intensity[i - 1] * std::pow(intensity[i] / intensity[i - 1], t);
}

std::vector<double> frequency_weights(const std::vector<double>& frequency_hz)
{
    const std::size_t n = frequency_hz.size();
    if (n == 1)
        return {1.0};
    const double whole = std::log(frequency_hz.back() / frequency_hz.front());
    std::vector<double> weights(n, 0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double half = 0.5 * std::log(frequency_hz[i + 1] / frequency_hz[i]) / whole;
        weights[i] += half;
        weights[i + 1] += half;
    }
    return weights;
}

std::vector<double> over_frequencies(std::span<const double> cells, std::span<const double> weights)
{
    const std::size_t ni = cells.size() / weights.size();
    std::vector<double> mean(ni, 0);
    for (std::size_t f = 0; f < weights.size(); ++f)
        for (std::size_t i = 0; i < ni; ++i)
            mean[i] += weights[f] * cells[f * ni + i];
    return mean;
}

std::vector<double> largest_over_frequencies(std::span<const double> cells, std::size_t intensities)
{
    std::vector<double> most(intensities, 0);
    for (std::size_t c = 0; c < cells.size(); ++c)
        most[c % intensities] = std::max(most[c % intensities], cells[c]);
    return most;
}

namespace {

/// The place in ascending sums at which a part u of the last one is reached.
std::size_t chosen(const std::vector<double>& sums, double u)
{
    const auto at = std::upper_bound(sums.begin(), sums.end(), u * sums.back());
    return std::min(static_cast<std::size_t>(at - sums.begin()), sums.size() - 1);
}

/// u of a coordinate of the true cell.
template <class Coordinate>
double place_of(const std::vector<double>& posterior, const Coordinate& coordinate, std::size_t truth, double within)
{
    double below = 0, here = 0, all = 0;
    for (std::size_t c = 0; c < posterior.size(); ++c) {
        all += posterior[c];
        below += coordinate(c) < coordinate(truth) ? posterior[c] : 0;
        here += coordinate(c) == coordinate(truth) ? posterior[c] : 0;
    }
    return (below + within * here) / all;
}

} // namespace

std::size_t MonumentTest::inside(const std::vector<double>& u, double level)
{
    return static_cast<std::size_t>(
        std::count_if(u.begin(), u.end(), [&](double each) { return std::fabs(each - 0.5) <= level / 2; }));
}

MonumentTest test_monuments(const PastAxes& axes, const std::vector<double>& trials, const StandingStates& standing,
                            const AgreeingStates& agreeing, const MeasuredState& measured,
                            std::span<const double> prior, std::size_t monuments, std::uint64_t seed)
{
    MonumentTest test;
    const std::size_t ni = axes.intensity.size(), of_one = axes.cells_of_one();
    if (standing.cell.empty())
        return test;
    const double count = prior_count(axes, PastUse::means);
    // a realization that stands has the prior of its cell over the trials of its cell
    std::vector<double> sums;
    for (const std::size_t cell : standing.cell)
        sums.push_back((sums.empty() ? 0 : sums.back()) + prior[cell] / trials[cell]);
    for (std::size_t m = 0; m < monuments; ++m) {
        const auto draw = [&](std::uint64_t element) { return uniform01(seed, m, Stream::monument, element); };
        const std::size_t itself = chosen(sums, draw(0));
        const std::size_t truth = standing.cell[itself];
        std::vector<double> seen;
        for (std::size_t k = 0; k < measured.tolerance.size(); ++k)
            seen.push_back(standing.state(itself)[k] + measured.tolerance[k] * (2 * draw(4 + k) - 1));
        std::vector<double> posterior(axes.cells(), 0);
        bool judged = false;
        agreeing.each(seen, [&](std::size_t r) {
            posterior[standing.cell[r]] += r == itself ? 0 : 1;
            judged = judged || r != itself;
        });
        for (std::size_t c = 0; c < posterior.size(); ++c)
            posterior[c] = prior[c] * (posterior[c] + count) / (trials[c] - (c == truth ? 1 : 0) + 2 * count);
        if (!judged) {
            ++test.not_judged;
            continue;
        }
        test.intensity.push_back(place_of(
            posterior, [&](std::size_t c) { return c % ni; }, truth, draw(1)));
        test.frequency.push_back(place_of(
            posterior, [&](std::size_t c) { return c % of_one / ni; }, truth, draw(2)));
        test.events.push_back(place_of(
            posterior, [&](std::size_t c) { return c / of_one; }, truth, draw(3)));
    }
    return test;
}

} // namespace stylobate
