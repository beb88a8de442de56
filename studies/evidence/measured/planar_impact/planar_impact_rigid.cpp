#include "studies/evidence/measured/planar_impact/planar_impact_rigid.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::measured::impact {

namespace {

/// Change of the contact's velocity per impulse [1/kg].
struct Mobility {
    double nn, nt, tt;
};

Mobility mobility(const Body& body, const Arms& arms)
{
    const double m = 1 / body.mass, i = 1 / body.inertia();
    return {m + i * arms.n * arms.n, i * arms.n * arms.t, m + i * arms.t * arms.t};
}

/// Impulse that changes the contact's velocity by this.
Impulse impulse_for(const Mobility& w, const ContactVelocity& change)
{
    const double determinant = w.nn * w.tt - w.nt * w.nt;
    return {(w.tt * change.n - w.nt * change.t) / determinant, (w.nn * change.t - w.nt * change.n) / determinant};
}

/// While the normal impulse grows the tangential one grows by a constant ratio, which changes once at most: where the
/// sliding ends.
struct Path {
    double first = 0;  ///< dP_t / dP_n from the start
    double second = 0; ///< after the sliding has ended
    double turn = 0;   ///< normal impulse at that moment
    double tangential(double normal) const
    {
        return first * std::min(normal, turn) + second * std::max(normal - turn, 0.0);
    }
};

Path friction_path(const Mobility& w, double sliding, double mu)
{
    // from rest: sticking if the cone allows it, else sliding to the side to which the normal impulse drives it
    const double held = -w.nt / w.tt;
    const double second = std::clamp(held, -mu, mu);
    if (sliding == 0)
        return {second, second, 0};
    const double first = sliding > 0 ? -mu : mu;
    const double rate = w.nt + w.tt * first; // of the sliding
    const bool ends = sliding * rate < 0;
    return {first, second, ends ? -sliding / rate : HUGE_VAL};
}

/// The normal impulse at which v_n has grown by `growth`. It grows with the impulse in either part of the path, or a
/// body is jammed (Painleve), which friction below r_n-dependent bounds excludes.
double impulse_until(const Mobility& w, const Path& path, double growth)
{
    const double rate = w.nn + w.nt * path.first;
    const double normal = growth / rate;
    if (normal <= path.turn)
        return normal;
    return path.turn + (growth - rate * path.turn) / (w.nn + w.nt * path.second);
}

} // namespace

ContactVelocity at_contact(const Velocity& v, const Arms& arms)
{
    return {v.y + arms.n * v.spin, v.x + arms.t * v.spin};
}

Velocity after_impulse(const Body& body, const Velocity& v, const Arms& arms, const Impulse& impulse)
{
    return {v.x + impulse.t / body.mass, v.y + impulse.n / body.mass,
            v.spin + (impulse.n * arms.n + impulse.t * arms.t) / body.inertia()};
}

Impulse nearest_impulse(const Body& body, const Velocity& change, const Arms& arms)
{
    // The residual is orthogonal, in that norm, to all that an impulse can do if it does not move the contact point.
    return impulse_for(mobility(body, arms), at_contact(change, arms));
}

double lever_residual(const Body& body, const Velocity& change, const Arms& arms)
{
    const double moment = body.inertia() * change.spin - body.mass * (change.x * arms.t + change.y * arms.n);
    return moment / (body.mass * change.y);
}

Impulse routh(const Body& body, const Velocity& v, const Arms& arms, double mu, double normal)
{
    return {normal, friction_path(mobility(body, arms), at_contact(v, arms).t, mu).tangential(normal)};
}

Velocity rigid_impact(const Body& body, const Velocity& v, const Arms& arms, double mu, double e, Restitution rule)
{
    const Mobility w = mobility(body, arms);
    const ContactVelocity c = at_contact(v, arms);
    if (rule == Restitution::total_impulse) {
        const Impulse sticking = impulse_for(w, {-(1 + e) * c.n, -c.t});
        if (std::fabs(sticking.t) <= mu * sticking.n)
            return after_impulse(body, v, arms, sticking);
        const double ratio = std::copysign(mu, sticking.t);
        const double normal = -(1 + e) * c.n / (w.nn + w.nt * ratio);
        return after_impulse(body, v, arms, {normal, ratio * normal});
    }
    const Path path = friction_path(w, c.t, mu);
    const double normal =
        rule == Restitution::newton ? impulse_until(w, path, -(1 + e) * c.n) : (1 + e) * impulse_until(w, path, -c.n);
    return after_impulse(body, v, arms, routh(body, v, arms, mu, normal));
}

} // namespace stylobate::measured::impact
