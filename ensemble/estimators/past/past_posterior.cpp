#include "ensemble/estimators/past/past_posterior.hpp"

#include <algorithm>
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

} // namespace stylobate
