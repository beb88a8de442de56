#include "io/store/result_file.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace stylobate {

namespace names = result_names;

void check_trajectory(const Trajectory& trajectory, int dimensions)
{
    if (trajectory.channels.data() != trajectory_channels(dimensions).data())
        throw std::invalid_argument("a trajectory is of another model than its file");
    if (!lists_fit(trajectory))
        throw std::invalid_argument("the arrays of a trajectory have inconsistent sizes");
    joined_names(trajectory.name); // for its refusals
}

namespace {

/// Calls f(path, list of numbers, its shape) for each of them. @param group of the trajectory
template <class T, class F>
void visit_datasets(T& t, const std::string& group, hsize_t times, hsize_t blocks, const F& f)
{
    visit_lists(t, [&](const TrajectoryChannel& channel, auto& list) {
        f(group + channel.name, list,
          channel.of == ListOf::times    ? hdf5::Dims{times}
          : channel.of == ListOf::blocks ? hdf5::Dims{blocks}
                                         : hdf5::Dims{times, blocks});
    });
}

std::string group_of(std::uint64_t index)
{
    return std::string(names::trajectories) + "/" + std::to_string(index) + "/";
}

} // namespace

void write_trajectory(hid_t file, const Trajectory& trajectory)
{
    const std::string group = group_of(trajectory.index);
    const hdf5::Handle made = hdf5::create_group(file, group);
    hdf5::write_text(made.id(), names::blocks, joined_names(trajectory.name));
    visit_datasets(trajectory, group, trajectory.time_s.size(), trajectory.blocks(),
                   [&](const std::string& path, const auto& list, const hdf5::Dims& dims) {
                       hdf5::write_array(file, path, list, dims, std::string(unit_of(path)));
                   });
    std::vector<std::uint8_t> roles;
    for (const BlockRole role : trajectory.role)
        roles.push_back(static_cast<std::uint8_t>(role));
    hdf5::write_bytes(file, group + "role", role_type().id(), roles, {trajectory.blocks()});
    hdf5::write_array(file, group + "column", trajectory.column, {trajectory.blocks()}, "");
}

Trajectory read_trajectory(hid_t file, int dimensions, std::uint64_t index)
{
    const std::string group = group_of(index);
    Trajectory trajectory(trajectory_channels(dimensions));
    trajectory.index = index;
    const hdf5::Dims both = hdf5::dims_of(file, group + "x_m");
    if (both.size() != 2)
        throw hdf5::Error("'" + group + "x_m' is not a matrix");
    visit_datasets(trajectory, group, both[0], both[1],
                   [&](const std::string& path, auto& list, const hdf5::Dims& dims) {
                       list = hdf5::read_doubles(file, path, dims);
                   });
    for (const std::uint8_t role : hdf5::read_bytes(file, group + "role", role_type().id(), {both[1]})) {
        if (role > static_cast<std::uint8_t>(BlockRole::ground))
            throw hdf5::Error("'" + group + "role' contains values that no run writes");
        trajectory.role.push_back(static_cast<BlockRole>(role));
    }
    trajectory.column = hdf5::read_integers(file, group + "column", {both[1]});
    const hdf5::Handle opened = hdf5::open_group(file, group);
    trajectory.name = split_names(hdf5::read_text(opened.id(), names::blocks));
    check_trajectory(trajectory, dimensions);
    return trajectory;
}

std::vector<std::byte> bytes_of(const Trajectory& trajectory)
{
    std::vector<std::byte> bytes;
    const auto put = [&](std::span<const std::byte> more) {
        const std::size_t at = bytes.size();
        bytes.resize(at + more.size());
        if (!more.empty()) // an empty list may have no place
            std::memcpy(bytes.data() + at, more.data(), more.size());
    };
    const auto put_list = [&](const auto& list) {
        const std::uint64_t n = list.size();
        put(std::as_bytes(std::span(&n, 1)));
        put(std::as_bytes(std::span(list)));
    };
    put(std::as_bytes(std::span(&trajectory.index, 1)));
    visit_lists(trajectory, [&](const TrajectoryChannel&, const std::vector<double>& list) { put_list(list); });
    put_list(trajectory.role);
    put_list(trajectory.column);
    put_list(joined_names(trajectory.name));
    return bytes;
}

Trajectory trajectory_of(int dimensions, std::span<const std::byte> bytes)
{
    const auto take = [&](void* to, std::size_t size) {
        if (size > bytes.size())
            throw std::invalid_argument("a trajectory is cut");
        if (size > 0)
            std::memcpy(to, bytes.data(), size);
        bytes = bytes.subspan(size);
    };
    const auto take_list = [&](auto& list) {
        std::uint64_t n = 0;
        take(&n, sizeof n);
        if (n > bytes.size() / sizeof(list[0]))
            throw std::invalid_argument("a trajectory is cut");
        list.resize(n);
        take(list.data(), n * sizeof(list[0]));
    };
    Trajectory trajectory(trajectory_channels(dimensions));
    take(&trajectory.index, sizeof trajectory.index);
    visit_lists(trajectory, [&](const TrajectoryChannel&, std::vector<double>& list) { take_list(list); });
    take_list(trajectory.role);
    take_list(trajectory.column);
    std::string text;
    take_list(text);
    trajectory.name = split_names(text);
    check_trajectory(trajectory, dimensions);
    return trajectory;
}

} // namespace stylobate
