#include "io/store/result_trajectory.hpp"

#include "io/store/result_file.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace stylobate {

namespace names = result_names;

namespace {

/// Calls f(list) for all lists but the names.
template <class T, class F>
void visit_lists(T& t, const F& f)
{
    f(t.time_s);
    f(t.x_m);
    f(t.y_m);
    f(t.theta_rad);
    f(t.base_x_m);
    f(t.rest_x_m);
    f(t.rest_y_m);
    f(t.half_width_m);
    f(t.half_height_m);
    f(t.role);
    f(t.column);
}

} // namespace

void check_trajectory(const Trajectory& trajectory)
{
    const std::size_t times = trajectory.time_s.size();
    const std::size_t blocks = trajectory.blocks();
    const std::size_t values = times * blocks;
    if (trajectory.x_m.size() != values || trajectory.y_m.size() != values || trajectory.theta_rad.size() != values ||
        trajectory.base_x_m.size() != times || trajectory.half_height_m.size() != blocks ||
        trajectory.rest_x_m.size() != blocks || trajectory.rest_y_m.size() != blocks ||
        trajectory.role.size() != blocks || trajectory.column.size() != blocks || trajectory.name.size() != blocks)
        throw std::invalid_argument("the arrays of a trajectory have inconsistent sizes");
    joined_names(trajectory.name); // for its refusals
}

void write_trajectory(hid_t file, const Trajectory& trajectory)
{
    const std::string group = std::string(names::trajectories) + "/" + std::to_string(trajectory.index);
    const hdf5::Handle made = hdf5::create_group(file, group);
    hdf5::write_text(made.id(), names::blocks, joined_names(trajectory.name));
    const hdf5::Dims time = {trajectory.time_s.size()};
    const hdf5::Dims block = {trajectory.blocks()};
    const hdf5::Dims both = {trajectory.time_s.size(), trajectory.blocks()};
    hdf5::write_array(file, group + "/time_s", trajectory.time_s, time, "s");
    hdf5::write_array(file, group + "/x_m", trajectory.x_m, both, "m");
    hdf5::write_array(file, group + "/y_m", trajectory.y_m, both, "m");
    hdf5::write_array(file, group + "/theta_rad", trajectory.theta_rad, both, "rad");
    hdf5::write_array(file, group + "/base_x_m", trajectory.base_x_m, time, "m");
    hdf5::write_array(file, group + "/rest_x_m", trajectory.rest_x_m, block, "m");
    hdf5::write_array(file, group + "/rest_y_m", trajectory.rest_y_m, block, "m");
    hdf5::write_array(file, group + "/half_width_m", trajectory.half_width_m, block, "m");
    hdf5::write_array(file, group + "/half_height_m", trajectory.half_height_m, block, "m");
    std::vector<std::uint8_t> roles;
    for (const BlockRole role : trajectory.role)
        roles.push_back(static_cast<std::uint8_t>(role));
    hdf5::write_bytes(file, group + "/role", role_type().id(), roles, block);
    hdf5::write_array(file, group + "/column", trajectory.column, block, "");
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
    visit_lists(trajectory, put_list);
    put_list(joined_names(trajectory.name));
    return bytes;
}

Trajectory trajectory_of(std::span<const std::byte> bytes)
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
    Trajectory trajectory;
    take(&trajectory.index, sizeof trajectory.index);
    visit_lists(trajectory, take_list);
    std::string text;
    take_list(text);
    trajectory.name = split_names(text);
    check_trajectory(trajectory);
    return trajectory;
}

} // namespace stylobate
