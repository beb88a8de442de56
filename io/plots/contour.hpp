#pragma once
/// Contour lines of a function on a rectangular grid, by marching squares.

#include <vector>

namespace stylobate {

struct ContourPoint {
    double x = 0;
    double y = 0;
};

/// A closed line repeats its first point at the end.
using ContourLine = std::vector<ContourPoint>;

/// The lines on which z, bilinear along the edges of the grid, is `level`. A saddle is cut by the mean of its corners;
/// squares with a corner that is not finite have no line.
///
/// @param x (nx), y (ny) the grid's coordinates, ascending
/// @param z (nx x ny) row by row: z[i * ny + j] at (x[i], y[j])
std::vector<ContourLine> contour_lines(const std::vector<double>& x, const std::vector<double>& y,
                                       const std::vector<double>& z, double level);

} // namespace stylobate
