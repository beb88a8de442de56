#include "tests/hidden/specimen.hpp"

#include "tests/hidden/laws/stepper.hpp"
#include "tests/hidden/shake.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

namespace {

void add_block(Specimen& specimen, double width, double height, double depth, double mass, double x, double bottom)
{
    specimen.half_width_m.push_back(width / 2);
    specimen.half_height_m.push_back(height / 2);
    specimen.depth_m.push_back(depth);
    specimen.mass_kg.push_back(mass);
    specimen.rest_x_m.push_back(x);
    specimen.rest_y_m.push_back(bottom + height / 2);
}

double inertia_of(const Body& body)
{
    return body.mass_kg * (body.half_width_m * body.half_width_m + body.half_height_m * body.half_height_m) / 3;
}

} // namespace

Planned plan_specimen(SpecimenKind kind, Draws& draws)
{
    Planned planned;
    planned.kind = kind;
    Specimen& s = planned.specimen;
    planned.band = {3, 7, 4};
    planned.camera_m = 5e-5;
    planned.camera_rad = 1e-3;
    planned.sensor_m = 2e-5;
    double slender = 0; // width over height of what rocks as one
    switch (kind) {
    case SpecimenKind::small_column: {
        const int blocks = 3 + draws.below(4);
        s.name = "column of " + std::to_string(blocks) + " small blocks";
        s.friction_nominal = 0.68;
        s.base_block_half_width_m = 0.024;
        s.base_block_top_m = 0.029;
        for (int i = 0; i < blocks; ++i) {
            add_block(s, 0.048, 0.029, 0.048, 0.1355, 0, 0.029 * (i + 1));
            s.joints.emplace_back(i - 1, i);
        }
        slender = 0.048 / (0.029 * blocks);
        break;
    }
    case SpecimenKind::two_drums:
        s.name = "column of two drums";
        s.friction_nominal = 0.65;
        add_block(s, 0.06, 0.05, 0.06, 0.375, 0, 0);
        add_block(s, 0.06, 0.05, 0.06, 0.375, 0, 0.05);
        s.joints = {{-1, 0}, {0, 1}};
        slender = 0.6;
        break;
    case SpecimenKind::frame:
        s.name = "two monolithic columns with an epistyle";
        s.friction_nominal = 0.65;
        add_block(s, 0.06, 0.1, 0.06, 0.75, -0.045, 0);
        add_block(s, 0.06, 0.1, 0.06, 0.75, 0.045, 0);
        add_block(s, 0.15, 0.06, 0.06, 1.14, 0, 0.1);
        s.joints = {{-1, 0}, {-1, 1}, {0, 2}, {1, 2}};
        slender = 0.58;
        break;
    case SpecimenKind::frame_of_drums:
        s.name = "two columns of two drums with an epistyle";
        s.friction_nominal = 0.65;
        for (const double x : {-0.045, 0.045})
            for (const double bottom : {0.0, 0.05})
                add_block(s, 0.06, 0.05, 0.06, 0.375, x, bottom);
        add_block(s, 0.15, 0.06, 0.06, 1.14, 0, 0.1);
        s.joints = {{-1, 0}, {0, 1}, {-1, 2}, {2, 3}, {1, 4}, {3, 4}};
        slender = 0.58;
        break;
    case SpecimenKind::full_scale_column: {
        const int drums = 4 + draws.below(3);
        s.name = "column of " + std::to_string(drums) + " drums at full scale";
        s.friction_nominal = 0.7;
        for (int i = 0; i < drums; ++i) {
            add_block(s, 1.5, 1, 1.5, 4771, 0, i);
            s.joints.emplace_back(i - 1, i);
        }
        slender = 1.5 / drums;
        planned.band = {0.7, 2, 8};
        planned.camera_m = 4e-4;
        planned.camera_rad = 4e-4;
        planned.sensor_m = 2e-4;
        break;
    }
    }
    s.placement_tolerance_m = 0.008 * s.half_width_m.front();
    planned.rocking_m_s2 = s.gravity_m_s2 * std::min(slender, *s.friction_nominal);
    return planned;
}

Model make_specimen(const Planned& planned, Law law, Draws making, Draws parameters)
{
    const Specimen& s = planned.specimen;
    Model model;
    model.law = law;
    model.gravity_m_s2 = s.gravity_m_s2;
    model.body_count = s.blocks();
    model.bed_count = static_cast<int>(s.joints.size());
    model.base_half_width_m = s.base_block_half_width_m.value_or(10);
    model.base_top_m = s.base_block_top_m;
    double mass = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i) {
        Body& body = model.bodies[i];
        body = {s.half_width_m[i], s.half_height_m[i], s.mass_kg[i], 0, s.rest_x_m[i]};
        mass += s.mass_kg[i] / s.blocks();
    }
    for (std::size_t j = 0; j < s.joints.size(); ++j)
        model.beds[j] = {s.joints[j].first, s.joints[j].second, s.friction_nominal.value()};
    scatter(model, s, making);

    LawParameters& p = model.parameters;
    const double width = s.half_width_m.front();
    double step = 0;
    if (law == Law::nonsmooth) {
        p.restitution = parameters.uniform(0, 0.3);
        step = 2e-4 * std::sqrt(width / 0.024); // rocking is slower the larger the blocks
        step = std::min(step, 5e-4);
    } else {
        // under its share of one block's weight a corner sinks by so much; the clock of the bed is then its root
        const double depth = width * 0.024 * parameters.log_uniform(0.004, 0.01);
        p.reference_m = depth;
        p.stiffness_n_m = 0.5 * mass * s.gravity_m_s2 / (depth * std::sqrt(depth));
        // of a corner that lands with the velocity of a fall through a hundredth of the width
        p.damping_s_m = parameters.uniform(0.5, 1.5) / std::sqrt(0.02 * s.gravity_m_s2 * width);
        p.bristle_m = depth * parameters.uniform(0.3, 1);
        const double clock = std::sqrt(depth / (1.5 * s.gravity_m_s2));
        p.bristle_time_s = 0.2 * clock;
        step = 0.19 * clock;
    }
    model.step_s = frame_s / std::ceil(frame_s / step);
    return model;
}

void scatter(Model& model, const Specimen& specimen, Draws& draws)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i) {
        Body& body = model.bodies[i];
        body.half_width_m *= 1 + specimen.width_tolerance * draws.normal();
        body.mass_kg *= 1 + specimen.mass_tolerance * draws.normal();
        body.inertia_kg_m2 = inertia_of(body);
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(model.bed_count); ++j)
        model.beds[j].friction *= 1 + friction_scatter * draws.normal();
}

State laid_by_hand(const Model& model, const Specimen& specimen, Draws placement)
{
    State state;
    // laid bed by bed, each block on the face below it; what lies on two columns on the second, and settles
    for (int j = 0; j < model.bed_count; ++j) {
        const Bed& bed = model.beds[static_cast<std::size_t>(j)];
        const auto upper = static_cast<std::size_t>(bed.upper);
        const BodyEffect& effect = model.effects.bodies[upper];
        const Body& body = model.bodies[upper];
        const double x = body.rest_x_m + effect.offset_m + specimen.placement_tolerance_m * placement.normal();
        double theta = model.effects.beds[static_cast<std::size_t>(j)].wedge_rad, top_x = 0, top_y = model.base_top_m;
        if (bed.lower >= 0) {
            const auto lower = static_cast<std::size_t>(bed.lower);
            double low_x = 0, low_y = 0;
            geometric_centre(model, bed.lower, state.bodies[lower], low_x, low_y);
            const double turn = state.bodies[lower].theta, half = model.bodies[lower].half_height_m;
            top_x = low_x - half * std::sin(turn);
            top_y = low_y + half * std::cos(turn);
            theta += turn;
        }
        const double face_y = top_y + (x - top_x) * std::tan(theta);
        const double cx = x - body.half_height_m * std::sin(theta), cy = face_y + body.half_height_m * std::cos(theta);
        BodyState& put = state.bodies[upper];
        put.theta = theta;
        put.x = cx + effect.eccentricity_m * std::cos(theta);
        put.y = cy + effect.eccentricity_m * std::sin(theta);
    }
    return state;
}

void let_rest(const Model& model, State& state)
{
    // until it rests: on a still table, with the velocities fading (in a time that belongs to the block's size)
    Shaking still;
    still.duration_s = 2 * model.step_s;
    const TableMotion motion(still, {}, model.step_s);
    const Table table{&motion, 0, {}, 0.5 * model.step_s};
    const double size_s = std::sqrt(model.bodies[0].half_width_m / model.gravity_m_s2);
    const double fade = std::exp(-model.step_s / (0.2 * size_s));
    const long steps = std::lround(4 * size_s / model.step_s);
    // nothing is worn by being put there, and what depends on the time has not begun
    Model resting = model;
    for (BedEffect& effect : resting.effects.beds)
        effect.dowel_n_m = effect.tension_n_m = 0;
    resting.rod_count = 0;
    for (state.step = -steps; state.step < 0;) {
        step(resting, table, state);
        for (BodyState& body : state.bodies) {
            body.vx *= fade;
            body.vy *= fade;
            body.omega *= fade;
        }
    }
    for (int j = 0; j < model.bed_count; ++j) {
        BedState& bed = state.beds[static_cast<std::size_t>(j)];
        if (!can_move(model, model.beds[static_cast<std::size_t>(j)]))
            continue;
        const BedEnds ends = ends_of_bed(model, j, state, {});
        bed.slip_m = bed.heat_j = bed.turned_rad = 0;
        bed.slipped = false;
        bed.dowel_at_m = ends.position;
        bed.width_m = bed.width_at_rest_m = ends.width;
    }
}

State put_on_table(const Model& model, const Specimen& specimen, Draws placement)
{
    State state = laid_by_hand(model, specimen, placement);
    let_rest(model, state);
    return state;
}

} // namespace stylobate::hidden
