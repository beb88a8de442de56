#pragma once
/// Impact of a rigid body in a point of contact: the limit of infinite stiffness, in closed form.
///
/// At the contact, with the lever arms r_n, r_t of a unit normal and tangential impulse and the radius of gyration k,
///
///   m dv_n = (1 + r_n^2/k^2) P_n + (r_n r_t/k^2) P_t        m dv_t = (r_n r_t/k^2) P_n + (1 + r_t^2/k^2) P_t
///
/// E. J. Routh, Dynamics of a System of Rigid Bodies (1905), art. 187: friction acts at every instant of the impact,
/// so that sliding may end and start anew while the normal impulse grows.

#include "studies/evidence/measured/planar_impact/planar_impact_data.hpp"

namespace stylobate::measured::impact {

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

} // namespace stylobate::measured::impact
