#include "io/plots/figure_panel.hpp"

#include "io/files/utf8.hpp"
#include "io/plots/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

constexpr std::size_t most_samples = 1600; ///< of a line
constexpr std::size_t many_series = 3;     ///< of a figure with more of them lines have half as many samples

bool has_ends(const FigureSeries& s)
{
    return !s.low.empty() && s.low.size() == s.x.size() && s.high.size() == s.x.size();
}

bool has_values(const FigureSeries& s)
{
    return s.kind != SeriesKind::band && s.y.size() == s.x.size();
}

/// Between neighbours among the bars of all series; 1 where there is one alone.
double least_spacing(const Figure& figure)
{
    std::vector<double> places;
    for (const FigureSeries& s : figure.series)
        if (s.kind == SeriesKind::bars)
            places.insert(places.end(), s.x.begin(), s.x.end());
    std::sort(places.begin(), places.end());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < places.size(); ++i)
        if (const double spacing = places[i] - places[i - 1]; spacing > 0)
            least = std::min(least, spacing);
    return std::isfinite(least) ? least : 1;
}

/// Whether two series have bars in one place.
bool bars_meet(const Figure& figure)
{
    std::vector<double> places;
    for (const FigureSeries& s : figure.series)
        if (s.kind == SeriesKind::bars)
            for (const double x : s.x) {
                if (std::find(places.begin(), places.end(), x) != places.end())
                    return true;
                places.push_back(x);
            }
    return false;
}

/// Least and greatest of a number of neighbours, in their order.
std::vector<std::size_t> thinned(const std::vector<double>& y, std::size_t most)
{
    std::vector<std::size_t> kept;
    const std::size_t bucket = std::max<std::size_t>(1, (y.size() + most / 2 - 1) / (most / 2));
    for (std::size_t begin = 0; begin < y.size(); begin += bucket) {
        const std::size_t end = std::min(begin + bucket, y.size());
        std::size_t low = begin, high = begin;
        for (std::size_t i = begin; i < end; ++i) {
            if (!std::isfinite(y[i])) { // a gap stays one
                low = high = i;
                break;
            }
            low = y[i] < y[low] ? i : low;
            high = y[i] > y[high] ? i : high;
        }
        if (begin == 0 && std::min(low, high) > 0)
            kept.push_back(0); // the ends of a line stay where they are
        kept.push_back(std::min(low, high));
        if (low != high)
            kept.push_back(std::max(low, high));
    }
    if (!y.empty() && kept.back() + 1 < y.size())
        kept.push_back(y.size() - 1);
    return kept;
}

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

} // namespace

std::string FigureLook::series(std::size_t number) const
{
    const std::size_t place = number % series_colours.size();
    return page ? fmt::format("var(--s{})", place) : std::string(series_colours[place]);
}

std::string FigureLook::cell(const std::string& colour) const
{
    return page && colour.empty() ? "class=\"empty-cell\""
                                  : fmt::format("fill=\"{}\"", colour.empty() ? "#b8b8b8" : colour);
}

FigurePanel::FigurePanel(const Figure& figure, FigureLook look) : figure_(figure), look_(look)
{
    side_by_side_ = bars_meet(figure);
    x_.log = figure.x_log && figure.x_ticks.empty();
    y_.log = figure.y_log;
    set_ranges();
}

void FigurePanel::set_ranges()
{
    for (const FigureCell& cell : figure_.cells) {
        x_.include(cell.left);
        x_.include(cell.right);
        y_.include(cell.low);
        y_.include(cell.high);
    }
    for (const FigureSeries& s : figure_.series) {
        if (!has_values(s) && !has_ends(s))
            continue;
        for (const double x : s.x)
            x_.include(x);
        if (s.kind == SeriesKind::spans) {
            for (const double x : s.y)
                x_.include(x);
            continue;
        }
        if (has_values(s))
            for (const double y : s.y)
                y_.include(y);
        if (has_ends(s))
            for (std::size_t i = 0; i < s.x.size(); ++i) {
                y_.include(s.low[i]);
                y_.include(s.high[i]);
            }
    }
    const bool bars = bar_series() > 0, cells = !figure_.cells.empty();
    empty_ = x_.empty() || y_.empty();
    if (bars && !y_.log)
        y_.include(0);
    const double least = y_.from;
    const bool points = std::any_of(figure_.series.begin(), figure_.series.end(),
                                    [](const FigureSeries& s) { return s.kind == SeriesKind::points; });
    if (!bars || x_.from < x_.to)
        x_.pad(points && !bars && !cells ? 0.03 : 0);
    y_.pad(cells ? 0 : 0.05);
    if (bars && !y_.log && least == 0)
        y_.from = 0;
    if (!figure_.x_ticks.empty()) {
        x_.from = -0.6;
        x_.to = static_cast<double>(figure_.x_ticks.size()) - 0.4;
    } else if (bars && !x_.log && !empty_) {
        spacing_ = least_spacing(figure_);
        x_.from -= 0.6 * spacing_;
        x_.to += 0.6 * spacing_;
    }
    for (const auto& [range, axis] : {std::pair{&figure_.x_range, &x_}, {&figure_.y_range, &y_}})
        if (*range) {
            axis->from = (**range)[0];
            axis->to = (**range)[1];
        }
}

std::size_t FigurePanel::samples() const
{
    return figure_.series.size() > many_series ? most_samples / 2 : most_samples;
}

std::size_t FigurePanel::colour_number(std::size_t i) const
{
    if (!figure_.series[i].group)
        return i % series_colours.size();
    std::vector<std::string> seen; // the groups are counted instead
    for (std::size_t k = 0; k <= i; ++k)
        if (std::find(seen.begin(), seen.end(), group_of(figure_.series[k])) == seen.end())
            seen.push_back(group_of(figure_.series[k]));
    const auto place = std::find(seen.begin(), seen.end(), group_of(figure_.series[i]));
    return static_cast<std::size_t>(place - seen.begin()) % series_colours.size();
}

std::string FigurePanel::colour(std::size_t i) const
{
    const FigureSeries& s = figure_.series[i];
    return s.colour ? *s.colour : s.kind == SeriesKind::spans ? look_.axis() : look_.series(colour_number(i));
}

std::vector<std::size_t> FigurePanel::kept(const FigureSeries& s) const
{
    if (s.kind == SeriesKind::line && s.y.size() == s.x.size())
        return thinned(s.y, samples());
    const std::size_t stride = s.kind == SeriesKind::band ? std::max<std::size_t>(1, s.x.size() / most_samples) : 1;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < s.x.size(); i += stride)
        all.push_back(i);
    return all;
}

double FigurePanel::number_width() const
{
    double widest = 0;
    for (const PlotScale::Tic& tic : y_.tics())
        widest = std::max(widest, DrawingSheet::width(tic.text, look_.letters()));
    return widest;
}

double FigurePanel::room_left() const
{
    return number_width() + (figure_.y_label.empty() ? 14 : 38) * look_.unit;
}

bool FigurePanel::slanted(double frame_width) const
{
    double longest = 0;
    for (const std::string& name : figure_.x_ticks)
        longest = std::max(longest, DrawingSheet::width(name, look_.letters()));
    return longest > frame_width / (static_cast<double>(figure_.x_ticks.size()) + 0.2) - 8 * look_.unit;
}

double FigurePanel::room_below(double frame_width) const
{
    double room = 30 * look_.unit;
    if (!figure_.x_ticks.empty() && slanted(frame_width)) {
        double longest = 0;
        for (const std::string& name : figure_.x_ticks)
            longest = std::max(longest, DrawingSheet::width(name, look_.letters()));
        room = 26 * look_.unit + 0.58 * longest;
    }
    return room + (figure_.x_label.empty() ? 0 : 20 * look_.unit);
}

double FigurePanel::draw_legend(DrawingSheet& sheet, double left, double right, double top) const
{
    const double unit = look_.unit;
    double x = left, y = top + 9.5 * unit; // middle of the row
    bool any = false;
    for (std::size_t i = 0; i < figure_.series.size(); ++i) {
        const FigureSeries& s = figure_.series[i];
        const bool later =
            std::any_of(figure_.series.begin(), figure_.series.begin() + static_cast<std::ptrdiff_t>(i),
                        [&](const FigureSeries& one) { return !one.name.empty() && group_of(one) == group_of(s); });
        if (s.name.empty() || later)
            continue;
        const double length = 34 * unit + DrawingSheet::width(group_of(s), look_.letters()) + 14 * unit;
        if (x > left && x + length > right) {
            x = left;
            y += 19 * unit;
        }
        any = true;
        sheet.open(fmt::format("class=\"key\" data-group=\"{}\"", xml_escaped(group_of(s))));
        if (s.kind == SeriesKind::points)
            sheet.mark(mark(i), x + 13 * unit, y, 4 * unit, colour(i));
        else if (s.kind == SeriesKind::line && s.dashed)
            sheet.path({{x, y}, {x + 26 * unit, y}}, colour(i), 2 * unit, fmt::format("{} {}", 5 * unit, 4 * unit));
        else if (s.kind == SeriesKind::line)
            sheet.line(x, y, x + 26 * unit, y, colour(i), 2 * unit);
        else
            sheet.rectangle(x, y - 5 * unit, x + 26 * unit, y + 5 * unit, colour(i), "",
                            s.kind == SeriesKind::bars ? 0.8 : 0.22);
        sheet.text(group_of(s), x + 34 * unit, y, look_.letters(), TextAt::left, look_.ink());
        sheet.close();
        x += length;
    }
    return any ? y + 9.5 * unit - top : 0;
}

void FigurePanel::draw_x_numbers(DrawingSheet& sheet, const PlotFrame& frame) const
{
    const double unit = look_.unit;
    if (figure_.x_ticks.empty()) {
        // as many as have room, each as wide as six letters
        const double most = std::max(2.0, (frame.right - frame.left) / (5.5 * look_.letters()));
        double last = -1e9;
        for (const PlotScale::Tic& tic : x_.tics(std::min(most, 9.0))) {
            const double x = x_.px(tic.value), half = DrawingSheet::width(tic.text, look_.letters()) / 2;
            const bool fits = !tic.text.empty() && x - half > last + 4 * unit;
            sheet.line(x, frame.bottom, x, frame.bottom + (fits ? 5 : 3) * unit, look_.axis(), unit);
            if (!fits)
                continue;
            sheet.text(tic.text, x, frame.bottom + 15.5 * unit, look_.letters(), TextAt::center, look_.ink());
            last = x + half;
        }
        return;
    }
    for (std::size_t i = 0; i < figure_.x_ticks.size(); ++i) {
        const double x = x_.px(static_cast<double>(i));
        if (slanted(frame.right - frame.left))
            sheet.slanted_text(figure_.x_ticks[i], x + 4 * unit, frame.bottom + 16 * unit, look_.letters(),
                               look_.ink());
        else
            sheet.text(figure_.x_ticks[i], x, frame.bottom + 15.5 * unit, look_.letters(), TextAt::center, look_.ink());
    }
}

void FigurePanel::draw_axes(DrawingSheet& sheet, const PlotFrame& frame, bool x_labels, bool y_labels) const
{
    const double unit = look_.unit;
    const double most = std::max(3.0, (frame.bottom - frame.top) / (1.6 * look_.letters()));
    double last = 1e9;
    for (const PlotScale::Tic& tic : y_.tics(std::min(most, 8.0))) {
        const double y = y_.px(tic.value);
        if (figure_.cells.empty() && !tic.text.empty())
            sheet.line(frame.left, y, frame.right, y, look_.grid(), unit);
        else
            sheet.line(frame.left - 4 * unit, y, frame.left, y, look_.axis(), unit);
        if (!y_labels || tic.text.empty() || last - y < look_.letters())
            continue;
        sheet.text(tic.text, frame.left - 8 * unit, y, look_.letters(), TextAt::right, look_.ink());
        last = y;
    }
    if (x_labels)
        draw_x_numbers(sheet, frame);
    if (x_labels && !figure_.x_label.empty())
        sheet.text(figure_.x_label, (frame.left + frame.right) / 2,
                   frame.bottom + room_below(frame.right - frame.left) - 12 * unit,
                   DrawingSheet::fitting(figure_.x_label, frame.right - frame.left + 40 * unit, look_.letters()),
                   TextAt::center, look_.ink());
    if (y_labels && !figure_.y_label.empty())
        sheet.text(figure_.y_label,
                   std::max(8 * unit, frame.left - std::max(number_width() + 22 * unit, look_.page ? 68.0 : 0)),
                   (frame.top + frame.bottom) / 2,
                   DrawingSheet::fitting(figure_.y_label, frame.bottom - frame.top + 40 * unit, look_.letters()),
                   TextAt::center, look_.ink(), true);
}

void FigurePanel::draw(DrawingSheet& sheet, const PlotFrame& frame, bool x_labels, bool y_labels)
{
    x_.first_px = frame.left;
    x_.last_px = frame.right;
    y_.first_px = frame.bottom;
    y_.last_px = frame.top;
    draw_axes(sheet, frame, x_labels, y_labels);
    const bool beyond = figure_.x_range || figure_.y_range;
    if (beyond) // a mark on the frame is whole
        sheet.clip(frame.left - 6 * look_.unit, frame.top - 6 * look_.unit, frame.right + 6 * look_.unit,
                   frame.bottom + 6 * look_.unit);
    if (!figure_.cells.empty())
        draw_cells(sheet, frame);
    if (!look_.page) // no band lies on another's line; on a page a series with its band is one group, to be switched
        for (std::size_t i = 0; i < figure_.series.size(); ++i)
            if (const FigureSeries& s = figure_.series[i]; s.kind == SeriesKind::line && has_values(s))
                draw_band(sheet, s, colour(i));
    for (const SeriesKind kind :
         {SeriesKind::spans, SeriesKind::band, SeriesKind::bars, SeriesKind::line, SeriesKind::points})
        for (std::size_t i = 0; i < figure_.series.size(); ++i)
            if (figure_.series[i].kind == kind) {
                sheet.open(fmt::format("data-series=\"{}\"", i));
                draw_series(sheet, i);
                sheet.close();
            }
    if (beyond)
        sheet.close();
    sheet.line(frame.left, frame.bottom, frame.right, frame.bottom, look_.axis(), look_.unit);
    sheet.line(frame.left, frame.top, frame.left, frame.bottom, look_.axis(), look_.unit);
    if (empty_)
        sheet.text("no data", (frame.left + frame.right) / 2, (frame.top + frame.bottom) / 2, look_.letters(),
                   TextAt::center, look_.ink());
}

/// Each cell has its number, by which the script of a page finds it.
void FigurePanel::draw_cells(DrawingSheet& sheet, const PlotFrame& frame) const
{
    const double seam = 0.5 * look_.unit; // a cell reaches under its neighbours: no light comes between them
    sheet.open("shape-rendering=\"crispEdges\"");
    for (std::size_t k = 0; k < figure_.cells.size(); ++k) {
        const FigureCell& cell = figure_.cells[k];
        sheet.cell(x_.px(cell.left), y_.px(cell.low), std::min(x_.px(cell.right) + seam, frame.right),
                   std::max(y_.px(cell.high) - seam, frame.top),
                   fmt::format("data-cell=\"{}\" {}", k, look_.cell(cell.colour)));
    }
    sheet.close();
}

void FigurePanel::draw_series(DrawingSheet& sheet, std::size_t i) const
{
    const FigureSeries& s = figure_.series[i];
    const std::string tone = colour(i);
    if (s.kind == SeriesKind::band || (look_.page && s.kind == SeriesKind::line && has_values(s)))
        draw_band(sheet, s, tone);
    if (s.kind == SeriesKind::band || !has_values(s))
        return;
    if (s.kind == SeriesKind::spans)
        return draw_spans(sheet, s, tone);
    if (s.kind == SeriesKind::line)
        return draw_line(sheet, s, tone);
    if (s.kind == SeriesKind::bars)
        return draw_bars(sheet, s, tone);
    draw_error_bars(sheet, s, tone, 0);
    for (std::size_t k = 0; k < s.x.size(); ++k)
        if (shown(s.x[k], s.y[k]))
            sheet.mark(mark(i), x_.px(s.x[k]), y_.px(s.y[k]), s.weight * (s.x.size() > 300 ? 1.5 : 3.5) * look_.unit,
                       tone);
}

void FigurePanel::draw_error_bars(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone,
                                  double shift_px) const
{
    std::vector<std::array<double, 2>> ends;
    if (has_ends(s))
        for (std::size_t i = 0; i < s.x.size(); ++i)
            if (shown(s.x[i], s.low[i]) && shown(s.x[i], s.high[i])) {
                const double x = x_.px(s.x[i]) + shift_px;
                ends.insert(ends.end(), {{x, y_.px(s.low[i])}, {x, y_.px(s.high[i])}, {gap, gap}});
            }
    sheet.path(ends, tone, 1.5 * look_.unit);
}

void FigurePanel::draw_bars(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const
{
    const double half = bar_half_width(), shift_px = bar_shift(s) * 2 * half;
    for (std::size_t i = 0; i < s.x.size(); ++i)
        if (shown(s.x[i], s.y[i])) {
            const double x = x_.px(s.x[i]) + shift_px;
            sheet.rectangle(x - half, y_.px(y_.log ? y_.from : std::clamp(0.0, y_.from, y_.to)), x + half,
                            y_.px(s.y[i]), tone, "", 0.8);
        }
    draw_error_bars(sheet, s, look_.lines(), shift_px);
}

double FigurePanel::bar_series() const
{
    return static_cast<double>(std::count_if(figure_.series.begin(), figure_.series.end(),
                                             [](const FigureSeries& s) { return s.kind == SeriesKind::bars; }));
}

double FigurePanel::bar_half_width() const
{
    return std::min(28.0 * look_.unit, 0.36 * spacing_ * (x_.last_px - x_.first_px) / (x_.to - x_.from)) /
           (side_by_side_ ? std::max(1.0, bar_series()) : 1.0);
}

double FigurePanel::bar_shift(const FigureSeries& one) const
{
    if (!side_by_side_)
        return 0;
    double before = 0;
    for (const FigureSeries& s : figure_.series) {
        if (&s == &one)
            break;
        before += s.kind == SeriesKind::bars ? 1 : 0;
    }
    return before - (bar_series() - 1) / 2;
}

void FigurePanel::draw_spans(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const
{
    for (std::size_t i = 0; i < s.x.size(); ++i)
        if (x_.holds(s.x[i]) && x_.holds(s.y[i]))
            sheet.rectangle(x_.px(s.x[i]), y_.last_px, x_.px(s.y[i]), y_.first_px, tone, "", 0.16);
}

void FigurePanel::draw_line(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const
{
    std::vector<std::array<double, 2>> points;
    for (const std::size_t i : thinned(s.y, samples()))
        if (shown(s.x[i], s.y[i]))
            points.push_back({x_.px(s.x[i]), y_.px(s.y[i])});
        else
            points.push_back({gap, gap});
    sheet.path(points, tone, 1.6 * s.weight * look_.unit,
               s.dashed ? fmt::format("{} {}", 5 * look_.unit, 4 * look_.unit) : "");
}

void FigurePanel::draw_band(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const
{
    if (!has_ends(s))
        return;
    // each stretch without a gap is there and back
    std::vector<std::size_t> stretch;
    const auto close = [&] {
        std::vector<std::array<double, 2>> outline;
        for (const std::size_t i : stretch)
            outline.push_back({x_.px(s.x[i]), y_.px(s.high[i])});
        for (std::size_t k = stretch.size(); k-- > 0;)
            outline.push_back({x_.px(s.x[stretch[k]]), y_.px(s.low[stretch[k]])});
        sheet.polygon(outline, tone, "", 0, 0.22);
        stretch.clear();
    };
    const std::size_t stride = std::max<std::size_t>(1, s.x.size() / most_samples);
    for (std::size_t i = 0; i < s.x.size(); i += stride) {
        if (shown(s.x[i], s.low[i]) && shown(s.x[i], s.high[i]))
            stretch.push_back(i);
        else
            close();
    }
    close();
}

DrawingSheet FigurePanel::sheet(double height)
{
    constexpr double width = 900;
    constexpr double left = 86; // room for six digits and the label of the axis
    constexpr double right = 884;
    const double unit = look_.unit;
    DrawingSheet sheet({static_cast<int>(width * unit), 0}, look_.letters());
    const double top = 14 * unit + draw_legend(sheet, left * unit, right * unit, 4 * unit);
    const double bottom = top + height * unit;
    draw(sheet, {left * unit, top, right * unit, bottom});
    sheet.set_height(static_cast<int>(std::ceil(bottom + room_below((right - left) * unit))));
    return sheet;
}

void draw_colour_scale(DrawingSheet& sheet, const FigureLook& look, const PlotFrame& strip, PlotScale scale,
                       const std::string& label, const std::function<std::string(double value)>& colour)
{
    scale.first_px = strip.bottom;
    scale.last_px = strip.top;
    constexpr int steps = 64;
    sheet.open("class=\"scale\"");
    const double high = (strip.bottom - strip.top) / steps;
    for (int k = 0; k < steps; ++k) {
        const double part = (k + 0.5) / steps;
        sheet.cell(strip.left, strip.bottom - k * high, strip.right,
                   std::max(strip.bottom - (k + 1) * high - 0.5 * look.unit, strip.top),
                   look.cell(colour(scale.from + part * (scale.to - scale.from))));
    }
    double widest = 0;
    for (const PlotScale::Tic& tic : scale.tics()) {
        sheet.text(tic.text, strip.right + 6 * look.unit, scale.px(tic.value), look.letters(), TextAt::left,
                   look.ink());
        widest = std::max(widest, DrawingSheet::width(tic.text, look.letters()));
    }
    if (!label.empty())
        sheet.text(label,
                   strip.right + 20 * look.unit + (look.page ? 1.45 : 1) * widest, // type grows on narrow screens
                   (strip.top + strip.bottom) / 2,
                   DrawingSheet::fitting(label, strip.bottom - strip.top + 40 * look.unit, look.letters()),
                   TextAt::center, look.ink(), true);
    sheet.close();
}

} // namespace stylobate
