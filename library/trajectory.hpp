#pragma once
/// The lists of numbers of the public trajectory by the channels of the engine's.

#include "ensemble/planar/planar_poses.hpp"
#include "stylobate/trajectory.hpp"

#include <array>

namespace stylobate::api {

/// Calls f(channel, list) for each of them. @param trajectory may be constant
template <class T, class F>
void visit_channels(T& trajectory, F&& f)
{
    constexpr std::array lists = {&Trajectory::x_m,          &Trajectory::y_m,          &Trajectory::theta_rad,
                                  &Trajectory::base_x_m,     &Trajectory::rest_x_m,     &Trajectory::rest_y_m,
                                  &Trajectory::half_width_m, &Trajectory::half_height_m};
    static_assert(lists.size() == planar_channels.size());
    f(time_channel, trajectory.time_s);
    for (std::size_t c = 0; c < lists.size(); ++c)
        f(planar_channels[c], trajectory.*lists[c]);
}

} // namespace stylobate::api
