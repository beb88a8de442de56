#pragma once
/// Figures as SVG, for notebooks and for pages of other programs.

#include "stylobate/check.hpp"
#include "stylobate/study.hpp"
#include "stylobate/surface.hpp"
#include "stylobate/trajectory.hpp"

#include <string>
#include <vector>

namespace stylobate::api {

enum class SeriesKind {
    line,   ///< with lower and upper: a band about it
    points, ///< with lower and upper: error bars
    bars    ///< from 0; with lower and upper: error bars
};

/// NaN leaves a gap.
struct FigureSeries {
    std::string name; ///< in the legend; "": not listed there
    SeriesKind kind = SeriesKind::line;
    std::vector<double> x;
    std::vector<double> y;     ///< as many as x
    std::vector<double> lower; ///< as many as x, or empty
    std::vector<double> upper; ///< as many as x, or empty
    std::string group = {};    ///< series of one group have one colour, and one entry in the legend; "": it is alone
};

/// A figure as data.
struct Figure {
    std::string title = {}; ///< for readers who do not see it
    std::string x_label = {};
    std::string y_label = {}; ///< with unit: "displacement [m]"
    bool x_log = false;
    bool y_log = false;
    std::vector<std::string> x_ticks = {}; ///< names instead of numbers, at x = 0, 1, 2, ...; none: numbers
    std::vector<FigureSeries> series = {};
};

/// The figure in the look of the pages of `stylobate report`, on paper: one element `svg` that needs no style, no
/// script and no other file. Texts are escaped.
/// @throws InputError if the lists of a series have different lengths
std::string svg(const Figure& figure);

/// The map of a surface: each cell at its true extent, with contour lines at 0.05, 0.5 and 0.95; cells without a trial
/// are grey.
/// @throws InputError if an axis is empty or not ascending, or if an array does not fit the axes
std::string svg(const Surface& surface);

/// The structure of a study to scale with its dimensions, nothing drawn at random, as `Check::draw` draws it.
std::string svg(const Study& study);
std::string svg(const Check& check);

/// The structure at a time, as `write_svg` draws it.
/// @throws InputError if the arrays do not fit each other
std::string svg(const Trajectory& trajectory, double time_s);

} // namespace stylobate::api
