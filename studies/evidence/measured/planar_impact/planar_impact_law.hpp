#pragma once
/// The engine's contact law in one impact of an ellipse on a flat surface, step by step.
///
/// Measured planar impacts of a rigid ellipse on a flat surface: table of states before and after, in this house's
/// signs.

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::measured::impact {

/// Velocity of the centre, x to the right and y up, and spin, counter-clockwise.
struct Velocity {
    double x = 0;    ///< [m/s]
    double y = 0;    ///< [m/s]
    double spin = 0; ///< [rad/s]
};
inline Velocity operator-(const Velocity& a, const Velocity& b)
{
    return {a.x - b.x, a.y - b.y, a.spin - b.spin};
}

/// The body of the data set; only ratios of its inertias enter a prediction.
struct Body {
    double mass = 0.0364;     ///< [kg]
    double a = 0.035;         ///< semi-axes [m]
    double b = 0.025;         ///< [m]
    double gyration = 0.0192; ///< radius of gyration [m]

    double inertia() const { return mass * gyration * gyration; }
};

/// One impact. `arm_n` and `arm_t` are the published lever arms of the contact: a unit impulse along the normal and
/// along the tangent have these moments about the centre.
struct Impact {
    long index = 0; ///< in the published order, which is the order in time
    double x = 0;   ///< of the centre along the surface [m]
    double theta = 0;
    Velocity before, after; ///< `after` is NaN where the table does not have it
    double arm_n = 0;       ///< [m]
    double arm_t = 0;       ///< [m]
};

/// Reads a table whose first line names its columns: i, x_i, th_i, vx_i, vy_i, w_i, n_th, d_th and, where they were
/// measured, vx_f, vy_f, w_f; others are passed over. The published vx has the opposite sign of x, of the spin and of
/// the lever arms: it is turned here.
/// @throws InputError (file, line, column, value) if a column is missing or a value is no number in its range
std::vector<Impact> read_impacts(const std::filesystem::path& file);

/// A law's predicted velocities, one for each impact.
struct Prediction {
    std::string law; ///< a word: the prefix of its columns
    std::vector<Velocity> after;
};

/// Writes i and, for each law, LAW_vx_f, LAW_vy_f, LAW_w_f in the published signs (vx turned back).
/// @throws InputError if it cannot be written
void write_predictions(const std::filesystem::path& file, const std::vector<Impact>& impacts,
                       const std::vector<Prediction>& predictions);

/// Kinetic energy of a velocity [J].
double kinetic_energy(const Body& body, const Velocity& v);

/// Error of a predicted velocity in the norm of the kinetic energy, relative to the measured velocity after the
/// impact: sqrt(T(predicted - measured) / T(measured)).
double relative_error(const Body& body, const Velocity& predicted, const Velocity& measured);

/// Lever arms of the contact point about the centre [m].
struct Arms {
    double n = 0;
    double t = 0;
};

/// Closing (< 0) and sliding speed of the contact point [m/s].
struct ContactVelocity {
    double n = 0;
    double t = 0;
};
ContactVelocity at_contact(const Velocity& v, const Arms& arms);

/// Impulse on the body [N s].
struct Impulse {
    double n = 0;
    double t = 0;
};

/// Velocity after an impulse in the contact point.
Velocity after_impulse(const Body& body, const Velocity& v, const Arms& arms, const Impulse& impulse);

/// The impulse in the contact point that comes nearest to a change of velocity, in the norm of the kinetic energy.
Impulse nearest_impulse(const Body& body, const Velocity& change, const Arms& arms);

/// Moment about the centre that no impulse in the contact point gives, as a length over the normal change of momentum:
/// where the line of action passes by the point [m].
double lever_residual(const Body& body, const Velocity& change, const Arms& arms);

/// Coulomb's friction at every instant while the normal impulse grows to `normal`.
Impulse routh(const Body& body, const Velocity& v, const Arms& arms, double mu, double normal);

enum class Restitution {
    total_impulse, ///< Newton's e; Coulomb's cone on the whole impulse: it sticks if that lies in the cone, else slides
    newton,        ///< Routh until v_n = -e v_n before
    poisson        ///< Routh until the impulse is 1 + e times that of the compression
};

/// @pre mu >= 0, 0 <= e <= 1, and the contact point closes
Velocity rigid_impact(const Body& body, const Velocity& v, const Arms& arms, double mu, double e, Restitution rule);

/// Part of an ellipse below a horizontal line.
struct EllipseOverlap {
    double area = 0;   ///< [m2]
    double length = 0; ///< of the chord [m]
    Arms centroid;     ///< the overlap's centroid is at (arms.n, -arms.t) from the ellipse's centre [m]
};

/// Closed form. The affine map that makes the ellipse a unit circle keeps ratios of areas, and takes the line to one at
/// s = height / h from the centre, h = sqrt(a^2 sin^2 + b^2 cos^2): the segment of half angle f = acos(s) has the area
/// f - sin f cos f, and its centroid lies 2 sin^3 f / (3 area) from the centre towards the lowest point, which the map
/// takes to the ellipse's lowest point.
///
/// @param height of the centre above the line [m];  @param theta of the axis a against the line [rad]
EllipseOverlap ellipse_overlap(const Body& body, double height, double theta);

/// The lowest point of an ellipse from its centre: at (n, -t).
Arms lowest_point(const Body& body, double theta);

/// Law of one impact. What follows the blank is neutral at its default.
struct ImpactLaw {
    double K_N = 1e8; ///< [N/m2]
    double C_N = 0;   ///< [N s/m]
    double K_T = 0;   ///< [N/m]
    double C_T = 0;   ///< [N s/m]
    double mu = 0;

    double rate = 0;          ///< Hunt and Crossley's lambda: C_N grows by lambda K_N A [s/m]
    double mu_moving = -1;    ///< of fast sliding, mu falls to it as exp(-|v_t| / stribeck); < 0: mu always
    double stribeck = 0.1;    ///< [m/s]
    double rolling = 0;       ///< moment against the spin, over F_N and the chord
    double surface_mass = 0;  ///< of the surface as a free body that recoils along the normal [kg]; 0: it is fixed
    double inertia_ratio = 1; ///< effective over published moment of inertia
    double turn = 0;          ///< orientation at the contact, less that of the table [rad]
    double tilt = 0;          ///< of the surface, counter-clockwise [rad]
};

struct SimulatedImpact {
    Velocity after;
    double duration_s = 0;
    int steps = 0;
    bool separated = false; ///< else `after` is NaN: it lasted too long
};

/// The law's own step over the period of an undamped one-block contact at the depth of a usual impact; at 0.05 the
/// velocities are good to 1e-3 of the speed.
inline constexpr double usual_step_fraction = 0.05;

/// From the touching of the surface to separation, by central differences, without gravity (of the order of 0.01 m/s in
/// the duration of an impact).
SimulatedImpact simulate_impact(const Body& body, const ImpactLaw& law, const Velocity& before, double theta,
                                double step_fraction = usual_step_fraction);

} // namespace stylobate::measured::impact
