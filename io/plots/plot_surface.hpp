#pragma once
/// The picture of a surface of the probability of a limit state.

#include "io/plots/figure_panel.hpp"
#include "io/store/result_store.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// A second pair of surfaces around the one that is drawn.
struct SurfaceRange {
    std::string words;             ///< "contact law: 0.61 to 0.88": below the title
    std::vector<double> low, high; ///< (cells)
};

/// Draws a heat map of the probability over frequency (or direction) and PGA (1800 x 1350 pixels): each cell at its
/// true extent, an axis logarithmic where its values are spaced so, cells without a trial grey, contour lines at 0.05,
/// 0.5 and 0.95. Below the title: the number of realizations and the interval.
///
/// @param limit what the probability is one of: "collapse"
/// @param png the file; its folder must exist
/// @param range the contour lines 0.5 of its two surfaces are dashed
/// @throws InputError if the table has no axes or its arrays do not fit them, or if
///         the picture cannot be written
void plot_surface(const SurfaceTable& surface, const std::string& limit, const std::string& title,
                  const std::filesystem::path& png, const std::optional<SurfaceRange>& range = {});

/// The cells over the axes of a surface, as a figure.
/// @param colour of a cell, "#rrggbb"; "": nothing is known there
/// @throws InputError if an axis is empty or not ascending
Figure cells_figure(const SurfaceAxes& axes, const std::function<std::string(std::size_t cell)>& colour);

/// The map of `plot_surface` on a sheet, for pages and notebooks: cells, axes, contour lines and a scale of colours.
/// The contour lines and the scale are groups of the classes "contours" and "scale", and each cell has its number in
/// `data-cell`, so that the script of a page can paint them anew.
/// @param room for all of it   @returns the frame of the cells
/// @throws InputError as `plot_surface` does, of the axes and the range
PlotFrame draw_surface(DrawingSheet& sheet, const FigureLook& look, const SurfaceTable& surface,
                       const std::string& limit, const PlotFrame& room, const std::optional<SurfaceRange>& range = {});

// The picture of fragility slices: the probability of a limit state against PGA at given frequencies or directions.

/// Draws one curve with its interval (as a band, and as bars at the cells) for each of the surface's rows that are
/// nearest to the values asked for, on the axis' scale; a row that is nearest to two of them is drawn once.
///
/// @param wanted frequencies or directions, at most 6; empty: up to three rows spread evenly over the axis
/// @param limit what the probability is one of: "collapse"
/// @throws InputError if more are asked for, if one is beyond the axis, and as `plot_surface` does
void plot_slice(const SurfaceTable& surface, const std::vector<double>& wanted, const std::string& limit,
                const std::string& title, const std::filesystem::path& png);

/// The rows that `plot_slice` draws, ascending.
std::vector<std::size_t> slice_rows(const SurfaceTable& surface, const std::vector<double>& wanted);

} // namespace stylobate
