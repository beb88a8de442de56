/// `slide`: the table shakes one block so hard that it slides nearly all the time. While it slides,
///
///   a = -mu g d - (c / m) |v| v      d = +1: it slips to the right, v: its speed in the laboratory
///
/// a and v by parabolas through windows of 50 ms (times sqrt(s)) of one slip, and -a d / g = mu + (c / (m g)) d |v| v
/// is fitted with `friction_fit.hpp`. From slip to slip v goes from one sign to the other while d stays: so drag is not
/// mistaken for friction.
///
///   friction    ln m, before wear
///   wear        k, friction lost per path over the first friction [1/m]
///   direction   c: slip to the left less slip to the right, over their mean
///   drag        c / m [1/m], with the column d |v| v
///   viscous     c_1 / m [1/s], with the column d v in its place: a drag in proportion to the speed
///
/// Errors: noise of the cameras, 2 sd / sqrt(sum of the parabola's squares), through the fit. A block that does not
/// slide has at least the friction of the table's largest acceleration, and is given that. No estimate where it turns.
///
/// Blind to corners, centres of mass, damping, bonds (broken by the first slip); nearly to friction that falls with
/// speed, which is alike at both ends of a slip.

#include "studies/measured/joint_tests/friction_fit.hpp"
#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stylobate {

namespace {

constexpr double accelerated_s = 0.05;                          // a window, times sqrt(s)
constexpr double slip_line_s = 0.022, least_slip_speed = 0.015; // times sqrt(s); m/s, times sqrt(s)
constexpr double most_slide_turn = 0.05;                        // rad
constexpr double most_stay_m = 0.002; // times s: of a block that does not slide (a dowel, much friction)

struct Parabola {
    double speed = 0, acceleration = 0, acceleration_sd = 0; ///< at the middle; sd: for noise of 1
};

/// Through samples [from, to) of a series at equal intervals; nothing where one of them was not measured.
std::optional<Parabola> parabola_of(const std::vector<double>& values, std::size_t from, std::size_t to, double step)
{
    const double n = static_cast<double>(to - from),
                 middle = (static_cast<double>(from) + static_cast<double>(to - 1)) / 2;
    double t2 = 0, t4 = 0, y = 0, ty = 0, tty = 0;
    for (std::size_t i = from; i < to; ++i) {
        const double t = (static_cast<double>(i) - middle) * step;
        if (!std::isfinite(values[i]))
            return std::nullopt;
        const double value = values[i] - values[from];
        t2 += t * t;
        t4 += t * t * t * t;
        y += value;
        ty += t * value;
        tty += t * t * value;
    }
    const double spread = t4 - t2 * t2 / n;
    return Parabola{ty / t2, 2 * (tty - t2 * y / n) / spread, 2 / std::sqrt(spread)};
}

struct SlideWindows {
    std::vector<FrictionWindow> windows;
    std::vector<double> speed; ///< in the laboratory
    double path_m = 0;
    int slips = 0;
};

SlideWindows slide_windows(const JointRun& seen, double g)
{
    const double root = seen.body.time_ratio, step = seen.step_s();
    const auto half = static_cast<std::size_t>(std::max(2.0, slip_line_s * root / step / 2));
    const auto wide = static_cast<std::size_t>(std::max(8.0, accelerated_s * root / step));
    const double n = 2 * static_cast<double>(half) + 1;
    const double speed_sd = seen.slip_sd() * std::sqrt(12 / n) / (n * step);
    const double limit = std::max(least_slip_speed * root, 5 * speed_sd);
    std::vector<double> slip(seen.samples), speed(seen.samples, 0.0);
    for (std::size_t i = 0; i < slip.size(); ++i)
        slip[i] = seen.slip(i);
    for (std::size_t i = half; i + half < slip.size(); ++i)
        if (const auto line = parabola_of(slip, i - half, i + half + 1, step);
            line && std::fabs(seen.turn(i)) < most_slide_turn)
            speed[i] = line->speed;
    SlideWindows found;
    for (std::size_t i = 0; i < speed.size();) {
        const double direction = speed[i] > limit ? 1 : speed[i] < -limit ? -1 : 0;
        std::size_t end = i + 1;
        while (direction != 0 && end < speed.size() && speed[end] * direction > limit)
            ++end;
        const std::size_t parts = direction != 0 ? (end - i) / wide : 0;
        for (std::size_t k = 0; k < parts; ++k) {
            const std::size_t from = i + (end - i) * k / parts, to = i + (end - i) * (k + 1) / parts;
            const auto of = parabola_of(seen.x_m, from, to, step);
            double path = found.path_m;
            for (std::size_t j = i; j < (from + to) / 2; ++j)
                path += std::fabs(speed[j]) * step;
            if (of) {
                FrictionWindow window;
                window.mu = -of->acceleration * direction / g;
                window.sd = of->acceleration_sd * seen.x_sd / g;
                window.path_m = path;
                window.time_s = (seen.time(from) + seen.time(to - 1)) / 2;
                window.direction = direction > 0 ? 1 : -1;
                found.windows.push_back(window);
                found.speed.push_back(of->speed);
            }
        }
        for (std::size_t j = i; direction != 0 && j < end; ++j)
            found.path_m += std::fabs(speed[j]) * step;
        found.slips += parts > 0 ? 1 : 0;
        i = end;
    }
    return found;
}

/// Whether the block was seen to the end and hardly slipped.
bool stayed_with_the_table(const JointRun& seen)
{
    if (seen.samples < seen.run->time_s.size())
        return false;
    std::size_t there = 0;
    for (std::size_t i = 0; i < seen.samples; ++i)
        there +=
            std::fabs(seen.slip(i)) < most_stay_m * seen.body.length_ratio && std::fabs(seen.turn(i)) < most_slide_turn
                ? 1
                : 0;
    return 10 * there > 9 * seen.samples;
}

/// Of the table, by parabolas through windows.
double peak_acceleration(const JointRun& seen)
{
    const auto wide = static_cast<std::size_t>(std::max(8.0, accelerated_s * seen.body.time_ratio / seen.step_s()));
    double most = 0;
    for (std::size_t i = 0; i + wide <= seen.base_m.size(); i += 2)
        if (const auto of = parabola_of(seen.base_m, i, i + wide, seen.step_s()))
            most = std::max(most, std::fabs(of->acceleration));
    return most;
}

std::vector<Estimate> slide_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<Estimate> all;
    const std::optional<JointRun> seen = joint_run(specimen, runs.front(), false);
    if (!seen)
        return all;
    const double g = specimen.gravity_m_s2;
    SlideWindows found = slide_windows(*seen, g);
    constexpr std::size_t fewest = 12;
    if (found.windows.size() < fewest) {
        if (stayed_with_the_table(*seen))
            all.push_back({"slide.friction",
                           0,
                           std::log(peak_acceleration(*seen) / g),
                           seen->x_sd / seen->body.length_ratio,
                           {.friction = 1, .geometry_m = 0, .force = 0, .damping = 0}});
        return all;
    }
    const auto with = [&](auto column) {
        double squares = 0;
        for (std::size_t i = 0; i < found.windows.size(); ++i) {
            found.windows[i].other = found.windows[i].direction * column(found.speed[i]);
            squares += std::pow(found.windows[i].other, 2) / static_cast<double>(found.windows.size());
        }
        return std::pair(fit_friction(found.windows, {FrictionTerm::direction, FrictionTerm::other}),
                         std::sqrt(squares));
    };
    const auto add = [&](const char* name, double value, double sd, double per_friction) {
        all.push_back({name, 0, value, sd, {.friction = per_friction, .geometry_m = 0, .force = 0, .damping = 0}});
    };
    const auto [fit, quadratic] = with([](double v) { return std::fabs(v) * v; });
    const auto [viscous, linear] = with([](double v) { return v; });
    if (!fit)
        return all;
    const double level = *(*fit)[FrictionTerm::level];
    const double of_slip =
        g * level / std::sqrt(static_cast<double>(found.slips)); // friction repeats itself to the floor
    add("slide.friction", std::log(level), fit->sd_of(FrictionTerm::level) / level, 1);
    add("slide.wear", *(*fit)[FrictionTerm::wear], fit->sd_of(FrictionTerm::wear), 1 / found.path_m);
    if (const auto direction = (*fit)[FrictionTerm::direction])
        add("slide.direction", *direction, fit->sd_of(FrictionTerm::direction), 1);
    if (const auto drag = (*fit)[FrictionTerm::other])
        add("slide.drag", *drag * g, fit->sd_of(FrictionTerm::other) * g, of_slip / quadratic);
    if (viscous && (*viscous)[FrictionTerm::other])
        add("slide.viscous", *(*viscous)[FrictionTerm::other] * g, viscous->sd_of(FrictionTerm::other) * g,
            of_slip / linear);
    return all;
}

} // namespace

const TestEstimators& slide_estimators()
{
    static const TestEstimators all = {
        slide_of,
        {{"slide.friction", "", "logarithm of the friction before wear", "corners, centres of mass, damping, drag"},
         {"slide.wear", "1/m", "friction lost per path slipped",
          "all but wear of friction, and friction that depends on time", "path"},
         {"slide.direction", "", "friction to the left less to the right, over their mean",
          "all but friction that depends on direction", "direction"},
         {"slide.drag", "1/m", "drag over mass and square of the speed in the laboratory", "all but drag"},
         {"slide.viscous", "1/s", "drag over mass and speed in the laboratory", "all but drag"}}};
    return all;
}

} // namespace stylobate
