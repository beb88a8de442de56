#include "bench/rigid_reference/impact.hpp"

#include <algorithm>

namespace stylobate::reference {

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
