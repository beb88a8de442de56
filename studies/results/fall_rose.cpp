#include "studies/results/fall_rose.hpp"

#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {
namespace {

constexpr double sector_rad = 2 * std::numbers::pi / FallRose::sectors;
constexpr double rad_to_deg = 180 / std::numbers::pi;

} // namespace

void FallRose::add(const Outcome& outcome)
{
    const double azimuth = outcome.fall_azimuth_rad;
    if (outcome.state != State::collapsed || !std::isfinite(azimuth))
        return;
    const long sector = std::lround(azimuth / sector_rad) % static_cast<long>(sectors);
    ++counts_[static_cast<std::size_t>(sector < 0 ? sector + static_cast<long>(sectors) : sector)];
    ++falls_;
    x_ += std::cos(azimuth);
    z_ += std::sin(azimuth);
}

double FallRose::resultant() const
{
    return falls_ == 0 ? 0 : std::hypot(x_, z_) / static_cast<double>(falls_);
}

double FallRose::mean_deg() const
{
    return std::atan2(z_, x_) * rad_to_deg;
}

Html FallRose::svg(const std::string& title) const
{
    constexpr double middle = 150, outer = 108;
    const auto most = static_cast<double>(std::max<std::uint64_t>(1, *std::ranges::max_element(counts_)));
    const auto circle = [&](double radius) {
        return fmt::format("<circle class=\"grid\" cx=\"{0}\" cy=\"{0}\" r=\"{1}\" fill=\"none\"/>\n", middle, radius);
    };
    const auto at = [&](double radius, double angle) {
        return fmt::format("{:.1f} {:.1f}", middle + radius * std::cos(angle), middle + radius * std::sin(angle));
    };
    std::string petals;
    for (std::size_t i = 0; i < sectors; ++i) {
        if (counts_[i] == 0)
            continue;
        const double radius = outer * std::sqrt(static_cast<double>(counts_[i]) / most);
        const double angle = static_cast<double>(i) * sector_rad;
        petals += fmt::format("<path class=\"petal\" d=\"M{0} {0}L{1}A{2:.1f} {2:.1f} 0 0 1 {3}Z\"><title>{4:.0f}°: "
                              "{5}</title></path>\n",
                              middle, at(radius, angle - sector_rad / 2), radius, at(radius, angle + sector_rad / 2),
                              angle * rad_to_deg, counts_[i]);
    }
    return Html::ready(fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"rose\" viewBox=\"0 0 300 300\" width=\"300\" role=\"img\" "
        "aria-label=\"{}\" font-family=\"inherit\" font-size=\"13\">\n{}{}{}{}{}{}</svg>",
        html_escaped(title), circle(outer), circle(outer / 2), petals, svg_text(270, middle + 5, "start", "x"),
        svg_text(middle, 282, "middle", "z"), svg_text(6, 16, "start", fmt::format("outer circle: {:.0f}", most))));
}

std::string FallRose::caption() const
{
    return fmt::format(
        "Directions in which {} realization{} fell, from above, x to the right and z downwards. The area "
        "of a sector is the number of realizations. Mean direction: {:.0f}° from x towards z; length of "
        "the mean of the directions: {:.2f} (1: all in one direction; near 0: none prevails).",
        falls_, falls_ == 1 ? "" : "s", mean_deg(), resultant());
}

} // namespace stylobate
