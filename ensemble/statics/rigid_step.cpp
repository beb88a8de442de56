#include "ensemble/statics/rigid_step.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

// For `usual_accuracy`, which the worst cell of `stylobate_rigid_limit --steps` reaches just so: of 1 / p, p2 = 3 g /
// (4 R) the rocking frequency of the smallest free block.
constexpr double part_of_rocking = 1.0 / 120;
// Of a period of the shaking.
constexpr double part_of_period = 1.0 / 400;

} // namespace

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
