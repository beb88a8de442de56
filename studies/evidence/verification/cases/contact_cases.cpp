/// The contact by itself: overlap, static rest, restitution, free fall.

#include "ensemble/planar/structure/static_state.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/reference_solver.hpp"

#include <fmt/format.h>

#include <random>

namespace stylobate::verification {

namespace {

constexpr const char* contact_subject = "Contact";

/// A drum of unequal width anywhere on another, pressed by little or much, flat or on its corner: the force of the
/// whole step against the exact clipping of the two outlines.
Finding overlap()
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double area = 0, direction = 0, centre = 0;
    constexpr int trials = 20000;
    int pressed = 0;
    for (int i = 0; i < trials; ++i) {
        const model::Stone stone{0.048 * (1 + 0.02 * uniform(random)), 0.029, 0.1355, 0.01 * uniform(random)};
        Realization r = model::single(stone, {1e8, 0, 0.68}, 1e-5, 0.048);
        model::BareColumn column(r);
        const double turn = uniform(random), theta = std::copysign(std::pow(10.0, -7 + 6.5 * std::fabs(turn)), turn);
        const double depth = std::pow(10.0, -6.5 + 1.5 * uniform(random)); // of the lower corner
        column.at(OfBlock::theta, 1) = theta;
        column.at(OfBlock::y, 1) =
            0.5 * stone.width * std::sin(std::fabs(theta)) - stone.height * std::pow(std::sin(0.5 * theta), 2) - depth;
        reference::State base, top;
        base.at = {r.blocks[0].x_m, r.blocks[0].y_m};
        top.at = {reference::Number(r.blocks[1].x_m), reference::Number(r.blocks[1].y_m) + column.at(OfBlock::y, 1)};
        top.angle = theta;
        const reference::Area exact = reference::Solver::overlap_of(r.blocks[0], base, r.blocks[1], top);
        if (exact.area < 1e-14L) // a micrometre by ten nanometres
            continue;
        column.step();
        ++pressed;
        const double fx = column.at(OfBlock::force_x, 1), fy = column.at(OfBlock::force_y, 1);
        const double force = std::hypot(fx, fy), want = static_cast<double>(1e8L * exact.area);
        area = std::max(area, std::fabs(force / want - 1));
        const reference::Vector n = exact.normal(), arm = exact.centroid - top.at;
        direction =
            std::max(direction, std::fabs(fx * static_cast<double>(n.y()) - fy * static_cast<double>(n.x())) / force);
        const double moment = static_cast<double>(reference::cross(arm, n)) * want;
        centre = std::max(centre, std::fabs(column.at(OfBlock::moment, 1) - moment) / (force * 0.048));
    }
    Finding f;
    f.at_least("pairs in contact", 0.5 * trials, pressed);
    f.equals("largest error of the force, relative", 0, area, 1e-8);
    f.equals("largest error of its direction [rad]", 0, direction, 1e-9);
    f.equals("largest error of its moment, over force x width", 0, centre, 1e-9);
    return f;
}

Finding static_overlap()
{
    const Realization r = model::spec({1e8, 0.1}, 6e-5);
    const StaticState rest = static_state(r);
    Finding f;
    f.equals("lowest joint of SPEC, W / (K_N B) [m]", 1.661569e-6, -rest.y_m[1], 5e-13);
    f.equals("top joint of SPEC [m]", 2.769281e-7, rest.y_m[5] - rest.y_m[6], 5e-14);
    return f;
}

Finding restitution()
{
    const auto measured = [](double xi, double dt) {
        Realization r = model::oscillator(2 * model::pi, xi, dt);
        r.gravity_m_s2 = 0;
        model::BareColumn column(r);
        column.at(OfBlock::dy, 1) = -0.1 * dt;
        for (double t = 0; t < 0.6; t += dt)
            column.step();
        return column.at(OfBlock::dy, 1) / (0.1 * dt);
    };
    Finding f;
    for (const double xi : {0.1, 0.2, 0.5}) {
        // x = exp(-xi w t) sin(wd t) / wd with w = 1, until w2 x + 2 xi w x' = 0: the velocity then
        const double wd = std::sqrt(1 - xi * xi);
        const double angle = std::atan2(2 * xi * wd, 2 * xi * xi - 1); // tan(wd t) of that time, in (0, pi)
        const double t = angle / wd;
        const double e = -std::exp(-xi * t) * (std::cos(angle) - xi / wd * std::sin(angle));
        const std::vector<double> steps{8e-5, 4e-5, 2e-5, 1e-5};
        std::vector<double> values;
        for (double dt : steps)
            values.push_back(measured(xi, dt));
        // first order in the step, so two steps give the limit
        f.equals(fmt::format("restitution at xi = {}", xi), e, 2 * values[3] - values[2], 1e-6);
        if (xi == 0.5)
            f.convergences.push_back(convergence("dt over the period", "restitution at xi = 0.5", steps, values, e));
    }
    return f;
}

Finding free_fall()
{
    Realization r = model::single(model::mono_stone, {1e8, 0.1, 0.68}, 1e-4);
    model::BareColumn column(r);
    const double dt = r.step_s, g = r.gravity_m_s2, height = 0.5;
    column.at(OfBlock::y, 1) = height;
    column.at(OfBlock::dy, 1) = 0.5 * g * dt * dt; // from rest
    column.at(OfBlock::dtheta, 1) = 0.1 * dt;
    for (int n = 0; n < 2000; ++n)
        column.step();
    const double t = 2000 * dt;
    Finding f;
    f.equals("height after 0.2 s from 0.5 m [m]", height - 0.5 * g * t * t, column.at(OfBlock::y, 1), 1e-13);
    f.equals("rotation at 0.1 rad/s [rad]", 0.1 * t, column.at(OfBlock::theta, 1), 1e-13);
    return f;
}

} // namespace

Cases contact_cases()
{
    return {
        {"StaticOverlap", contact_subject, "Overlap of the drums of SPEC at rest, K_N = 1e8 N/m2.",
         "W / (K_N B) by hand, seven digits.", "the digits.", static_overlap},
        {"Overlap", contact_subject,
         "The contact force in one step of 20 000 random pairs: drums of unequal widths, eccentric, flat or on a "
         "corner, with an overlap of 1e-8 to 1e-5 m and a rotation of 1e-7 to 0.3 rad.",
         "clipping of one outline by the other (Sutherland and Hodgman) in extended precision.",
         "rounding of positions of 0.01 m against overlaps that may be 1e-8 m deep.", overlap},
        {"Restitution", contact_subject,
         "Impact of a mass on its bed; the contact ends when F_N = max(0, K_N A + C_N v) becomes zero.",
         "the damped oscillation's velocity at the time when spring and dashpot cancel, in closed form.",
         "the scheme is of first order in the dashpot; the extrapolation from two steps leaves a second-order error.",
         restitution},
        {"FreeFall", contact_subject, "A block that falls and rotates without contact.",
         "h - g t2 / 2 and w t: central differences are exact for a constant acceleration.", "rounding of 2000 steps.",
         free_fall},
    };
}

} // namespace stylobate::verification
