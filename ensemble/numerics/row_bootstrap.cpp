#include "ensemble/numerics/row_bootstrap.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {

Estimate Estimate::undetermined()
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
}

std::vector<double> row_means(std::span<const double> rows, std::size_t width)
{
    std::vector<double> means(width, 0);
    for (std::size_t i = 0; i < rows.size(); ++i)
        means[i % width] += rows[i];
    const std::size_t count = rows.size() / width;
    for (double& mean : means)
        mean /= static_cast<double>(count);
    return means;
}

std::vector<Estimate> bootstrap_rows(std::span<const double> rows, std::size_t width, std::size_t estimates,
                                     const FromMeans& from_means, const BootstrapOptions& options)
{
    assert(width > 0 && rows.size() % width == 0 && "the rows have as many numbers each");
    const std::size_t n = rows.size() / width;
    if (n < 2 || options.resamples < 2)
        return std::vector<Estimate>(estimates, Estimate::undetermined());
    std::vector<double> value(estimates);
    from_means(row_means(rows, width), value);

    std::vector<std::vector<double>> drawn(estimates);
    std::vector<double> means(width), resampled(estimates);
    std::vector<std::uint32_t> times(n);
    for (std::size_t resample = 0; resample < options.resamples; ++resample) {
        std::fill(times.begin(), times.end(), 0U);
        for (std::size_t i = 0; i < n; ++i) {
            const double u = uniform01(options.seed, resample, Stream::bootstrap, i);
            ++times[static_cast<std::size_t>(u * static_cast<double>(n))];
        }
        std::fill(means.begin(), means.end(), 0);
        for (std::size_t i = 0; i < n; ++i)
            if (times[i] > 0)
                for (std::size_t k = 0; k < width; ++k)
                    means[k] += times[i] * rows[i * width + k];
        for (double& mean : means)
            mean /= static_cast<double>(n);
        from_means(means, resampled);
        for (std::size_t k = 0; k < estimates; ++k)
            if (std::isfinite(resampled[k]))
                drawn[k].push_back(resampled[k]);
    }

    std::vector<Estimate> result;
    const double tail = (1 - options.level) / 2;
    for (std::size_t k = 0; k < estimates; ++k) {
        const auto lost = static_cast<double>(options.resamples - drawn[k].size());
        if (!std::isfinite(value[k]) || lost > tail * static_cast<double>(options.resamples)) {
            result.push_back(Estimate::undetermined());
            continue;
        }
        std::sort(drawn[k].begin(), drawn[k].end());
        result.push_back({value[k], sorted_quantile(drawn[k], tail, QuantileDefinition::linear),
                          sorted_quantile(drawn[k], 1 - tail, QuantileDefinition::linear)});
    }
    return result;
}

std::vector<Estimate> resampled_rows(std::span<const double> rows, std::size_t width, std::size_t estimates,
                                     const FromMeans& from_means, const BootstrapOptions& options)
{
    std::vector<Estimate> result = bootstrap_rows(rows, width, estimates, from_means, options);
    const std::size_t n = rows.size() / width;
    if (n < 2)
        return result;
    const std::vector<double> means = row_means(rows, width);
    std::vector<double> without(width), value(estimates), sum(estimates, 0), squares(estimates, 0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < width; ++k)
            without[k] = means[k] + (means[k] - rows[i * width + k]) / static_cast<double>(n - 1);
        from_means(without, value);
        for (std::size_t k = 0; k < estimates; ++k) {
            const double change = value[k] - result[k].value;
            sum[k] += change;
            squares[k] += change * change;
        }
    }
    const auto count = static_cast<double>(n);
    const double t = student_quantile((1 + options.level) / 2, count - 1);
    for (std::size_t k = 0; k < estimates; ++k) {
        const double variance = (count - 1) / count * (squares[k] - sum[k] * sum[k] / count);
        if (!std::isfinite(variance)) {
            result[k] = Estimate::undetermined();
            continue;
        }
        const double reach = t * std::sqrt(std::max(variance, 0.0));
        result[k].lower = std::min(result[k].lower, result[k].value - reach);
        result[k].upper = std::max(result[k].upper, result[k].value + reach);
    }
    return result;
}

} // namespace stylobate
