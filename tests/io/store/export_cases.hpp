#pragma once
/// What the tests of exports and pictures share: a folder, a surface, a trajectory.

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_store.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <string>

namespace stylobate {

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A fresh folder for each test, removed afterwards.
class ExportFolder : public ::testing::Test {
protected:
    std::size_t entries() const
    {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
    }

    const TemporaryFolder own;
    const std::filesystem::path folder = own.path();
};
inline std::string read_file(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Message of the InputError that `action` must throw.
template <class Action>
std::string message_of(Action action)
{
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError";
    return {};
}

/// Probability rising with PGA along a curve that rises with the frequency.
inline SurfaceTable some_surface(std::size_t nf = 16, std::size_t np = 12)
{
    SurfaceTable surface;
    surface.interval = "wilson 0.95";
    for (std::size_t i = 0; i < nf; ++i)
        surface.frequency_hz.push_back(0.5 * std::pow(20.0, static_cast<double>(i) / static_cast<double>(nf - 1)));
    for (std::size_t j = 0; j < np; ++j)
        surface.pga_m_s2.push_back(1.0 + 11.0 * static_cast<double>(j) / static_cast<double>(np - 1));
    for (const double f : surface.frequency_hz)
        for (const double a : surface.pga_m_s2) {
            const double p = std::round(256 / (1 + std::exp(-1.5 * (a - 2 - f)))) / 256;
            surface.trials.push_back(256);
            surface.collapses.push_back(static_cast<std::uint64_t>(256 * p));
            surface.probability.push_back(p);
            surface.lower.push_back(std::max(0.0, p - 0.06));
            surface.upper.push_back(std::min(1.0, p + 0.06));
        }
    return surface;
}

/// Drums of B x H, the lowest one fixed if there are several; the others lean over more and more.
inline Trajectory some_trajectory(std::size_t blocks, double width, double height, std::size_t samples = 401)
{
    Trajectory t(planar_channels);
    t.index = 77;
    t["half_width_m"].assign(blocks, width / 2);
    t["half_height_m"].assign(blocks, height / 2);
    t.role.assign(blocks, BlockRole::drum);
    t.column.assign(blocks, 0);
    for (std::size_t i = 0; i < blocks; ++i)
        t.name.push_back("drum " + std::to_string(i));
    t["rest_x_m"].assign(blocks, 0);
    for (std::size_t i = 0; i < blocks; ++i)
        t["rest_y_m"].push_back((static_cast<double>(i) + 0.5) * height);
    for (std::size_t s = 0; s < samples; ++s) {
        const double time = 0.01 * static_cast<double>(s);
        t.time_s.push_back(time);
        t["base_x_m"].push_back(0.3 * width * std::sin(6 * time));
        for (std::size_t i = 0; i < blocks; ++i) {
            const double y = (static_cast<double>(i) + 0.5) * height;
            const bool fixed = blocks > 1 && i == 0;
            const double theta = fixed ? 0.0 : 0.02 * time * time * std::sin(5 * time);
            t["x_m"].push_back(-y * std::sin(theta));
            t["y_m"].push_back(y * std::cos(theta));
            t["theta_rad"].push_back(theta);
        }
    }
    return t;
}

/// A colonnade of three columns (five drums each, 1.2 m by 1 m, 3 m apart) under two epistyles: the right one falls
/// with its epistyle and comes to lie on the ground, a drum on two others; the rest stays.
struct FallingColonnade {
    Trajectory trajectory{planar_channels};
    std::vector<double> fall_time_s;
};

inline FallingColonnade falling_colonnade(std::size_t samples = 801)
{
    struct Place {
        double x, y, theta;
    };
    struct Path {
        Place from, to;
        double start_s; ///< < 0: stays
    };
    const double quarter = std::acos(0.0);
    FallingColonnade c;
    Trajectory& t = c.trajectory;
    t.index = 5;
    std::vector<Path> paths;
    for (int column = 0; column < 3; ++column)
        for (int drum = 0; drum < 5; ++drum) {
            const Place from{3.0 * column, drum + 0.5, 0};
            const bool falls = column == 2 && drum > 0;
            // lying on their sides, their axes along x; the highest drum on top of the two beside it
            const Place to = drum == 4 ? Place{9.0, 1.8, -quarter} : Place{7.4 + 1.05 * drum, 0.6, -quarter};
            paths.push_back({from, falls ? to : from, falls ? 3 + 0.1 * drum : -1});
            t.role.push_back(BlockRole::drum);
            t.column.push_back(column);
            t["half_width_m"].push_back(0.6);
            t["half_height_m"].push_back(0.5);
            t.name.push_back("drum " + std::to_string(drum) + " of column " + std::to_string(column));
        }
    for (int span = 0; span < 2; ++span) {
        const Place from{3.0 * span + 1.5, 5.4, 0};
        paths.push_back({from, span == 1 ? Place{12.6, 0.4, -2 * quarter} : from, span == 1 ? 2.5 : -1});
        t.role.push_back(BlockRole::epistyle);
        t.column.push_back(-1);
        t["half_width_m"].push_back(1.5);
        t["half_height_m"].push_back(0.4);
        t.name.push_back("epistyle " + std::to_string(span));
    }
    for (const Path& path : paths) {
        t["rest_x_m"].push_back(path.from.x);
        t["rest_y_m"].push_back(path.from.y);
    }
    for (const Path& path : paths)
        c.fall_time_s.push_back(path.start_s < 0 ? -1 : path.start_s + 0.2);
    for (std::size_t s = 0; s < samples; ++s) {
        const double time = 0.01 * static_cast<double>(s);
        t.time_s.push_back(time);
        t["base_x_m"].push_back(0.2 * std::sin(5 * time) * std::exp(-0.3 * time));
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const Path& p = paths[i];
            const double u = p.start_s < 0 ? 0 : std::clamp((time - p.start_s) / 1.2, 0.0, 1.0);
            const double sway = i % 5 == 0 && i < 15 ? 0 : 0.02 * std::sin(5 * time) * std::exp(-0.3 * time) * (1 - u);
            t["x_m"].push_back(p.from.x + u * (p.to.x - p.from.x) + sway * p.from.y);
            t["y_m"].push_back(p.from.y + u * u * (p.to.y - p.from.y));
            t["theta_rad"].push_back(u * p.to.theta);
        }
    }
    return c;
}

} // namespace stylobate
