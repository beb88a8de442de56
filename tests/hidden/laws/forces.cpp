#include "tests/hidden/laws/forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate::hidden {

namespace {

const BedEffect& effect_of(const Model& model, int bed)
{
    return model.effects.beds[static_cast<std::size_t>(bed)];
}

/// Friction never falls below this part of the nominal one, however worn or hot.
constexpr double least_friction = 0.2;

} // namespace

double friction_of(const Model& model, int bed, const BedState& state, double position, double sliding)
{
    const BedEffect& effect = effect_of(model, bed);
    double mu = model.beds[static_cast<std::size_t>(bed)].friction * effect.friction_ratio;
    if (effect.dynamic_ratio != 1)
        mu *= effect.dynamic_ratio + (1 - effect.dynamic_ratio) * std::exp(-std::abs(sliding) / effect.stribeck_m_s);
    mu *= std::max(least_friction, 1 - effect.wear_per_m * state.slip_m);
    mu *= std::max(least_friction, 1 - effect.heat_per_j * state.heat_j);
    if (sliding != 0)
        mu *= 1 + (sliding > 0 ? effect.direction : -effect.direction);
    if (effect.patch_drop != 0) {
        const double from = (position - effect.patch_at_m) / effect.patch_width_m;
        mu *= 1 - effect.patch_drop * std::exp(-from * from);
    }
    return mu;
}

double adhesion_of(const Model& model, int bed, const BedState& state, double width)
{
    return state.slipped ? 0 : 0.5 * effect_of(model, bed).adhesion_n_m * std::max(width, 0.0);
}

double dowel_force(const Model& model, int bed, const BedState& state, double position)
{
    const BedEffect& effect = effect_of(model, bed);
    if (effect.dowel_n_m == 0)
        return 0;
    const double from = position - state.dowel_at_m;
    const double bent = std::max(std::abs(from) - effect.dowel_gap_m, 0.0);
    return -std::copysign(std::min(effect.dowel_n_m * bent, effect.dowel_yield_n), from);
}

Load load_on(const Model& model, int body, const BodyState& state, const BaseState& base, double time)
{
    const auto i = static_cast<std::size_t>(body);
    const BodyEffect& effect = model.effects.bodies[i];
    const Body& shape = model.bodies[i];
    Load load;
    load.fy = -shape.mass_kg * model.gravity_m_s2;
    if (effect.drag_kg_m != 0) {
        const double speed = std::hypot(state.vx, state.vy);
        load.fx -= effect.drag_kg_m * speed * state.vx;
        load.fy -= effect.drag_kg_m * speed * state.vy;
    }
    if (effect.coriolis_per_s != 0) {
        load.fx += shape.mass_kg * effect.coriolis_per_s * state.vy;
        load.fy -= shape.mass_kg * effect.coriolis_per_s * state.vx;
    }
    if (effect.magnet_n != 0) {
        const double from = (state.x - base.x - shape.rest_x_m - effect.magnet_at_m) / effect.magnet_range_m;
        load.fx -= effect.magnet_n * 2 * from / (1 + from * from); // greatest at the range, weaker beyond
    }
    if (time >= effect.draught_from_s && time < effect.draught_to_s)
        load.fx += effect.draught_n;
    if (effect.slosh_ratio != 0) {
        const double w = 2 * std::numbers::pi * effect.slosh_hz;
        const double mass = effect.slosh_ratio * shape.mass_kg;
        load.fx += mass * (w * w * state.slosh_m + 0.1 * w * state.slosh_m_s);
    }
    load.moment -= effect.spin_n_m_s * state.omega;
    return load;
}

void remember(const Model& model, int bed, BedState& state, double position, double sliding, double shear,
              double turning)
{
    const BedEffect& effect = effect_of(model, bed);
    const double dt = model.step_s;
    state.slip_m += std::abs(sliding) * dt;
    state.heat_j += (std::abs(shear * sliding) - state.heat_j / effect.heat_time_s) * dt;
    state.turned_rad += std::abs(turning) * dt;
    state.slipped = state.slipped || sliding != 0;
    if (effect.dowel_n_m != 0) { // yielding takes the free place of the dowel with it
        const double reach = effect.dowel_gap_m + effect.dowel_yield_n / effect.dowel_n_m;
        state.dowel_at_m = std::clamp(state.dowel_at_m, position - reach, position + reach);
    }
}

void slosh(const Model& model, int body, BodyState& state, double ax)
{
    const BodyEffect& effect = model.effects.bodies[static_cast<std::size_t>(body)];
    if (effect.slosh_ratio == 0)
        return;
    const double w = 2 * std::numbers::pi * effect.slosh_hz, dt = model.step_s;
    state.slosh_m_s += dt * (-w * w * state.slosh_m - 0.1 * w * state.slosh_m_s - ax);
    state.slosh_m += dt * state.slosh_m_s;
}

} // namespace stylobate::hidden
