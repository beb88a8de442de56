#include "ensemble/planar/structure/scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

// For `usual_accuracy`, which the worst cell of `stylobate_rigid_limit --steps` reaches just so: of 1 / p, p2 = 3 g /
// (4 R) the rocking frequency of the smallest free block.
constexpr double part_of_rocking = 1.0 / 120;
// Of a period of the shaking.
constexpr double part_of_period = 1.0 / 400;

} // namespace

Scales scales_of(const Realization& r)
{
    Scales s;
    double top = -std::numeric_limits<double>::infinity(), bottom = -top, half_width = 0;
    s.least_size_m = std::numeric_limits<double>::infinity();
    int free_drums = 0;
    for (const Block& block : r.blocks) {
        if (block.fixed)
            continue;
        s.least_size_m = std::min({s.least_size_m, block.half_width_m, block.half_height_m});
        if (block.role != BlockRole::drum)
            continue;
        ++free_drums;
        top = std::max(top, block.y_m + block.half_height_m);
        bottom = std::min(bottom, block.y_m - block.half_height_m);
        half_width = std::max(half_width, block.half_width_m);
        s.width_m += 2 * block.half_width_m;
    }
    s.width_m /= free_drums;
    s.p_rad_s = std::sqrt(0.75 * r.gravity_m_s2 / std::hypot(half_width, 0.5 * (top - bottom)));

    s.barrier_j = std::numeric_limits<double>::infinity();
    for (int j = 0; j < r.beds(); ++j) {
        // all of the column that stands on this bed, as one body; an epistyle by itself
        const Block& foot = r.blocks[static_cast<std::size_t>(r.joints[static_cast<std::size_t>(j)].upper)];
        double mass = 0, moment = 0;
        for (int k = j; k < r.beds(); ++k) {
            const Block& block = r.blocks[static_cast<std::size_t>(r.joints[static_cast<std::size_t>(k)].upper)];
            if (block.role != foot.role || block.column != foot.column ||
                (foot.role == BlockRole::epistyle && &block != &foot))
                continue;
            mass += block.mass_kg;
            moment += block.mass_kg * block.y_m;
        }
        const double height = moment / mass - (foot.y_m - foot.half_height_m);
        s.barrier_j = std::min(s.barrier_j, mass * r.gravity_m_s2 * (std::hypot(foot.half_width_m, height) - height));
    }
    return s;
}

double rigid_step_s(const Realization& r, double accuracy)
{
    const double part = accuracy / usual_accuracy;
    double smallest = 1e300;
    for (const Block& block : r.blocks)
        if (!block.fixed)
            smallest = std::min(smallest, std::hypot(block.half_width_m, block.half_height_m));
    const double rocking_s = part * part_of_rocking * std::sqrt(4 * smallest / (3 * r.gravity_m_s2));
    return r.frequency_hz > 0 ? std::min(rocking_s, part * part_of_period / r.frequency_hz) : rocking_s;
}

} // namespace stylobate
