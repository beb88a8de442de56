#include "bench/rigid_reference/column.hpp"

#include "ensemble/planar/structure/scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stylobate::reference {

namespace {

constexpr double rate_tolerance = 1e-9; ///< of conditions [m/s]
constexpr double gap_tolerance = 1e-12; ///< of places [m]
constexpr double met_m = 1e-9;          ///< gap at which a point has met its face
constexpr double recovery_m_s = 0.01;   ///< at most so fast a point comes out of a face
constexpr double deepest_part = 0.05;   ///< of the half height: what is deeper is no contact of faces
constexpr int most_bends = 4, most_halvings = 60, most_impacts = 200;

} // namespace

Column::Column(Bodies bodies, Twists places, Impacts impacts)
    : bodies_(std::move(bodies)), place_(std::move(places)), velocity_(place_.size()), impacts_(impacts),
      memory_(corners_of_bed * bodies_.size())
{
}

Contacts Column::points_within(const Twists& place, double reach_m) const
{
    Contacts all;
    for (std::size_t i = 0; i + 1 < bodies_.size(); ++i) {
        const Body &lower = bodies_[i], &upper = bodies_[i + 1];
        for (int k = 0; k < corners_of_bed; ++k) {
            const auto corner = static_cast<Corner>(k);
            const Meeting m = meeting(lower, upper, place[i], place[i + 1], corner);
            if (!m.on_face || m.gap > reach_m || m.gap < -deepest_part * upper.half_height_m)
                continue;
            Contact c;
            c.lower = static_cast<int>(i);
            c.corner = corner;
            c.gap = m.gap;
            c.rows = rows(lower, upper, place[i], place[i + 1], corner);
            all.push_back(c);
        }
    }
    return all;
}

void Column::guess(Contacts& contacts, double per_step) const
{
    for (Contact& c : contacts) {
        const Memory& m = memory_[c.key()];
        c.grip = m.grip;
        c.normal = m.normal * per_step;
        c.along = m.along * per_step;
    }
}

void Column::remember(const Contacts& contacts, double per_step)
{
    for (const Contact& c : contacts) {
        Memory& m = memory_[c.key()];
        m.grip = c.grip;
        m.normal = c.normal / per_step;
        m.along = c.along / per_step;
    }
}

void Column::solve(Contacts& contacts, Twists& velocity, double per_step)
{
    const Solved solved = solve_together(bodies_, contacts, velocity, rate_tolerance);
    counts_.swept += solved.sweeps > 0;
    counts_.inexact += !solved.exact;
    remember(contacts, per_step);
}

double Column::least_other_gap(const Contacts& touching, const Twists& place) const
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < bodies_.size(); ++i)
        for (int k = 0; k < corners_of_bed; ++k) {
            const auto corner = static_cast<Corner>(k);
            const Meeting m = meeting(bodies_[i], bodies_[i + 1], place[i], place[i + 1], corner);
            if (!m.on_face || m.gap >= least || m.gap < -deepest_part * bodies_[i + 1].half_height_m)
                continue;
            const bool touched = std::any_of(touching.begin(), touching.end(), [&](const Contact& c) {
                return c.lower == static_cast<int>(i) && c.corner == corner;
            });
            // corners that pass each other exchange their parts; what was a part of this end has touched already
            const bool exchanged = std::any_of(touching.begin(), touching.end(), [&](const Contact& c) {
                return c.lower == static_cast<int>(i) && (static_cast<int>(c.corner) & 1) == (k & 1);
            });
            if (!touched && !exchanged)
                least = m.gap;
        }
    return least;
}

/// Differences of gaps and sliding over the step beside what the rows say of them.
void Column::bend(const Trial& trial, double step_s, double& most_change, Contacts& contacts) const
{
    most_change = 0;
    for (Contact& c : contacts) {
        const auto i = static_cast<std::size_t>(c.lower);
        const Meeting before = meeting(bodies_[i], bodies_[i + 1], place_[i], place_[i + 1], c.corner);
        const Meeting after = meeting(bodies_[i], bodies_[i + 1], trial.place[i], trial.place[i + 1], c.corner);
        const double goal = std::min(0.0, before.gap + recovery_m_s * step_s);
        const double normal = (after.gap - goal) / step_s - normal_rate(c, trial.velocity);
        const double along = (after.along - before.along) / step_s - along_rate(c, trial.velocity);
        most_change = std::max({most_change, std::fabs(normal - c.add_normal), std::fabs(along - c.add_along)});
        c.add_normal = normal;
        c.add_along = along;
    }
}

Column::Trial Column::attempt(const Contacts& touching, double step_s, double x_m_s2, double y_m_s2)
{
    const double half = step_s / 2;
    Twists free = velocity_;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].per_mass > 0)
            free[i] += {half * x_m_s2, half * y_m_s2, 0};
    Trial trial;
    trial.contacts = touching;
    guess(trial.contacts, half);
    for (Contact& c : trial.contacts) {
        c.add_normal = memory_[c.key()].bend_normal * step_s + (c.gap - std::min(0.0, c.gap)) / step_s;
        c.add_along = memory_[c.key()].bend_along * step_s;
    }
    double change = 0;
    for (int round = 0; round < most_bends; ++round) {
        trial.velocity = free;
        solve(trial.contacts, trial.velocity, half);
        trial.place = place_;
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            trial.place[i] += step_s * trial.velocity[i];
        bend(trial, step_s, change, trial.contacts);
        if (change * step_s < gap_tolerance)
            break;
    }
    for (const Contact& c : trial.contacts) {
        memory_[c.key()].bend_normal = (c.add_normal - std::max(0.0, c.gap) / step_s) / step_s;
        memory_[c.key()].bend_along = c.add_along / step_s;
    }
    trial.least_gap = least_other_gap(touching, trial.place);
    // the second half, with the points that touch then of those that did
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].per_mass > 0)
            trial.velocity[i] += {half * x_m_s2, half * y_m_s2, 0};
    Contacts last;
    for (const Contact& c : points_within(trial.place, touching_m_))
        if (std::any_of(touching.begin(), touching.end(), [&](const Contact& t) { return t.key() == c.key(); }))
            last.push_back(c);
    guess(last, half);
    solve(last, trial.velocity, half);
    trial.contacts = std::move(last);
    return trial;
}

void Column::strike_what_closes()
{
    Contacts contacts = touching();
    if (std::none_of(contacts.begin(), contacts.end(),
                     [&](const Contact& c) { return normal_rate(c, velocity_) < -still_m_s; }))
        return;
    ++counts_.impacts;
    counts_.inexact += !strike(bodies_, impacts_, contacts, velocity_);
    for (const Contact& c : contacts)
        if (memory_[c.key()].grip == Grip::open)
            memory_[c.key()] = {Grip::holds, 0, 0, 0, 0};
}

/// Up to the next impact, or the end of the step. @return time that is left
double Column::advance(double step_s, double x_m_s2, double y_m_s2, bool crowded)
{
    Contacts touching = points_within(place_, crowded ? 1e-5 : touching_m_);
    Trial trial = attempt(touching, step_s, x_m_s2, y_m_s2);
    double taken = step_s;
    if (!crowded && trial.least_gap < -gap_tolerance) {
        double low = 0, high = step_s, low_gap = least_other_gap(touching, place_), high_gap = trial.least_gap;
        for (int i = 0; i < most_halvings && (trial.least_gap < -gap_tolerance * 10 || trial.least_gap > met_m); ++i) {
            const bool bisect = i % 4 == 3 || !std::isfinite(low_gap);
            taken = bisect ? (low + high) / 2 : low + (high - low) * low_gap / (low_gap - high_gap);
            trial = attempt(touching, taken, x_m_s2, y_m_s2);
            if (trial.least_gap < 0) {
                high = taken;
                high_gap = trial.least_gap;
            } else {
                low = taken;
                low_gap = trial.least_gap;
            }
        }
    }
    place_ = std::move(trial.place);
    velocity_ = std::move(trial.velocity);
    return step_s - taken;
}

void Column::step(double step_s, double x_m_s2, double y_m_s2)
{
    double left = step_s;
    for (int impact = 0; left > 1e-9 * step_s; ++impact) {
        const bool crowded = impact >= most_impacts;
        counts_.crowded += crowded;
        left = advance(left, x_m_s2, y_m_s2, crowded);
        strike_what_closes();
    }
}

namespace {

constexpr int check_steps = 16;

Bodies bodies_of(const Realization& r)
{
    Bodies bodies;
    for (const Block& b : r.blocks)
        bodies.push_back(
            {b.half_width_m, b.half_height_m, b.fixed ? 0 : 1 / b.mass_kg, b.fixed ? 0 : 1 / b.inertia_kg_m2, 0});
    for (const Joint& j : r.joints)
        if (j.lower + 1 == j.upper)
            bodies[static_cast<std::size_t>(j.upper)].friction = j.friction;
    return bodies;
}

Twists places_of(const Realization& r)
{
    Twists places;
    for (const Block& b : r.blocks)
        places.push_back({b.x_m, b.y_m, 0});
    return places;
}

LimitStates limits_of(const Study& study, const Realization& r, double step_s)
{
    const Block& below = r.blocks[static_cast<std::size_t>(r.joints.front().lower)];
    return {r, study.outcome, below.y_m + below.half_height_m,
            static_cast<std::uint64_t>(std::ceil(1 / scales_of(r).p_rad_s / step_s))};
}

} // namespace

Draw::Draw(const Study& study, Realization realization, const Impacts& impacts, double step_s)
    : realization_(std::move(realization)), step_s_(step_s), base_(study.excitation, realization_, nullptr),
      end_s_(base_.duration_s() + study.excitation.tail_s.value_or(0)),
      column_(bodies_of(realization_), places_of(realization_), impacts), start_(places_of(realization_)),
      limits_(limits_of(study, realization_, step_s)), moved_(realization_.blocks.size()),
      inside_(realization_.blocks.size(), -1)
{
}

/// Mean over a step of the second difference of the displacement.
double Draw::base_acceleration(int step) const
{
    if (step * step_s_ >= base_.duration_s())
        return 0;
    const auto at = [&](int k) { return base_.displacement_m(k * step_s_); };
    return ((at(step + 2) - at(step + 1)) - (at(step) - at(step - 1))) / (2 * step_s_ * step_s_);
}

void Draw::step()
{
    const double g = realization_.gravity_m_s2, lean = realization_.base_tilt_rad;
    column_.step(step_s_, g * std::sin(lean) - base_acceleration(steps_), -g * std::cos(lean));
    ++steps_;
    for (std::size_t i = 0; i < moved_.size(); ++i) {
        const Twist& at = column_.places()[i];
        moved_[i] = {at.x - start_[i].x, at.y - start_[i].y, at.theta - start_[i].theta};
    }
    if (steps_ % check_steps == 0)
        limits_.check(realization_, static_cast<std::uint64_t>(steps_), moved_, inside_, check_steps);
}

bool Draw::conclude()
{
    limits_.conclude();
    return fallen();
}

} // namespace stylobate::reference
