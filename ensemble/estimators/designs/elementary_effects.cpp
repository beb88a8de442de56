#include "ensemble/estimators/designs/elementary_effects.hpp"

#include <cmath>
#include <stdexcept>

namespace stylobate {

namespace {

/// The root of a square that chance may have made negative.
double root(double square)
{
    return std::sqrt(std::max(square, 0.0));
}

} // namespace

std::vector<ElementaryEffects> elementary_effects(const DesignValues& values, const std::vector<double>& direction,
                                                  const BootstrapOptions& options)
{
    const std::size_t points = values.factors + 1, d = values.factors, m = values.inner;
    if (m == 0 || values.rows < 2 || values.value.size() != values.rows * points * m ||
        direction.size() != values.rows * d)
        throw std::invalid_argument("the outcomes are not (rows x (factors + 1) x inner)");

    constexpr std::size_t width = 3; // of each factor: e, |e|, e^2 without its noise
    std::vector<double> numbers;
    std::vector<bool> acts(d, false);
    numbers.reserve(values.rows * d * width);
    for (std::size_t r = 0; r < values.rows; ++r)
        for (std::size_t k = 0; k < d; ++k) {
            double sum = 0, squares = 0;
            for (std::size_t i = 0; i < m; ++i) {
                const double effect = (values.at(r, k + 1, i, points) - values.at(r, 0, i, points)) / elementary_step;
                acts[k] = acts[k] || effect != 0;
                sum += effect;
                squares += effect * effect;
            }
            const auto n = static_cast<double>(m);
            const double mean = sum / n;
            const double noise = m > 1 ? (squares / n - mean * mean) / (n - 1) : 0;
            numbers.insert(numbers.end(), {mean * direction[r * d + k], std::abs(mean), mean * mean - noise});
        }

    const auto estimates = [&](std::span<const double> means, std::span<double> out) {
        for (std::size_t k = 0; k < d; ++k) {
            const double mu = means[width * k], square = means[width * k + 2];
            const double n = static_cast<double>(values.rows);
            out[4 * k] = mu;
            out[4 * k + 1] = means[width * k + 1];
            out[4 * k + 2] = root(square);
            out[4 * k + 3] = std::isnan(mu) ? mu : root((square - mu * mu) * n / (n - 1));
        }
    };
    const std::vector<Estimate> found = bootstrap_rows(numbers, width * d, 4 * d, estimates, options);
    std::vector<ElementaryEffects> effects;
    for (std::size_t k = 0; k < d; ++k)
        effects.push_back({found[4 * k], found[4 * k + 1], found[4 * k + 2], found[4 * k + 3], acts[k]});
    return effects;
}

} // namespace stylobate
