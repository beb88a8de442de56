#pragma once
/// A picture of several maps over the same rows and PGAs, one beside the other.

#include "ensemble/model/surface_axes.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// One colour for all values from `from` up to the next one's.
struct MapClass {
    double from = 0;
    std::string colour; ///< "#rrggbb"
    std::string name;
};

struct MapPanel {
    std::string title;
    std::vector<double> value;     ///< (nf x np), row by row; NaN: grey
    std::vector<MapClass> classes; ///< ascending; empty: a continuous scale with its own box of colours
    double low = 0, high = 1;      ///< of the continuous scale; values beyond take the colour of its end, which is then
                                   ///< marked
};

struct MapPicture : SurfaceAxes {
    std::string title, subtitle;
    std::vector<MapPanel> panels;
    int columns = 2;
    std::vector<double>
        line; ///< (nf x np), of which the lines at 0.05, 0.5 and 0.95 are drawn over every map; or empty
    std::optional<std::string> key; ///< explanation of grey cells and lines, below the maps
};

/// The classes of the first panel that has any are explained below the maps.
/// @throws InputError if the axes are not such, or if the picture cannot be written
void plot_maps(const MapPicture& picture, const std::filesystem::path& png);

} // namespace stylobate
