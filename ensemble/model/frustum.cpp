#include "ensemble/model/frustum.hpp"

#include <numbers>

namespace stylobate {

double Frustum::bottom_area_m2() const
{
    return shape == Shape::round ? std::numbers::pi / 4 * width_m * width_m : width_m * depth_m;
}

double Frustum::volume_m3() const
{
    const double t = top_ratio; // of s^2
    return bottom_area_m2() * height_m * ((1 + t + t * t) / 3);
}

double Frustum::centre_height_m() const
{
    const double t = top_ratio; // integral of y s^2 over that of s^2
    return height_m * (1 + 2 * t + 3 * t * t) / (4 * (1 + t + t * t));
}

std::array<double, 3> Frustum::inertia_per_mass_m2() const
{
    const double t = top_ratio, h = height_m;
    const double volume = (1 + t + t * t) / 3;                       // integral of s^2, of h A0
    const double fourth = (1 + t * (1 + t * (1 + t * (1 + t)))) / 5; // of s^4
    const double second = h * h * (1 + t * (3 + 6 * t)) / 30;        // of y^2 s^2
    const double centre = centre_height_m();
    const double upright = second / volume - centre * centre;             // about the horizontal plane of the centre
    const double section = shape == Shape::round ? 1.0 / 16 : 1.0 / 12;   // I0 / (A0 size^2)
    const double along_x = section * width_m * width_m * fourth / volume; // integral of x^2 over the mass
    const double depth = shape == Shape::round ? width_m : depth_m;
    const double along_z = section * depth * depth * fourth / volume;
    return {along_z + upright, along_x + along_z, along_x + upright};
}

} // namespace stylobate
