#include "io/measured/measured_noise.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stylobate {

double noise_of(std::span<const double> values, std::size_t stride)
{
    constexpr int orders = 8;
    constexpr std::size_t fewest = 32;
    std::vector<double> difference;
    for (std::size_t i = 0; i < values.size(); i += stride)
        difference.push_back(values[i]);
    double least = 0, gain2 = 1; // (2p)! / (p!)2
    for (int p = 1; p <= orders; ++p) {
        gain2 *= 2.0 * (2 * p - 1) / p;
        for (std::size_t i = 0; i + 1 < difference.size(); ++i)
            difference[i] = difference[i + 1] - difference[i];
        if (!difference.empty())
            difference.pop_back();
        std::vector<double> size;
        for (const double d : difference)
            if (std::isfinite(d))
                size.push_back(std::abs(d));
        if (size.size() < fewest)
            break;
        constexpr double median_of_normal = 0.674490;
        const double sd = upper_median(std::move(size)) / median_of_normal / std::sqrt(gain2);
        least = p == 1 ? sd : std::min(least, sd);
    }
    return least;
}

double mean_seen(std::span<const double> values, std::size_t samples, std::size_t column, std::size_t stride)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < samples; ++i)
        if (const double value = values[i * stride + column]; !std::isnan(value)) {
            sum += value;
            ++count;
        }
    return sum / count;
}

std::size_t samples_at_rest(const MeasuredRun& run)
{
    const Series& base = run.base_acceleration_m_s2;
    constexpr std::size_t block = 10, fewest = 20;
    if (base.empty())
        return 0;
    const double noise = base.noise_sd.value_or(noise_of(base.values));
    const double tolerance = 4 * noise * std::sqrt(2.0 / block) + 1e-9;
    std::size_t quiet = 0;
    double first = 0;
    for (; quiet + block <= base.values.size(); quiet += block) {
        double mean = 0;
        for (std::size_t i = quiet; i < quiet + block; ++i)
            mean += base.values[i] / block;
        first = quiet == 0 ? mean : first;
        if (!(std::abs(mean - first) < tolerance))
            break;
    }
    return quiet / 2 >= fewest ? quiet / 2 : 0;
}

std::vector<double> places_at_rest(const Specimen& specimen, const MeasuredRun& run, std::size_t samples)
{
    const std::size_t blocks = specimen.rest_x_m.size();
    const double shift = run.table.x_m.empty() ? 0 : mean_seen(run.table.x_m.values, samples, 0, 1);
    std::vector<double> out;
    for (std::size_t b = 0; b < blocks; ++b)
        out.push_back(mean_seen(run.blocks.x_m.values, samples, b, blocks) - specimen.rest_x_m[b] - shift);
    return out;
}

} // namespace stylobate
