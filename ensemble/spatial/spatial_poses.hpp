#pragma once
/// The bodies of the spatial model through time: the channels of its trajectories.

#include "ensemble/model/trajectory.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace stylobate {

/// The channels of a trajectory in space, in the order of files.
inline constexpr std::array spatial_channels = {
    TrajectoryChannel{"x_m", ListOf::poses, "place of the body's middle along x, in the frame of the base"},
    TrajectoryChannel{"y_m", ListOf::poses, "height of the body's middle, in the frame of the base"},
    TrajectoryChannel{"z_m", ListOf::poses, "place of the body's middle along z, in the frame of the base"},
    TrajectoryChannel{"q_w", ListOf::poses, "attitude: cosine of half the angle of the rotation from upright"},
    TrajectoryChannel{"q_x", ListOf::poses, "attitude: x of the axis times the sine of half the angle"},
    TrajectoryChannel{"q_y", ListOf::poses, "attitude: y of the axis times the sine of half the angle"},
    TrajectoryChannel{"q_z", ListOf::poses, "attitude: z of the axis times the sine of half the angle"},
    TrajectoryChannel{"base_x_m", ListOf::times, "displacement of the base along x"},
    TrajectoryChannel{"base_y_m", ListOf::times, "displacement of the base upwards"},
    TrajectoryChannel{"base_z_m", ListOf::times, "displacement of the base along z"},
    TrajectoryChannel{"rest_x_m", ListOf::blocks, "place of the body's middle along x as built"},
    TrajectoryChannel{"rest_y_m", ListOf::blocks, "height of the body's middle as built"},
    TrajectoryChannel{"rest_z_m", ListOf::blocks, "place of the body's middle along z as built"},
    TrajectoryChannel{"half_height_m", ListOf::blocks, "half height of the body"},
    TrajectoryChannel{"bottom_half_x_m", ListOf::blocks, "half size of the bottom face along x; radius of a disc"},
    TrajectoryChannel{"bottom_half_z_m", ListOf::blocks, "half size of the bottom face along z; radius of a disc"},
    TrajectoryChannel{"top_half_x_m", ListOf::blocks, "half size of the top face along x; radius of a disc"},
    TrajectoryChannel{"top_half_z_m", ListOf::blocks, "half size of the top face along z; radius of a disc"},
    TrajectoryChannel{"round", ListOf::blocks,
                      "1: the faces are discs; 0: rectangles; 2: the bottom one is a disc, the top one a rectangle"},
};

/// Whether a trajectory is of the spatial model.
inline bool is_spatial(const Trajectory& t)
{
    return t.channels.data() == spatial_channels.data();
}

/// Number of channels of poses, the first ones of `spatial_channels`.
inline constexpr std::size_t spatial_pose_channels = 7;

/// Where all bodies of one realization are, in the order of `SpatialStructure::solids`, in the frame of the base.
struct SolidSnapshot {
    std::array<std::vector<double>, spatial_pose_channels> lists; ///< (bodies) of each channel of poses

    /// The values of a channel of poses, by its number among them.
    const std::vector<double>& pose(std::size_t channel) const { return lists[channel]; }
};

} // namespace stylobate
