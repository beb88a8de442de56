#include "bench/peers/space/space_trials.hpp"

#include "bench/peers/column.hpp"
#include "bench/peers/engine.hpp"
#include "bench/peers/rocking.hpp"
#include "bench/peers/space/space_oracles.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate::peers {

namespace {

constexpr double pi = std::numbers::pi, none = std::numeric_limits<double>::quiet_NaN();
constexpr double no_slip = 5;           ///< friction where nothing is to slide
constexpr double generic_azimuth = 0.3; ///< a direction in which no regular polygon is symmetric
constexpr double start_part = 0.5;      ///< of the lean that overturns
constexpr double ahead_steps = 0.5;     ///< `SpaceRun`
constexpr SpaceVector still{0, 0, 0};

SpaceVector direction(double azimuth_rad)
{
    return {std::cos(azimuth_rad), 0, std::sin(azimuth_rad)};
}

SpaceVector axis_of(const SpacePose& pose)
{
    return rotated(spatial::minus_identity(pose.attitude), SpaceVector{0, 1, 0});
}

double tilt_of(const SpacePose& pose)
{
    const SpaceVector axis = axis_of(pose);
    return std::atan2(std::hypot(axis.x, axis.z), axis.y);
}

/// The lean towards a horizontal direction; away from it negative.
double lean_of(const SpacePose& pose, const SpaceVector& towards)
{
    const SpaceVector axis = axis_of(pose);
    return std::atan2(dot(axis, towards), axis.y);
}

/// One drum that leans over its rim, on the plane or on an equal drum.
struct Leaning {
    SpaceScene scene;
    SpaceVector to_pivot; ///< from its centre
    SpaceVector towards;

    Drum& drum() { return scene.drums.back(); }
    std::size_t place() const { return scene.drums.size() - 1; }
    /// About the point of the rim on which it stands.
    void turn(const SpaceVector& omega)
    {
        drum().omega_rad_s = omega;
        drum().velocity_m_s = cross(to_pivot, omega);
    }
};

Leaning leaning(const DrumSize& size, double lean_rad, double azimuth_rad, bool on_plane)
{
    const double R = size.radius_m, h = size.half_height_m, s = std::sin(lean_rad), c = std::cos(lean_rad);
    const SpaceVector towards = direction(azimuth_rad);
    Leaning l;
    l.scene.friction = no_slip;
    if (!on_plane)
        l.scene.drums.push_back({R, h, 0, true, {0, -h, 0}});
    const double along = R * (1 - c) + h * s;
    Drum drum{R, h, 2600 * pi * R * R * 2 * h};
    drum.centre_m = {along * towards.x, h * c + R * s, along * towards.z};
    if (lean_rad != 0)
        drum.attitude = {std::cos(lean_rad / 2), std::sin(lean_rad / 2) * towards.z, 0,
                         -std::sin(lean_rad / 2) * towards.x};
    l.scene.drums.push_back(drum);
    l.towards = towards;
    const double out = R * c - h * s;
    l.to_pivot = {out * towards.x, -drum.centre_m.y, out * towards.z};
    return l;
}

double overturning_lean()
{
    return static_cast<double>(rocking_drum(tall_drum).alpha);
}

// ---------------------------------------------------------------- rocking

std::vector<double> quarter_periods(const SpaceContender& contender, double dial, bool on_plane)
{
    const double exact = static_cast<double>(
        verification::quarter_period(rocking_drum(tall_drum), start_part * rocking_drum(tall_drum).alpha));
    constexpr int directions = 8;
    double sum = 0, least = std::numeric_limits<double>::infinity(), largest = -least;
    for (int k = 0; k < directions; ++k) { // no two of them are alike to a regular octagon
        const double error =
            space_quarter_period_s(contender, dial, on_plane, 2 * pi * k / directions + 0.05 * k) / exact - 1;
        sum += error / directions;
        least = std::min(least, error);
        largest = std::max(largest, error);
    }
    return {sum, std::isfinite(sum) ? largest - least : none};
}

bool overturns(const SpaceContender& contender, double dial, bool on_plane, double eta)
{
    const auto block = rocking_drum(tall_drum);
    const double alpha = static_cast<double>(block.alpha), p = static_cast<double>(block.p);
    const Leaning upright = leaning(tall_drum, 0, generic_azimuth, on_plane);
    const SpaceRun run = contender.make(upright.scene, dial);
    RealizationHeader motion;
    motion.step_s = run.step_s;
    motion.frequency_hz = pulse_rate * p / (2 * pi);
    motion.pga_m_s2 = eta * space_gravity_m_s2 * std::tan(alpha);
    ExcitationSpec half_sine;
    half_sine.kind = ExcitationKind::half_sine;
    const BaseMotion base(half_sine, motion, nullptr);
    // the drum leans away from where the ground goes, as it is pushed until the pulse ends
    for (int n = 0; n * run.step_s < 12 / p; ++n) {
        run.world->step(mean_acceleration(base, n, run.step_s) * upright.towards);
        const SpacePose at = run.world->pose(upright.place());
        if (!(tilt_of(at) <= 1.5 * alpha))
            return true;
        if (lean_of(at, upright.towards) > 0 && n * run.step_s > base.duration_s())
            return false;
    }
    return false;
}

std::vector<double> overturning(const SpaceContender& contender, double dial, bool on_plane)
{
    double low = eta_low, high = eta_high;
    if (overturns(contender, dial, on_plane, low) || !overturns(contender, dial, on_plane, high))
        return {none};
    while (high - low > eta_tolerance) {
        const double middle = (low + high) / 2;
        (overturns(contender, dial, on_plane, middle) ? high : low) = middle;
    }
    return {(low + high) / 2 / verification::half_sine_edge(rocking_drum(tall_drum), pulse_rate) - 1};
}

/// Of a drum that rocks in a plane: how far it turns back after the first impact, and how far its centre leaves the
/// plane within two seconds.
std::vector<double> turn_back(const SpaceContender& contender, double dial)
{
    const double start = start_part * overturning_lean();
    const Leaning l = leaning(tall_drum, start, generic_azimuth, true);
    const SpaceRun run = contender.make(l.scene, dial);
    double highest = 0;
    bool passed = false;
    for (int n = 0; n * run.step_s < 2; ++n) {
        run.world->step(still);
        const SpacePose at = run.world->pose(l.place());
        passed = passed || lean_of(at, l.towards) <= 0;
        if (passed)
            highest = std::max(highest, tilt_of(at));
        if (highest > 0.1 * start && tilt_of(at) < 0.8 * highest)
            return {highest / start / first_turn_back(tall_drum, start) - 1};
    }
    return {none};
}

std::vector<double> out_of_plane(const SpaceContender& contender, double dial)
{
    const Leaning l = leaning(tall_drum, start_part * overturning_lean(), generic_azimuth, true);
    const SpaceRun run = contender.make(l.scene, dial);
    const SpaceVector across{-l.towards.z, 0, l.towards.x};
    double farthest = 0;
    for (int n = 0; n * run.step_s < 2; ++n) {
        run.world->step(still);
        farthest = std::max(farthest, std::fabs(dot(run.world->pose(l.place()).centre_m, across)));
    }
    return {farthest / tall_drum.radius_m};
}

// ---------------------------------------------------------------- motion on the rim

/// Follows the direction in which a drum's axis leans.
class Azimuth {
public:
    explicit Azimuth(const SpacePose& pose) : last_(now(pose)) {}
    double add(const SpacePose& pose)
    {
        const double next = now(pose);
        turned_ += std::remainder(next - last_, 2 * pi);
        last_ = next;
        return turned_;
    }

private:
    static double now(const SpacePose& pose)
    {
        const SpaceVector axis = axis_of(pose);
        return std::atan2(axis.z, axis.x);
    }
    double last_, turned_ = 0;
};

constexpr double rim_lean_rad = 0.1, rim_s = 0.5, wobble_friction = 0.1;

/// Errors of the rate at which the lean goes round, and of the lean over the second half of the time.
std::vector<double> on_the_rim(const SpaceContender& contender, double dial, double friction, double rate,
                               const SpaceVector& omega)
{
    Leaning l = leaning(flat_drum, rim_lean_rad, 0, true);
    l.scene.friction = friction;
    l.turn(omega);
    const SpaceRun run = contender.make(l.scene, dial);
    Azimuth azimuth(run.world->pose(l.place()));
    double turned = 0, leans = 0;
    int n = 0, counted = 0;
    for (; n * run.step_s < rim_s; ++n) {
        run.world->step(still);
        const SpacePose at = run.world->pose(l.place());
        turned = azimuth.add(at);
        if (n * run.step_s >= rim_s / 2) {
            leans += tilt_of(at);
            ++counted;
        }
    }
    return {std::fabs(turned) / (n * run.step_s * rate) - 1, leans / counted / rim_lean_rad - 1};
}

std::vector<double> rolling(const SpaceContender& contender, double dial)
{
    const double rate = rolling_rate(flat_drum, rim_lean_rad);
    // it turns about its axis so that the rotation has no vertical part
    return on_the_rim(contender, dial, no_slip, rate, {-rate * std::tan(rim_lean_rad), 0, 0});
}

std::vector<double> wobble(const SpaceContender& contender, double dial)
{
    const double rate = wobble_rate(flat_drum, rim_lean_rad);
    const SpaceVector to_pivot = leaning(flat_drum, rim_lean_rad, 0, true).to_pivot;
    // no force of friction is needed, and a small one has little moment about the vertical
    return on_the_rim(contender, dial, wobble_friction, rate,
                      (-rate * std::sin(rim_lean_rad) / flat_drum.radius_m) * to_pivot);
}

std::vector<double> face_down(const SpaceContender& contender, double dial)
{
    constexpr double lean = face_down_lean_rad;
    std::vector<double> errors;
    for (std::size_t k = 0; k < face_down_deg.size(); ++k) {
        const DrumSize& size = k == 0 ? flat_drum : tall_drum;
        Leaning l = leaning(size, lean, 0, true);
        const double rate = std::sqrt(space_gravity_m_s2 * size.radius_m / (rim_inertia(size) * lean));
        l.turn({face_down_aside * lean * rate, 0, 0});
        const SpaceRun run = contender.make(l.scene, dial);
        Azimuth azimuth(run.world->pose(l.place()));
        double highest = 0, turned = none;
        bool down = false;
        for (int n = 0; n * run.step_s < 6 / rate; ++n) {
            run.world->step(still);
            const SpacePose at = run.world->pose(l.place());
            const double tilt = tilt_of(at), now = azimuth.add(at);
            down = down || tilt < 0.3 * lean;
            if (down && tilt > highest) {
                highest = tilt;
                turned = now;
            }
            if (highest > 0.5 * lean && tilt < 0.8 * highest)
                break;
        }
        errors.push_back(highest > 0.5 * lean ? std::fabs(turned) * 180 / pi / face_down_deg[k] - 1 : none);
    }
    return errors;
}

std::vector<double> spin_down(const SpaceContender& contender, double dial)
{
    constexpr double radius = 0.5, half_height = 0.5, spin = 10, friction = 0.6;
    SpaceScene scene;
    scene.friction = friction;
    Drum drum{radius, half_height, 2000};
    drum.centre_m = {0, half_height, 0};
    drum.omega_rad_s = {0, spin, 0};
    scene.drums.push_back(drum);
    const SpaceRun run = contender.make(scene, dial);
    const double exact = spin_down_s(radius, spin, friction);
    SpaceAttitude before = drum.attitude;
    for (int n = 1; n * run.step_s < 2 * exact; ++n) {
        run.world->step(still);
        const SpaceAttitude now = run.world->pose(0).attitude;
        const double same = before.w * now.w + before.x * now.x + before.y * now.y + before.z * now.z;
        const double turned = 2 * std::atan2(before.w * now.y - before.y * now.w, std::fabs(same));
        const double rate = (same < 0 ? -turned : turned) / run.step_s; // the two quaternions of an attitude
        if (rate <= spin / 10) // soft friction ends in a tail: the line from the start through this rate
            return {run.step_s * n / (1 - rate / spin) / exact - 1};
        before = now;
    }
    return {none};
}

// ---------------------------------------------------------------- a column

constexpr double column_run_s = 10;

/// How far the top drum is off its axis at the end, over its diameter.
double strayed(const SpaceContender& contender, double dial, bool shaken)
{
    const SpaceScene scene = space_column();
    const SpaceRun run = contender.make(scene, dial);
    const Study study = column_study(shaken);
    Realization motion = Sampler(study, nullptr).realization(0);
    motion.step_s = run.step_s;
    const BaseMotion base(study.excitation, motion, nullptr);
    const SpaceVector along = direction(generic_azimuth);
    const std::size_t top = scene.drums.size() - 1;
    for (int n = 0; n * run.step_s < column_run_s; ++n)
        run.world->step(shaken ? mean_acceleration(base, n, run.step_s) * along : still);
    const SpaceVector moved = run.world->pose(top).centre_m - scene.drums[top].centre_m;
    const double way = std::hypot(moved.x, moved.z) / (2 * flat_drum.radius_m);
    return std::isfinite(way) ? way : std::numeric_limits<double>::infinity();
}

} // namespace

double space_quarter_period_s(const SpaceContender& contender, double dial, bool on_plane, double azimuth_rad)
{
    const double start = start_part * overturning_lean(), limit_s = 5 / static_cast<double>(rocking_drum(tall_drum).p);
    const Leaning l = leaning(tall_drum, start, azimuth_rad, on_plane);
    const SpaceRun run = contender.make(l.scene, dial);
    double before = start;
    for (int n = 1; n * run.step_s < limit_s; ++n) {
        run.world->step(still);
        const double now = lean_of(run.world->pose(l.place()), l.towards);
        if (now <= 0)
            return run.step_s * (n - 1 + before / (before - now) + ahead_steps);
        before = now;
    }
    return none;
}

SpaceScene space_column()
{
    constexpr double R = flat_drum.radius_m, h = flat_drum.half_height_m;
    SpaceScene scene;
    scene.friction = 0.68;
    scene.drums.push_back({R, h, 0, true, {0, -h, 0}});
    for (int i = 0; i < 6; ++i)
        scene.drums.push_back({R, h, 0.1064214508, false, {0, (2 * i + 1) * h, 0}});
    return scene;
}

double space_cost_s(const SpaceContender& contender, const SpaceScene& scene, double dial)
{
    if (contender.cost_s)
        return contender.cost_s(scene, dial);
    double best = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 3; ++n) { // each from the start: what has fallen apart costs less
        const SpaceRun run = contender.make(scene, dial);
        const int steps = static_cast<int>(std::ceil(1 / run.step_s));
        const double begin = processor_seconds();
        for (int k = 0; k < steps; ++k)
            run.world->step({1, 0, 0.3});
        best = std::min(best, (processor_seconds() - begin) / (steps * run.step_s));
    }
    return best;
}

const std::vector<SpaceTrial>& space_trials()
{
    using C = const SpaceContender&;
    static const std::vector<SpaceTrial> all{
        {"quarter period on a plane", {"mean", "spread"}, [](C c, double d) { return quarter_periods(c, d, true); }},
        {"quarter period on a drum", {"mean", "spread"}, [](C c, double d) { return quarter_periods(c, d, false); }},
        {"overturning on a plane", {"amplitude"}, [](C c, double d) { return overturning(c, d, true); }},
        {"overturning on a drum", {"amplitude"}, [](C c, double d) { return overturning(c, d, false); }},
        {"first turn back", {"lean"}, turn_back},
        {"out of plane", {"over R"}, out_of_plane},
        {"rolling on a plane", {"rate", "lean"}, rolling},
        {"wobble on a plane", {"rate", "lean"}, wobble},
        {"spin-down", {"time"}, spin_down},
        {"face-down turn", {"flat drum", "tall drum"}, face_down},
        {"creep at rest", {"over 2R"}, [](C c, double d) { return std::vector{strayed(c, d, false)}; }},
        {"shaken below uplift", {"over 2R"}, [](C c, double d) { return std::vector{strayed(c, d, true)}; }}};
    return all;
}

} // namespace stylobate::peers
