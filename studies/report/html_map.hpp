#pragma once
/// A map of cells over two axes, drawn as SVG.

#include "io/plots/plot_surface.hpp"
#include "studies/report/html.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Cells x by y, the y within each x: value[i * y.size() + j].
struct CellMap {
    std::string title; ///< for readers who do not see it
    std::string x_label, y_label, value_label;
    std::vector<double> x, y;             ///< (nx), (ny) values of the cells
    std::vector<double> x_edges, y_edges; ///< (nx + 1), (ny + 1) of the cells, in [0, 1]
    std::vector<double> value;            ///< (nx x ny) in [0, 1]; NaN: nothing is known, the cell is grey
    std::vector<SurfaceContour> contours;
};

/// For the script of the page (cells.js) each cell has its number in `data-cell`, and the drawing in `data-frame` left,
/// top, width and height of the frame; contours and colour scale are groups that it draws anew.
/// @pre all sizes fit
Html map_svg(const CellMap& map);

} // namespace stylobate
