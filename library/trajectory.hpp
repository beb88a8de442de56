#pragma once
/// The lists of numbers of the public trajectory by the channels of the engine's, and what its pictures in space show.

#include "io/plots/solid_sheet.hpp"
#include "io/store/result_layout.hpp"
#include "stylobate/trajectory.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate::api {

/// The public list of each channel of any model.
inline constexpr std::array<std::pair<std::string_view, std::vector<double> Trajectory::*>, 21> channel_lists = {
    {{"x_m", &Trajectory::x_m},
     {"y_m", &Trajectory::y_m},
     {"z_m", &Trajectory::z_m},
     {"theta_rad", &Trajectory::theta_rad},
     {"q_w", &Trajectory::q_w},
     {"q_x", &Trajectory::q_x},
     {"q_y", &Trajectory::q_y},
     {"q_z", &Trajectory::q_z},
     {"base_x_m", &Trajectory::base_x_m},
     {"base_y_m", &Trajectory::base_y_m},
     {"base_z_m", &Trajectory::base_z_m},
     {"rest_x_m", &Trajectory::rest_x_m},
     {"rest_y_m", &Trajectory::rest_y_m},
     {"rest_z_m", &Trajectory::rest_z_m},
     {"half_width_m", &Trajectory::half_width_m},
     {"half_height_m", &Trajectory::half_height_m},
     {"bottom_half_x_m", &Trajectory::bottom_half_x_m},
     {"bottom_half_z_m", &Trajectory::bottom_half_z_m},
     {"top_half_x_m", &Trajectory::top_half_x_m},
     {"top_half_z_m", &Trajectory::top_half_z_m},
     {"round", &Trajectory::round}}};

/// @throws std::logic_error if the public trajectory has none of this name
constexpr std::vector<double> Trajectory::*list_of(std::string_view channel)
{
    for (const auto& [name, list] : channel_lists)
        if (name == channel)
            return list;
    throw std::logic_error("a channel has no list in the public trajectory");
}

/// Calls f(channel, list) for each of its model. @param trajectory may be constant
template <class T, class F>
void visit_channels(T& trajectory, F&& f)
{
    f(time_channel, trajectory.time_s);
    for (const TrajectoryChannel& channel : trajectory_channels(trajectory.dimensions))
        f(channel, trajectory.*list_of(channel.name));
}

/// What `write_svg` draws of a structure in space at some samples: polygons in the order in which they are painted, the
/// ground first; metres to the right and upwards as seen obliquely from above.
/// @throws InputError as `write_svg`   @throws std::out_of_range if there is no such sample
std::vector<std::vector<ShadedPolygon>> seen_in_space(const Trajectory& trajectory,
                                                      const std::vector<std::size_t>& samples);

} // namespace stylobate::api
