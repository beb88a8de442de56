#pragma once
/// An axis of cells, such as those of a surface: its scale, the extents of the cells, the cell of a value; and a
/// surface in words.

#include "io/store/result_store.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace stylobate {

struct CellAxis {
    std::vector<double> values; ///< ascending
    std::vector<double> edges;  ///< of the cells around the values, one more than these; midpoints on the axis' scale
    bool log = false;           ///< logarithmic, because the values are spaced so

    /// Position along the axis, for the arithmetic of distances, and back.
    double scaled(double value) const;
    double unscaled(double position) const;
    /// Position with 0 at the first edge and 1 at the last one: where a value is in a picture's frame, and back.
    double in_unit(double value) const;
    double from_unit(double unit) const;
    /// The cell whose value is nearest on the axis' scale.
    std::size_t nearest(double value) const;
};

/// @param values at least one, finite
/// @param name for the message, for example "frequency_hz"
/// @throws InputError if there is no value, or if the values are not finite and ascending
CellAxis make_cell_axis(const std::vector<double>& values, const std::string& name);

/// "wilson 0.95" -> "95 % Wilson interval"; other texts are left as they are.
std::string describe_interval(const std::string& interval);

/// Realizations of a surface in words: "65536 realizations, 256 in each of 16 × 16 cells".
/// @throws InputError if the table's arrays do not fit its axes
std::string describe_realizations(const SurfaceTable& surface);

} // namespace stylobate
