#pragma once
/// A figure as plain data. Pages, pictures and programs that show it draw it by `figure_panel.hpp`.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

enum class SeriesKind {
    line,   ///< x, y; with low and high: a band about it
    points, ///< x, y; with low and high: error bars
    band,   ///< x, low, high; y is empty
    bars,   ///< x, y from 0; with low and high: error bars
    spans   ///< stretches of the axis from x to y, marked over the whole height
};

/// NaN in y, low or high leaves a gap.
struct FigureSeries {
    std::string name; ///< under the pointer; "" where the legend does not list it
    SeriesKind kind = SeriesKind::line;
    std::vector<double> x;
    std::vector<double> y;    ///< as many as x; of a band: empty
    std::vector<double> low;  ///< as many as x, or empty
    std::vector<double> high; ///< as many as x, or empty
    // The file of a diagnosis does not keep these.
    std::optional<std::string> group =
        {}; ///< has one colour and one entry of the legend, its own name; nullopt: that of the series
    std::optional<std::string> layer = {};  ///< what of its group it is ("fitted curve"); layers can be switched off
    std::optional<std::string> colour = {}; ///< "#rrggbb"; nullopt: that of its place in the list
    bool dashed = false;
    bool shown = true; ///< at first, where a page runs its script; the legend switches the group on
    double weight = 1; ///< width of its line, size of its points; in ordinary ones
};

/// A rectangle of one colour: a cell of a map.
struct FigureCell {
    double left = 0, right = 0, low = 0, high = 0;
    std::string colour; ///< "#rrggbb"; "": nothing is known there
};

/// A figure as data; who shows it draws it.
struct Figure {
    std::string title;
    std::string caption;
    std::string x_label; ///< with unit: "time [s]"
    std::string y_label;
    bool x_log = false;
    bool y_log = false;
    std::vector<std::string> x_ticks; ///< names instead of numbers, at x = 0, 1, 2, ...; none: numbers
    std::vector<FigureSeries> series;
    // The file of a diagnosis does not keep these.
    std::optional<std::array<double, 2>> x_range = {}; ///< nullopt: as the data need it
    std::optional<std::array<double, 2>> y_range = {};
    std::vector<FigureCell> cells = {}; ///< below the series
};

} // namespace stylobate
