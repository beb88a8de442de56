#include "tests/hidden/laws/forces.hpp"
#include "tests/hidden/laws/stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate::hidden {

namespace {

struct Rate {
    std::array<Load, max_bodies> acceleration; ///< fx, fy, moment hold x'', y'', theta''
    double bristle[max_beds][2];
    bool torn[max_beds][2];   ///< the tension that adhesion holds is reached
    double sliding[max_beds]; ///< where it slips, else 0
    double shear[max_beds];
    double position[max_beds];
};

/// K d^p with the change of the exponent that an effect brings, the same at the reference depth.
double spring_force(const LawParameters& law, double exponent_change, double depth)
{
    const double force = law.stiffness_n_m * depth * std::sqrt(depth);
    return exponent_change == 0 ? force : force * std::pow(depth / law.reference_m, exponent_change);
}

/// An end that is held by adhesion: as stiff as under its share of a block's weight, and damped as it is there.
/// @param depth negative: it is open by so much
double bond_force(const LawParameters& law, double depth, double closing)
{
    const double stiffness = law.stiffness_n_m * std::sqrt(law.reference_m);
    return std::min(stiffness * depth * (1 - law.damping_s_m * closing), 0.0);
}

/// All forces at a state; sets the widths of the beds.
void rate_of(const Model& model, State& state, const BaseState& base, double time, Rate& rate)
{
    carry(model, base, state);
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        rate.acceleration[b] = mover(model, i) == i ? load_on(model, i, state.bodies[b], base, time) : Load{};
    }
    for (int r = 0; r < model.rod_count; ++r) {
        const Rod& rod = model.rods[static_cast<std::size_t>(r)];
        const Load load = rod_load(model, rod, state, base, time);
        Load& on = rate.acceleration[static_cast<std::size_t>(mover(model, rod.body))];
        on.fx += load.fx;
        on.fy += load.fy;
        on.moment += load.moment;
    }
    for (int j = 0; j < model.bed_count; ++j) {
        const auto b = static_cast<std::size_t>(j);
        BedState& bed = state.beds[b];
        const BedEffect& effect = model.effects.beds[b];
        rate.position[j] = rate.sliding[j] = rate.shear[j] = 0;
        for (int e = 0; e < 2; ++e) {
            rate.bristle[j][e] = 0;
            rate.torn[j][e] = false;
        }
        if (!can_move(model, model.beds[b]))
            continue;
        const auto upper = static_cast<std::size_t>(mover(model, model.beds[b].upper));
        const int lower = mover(model, model.beds[b].lower);
        const BodyState& up = state.bodies[upper];
        const BedEnds ends = ends_of_bed(model, j, state, base);
        bed.width_m = ends.width;
        rate.position[j] = ends.position;
        Load& above = rate.acceleration[upper];
        Load fixed;
        Load& below = lower >= 0 ? rate.acceleration[static_cast<std::size_t>(lower)] : fixed;
        const double low_x = lower >= 0 ? state.bodies[static_cast<std::size_t>(lower)].x : base.x;
        const double low_y = lower >= 0 ? state.bodies[static_cast<std::size_t>(lower)].y : base.y;
        if (const double pull = dowel_force(model, j, bed, ends.position); pull != 0) {
            const double y = 0.5 * (ends.end[0].y + ends.end[1].y);
            above.fx += pull;
            above.moment -= (y - up.y) * pull;
            below.fx -= pull;
            below.moment += (y - low_y) * pull;
        }
        for (int e = 0; e < 2; ++e) {
            const BedEnd& end = ends.end[e];
            const double depth = -end.gap;
            const double tension = tension_of(model, j, bed, e, ends.width);
            if ((depth <= 0 && tension == 0) || ends.width <= 0) {
                rate.bristle[j][e] = -bed.bristle[e] / (10 * model.step_s); // they spring back
                continue;
            }
            double ux = 0, uy = 0, lx = 0, ly = 0;
            velocity_at(up, end.x, end.y, ux, uy);
            if (lower >= 0)
                velocity_at(state.bodies[static_cast<std::size_t>(lower)], end.x, end.y, lx, ly);
            else
                velocity_at(base, end.x, end.y, lx, ly);
            const double closing = -((ux - lx) * end.nx + (uy - ly) * end.ny);
            const double v = (ux - lx) * end.ny - (uy - ly) * end.nx;
            const LawParameters& law = model.parameters;
            double normal = 0;
            if (depth > 0) {
                const double spring = spring_force(law, effect.exponent_change, depth);
                normal = std::max(spring * (1 + law.damping_s_m * effect.rate_factor * closing) +
                                      effect.end_dashpot_n_s_m * closing,
                                  0.0);
            } else {
                normal = std::max(bond_force(law, depth, closing), -tension);
                rate.torn[j][e] = normal <= -tension;
            }
            const double mu = friction_of(model, j, bed, ends.position, v);
            const double adhesion = adhesion_of(model, j, bed, e, ends.width);
            const double limit = mu * std::max(normal, 0.0) + adhesion;
            const double bent = bed.bristle[e] / law.bristle_m;
            const double quarter = bent * bent;
            const bool further = v * bent > 0;
            const double flow = further ? v * (1 - std::min(quarter * quarter, 1.0)) : v;
            rate.bristle[j][e] = flow;
            const double shear = -limit * std::clamp(bent + law.bristle_time_s * flow / law.bristle_m, -1.0, 1.0);
            if (further && std::abs(bent) > 0.97)
                rate.sliding[j] = v;
            rate.shear[j] += shear;
            const double fx = normal * end.nx + shear * end.ny, fy = normal * end.ny - shear * end.nx;
            above.fx += fx;
            above.fy += fy;
            above.moment += (end.x - up.x) * fy - (end.y - up.y) * fx;
            below.fx -= fx;
            below.fy -= fy;
            below.moment -= (end.x - low_x) * fy - (end.y - low_y) * fx;
        }
    }
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        if (mover(model, i) != i)
            continue;
        Load& a = rate.acceleration[b];
        a.fx /= model.bodies[b].mass_kg;
        a.fy /= model.bodies[b].mass_kg;
        a.moment /= model.bodies[b].inertia_kg_m2;
    }
}

/// `from` advanced by dt: velocities by the rate, places by the velocities of the state that the rate belongs to.
void advance(const Model& model, const State& from, const State& at, const Rate& rate, double dt, State& to)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i) {
        const BodyState& old = from.bodies[i];
        const BodyState& now = at.bodies[i];
        const Load& a = rate.acceleration[i];
        BodyState& next = to.bodies[i];
        next.x = old.x + dt * now.vx;
        next.y = old.y + dt * now.vy;
        next.theta = old.theta + dt * now.omega;
        next.vx = old.vx + dt * a.fx;
        next.vy = old.vy + dt * a.fy;
        next.omega = old.omega + dt * a.moment;
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(model.bed_count); ++j)
        for (int e = 0; e < 2; ++e)
            to.beds[j].bristle[e] = from.beds[j].bristle[e] + dt * rate.bristle[j][e];
}

} // namespace

double compliant_force(const Model& model, int bed, double depth)
{
    return depth <= 0 ? 0
                      : spring_force(model.parameters,
                                     model.effects.beds[static_cast<std::size_t>(bed)].exponent_change, depth);
}

double compliant_depth(const Model& model, int bed, double force)
{
    const LawParameters& law = model.parameters;
    const double q = model.effects.beds[static_cast<std::size_t>(bed)].exponent_change;
    // force = K d^1.5 (d / d_r)^q
    return force <= 0 ? 0 : std::pow(force * std::pow(law.reference_m, q) / law.stiffness_n_m, 1 / (1.5 + q));
}

void step_compliant(const Model& model, const Table& table, State& state)
{
    const double h = model.step_s;
    const double t = static_cast<double>(state.step) * h;
    const BaseState base[3] = {table.at(2 * state.step), table.at(2 * state.step + 1), table.at(2 * state.step + 2)};
    Rate k1, k2, k3, k4;
    State s2 = state, s3 = state, s4 = state;
    rate_of(model, state, base[0], t, k1);
    advance(model, state, state, k1, 0.5 * h, s2);
    rate_of(model, s2, base[1], t + 0.5 * h, k2);
    advance(model, state, s2, k2, 0.5 * h, s3);
    rate_of(model, s3, base[1], t + 0.5 * h, k3);
    advance(model, state, s3, k3, h, s4);
    rate_of(model, s4, base[2], t + h, k4);

    const double part = h / 6;
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        if (mover(model, i) != i)
            continue;
        BodyState& body = state.bodies[b];
        const double vx = body.vx;
        body.x += part * (body.vx + 2 * s2.bodies[b].vx + 2 * s3.bodies[b].vx + s4.bodies[b].vx);
        body.y += part * (body.vy + 2 * s2.bodies[b].vy + 2 * s3.bodies[b].vy + s4.bodies[b].vy);
        body.theta += part * (body.omega + 2 * s2.bodies[b].omega + 2 * s3.bodies[b].omega + s4.bodies[b].omega);
        const Load &a = k1.acceleration[b], &c = k2.acceleration[b], &d = k3.acceleration[b], &f = k4.acceleration[b];
        body.vx += part * (a.fx + 2 * c.fx + 2 * d.fx + f.fx);
        body.vy += part * (a.fy + 2 * c.fy + 2 * d.fy + f.fy);
        body.omega += part * (a.moment + 2 * c.moment + 2 * d.moment + f.moment);
        slosh(model, i, body, (body.vx - vx) / h);
    }
    carry(model, base[2], state);
    for (int j = 0; j < model.bed_count; ++j) {
        const auto b = static_cast<std::size_t>(j);
        if (!can_move(model, model.beds[b]))
            continue;
        BedState& bed = state.beds[b];
        const double most = model.parameters.bristle_m;
        for (int e = 0; e < 2; ++e) {
            bed.bristle[e] +=
                part * (k1.bristle[j][e] + 2 * k2.bristle[j][e] + 2 * k3.bristle[j][e] + k4.bristle[j][e]);
            bed.bristle[e] = std::clamp(bed.bristle[e], -most, most);
            bed.opened[e] = bed.opened[e] || k4.torn[j][e];
        }
        const Bed& which = model.beds[b];
        const double turning =
            state.bodies[static_cast<std::size_t>(which.upper)].omega -
            (which.lower < 0 ? base[2].omega : state.bodies[static_cast<std::size_t>(which.lower)].omega);
        remember(model, j, bed, k4.position[j], k4.sliding[j], k4.shear[j], turning);
    }
    ++state.step;
}

} // namespace stylobate::hidden
