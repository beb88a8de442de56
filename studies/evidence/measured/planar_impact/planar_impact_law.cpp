#include "studies/evidence/measured/planar_impact/planar_impact_law.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "kernels/planar/contact.hpp"
#include "studies/evidence/measured/parts/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate::measured::impact {

namespace {

/// @param largest of the size of the value
double bounded(const Table& table, const std::string& file, std::size_t row, const char* heading, double largest)
{
    const double value = table.number(row, heading);
    if (!(std::fabs(value) <= largest))
        throw InputError(
            file, static_cast<long>(row) + 2,
            fmt::format("{} = {} is outside [-{}, {}].\n  SI units are expected.", heading, value, largest, largest));
    return value;
}

} // namespace

std::vector<Impact> read_impacts(const std::filesystem::path& file)
{
    const Table table(file);
    const bool measured = table.has("vx_f") && table.has("vy_f") && table.has("w_f");
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Impact> impacts(table.rows());
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto value = [&](const char* heading, double largest) {
            return bounded(table, file.string(), row, heading, largest);
        };
        const auto velocity = [&](const char* x, const char* y, const char* spin) {
            return Velocity{-value(x, 100), value(y, 100), value(spin, 1e4)};
        };
        impacts[row] = {std::lround(value("i", 1e9)),
                        value("x_i", 100),
                        value("th_i", 1e4),
                        velocity("vx_i", "vy_i", "w_i"),
                        measured ? velocity("vx_f", "vy_f", "w_f") : Velocity{nan, nan, nan},
                        value("n_th", 1),
                        value("d_th", 1)};
    }
    if (impacts.empty())
        throw InputError(file.string(), 1, "there is no impact in this table.");
    return impacts;
}

void write_predictions(const std::filesystem::path& file, const std::vector<Impact>& impacts,
                       const std::vector<Prediction>& predictions)
{
    std::string text = "i";
    for (const Prediction& p : predictions)
        text += fmt::format(",{0}_vx_f,{0}_vy_f,{0}_w_f", p.law);
    text += '\n';
    for (std::size_t k = 0; k < impacts.size(); ++k) {
        text += fmt::format("{}", impacts[k].index);
        for (const Prediction& p : predictions)
            text += fmt::format(",{:.7g},{:.7g},{:.7g}", -p.after[k].x, p.after[k].y, p.after[k].spin);
        text += '\n';
    }
    write_whole(file, text);
}

double kinetic_energy(const Body& body, const Velocity& v)
{
    return 0.5 * (body.mass * (v.x * v.x + v.y * v.y) + body.inertia() * v.spin * v.spin);
}

double relative_error(const Body& body, const Velocity& predicted, const Velocity& measured)
{
    return std::sqrt(kinetic_energy(body, predicted - measured) / kinetic_energy(body, measured));
}

namespace {

/// Support function h of the ellipse for the direction down, and the sine and cosine of its angle.
struct Attitude {
    double sine, cosine, h;
};

Attitude attitude(const Body& body, double theta)
{
    const double s = std::sin(theta), c = std::cos(theta);
    return {s, c, std::sqrt(body.a * body.a * s * s + body.b * body.b * c * c)};
}

double lowest_n(const Body& body, const Attitude& at)
{
    return -(body.a * body.a - body.b * body.b) * at.sine * at.cosine / at.h;
}

/// Components in a frame turned by an angle.
Velocity turned(const Velocity& v, double angle)
{
    const double s = std::sin(angle), c = std::cos(angle);
    return {c * v.x + s * v.y, c * v.y - s * v.x, v.spin};
}

/// A part of the penalty's own period at a depth where the chord is a usual one: sqrt(m / (K_N chord)).
double step_of(const Body& body, double K_N, double step_fraction)
{
    constexpr double usual_chord = 0.009; // [m], at 2.5 m/s and 1e8 N/m2
    return step_fraction * std::sqrt(body.mass / (K_N * usual_chord));
}

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

EllipseOverlap ellipse_overlap(const Body& body, double height, double theta)
{
    const Attitude at = attitude(body, theta);
    const Arms lowest{lowest_n(body, at), at.h};
    const double s = std::max(height / at.h, -1.0);
    if (s >= 1)
        return {0, 0, lowest};
    const double half = std::acos(s), sine = std::sin(half);
    // f - sin f cos f loses all its digits at small f, where it is 2/3 f^3 (1 - f^2/5)
    const double segment = half < 1e-3 ? half * half * half * (2.0 / 3) * (1 - half * half / 5) : half - sine * s;
    const double place = half < 1e-3 ? 1 - 0.3 * half * half : 2 * sine * sine * sine / (3 * segment);
    return {body.a * body.b * segment, 2 * body.a * body.b / at.h * sine, {place * lowest.n, place * lowest.t}};
}

Arms lowest_point(const Body& body, double theta)
{
    const Attitude at = attitude(body, theta);
    return {lowest_n(body, at), at.h};
}

SimulatedImpact simulate_impact(const Body& body, const ImpactLaw& law, const Velocity& before, double theta,
                                double step_fraction)
{
    const double dt = step_of(body, law.K_N, step_fraction);
    const double inertia = body.inertia() * law.inertia_ratio;
    double angle = theta + law.turn - law.tilt;
    double height = attitude(body, angle).h, recoil = 0, recoil_speed = 0, spring = 0;
    Velocity v = turned(before, law.tilt);
    bool touched = false;
    constexpr int most = 20000;
    for (int step = 1; step <= most; ++step) {
        height += v.y * dt;
        angle += v.spin * dt;
        recoil += recoil_speed * dt;
        const EllipseOverlap o = ellipse_overlap(body, height - recoil, angle);
        const ContactVelocity c = at_contact(v, o.centroid);
        if (o.area > 0)
            touched = true;
        else if (touched && c.n > recoil_speed)
            return {turned(v, -law.tilt), step * dt, step, true};
        if (o.area <= 0) {
            spring = 0;
            continue;
        }
        const double mu = law.mu_moving < 0
                              ? law.mu
                              : law.mu_moving + (law.mu - law.mu_moving) * std::exp(-std::fabs(c.t) / law.stribeck);
        const double C_N = law.C_N + law.rate * law.K_N * o.area;
        const JointLaw<double> joint{law.K_N, law.K_T, C_N / dt, law.C_T / dt, 0, 0, mu};
        const ContactForce<double> f =
            contact_force(joint, o.area, o.length, (recoil_speed - c.n) * dt, -c.t * dt, spring);
        spring = f.spring;
        // the rolling moment stops the spin at most
        const double brake = std::min(law.rolling * f.normal * o.length, inertia * std::fabs(v.spin) / dt);
        v.x += dt / body.mass * f.tangential;
        v.y += dt / body.mass * f.normal;
        v.spin += dt / inertia * (f.tangential * o.centroid.t + f.normal * o.centroid.n - std::copysign(brake, v.spin));
        if (law.surface_mass > 0)
            recoil_speed -= dt / law.surface_mass * f.normal;
    }
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {{nan, nan, nan}, most * dt, most, false};
}

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
