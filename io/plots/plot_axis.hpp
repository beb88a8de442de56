#pragma once
/// An axis of a picture over given values: its scale, the extents of the cells around the values, its tics.

#include <string>
#include <vector>

namespace stylobate {

struct PlotAxis {
    std::vector<double> values; ///< ascending
    std::vector<double> edges;  ///< of the cells around the values, one more than these; midpoints on the axis' scale
    bool log = false;           ///< logarithmic, because the values are spaced so

    /// Position along the axis, for the arithmetic of distances, and back.
    double scaled(double value) const;
    double unscaled(double position) const;
    /// The same with 0 at the first edge and 1 at the last one: where a value is in the picture's frame, and back.
    double in_unit(double value) const;
    double from_unit(double unit) const;

    /// gnuplot's commands for the scale, the range (first to last edge) and the tics of axis `letter`.
    std::string commands(char letter) const;
};

/// @param values at least one, finite
/// @param name for the message, for example "frequency_hz"
/// @throws InputError if there is no value, or if the values are not finite and ascending
PlotAxis make_plot_axis(const std::vector<double>& values, const std::string& name);

} // namespace stylobate
