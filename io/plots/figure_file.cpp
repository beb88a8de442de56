#include "io/plots/figure_file.hpp"

#include <algorithm>

namespace stylobate {

namespace {

/// The entries of a figure's legend.
std::vector<std::string> names_of(const Figure& figure)
{
    std::vector<std::string> names;
    for (const FigureSeries& s : figure.series)
        if (!s.name.empty() && std::find(names.begin(), names.end(), s.name) == names.end())
            names.push_back(s.name);
    return names;
}

} // namespace

void write_figure(const Figure& figure, const std::string& title, const std::string& subtitle,
                  const std::filesystem::path& file, PictureSize size)
{
    const FigureLook look{size.width / 800.0, false};
    DrawingSheet sheet(size, look.letters());
    FigurePanel panel(figure, look);
    PlotFrame frame;
    frame.top = sheet.heading(title, subtitle);
    frame.left = 20 * look.unit + panel.room_left();
    frame.right = size.width - 24 * look.unit;
    frame.top += panel.draw_legend(sheet, frame.left, frame.right, frame.top) + 8 * look.unit;
    frame.bottom = size.height - 12 * look.unit - panel.room_below(frame.right - frame.left);
    panel.draw(sheet, frame);
    sheet.write(file);
}

void write_figures(const std::vector<Figure>& figures, std::size_t columns, const std::string& title,
                   const std::string& subtitle, const std::filesystem::path& file, PictureSize size, double unit)
{
    const FigureLook look{unit > 0 ? unit : size.width / 900.0, false};
    unit = look.unit;
    const double margin = 16 * unit;
    DrawingSheet sheet(size, look.letters());
    double top = title.empty() ? 4 * unit : sheet.heading(title, subtitle);
    const bool one_legend = std::all_of(figures.begin(), figures.end(), [&](const Figure& figure) {
        return names_of(figure).empty() || names_of(figure) == names_of(figures.front());
    });
    if (one_legend && !figures.empty())
        top += FigurePanel(figures.front(), look).draw_legend(sheet, 2 * margin, size.width - margin, top);
    const std::size_t rows = (figures.size() + columns - 1) / columns;
    const double wide = (size.width - 2 * margin) / static_cast<double>(columns);
    const double high = (size.height - margin - top) / static_cast<double>(std::max<std::size_t>(rows, 1));
    std::vector<double> room(columns, 0); // frames below one another begin at one place
    for (std::size_t k = 0; k < figures.size(); ++k)
        room[k % columns] = std::max(room[k % columns], FigurePanel(figures[k], look).room_left());
    for (std::size_t k = 0; k < figures.size(); ++k) {
        FigurePanel panel(figures[k], look);
        const double left = margin + wide * static_cast<double>(k % columns);
        const double above = top + high * static_cast<double>(k / columns);
        PlotFrame frame{left + room[k % columns], above + 10 * unit, left + wide - 10 * unit, 0};
        if (!figures[k].title.empty()) {
            sheet.text(figures[k].title, (frame.left + frame.right) / 2, above + 14 * unit,
                       DrawingSheet::fitting(figures[k].title, wide - 2 * margin, 1.1 * look.letters()), TextAt::center,
                       look.ink());
            frame.top += 18 * unit;
        }
        if (!one_legend)
            frame.top += panel.draw_legend(sheet, frame.left, frame.right, frame.top - 6 * unit);
        frame.bottom = above + high - 6 * unit - panel.room_below(frame.right - frame.left);
        panel.draw(sheet, frame);
    }
    sheet.write(file);
}

} // namespace stylobate
