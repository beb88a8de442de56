/// `pull`: a rod holds the block in the laboratory while the table cycles below it. The block stands nearly still, so
/// its force is the joint's friction:
///
///   mu = F d / N      F: force of the gauge, N: weight of the block, d = +1 where the block slips to the right
///
/// Means of mu over windows of 0.5 mm (times s) are fitted with `friction_fit.hpp`. Windows begin when the block has
/// slipped 2.5 mm since the table turned round (1.2 mm in the first stroke), past the play of a dowel.
///
///   friction    ln m                                      error: noise / (N sqrt(samples)), and the gauge's gain
///   speed       b: friction in slow cycles less that in fast ones, over their mean
///   wear        k, friction lost per path over the first friction [1/m]
///   direction   c: slip to the left less slip to the right, over their mean; error: the gauge's zero, too
///   time        e, growth per time [1/s]; from path by the fast cycles, which have much path in little time
///   place       root mean square over places of the mean deviation from what all this gives, less that of the noise
///   width       after each slow reversal, u: displacement of the table, f: force over that of the same stroke from 2.5
///               to 5 mm, from -1 to 1;  w = mean of integral (1 - f) / 2 du up to 2.5 mm, less F / k of the rod.
///               mu N / K for a joint of stiffness K; more for a dowel, whose force comes back beyond its play;
///               less by m v^2 / (2 F) for the inertia of the block, on every joint
///   compliance  du / dF while |f| < 0.8 after these reversals, less 1 / k of the rod [m/N]
///   first       ln(F_b / F_p): largest mean of three samples until the table has moved by 2.5 mm, over the mean from
///               there to 5 mm. The first slip is approached slowly; a bond breaks there, a strong one a little later.
///               The largest of many samples is above the friction by two standard deviations or so, on every joint
///
/// Where the block never slips (a dowel holds it until it turns), `friction` is that of the largest force: the joint
/// has at least that. All but `friction` are ratios in which the gauge's gain cancels. The block does not move: blind
/// to drag, and to what happens where faces open (corners, centres of mass, damping, bonds against opening).

#include "studies/measured/joint_tests/friction_fit.hpp"
#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace stylobate {

namespace {

constexpr double pull_window_m = 0.0005, after_turn_m = 0.0025, after_start_m = 0.0012; // times s
constexpr double most_block_motion = 0.1; // of the reach: a block that moves more is not held by its rod
constexpr double most_block_turn = 0.1;   // rad
constexpr double steady_speed = 0.2;      // change of the table's speed within a window
constexpr std::size_t fewest_in_window = 3;

/// The gauge that holds the block.
struct HeldBlock {
    JointRun seen;
    std::vector<double> force_n; ///< without its zero
    double zero_sd = 0;          ///< of that zero [N]
    double force_sd = 0;         ///< [N]
    const ForceGauge* gauge = nullptr;
    std::vector<std::size_t> turns; ///< of the table
    std::size_t first = 0;          ///< sample at which the table begins to move
    double reach_m = 0;

    bool usable(std::size_t i) const
    {
        return i < seen.samples && std::isfinite(force_n[i]) && std::isfinite(seen.x_m[i]) &&
               std::fabs(seen.x_m[i] - block_zero_m) < most_block_motion * reach_m &&
               std::fabs(seen.turn(i)) < most_block_turn;
    }
    double block_zero_m = 0;
};

std::optional<HeldBlock> held_block(const Specimen& specimen, const MeasuredRun& run)
{
    std::optional<JointRun> seen = joint_run(specimen, run, false);
    if (!seen)
        return std::nullopt;
    HeldBlock held;
    held.seen = std::move(*seen);
    for (const ForceGauge& gauge : run.forces)
        if (gauge.block == held.seen.body.upper && gauge.to_laboratory &&
            gauge.value_n.values.size() == run.time_s.size())
            held.gauge = &gauge;
    if (!held.gauge)
        return std::nullopt;
    held.force_n = held.gauge->value_n.values;
    held.force_sd = held.gauge->value_n.noise_sd.value_or(noise_of(held.force_n));
    const std::vector<double>& base = held.seen.base_m;
    const auto [low, high] = std::ranges::minmax_element(base);
    held.reach_m = (*high - *low) / 2;
    if (!(held.reach_m > 4 * after_turn_m * held.seen.body.length_ratio / 2))
        return std::nullopt;
    held.turns = turning_points(base, 0.1 * held.reach_m);
    // the table moves where the mean of some samples does; before that, with a margin, the gauge shows its zero
    constexpr std::size_t of_mean = 25;
    const double still = 1e-4 * held.reach_m +
                         6 * run.base_displacement_m.noise_sd.value_or(0) / std::sqrt(static_cast<double>(of_mean));
    while (held.first + of_mean < base.size() &&
           std::fabs(finite_mean(base, held.first, held.first + of_mean).first) < still)
        ++held.first;
    held.first = held.first * 4 / 5;
    const auto [zero, count] = finite_mean(held.force_n, 0, held.first);
    held.block_zero_m = finite_mean(held.seen.x_m, 0, held.first).first;
    if (count < 10)
        return std::nullopt;
    held.zero_sd = held.force_sd / std::sqrt(count);
    for (double& force : held.force_n)
        force -= zero;
    return held;
}

/// The strokes of the table, from one turn to the next: [from, to).
std::vector<std::pair<std::size_t, std::size_t>> strokes_of(const HeldBlock& held)
{
    std::vector<std::pair<std::size_t, std::size_t>> strokes;
    std::size_t from = held.first;
    for (const std::size_t turn : held.turns) {
        strokes.emplace_back(from, turn);
        from = turn;
    }
    const std::vector<double>& base = held.seen.base_m;
    std::size_t end = base.size();
    while (end > from + 1 && std::fabs(base[end - 1] - base.back()) < 1e-3 * held.reach_m)
        --end; // at rest again
    strokes.emplace_back(from, end);
    return strokes;
}

struct PullWindow {
    FrictionWindow window;
    double speed_m_s = 0;
};

std::vector<PullWindow> pull_windows(const HeldBlock& held)
{
    const JointRun& seen = held.seen;
    const double s = seen.body.length_ratio, wide = pull_window_m * s;
    const std::vector<double>& base = seen.base_m;
    std::vector<PullWindow> windows;
    double path = 0;
    bool first = true;
    for (const auto& [from, to] : strokes_of(held)) {
        const double skip = (first ? after_start_m : after_turn_m) * s, start = base[from];
        first = false;
        const int direction = base[std::min(to, base.size() - 1)] > start ? -1 : 1; // of the block's slip
        const auto place_of = [&](std::size_t k) { return static_cast<int>(std::floor(base[k] / wide)); };
        for (std::size_t i = from; i < to;) {
            std::size_t end = i + 1;
            while (end < to && place_of(end) == place_of(i))
                ++end;
            const std::size_t middle = (i + end) / 2;
            const auto speed_over = [&](std::size_t a, std::size_t b) {
                return std::fabs(base[b] - base[a]) /
                       (static_cast<double>(std::max<std::size_t>(b - a, 1)) * seen.step_s());
            };
            const double v0 = speed_over(i, middle), v1 = speed_over(middle, std::min(end, base.size() - 1));
            const double sum_v = v0 + v1;
            double force = 0;
            std::size_t count = 0;
            for (std::size_t k = i; k < end; ++k)
                if (held.usable(k)) {
                    force += held.force_n[k];
                    ++count;
                }
            const bool whole = std::fabs(base[end - 1] - base[i]) > 0.5 * wide; // not where noise goes to and fro
            if (whole && std::fabs(base[i] - start) >= skip && count >= fewest_in_window && 2 * count > end - i &&
                std::fabs(v1 - v0) < steady_speed * sum_v / 2) {
                PullWindow window;
                const auto n = static_cast<double>(count);
                window.window.mu = force / n * direction / seen.weight_n;
                window.window.sd = held.force_sd / (seen.weight_n * std::sqrt(n));
                window.window.path_m = path + std::fabs((base[i] + base[end - 1]) / 2 - start);
                window.window.time_s = (seen.time(i) + seen.time(end - 1)) / 2;
                window.window.direction = direction;
                window.speed_m_s = sum_v / 2;
                window.window.place = place_of(i);
                windows.push_back(window);
            }
            i = end;
        }
        path += std::fabs(base[std::min(to, base.size() - 1)] - start);
    }
    return windows;
}

/// Speeds below and above which a twentieth of the windows are.
std::pair<double, double> slow_and_fast(const std::vector<PullWindow>& windows)
{
    std::vector<double> speeds;
    for (const PullWindow& window : windows)
        speeds.push_back(window.speed_m_s);
    std::ranges::sort(speeds);
    return {speeds[speeds.size() / 20], speeds[speeds.size() * 19 / 20]};
}

/// Fast windows are above the geometric mean of the speeds, where these are far apart.
void mark_fast(std::vector<PullWindow>& windows)
{
    const auto [slow, fast] = slow_and_fast(windows);
    if (fast > 2 * slow)
        for (PullWindow& window : windows)
            window.window.fast = window.speed_m_s * window.speed_m_s > slow * fast;
}

Estimate pull_estimate(const char* name, double value, double sd, double per_friction)
{
    return {name, 0, value, sd, {.friction = per_friction, .geometry_m = 0, .force = 0, .damping = 0}};
}

void add_place(const FrictionFit& fit, std::vector<Estimate>& all)
{
    struct Sum {
        double weight = 0, value = 0;
    };
    std::map<int, Sum> of_place;
    for (std::size_t i = 0; i < fit.windows.size(); ++i) {
        const FrictionWindow& w = fit.windows[i];
        const double sd = w.sd * std::fabs((1 + fit.residual[i]) / w.mu), weight = 1 / (sd * sd); // relative
        Sum& sum = of_place[w.place];
        sum.weight += weight;
        sum.value += weight * fit.residual[i];
    }
    constexpr std::size_t fewest_places = 8;
    if (of_place.size() < fewest_places)
        return;
    double squares = 0, noise = 0;
    const auto n = static_cast<double>(of_place.size());
    for (const auto& [place, sum] : of_place) {
        squares += std::pow(sum.value / sum.weight, 2) / n;
        noise += 1 / sum.weight / n;
    }
    const double value = std::sqrt(std::max(0.0, squares - noise)), error = noise * std::sqrt(2 / n);
    all.push_back(pull_estimate("pull.place", value, std::sqrt(value * value + error) - value, 1));
}

/// What one slow stroke gives after its turn.
struct Loop {
    double width_m = 0, width_variance = 0; ///< with the rod
    double plateau_n = 0;                   ///< in the direction of the stroke
    double uu = 0, uf = 0, ff = 0;          ///< sums for the compliance: products of displacement and force
    double points = 0;
};

std::optional<Loop> loop_of(const HeldBlock& held, std::size_t from, std::size_t to)
{
    const std::vector<double>& base = held.seen.base_m;
    const double reach = after_turn_m * held.seen.body.length_ratio, noise = held.force_sd;
    const double direction = base[to - 1] > base[from] ? -1 : 1;
    const auto moved = [&](std::size_t i) { return std::fabs(base[i] - base[from]); };
    Loop loop;
    double count = 0;
    for (std::size_t i = from; i < to; ++i)
        if (moved(i) >= reach && moved(i) < 2 * reach && held.usable(i)) {
            loop.plateau_n += held.force_n[i] * direction;
            ++count;
        }
    constexpr double fewest = 20, clear_of_noise = 10;
    if (count < fewest || loop.plateau_n / count < clear_of_noise * noise)
        return std::nullopt;
    loop.plateau_n /= count;
    const auto share = [&](std::size_t i) { return held.force_n[i] * direction / loop.plateau_n; };
    double squares = 0, mean_u = 0, mean_f = 0;
    std::vector<std::size_t> rising;
    bool full = false;
    for (std::size_t i = from; i + 1 < to && moved(i) < reach; ++i) {
        if (!held.usable(i) || !held.usable(i + 1))
            return std::nullopt;
        const double step = moved(i + 1) - moved(i);
        loop.width_m += (2 - share(i) - share(i + 1)) / 4 * step;
        squares += step * step;
        full = full || share(i) >= 0.8;
        if (!full && share(i) > -0.8)
            rising.push_back(i);
    }
    const double relative = noise / loop.plateau_n;
    loop.width_variance = relative * relative * (squares + reach * reach / count) / 4;
    loop.points = static_cast<double>(rising.size());
    for (const std::size_t i : rising) {
        mean_u += moved(i) / loop.points;
        mean_f += held.force_n[i] * direction / loop.points;
    }
    for (const std::size_t i : rising) {
        const double u = moved(i) - mean_u, f = held.force_n[i] * direction - mean_f;
        loop.uu += u * u;
        loop.uf += u * f;
        loop.ff += f * f;
    }
    return loop;
}

/// The strokes whose speed is the slow one's, without the first: it does not begin at a turn.
std::vector<Loop> slow_loops(const HeldBlock& held, double slow_m_s)
{
    std::vector<Loop> loops;
    const std::vector<double>& base = held.seen.base_m;
    const double reach = after_turn_m * held.seen.body.length_ratio;
    std::vector<std::pair<std::size_t, std::size_t>> strokes = strokes_of(held);
    strokes.erase(strokes.begin());
    for (const auto& [from, to] : strokes) {
        std::size_t at = from, end = from;
        while (at < to && std::fabs(base[at] - base[from]) < reach)
            ++at;
        while (end < to && std::fabs(base[end] - base[from]) < 2 * reach)
            ++end;
        if (end >= to || end - at < 2)
            continue;
        const double speed = reach / (held.seen.time(end) - held.seen.time(at));
        if (speed < 1.5 * slow_m_s)
            if (const auto loop = loop_of(held, from, to))
                loops.push_back(*loop);
    }
    return loops;
}

void add_loops(const HeldBlock& held, double slow_m_s, std::vector<Estimate>& all)
{
    const std::vector<Loop> loops = slow_loops(held, slow_m_s);
    if (loops.empty() || !(held.gauge->stiffness_n_m > 0))
        return;
    const double k = held.gauge->stiffness_n_m, reach = after_turn_m * held.seen.body.length_ratio;
    const auto n = static_cast<double>(loops.size());
    double width = 0, variance = 0, uf = 0, uu = 0, ff = 0, points = 0;
    for (const Loop& loop : loops) {
        width += (loop.width_m - loop.plateau_n / k) / n;
        variance += loop.width_variance / (n * n);
        uf += loop.uf;
        uu += loop.uu;
        ff += loop.ff;
        points += std::max(0.0, loop.points - 1);
    }
    all.push_back(pull_estimate("pull.width", width, std::sqrt(variance), reach / 2));
    const double noise = held.force_sd * held.force_sd,
                 signal = ff - points * noise; // noise adds to the forces' squares
    if (points < 8 || signal < 0.5 * ff)
        return;
    const double slope = uf / signal;
    const double scatter = std::max(0.0, uu - uf * slope) / points; // of displacements about the line
    const double sd = std::sqrt(std::max(scatter, slope * slope * noise) / signal);
    all.push_back(pull_estimate("pull.compliance", slope - 1 / k, sd, slope));
}

/// The first slip: the largest force of the first stroke over that of the block that slips on.
void add_first(const HeldBlock& held, std::vector<Estimate>& all)
{
    const JointRun& seen = held.seen;
    const double s = seen.body.length_ratio;
    std::vector<double> first, after;
    for (std::size_t i = held.first; i < seen.samples && std::fabs(seen.base_m[i]) < 2 * after_turn_m * s; ++i) {
        if (!held.usable(i))
            return;
        const double force = seen.base_m[i] > 0 ? -held.force_n[i] : held.force_n[i];
        (std::fabs(seen.base_m[i]) < after_turn_m * s ? first : after).push_back(force);
    }
    constexpr std::size_t fewest = 50;
    constexpr double clear_of_noise = 10;
    if (first.size() < fewest || after.size() < fewest)
        return; // not approached slowly
    const double plateau = finite_mean(after, 0, after.size()).first;
    if (plateau < clear_of_noise * held.force_sd)
        return;
    double most = 0;
    for (std::size_t i = 1; i + 1 < first.size(); ++i)
        most = std::max(most, (first[i - 1] + first[i] + first[i + 1]) / 3);
    all.push_back(pull_estimate("pull.first", std::log(most / plateau), held.force_sd / std::sqrt(3.0) / plateau, 1));
}

/// A block that does not slip but is lifted off its bed or taken along: the joint holds at least the largest force.
void add_held_by_more(const HeldBlock& held, std::vector<Estimate>& all)
{
    double most = 0;
    std::size_t last = held.first; // while it stands
    for (std::size_t i = held.first + 1; i + 1 < held.seen.samples && held.usable(i + 1); ++i) {
        most = std::max(most, std::fabs(held.force_n[i - 1] + held.force_n[i] + held.force_n[i + 1]) / 3);
        last = i;
    }
    constexpr double clear_of_noise = 10;
    if (most > clear_of_noise * held.force_sd && last > held.first)
        all.push_back(pull_estimate("pull.friction", std::log(most / held.seen.weight_n),
                                    std::hypot(held.force_sd / most, held.gauge->gain_sd), 1));
}

std::vector<Estimate> pull_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<Estimate> all;
    const std::optional<HeldBlock> held = held_block(specimen, runs.front());
    if (!held)
        return all;
    std::vector<PullWindow> found = pull_windows(*held);
    if (found.empty()) {
        add_held_by_more(*held, all);
        return all;
    }
    mark_fast(found);
    std::vector<FrictionWindow> windows;
    double path = 0;
    for (const PullWindow& window : found) {
        windows.push_back(window.window);
        path = std::max(path, window.window.path_m);
    }
    const double duration = windows.back().time_s - windows.front().time_s;
    add_first(*held, all);
    const auto fit = fit_friction(windows, {FrictionTerm::speed, FrictionTerm::direction, FrictionTerm::time});
    if (!fit)
        return all;
    const double level = *(*fit)[FrictionTerm::level];
    all.push_back(pull_estimate("pull.friction", std::log(level),
                                std::hypot(fit->sd_of(FrictionTerm::level) / level, held->gauge->gain_sd), 1));
    const auto add = [&](const char* name, FrictionTerm term, double per_friction, double other_sd = 0) {
        if (const auto value = (*fit)[term])
            all.push_back(pull_estimate(name, *value, std::hypot(fit->sd_of(term), other_sd), per_friction));
    };
    add("pull.speed", FrictionTerm::speed, 1);
    add("pull.wear", FrictionTerm::wear, 1 / path);
    add("pull.direction", FrictionTerm::direction, 1, 2 * held->zero_sd / (level * held->seen.weight_n));
    add("pull.time", FrictionTerm::time, 1 / duration);
    add_place(*fit, all);
    add_loops(*held, slow_and_fast(found).first, all);
    return all;
}

} // namespace

const TestEstimators& pull_estimators()
{
    static const TestEstimators all = {
        pull_of,
        {{"pull.friction", "", "logarithm of the friction before wear", "damping, corners, centres, drag, bonds"},
         {"pull.speed", "", "friction in slow less in fast cycles, over their mean",
          "all but friction that depends on speed", "speed"},
         {"pull.wear", "1/m", "friction lost per path slipped", "all but wear of friction", "path"},
         {"pull.direction", "", "friction to the left less to the right, over their mean",
          "all but friction that depends on direction", "direction"},
         {"pull.time", "1/s", "growth of friction with time", "all but friction that depends on time", "time"},
         {"pull.place", "", "root mean square deviation of friction over places",
          "all but friction that depends on the place, and unsteady wear", "place"},
         {"pull.width", "m", "displacement after a reversal before the full force",
          "all but dowels and stiffness of the joint", "", true},
         {"pull.compliance", "m/N", "displacement per force right after a reversal",
          "all but stiffness of joint and dowel", "", true},
         {"pull.first", "", "logarithm of the first peak over the plateau after it",
          "all but bonds against sliding, and wear within some tenths of a millimetre"}}};
    return all;
}

} // namespace stylobate
