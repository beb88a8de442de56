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

/// The point of a rod's body that it acts on.
void rod_point(const Model& model, const Rod& rod, const State& state, double& x, double& y)
{
    const auto b = static_cast<std::size_t>(rod.body);
    const BodyState& body = state.bodies[b];
    geometric_centre(model, rod.body, body, x, y);
    const double up = rod.height_m - model.bodies[b].half_height_m;
    x -= up * std::sin(body.theta);
    y += up * std::cos(body.theta);
}

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

double adhesion_of(const Model& model, int bed, const BedState& state, int end, double width)
{
    return state.slipped || state.opened[end] ? 0 : 0.5 * effect_of(model, bed).adhesion_n_m * std::max(width, 0.0);
}

double tension_of(const Model& model, int bed, const BedState& state, int end, double width)
{
    return state.slipped || state.opened[end] ? 0 : 0.5 * effect_of(model, bed).tension_n_m * std::max(width, 0.0);
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

void rod_tip(const Rod& rod, const Model& model, const State& state, const BaseState& base, double& at,
             double& velocity)
{
    double px = 0, py = 0, vy = 0;
    rod_point(model, rod, state, px, py);
    velocity_at(state.bodies[static_cast<std::size_t>(rod.body)], px, py, velocity, vy);
    at = px;
    if (rod.to_table) {
        double bx = 0, by = 0;
        velocity_at(base, px, py, bx, by);
        const double c = std::cos(base.theta), s = std::sin(base.theta);
        at = (px - base.x) * c + (py - base.y) * s;
        velocity = (velocity - bx) * c + (vy - by) * s;
    }
}

double rod_force(const Model& model, const Rod& rod, const State& state, const BaseState& base, double time)
{
    double at = 0, speed = 0;
    rod_tip(rod, model, state, base, at, speed);
    const double moved = std::clamp(time, rod.from_s, rod.to_s) - rod.from_s;
    const double end_speed = time >= rod.from_s && time < rod.to_s ? rod.speed_m_s : 0;
    const double bent = rod.end_m + rod.speed_m_s * moved - at;
    const double force = rod.stiffness_n_m * bent + rod.damping_n_s_m * (end_speed - speed);
    return rod.side != 0 && (rod.side * bent <= 0 || rod.side * force <= 0) ? 0 : force;
}

Load rod_load(const Model& model, const Rod& rod, const State& state, const BaseState& base, double time)
{
    double px = 0, py = 0;
    rod_point(model, rod, state, px, py);
    const double force = rod_force(model, rod, state, base, time);
    const double turned = rod.to_table ? base.theta : 0;
    const BodyState& on = state.bodies[static_cast<std::size_t>(mover(model, rod.body))];
    Load load;
    load.fx = force * std::cos(turned);
    load.fy = force * std::sin(turned);
    load.moment = (px - on.x) * load.fy - (py - on.y) * load.fx;
    return load;
}

void carry(const Model& model, const BaseState& base, State& state)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i) {
        const Body& body = model.bodies[i];
        if (body.carrier < on_table)
            continue;
        const auto put = [&](const auto& on) {
            BodyState& carried = state.bodies[i];
            const double c = std::cos(on.theta), s = std::sin(on.theta);
            carried.x = on.x + c * body.held_x_m - s * body.held_y_m;
            carried.y = on.y + s * body.held_x_m + c * body.held_y_m;
            carried.theta = on.theta + body.held_rad;
            velocity_at(on, carried.x, carried.y, carried.vx, carried.vy);
            carried.omega = on.omega;
        };
        if (body.carrier == on_table)
            put(base);
        else
            put(state.bodies[static_cast<std::size_t>(body.carrier)]);
    }
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
