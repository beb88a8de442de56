#include "bench/peers/space/space_oracles.hpp"

#include <cmath>

namespace stylobate::peers {

namespace {

/// Over the mass, about the centre: across the axis and along it.
double across(const DrumSize& d)
{
    return d.radius_m * d.radius_m / 4 + d.half_height_m * d.half_height_m / 3;
}
double along(const DrumSize& d)
{
    return d.radius_m * d.radius_m / 2;
}

} // namespace

double rim_inertia(const DrumSize& d)
{
    return across(d) + d.radius_m * d.radius_m + d.half_height_m * d.half_height_m;
}

verification::RigidBlock rocking_drum(const DrumSize& d)
{
    return {std::atan2(static_cast<long double>(d.radius_m), static_cast<long double>(d.half_height_m)),
            std::sqrt(static_cast<long double>(space_gravity_m_s2 * std::hypot(d.radius_m, d.half_height_m) /
                                               rim_inertia(d)))};
}

double drum_restitution(const DrumSize& d)
{
    return 1 - 2 * d.radius_m * d.radius_m / rim_inertia(d);
}

double first_turn_back(const DrumSize& d, double start_rad)
{
    const double alpha = std::atan2(d.radius_m, d.half_height_m), e = drum_restitution(d);
    return (alpha - std::acos(std::cos(alpha) + e * e * (std::cos(alpha - start_rad) - std::cos(alpha)))) / start_rad;
}

double rolling_rate(const DrumSize& d, double lean_rad)
{
    const double R = d.radius_m, h = d.half_height_m, s = std::sin(lean_rad), c = std::cos(lean_rad);
    const double path = R / c - R * c + h * s; // radius of the centre's circle
    return std::sqrt(space_gravity_m_s2 * (R * c - h * s) /
                     (s * (across(d) * c + along(d) * s * s / c) + (R * s + h * c) * path));
}

double wobble_rate(const DrumSize& d, double lean_rad)
{
    const double R = d.radius_m, h = d.half_height_m, s = std::sin(lean_rad), c = std::cos(lean_rad);
    return std::sqrt(space_gravity_m_s2 * (R * c - h * s) / (s * (across(d) * c - along(d) * h * s / R)));
}

double spin_down_s(double radius_m, double spin_rad_s, double friction)
{
    return 3 * radius_m * spin_rad_s / (4 * friction * space_gravity_m_s2);
}

} // namespace stylobate::peers
