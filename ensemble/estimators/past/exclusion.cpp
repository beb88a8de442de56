#include "ensemble/estimators/past/exclusion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

Exclusion exclusion(const PastLikelihood& likelihood, std::size_t events, const PriorDensity& prior, double level,
                    const RatioThresholds& thresholds, std::optional<std::size_t> frequency)
{
    const PastAxes& axes = likelihood.axes;
    assert(events >= 1 && events <= axes.events && "a past that was computed");
    const std::size_t ni = axes.intensity.size(), nf = axes.frequency_hz.size(),
                      first = (events - 1) * axes.cells_of_one();
    const std::vector<double> weights = frequency_weights(axes.frequency_hz);
    const auto of_events = [&](std::span<const double> cells) { return cells.subspan(first, axes.cells_of_one()); };
    const auto curve = [&](std::span<const double> cells) {
        if (!frequency)
            return over_frequencies(of_events(cells), weights);
        const std::span<const double> row = of_events(cells).subspan(*frequency * ni, ni);
        return std::vector<double>(row.begin(), row.end());
    };
    const IntensityIntegral integral(axes.intensity, prior);

    Exclusion result;
    result.rule = frequency ? thresholds.by_frequency.at(*frequency) : thresholds.mean;
    for (std::size_t i = 0; i < ni; ++i)
        result.likelihood.push_back(past_estimate(likelihood, [&](auto cells) { return curve(cells)[i]; }));
    const auto top = [](const std::vector<double>& values) {
        const double most = *std::max_element(values.begin(), values.end());
        return most > 0 ? values.back() / most : 1.0;
    };
    result.top_ratio = past_estimate(likelihood, [&](auto cells) { return top(curve(cells)); });
    const auto limit = [&](std::span<const double> cells) {
        const std::vector<double> values = curve(cells);
        return likelihood_limit(axes.intensity, values, result.rule.thresholds(values));
    };
    result.by_likelihood = past_estimate(likelihood, limit);
    std::vector<double> inverse; // from strong to weak, ascending
    for (auto a = axes.intensity.rbegin(); a != axes.intensity.rend(); ++a)
        inverse.push_back(1 / *a);
    result.weaker = past_estimate(likelihood, [&](auto cells) {
        std::vector<double> values = curve(cells), threshold = result.rule.thresholds(values);
        std::reverse(values.begin(), values.end());
        std::reverse(threshold.begin(), threshold.end());
        return 1 / likelihood_limit(inverse, values, threshold);
    });
    for (const std::vector<double>& draw : likelihood.drawn)
        result.drawn_with_limit += std::isfinite(limit(draw));
    result.drawn = likelihood.drawn.size();
    result.by_posterior = past_estimate(likelihood, [&](auto cells) { return integral.quantile(curve(cells), level); });
    result.by_prior = integral.quantile(std::vector<double>(ni, 1.0), level);
    if (frequency || nf == 1)
        return result;

    result.by_profile = past_estimate(likelihood, [&](auto cells) {
        const std::vector<double> values = largest_over_frequencies(of_events(cells), ni);
        return likelihood_limit(axes.intensity, values, thresholds.profile.thresholds(values));
    });
    const auto of_end = [&](std::size_t f) {
        return past_estimate(likelihood, [&](auto cells) {
            const auto all = of_events(cells), row = all.subspan(f * ni, ni);
            return *std::max_element(row.begin(), row.end()) / *std::max_element(all.begin(), all.end());
        });
    };
    result.lowest_frequency = of_end(0);
    result.highest_frequency = of_end(nf - 1);
    result.open_from = asymptotic_rule(1, level).part.front();
    return result;
}

} // namespace stylobate
