#include "bench/rigid_reference/contact_problem.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stylobate::reference {

namespace {

constexpr int most_sweeps = 20'000, sweeps_between_trials = 10;
constexpr std::size_t most_unknowns = 64;

/// A column of the equations: what an unknown impulse pushes.
struct Unknown {
    std::size_t contact;
    Twist lower, upper;         ///< of the impulse
    Twist row_lower, row_upper; ///< of the condition
    double goal;
};

/// Two points of one bed that hold have one impulse along the face: the second one's would do the same.
bool is_second_to_hold(const Contacts& contacts, std::size_t i)
{
    return i > 0 &&
           std::any_of(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(i), [&](const Contact& other) {
               return other.lower == contacts[i].lower && other.grip == Grip::holds;
           });
}

std::vector<Unknown> unknowns(const Bodies& bodies, const Contacts& contacts, const Twists& free)
{
    std::vector<Unknown> all;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& c = contacts[i];
        if (c.grip == Grip::open)
            continue;
        const double mu = bodies[static_cast<std::size_t>(c.upper())].friction;
        const double share = c.grip == Grip::holds ? 0 : -mu * static_cast<double>(c.grip);
        all.push_back({i, c.rows.normal_lower + share * c.rows.along_lower,
                       c.rows.normal_upper + share * c.rows.along_upper, c.rows.normal_lower, c.rows.normal_upper,
                       -(normal_rate(c, free) + c.add_normal)});
        if (c.grip == Grip::holds && !is_second_to_hold(contacts, i))
            all.push_back({i, c.rows.along_lower, c.rows.along_upper, c.rows.along_lower, c.rows.along_upper,
                           -(along_rate(c, free) + c.add_along)});
    }
    return all;
}

/// Gauss' elimination with pivots. @return false if the equations are singular
bool eliminate(std::array<std::array<double, most_unknowns + 1>, most_unknowns>& a, std::size_t n)
{
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::fabs(a[i][k]) > std::fabs(a[pivot][k]))
                pivot = i;
        if (!(std::fabs(a[pivot][k]) > 0))
            return false;
        std::swap(a[k], a[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            if (factor == 0)
                continue;
            for (std::size_t j = k + 1; j <= n; ++j)
                a[i][j] -= factor * a[k][j];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j)
            a[k][n] -= a[k][j] * a[j][n];
        a[k][n] /= a[k][k];
    }
    return true;
}

/// Impulses with which the points carry, hold and slip as they say. @return false if there are none
bool solve_directly(const Bodies& bodies, Contacts& contacts, const Twists& free)
{
    const std::vector<Unknown> all = unknowns(bodies, contacts, free);
    const std::size_t n = all.size();
    if (n > most_unknowns)
        return false;
    static thread_local std::array<std::array<double, most_unknowns + 1>, most_unknowns> a;
    for (std::size_t i = 0; i < n; ++i) {
        const Unknown& row = all[i];
        const int lower = contacts[row.contact].lower;
        for (std::size_t j = 0; j < n; ++j) {
            const Unknown& column = all[j];
            const int other = contacts[column.contact].lower;
            double sum = 0;
            const auto share = [&](int body, const Twist& condition, const Twist& impulse) {
                sum += dot(condition, moved(bodies[static_cast<std::size_t>(body)], impulse));
            };
            if (lower == other) {
                share(lower, row.row_lower, column.lower);
                share(lower + 1, row.row_upper, column.upper);
            } else if (lower == other + 1) {
                share(lower, row.row_lower, column.upper);
            } else if (lower + 1 == other) {
                share(other, row.row_upper, column.lower);
            }
            a[i][j] = sum;
        }
        a[i][n] = row.goal;
    }
    if (!eliminate(a, n))
        return false;
    for (Contact& c : contacts)
        c.normal = c.along = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Contact& c = contacts[all[i].contact];
        const bool second_row = i > 0 && all[i - 1].contact == all[i].contact;
        (second_row ? c.along : c.normal) = a[i][n];
    }
    return true;
}

/// What two holding points of a bed share of the impulse along the face: in proportion to what they carry.
void share_friction(const Bodies& bodies, Contacts& contacts)
{
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        Contact& c = contacts[i];
        const double mu = bodies[static_cast<std::size_t>(c.upper())].friction;
        if (c.grip == Grip::slips_back || c.grip == Grip::slips_forth)
            c.along = -mu * static_cast<double>(c.grip) * c.normal;
        if (c.grip != Grip::holds || is_second_to_hold(contacts, i))
            continue;
        double normal = 0;
        const double along = c.along;
        for (const Contact& other : contacts)
            normal += other.lower == c.lower && other.grip == Grip::holds ? other.normal : 0;
        if (normal > 0)
            for (Contact& other : contacts)
                if (other.lower == c.lower && other.grip == Grip::holds)
                    other.along = along * other.normal / normal;
    }
}

bool is_verified(const Bodies& bodies, const Contacts& contacts, const Twists& velocity, double tolerance)
{
    return std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        const double u_n = normal_rate(c, velocity) + c.add_normal, u_t = along_rate(c, velocity) + c.add_along;
        if (c.grip == Grip::open)
            return u_n >= -tolerance;
        const Response r = response(bodies, c);
        const double mu = bodies[static_cast<std::size_t>(c.upper())].friction;
        if (std::fabs(u_n) > tolerance || !(c.normal >= -tolerance / r.normal))
            return false;
        if (c.grip == Grip::holds)
            return std::fabs(c.along) <= mu * c.normal + tolerance / r.along;
        return u_t * static_cast<double>(c.grip) >= -tolerance;
    });
}

bool try_directly(const Bodies& bodies, Contacts& contacts, const Twists& free, Twists& velocity, double tolerance)
{
    if (!solve_directly(bodies, contacts, free))
        return false;
    share_friction(bodies, contacts);
    velocity = free;
    for (const Contact& c : contacts)
        push(bodies, c, c.normal, c.along, velocity);
    return is_verified(bodies, contacts, velocity, tolerance);
}

} // namespace

double normal_rate(const Contact& c, const Twists& velocity)
{
    return dot(c.rows.normal_lower, velocity[static_cast<std::size_t>(c.lower)]) +
           dot(c.rows.normal_upper, velocity[static_cast<std::size_t>(c.upper())]);
}

double along_rate(const Contact& c, const Twists& velocity)
{
    return dot(c.rows.along_lower, velocity[static_cast<std::size_t>(c.lower)]) +
           dot(c.rows.along_upper, velocity[static_cast<std::size_t>(c.upper())]);
}

void push(const Bodies& bodies, const Contact& c, double normal, double along, Twists& velocity)
{
    const auto lower = static_cast<std::size_t>(c.lower), upper = lower + 1;
    velocity[lower] += moved(bodies[lower], normal * c.rows.normal_lower + along * c.rows.along_lower);
    velocity[upper] += moved(bodies[upper], normal * c.rows.normal_upper + along * c.rows.along_upper);
}

Response response(const Bodies& bodies, const Contact& c)
{
    const Body& lower = bodies[static_cast<std::size_t>(c.lower)];
    const Body& upper = bodies[static_cast<std::size_t>(c.upper())];
    const ContactRows& r = c.rows;
    const Twist nl = moved(lower, r.normal_lower), nu = moved(upper, r.normal_upper);
    return {dot(r.normal_lower, nl) + dot(r.normal_upper, nu), dot(r.along_lower, nl) + dot(r.along_upper, nu),
            dot(r.along_lower, moved(lower, r.along_lower)) + dot(r.along_upper, moved(upper, r.along_upper))};
}

Impulse single_point(const Response& r, double normal_rate, double along_rate, double mu)
{
    if (normal_rate >= 0)
        return {};
    const double determinant = r.normal * r.along - r.both * r.both;
    const double normal = (r.both * along_rate - r.along * normal_rate) / determinant;
    const double along = (r.both * normal_rate - r.normal * along_rate) / determinant;
    if (normal >= 0 && std::fabs(along) <= mu * normal)
        return {normal, along, Grip::holds};
    Impulse found;
    for (const double way : {along > 0 ? -1.0 : 1.0, along > 0 ? 1.0 : -1.0}) {
        const double p = -normal_rate / (r.normal - way * mu * r.both);
        if (!(p > 0))
            continue;
        found = {p, -way * mu * p, way > 0 ? Grip::slips_forth : Grip::slips_back};
        if (way * (along_rate + r.both * p + r.along * found.along) >= 0)
            return found;
    }
    return found;
}

Solved solve_together(const Bodies& bodies, Contacts& contacts, Twists& velocity, double tolerance)
{
    const Twists free = velocity;
    const Contacts guess = contacts;
    if (try_directly(bodies, contacts, free, velocity, tolerance))
        return {0, true};
    contacts = guess;
    std::vector<Response> responses;
    velocity = free;
    for (const Contact& c : contacts) {
        responses.push_back(response(bodies, c));
        push(bodies, c, c.normal, c.along, velocity);
    }
    Contacts trial;
    Twists trial_velocity;
    for (int sweep = 1; sweep <= most_sweeps; ++sweep) {
        double most = 0;
        for (std::size_t k = 0; k < contacts.size(); ++k) {
            const std::size_t i = sweep % 2 == 0 ? k : contacts.size() - 1 - k;
            Contact& c = contacts[i];
            const Response& r = responses[i];
            const double u_n = normal_rate(c, velocity) + c.add_normal - r.normal * c.normal - r.both * c.along;
            const double u_t = along_rate(c, velocity) + c.add_along - r.both * c.normal - r.along * c.along;
            const Impulse p = single_point(r, u_n, u_t, bodies[static_cast<std::size_t>(c.upper())].friction);
            const double more_normal = p.normal - c.normal, more_along = p.along - c.along;
            most = std::max({most, r.normal * std::fabs(more_normal), r.along * std::fabs(more_along)});
            push(bodies, c, more_normal, more_along, velocity);
            c.normal = p.normal;
            c.along = p.along;
            c.grip = p.grip;
        }
        if (sweep % sweeps_between_trials == 0) {
            trial = contacts;
            if (try_directly(bodies, trial, free, trial_velocity, tolerance)) {
                contacts.swap(trial);
                velocity.swap(trial_velocity);
                return {sweep, true};
            }
        }
        if (most < 1e-3 * tolerance)
            return {sweep, true};
    }
    return {most_sweeps, false};
}

namespace {

constexpr int most_blows = 1'000'000;
/// Closing that is left when an impact is over, of the first one.
constexpr double part_left = 1e-7;

double friction_of(const Bodies& bodies, const Contact& c)
{
    return bodies[static_cast<std::size_t>(c.upper())].friction;
}

double fastest_closing(const Contacts& contacts, const Twists& velocity)
{
    double closing = 0;
    for (const Contact& c : contacts)
        closing = std::max(closing, -normal_rate(c, velocity));
    return closing;
}

bool strike_in_sequence(const Bodies& bodies, Contacts& contacts, Twists& velocity)
{
    const double still = std::max(still_m_s, part_left * fastest_closing(contacts, velocity));
    for (int blow = 0; blow < most_blows; ++blow) {
        const auto fastest =
            std::min_element(contacts.begin(), contacts.end(), [&](const Contact& a, const Contact& b) {
                return normal_rate(a, velocity) < normal_rate(b, velocity);
            });
        const double rate = normal_rate(*fastest, velocity);
        if (rate >= -still)
            return true;
        const Impulse p = single_point(response(bodies, *fastest), rate, along_rate(*fastest, velocity),
                                       friction_of(bodies, *fastest));
        push(bodies, *fastest, p.normal, p.along, velocity);
        fastest->normal += p.normal;
        fastest->along += p.along;
    }
    return false;
}

bool strike_with_dashpots(const Bodies& bodies, const Impacts& impacts, Contacts& contacts, Twists& velocity)
{
    const double still = std::max(still_m_s, part_left * fastest_closing(contacts, velocity));
    double stiffest = 0;
    for (const Contact& c : contacts) {
        const Response r = response(bodies, c);
        stiffest = std::max({stiffest, r.normal, impacts.along_ratio * r.along});
    }
    const double per_rate = impacts.fineness / stiffest;
    for (int increment = 0; increment < most_blows; ++increment) {
        const Twists before = velocity;
        double closing = 0;
        for (Contact& c : contacts) {
            const double rate = normal_rate(c, before);
            closing = std::max(closing, -rate);
            const double normal = per_rate * std::max(0.0, -rate);
            const double limit = friction_of(bodies, c) * normal;
            const double along = std::clamp(-impacts.along_ratio * per_rate * along_rate(c, before), -limit, limit);
            push(bodies, c, normal, along, velocity);
            c.normal += normal;
            c.along += along;
        }
        if (closing <= still)
            return true;
    }
    return false;
}

/// In units of time of 1 / w, w the angular frequency of the first point's upper block on two springs.
bool strike_with_springs(const Bodies& bodies, const Impacts& impacts, Contacts& contacts, Twists& velocity)
{
    constexpr double longest = 200; // a column of six drums has periods of about 60
    const double mass = 1 / bodies[static_cast<std::size_t>(contacts.front().upper())].per_mass;
    const double k = mass / 2, c = impacts.damping_ratio * mass;
    const double k_along = k / 3, c_along = c / std::sqrt(3.0);
    const double dt = 0.5 * impacts.fineness / std::max(1.0, impacts.damping_ratio);
    std::vector<double> depth(contacts.size(), 0.0), spring(contacts.size(), 0.0);
    for (double time = 0; time < longest; time += dt) {
        const Twists before = velocity;
        bool carries = false;
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            Contact& point = contacts[i];
            const double rate = normal_rate(point, before), along_rate_now = along_rate(point, before);
            depth[i] -= rate * dt;
            const double force = depth[i] > 0 ? std::max(0.0, k * depth[i] - c * rate) : 0;
            const double limit = friction_of(bodies, point) * force;
            spring[i] = std::clamp(spring[i] - k_along * along_rate_now * dt, -limit, limit);
            const double normal = force * dt;
            const double along = std::clamp(spring[i] - c_along * along_rate_now, -limit, limit) * dt;
            push(bodies, point, normal, along, velocity);
            point.normal += normal;
            point.along += along;
            carries = carries || force > 0;
        }
        if (!carries)
            return true;
    }
    return false;
}

} // namespace

bool strike(const Bodies& bodies, const Impacts& impacts, Contacts& contacts, Twists& velocity)
{
    for (Contact& c : contacts) {
        c.add_normal = c.add_along = c.normal = c.along = 0;
        c.grip = Grip::holds;
    }
    switch (impacts.law) {
    case ImpactLaw::together:
        return solve_together(bodies, contacts, velocity, 1e-9).exact;
    case ImpactLaw::sequential:
        return strike_in_sequence(bodies, contacts, velocity);
    case ImpactLaw::viscous:
        return strike_with_dashpots(bodies, impacts, contacts, velocity);
    case ImpactLaw::compliant:
        return strike_with_springs(bodies, impacts, contacts, velocity);
    }
    return false;
}

double kinetic_energy(const Bodies& bodies, const Twists& velocity)
{
    double sum = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].per_mass == 0)
            continue;
        const Twist& v = velocity[i];
        sum += (v.x * v.x + v.y * v.y) / bodies[i].per_mass + v.theta * v.theta / bodies[i].per_inertia;
    }
    return sum / 2;
}

} // namespace stylobate::reference
