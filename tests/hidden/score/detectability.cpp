#include "tests/hidden/score/detectability.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

namespace {

/// Two impacts that lie on either side of a window's end are a large difference without being a large effect: what one
/// number can add is limited to this many standard deviations. On the small scale that is 40 mm/s in a window, what
/// friction that is wrong by a sixth makes of a block that slides.
constexpr double most_of_one = 30;

/// The state of one model's specimen as the state of another's, whose blocks are seen in the same places and move as
/// fast, and whose corners press as hard.
State as_state_of(const Model& twin, const Model& model, const State& state, const BaseState& base,
                  const BaseState& twin_base)
{
    State same = state;
    for (int i = 0; i < model.body_count; ++i) {
        const auto b = static_cast<std::size_t>(i);
        BodyState centre = seen(model, i, state.bodies[b]);
        const double off = twin.effects.bodies[b].eccentricity_m;
        const double x = centre.x + off * std::cos(centre.theta), y = centre.y + off * std::sin(centre.theta);
        double vx = 0, vy = 0;
        velocity_at(centre, x, y, vx, vy);
        centre.x = x;
        centre.y = y;
        centre.vx = vx;
        centre.vy = vy;
        same.bodies[b] = centre;
    }
    for (int j = 0; j < model.bed_count; ++j) {
        const BedEnds true_ends = ends_of_bed(model, j, state, base);
        const BedEnds twin_ends = ends_of_bed(twin, j, same, twin_base);
        for (int e = 0; e < 2; ++e) {
            double wanted = true_ends.end[e].gap;
            if (model.law == Law::compliant && wanted < 0)
                wanted = -compliant_depth(twin, j, compliant_force(model, j, -wanted));
            same.beds[static_cast<std::size_t>(j)].gap_shift_m[e] = wanted - twin_ends.end[e].gap;
        }
    }
    return same;
}

/// What a twin does otherwise, number by number, window by window from the same state, in standard deviations of the
/// cameras' noise.
std::vector<double> differences(const VirtualCampaign& made, const Model& twin)
{
    const Model& model = made.model;
    const double sd_v = velocity_change_noise(made.planned.camera_m);
    const double sd_w = velocity_change_noise(made.planned.camera_rad);
    const auto limited = [](double change, double sd) {
        return std::isfinite(change) ? std::clamp(change / sd, -most_of_one, most_of_one) : most_of_one;
    };
    std::vector<double> all;
    for (const TrueRun& run : made.runs) {
        const TableMotion motion(run.shaking, model.effects.base, model.step_s);
        // by the twin's effects on the table, at the time of the file
        const double late = model.effects.base.time_offset_s - twin.effects.base.time_offset_s;
        Shaking shifted = run.shaking;
        shifted.from_s += late;
        shifted.to_s += late;
        const TableMotion other(shifted, twin.effects.base, model.step_s);
        for (std::size_t w = 0; w + 1 < run.history.windows.size(); ++w) {
            const State& from = run.history.windows[w];
            const State& to = run.history.windows[w + 1];
            const BaseState base = motion.at(2 * from.step), its = other.at(2 * from.step);
            const Table table{&other,
                              2 * from.step,
                              {base.x - its.x, base.y - its.y, base.theta - its.theta, base.vx - its.vx,
                               base.vy - its.vy, base.omega - its.omega},
                              0.5 * model.step_s};
            State state = as_state_of(twin, model, from, base, table.at(2 * from.step));
            while (state.step < to.step)
                step(twin, table, state);
            for (int i = 0; i < model.body_count; ++i) {
                const auto b = static_cast<std::size_t>(i);
                const BodyState truly = seen(model, i, to.bodies[b]), instead = seen(twin, i, state.bodies[b]);
                all.push_back(limited(truly.vx - instead.vx, sd_v));
                all.push_back(limited(truly.vy - instead.vy, sd_v));
                all.push_back(limited(truly.omega - instead.omega, sd_w));
            }
        }
    }
    return all;
}

double product(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

double norm(const std::vector<double>& values)
{
    return std::sqrt(product(values, values));
}

// How often a change of the law below may be taken.
constexpr double most_steps = 3;

/// The same specimen with other healthy laws: one step each in everything that is common to all joints. Without the
/// effects, which the caller leaves as they are.
std::vector<Model> other_laws(const Model& model)
{
    std::vector<Model> laws;
    const auto add = [&](auto&& change) {
        laws.push_back(model);
        change(laws.back());
    };
    add([](Model& m) {
        for (Bed& bed : m.beds)
            bed.friction *= 1.05;
    });
    add([](Model& m) { // all faces begin to carry inside their corners
        for (Body& body : m.bodies)
            body.half_width_m *= 0.995;
        m.base_half_width_m *= 0.995;
    });
    if (model.law == Law::nonsmooth) {
        add([](Model& m) { m.parameters.restitution += m.parameters.restitution < 0.2 ? 0.1 : -0.1; });
        return laws;
    }
    add([](Model& m) { // a bed of half the stiffness sinks deeper under the same weight
        m.parameters.stiffness_n_m *= 0.5;
    });
    add([](Model& m) { m.parameters.damping_s_m *= 1.5; });
    add([](Model& m) { m.parameters.bristle_m *= 1.5; });
    add([](Model& m) {
        for (BedEffect& bed : m.effects.beds)
            bed.exponent_change += 0.25;
    });
    return laws;
}

/// What stands otherwise before anything moves: a drum off its place, a face that is not square.
Detectability at_rest(const VirtualCampaign& made, const Effects& alone)
{
    const double runs = static_cast<double>(made.runs.size());
    double still = 0; // frames
    for (const TrueRun& run : made.runs)
        still += run.shaking.from_s / frame_s;
    Detectability best;
    for (int i = 0; i < made.model.body_count; ++i) {
        const double off = std::abs(alone.bodies[static_cast<std::size_t>(i)].offset_m);
        best.snr_noise = std::max(best.snr_noise, off / (made.planned.camera_m / std::sqrt(still)));
        best.snr_scatter =
            std::max(best.snr_scatter, off / (made.planned.specimen.placement_tolerance_m / std::sqrt(runs)));
    }
    for (int j = 0; j < made.model.bed_count; ++j) {
        const double turned = std::abs(alone.beds[static_cast<std::size_t>(j)].wedge_rad);
        const double noise = made.planned.camera_rad / std::sqrt(still);
        best.snr_noise = std::max(best.snr_noise, turned / noise);
        best.snr_scatter = std::max(best.snr_scatter, turned / noise); // no block's tolerance turns it
    }
    return best;
}

} // namespace

double velocity_change_noise(double noise_sd)
{
    const double window_s = window_frames * frame_s;
    const double slope = noise_sd * std::sqrt(12.0 / window_frames) / window_s;
    return std::sqrt(2.0) * slope;
}

bool Detectability::detectable() const
{
    const double left = std::sqrt(1 - law_share);
    return left * snr_noise >= least_snr_noise && left * snr_scatter >= least_snr_scatter;
}

double share_of_laws(const std::vector<double>& effect, const std::vector<std::vector<double>>& laws, double most)
{
    const double all = product(effect, effect);
    if (!(all > 0))
        return 0;
    // least squares within bounds, one coefficient after the other
    std::vector<double> left = effect, taken(laws.size(), 0);
    for (int sweep = 0; sweep < 100; ++sweep)
        for (std::size_t k = 0; k < laws.size(); ++k) {
            const double square = product(laws[k], laws[k]);
            if (!(square > 0))
                continue;
            const double wanted = std::clamp(taken[k] + product(laws[k], left) / square, -most, most);
            for (std::size_t i = 0; i < left.size(); ++i)
                left[i] -= (wanted - taken[k]) * laws[k][i];
            taken[k] = wanted;
        }
    return std::clamp(1 - product(left, left) / all, 0.0, 1.0);
}

std::vector<Detectability> detectability_of(const VirtualCampaign& made)
{
    std::vector<Detectability> all;
    if (made.effects.empty())
        return all;
    Model scattered = made.model;
    Draws draws(made.seed, Draw::scatter);
    scatter(scattered, made.planned.specimen, draws);
    const double by_scatter = norm(differences(made, scattered));
    std::vector<std::vector<double>> laws;
    for (const Model& law : other_laws(made.model))
        laws.push_back(differences(made, law));
    for (std::size_t k = 0; k < made.effects.size(); ++k) {
        std::vector<HiddenEffect> others = made.effects;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        Model twin = made.model;
        twin.effects = together(others);
        const Detectability rest = at_rest(made, made.effects[k].effects);
        const std::vector<double> by_effect = differences(made, twin);
        const double moving = norm(by_effect);
        Detectability found;
        if (made.effects[k].is_law) // however far it is from those that `laws` reach
            found.law_share = 1;
        else if (moving > rest.snr_noise)
            found.law_share = share_of_laws(by_effect, laws, most_steps);
        found.snr_noise = std::max(rest.snr_noise, moving);
        found.snr_scatter = std::max(rest.snr_scatter, moving / std::max(by_scatter, 1e-9));
        all.push_back(found);
    }
    return all;
}

} // namespace stylobate::hidden
