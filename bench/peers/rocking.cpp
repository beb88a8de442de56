#include "bench/peers/rocking.hpp"

#include "bench/peers/engine.hpp"
#include "studies/evidence/verification/rigid_block.hpp"

#include <cmath>
#include <limits>
#include <numbers>

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

namespace {

bool overturns(const Engine& engine, std::size_t setting, double step_s, double eta)
{
    const auto block = verification::rigid_block(Monolith::width_m, Monolith::height_m);
    const double alpha = static_cast<double>(block.alpha), p = static_cast<double>(block.p);
    const Scene scene = monolith_scene(0);
    RealizationHeader motion;
    motion.step_s = step_s;
    motion.frequency_hz = pulse_rate * p / (2 * std::numbers::pi);
    motion.pga_m_s2 = eta * scene.gravity_m_s2 * std::tan(alpha);
    ExcitationSpec half_sine;
    half_sine.kind = ExcitationKind::half_sine;
    const BaseMotion base(half_sine, motion, nullptr);

    const auto world = engine.make(scene, setting, step_s);
    // the ground first goes to the right, and the block leans to the left, as it is pushed until the pulse ends
    for (int n = 0; n * step_s < 12 / p; ++n) {
        world->step(mean_acceleration(base, n, step_s));
        const double lean = world->pose(1).theta_rad;
        if (lean > 1.5 * alpha)
            return true;
        if (lean < 0 && n * step_s > base.duration_s())
            return false;
    }
    return false;
}

} // namespace

double overturning_eta(const Engine& engine, std::size_t setting, double step_s)
{
    double low = eta_low, high = eta_high;
    if (overturns(engine, setting, step_s, low) || !overturns(engine, setting, step_s, high))
        return std::numeric_limits<double>::quiet_NaN();
    while (high - low > eta_tolerance) {
        const double middle = (low + high) / 2;
        (overturns(engine, setting, step_s, middle) ? high : low) = middle;
    }
    return (low + high) / 2;
}

double exact_overturning_eta()
{
    return verification::half_sine_edge(verification::rigid_block(Monolith::width_m, Monolith::height_m), pulse_rate);
}

} // namespace stylobate::peers
