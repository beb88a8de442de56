#pragma once
/// The blocks of the planar model through time: the channels of its trajectories, and where a block then lies.

#include "ensemble/model/trajectory.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace stylobate {

/// The channels of a planar trajectory, in the order of files.
inline constexpr std::array planar_channels = {
    TrajectoryChannel{"x_m", ListOf::poses, "horizontal place of the centre, in the frame of the base"},
    TrajectoryChannel{"y_m", ListOf::poses, "height of the centre, in the frame of the base"},
    TrajectoryChannel{"theta_rad", ListOf::poses, "rotation, counter-clockwise from upright"},
    TrajectoryChannel{"base_x_m", ListOf::times, "displacement of the base"},
    TrajectoryChannel{"rest_x_m", ListOf::blocks, "horizontal place of the centre as built"},
    TrajectoryChannel{"rest_y_m", ListOf::blocks, "height of the centre as built"},
    TrajectoryChannel{"half_width_m", ListOf::blocks, "half width of the block"},
    TrajectoryChannel{"half_height_m", ListOf::blocks, "half height of the block"},
};

/// Whether a trajectory is of the planar model.
inline bool is_planar(const Trajectory& t)
{
    return t.channels.data() == planar_channels.data();
}

/// Positions of all blocks of one realization, in the order of `Realization::blocks`, in the frame of the base.
struct Snapshot {
    std::vector<double> x_m, y_m, theta_rad; ///< (blocks) centres and rotations

    /// The values of a channel of poses, by its number among them in `planar_channels`.
    const std::vector<double>& pose(std::size_t channel) const
    {
        return channel == 0 ? x_m : channel == 1 ? y_m : theta_rad;
    }
};

/// A rectangle in any unit of length.
struct Rectangle {
    double x = 0, y = 0;                    ///< its centre
    double turned_rad = 0;                  ///< counter-clockwise
    double half_width = 0, half_height = 0; ///< before it is turned

    struct Corner {
        double x = 0, y = 0;
    };
    /// Where a point of it is. @param u, v from its centre before it is turned
    Corner place(double u, double v) const
    {
        const double c = std::cos(turned_rad), s = std::sin(turned_rad);
        return {x + c * u - s * v, y + s * u + c * v};
    }
    /// Counter-clockwise from the one that is at the lower left before it is turned.
    std::array<Corner, 4> corners() const
    {
        return {place(-half_width, -half_height), place(half_width, -half_height), place(half_width, half_height),
                place(-half_width, half_height)};
    }
    /// The radius of the circle about the centre that no corner leaves.
    double reach() const { return std::hypot(half_width, half_height); }
    friend bool operator==(const Rectangle&, const Rectangle&) = default;
    bool is_finite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(turned_rad); }
};

/// A block of a planar trajectory at a sample, in metres. @pre is_planar(t)
inline Rectangle rectangle_of(const Trajectory& t, std::size_t sample, std::size_t block)
{
    assert(is_planar(t));
    const std::size_t at = sample * t.blocks() + block;
    const auto& lists = t.lists; // in the order of `planar_channels`
    return {lists[0][at], lists[1][at], lists[2][at], lists[6][block], lists[7][block]};
}

} // namespace stylobate
