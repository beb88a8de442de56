#include "ensemble/estimators/past/hazard_update.hpp"

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stylobate {

double factor_quantile(double exposure, double sigma_ln, double p)
{
    return factor_quantile([exposure](double c) { return std::exp(-exposure * c); }, sigma_ln, p);
}

double alike_likelihood(std::span<const double> exposure, std::uint64_t standing, double c)
{
    const std::size_t built = exposure.size();
    double sum = 0, term = 1; // (-1)^j C(N - n, j)
    for (std::size_t m = standing; m <= built; ++m) {
        sum += term * std::exp(-c * exposure[m - 1]);
        const auto j = static_cast<double>(m - standing), left = static_cast<double>(built - m);
        term *= -left / (j + 1);
    }
    return std::max(sum, 0.0); // rounding of the alternating sum
}

double factor_quantile(const std::function<double(double c)>& likelihood, double sigma_ln, double p)
{
    constexpr int points = 4001;
    constexpr double reach = 8;
    const double step = 2 * reach / (points - 1);
    std::vector<double> sum(points, 0);
    double before = 0;
    for (int i = 0; i < points; ++i) {
        const double z = -reach + step * i; // of ln c, in standard deviations
        const double density = std::exp(-z * z / 2) * likelihood(std::exp(sigma_ln * z));
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
                           double level, const std::optional<IntensityRange>& points, const AlikeStructures& alike)
{
    const PastAxes& axes = collapse.axes;
    const std::vector<double> weights = frequency_weights(axes.frequency_hz);
    const IntensityIntegral integral(axes.intensity, [&](double a) { return rates.density(std::log(a)); });
    const double above = rates.frequency(std::log(axes.intensity.back()));
    const auto fragility = [&](std::span<const double> cells) {
        return over_frequencies(cells.subspan(0, axes.cells_of_one()), weights);
    };
    const auto rate_of = [&](const std::vector<double>& p) { return integral.total(p) + p.back() * above; };
    const auto rate = [&](std::span<const double> cells) { return rate_of(fragility(cells)); };
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
    const auto exposures = [&](std::span<const double> cells) {
        std::vector<double> exposure, any(axes.cells_of_one());
        for (std::size_t m = 1; m <= alike.built; ++m) { // one of m falls
            for (std::size_t c = 0; c < any.size(); ++c)
                any[c] = 1 - (1 - cells[c]) * alike.all_stand[c * alike.built + m - 1];
            exposure.push_back(rate_of(fragility(any)) * years);
        }
        return exposure;
    };
    const auto alike_quantile = [&](double p) {
        return past_estimate(collapse, [&](auto cells) {
            const std::vector<double> exposure = exposures(cells);
            return factor_quantile([&](double c) { return alike_likelihood(exposure, alike.standing, c); }, sigma_ln,
                                   p);
        });
    };
    const bool several = alike.built > 1;
    update.alike_median = several ? alike_quantile(0.5) : update.factor_median;
    update.alike_lower = several ? alike_quantile((1 - level) / 2) : update.factor_lower;
    update.alike_upper = several ? alike_quantile((1 + level) / 2) : update.factor_upper;
    const double z = normal_quantile((1 + level) / 2);
    update.prior_lower = std::exp(-sigma_ln * z);
    update.prior_upper = std::exp(sigma_ln * z);
    return update;
}

} // namespace stylobate
