#pragma once
/// What holds the blocks of a planar structure beside their beds, as lines that a drawing follows through time: rods,
/// tendons and clamps.

#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/planar/planar_poses.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

/// An end of a fastening: a point of a block, with which it moves, or of the base.
struct FastenedPoint {
    std::optional<std::size_t> block; ///< of the layout; none: of the base
    double x_m = 0, y_m = 0;          ///< from the middle of the upright block; of the base: in its frame
};

struct Fastening {
    FastenedPoint at;                   ///< of a block
    std::optional<FastenedPoint> other; ///< none: of a rod, which comes from outside the drawing
    BlockMechanisms rod;                ///< of a rod, its parameters

    /// A rod that only pushes to the left comes from the right; every other one comes from the left.
    bool from_the_right() const { return rod.rod_right_n_m == 0; }
    /// A rod that only pushes: its tip leaves the block where the block is ahead of it.
    bool only_pushes() const { return rod.rod_right_n_m == 0 || rod.rod_left_n_m == 0; }
};

/// Between two points in the frame of the base [m].
struct FastenedLine {
    Rectangle::Corner from, to; ///< of a rod, x of `to` is infinite
};

/// A fastening at a time; nullopt where a block of it is not finite.
/// @param blocks as they are   @param start its block `at` as it was at the start
/// @param time_s since the start   @param base_m displacement of the base [m]
std::optional<FastenedLine> line_of(const Fastening& fastening, const std::vector<Rectangle>& blocks,
                                    const Rectangle& start, double time_s, double base_m);

/// The rods, tendons and clamps that act, with the values of the study (a realization may have drawn others).
/// @param friction of [contact]
std::vector<Fastening> fastenings(const std::vector<MechanismSpec>& mechanisms, double friction, const Layout& layout);

} // namespace stylobate
