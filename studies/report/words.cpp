#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

std::string list_words(const std::vector<std::string>& list)
{
    std::string text;
    for (std::size_t i = 0; i < list.size(); ++i)
        text += (i == 0 ? "" : i + 1 == list.size() ? " and " : ", ") + list[i];
    return text;
}

std::string duration_text(double seconds)
{
    const long s = std::lround(seconds);
    if (s < 60)
        return fmt::format("{} s", s);
    if (s < 3600)
        return fmt::format("{} min {} s", s / 60, s % 60);
    return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

std::string seconds_text(double seconds)
{
    return seconds < 9.5 ? fmt::format("{:.2g} s", seconds) : duration_text(seconds);
}

std::string rate_text(double rate)
{
    return rate >= 10 ? fmt::format("{:.0f}", rate) : fmt::format("{:.2g}", rate);
}

std::string percent_text(double share)
{
    return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "–";
}

} // namespace stylobate
