#pragma once
/// The contact law: Eqs. 1 to 3 of Papaloizou and Komodromos, with the choices of `THEORY.md` section 3. Friction is
/// the return mapping of elastic, perfectly plastic friction (Simo & Laursen, "An augmented Lagrangian treatment of
/// contact problems involving friction", Computers & Structures 42 (1992) 97).

#include "kernels/real.hpp"

namespace stylobate {

/// Law of one joint, in units that suit a step: the dashpots act on the displacement of one step, not on a velocity.
template <class Real>
struct JointLaw {
    Real K_n;        ///< force per overlap area [N/m2]
    Real K_t;        ///< [N/m]
    Real C_n_per_dt; ///< [N/m], for any contact length
    Real C_t_per_dt; ///< [N/m], for any contact length
    Real C_n_chord;  ///< [N/m2], times the contact length
    Real C_t_chord;  ///< [N/m2], times the contact length
    Real mu;
};

template <class Real>
struct ContactForce {
    Real normal;     ///< F_N >= 0: pushes the blocks apart [N]
    Real tangential; ///< F_T, against the sliding of the upper block [N]
    Real spring;     ///< elastic part of F_T [N]
    Real excess;     ///< part of the spring's trial force beyond the limit, >= 0 [N]
};

/// The friction force for the sliding of this step, within |F_T| <= limit.
/// @param sliding of this step [m];  @param spring elastic part of F_T, carried from step to step [N]
/// @return `normal` is left at 0
template <class Real>
STYLOBATE_INLINE ContactForce<Real> friction_force(const JointLaw<Real>& law, Real limit, Real length, Real sliding,
                                                   Real spring)
{
    // elastic trial, then return to the Coulomb cone; the total with the dashpot stays in the cone too
    const Real least = Real(0.0) - limit;
    const Real trial = fma(law.K_t, sliding, spring);
    const Real kept = clamp(trial, least, limit);
    const Real C_t = fma(law.C_t_chord, length, law.C_t_per_dt);
    const Real F_t = clamp(fma(C_t, sliding, kept), least, limit);
    return {Real(0.0), F_t, kept, abs_of(trial - kept)};
}

/// Force between two blocks through their joint.
///
///   F_N = max(0, K_N A_c + C_N v_N)        |F_T| <= mu F_N
///
/// Where the blocks do not touch, area, length, closing and sliding are 0; so are then the forces and the spring.
///
/// @param area     A_c [m2];  @param length  of the contact [m]
/// @param closing, sliding  displacement of the faces against each other in this step, at the centroid [m]
/// @param spring   elastic part of F_T, carried from step to step [N]
/// @pre K_N, K_T > 0, mu >= 0, C >= 0
template <class Real>
STYLOBATE_INLINE ContactForce<Real> contact_force(const JointLaw<Real>& law, Real area, Real length, Real closing,
                                                  Real sliding, Real spring)
{
    const Real zero(0.0);
    // normal: penalty on the overlap; the dashpot may never pull the faces together
    const Real C_n = fma(law.C_n_chord, length, law.C_n_per_dt);
    const Real F_n = max_of(fma(C_n, closing, law.K_n * area), zero);

    ContactForce<Real> force = friction_force(law, law.mu * F_n, length, sliding, spring);
    force.normal = F_n;
    return force;
}

} // namespace stylobate
