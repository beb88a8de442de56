#include "io/plots/sheet.hpp"

#include "io/files/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

constexpr double dimension_font = 25, least_font = 12;
constexpr char dimension_colour[] = "#27475c";
constexpr double drop = 0.35; ///< of a text's middle above its baseline, in heights of the type

/// A number with as many digits as a picture shows.
std::string px(double value)
{
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.'))
        text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string fill_and_line(std::string_view fill, std::string_view line, double width, double opacity)
{
    std::string look = fill.empty() ? "fill:none" : fmt::format("fill:{}", fill);
    if (opacity < 1)
        look += fmt::format(";fill-opacity:{}", opacity);
    if (!line.empty())
        look += fmt::format(";stroke:{};stroke-width:{}", line, px(width));
    return look;
}

std::string points_of(const std::vector<std::array<double, 2>>& points)
{
    std::string data;
    bool open = false;
    for (const auto& [x, y] : points) {
        if (!std::isfinite(x) || !std::isfinite(y)) {
            open = false;
            continue;
        }
        data += fmt::format("{}{} {}", open ? 'L' : 'M', px(x), px(y));
        open = true;
    }
    return data;
}

/// The corners of a mark about its middle, of a circle none.
std::vector<std::array<double, 2>> corners_of(MarkShape shape)
{
    switch (shape) {
    case MarkShape::circle:
        return {};
    case MarkShape::square:
        return {{-0.88, -0.88}, {0.88, -0.88}, {0.88, 0.88}, {-0.88, 0.88}};
    case MarkShape::triangle:
        return {{0, -1.2}, {1.1, 0.8}, {-1.1, 0.8}};
    case MarkShape::diamond:
        return {{0, -1.25}, {1.25, 0}, {0, 1.25}, {-1.25, 0}};
    case MarkShape::wedge:
        return {{0, 1.2}, {-1.1, -0.8}, {1.1, -0.8}};
    case MarkShape::pentagon:
        return {{0, -1.15}, {1.09, -0.36}, {0.68, 0.93}, {-0.68, 0.93}, {-1.09, -0.36}};
    case MarkShape::cross:
        return {{-1.1, -0.5}, {-0.5, -1.1}, {0, -0.6}, {0.5, -1.1}, {1.1, -0.5}, {0.6, 0},
                {1.1, 0.5},   {0.5, 1.1},   {0, 0.6},  {-0.5, 1.1}, {-1.1, 0.5}, {-0.6, 0}};
    }
    return {};
}

} // namespace

double DrawingSheet::fitting(std::string_view words, double pixels, double most)
{
    return std::min(most, most * pixels / std::max(width(words, most), 1.0));
}

void DrawingSheet::cell(double left, double top, double right, double bottom, std::string_view attributes)
{
    elements_ +=
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", px(std::min(left, right)),
                    px(std::min(top, bottom)), px(std::abs(right - left)), px(std::abs(bottom - top)), attributes);
}

void DrawingSheet::rectangle(double left, double top, double right, double bottom, std::string_view fill,
                             std::string_view line, double opacity, double width)
{
    cell(left, top, right, bottom, fmt::format("style=\"{}\"", fill_and_line(fill, line, width, opacity)));
}

void DrawingSheet::polygon(const std::vector<std::array<double, 2>>& points, std::string_view fill,
                           std::string_view line, double width, double opacity)
{
    if (!points.empty())
        elements_ += fmt::format("<path d=\"{}Z\" style=\"{};stroke-linejoin:round\"/>\n", points_of(points),
                                 fill_and_line(fill, line, width, opacity));
}

void DrawingSheet::path(const std::vector<std::array<double, 2>>& points, std::string_view colour, double width,
                        std::string_view dashes)
{
    const std::string data = points_of(points);
    if (!data.empty())
        elements_ +=
            fmt::format("<path d=\"{}\" style=\"fill:none;stroke:{};stroke-width:{};stroke-linejoin:round{}\""
                        "/>\n",
                        data, colour, px(width), dashes.empty() ? "" : fmt::format(";stroke-dasharray:{}", dashes));
}

void DrawingSheet::line(double x0, double y0, double x1, double y1, std::string_view colour, double width)
{
    elements_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" style=\"stroke:{};stroke-width:{}\"/>\n",
                             px(x0), px(y0), px(x1), px(y1), colour, px(width));
}

void DrawingSheet::mark(MarkShape shape, double x, double y, double radius, std::string_view colour)
{
    std::vector<std::array<double, 2>> corners = corners_of(shape);
    if (corners.empty()) {
        elements_ +=
            fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" style=\"fill:{}\"/>\n", px(x), px(y), px(radius), colour);
        return;
    }
    for (auto& [at_x, at_y] : corners) {
        at_x = x + radius * at_x;
        at_y = y + radius * at_y;
    }
    polygon(corners, colour);
}

void DrawingSheet::keep_box(std::string_view words, double x, double y, double font, TextAt at, bool turned)
{
    const double wide = width(words, font);
    const double before = at == TextAt::left ? 0 : at == TextAt::right ? wide : wide / 2;
    const double half = 0.37 * font; // of capitals and digits
    if (turned)
        texts_.push_back({std::string(words), x - half, y + before - wide, x + half, y + before});
    else
        texts_.push_back({std::string(words), x - before, y - half, x - before + wide, y + half});
}

void DrawingSheet::add_text(std::string_view words, double x, double baseline, double font, TextAt at,
                            std::string_view colour, const std::string& more)
{
    std::string plain(words);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    elements_ += fmt::format(
        "<text x=\"{}\" y=\"{}\"{}{}{}{}>{}</text>\n", px(x), px(baseline),
        at == TextAt::left ? "" : fmt::format(" text-anchor=\"{}\"", at == TextAt::right ? "end" : "middle"),
        same(font, letters_) ? "" : fmt::format(" font-size=\"{}\"", px(font)),
        colour.empty() ? "" : fmt::format(" style=\"fill:{}\"", colour), more, xml_escaped(plain));
}

void DrawingSheet::text(std::string_view words, double x, double y, double font, TextAt at, std::string_view colour,
                        bool turned)
{
    keep_box(words, x, y, font, at, turned);
    if (turned)
        add_text(words, x + drop * font, y, font, at, colour,
                 fmt::format(" transform=\"rotate(-90 {} {})\"", px(x + drop * font), px(y)));
    else
        add_text(words, x, y + drop * font, font, at, colour, "");
}

void DrawingSheet::slanted_text(std::string_view words, double x, double y, double font, std::string_view colour)
{
    add_text(words, x, y, font, TextAt::right, colour, fmt::format(" transform=\"rotate(-35 {} {})\"", px(x), px(y)));
}

void DrawingSheet::boxed_text(std::string_view words, double x, double y, double font)
{
    const double half = width(words, font) / 2 + 0.35 * font;
    elements_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\" style=\"fill:#fff\" "
                             "pointer-events=\"none\"/>\n",
                             px(x - half), px(y - 0.68 * font), px(2 * half), px(1.36 * font), px(0.2 * font));
    text(words, x, y, font, TextAt::center, "#000000");
}

void DrawingSheet::tick(double at_x, double at_y)
{
    constexpr double half = 6;
    line(at_x - half, at_y + half, at_x + half, at_y - half, dimension_colour, 1.6);
}

void DrawingSheet::across(double x0, double x1, double at_y, std::string_view words, bool above)
{
    line(x0, at_y, x1, at_y, dimension_colour, 1.2);
    tick(x0, at_y);
    tick(x1, at_y);
    constexpr double distance = 20;
    const double font = fitting(words, x1 - x0 - 6, dimension_font);
    if (font >= 0.7 * dimension_font)
        return text(words, (x0 + x1) / 2, at_y + (above ? -distance : distance), font, TextAt::center,
                    dimension_colour);
    // upright, away from the line
    constexpr double room = 58; // to the next line
    const double turned = std::max(least_font, std::min((x1 - x0) / 1.1, fitting(words, room, dimension_font)));
    text(words, (x0 + x1) / 2, at_y + (above ? -10 : 10), turned, above ? TextAt::left : TextAt::right,
         dimension_colour, true);
}

void DrawingSheet::along(double at_x, double y0, double y1, std::string_view words, bool turned)
{
    line(at_x, y0, at_x, y1, dimension_colour, 1.2);
    tick(at_x, y0);
    tick(at_x, y1);
    const double middle = (y0 + y1) / 2;
    if (turned)
        text(words, at_x - 20, middle, dimension_font, TextAt::center, dimension_colour, true);
    else
        text(words, at_x - 14, middle, std::clamp(std::abs(y0 - y1), least_font, dimension_font), TextAt::right,
             dimension_colour);
}

void DrawingSheet::open(std::string_view attributes)
{
    elements_ += fmt::format("<g{}{}>\n", attributes.empty() ? "" : " ", attributes);
}

void DrawingSheet::clip(double left, double top, double right, double bottom)
{
    // Several drawings may be in one page: equal names mean equal rectangles.
    const std::string name = fmt::format("clip-{:.0f}-{:.0f}-{:.0f}-{:.0f}", left, top, right, bottom);
    elements_ += fmt::format("<clipPath id=\"{0}\"><rect x=\"{1:.0f}\" y=\"{2:.0f}\" width=\"{3:.0f}\" "
                             "height=\"{4:.0f}\"/></clipPath>\n<g clip-path=\"url(#{0})\">\n",
                             name, left, top, right - left, bottom - top);
}

void DrawingSheet::close()
{
    elements_ += "</g>\n";
}

double DrawingSheet::heading(std::string_view title, std::string_view subtitle)
{
    const double unit = size_.width / 1800.0, room = 0.96 * size_.width;
    const double least = 8 * unit;
    text(title, size_.width / 2.0, 58 * unit, std::max(least, fitting(title, room, 43 * unit)), TextAt::center,
         "#000000");
    if (subtitle.empty())
        return 100 * unit;
    text(subtitle, size_.width / 2.0, 123 * unit, std::max(least, fitting(subtitle, room, 28 * unit)), TextAt::center,
         "#505050");
    return 160 * unit;
}

std::string DrawingSheet::element(std::string_view attributes) const
{
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"{2}\"{4}{5}>\n<rect width=\"{0}\" height=\"{1}\" "
        "style=\"fill:#ffffff\"/>\n{3}</svg>\n",
        size_.width, size_.height, px(letters_), elements_, attributes.empty() ? "" : " ", attributes);
}

std::string DrawingSheet::svg() const
{
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + element();
}

void DrawingSheet::write(const std::filesystem::path& file) const
{
    write_picture(svg(), size_, file);
}

void DrawingSheet::write(std::string_view title, std::string_view subtitle, const std::filesystem::path& file) const
{
    DrawingSheet whole = *this;
    whole.heading(title, subtitle);
    whole.write(file);
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
