#include "io/plots/plot_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {
namespace {

/// "0.25", "2.5e-4": of more than six letters the shorter one, as they would reach the label of the axis.
std::string tic_text(double value)
{
    constexpr std::size_t room = 6;
    std::string text = fmt::format("{:.6g}", value), power = fmt::format("{:.5e}", value);
    if (text.size() <= room && text.find('e') == std::string::npos)
        return text;
    const std::size_t e = power.find('e');
    const int exponent = std::stoi(power.substr(e + 1));
    power.resize(e);
    power.erase(power.find_last_not_of('0') + 1);
    if (power.ends_with('.'))
        power.pop_back();
    power += fmt::format("e{}", exponent);
    return power.size() < text.size() ? power : text;
}

/// The values of a logarithmic axis: digits of each decade, as few as give three numbers, and marks between them.
std::vector<PlotScale::Tic> log_tics(double from, double to, double most)
{
    constexpr std::array<std::array<bool, 9>, 3> labelled{
        {{true, false, false, false, false, false, false, false, false},
         {true, true, false, false, true, false, false, false, false},
         {true, true, true, true, true, true, true, true, true}}};
    const double decades = std::log10(to / from);
    const int stride = static_cast<int>(std::max(1.0, std::ceil(decades / most)));
    std::vector<PlotScale::Tic> tics;
    for (const std::array<bool, 9>& digits : labelled) {
        if (decades < 1 && !digits[2])
            continue; // all digits have room
        tics.clear();
        std::size_t numbers = 0;
        for (int decade = static_cast<int>(std::floor(std::log10(from))); std::pow(10.0, decade) <= to; ++decade)
            for (std::size_t k = 0; k < digits.size(); ++k) {
                // from its text, so that 0.3 is 0.3
                const double tic = std::stod(fmt::format("{}e{}", k + 1, decade));
                if (tic < from * (1 - 1e-9) || tic > to * (1 + 1e-9))
                    continue;
                const bool number = digits[k] && decade % stride == 0;
                numbers += number ? 1 : 0;
                if (number || decades < 4)
                    tics.push_back({tic, number ? tic_text(tic) : ""});
            }
        if (numbers >= 3)
            break;
    }
    return tics;
}

} // namespace

bool PlotScale::holds(double value) const
{
    return std::isfinite(value) && (!log || value > 0);
}

void PlotScale::include(double value)
{
    if (!holds(value))
        return;
    from = std::min(from, value);
    to = std::max(to, value);
}

double PlotScale::scaled(double value) const
{
    return log ? std::log10(value) : value;
}

void PlotScale::pad(double share)
{
    if (empty()) {
        from = log ? 1 : 0;
        to = log ? 10 : 1;
        return;
    }
    double a = scaled(from), b = scaled(to);
    if (b - a <= 1e-12 * std::max(std::abs(a), std::abs(b)) || b == a) {
        const double around = log ? 0.5 : a == 0 ? 1 : std::abs(a) / 2;
        a -= around;
        b += around;
    } else {
        const double room = share * (b - a);
        a -= room;
        b += room;
    }
    from = log ? std::pow(10, a) : a;
    to = log ? std::pow(10, b) : b;
}

double PlotScale::px(double value) const
{
    return first_px + (scaled(value) - scaled(from)) / (scaled(to) - scaled(from)) * (last_px - first_px);
}

std::vector<PlotScale::Tic> PlotScale::tics(double most) const
{
    if (log && to > 2 * from)
        return log_tics(from, to, most);
    const double rough = (to - from) / std::max(1.0, most - 1);
    double decade = std::pow(10, std::floor(std::log10(rough)));
    int digit = rough <= 1.001 * decade ? 1 : rough < 2.5 * decade ? 2 : rough < 6 * decade ? 5 : 10;
    std::vector<Tic> tics;
    while (true) {
        const double step = digit * decade;
        tics.clear();
        for (double i = std::ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i)
            tics.push_back({i == 0 ? 0 : i * step, tic_text(i == 0 ? 0 : i * step)});
        if (tics.size() >= 3 || !(to > from))
            return tics; // fewer would not show the scale
        decade = digit == 1 ? decade / 10 : decade;
        digit = digit == 10 ? 5 : digit == 5 ? 2 : digit == 2 ? 1 : 5;
    }
}

} // namespace stylobate
