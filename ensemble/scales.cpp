#include "ensemble/scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

Scales scales_of(const Realization& r)
{
    Scales s;
    double top = -std::numeric_limits<double>::infinity(), bottom = -top, half_width = 0;
    int free_blocks = 0;
    for (const Block& block : r.blocks) {
        if (block.fixed)
            continue;
        ++free_blocks;
        top = std::max(top, block.y_m + block.half_height_m);
        bottom = std::min(bottom, block.y_m - block.half_height_m);
        half_width = std::max(half_width, block.half_width_m);
        s.width_m += 2 * block.half_width_m;
        s.rotation_rad = std::max(s.rotation_rad, std::atan(block.half_width_m / block.half_height_m));
    }
    s.width_m /= free_blocks;
    s.p_rad_s = std::sqrt(0.75 * r.gravity_m_s2 / std::hypot(half_width, 0.5 * (top - bottom)));

    s.barrier_j = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < r.joints.size(); ++j) {
        // all that stands on this joint, as one body
        double mass = 0, moment = 0;
        for (std::size_t k = j; k < r.joints.size(); ++k) {
            const Block& block = r.blocks[static_cast<std::size_t>(r.joints[k].upper)];
            mass += block.mass_kg;
            moment += block.mass_kg * block.y_m;
        }
        const Block& foot = r.blocks[static_cast<std::size_t>(r.joints[j].upper)];
        const double height = moment / mass - (foot.y_m - foot.half_height_m);
        s.barrier_j = std::min(s.barrier_j, mass * r.gravity_m_s2 * (std::hypot(foot.half_width_m, height) - height));
    }
    return s;
}

} // namespace stylobate
