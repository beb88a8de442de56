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

} // namespace stylobate
