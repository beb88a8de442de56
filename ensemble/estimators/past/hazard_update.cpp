#include "ensemble/estimators/past/hazard_update.hpp"

#include "ensemble/numerics/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stylobate {

double factor_quantile(double exposure, double sigma_ln, double p)
{
    constexpr int points = 4001;
    constexpr double reach = 8;
    const double step = 2 * reach / (points - 1);
    std::vector<double> sum(points, 0);
    double before = 0;
    for (int i = 0; i < points; ++i) {
        const double z = -reach + step * i; // of ln c, in standard deviations
        const double density = std::exp(-z * z / 2 - exposure * std::exp(sigma_ln * z));
        const auto at = static_cast<std::size_t>(i);
        if (i > 0)
            sum[at] = sum[at - 1] + 0.5 * step * (before + density);
        before = density;
    }
    const double wanted = p * sum.back();
    std::size_t i = 1;
    while (i + 1 < sum.size() && sum[i] < wanted)
        ++i;
    const double within = (wanted - sum[i - 1]) / (sum[i] - sum[i - 1]);
    return std::exp(sigma_ln * (-reach + step * (static_cast<double>(i) - 1 + within)));
}

HazardUpdate hazard_update(const PastLikelihood& collapse, const HazardCurve& rates, double years, double sigma_ln,
                           double level, const std::optional<IntensityRange>& points)
{
    const PastAxes& axes = collapse.axes;
    const std::vector<double> weights = frequency_weights(axes.frequency_hz);
    const IntensityIntegral integral(axes.intensity, [&](double a) { return rates.density(std::log(a)); });
    const double above = rates.frequency(std::log(axes.intensity.back()));
    const auto fragility = [&](std::span<const double> cells) {
        return over_frequencies(cells.subspan(0, axes.cells_of_one()), weights);
    };
    const auto rate = [&](std::span<const double> cells) {
        const std::vector<double> p = fragility(cells);
        return integral.total(p) + p.back() * above;
    };
    HazardUpdate update;
    update.collapse_rate = past_estimate(collapse, rate);
    update.stands = past_estimate(collapse, [&](auto cells) { return std::exp(-rate(cells) * years); });
    update.beyond = past_estimate(collapse, [&](auto cells) {
        const double all = rate(cells);
        return all > 0 ? fragility(cells).back() * above / all : 0.0;
    });
    if (points) {
        const double end = axes.intensity.back();
        const IntensityIntegral known(axes.intensity, [&](double a) {
            return a >= points->from && a <= points->to ? rates.density(std::log(a)) : 0.0;
        });
        const double known_above = std::max(
            rates.frequency(std::log(std::max(end, points->from))) - rates.frequency(std::log(points->to)), 0.0);
        update.beyond_hazard = past_estimate(collapse, [&](auto cells) {
            const std::vector<double> p = fragility(cells);
            const double all = rate(cells);
            return all > 0 ? std::clamp(1 - (known.total(p) + p.back() * known_above) / all, 0.0, 1.0) : 0.0;
        });
    }
    update.at_begin = past_estimate(collapse, [&](auto cells) { return fragility(cells).front(); });
    const auto quantile = [&](double p) {
        return past_estimate(collapse, [&](auto cells) { return factor_quantile(rate(cells) * years, sigma_ln, p); });
    };
    update.factor_median = quantile(0.5);
    update.factor_lower = quantile((1 - level) / 2);
    update.factor_upper = quantile((1 + level) / 2);
    const double z = normal_quantile((1 + level) / 2);
    update.prior_lower = std::exp(-sigma_ln * z);
    update.prior_upper = std::exp(sigma_ln * z);
    return update;
}

} // namespace stylobate
