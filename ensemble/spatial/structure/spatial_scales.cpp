#include "ensemble/spatial/structure/spatial_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

/// The smaller half size of a face.
double narrow_half(const Face& face)
{
    return face.round ? face.half_x_m : std::min(face.half_x_m, face.half_z_m);
}

/// Least distance from a point above a face to its rim, seen from above; 0 outside the face.
double rim_distance(const Face& face, double x, double z)
{
    const double inside = face.round ? face.half_x_m - std::hypot(x, z)
                                     : std::min(face.half_x_m - std::abs(x), face.half_z_m - std::abs(z));
    return std::max(inside, 0.0);
}

} // namespace

Scales spatial_scales(const Realization& realization)
{
    const SpatialStructure& s = realization.space;
    const double g = realization.gravity_m_s2, infinite = std::numeric_limits<double>::infinity();
    Scales scales;
    scales.least_size_m = scales.barrier_j = infinite;
    double top = -infinite, bottom = infinite, half = 0;
    int free_drums = 0;
    for (const Solid& solid : s.solids) {
        if (solid.fixed)
            continue;
        scales.least_size_m =
            std::min({scales.least_size_m, narrow_half(solid.bottom), narrow_half(solid.top), solid.height_m / 2});
        if (solid.role != BlockRole::drum)
            continue;
        ++free_drums;
        const double foot = solid.centre_m[1] - solid.centre_height_m;
        top = std::max(top, foot + solid.height_m);
        bottom = std::min(bottom, foot);
        half = std::max({half, narrow_half(solid.bottom), narrow_half(solid.top)});
        scales.width_m += 2 * narrow_half(solid.bottom);
    }
    scales.width_m /= free_drums;
    scales.p_rad_s = std::sqrt(0.75 * g / std::hypot(half, 0.5 * (top - bottom)));

    for (std::size_t j = 0; j < s.joints.size(); ++j) {
        if (s.joints[j].normal != Normal::y)
            continue;
        // all of the column that stands on this bed, as one body; an epistyle by itself
        const Solid& foot = s.solids[static_cast<std::size_t>(s.joints[j].upper)];
        double mass = 0;
        std::array<double, 3> moment{};
        for (std::size_t k = j; k < s.joints.size(); ++k) {
            const Solid& body = s.solids[static_cast<std::size_t>(s.joints[k].upper)];
            if (s.joints[k].normal != Normal::y || body.role != foot.role || body.column != foot.column ||
                (foot.role == BlockRole::epistyle && &body != &foot))
                continue;
            mass += body.mass_kg;
            for (std::size_t axis = 0; axis < 3; ++axis)
                moment[axis] += body.mass_kg * body.centre_m[axis];
        }
        const std::array<double, 3> middle = foot.middle_m();
        const double height = moment[1] / mass - (middle[1] - foot.height_m / 2);
        const double rim = rim_distance(foot.bottom, moment[0] / mass - middle[0], moment[2] / mass - middle[2]);
        scales.barrier_j = std::min(scales.barrier_j, mass * g * (std::hypot(rim, height) - height));
    }
    return scales;
}

} // namespace stylobate
