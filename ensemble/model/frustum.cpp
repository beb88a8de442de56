#include "ensemble/model/frustum.hpp"

#include <algorithm>
#include <numbers>

namespace stylobate {
namespace {

double bottom_area_m2(const Frustum& f)
{
    return f.shape == Shape::round ? std::numbers::pi / 4 * f.width_m * f.width_m : f.width_m * f.depth_m;
}

/// A body of two parts, which have no echinus themselves.
struct Parts {
    Frustum echinus, abacus;
    double from_m = 0; ///< bottom of the abacus

    explicit Parts(const Frustum& f)
    {
        const double bottom = f.echinus_ratio * f.width_m;
        from_m = f.echinus_part * f.height_m;
        echinus = {Shape::round, bottom, bottom, from_m, std::min(f.width_m, f.depth_m) / bottom};
        abacus = {f.shape, f.width_m, f.depth_m, f.height_m - from_m, f.top_ratio};
    }
};

} // namespace

double Frustum::volume_m3() const
{
    if (echinus_part > 0) {
        const Parts parts(*this);
        return parts.echinus.volume_m3() + parts.abacus.volume_m3();
    }
    const double t = top_ratio; // of s^2
    return bottom_area_m2(*this) * height_m * ((1 + t + t * t) / 3);
}

double Frustum::centre_height_m() const
{
    if (echinus_part > 0) {
        const Parts parts(*this);
        const double below = parts.echinus.volume_m3(), above = parts.abacus.volume_m3();
        return (below * parts.echinus.centre_height_m() + above * (parts.from_m + parts.abacus.centre_height_m())) /
               (below + above);
    }
    const double t = top_ratio; // integral of y s^2 over that of s^2
    return height_m * (1 + 2 * t + 3 * t * t) / (4 * (1 + t + t * t));
}

std::array<double, 3> Frustum::inertia_per_mass_m2() const
{
    if (echinus_part > 0) {
        const Parts parts(*this);
        const double all = volume_m3(), centre = centre_height_m(), share = parts.echinus.volume_m3() / all;
        const double down = parts.echinus.centre_height_m() - centre;
        const double up = parts.from_m + parts.abacus.centre_height_m() - centre;
        const std::array<double, 3> below = parts.echinus.inertia_per_mass_m2(),
                                    above = parts.abacus.inertia_per_mass_m2();
        std::array<double, 3> inertia{};
        for (std::size_t axis = 0; axis < 3; ++axis) // Steiner's terms about the horizontal axes
            inertia[axis] = share * (below[axis] + (axis == 1 ? 0 : down * down)) +
                            (1 - share) * (above[axis] + (axis == 1 ? 0 : up * up));
        return inertia;
    }
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
