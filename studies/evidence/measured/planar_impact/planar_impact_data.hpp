#pragma once
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

} // namespace stylobate::measured::impact
