#include "studies/evidence/verification/reference_runs.hpp"

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/statics/static_state.hpp"
#include "studies/evidence/verification/reference_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stylobate::verification {

namespace {

using reference::Number;
using reference::Solver;
using reference::State;

/// The engine's start, in absolute positions.
std::vector<State> start_of(const Realization& r)
{
    const StaticState rest = static_state(r);
    std::vector<State> states;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        states.push_back(
            {{Number(r.blocks[i].x_m) + rest.x_m[i], Number(r.blocks[i].y_m) + rest.y_m[i]}, rest.theta_rad[i]});
    return states;
}

double rate_of(const Block& b)
{
    return std::sqrt(0.75 * 9.81 / std::hypot(b.half_width_m, b.half_height_m));
}

double slenderness_of(const Block& b)
{
    return std::atan(b.half_width_m / b.half_height_m);
}

/// Steps until `enough` says so, which gets the number of steps made; at most `limit_s`.
template <class Enough>
void follow(const Realization& r, Solver& solver, double limit_s, const BaseMotion* base, Enough enough)
{
    for (int n = 0; n * r.step_s < limit_s; ++n) {
        solver.step(base ? base->displacement_m((n + 1) * r.step_s) : 0);
        if (enough(n + 1))
            return;
    }
}

} // namespace

double reference_upright_time(const Realization& r, const std::vector<int>& blocks)
{
    Solver solver(r, start_of(r));
    const auto lean = [&] {
        double sum = 0;
        for (const int b : blocks)
            sum += static_cast<double>(solver.block(static_cast<std::size_t>(b)).angle);
        return sum / static_cast<double>(blocks.size());
    };
    double before = lean(), time = -1;
    follow(r, solver, 5 / rate_of(r.blocks[static_cast<std::size_t>(blocks.front())]), nullptr, [&](int n) {
        const double now = lean();
        if (now <= 0)
            time = r.step_s * (n - 1 + before / (before - now));
        before = now;
        return time >= 0;
    });
    if (time < 0)
        throw std::runtime_error("by the second solver the block did not come through the upright position in time");
    return time;
}

double reference_restitution(const Realization& r)
{
    Solver solver(r, start_of(r));
    const double alpha = slenderness_of(r.blocks[1]);
    double lowest = 0;
    follow(r, solver, 8 / rate_of(r.blocks[1]), nullptr, [&](int) {
        const auto now = static_cast<double>(solver.block(1).angle);
        const bool turned = lowest < -1e-3 * alpha && now > lowest;
        lowest = std::min(lowest, now);
        return turned;
    });
    const auto energy = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
    return std::sqrt(energy(-lowest) / energy(r.initial_tilt_rad));
}

ReferenceShaken reference_shaken(const Study& study, const Realization& r, double rotation_rad, double height_fraction)
{
    const BaseMotion base(study.excitation, r, nullptr);
    Solver solver(r, start_of(r));
    ReferenceShaken found;
    const auto ground = static_cast<double>(r.blocks[0].y_m + r.blocks[0].half_height_m);
    follow(r, solver, base.duration_s(), &base, [&](int) {
        const std::vector<State>& blocks = solver.blocks();
        for (std::size_t i = 1; i < blocks.size(); ++i) {
            found.rocks = found.rocks || std::fabs(blocks[i].angle - blocks[i - 1].angle) > rotation_rad;
            found.falls = found.falls ||
                          static_cast<double>(blocks[i].at.y()) - ground < height_fraction * (r.blocks[i].y_m - ground);
        }
        return found.falls;
    });
    return found;
}

int reference_way(const Study& study, const Realization& r)
{
    const BaseMotion base(study.excitation, r, nullptr);
    Solver solver(r, start_of(r));
    const double alpha = slenderness_of(r.blocks[1]), clear = 0.01 * alpha;
    int side = 1, crossings = 0; // the base first accelerates to +x: the block leans to -x, counter-clockwise
    double now = 0;
    follow(r, solver, base.duration_s() + 12 / rate_of(r.blocks[1]), &base, [&](int) {
        now = static_cast<double>(solver.block(1).angle);
        if (side * now < -clear) {
            side = -side;
            ++crossings;
        }
        return std::fabs(now) > 1.5 * alpha + 0.3;
    });
    return std::fabs(now) < alpha ? 0 : 1 + crossings;
}

} // namespace stylobate::verification
