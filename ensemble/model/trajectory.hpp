#pragma once
/// One realization through time: a list of numbers for each named channel of its model.

#include "ensemble/model/structure.hpp"

#include <concepts>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace stylobate {

/// What a list of a trajectory has values of.
enum class ListOf {
    times,  ///< the base at each time
    blocks, ///< each block, at all times the same
    poses   ///< each block at each time, time by time
};

/// A list of numbers of a trajectory, as a model describes it. Files, tables and Python have the list under its name.
struct TrajectoryChannel {
    const char* name; ///< ends in the unit
    ListOf of;
    const char* meaning;
};

/// The one list that trajectories of every model have.
inline constexpr TrajectoryChannel time_channel = {"time_s", ListOf::times, "time"};

struct Trajectory {
    Trajectory() = default;
    /// @param of_model its channels; their lists are empty
    explicit Trajectory(std::span<const TrajectoryChannel> of_model) : channels(of_model), lists(of_model.size()) {}

    std::uint64_t index = 0;
    std::vector<double> time_s; ///< (times)
    std::span<const TrajectoryChannel> channels;
    std::vector<std::vector<double>> lists; ///< (channels)
    std::vector<BlockRole> role;            ///< (blocks)
    std::vector<std::int32_t> column;       ///< (blocks) of a drum, from the left; -1 for all else
    std::vector<std::string> name;          ///< (blocks) as in `ResultHeader::block_names`

    std::size_t blocks() const { return role.size(); }
    /// The list of a channel, or the times.
    /// @throws std::out_of_range if the model has none of this name
    const std::vector<double>& operator[](std::string_view channel) const
    {
        if (channel == time_channel.name)
            return time_s;
        for (std::size_t c = 0; c < channels.size(); ++c)
            if (channel == channels[c].name)
                return lists[c];
        throw std::out_of_range("a trajectory has no channel '" + std::string(channel) + "'");
    }
    std::vector<double>& operator[](std::string_view channel)
    {
        return const_cast<std::vector<double>&>(std::as_const(*this)[channel]);
    }
};

/// Calls f(channel, list) for the times and then for each channel. @param trajectory may be constant
template <class T, class F>
requires std::same_as<std::remove_const_t<T>, Trajectory>
void visit_lists(T& trajectory, F&& f)
{
    f(time_channel, trajectory.time_s);
    for (std::size_t c = 0; c < trajectory.channels.size(); ++c)
        f(trajectory.channels[c], trajectory.lists[c]);
}

/// Whether the lists of a trajectory fit each other.
inline bool lists_fit(const Trajectory& trajectory)
{
    const std::size_t blocks = trajectory.blocks();
    bool fit = trajectory.column.size() == blocks && trajectory.name.size() == blocks;
    visit_lists(trajectory, [&](const TrajectoryChannel& channel, const std::vector<double>& list) {
        const std::size_t times = channel.of == ListOf::blocks ? 1 : trajectory.time_s.size();
        fit = fit && list.size() == times * (channel.of == ListOf::times ? 1 : blocks);
    });
    return fit;
}

} // namespace stylobate
