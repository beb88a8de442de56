#include "tests/hidden/joint_setup.hpp"

#include "ensemble/model/input_error.hpp"
#include "tests/hidden/laws/forces.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate::hidden {

namespace {

constexpr double rod_damping = 0.05;   ///< of rod and gauge, over the critical one of the body that is tested
constexpr double rod_stroke = 1 / 2.4; ///< of a rod's end, over the half width of its block: 10 mm of small ones

/// What is rigid with the table: all that stands on it through clamped joints.
void clamp_to_table(Model& model, const State& laid, const std::vector<int>& clamped)
{
    for (std::size_t pass = 0; pass < clamped.size(); ++pass)
        for (const int joint : clamped) {
            const Bed& bed = model.beds[static_cast<std::size_t>(joint)];
            const auto upper = static_cast<std::size_t>(bed.upper);
            if (mover(model, bed.lower) != on_table || mover(model, bed.upper) == away)
                continue;
            Body& body = model.bodies[upper];
            body.carrier = on_table;
            body.held_x_m = laid.bodies[upper].x;
            body.held_y_m = laid.bodies[upper].y;
            body.held_rad = laid.bodies[upper].theta;
        }
}

/// A body of the composite: its centre of mass and inertia about it.
struct Piece {
    double mass, inertia, x, y;
};

Piece piece_of(const Dummy& dummy, const BodyState& on, double centre_x, double centre_y)
{
    const double c = std::cos(on.theta), s = std::sin(on.theta);
    return {dummy.mass_kg,
            dummy.mass_kg * (dummy.half_width_m * dummy.half_width_m + dummy.half_height_m * dummy.half_height_m) / 3,
            centre_x + c * dummy.x_m - s * dummy.y_m, centre_y + s * dummy.x_m + c * dummy.y_m};
}

/// Makes one body of blocks and the dummies on them; the first block carries the others. Forces on a block alone act at
/// the common centre of mass.
void tape(Model& model, State& state, const std::vector<int>& blocks, const std::vector<Dummy>& dummies)
{
    std::vector<Piece> pieces;
    for (const int block : blocks) {
        const auto b = static_cast<std::size_t>(block);
        pieces.push_back(
            {model.bodies[b].mass_kg, model.bodies[b].inertia_kg_m2, state.bodies[b].x, state.bodies[b].y});
        double x = 0, y = 0;
        geometric_centre(model, block, state.bodies[b], x, y);
        for (const Dummy& dummy : dummies)
            if (dummy.block == block)
                pieces.push_back(piece_of(dummy, state.bodies[b], x, y));
    }
    if (pieces.size() == 1)
        return;
    double mass = 0, inertia = 0, x = 0, y = 0;
    for (const Piece& piece : pieces) {
        mass += piece.mass;
        x += piece.mass * piece.x;
        y += piece.mass * piece.y;
    }
    x /= mass;
    y /= mass;
    for (const Piece& piece : pieces)
        inertia += piece.inertia + piece.mass * ((piece.x - x) * (piece.x - x) + (piece.y - y) * (piece.y - y));

    const auto first = static_cast<std::size_t>(blocks.front());
    Body& body = model.bodies[first];
    BodyState& own = state.bodies[first];
    BodyEffect& effect = model.effects.bodies[first];
    const double c = std::cos(own.theta), s = std::sin(own.theta);
    for (std::size_t k = 1; k < blocks.size(); ++k) {
        const auto b = static_cast<std::size_t>(blocks[k]);
        Body& other = model.bodies[b];
        other.carrier = blocks.front();
        const double dx = state.bodies[b].x - x, dy = state.bodies[b].y - y;
        other.held_x_m = c * dx + s * dy;
        other.held_y_m = c * dy - s * dx;
        other.held_rad = state.bodies[b].theta - own.theta;
        const BodyEffect& its = model.effects.bodies[b];
        effect.drag_kg_m += its.drag_kg_m;
        effect.draught_n += its.draught_n;
        effect.spin_n_m_s += its.spin_n_m_s;
    }
    double centre_x = 0, centre_y = 0;
    geometric_centre(model, blocks.front(), own, centre_x, centre_y);
    body.mass_x_m = c * (x - centre_x) + s * (y - centre_y);
    body.mass_y_m = c * (y - centre_y) - s * (x - centre_x);
    effect.eccentricity_m = 0;
    // of the block's own mass alone
    effect.slosh_ratio *= body.mass_kg / mass;
    effect.coriolis_per_s *= body.mass_kg / mass;
    body.mass_kg = mass;
    body.inertia_kg_m2 = inertia;
    own.x = x;
    own.y = y;
}

/// The body that moves with a block, with all that is taped to it.
void tape_all(Model& model, State& state, const MeasuredRun& planned)
{
    std::vector<bool> done(max_bodies, false);
    const auto one = [&](const std::vector<int>& group) {
        std::vector<int> there;
        bool fixed = false;
        for (const int block : group) {
            fixed = fixed || mover(model, block) == on_table;
            if (mover(model, block) != away && !done[static_cast<std::size_t>(block)])
                there.push_back(block);
        }
        for (const int block : there) {
            const auto b = static_cast<std::size_t>(block);
            done[b] = true;
            if (fixed) {
                Body& body = model.bodies[b];
                body.carrier = on_table;
                body.held_x_m = state.bodies[b].x;
                body.held_y_m = state.bodies[b].y;
                body.held_rad = state.bodies[b].theta;
            }
        }
        if (!fixed && !there.empty())
            tape(model, state, there, planned.dummies);
    };
    for (const std::vector<int>& group : planned.taped)
        one(group);
    for (int i = 0; i < model.body_count; ++i)
        one({i});
}

void set_rods(const VirtualCampaign& made, const MeasuredRun& planned, Model& model)
{
    for (const ForceGauge& gauge : planned.forces) {
        const auto b = static_cast<std::size_t>(gauge.block);
        const Body& block = made.model.bodies[b];
        const auto on = static_cast<std::size_t>(mover(model, gauge.block));
        Rod& rod = model.rods[static_cast<std::size_t>(model.rod_count++)];
        rod = {};
        rod.body = gauge.block;
        rod.height_m = gauge.height_m;
        rod.to_table = !gauge.to_laboratory;
        rod.side = gauge.to_laboratory ? 0 : std::copysign(1.0, gauge.speed_m_s);
        // not stated: a small block's weight bends the rod by a 350th of the half width
        rod.stiffness_n_m = gauge.stiffness_n_m > 0 ? gauge.stiffness_n_m
                                                    : 350 * block.mass_kg * model.gravity_m_s2 / block.half_width_m;
        rod.damping_n_s_m = 2 * rod_damping * std::sqrt(rod.stiffness_n_m * model.bodies[on].mass_kg);
        rod.speed_m_s = gauge.speed_m_s;
        rod.from_s = rod.to_s = rod_start_s;
        if (gauge.speed_m_s != 0)
            rod.to_s += rod_stroke * made.planned.specimen.half_width_m[b] / std::abs(gauge.speed_m_s);
    }
}

} // namespace

JointSetup set_up(const VirtualCampaign& made, const MeasuredRun& planned, int number, const State* worn)
{
    JointSetup setup;
    Model& model = setup.model = made.model;
    const Draws hands(made.seed, Draw::test_placement, static_cast<std::uint64_t>(number));
    setup.start = laid_by_hand(model, made.planned.specimen, hands);
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        double y = 0;
        geometric_centre(model, i, setup.start.bodies[b], setup.laid_off_m[b], y);
        setup.laid_off_m[b] -= model.bodies[b].rest_x_m;
        if (!planned.has(i))
            model.bodies[b].carrier = away;
    }
    clamp_to_table(model, setup.start, planned.clamped);
    tape_all(model, setup.start, planned);
    set_rods(made, planned, model);
    if (worn != nullptr)
        for (std::size_t j = 0; j < max_beds; ++j)
            setup.start.beds[j].turned_rad = worn->beds[j].turned_rad;
    return setup;
}

void hold(const Model& model, int body, double x, double y, double theta, BodyState& state)
{
    state = {};
    state.theta = theta;
    double from_x = 0, from_y = 0;
    geometric_centre(model, body, state, from_x, from_y);
    state.x = x - from_x;
    state.y = y - from_y;
}

void check_plan(const VirtualCampaign& made, const MeasuredRun& planned)
{
    const auto refuse = [&](const std::string& text) {
        throw InputError(fmt::format("run {}", planned.name), 0, text + "\n  Correct the plan of this test.");
    };
    const int blocks = made.model.body_count, joints = made.model.bed_count;
    const auto check = [&](const std::vector<int>& list, int count, const char* what) {
        for (const int one : list)
            if (one < 0 || one >= count)
                refuse(fmt::format("{} {} is outside 0 to {}.", what, one, count - 1));
    };
    if (planned.test == RunKind::shake)
        refuse("it is a shake, not a test on a joint.");
    check(planned.present, blocks, "block");
    check(planned.clamped, joints, "clamped joint");
    for (const auto& group : planned.taped)
        check(group, blocks, "taped block");
    for (const Dummy& dummy : planned.dummies) {
        check({dummy.block}, blocks, "block of a dummy");
        if (!(dummy.mass_kg > 0 && dummy.half_width_m > 0 && dummy.half_height_m > 0))
            refuse(fmt::format("the dummy on block {} has no mass or no size.", dummy.block));
    }
    if (planned.forces.size() > max_rods)
        refuse(fmt::format("it has {} force gauges; the laboratory has {}.", planned.forces.size(), max_rods));
    for (const ForceGauge& gauge : planned.forces) {
        check({gauge.block}, blocks, "block of a force gauge");
        if (!planned.has(gauge.block))
            refuse(fmt::format("the force gauge acts on block {}, which is not there.", gauge.block));
        if (!gauge.to_laboratory && gauge.speed_m_s == 0)
            refuse("the rod on the table has no speed, so the side on which it pushes is not known.");
    }
    if (planned.test == RunKind::rest && planned.time_s.empty())
        return;
    const std::size_t nt = planned.time_s.size();
    if (nt < 2 || !(planned.time_s[1] > planned.time_s[0]))
        refuse("time_s has no two times that grow.");
    for (std::size_t k = 0; k < nt; ++k) {
        const double even = planned.time_s[0] + (planned.time_s[nt - 1] - planned.time_s[0]) * static_cast<double>(k) /
                                                    static_cast<double>(nt - 1);
        if (!(std::abs(planned.time_s[k] - even) < 0.01 * (planned.time_s[1] - planned.time_s[0])))
            refuse(fmt::format("time_s is not equally spaced at sample {}.", k));
    }
    for (const Series* series : {&planned.base_displacement_m, &planned.base_tilt_rad})
        if (!series->empty() && series->values.size() != nt)
            refuse(fmt::format("a motion of the table has {} samples instead of {}.", series->values.size(), nt));
    for (const Series* series : {&planned.blocks.x_m, &planned.blocks.y_m, &planned.blocks.theta_rad})
        if (planned.released_s && series->values.size() != nt * static_cast<std::size_t>(blocks))
            refuse("hands hold blocks until released_s, but their places are not given.");
}

} // namespace stylobate::hidden
