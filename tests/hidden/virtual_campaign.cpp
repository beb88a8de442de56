#include "tests/hidden/virtual_campaign.hpp"

#include "tests/hidden/sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate::hidden {

namespace {

/// Of how many in a hundred campaigns which kind is.
constexpr int nothing_percent = 68, single_percent = 18, pair_percent = 5; // the rest is outside the list

std::vector<std::string> draw_names(Law law, Draws& plan)
{
    std::vector<std::string> possible;
    for (const std::string& name : listed_names())
        if (applies(name, law))
            possible.push_back(name);
    const auto one = [&](std::vector<std::string>& from) {
        const auto at = from.begin() + plan.below(static_cast<int>(from.size()));
        const std::string name = *at;
        from.erase(at);
        return name;
    };
    const double percent = plan.uniform(0, 100);
    if (percent < nothing_percent)
        return {};
    if (percent < nothing_percent + single_percent)
        return {one(possible)};
    if (percent < nothing_percent + single_percent + pair_percent) {
        const std::string first = one(possible);
        return {first, one(possible)};
    }
    std::vector<std::string> others = outside_names();
    return {one(others)};
}

/// Motions of different kinds, frequencies and strengths.
std::vector<Shaking> draw_motions(const Planned& planned, std::uint64_t seed, int count)
{
    static const char* const kinds[] = {"harmonic", "sweep", "quake", "harmonic", "quake", "sweep"};
    std::vector<Shaking> motions;
    for (int i = 0; i < count; ++i) {
        Draws draws(seed, Draw::motion, static_cast<std::uint64_t>(i));
        ShakingBand band = planned.band;
        const double middle = std::sqrt(band.low_hz * band.high_hz);
        (i % 2 == 0 ? band.high_hz : band.low_hz) = middle; // both halves of the band are used
        motions.push_back(draw_shaking(kinds[i], band, draws));
        motions.back().duration_s = planned.band.duration_s;
    }
    return motions;
}

/// How strongly a specimen answered: the greatest of its rotation, against the one at which it would stand on an edge,
/// and its sliding, against a twentieth of its width. A collapse is more than any answer.
double answer(const Model& model, const History& history)
{
    if (history.collapsed)
        return 10;
    double height = 0, half = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i) {
        height = std::max(height, history.places[i].y + model.bodies[i].half_height_m - model.base_top_m);
        half = std::max(half, model.bodies[i].rest_x_m + model.bodies[0].half_width_m);
    }
    const double edge = std::atan(2 * half / height);
    return std::max(history.tilt_rad / edge, 0.3 * history.slip_m / (0.1 * model.bodies[0].half_width_m));
}

History one_run(const Model& model, const Planned& planned, const Shaking& shaking, const Draws& placement,
                const State* worn, State& start)
{
    const TableMotion motion(shaking, model.effects.base, model.step_s);
    start = put_on_table(model, planned.specimen, placement);
    if (worn != nullptr)
        for (std::size_t j = 0; j < max_beds; ++j) {
            start.beds[j].slip_m = worn->beds[j].slip_m;
            start.beds[j].turned_rad = worn->beds[j].turned_rad;
        }
    return shake(model, motion, start);
}

/// Peak acceleration by trial, as a laboratory finds it: most motions shall rock and slide the specimen without felling
/// it, one in eight is meant to be too strong or too weak.
void choose_amplitude(const Model& model, const Planned& planned, std::uint64_t seed, int index, Shaking& shaking)
{
    Draws draws(seed, Draw::trial, static_cast<std::uint64_t>(index));
    const bool anything = draws.chance(0.125);
    const double least = 0.1, most = draws.uniform(0.3, 0.8);
    double peak = planned.rocking_m_s2 * draws.uniform(1.05, 1.5);
    double stands = 0, falls = 0;
    for (int trial = 0; trial < 6; ++trial) {
        shaking.scale_to(peak);
        State start;
        const double strong =
            answer(model, one_run(model, planned, shaking, Draws(seed, Draw::trial, 100 + index), nullptr, start));
        if (anything || (strong >= least && strong <= most))
            return;
        (strong > most ? falls : stands) = peak;
        if (falls > 0 && stands > 0)
            peak = 0.5 * (falls + stands);
        else
            peak *= strong > most ? 0.85 : 1.2;
    }
    shaking.scale_to(stands > 0 ? stands : peak); // what answers by nothing or too much is shaken below that
}

/// What the file gives of a run.
MeasuredRun seen_run(const VirtualCampaign& made, const TrueRun& run, int index)
{
    const Planned& planned = made.planned;
    MeasuredRun seen;
    seen.name = fmt::format("{:03}", index);
    seen.kind = run.shaking.kind;
    seen.rate_hz = 1 / frame_s;
    seen.collapsed = run.history.collapsed;
    seen.collapse_time_s = run.history.collapse_s;
    seen.run_order = index;
    const auto frames = static_cast<std::size_t>(std::lround(run.shaking.duration_s / frame_s)) + 1;
    const auto blocks = static_cast<std::size_t>(made.model.body_count);
    const auto number = static_cast<std::uint64_t>(index);
    Draws table(made.seed, Draw::table, number), cameras(made.seed, Draw::cameras, number);

    seen.base_source = made.of_command ? BaseSource::command : BaseSource::table_sensor;
    const double zero = 100 * planned.sensor_m * table.normal();          // of the displacement sensor
    const double cameras_zero = 20 * planned.camera_m * cameras.normal(); // where the table stood that day
    for (std::size_t k = 0; k < frames; ++k) {
        const double t = static_cast<double>(k) * frame_s;
        seen.time_s.push_back(t);
        const Jet u = reported(run.shaking, made.model.effects.base, made.of_command, t);
        seen.base_acceleration_m_s2.values.push_back(u.a);
        seen.base_displacement_m.values.push_back(u.u + zero);
    }
    add_noise(seen.base_acceleration_m_s2, sensor_m_s2, table);
    add_noise(seen.base_displacement_m, planned.sensor_m, table);

    std::vector<const BodyState*> places, tables;
    std::vector<BodyState> states(made.table_seen ? frames : 0);
    for (std::size_t k = 0; k < frames; ++k) {
        const bool standing = k < static_cast<std::size_t>(run.history.frames);
        for (std::size_t i = 0; i < blocks; ++i)
            places.push_back(standing ? &run.history.places[k * blocks + i] : nullptr);
        if (made.table_seen && standing) {
            const BaseState& base = run.history.table[k];
            states[k].x = base.x;
            states[k].y = base.y;
            states[k].theta = base.theta;
        }
        if (made.table_seen)
            tables.push_back(standing ? &states[k] : nullptr);
    }
    seen.blocks = by_cameras(places, cameras_zero, planned, cameras);
    seen.table = by_cameras(tables, cameras_zero, planned, cameras);
    return seen;
}

/// Each motion so many times, the specimen put back by hand in between.
void shake_all(VirtualCampaign& made, const std::vector<Shaking>& shakings, const std::vector<int>& repeats)
{
    const State* worn = nullptr;
    made.campaign.specimen = made.planned.specimen;
    made.runs.reserve(static_cast<std::size_t>(std::accumulate(repeats.begin(), repeats.end(), 0))); // `worn` points
    for (std::size_t i = 0; i < shakings.size(); ++i)
        for (int repeat = 0; repeat < repeats[i]; ++repeat) {
            const int index = static_cast<int>(made.runs.size());
            TrueRun run;
            run.shaking = shakings[i];
            run.history =
                one_run(made.model, made.planned, run.shaking,
                        Draws(made.seed, Draw::placement, static_cast<std::uint64_t>(index)), worn, run.start);
            made.runs.push_back(std::move(run));
            if (made.model.effects.persists)
                worn = &made.runs.back().history.end;
            MeasuredRun seen = seen_run(made, made.runs.back(), index);
            seen.motion_id = static_cast<int>(i);
            seen.repeat = repeat;
            made.campaign.runs.push_back(std::move(seen));
        }
}

} // namespace

VirtualCampaign make_campaign(std::uint64_t seed, const Wish& wish)
{
    VirtualCampaign made;
    made.seed = seed;
    Draws plan(seed, Draw::plan);
    const Law law = plan.chance(0.5) ? Law::nonsmooth : Law::compliant;
    const double kind = plan.uniform();
    const SpecimenKind specimen = kind < 0.4    ? SpecimenKind::small_column
                                  : kind < 0.5  ? SpecimenKind::two_drums
                                  : kind < 0.62 ? SpecimenKind::frame
                                  : kind < 0.75 ? SpecimenKind::frame_of_drums
                                                : SpecimenKind::full_scale_column;
    made.planned = plan_specimen(wish.specimen.value_or(specimen), plan);
    Law healthy = wish.law.value_or(law);
    for (const std::string& name : wish.effects.value_or(std::vector<std::string>()))
        healthy = applies(name, healthy) ? healthy : Law::compliant;
    made.model = make_specimen(made.planned, healthy, Draws(seed, Draw::making), Draws(seed, Draw::law));
    if (wish.friction) {
        const double ratio = Draws(seed, Draw::friction).log_uniform(wish.friction->first, wish.friction->second);
        for (Bed& bed : made.model.beds)
            bed.friction *= ratio;
    }
    made.of_command = plan.chance(0.3);
    made.table_seen = plan.chance(0.25);

    const std::vector<std::string> drawn = draw_names(made.model.law, plan);
    const std::vector<std::string> names = wish.effects.value_or(drawn);
    for (std::size_t i = 0; i < names.size(); ++i) {
        Draws draws(seed, Draw::effect, i);
        made.effects.push_back(draw_effect(names[i], made.planned, made.model, draws));
        made.of_command = made.of_command || needs_command(names[i]);
    }
    made.model.effects = together(made.effects);

    const int motions = std::min(4 + plan.below(3), wish.most_motions);
    std::vector<int> repeats(static_cast<std::size_t>(motions), 1);
    if (motions >= 4) {
        const int thrice = plan.below(motions);
        repeats[static_cast<std::size_t>(thrice)] = 3;
        if (plan.chance(0.6))
            repeats[static_cast<std::size_t>((thrice + 2) % motions)] = 3;
    }
    std::vector<Shaking> shakings = draw_motions(made.planned, seed, motions);
    for (int i = 0; i < motions; ++i)
        choose_amplitude(made.model, made.planned, seed, i, shakings[static_cast<std::size_t>(i)]);
    made.campaign.source = fmt::format("campaign_{}", seed);
    shake_all(made, shakings, repeats);
    return made;
}

VirtualCampaign another_like(const VirtualCampaign& made, std::uint64_t number, bool with_effects)
{
    VirtualCampaign other;
    other.seed = made.seed + ((number + 1) << 32U);
    other.planned = made.planned;
    other.model =
        make_specimen(made.planned, made.model.law, Draws(other.seed, Draw::making), Draws(made.seed, Draw::law));
    other.of_command = made.of_command;
    other.table_seen = made.table_seen;
    if (with_effects) {
        other.effects = made.effects;
        other.model.effects = made.model.effects;
    }
    std::vector<Shaking> shakings;
    std::vector<int> repeats;
    for (std::size_t i = 0; i < made.runs.size(); ++i) {
        if (made.campaign.runs[i].repeat == 0) {
            shakings.push_back(made.runs[i].shaking);
            repeats.push_back(0);
        }
        ++repeats.back();
    }
    other.campaign.source = fmt::format("{}_like_{}", made.campaign.source, number);
    shake_all(other, shakings, repeats);
    return other;
}

} // namespace stylobate::hidden
