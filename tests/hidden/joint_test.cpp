#include "tests/hidden/joint_test.hpp"

#include "ensemble/model/input_error.hpp"
#include "tests/hidden/joint_setup.hpp"
#include "tests/hidden/laws/forces.hpp"
#include "tests/hidden/sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

namespace {

constexpr double gauge_of_weight = 0.015; ///< noise of a force gauge over the weight of its block: 0.02 N of small ones
constexpr double gauge_gain = 0.005;      ///< 1 sigma of its gain, where the plan does not state it
constexpr double inclinometer_rad = 5e-4; ///< its noise, 1 sigma

/// A planned series between its samples: cubic, with differences of the fourth order as slopes.
class PlannedSeries {
public:
    PlannedSeries(const std::vector<double>& values, double spacing_s) : values_(values), dt_(spacing_s)
    {
        const auto n = static_cast<long>(values.size());
        for (long k = 0; k < n; ++k) {
            slopes_.push_back((at(k - 2) - 8 * at(k - 1) + 8 * at(k + 1) - at(k + 2)) / (12 * dt_));
            bends_.push_back((-at(k - 2) + 16 * at(k - 1) - 30 * at(k) + 16 * at(k + 1) - at(k + 2)) /
                             (12 * dt_ * dt_));
        }
    }

    /// @param time since the first sample
    Jet operator()(double time) const
    {
        if (values_.empty())
            return {};
        const auto last = static_cast<double>(values_.size() - 1);
        const double place = std::clamp(time / dt_, 0.0, last);
        const auto k = static_cast<std::size_t>(std::min(place, std::max(last - 1, 0.0)));
        const double p = place - static_cast<double>(k), q = 1 - p;
        const double from = values_[k], to = values_[k + 1], left = dt_ * slopes_[k], right = dt_ * slopes_[k + 1];
        return {q * q * (1 + 2 * p) * from + p * p * (3 - 2 * p) * to + p * q * (q * left - p * right),
                (6 * p * q * (to - from) + q * (1 - 3 * p) * left + p * (3 * p - 2) * right) / dt_,
                q * bends_[k] + p * bends_[k + 1]};
    }

    double peak() const
    {
        double most = 0;
        for (const double value : values_)
            most = std::max(most, std::abs(value));
        return most;
    }

private:
    double at(long k) const
    {
        return values_[static_cast<std::size_t>(std::clamp(k, 0L, static_cast<long>(values_.size()) - 1))];
    }

    std::vector<double> values_, slopes_, bends_;
    double dt_;
};

/// What the table is commanded in a test.
struct Commanded {
    PlannedSeries displacement, tilt;
    BaseEffect effect;

    Commanded(const MeasuredRun& planned, const BaseEffect& of_table, double dt)
        : displacement(planned.base_displacement_m.values, dt), tilt(planned.base_tilt_rad.values, dt), effect(of_table)
    {
        if (displacement.peak() == 0)
            effect.distortion_ratio = 0;
    }

    TableMotion motion(double duration_s, double step_s) const
    {
        std::vector<BaseState> states;
        const long half_steps = 2 * std::lround(duration_s / step_s);
        for (long i = 0; i <= half_steps; ++i) {
            const double t = 0.5 * step_s * static_cast<double>(i);
            BaseState base = table_at(displacement(t), effect, displacement.peak());
            base.theta += tilt(t).u;
            base.omega = states.empty() ? 0 : (base.theta - states.back().theta) / (0.5 * step_s);
            states.push_back(base);
        }
        return TableMotion(std::move(states));
    }
};

/// A run as it truly was.
struct TrueTest {
    bool collapsed = false;
    std::size_t frames = 0;                  ///< before it
    std::vector<BodyState> places;           ///< (frames x blocks) geometric centres as the cameras see them
    std::vector<BodyState> table;            ///< (frames)
    std::vector<std::vector<double>> forces; ///< of each rod
};

/// A test while it runs.
class Running {
public:
    Running(const VirtualCampaign& made, const MeasuredRun& planned, int number, const State* worn)
        : planned_(planned), setup_(set_up(made, planned, number, worn)),
          dt_((planned.time_s.back() - planned.time_s.front()) / static_cast<double>(planned.time_s.size() - 1)),
          commanded_(planned, made.model.effects.base, dt_), motion_({})
    {
        Model& model = setup_.model;
        per_frame_ = static_cast<long>(std::ceil(dt_ / model.step_s - 1e-9));
        model.step_s = dt_ / static_cast<double>(per_frame_);
        motion_ = commanded_.motion(dt_ * static_cast<double>(planned.time_s.size() - 1), model.step_s);
        table_ = {&motion_, 0, {}, 0.5 * model.step_s};
        state_ = setup_.start;
        let_rest(model, state_);
        if (worn != nullptr)
            for (std::size_t j = 0; j < max_beds; ++j)
                remember_from(worn->beds[j], state_.beds[j]);
        go_with_table(table_.at(0));
        rest_ = state_;
        for (int r = 0; r < model.rod_count; ++r) {
            Rod& rod = model.rods[static_cast<std::size_t>(r)];
            double velocity = 0;
            rod_tip(rod, model, state_, table_.at(0), rod.end_m, velocity);
        }
        Draws hands(made.seed, Draw::test_release, static_cast<std::uint64_t>(number));
        level_rad_ = made.planned.camera_rad * hands.normal();
    }

    TrueTest run()
    {
        TrueTest seen;
        seen.forces.resize(static_cast<std::size_t>(setup_.model.rod_count));
        for (std::size_t k = 0; k < planned_.time_s.size(); ++k) {
            const bool held = planned_.released_s && planned_.time_s[k] <= *planned_.released_s + 1e-9;
            if (held) {
                state_.step = static_cast<long>(k) * per_frame_;
                hold_all(k);
            } else if (k > 0) {
                for (long n = 0; n < per_frame_; ++n)
                    step(setup_.model, table_, state_);
            }
            if (!held && fallen()) {
                seen.collapsed = true;
                break;
            }
            look(k, seen);
        }
        return seen;
    }

    const State& state() const { return state_; }
    const Commanded& commanded() const { return commanded_; }
    double spacing_s() const { return dt_; }

private:
    static void remember_from(const BedState& worn, BedState& bed)
    {
        bed.slip_m = worn.slip_m;
        bed.turned_rad = worn.turned_rad;
        bed.slipped = worn.slipped;
        bed.opened[0] = worn.opened[0];
        bed.opened[1] = worn.opened[1];
    }

    /// From the table at rest in its middle to where its motion begins.
    void go_with_table(const BaseState& base)
    {
        const double c = std::cos(base.theta), s = std::sin(base.theta);
        for (BodyState& body : state_.bodies) {
            const double x = body.x, y = body.y;
            body.x = base.x + c * x - s * y;
            body.y = base.y + s * x + c * y;
            body.theta += base.theta;
        }
    }

    void hold_all(std::size_t k)
    {
        const Model& model = setup_.model;
        const auto blocks = static_cast<std::size_t>(model.body_count);
        for (std::size_t i = 0; i < blocks; ++i) {
            const double x = planned_.blocks.x_m.values[k * blocks + i];
            if (mover(model, static_cast<int>(i)) != static_cast<int>(i) || !std::isfinite(x))
                continue;
            hold(model, static_cast<int>(i), x + setup_.laid_off_m[i], planned_.blocks.y_m.values[k * blocks + i],
                 planned_.blocks.theta_rad.values[k * blocks + i] + level_rad_, state_.bodies[i]);
        }
        carry(model, table_.at(2 * state_.step), state_);
        for (std::size_t j = 0; j < static_cast<std::size_t>(model.bed_count); ++j)
            if (can_move(model, model.beds[j])) { // what was lifted is no longer bonded
                BedState& bed = state_.beds[j];
                bed.slipped = bed.opened[0] = bed.opened[1] = true;
                bed.bristle[0] = bed.bristle[1] = 0;
            }
    }

    bool fallen() const
    {
        const Model& model = setup_.model;
        const BaseState base = table_.at(2 * state_.step);
        const auto height = [&](const BodyState& body) {
            return std::cos(base.theta) * (body.y - base.y) - std::sin(base.theta) * (body.x - base.x);
        };
        for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i) {
            if (mover(model, static_cast<int>(i)) != static_cast<int>(i))
                continue;
            const BodyState& body = state_.bodies[i];
            // negated, so that what is not a number has fallen
            if (!(std::abs(body.theta - base.theta) <= 0.7) || height(body) < 0.6 * rest_.bodies[i].y)
                return true;
        }
        for (std::size_t j = 0; j < static_cast<std::size_t>(model.bed_count); ++j)
            if (state_.beds[j].width_m < 0.1 * state_.beds[j].width_at_rest_m)
                return true;
        return false;
    }

    /// What the cameras and gauges meet in this frame.
    void look(std::size_t k, TrueTest& seen_test) const
    {
        const Model& model = setup_.model;
        const BaseState base = table_.at(2 * state_.step);
        // the cameras turn with the board
        const double turned = commanded_.tilt(dt_ * static_cast<double>(k)).u;
        const double c = std::cos(turned), s = std::sin(turned);
        for (int i = 0; i < model.body_count; ++i) {
            BodyState place = seen(model, i, state_.bodies[static_cast<std::size_t>(i)]);
            const double x = place.x - base.x, y = place.y - base.y;
            place.x = base.x + c * x + s * y;
            place.y = base.y + c * y - s * x;
            place.theta -= turned;
            seen_test.places.push_back(place);
        }
        BodyState table;
        table.x = base.x;
        table.y = base.y;
        table.theta = base.theta - turned;
        seen_test.table.push_back(table);
        for (int r = 0; r < model.rod_count; ++r)
            seen_test.forces[static_cast<std::size_t>(r)].push_back(
                rod_force(model, model.rods[static_cast<std::size_t>(r)], state_, base,
                          static_cast<double>(state_.step) * model.step_s));
        ++seen_test.frames;
    }

    const MeasuredRun& planned_;
    JointSetup setup_;
    double dt_;
    Commanded commanded_;
    TableMotion motion_;
    long per_frame_ = 1;
    Table table_;
    State state_, rest_;
    double level_rad_ = 0;
};

/// What the table's sensors give: of what was planned.
void sense_table(const VirtualCampaign& made, const Commanded& commanded, double dt, int number, MeasuredRun& run)
{
    Draws table(made.seed, Draw::test_table, static_cast<std::uint64_t>(number));
    const double zero = 100 * made.planned.sensor_m * table.normal();
    const BaseEffect& effect = commanded.effect;
    run.base_source = made.of_command ? BaseSource::command : BaseSource::table_sensor;
    if (!run.base_displacement_m.empty()) {
        run.base_acceleration_m_s2.values.clear();
        for (std::size_t k = 0; k < run.time_s.size(); ++k) {
            const double at = dt * static_cast<double>(k) - effect.time_offset_s; // the clock of the file
            const Jet u = reported(commanded.displacement(at), effect, made.of_command, commanded.displacement.peak());
            run.base_displacement_m.values[k] = u.u + zero;
            run.base_acceleration_m_s2.values.push_back(u.a);
        }
        add_noise(run.base_acceleration_m_s2, sensor_m_s2, table);
        add_noise(run.base_displacement_m, made.planned.sensor_m, table);
    }
    if (!run.base_tilt_rad.empty())
        add_noise(run.base_tilt_rad, inclinometer_rad, table);
}

/// What the cameras give: nothing of blocks that are not there, and nothing after a collapse.
void see_blocks(const VirtualCampaign& made, const MeasuredRun& planned, const TrueTest& truth, int number,
                MeasuredRun& run)
{
    Draws cameras(made.seed, Draw::test_cameras, static_cast<std::uint64_t>(number));
    const double zero = 20 * made.planned.camera_m * cameras.normal();
    const auto blocks = static_cast<std::size_t>(made.model.body_count);
    std::vector<const BodyState*> places, tables;
    for (std::size_t k = 0; k < run.time_s.size(); ++k) {
        for (std::size_t i = 0; i < blocks; ++i) {
            const bool there = planned.present.empty() || std::find(planned.present.begin(), planned.present.end(),
                                                                    static_cast<int>(i)) != planned.present.end();
            places.push_back(there && k < truth.frames ? &truth.places[k * blocks + i] : nullptr);
        }
        if (made.table_seen)
            tables.push_back(k < truth.frames ? &truth.table[k] : nullptr);
    }
    run.blocks = by_cameras(places, zero, made.planned, cameras);
    run.table = by_cameras(tables, zero, made.planned, cameras);
}

/// What the force gauges give; after a collapse their rods touch nothing.
void weigh_forces(const VirtualCampaign& made, const TrueTest& truth, int number, MeasuredRun& run)
{
    Draws draws(made.seed, Draw::test_gauge, static_cast<std::uint64_t>(number));
    for (std::size_t r = 0; r < run.forces.size(); ++r) {
        ForceGauge& gauge = run.forces[r];
        if (gauge.gain_sd == 0)
            gauge.gain_sd = gauge_gain;
        const double gain = 1 + gauge.gain_sd * draws.normal();
        const double weight =
            made.planned.specimen.mass_kg[static_cast<std::size_t>(gauge.block)] * made.model.gravity_m_s2;
        const double noise = gauge.value_n.noise_sd.value_or(gauge_of_weight * weight);
        gauge.value_n.values.clear();
        for (std::size_t k = 0; k < run.time_s.size(); ++k)
            gauge.value_n.values.push_back(k < truth.frames ? gain * truth.forces[r][k] : 0);
        add_noise(gauge.value_n, noise, draws);
    }
}

/// Whether a run has what only a measurement gives: forces, or places of blocks that no hands hold.
bool is_measured(const MeasuredRun& run, int blocks)
{
    for (const ForceGauge& gauge : run.forces)
        if (!gauge.value_n.empty())
            return true;
    const std::vector<double>& x = run.blocks.x_m.values;
    for (std::size_t k = 0; k < x.size(); ++k)
        if (std::isfinite(x[k]) &&
            !(run.released_s && run.time_s[k / static_cast<std::size_t>(blocks)] <= *run.released_s + 1e-9))
            return true;
    return false;
}

} // namespace

MeasuredRun performed(const VirtualCampaign& made, const MeasuredRun& planned, int number, const State* worn,
                      State* end)
{
    check_plan(made, planned);
    MeasuredRun run = planned;
    run.run_order = number;
    if (planned.test == RunKind::rest && planned.time_s.empty()) {
        if (end != nullptr)
            *end = worn != nullptr ? *worn : State{};
        return run;
    }
    Running test(made, planned, number, worn);
    const TrueTest truth = test.run();
    run.collapsed = truth.collapsed;
    run.collapse_time_s = truth.collapsed ? run.time_s[truth.frames] : -1;
    sense_table(made, test.commanded(), test.spacing_s(), number, run);
    see_blocks(made, planned, truth, number, run);
    weigh_forces(made, truth, number, run);
    if (end != nullptr)
        *end = test.state();
    return run;
}

Specimen measured_at_rest(const VirtualCampaign& made, int number, const State* worn)
{
    Specimen measured = made.planned.specimen;
    const double noise = 2 * made.planned.camera_m;
    Draws draws(made.seed, Draw::callipers, static_cast<std::uint64_t>(number));
    measured.centre_of_mass_m.clear();
    for (std::size_t i = 0; i < measured.mass_kg.size(); ++i)
        measured.centre_of_mass_m.push_back(made.model.effects.bodies[i].eccentricity_m + noise * draws.normal());
    Specimen exactly = made.planned.specimen;
    exactly.placement_tolerance_m = 0;
    State state = laid_by_hand(made.model, exactly, Draws(made.seed, Draw::test_placement));
    measured.bearing_left_m.clear();
    measured.bearing_right_m.clear();
    for (int j = 0; j < made.model.bed_count; ++j) {
        const auto b = static_cast<std::size_t>(j);
        if (worn != nullptr)
            state.beds[b].turned_rad = worn->beds[b].turned_rad;
        const auto upper = static_cast<std::size_t>(made.model.beds[b].upper);
        const BedEnds ends = ends_of_bed(made.model, j, state, {});
        double x = 0, y = 0;
        geometric_centre(made.model, static_cast<int>(upper), state.bodies[upper], x, y);
        const double half = made.model.bodies[upper].half_width_m;
        const double c = std::cos(state.bodies[upper].theta), s = std::sin(state.bodies[upper].theta);
        const auto along = [&](const BedEnd& at) { return (at.x - x) * c + (at.y - y) * s; };
        measured.bearing_left_m.push_back(half + along(ends.end[0]) + noise * draws.normal());
        measured.bearing_right_m.push_back(half - along(ends.end[1]) + noise * draws.normal());
    }
    return measured;
}

Campaign tested(const VirtualCampaign& made, const Campaign& planned)
{
    if (planned.specimen.joints != made.planned.specimen.joints ||
        planned.specimen.blocks() != made.planned.specimen.blocks())
        throw InputError(planned.source, 0,
                         fmt::format("its specimen is not the one of the campaign, a {} of {} blocks and {} joints.\n  "
                                     "Give the plan of a test of that campaign.",
                                     made.planned.specimen.name, made.planned.specimen.blocks(),
                                     made.planned.specimen.joints.size()));
    Campaign done = planned;
    std::ranges::stable_sort(done.tests, {}, [](const MeasuredRun& run) { return run.run_order.value_or(0); });
    const bool persists = made.model.effects.persists;
    State state;
    const State* worn = nullptr;
    if (persists && !made.runs.empty()) {
        state = made.runs.back().history.end;
        worn = &state;
    }
    int number = 0;
    for (MeasuredRun& run : done.tests) {
        if (is_measured(run, planned.specimen.blocks()))
            throw InputError(planned.source, 0,
                             fmt::format("run {} is measured already.\n  Give plans alone, in their order: what is "
                                         "repeated is the same again.",
                                         run.name));
        if (run.test == RunKind::rest) {
            const Specimen measured = measured_at_rest(made, number, worn);
            done.specimen.centre_of_mass_m = measured.centre_of_mass_m;
            done.specimen.bearing_left_m = measured.bearing_left_m;
            done.specimen.bearing_right_m = measured.bearing_right_m;
        }
        State end;
        run = performed(made, MeasuredRun(run), number++, worn, &end);
        if (persists) {
            state = end;
            worn = &state;
        }
    }
    return done;
}

} // namespace stylobate::hidden
