#pragma once
/// The picture of a surface of the probability of a limit state.

#include "io/plots/contour.hpp"
#include "io/store/result_store.hpp"

#include <filesystem>
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

/// The contour lines of one probability, and where its name is best written, in the unit square of the picture's frame
/// (an axis logarithmic where its values are spaced so).
struct SurfaceContour {
    double level = 0;
    std::vector<ContourLine> lines; ///< none: the surface does not reach it
    ContourPoint label;             ///< where there is a line
};
/// At 0.05, 0.5 and 0.95.
/// @throws InputError as `plot_surface` does, of the axes
std::vector<SurfaceContour> surface_contours(const SurfaceTable& surface);

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
