#include "io/plots/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

std::string mixed_colour(const char* first, const char* second, double part)
{
    const auto channel = [](const char* colour, std::size_t k) { // of "#rrggbb"
        return static_cast<double>(std::stoi(std::string(colour).substr(1 + 2 * k, 2), nullptr, 16));
    };
    std::string mixed = "#";
    for (std::size_t k = 0; k < 3; ++k)
        mixed += fmt::format("{:02x}", std::lround((1 - part) * channel(first, k) + part * channel(second, k)));
    return mixed;
}

std::string viridis_colour(double value)
{
    const double at = std::clamp(value, 0.0, 1.0) * static_cast<double>(viridis.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
    return mixed_colour(viridis[i], viridis[i + 1], at - static_cast<double>(i));
}

} // namespace stylobate
