#include "tests/hidden/laws/forces.hpp"
#include "tests/hidden/laws/stepper.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

namespace {

/// An end of a bed that is closed in this step.
struct Corner {
    int bed, end, lower, upper;
    double nx, ny;         ///< normal; the tangent is (ny, -nx)
    double lx, ly, ux, uy; ///< arms from the centres of mass
    double mass_n, mass_t; ///< effective masses
    double wanted;         ///< normal velocity after the step
    double mu, adhesion_n_s, tension_n_s;
    double base_vx, base_vy; ///< velocity of the corner as a point of the table, where that is the lower body
};

struct Speed {
    double x, y, turn;
};

/// Relative velocity of the upper against the lower body at a corner.
void relative(const Corner& corner, const Speed* speeds, double& vn, double& vt)
{
    const Speed& up = speeds[corner.upper];
    double vx = up.x - up.turn * corner.uy - corner.base_vx;
    double vy = up.y + up.turn * corner.ux - corner.base_vy;
    if (corner.lower >= 0) {
        const Speed& low = speeds[corner.lower];
        vx -= low.x - low.turn * corner.ly;
        vy -= low.y + low.turn * corner.lx;
    }
    vn = vx * corner.nx + vy * corner.ny;
    vt = vx * corner.ny - vy * corner.nx;
}

void push(const Corner& corner, const Model& model, double normal, double shear, Speed* speeds)
{
    const double px = normal * corner.nx + shear * corner.ny, py = normal * corner.ny - shear * corner.nx;
    const Body& up = model.bodies[static_cast<std::size_t>(corner.upper)];
    speeds[corner.upper].x += px / up.mass_kg;
    speeds[corner.upper].y += py / up.mass_kg;
    speeds[corner.upper].turn += (corner.ux * py - corner.uy * px) / up.inertia_kg_m2;
    if (corner.lower >= 0) {
        const Body& low = model.bodies[static_cast<std::size_t>(corner.lower)];
        speeds[corner.lower].x -= px / low.mass_kg;
        speeds[corner.lower].y -= py / low.mass_kg;
        speeds[corner.lower].turn -= (corner.lx * py - corner.ly * px) / low.inertia_kg_m2;
    }
}

double effective_mass(const Corner& corner, const Model& model, double dx, double dy)
{
    const auto part = [&](int body, double ax, double ay) {
        const Body& of = model.bodies[static_cast<std::size_t>(body)];
        const double arm = ax * dy - ay * dx;
        return 1 / of.mass_kg + arm * arm / of.inertia_kg_m2;
    };
    return 1 / (part(corner.upper, corner.ux, corner.uy) +
                (corner.lower >= 0 ? part(corner.lower, corner.lx, corner.ly) : 0));
}

/// Greatest shear impulse at a corner that is pressed by a normal one.
double shear_limit(const Corner& corner, double normal)
{
    return corner.mu * std::max(normal, 0.0) + corner.adhesion_n_s;
}

constexpr int most_sweeps = 60;
/// A sweep that changes no impulse by more than this part of a body's weight in a step is the last.
constexpr double settled = 1e-4;

} // namespace

void step_nonsmooth(const Model& model, const Table& table, State& state)
{
    const double h = model.step_s;
    const BaseState base_before = table.at(2 * state.step), base = table.at(2 * state.step + 1),
                    base_after = table.at(2 * state.step + 2);
    const double time = static_cast<double>(state.step) * h;

    State middle = state;
    Speed speeds[max_bodies], before[max_bodies];
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        if (mover(model, i) != i)
            continue;
        BodyState& body = middle.bodies[b];
        body.x += 0.5 * h * body.vx;
        body.y += 0.5 * h * body.vy;
        body.theta += 0.5 * h * body.omega;
        before[i] = speeds[i] = {body.vx, body.vy, body.omega};
        const Load load = load_on(model, i, state.bodies[b], base_before, time);
        speeds[i].x += h * load.fx / model.bodies[b].mass_kg;
        speeds[i].y += h * load.fy / model.bodies[b].mass_kg;
        speeds[i].turn += h * load.moment / model.bodies[b].inertia_kg_m2;
    }
    for (int r = 0; r < model.rod_count; ++r) {
        const Rod& rod = model.rods[static_cast<std::size_t>(r)];
        const int on = mover(model, rod.body);
        const Load load = rod_load(model, rod, state, base_before, time);
        speeds[on].x += h * load.fx / model.bodies[static_cast<std::size_t>(on)].mass_kg;
        speeds[on].y += h * load.fy / model.bodies[static_cast<std::size_t>(on)].mass_kg;
        speeds[on].turn += h * load.moment / model.bodies[static_cast<std::size_t>(on)].inertia_kg_m2;
    }
    carry(model, base, middle);

    Corner corners[2 * max_beds];
    int count = 0;
    BedEnds ends[max_beds];
    for (int j = 0; j < model.bed_count; ++j) {
        const auto b = static_cast<std::size_t>(j);
        BedState& bed = state.beds[b];
        if (!can_move(model, model.beds[b]))
            continue;
        const int lower = mover(model, model.beds[b].lower), upper = mover(model, model.beds[b].upper);
        ends[j] = ends_of_bed(model, j, middle, base);
        bed.width_m = ends[j].width;
        const BodyState& up = middle.bodies[static_cast<std::size_t>(upper)];
        if (const double pull = dowel_force(model, j, bed, ends[j].position); pull != 0) {
            Corner middle_of_bed{};
            middle_of_bed.lower = lower;
            middle_of_bed.upper = upper;
            middle_of_bed.ny = 1;
            const double x = 0.5 * (ends[j].end[0].x + ends[j].end[1].x);
            const double y = 0.5 * (ends[j].end[0].y + ends[j].end[1].y);
            middle_of_bed.ux = x - up.x;
            middle_of_bed.uy = y - up.y;
            if (lower >= 0) {
                middle_of_bed.lx = x - middle.bodies[static_cast<std::size_t>(lower)].x;
                middle_of_bed.ly = y - middle.bodies[static_cast<std::size_t>(lower)].y;
            }
            push(middle_of_bed, model, 0, h * pull, speeds);
        }
        for (int e = 0; e < 2; ++e) {
            const BedEnd& end = ends[j].end[e];
            const double tension = h * tension_of(model, j, bed, e, ends[j].width);
            if ((end.gap > 0 && tension == 0) || ends[j].width <= 0) {
                bed.normal_n_s[e] = bed.shear_n_s[e] = 0;
                continue;
            }
            Corner corner{};
            corner.bed = j;
            corner.end = e;
            corner.lower = lower;
            corner.upper = upper;
            corner.nx = end.nx;
            corner.ny = end.ny;
            corner.ux = end.x - up.x;
            corner.uy = end.y - up.y;
            if (lower >= 0) {
                const BodyState& low = middle.bodies[static_cast<std::size_t>(lower)];
                corner.lx = end.x - low.x;
                corner.ly = end.y - low.y;
            } else {
                velocity_at(base_before, end.x, end.y, corner.base_vx, corner.base_vy);
            }
            corner.mass_n = effective_mass(corner, model, end.nx, end.ny);
            corner.mass_t = effective_mass(corner, model, end.ny, -end.nx);
            double vn = 0, vt = 0;
            relative(corner, before, vn, vt);
            // what rests shall not bounce on the velocity that gravity gives it in a step
            const double closing = vn < -4 * model.gravity_m_s2 * h ? -vn : 0;
            // rotations within a step let corners sink by less than a micrometre: out again, slowly
            const double sunk = std::max(-end.gap - 1e-7, 0.0);
            corner.wanted = std::max(model.parameters.restitution * closing, std::min(0.05 * sunk / h, 2e-3));
            corner.mu = friction_of(model, j, bed, ends[j].position, vt);
            corner.adhesion_n_s = h * adhesion_of(model, j, bed, e, ends[j].width);
            corner.tension_n_s = tension;
            if (lower < 0)
                velocity_at(base_after, end.x, end.y, corner.base_vx, corner.base_vy);
            const double limit = shear_limit(corner, bed.normal_n_s[e]);
            bed.shear_n_s[e] = std::clamp(bed.shear_n_s[e], -limit, limit);
            push(corner, model, bed.normal_n_s[e], bed.shear_n_s[e], speeds);
            corners[count++] = corner;
        }
    }

    const double tolerance = settled * model.bodies[0].mass_kg * model.gravity_m_s2 * h;
    const auto solve = [&](const Corner& corner) {
        BedState& bed = state.beds[static_cast<std::size_t>(corner.bed)];
        double& normal = bed.normal_n_s[corner.end];
        double& shear = bed.shear_n_s[corner.end];
        double vn = 0, vt = 0;
        relative(corner, speeds, vn, vt);
        const double more = std::max(normal - corner.mass_n * (vn - corner.wanted), -corner.tension_n_s) - normal;
        normal += more;
        push(corner, model, more, 0, speeds);
        relative(corner, speeds, vn, vt);
        const double limit = shear_limit(corner, normal);
        const double along = std::clamp(shear - corner.mass_t * vt, -limit, limit) - shear;
        shear += along;
        push(corner, model, 0, along, speeds);
        return std::max(std::abs(more), std::abs(along));
    };
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double change = 0;
        for (int c = 0; c < count; ++c) // up, and down again: what is pressed above is felt below at once
            change = std::max(change, solve(corners[c]));
        for (int c = count; c-- > 0;)
            change = std::max(change, solve(corners[c]));
        if (change < tolerance)
            break;
    }

    double sliding[max_beds] = {}, shear[max_beds] = {};
    for (int c = 0; c < count; ++c) {
        const Corner& corner = corners[c];
        BedState& bed = state.beds[static_cast<std::size_t>(corner.bed)];
        double vn = 0, vt = 0;
        relative(corner, speeds, vn, vt);
        shear[corner.bed] += bed.shear_n_s[corner.end] / h;
        if (corner.tension_n_s > 0 && bed.normal_n_s[corner.end] <= -corner.tension_n_s)
            bed.opened[corner.end] = true;
        const double limit = shear_limit(corner, bed.normal_n_s[corner.end]);
        // a tenth of the velocity that friction changes in a step is slip; less is what the sweeps have left
        if (std::abs(bed.shear_n_s[corner.end]) >= 0.999 * limit &&
            std::abs(vt) > 0.1 * corner.mu * h * model.gravity_m_s2)
            sliding[corner.bed] = vt;
    }
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        if (mover(model, i) != i)
            continue;
        BodyState& body = state.bodies[b];
        body.vx = speeds[i].x;
        body.vy = speeds[i].y;
        body.omega = speeds[i].turn;
        body.x = middle.bodies[b].x + 0.5 * h * body.vx;
        body.y = middle.bodies[b].y + 0.5 * h * body.vy;
        body.theta = middle.bodies[b].theta + 0.5 * h * body.omega;
        slosh(model, i, body, (body.vx - before[i].x) / h);
    }
    carry(model, base_after, state);
    for (int j = 0; j < model.bed_count; ++j) {
        const Bed& bed = model.beds[static_cast<std::size_t>(j)];
        if (!can_move(model, bed))
            continue;
        const double turning =
            state.bodies[static_cast<std::size_t>(bed.upper)].omega -
            (bed.lower < 0 ? base_after.omega : state.bodies[static_cast<std::size_t>(bed.lower)].omega);
        remember(model, j, state.beds[static_cast<std::size_t>(j)], ends[j].position, sliding[j], shear[j], turning);
    }
    ++state.step;
}

} // namespace stylobate::hidden
