#include "studies/verification/held_load.hpp"

#include "ensemble/scales.hpp"
#include "studies/verification/model.hpp"

namespace stylobate::verification {

namespace {

bool stays(const Realization& r, const StaticState& rest, double acceleration)
{
    model::BareColumn column(r);
    column.put(rest);
    const double p = scales_of(r).p_rad_s, dt = r.step_s, rise = 10 / p, end = 70 / p;
    const double slip_limit = 0.01 * scales_of(r).width_m;
    const auto moved = [&] {
        for (int i = 0; i < column.blocks(); ++i) {
            const Block& block = r.blocks[static_cast<std::size_t>(i)];
            if (std::fabs(column.at(OfBlock::theta, i)) > std::atan(block.half_width_m / block.half_height_m))
                return true;
        }
        return column.at(OfRealization::slip) > slip_limit;
    };
    int n = 0;
    for (double t = 0; t < end; t += dt, ++n) {
        const double x = std::min(t / rise, 1.0);
        column.step(acceleration * x * x * (3 - 2 * x) * dt * dt);
        column.slow_down(2 * p * dt);
        if (n % 256 == 0 && moved())
            return false;
    }
    return !moved();
}

} // namespace

double largest_held_acceleration(const Realization& r, double low, double high, double tolerance)
{
    const StaticState rest = static_state(r);
    if (!stays(r, rest, low) || stays(r, rest, high))
        throw std::runtime_error("the ends do not bracket the largest acceleration that is held");
    while (high - low > tolerance) {
        const double middle = 0.5 * (low + high);
        (stays(r, rest, middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace stylobate::verification
