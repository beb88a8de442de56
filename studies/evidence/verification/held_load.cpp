#include "studies/evidence/verification/held_load.hpp"

#include "ensemble/statics/scales.hpp"
#include "ensemble/statics/settle.hpp"
#include "studies/evidence/verification/model.hpp"

namespace stylobate::verification {

HeldState hold(const Realization& r, double acceleration)
{
    model::BareColumn column(r);
    column.put(static_state(r));
    const Scales scales = scales_of(r);
    const double p = scales.p_rad_s, dt = r.step_s, rise = 10 / p, end = 70 / p;
    const auto moved = [&] {
        for (int i = 0; i < column.blocks(); ++i) {
            const Block& block = r.blocks[static_cast<std::size_t>(i)];
            if (std::fabs(column.at(OfBlock::theta, i)) > std::atan(block.half_width_m / block.half_height_m))
                return true;
        }
        return column.at(OfRealization::slip) > 0.01 * scales.width_m;
    };
    HeldState state;
    int n = 0;
    for (double t = 0; t < end; t += dt, ++n) {
        const double x = std::min(t / rise, 1.0);
        column.step(acceleration * x * x * (3 - 2 * x) * dt * dt);
        column.slow_down(2 * p * dt);
        if (n % 256 == 0 && moved())
            return state;
    }
    state.stays = !moved();
    const auto pose = [&](int block) {
        const Block& b = r.blocks[static_cast<std::size_t>(block)];
        return Pose{b.x_m + column.at(OfBlock::x, block), b.y_m + column.at(OfBlock::y, block),
                    column.at(OfBlock::theta, block)};
    };
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const auto area = overlap_of(r.blocks[static_cast<std::size_t>(joint.lower)], pose(joint.lower),
                                     r.blocks[static_cast<std::size_t>(joint.upper)], pose(joint.upper))
                              .area;
        state.pressure_n.push_back(joint.normal_stiffness_n_m2 * area);
    }
    return state;
}

double largest_held_acceleration(const Realization& r, double low, double high, double tolerance)
{
    if (!hold(r, low).stays || hold(r, high).stays)
        throw std::runtime_error("the ends do not bracket the largest acceleration that is held");
    while (high - low > tolerance) {
        const double middle = 0.5 * (low + high);
        (hold(r, middle).stays ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace stylobate::verification
