#pragma once
/// Small pictures of the pages, as scripts for `io/plots/gnuplot.hpp`.

#include "io/plots/gnuplot.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate::verification {

inline constexpr PictureSize picture_size{900, 600};

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
    bool right = false;                      ///< on the axis at the right
};

/// Curves and marks over one another.
/// @param right axis of the series that use it; nullopt: none does
/// @param key gnuplot's place of the legend
std::string curves(const PictureAxis& x, const PictureAxis& y, const std::vector<Series>& series,
                   const std::string& key = "top right", const std::optional<PictureAxis>& right = std::nullopt);

/// Cells of a grid in the colours of their kinds, with curves over them.
/// @param kind (y.size() x x.size()) index into `kinds`, row by row
std::string map(const PictureAxis& x, const PictureAxis& y, const std::vector<double>& at_x,
                const std::vector<double>& at_y, const std::vector<int>& kind, const std::vector<std::string>& kinds,
                const std::vector<Series>& lines);

} // namespace stylobate::verification
