#pragma once
/// Campaigns of blocks that slide and rock by formula, for the tests of the balance of forces: nothing of them comes
/// from a simulation.

#include "ensemble/model/campaign.hpp"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace stylobate {

/// Noise of the cameras that see these motions.
inline constexpr double camera_m = 3e-5, camera_rad = 3e-4;

inline constexpr double formula_rate_hz = 1000;
inline constexpr double formula_gravity = 9.81;

/// One block of half width 30 mm and half height 50 mm on the table.
inline Specimen one_block()
{
    Specimen s;
    s.name = "by formula";
    s.gravity_m_s2 = formula_gravity;
    s.friction_nominal = 0.5;
    s.half_width_m = {0.03};
    s.half_height_m = {0.05};
    s.depth_m = {0.06};
    s.mass_kg = {0.9};
    s.rest_x_m = {0};
    s.rest_y_m = {0.05};
    s.joints = {{-1, 0}};
    return s;
}

/// The same on a wide slab, on which it can slide far.
inline Specimen block_on_slab()
{
    Specimen s = one_block();
    s.half_width_m = {0.8, 0.03};
    s.half_height_m = {0.05, 0.05};
    s.depth_m = {0.06, 0.06};
    s.mass_kg = {20, 0.9};
    s.rest_x_m = {0, 0};
    s.rest_y_m = {0.05, 0.15};
    s.joints = {{-1, 0}, {0, 1}};
    return s;
}

struct Pose {
    double x = 0, y = 0, theta = 0;
};

/// @param pose(block, sample)
inline MeasuredRun formula_run(const Specimen& s, int samples, const std::function<Pose(int, int)>& pose,
                               double noise_m, double noise_rad, unsigned seed)
{
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    MeasuredRun run;
    run.name = std::to_string(seed);
    run.rate_hz = formula_rate_hz;
    run.collapsed = false;
    run.blocks.x_m.noise_sd = run.blocks.y_m.noise_sd = noise_m;
    run.blocks.theta_rad.noise_sd = noise_rad;
    for (int i = 0; i < samples; ++i) {
        run.time_s.push_back(i / formula_rate_hz);
        run.base_displacement_m.values.push_back(0);
        for (int b = 0; b < s.blocks(); ++b) {
            const Pose at = pose(b, i);
            run.blocks.x_m.values.push_back(at.x + noise_m * normal(random));
            run.blocks.y_m.values.push_back(at.y + noise_m * normal(random));
            run.blocks.theta_rad.values.push_back(at.theta + noise_rad * normal(random));
        }
    }
    return run;
}

inline Pose at_rest(const Specimen& s, int block)
{
    const auto b = static_cast<std::size_t>(block);
    return {s.rest_x_m[b], s.rest_y_m[b], 0};
}

/// Displacement, sample by sample, of what starts with a velocity and is slowed down by `slowed(v)` until it stops
/// (Runge and Kutta, 10 steps a sample).
inline std::vector<double> coasting(double velocity_m_s, const std::function<double(double)>& slowed)
{
    std::vector<double> x = {0};
    const double dt = 0.1 / formula_rate_hz, sign = velocity_m_s > 0 ? 1 : -1;
    double at = 0, v = std::fabs(velocity_m_s);
    while (v > 0) {
        for (int i = 0; i < 10; ++i) {
            const double k1 = -slowed(v), k2 = -slowed(v + dt / 2 * k1), k3 = -slowed(v + dt / 2 * k2),
                         k4 = -slowed(v + dt * k3);
            at += dt * (v + dt / 6 * (k1 + k2 + k3));
            v += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        if (v > 0)
            x.push_back(sign * at);
    }
    return x;
}

/// Rotation, sample by sample, of a block that turns on a corner, by Housner's equation (Bull. Seism. Soc. Am. 53,
/// 1963): up to `most_rad` and down again, as far as `least_rad`.
///
///   (I + m (b^2 + h^2)) theta'' = -m g (b cos theta - h sin theta)
///
/// @param arm_b, arm_h from the corner to the centre of mass   @param inertia about it, over the mass
inline std::vector<double> rocking(double arm_b, double arm_h, double inertia, double most_rad, double least_rad)
{
    const auto spin = [&](double theta) {
        return -formula_gravity * (arm_b * std::cos(theta) - arm_h * std::sin(theta)) /
               (inertia + arm_b * arm_b + arm_h * arm_h);
    };
    std::vector<double> down;
    const double dt = 0.1 / formula_rate_hz;
    double theta = most_rad, rate = 0;
    while (theta > least_rad) {
        down.push_back(theta);
        for (int i = 0; i < 10; ++i) {
            const double k1 = spin(theta), k2 = spin(theta + dt / 2 * rate),
                         k3 = spin(theta + dt / 2 * rate + dt * dt / 4 * k1),
                         k4 = spin(theta + dt * rate + dt * dt / 2 * k2);
            theta += dt * rate + dt * dt / 6 * (k1 + k2 + k3);
            rate += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
    }
    std::vector<double> all(down.rbegin(), down.rend());
    all.insert(all.end(), down.begin() + 1, down.end());
    return all;
}

/// A block that has turned by theta on a point of its lower face, `inside` of the corner.
inline Pose rocked_pose(double half_width, double half_height, double theta, double inside = 0)
{
    const double side = theta > 0 ? -1 : 1, corner = side * (half_width - inside);
    const double c = std::cos(theta), s = std::sin(theta);
    return {corner - corner * c - half_height * s, -corner * s + half_height * c, theta};
}

} // namespace stylobate
