#pragma once
/// Figures drawn on a sheet: the same lines for pages and for picture files.

#include "io/plots/figure.hpp"
#include "io/plots/plot_scale.hpp"
#include "io/plots/sheet.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace stylobate {

/// How figures look on a sheet.
struct FigureLook {
    double unit = 1;   ///< pixels of the sheet for each pixel of a page
    bool page = false; ///< colours are those of the page's style, which change with its light

    double letters() const { return 13 * unit; } ///< height of the type
    std::string series(std::size_t number) const;
    std::string axis() const { return page ? "var(--axis)" : "#5a6672"; }
    std::string grid() const { return page ? "var(--grid)" : "#dfe3e7"; }
    std::string ink() const { return page ? "" : "#1f2933"; } ///< of texts
    /// Attributes of a cell. @param colour "#rrggbb"; "": nothing is known there
    std::string cell(const std::string& colour) const;
    std::string lines() const { return page ? "var(--ink)" : "#1f2933"; }
};

/// Look of a picture file of a width of 1800 pixels.
inline constexpr FigureLook picture_look{2.25, false};

/// Where a plot's data lie on a sheet [px].
struct PlotFrame {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// One figure on a sheet. Bars of several series stand side by side where they meet. What is not finite, or not
/// positive on a logarithmic axis, is left out; without any point there are empty axes with a note. Lines of more
/// samples than the width has pixels are drawn by the least and the greatest of neighbours.
class FigurePanel {
public:
    /// @param figure must outlive the panel
    FigurePanel(const Figure& figure, FigureLook look);

    /// Room for numbers and label at the left of the frame, and below it [px].
    double room_left() const;
    double room_below(double frame_width) const;

    /// The names of the series, in as many rows as they need. @returns the height of these [px]
    double draw_legend(DrawingSheet& sheet, double left, double right, double top) const;
    /// The axes and all series. @param labels whether the axes have their labels, along x and along y
    void draw(DrawingSheet& sheet, const PlotFrame& frame, bool x_labels = true, bool y_labels = true);

    /// The whole figure on a sheet of its own: legend, axes, series. @param height of the frame [px of a page]
    DrawingSheet sheet(double height);

    /// The axes, as drawn.
    const PlotScale& x() const { return x_; }
    const PlotScale& y() const { return y_; }
    /// Series of one group share the number of the first of them.
    std::size_t colour_number(std::size_t series) const;
    /// The samples of a series that are drawn.
    std::vector<std::size_t> kept(const FigureSeries& s) const;
    static const std::string& group_of(const FigureSeries& s) { return s.group ? *s.group : s.name; }

private:
    std::string colour(std::size_t series) const;
    MarkShape mark(std::size_t series) const { return static_cast<MarkShape>(colour_number(series) % marks); }
    double number_width() const;
    bool slanted(double frame_width) const;
    void set_ranges();
    void draw_axes(DrawingSheet& sheet, const PlotFrame& frame, bool x_labels, bool y_labels) const;
    void draw_x_numbers(DrawingSheet& sheet, const PlotFrame& frame) const;
    void draw_cells(DrawingSheet& sheet, const PlotFrame& frame) const;
    void draw_series(DrawingSheet& sheet, std::size_t i) const;
    void draw_band(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const;
    void draw_line(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const;
    void draw_error_bars(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone, double shift_px) const;
    void draw_bars(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const;
    void draw_spans(DrawingSheet& sheet, const FigureSeries& s, const std::string& tone) const;
    double bar_series() const;
    double bar_half_width() const;
    double bar_shift(const FigureSeries& one) const;
    bool shown(double x, double y) const { return x_.holds(x) && y_.holds(y); }
    std::size_t samples() const;

    const Figure& figure_;
    const FigureLook look_;
    PlotScale x_, y_;
    bool side_by_side_ = false;
    bool empty_ = false;
    double spacing_ = 1; ///< of bars [unit of x]
};

/// A strip of colours with its numbers and its label at its right.
/// @param colour of a value of the scale, "#rrggbb"   @param scale its pixels are set here
void draw_colour_scale(DrawingSheet& sheet, const FigureLook& look, const PlotFrame& strip, PlotScale scale,
                       const std::string& label, const std::function<std::string(double value)>& colour);

} // namespace stylobate
