#include "io/plots/drawing_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

constexpr double dimension_font = 19, least_font = 9;
constexpr char dimension_colour[] = "#27475c";

} // namespace

std::string DrawingSheet::x(double pixels) const
{
    return fmt::format("screen {:.5f}", pixels / size_.width);
}

std::string DrawingSheet::y(double pixels) const
{
    return fmt::format("screen {:.5f}", 1 - pixels / size_.height);
}

double DrawingSheet::width(std::string_view words, double font)
{
    const auto letters = std::count_if(words.begin(), words.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    return 0.86 * font * static_cast<double>(letters); // a point is 4/3 of a pixel
}

double DrawingSheet::fitting(std::string_view words, double pixels, double most)
{
    return std::min(most, most * pixels / std::max(width(words, most), 1.0));
}

void DrawingSheet::rectangle(double left, double top, double right, double bottom, std::string_view fill,
                             std::string_view line)
{
    script_ +=
        fmt::format("set object {} rectangle from {}, {} to {}, {} front fillcolor rgb '{}' fillstyle solid 1 {}\n",
                    ++objects_, x(left), y(bottom), x(right), y(top), fill,
                    line.empty() ? "noborder" : fmt::format("border linecolor rgb '{}' linewidth 0.8", line));
}

void DrawingSheet::polygon(const std::vector<std::array<double, 2>>& points, std::string_view fill,
                           std::string_view line, double width)
{
    if (points.empty())
        return;
    script_ += fmt::format("set object {} polygon from ", ++objects_);
    for (std::size_t i = 0; i <= points.size(); ++i) {
        const auto& [at_x, at_y] = points[i % points.size()];
        script_ += fmt::format("{}{}, {}", i > 0 ? " to " : "", x(at_x), y(at_y));
    }
    script_ += fmt::format(
        " front {} {}\n", fill.empty() ? "fillstyle empty" : fmt::format("fillcolor rgb '{}' fillstyle solid 1", fill),
        line.empty() ? "noborder" : fmt::format("border linecolor rgb '{}' linewidth {}", line, width));
}

void DrawingSheet::path(const std::vector<std::array<double, 2>>& points, std::string_view colour, double width)
{
    for (std::size_t i = 1; i < points.size(); ++i)
        line(points[i - 1][0], points[i - 1][1], points[i][0], points[i][1], colour, width);
}

void DrawingSheet::line(double x0, double y0, double x1, double y1, std::string_view colour, double width)
{
    script_ += fmt::format("set arrow from {}, {} to {}, {} nohead front linecolor rgb '{}' linewidth {}\n", x(x0),
                           y(y0), x(x1), y(y1), colour, width);
}

void DrawingSheet::text(std::string_view words, double at_x, double at_y, double font, TextAt at,
                        std::string_view colour, bool turned)
{
    script_ += fmt::format("set label {} at {}, {} {} {} front font ',{:.1f}' textcolor rgb '{}'\n",
                           gnuplot_text(words), x(at_x), y(at_y),
                           at == TextAt::left    ? "left"
                           : at == TextAt::right ? "right"
                                                 : "center",
                           turned ? "rotate by 90" : "norotate", font, colour);
}

void DrawingSheet::tick(double at_x, double at_y)
{
    constexpr double half = 6;
    line(at_x - half, at_y + half, at_x + half, at_y - half, dimension_colour, 0.8);
}

void DrawingSheet::across(double x0, double x1, double at_y, std::string_view words, bool above)
{
    line(x0, at_y, x1, at_y, dimension_colour, 0.6);
    tick(x0, at_y);
    tick(x1, at_y);
    constexpr double distance = 20;
    const double font = fitting(words, x1 - x0 - 6, dimension_font);
    if (font >= 0.7 * dimension_font)
        return text(words, (x0 + x1) / 2, at_y + (above ? -distance : distance), font, TextAt::center,
                    dimension_colour);
    // upright, away from the line
    constexpr double room = 58; // to the next line
    const double turned = std::max(least_font, std::min((x1 - x0) / 1.5, fitting(words, room, dimension_font)));
    text(words, (x0 + x1) / 2, at_y + (above ? -10 : 10), turned, above ? TextAt::left : TextAt::right,
         dimension_colour, true);
}

void DrawingSheet::along(double at_x, double y0, double y1, std::string_view words, bool turned)
{
    line(at_x, y0, at_x, y1, dimension_colour, 0.6);
    tick(at_x, y0);
    tick(at_x, y1);
    const double middle = (y0 + y1) / 2;
    if (turned)
        text(words, at_x - 20, middle, dimension_font, TextAt::center, dimension_colour, true);
    else
        text(words, at_x - 14, middle, std::clamp((y0 > y1 ? y0 - y1 : y1 - y0) / 1.3, least_font, dimension_font),
             TextAt::right, dimension_colour);
}

void DrawingSheet::write(std::string_view title, std::string_view subtitle, const std::filesystem::path& file) const
{
    // something must be plotted: a point that is nowhere
    run_gnuplot(gnuplot_heading(title, subtitle, size_) + script_ +
                    "unset border\nunset tics\nunset key\nset xrange [0:1]\nset yrange [0:1]\nplot '+' using 1:(1/0) "
                    "notitle\n",
                size_, file);
}

bool same(double a, double b)
{
    return std::fabs(a - b) <= 1e-9 * std::max(std::fabs(a), std::fabs(b));
}

std::string mass_text(double kg)
{
    return kg < 1000 ? fmt::format("{:.4g} kg", kg) : fmt::format("{:.4g} t", kg / 1000);
}

} // namespace stylobate
