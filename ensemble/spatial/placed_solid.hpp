#pragma once
/// Where a body of a spatial trajectory lies, and its corners: what pictures, pages and other programs draw.

#include "ensemble/spatial/spatial_poses.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace stylobate {

using SpacePoint = std::array<double, 3>; ///< along x, y, z

/// A turn from upright, as a quaternion of length 1.
class Attitude {
public:
    Attitude() = default;
    /// @param q w, x, y, z. The samples of a trajectory lie between two steps, so that its length is not quite 1
    explicit Attitude(const std::array<double, 4>& q) : q_(q)
    {
        const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
        for (double& part : q_)
            part /= length;
    }

    SpacePoint turned(const SpacePoint& p) const
    {
        const auto [w, x, y, z] = q_;
        // p + 2 v x (v x p + w p), v the vector of the quaternion
        const SpacePoint a = {y * p[2] - z * p[1] + w * p[0], z * p[0] - x * p[2] + w * p[1],
                              x * p[1] - y * p[0] + w * p[2]};
        return {p[0] + 2 * (y * a[2] - z * a[1]), p[1] + 2 * (z * a[0] - x * a[2]), p[2] + 2 * (x * a[1] - y * a[0])};
    }
    double angle_rad() const { return 2 * std::atan2(std::hypot(q_[1], q_[2], q_[3]), std::fabs(q_[0])); }
    /// Of the body's axis from the vertical.
    double tilt_rad() const { return 2 * std::atan2(std::hypot(q_[1], q_[3]), std::hypot(q_[0], q_[2])); }
    /// Axis times angle, of all vectors of this attitude the one that is nearest to another vector: as the attitude
    /// turns on, the vector goes on, past a whole turn too.
    SpacePoint rotation_vector(const SpacePoint& near = {}) const
    {
        const double sine = std::hypot(q_[1], q_[2], q_[3]);
        if (sine < 1e-12)
            return near_whole_turns(near);
        SpacePoint axis = {q_[1] / sine, q_[2] / sine, q_[3] / sine};
        double angle = 2 * std::atan2(sine, q_[0]);
        const double along = axis[0] * near[0] + axis[1] * near[1] + axis[2] * near[2];
        angle += 2 * std::numbers::pi * std::round((along - angle) / (2 * std::numbers::pi));
        for (double& part : axis)
            part *= angle;
        return axis;
    }
    const std::array<double, 4>& quaternion() const { return q_; }

    /// From this attitude to another one the short way. @param share in [0, 1]
    Attitude between(const Attitude& other, double share) const
    {
        double cosine = 0;
        for (std::size_t i = 0; i < 4; ++i)
            cosine += q_[i] * other.q_[i];
        std::array<double, 4> mixed{}; // chords are short between samples: what is mixed evenly turns evenly
        for (std::size_t i = 0; i < 4; ++i)
            mixed[i] = (1 - share) * q_[i] + share * (cosine < 0 ? -other.q_[i] : other.q_[i]);
        return Attitude(mixed);
    }

private:
    /// Upright: any axis, a whole number of turns.
    static SpacePoint near_whole_turns(const SpacePoint& near)
    {
        const double length = std::hypot(near[0], near[1], near[2]);
        const double turns = std::round(length / (2 * std::numbers::pi));
        if (turns == 0)
            return {};
        SpacePoint vector = near;
        for (double& part : vector)
            part *= turns * 2 * std::numbers::pi / length;
        return vector;
    }

    std::array<double, 4> q_ = {1, 0, 0, 0}; ///< w, x, y, z
};

/// Half sizes of a face along x and z; of a disc both are the radius.
struct HalfSizes {
    double x = 0, z = 0;
};

/// Sides of the prism that is drawn for a drum: its corners lie on the circles of the faces.
inline constexpr int drum_sides = 24;

/// A frustum about its middle, in any unit of length.
struct SolidShape {
    double half_height = 0;
    HalfSizes bottom = {}, top = {};
    bool round = true;
    bool square_top = false; ///< of a round one: a capital with an echinus, drawn from its disc straight to its abacus

    /// Corners of the bottom face or the top one of the upright body, counter-clockwise as seen from above.
    std::vector<SpacePoint> ring(bool of_top) const
    {
        const HalfSizes& half = of_top ? top : bottom;
        const double y = of_top ? half_height : -half_height;
        if (!round)
            return {{half.x, y, half.z}, {half.x, y, -half.z}, {-half.x, y, -half.z}, {-half.x, y, half.z}};
        std::vector<SpacePoint> points;
        for (int i = 0; i < drum_sides; ++i) {
            const double a = 2 * std::numbers::pi * i / drum_sides, cosine = std::cos(a), sine = std::sin(a);
            // on a rectangle its corners are among the points
            const double out = of_top && square_top ? 1 / std::fmax(std::fabs(cosine), std::fabs(sine)) : 1;
            points.push_back({half.x * out * cosine, y, -half.z * out * sine});
        }
        return points;
    }
    SolidShape scaled(double by) const
    {
        return {by * half_height, {by * bottom.x, by * bottom.z}, {by * top.x, by * top.z}, round, square_top};
    }
    double half_diagonal() const
    {
        return std::hypot(half_height, std::fmax(bottom.x, top.x), std::fmax(bottom.z, top.z));
    }
};

/// A body in its place.
struct PlacedSolid {
    SolidShape shape;
    SpacePoint middle = {};
    Attitude attitude = {};

    bool is_finite() const
    {
        bool finite = true;
        for (const double part : middle)
            finite = finite && std::isfinite(part);
        for (const double part : attitude.quaternion())
            finite = finite && std::isfinite(part);
        return finite;
    }
    /// The corners of the bottom face, then those of the top face, each counter-clockwise as seen from above while the
    /// body stands upright.
    std::vector<SpacePoint> corners() const
    {
        std::vector<SpacePoint> points = shape.ring(false);
        for (const SpacePoint& point : shape.ring(true))
            points.push_back(point);
        for (SpacePoint& point : points) {
            point = attitude.turned(point);
            for (std::size_t i = 0; i < 3; ++i)
                point[i] += middle[i];
        }
        return points;
    }
    /// The faces as lists of corners, each counter-clockwise as seen from outside: bottom, top, then the sides.
    std::vector<std::vector<std::size_t>> faces() const
    {
        const std::size_t n = shape.round ? drum_sides : 4;
        std::vector<std::vector<std::size_t>> all(2);
        for (std::size_t i = 0; i < n; ++i) {
            all[0].push_back(n - 1 - i);
            all[1].push_back(n + i);
            const std::size_t next = (i + 1) % n;
            all.push_back({i, next, n + next, n + i});
        }
        return all;
    }
};

/// The shape of a body of a spatial trajectory, in metres. @pre is_spatial(t)
inline SolidShape shape_of(const Trajectory& t, std::size_t block)
{
    assert(is_spatial(t));
    const auto& lists = t.lists; // in the order of `spatial_channels`
    return {lists[13][block],
            {lists[14][block], lists[15][block]},
            {lists[16][block], lists[17][block]},
            lists[18][block] != 0,
            lists[18][block] == 2};
}

/// A body of a spatial trajectory at a sample, in metres, in the frame of the base. @pre is_spatial(t)
inline PlacedSolid solid_of(const Trajectory& t, std::size_t sample, std::size_t block)
{
    const std::size_t at = sample * t.blocks() + block;
    const auto& lists = t.lists;
    return {shape_of(t, block),
            {lists[0][at], lists[1][at], lists[2][at]},
            Attitude({lists[3][at], lists[4][at], lists[5][at], lists[6][at]})};
}

/// A block as built, in metres.
inline PlacedSolid solid_of(const PlacedBlock& block)
{
    const HalfSizes face = {block.width_m / 2, block.depth_m / 2};
    const bool echinus = block.echinus_part > 0, round = block.shape == Shape::round;
    const double radius = block.echinus_ratio * face.x;
    return {{block.height_m / 2,
             echinus ? HalfSizes{radius, radius} : face,
             {block.top_ratio * face.x, block.top_ratio * face.z},
             round || echinus,
             echinus && !round},
            {block.x_m(), block.y_m, block.z_m()},
            Attitude()};
}

} // namespace stylobate
