#pragma once
/// Small pictures of the pages: curves, marks and maps, as figures (`io/plots/figure_panel.hpp`).

#include "io/plots/figure_panel.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::verification {

struct PictureAxis {
    std::string label;
    bool log = false;
    double from = 0, to = 0; ///< both 0: as the data need it
};

struct Series {
    std::optional<std::string> title; ///< in the legend; nullopt: it is not listed
    std::vector<double> x = {}, y = {};
    bool line = false;                       ///< joined, without marks; else marks alone
    std::vector<double> low = {}, high = {}; ///< ends of error bars, or empty
    int colour = -1;                         ///< a number of the palette; -1: that of its place in the list
    double size = 1;                         ///< of its marks
};

/// Curves and marks over one another.
Figure curves(const PictureAxis& x, const PictureAxis& y, const std::vector<Series>& series);

/// Cells of a grid in the colours of their kinds, which the legend names, with curves over them.
/// @param kind (y.size() x x.size()) index into `kinds`, row by row
Figure map(const PictureAxis& x, const PictureAxis& y, const std::vector<double>& at_x, const std::vector<double>& at_y,
           const std::vector<int>& kind, const std::vector<std::string>& kinds, const std::vector<Series>& lines);

/// A picture without a heading, as wide as a page's text; several figures stand side by side.
/// @throws InputError as `write_picture`
void write_small(const std::vector<Figure>& figures, const std::filesystem::path& file);

} // namespace stylobate::verification
