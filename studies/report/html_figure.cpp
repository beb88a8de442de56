#include "studies/report/html_figure.hpp"

#include "io/files/utf8.hpp"
#include "studies/report/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

constexpr double width = 900;
constexpr double left = 86; ///< room for six digits and the label of the axis
constexpr double right = 884;
constexpr double letter = 7.1;             ///< a letter's mean width at the font's size [px]
constexpr std::size_t most_samples = 1600; ///< of a line
constexpr std::size_t many_series = 3;     ///< of a figure with more of them lines have half as many samples

constexpr std::size_t colours = 7; ///< of series: --s0 to --s6 of the page's style

double letters(std::string_view text)
{
    double count = 0;
    for (; !text.empty(); ++count)
        text.remove_prefix(std::max<std::size_t>(utf8_length(text), 1));
    return count;
}

/// An axis: its range in values, and where these lie in pixels.
struct FigureAxis {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    bool log = false;
    double first_px = 0;
    double last_px = 0;

    bool holds(double value) const { return std::isfinite(value) && (!log || value > 0); }
    void include(double value)
    {
        if (!holds(value))
            return;
        from = std::min(from, value);
        to = std::max(to, value);
    }
    bool empty() const { return from > to; }
    double scaled(double value) const { return log ? std::log10(value) : value; }
    /// Room at both ends, a share of the range; and some range where there is none.
    void pad(double share)
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
    double px(double value) const
    {
        const double part = (scaled(value) - scaled(from)) / (scaled(to) - scaled(from));
        return first_px + part * (last_px - first_px);
    }

    std::vector<double> tics() const
    {
        std::vector<double> tics;
        if (log) {
            const bool few = scaled(to) - scaled(from) < 2.5;
            for (double decade = std::floor(scaled(from)); decade <= scaled(to); ++decade)
                for (const double k : {1.0, 2.0, 5.0})
                    if (const double tic = k * std::pow(10, decade);
                        (k == 1 || few) && tic >= from * (1 - 1e-9) && tic <= to * (1 + 1e-9))
                        tics.push_back(tic);
            return tics;
        }
        const double rough = (to - from) / 6;
        const double decade = std::pow(10, std::floor(std::log10(rough)));
        const double step = decade * (rough < 1.5 * decade   ? 1
                                      : rough < 3.5 * decade ? 2
                                      : rough < 7.5 * decade ? 5
                                                             : 10);
        for (double i = std::ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i)
            tics.push_back(i == 0 ? 0 : i * step);
        return tics;
    }
};

/// "0.25", "2.5e-4": of more than six letters the shorter one, as they would reach the label of the axis.
std::string tick_text(double value)
{
    constexpr std::size_t room = 6;
    std::string text = fmt::format("{:.6g}", value), power = fmt::format("{:.5e}", value);
    if (text.size() <= room)
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
        kept.push_back(std::min(low, high));
        if (low != high)
            kept.push_back(std::max(low, high));
    }
    return kept;
}

std::string path(const std::string& data, const std::string& look)
{
    return data.empty() ? "" : "<path d=\"" + data + "\" " + look + "/>\n";
}

class Drawing {
public:
    Drawing(const Figure& figure, double height) : figure_(figure), height_(height)
    {
        side_by_side_ = bars_meet(figure);
        x_.log = figure.x_log && figure.x_ticks.empty();
        y_.log = figure.y_log;
        const bool bars = bar_series() > 0;
        for (const FigureSeries& s : figure.series) {
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
        empty_ = x_.empty() || y_.empty();
        if (bars && !y_.log)
            y_.include(0);
        const double least = y_.from;
        const bool points = std::any_of(figure.series.begin(), figure.series.end(),
                                        [](const FigureSeries& s) { return s.kind == SeriesKind::points; });
        if (!bars || x_.from < x_.to)
            x_.pad(points && !bars ? 0.03 : 0);
        y_.pad(0.05);
        if (bars && !y_.log && least == 0)
            y_.from = 0;
        if (!figure.x_ticks.empty()) {
            x_.from = -0.6;
            x_.to = static_cast<double>(figure.x_ticks.size()) - 0.4;
        } else if (bars && !x_.log && !empty_) {
            spacing_ = least_spacing(figure);
            x_.from -= 0.6 * spacing_;
            x_.to += 0.6 * spacing_;
        }
        x_.first_px = left;
        x_.last_px = right;
    }

    std::string svg()
    {
        const std::string legend_text = legend();
        const double top = 14 + legend_height_;
        const double bottom = top + height_;
        y_.first_px = bottom;
        y_.last_px = top;
        const std::string axes_text = axes(top, bottom);
        std::string marks;
        for (const SeriesKind kind :
             {SeriesKind::spans, SeriesKind::band, SeriesKind::bars, SeriesKind::line, SeriesKind::points})
            for (std::size_t i = 0; i < figure_.series.size(); ++i)
                if (figure_.series[i].kind == kind)
                    marks += fmt::format("<g data-series=\"{}\">\n{}</g>\n", i, series(figure_.series[i], colour(i)));
        if (empty_)
            marks = svg_text((left + right) / 2, (top + bottom) / 2, "middle", "no data");
        return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" "
                           "role=\"img\" aria-label=\"{}\" font-family=\"inherit\" font-size=\"13\">\n{}{}{}</svg>",
                           width, bottom + below_, width, html_escaped(figure_.title), legend_text, axes_text, marks);
    }

    /// What the script reads (figure.js). @pre svg() was called
    std::string json() const
    {
        Json all = Json::list();
        for (std::size_t i = 0; i < figure_.series.size(); ++i) {
            const FigureSeries& s = figure_.series[i];
            const std::vector<std::size_t> kept = kept_of(s);
            const auto values = [&](const std::vector<double>& v) {
                std::vector<double> drawn;
                for (std::size_t k = 0; k < kept.size() && v.size() == s.x.size(); ++k)
                    drawn.push_back(v[kept[k]]);
                return Json::brief(drawn);
            };
            all.item(Json::object()
                         .member("name", s.name)
                         .member("group", group_of(s))
                         .member("layer", s.layer.value_or(""))
                         .member("kind", s.kind == SeriesKind::spans  ? "spans"
                                         : s.kind == SeriesKind::bars ? "bars"
                                                                      : "values")
                         .member("colour", colour_number(i))
                         .member("x", values(s.x))
                         .member("y", values(s.kind == SeriesKind::band ? std::vector<double>{} : s.y))
                         .member("low", values(s.low))
                         .member("high", values(s.high)));
        }
        return Json::object()
            .member("x", axis_json(x_, figure_.x_label, figure_.x_ticks))
            .member("y", axis_json(y_, figure_.y_label, {}))
            .member("series", all)
            .text();
    }

private:
    std::size_t samples() const { return figure_.series.size() > many_series ? most_samples / 2 : most_samples; }
    static const std::string& group_of(const FigureSeries& s) { return s.group ? *s.group : s.name; }

    /// Series of one group share that of the first of them.
    std::size_t colour_number(std::size_t i) const
    {
        std::size_t number = i;
        if (figure_.series[i].group) { // the groups are counted instead
            std::vector<std::string> seen;
            for (std::size_t k = 0; k <= i; ++k)
                if (std::find(seen.begin(), seen.end(), group_of(figure_.series[k])) == seen.end())
                    seen.push_back(group_of(figure_.series[k]));
            number = static_cast<std::size_t>(std::find(seen.begin(), seen.end(), group_of(figure_.series[i])) -
                                              seen.begin());
        }
        return number % colours;
    }
    std::string colour(std::size_t i) const
    {
        return figure_.series[i].kind == SeriesKind::spans ? "var(--axis)"
                                                           : fmt::format("var(--s{})", colour_number(i));
    }

    static Json axis_json(const FigureAxis& axis, const std::string& label, const std::vector<std::string>& ticks)
    {
        return Json::object()
            .member("from", axis.from)
            .member("to", axis.to)
            .member("log", axis.log)
            .member("first", axis.first_px)
            .member("last", axis.last_px)
            .member("label", label)
            .member("ticks", Json::list(ticks));
    }

    /// The samples that are drawn.
    std::vector<std::size_t> kept_of(const FigureSeries& s) const
    {
        if (s.kind == SeriesKind::line && s.y.size() == s.x.size())
            return thinned(s.y, samples());
        const std::size_t stride = s.kind == SeriesKind::band ? std::max<std::size_t>(1, s.x.size() / most_samples) : 1;
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < s.x.size(); i += stride)
            kept.push_back(i);
        return kept;
    }

    std::string legend()
    {
        std::string out;
        double x = left, y = 14;
        for (std::size_t i = 0; i < figure_.series.size(); ++i) {
            const FigureSeries& s = figure_.series[i];
            const bool later =
                std::any_of(figure_.series.begin(), figure_.series.begin() + static_cast<std::ptrdiff_t>(i),
                            [&](const FigureSeries& one) { return !one.name.empty() && group_of(one) == group_of(s); });
            if (s.name.empty() || later)
                continue;
            const double length = 34 + letter * letters(s.name) + 14;
            if (x > left && x + length > right) {
                x = left;
                y += 19;
            }
            out += fmt::format("<g class=\"key\" data-group=\"{}\">", html_escaped(group_of(s)));
            if (s.kind == SeriesKind::points)
                out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" style=\"fill:{}\"/>\n", x + 13,
                                   y - 4.5, colour(i));
            else
                out += fmt::format(
                    "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"26\" height=\"{}\" style=\"fill:{}\"{}/>\n", x,
                    y - (s.kind == SeriesKind::line ? 5.5 : 10), s.kind == SeriesKind::line ? 2 : 10, colour(i),
                    s.kind == SeriesKind::band || s.kind == SeriesKind::spans ? " fill-opacity=\"0.22\"" : "");
            out += svg_text(x + 34, y, "start", s.name) + "</g>\n";
            x += length;
        }
        legend_height_ = out.empty() ? 0 : y + 4;
        return out;
    }

    std::string axes(double top, double bottom)
    {
        std::string out;
        for (const double tic : y_.tics()) {
            out += svg_rule(left, y_.px(tic), right, y_.px(tic), "grid");
            out += svg_text(left - 8, y_.px(tic) + 4.5, "end", tick_text(tic));
        }
        below_ = 30;
        if (figure_.x_ticks.empty()) {
            for (const double tic : x_.tics()) {
                out += svg_rule(x_.px(tic), bottom, x_.px(tic), bottom + 5, "axis");
                out += svg_text(x_.px(tic), bottom + 20, "middle", fmt::format("{:.6g}", tic));
            }
        } else {
            double longest = 0;
            for (const std::string& name : figure_.x_ticks)
                longest = std::max(longest, letter * letters(name));
            const double room = (right - left) / (static_cast<double>(figure_.x_ticks.size()) + 0.2);
            const bool slanted = longest > room - 8;
            for (std::size_t i = 0; i < figure_.x_ticks.size(); ++i) {
                const double x = x_.px(static_cast<double>(i));
                if (slanted)
                    out += svg_text(x + 4, bottom + 16, "end", figure_.x_ticks[i],
                                    fmt::format(" transform=\"rotate(-35 {:.1f} {:.1f})\"", x + 4, bottom + 16));
                else
                    out += svg_text(x, bottom + 20, "middle", figure_.x_ticks[i]);
            }
            if (slanted)
                below_ = 26 + 0.58 * longest;
        }
        out += svg_rule(left, bottom, right, bottom, "axis");
        out += svg_rule(left, top, left, bottom, "axis");
        if (!figure_.x_label.empty()) {
            below_ += 20;
            out += svg_text((left + right) / 2, bottom + below_ - 8, "middle", figure_.x_label);
        }
        const double middle = (top + bottom) / 2;
        if (!figure_.y_label.empty())
            out += svg_text(18, middle, "middle", figure_.y_label,
                            fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle));
        return out;
    }

    bool shown(double x, double y) const { return x_.holds(x) && y_.holds(y); }
    std::string point(double x, double y) const { return fmt::format("{:.1f} {:.1f}", x_.px(x), y_.px(y)); }

    std::string error_bars(const FigureSeries& s, const std::string& tone, double shift_px) const
    {
        std::string data;
        if (has_ends(s))
            for (std::size_t i = 0; i < s.x.size(); ++i)
                if (shown(s.x[i], s.low[i]) && shown(s.x[i], s.high[i]))
                    data += fmt::format("M{0:.1f} {1:.1f}L{0:.1f} {2:.1f}", x_.px(s.x[i]) + shift_px, y_.px(s.low[i]),
                                        y_.px(s.high[i]));
        return path(data, "style=\"stroke:" + tone + "\" stroke-width=\"1.5\" fill=\"none\"");
    }

    std::string series(const FigureSeries& s, const std::string& tone) const
    {
        if (s.kind == SeriesKind::band)
            return band(s, tone);
        if (!has_values(s))
            return "";
        if (s.kind == SeriesKind::spans)
            return spans(s, tone);
        if (s.kind == SeriesKind::line)
            return band(s, tone) + line(s, tone);
        const double half = bar_half_width();
        const double shift_px = s.kind == SeriesKind::bars ? bar_shift(s) * 2 * half : 0;
        std::string out;
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            if (!shown(s.x[i], s.y[i]))
                continue;
            if (s.kind == SeriesKind::points) {
                out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" style=\"fill:{}\"/>\n", x_.px(s.x[i]),
                                   y_.px(s.y[i]), s.x.size() > 300 ? 1.5 : 3.5, tone);
            } else {
                const double base = y_.px(y_.log ? y_.from : std::clamp(0.0, y_.from, y_.to));
                const double end = y_.px(s.y[i]);
                const double x = x_.px(s.x[i]) + shift_px;
                out +=
                    fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"fill:{}\" "
                                "fill-opacity=\"0.8\"/>\n",
                                x - half, std::min(base, end), 2 * half, std::abs(base - end), tone);
            }
        }
        return out + error_bars(s, s.kind == SeriesKind::bars ? "var(--ink)" : tone, shift_px);
    }

    /// Series of bars stand side by side.
    double bar_series() const
    {
        return static_cast<double>(std::count_if(figure_.series.begin(), figure_.series.end(),
                                                 [](const FigureSeries& s) { return s.kind == SeriesKind::bars; }));
    }
    double bar_half_width() const
    {
        return std::min(28.0, 0.36 * spacing_ * (right - left) / (x_.to - x_.from)) /
               (side_by_side_ ? std::max(1.0, bar_series()) : 1.0);
    }
    double bar_shift(const FigureSeries& one) const
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

    std::string spans(const FigureSeries& s, const std::string& tone) const
    {
        std::string out;
        for (std::size_t i = 0; i < s.x.size(); ++i)
            if (x_.holds(s.x[i]) && x_.holds(s.y[i]))
                out += fmt::format(
                    "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"fill:{}\" "
                    "fill-opacity=\"0.16\"/>\n",
                    x_.px(s.x[i]), y_.last_px, x_.px(s.y[i]) - x_.px(s.x[i]), y_.first_px - y_.last_px, tone);
        return out;
    }

    std::string line(const FigureSeries& s, const std::string& tone) const
    {
        std::string data;
        bool open = false;
        for (const std::size_t i : thinned(s.y, samples())) {
            if (!shown(s.x[i], s.y[i])) {
                open = false;
                continue;
            }
            data += (open ? "L" : "M") + point(s.x[i], s.y[i]);
            open = true;
        }
        return path(data, "style=\"stroke:" + tone + "\" stroke-width=\"1.6\" stroke-linejoin=\"round\" fill=\"none\"");
    }

    std::string band(const FigureSeries& s, const std::string& tone) const
    {
        if (!has_ends(s))
            return "";
        // each stretch without a gap is there and back
        std::string data;
        std::vector<std::size_t> stretch;
        const auto close = [&] {
            for (std::size_t k = 0; k < stretch.size(); ++k)
                data += (k == 0 ? "M" : "L") + point(s.x[stretch[k]], s.high[stretch[k]]);
            for (std::size_t k = stretch.size(); k-- > 0;)
                data += "L" + point(s.x[stretch[k]], s.low[stretch[k]]);
            data += stretch.empty() ? "" : "Z";
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
        return path(data, "style=\"fill:" + tone + "\" fill-opacity=\"0.22\" stroke=\"none\"");
    }

    const Figure& figure_;
    const double height_;
    FigureAxis x_, y_;
    bool side_by_side_ = false;
    bool empty_ = false;
    double spacing_ = 1; ///< of bars [unit of x]
    double legend_height_ = 0;
    double below_ = 0;
};

} // namespace

std::string svg_text(double x, double y, const char* anchor, const std::string& text, const std::string& more)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       html_escaped(text));
}

std::string svg_rule(double x1, double y1, double x2, double y2, const char* look)
{
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2, y2,
                       look);
}

Html figure_svg(const Figure& figure, double height)
{
    Drawing drawing(figure, height);
    Html html = Html::ready(drawing.svg());
    html += data_script("class=\"figure-data\"", drawing.json());
    return html;
}

std::string figure_drawing(const Figure& figure, double height)
{
    return Drawing(figure, height).svg();
}

Html bar_svg(double value, std::optional<double> mark, double most)
{
    constexpr double length = 96;
    const auto px = [&](double v) { return std::clamp(v / most, 0.0, 1.0) * length; };
    std::string svg =
        fmt::format("<svg width=\"{0:.0f}\" height=\"12\" viewBox=\"0 0 {0:.0f} 12\" aria-hidden=\"true\">"
                    "<rect y=\"2\" width=\"{1:.1f}\" height=\"8\" style=\"fill:{2}\"/>",
                    length + 2, px(value), mark && value > *mark ? "var(--s0)" : "var(--ground)");
    if (mark)
        svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"0\" y2=\"12\" style=\"stroke:var(--bad)\" "
                           "stroke-width=\"1.6\"/>",
                           px(*mark) + 0.8);
    return Html::ready(svg + "</svg>");
}

} // namespace stylobate
