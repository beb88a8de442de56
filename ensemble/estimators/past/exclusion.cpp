#include "ensemble/estimators/past/exclusion.hpp"

#include "ensemble/numerics/quantiles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

Exclusion exclusion(const PastLikelihood& likelihood, std::size_t events, const PriorDensity& prior, double level,
                    std::optional<std::size_t> frequency)
{
    const PastAxes& axes = likelihood.axes;
    assert(events >= 1 && events <= axes.events && "a past that was computed");
    const std::size_t ni = axes.intensity.size(), first = (events - 1) * axes.cells_of_one();
    const std::vector<double> weights = frequency_weights(axes.frequency_hz);
    const auto curve = [&](std::span<const double> cells) {
        const std::span<const double> of = cells.subspan(first, axes.cells_of_one());
        if (frequency)
            return std::vector<double>(of.begin() + static_cast<std::ptrdiff_t>(*frequency * ni),
                                       of.begin() + static_cast<std::ptrdiff_t>((*frequency + 1) * ni));
        return over_frequencies(of, weights);
    };
    const IntensityIntegral integral(axes.intensity, prior);
    // the quantile of chi-square with one degree of freedom is the square of a normal one
    const double normal = normal_quantile(0.5 + level / 2);

    Exclusion result;
    result.threshold = std::exp(-normal * normal / 2);
    for (std::size_t i = 0; i < ni; ++i)
        result.likelihood.push_back(past_estimate(likelihood, [&](auto cells) { return curve(cells)[i]; }));
    const auto top = [](const std::vector<double>& values) {
        const double most = *std::max_element(values.begin(), values.end());
        return most > 0 ? values.back() / most : 1.0;
    };
    result.top_ratio = past_estimate(likelihood, [&](auto cells) { return top(curve(cells)); });
    const auto limit = [&](std::span<const double> cells) {
        return likelihood_ratio_limit(axes.intensity, curve(cells), result.threshold);
    };
    result.by_likelihood = past_estimate(likelihood, limit);
    std::vector<double> inverse; // from strong to weak, ascending
    for (auto a = axes.intensity.rbegin(); a != axes.intensity.rend(); ++a)
        inverse.push_back(1 / *a);
    result.weaker = past_estimate(likelihood, [&](auto cells) {
        std::vector<double> reversed = curve(cells);
        std::reverse(reversed.begin(), reversed.end());
        return 1 / likelihood_ratio_limit(inverse, reversed, result.threshold);
    });
    for (const std::vector<double>& draw : likelihood.drawn)
        result.drawn_with_limit += std::isfinite(limit(draw));
    result.drawn = likelihood.drawn.size();
    result.by_posterior = past_estimate(likelihood, [&](auto cells) { return integral.quantile(curve(cells), level); });
    result.by_prior = integral.quantile(std::vector<double>(ni, 1.0), level);
    return result;
}

} // namespace stylobate
