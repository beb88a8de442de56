#include "bench/peers/rocking.hpp"

#include "studies/evidence/verification/rigid_block.hpp"

#include <cmath>
#include <limits>

namespace stylobate::peers {

namespace {

using Block = Monolith;

verification::RigidBlock rigid()
{
    return verification::rigid_block(Block::width_m, Block::height_m);
}

} // namespace

Scene monolith_scene(double lean_rad)
{
    const double b = Block::width_m / 2, h = Block::height_m / 2, c = std::cos(lean_rad), s = std::sin(lean_rad);
    const Pose leaned{-b + b * c - h * s, b * s + h * c, lean_rad};
    return {
        {{10 * b, h, 1, 1, {0, -h, 0}, true}, {b, h, Block::depth_m, Block::mass_kg, leaned, false, Block::friction}}};
}

double quarter_period(const Engine& engine, std::size_t setting, double step_s)
{
    const auto block = rigid();
    const double start = Block::lean * static_cast<double>(block.alpha);
    const double limit_s = 5 / static_cast<double>(block.p);
    const auto world = engine.make(monolith_scene(start), setting, step_s);
    double before = start;
    for (int n = 1; n * step_s < limit_s; ++n) {
        world->step(0);
        const double now = world->pose(1).theta_rad;
        if (now <= 0)
            return step_s * (n - 1 + before / (before - now) + engine.ahead_steps);
        before = now;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double exact_quarter_period()
{
    const auto block = rigid();
    return static_cast<double>(verification::quarter_period(block, Block::lean * block.alpha));
}

} // namespace stylobate::peers
