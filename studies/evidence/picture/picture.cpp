#include "studies/evidence/picture/picture.hpp"

#include "io/plots/colours.hpp"
#include "io/plots/figure_file.hpp"

#include <array>

namespace stylobate::verification {

namespace {

constexpr std::array<const char*, 4> fills{"#e8e8e8", "#a6cfe8", "#f4c9a0", "#a9dcc9"};

std::optional<std::array<double, 2>> range(const PictureAxis& axis)
{
    if (axis.from == 0 && axis.to == 0)
        return std::nullopt;
    return std::array{axis.from, axis.to};
}

FigureSeries drawn(const Series& s)
{
    FigureSeries out{s.title.value_or(""), s.line ? SeriesKind::line : SeriesKind::points, s.x, s.y, s.low, s.high};
    if (s.colour >= 0)
        out.colour = series_colours[static_cast<std::size_t>(s.colour) % series_colours.size()];
    out.weight = s.size;
    return out;
}

} // namespace

Figure curves(const PictureAxis& x, const PictureAxis& y, const std::vector<Series>& series)
{
    Figure figure;
    figure.x_label = x.label;
    figure.y_label = y.label;
    figure.x_log = x.log;
    figure.y_log = y.log;
    figure.x_range = range(x);
    figure.y_range = range(y);
    for (const Series& s : series)
        figure.series.push_back(drawn(s));
    return figure;
}

Figure map(const PictureAxis& x, const PictureAxis& y, const std::vector<double>& at_x, const std::vector<double>& at_y,
           const std::vector<int>& kind, const std::vector<std::string>& kinds, const std::vector<Series>& lines)
{
    Figure figure = curves(x, y, {});
    const double dx = (at_x[1] - at_x[0]) / 2, dy = (at_y[1] - at_y[0]) / 2;
    figure.x_range = {at_x.front() - dx, at_x.back() + dx};
    figure.y_range = {at_y.front() - dy, at_y.back() + dy};
    const auto fill = [](std::size_t k) { return fills[k % fills.size()]; };
    for (std::size_t j = 0; j < at_y.size(); ++j)
        for (std::size_t i = 0; i < at_x.size(); ++i)
            figure.cells.push_back({at_x[i] - dx, at_x[i] + dx, at_y[j] - dy, at_y[j] + dy,
                                    fill(static_cast<std::size_t>(kind[j * at_x.size() + i]))});
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        figure.series.push_back({kinds[k], SeriesKind::band, {}, {}, {}, {}}); // its entry of the legend
        figure.series.back().colour = fill(k);
    }
    for (const Series& line : lines) {
        figure.series.push_back(drawn(line));
        figure.series.back().colour = "#1f2933";
    }
    return figure;
}

void write_small(const std::vector<Figure>& figures, const std::filesystem::path& file)
{
    const PictureSize size{900 * static_cast<int>(figures.size()), 600};
    write_figures(figures, figures.size(), "", "", file, size, 1.4);
}

} // namespace stylobate::verification
