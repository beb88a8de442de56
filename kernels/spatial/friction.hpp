#pragma once
/// What a bed gives beside its elastic load: a dashpot spread over the patch, and friction along the face with its
/// torsion. THEORY.md has the equations.
///
/// Friction has three numbers, two forces along the face at the centre of the pressure and one about the normal. The
/// third is a force, too: the torque over the friction radius. The three lie in a sphere of the radius mu N ("friction
/// sphere"), so that a body that spins slides at the slightest push, and the other way round. As in the plane
/// (`planar/contact.hpp`), friction is an elastic trial, returned to the limit, and a dashpot whose total with the
/// spring is limited again.
///
/// Rates are the motion of one step, in m and rad. The power of a dashpot is then its loss of energy per step.

#include "kernels/spatial/bed.hpp"

namespace stylobate::spatial {

/// @pre K_t > 0 and per_K_t = 1 / K_t, the others >= 0; or all 0: then nothing resists
template <class Real>
struct FrictionLaw {
    Real K_t;        ///< stiffness along the face [N/m]
    Real per_K_t;    ///< 1 / K_t [m/N]
    Real C_n_per_dt; ///< dashpot along the normal, per area of the patch [N/m3]
    Real C_t_per_dt; ///< dashpot along the face, per area of the patch [N/m3]
    Real mu;
};

/// Motion of the upper body against the lower one in the last step, in the joint's frame.
template <class Real>
struct BedMotion {
    Vector<Real> displacement; ///< of the upper body's point at P against the lower body's point there [m]
    Vector<Real> rotation;     ///< [rad]
};

/// Springs of friction, carried from step to step: the force on the lower body [N].
template <class Real>
struct FrictionSprings {
    Real x, y;
    Real twist; ///< torque over the friction radius
};

/// The six directions in which a bed resists a motion: rates, or the resistances that belong to them.
template <class Real>
struct BedComponents {
    Real normal;         ///< rate of the point at P [m]; force [N]
    Real tilt_x, tilt_y; ///< growth of the normal rate on the upper face [rad]; first moments on that face [N m]
    Real x, y;           ///< rate of sliding at the centre of the pressure [m]; force [N]
    Real twist;          ///< friction radius times the rotation about the normal [m]; torque over that radius [N]
};

/// The force and torque on the upper body at P, in the joint's frame; those on the lower one are opposite.
template <class Real>
struct BedForce {
    Vector<Real> force, torque;
    Real normal; ///< elastic force and dashpot, >= 0 [N]
    FrictionSprings<Real> springs;
    FrictionSprings<Real> excess; ///< what the limit took from the springs' trial forces [N]
    Real slip;                    ///< of this step, with the torsion as a path at the friction radius, >= 0 [m]
    BedComponents<Real> rates;
    BedComponents<Real> dashpots; ///< resistances
};

/// Stiffness of the torsion spring against K_t. The friction radius of an evenly pressed disc is 2 R / 3; with this
/// factor its stiffness in torsion is K_t R2 / 2, that of K_t spread evenly over the face.
template <class Real>
STYLOBATE_INLINE Real torsion_ratio()
{
    return Real(1.125);
}

namespace detail {

template <class Real>
STYLOBATE_INLINE Real length_of(Real x, Real y, Real z)
{
    return sqrt_of(fma(x, x, fma(y, y, fma(z, z, Real(Extreme<NumberOf<Real>>::tiny)))));
}

/// Rates of a bed. @param centre of the pressure, from P in the joint's frame [m]
template <class Real>
STYLOBATE_INLINE BedComponents<Real> bed_rates(const BedLoad<Real>& load, const BedMotion<Real>& motion,
                                               const Vector<Real>& centre)
{
    const Vector<Real>& w = motion.rotation;
    const Vector<Real> slide = motion.displacement + cross(w, centre);
    // faces that are apart neither close nor slide
    const auto touches = load.force > Real(0.0);
    const auto if_touching = [&](Real rate) { return select(touches, rate, Real(0.0)); };
    return {if_touching(motion.displacement.z),
            if_touching(fms(w.x, load.t21, w.y * load.t11)),
            if_touching(fms(w.x, load.t22, w.y * load.t12)),
            if_touching(slide.x),
            if_touching(slide.y),
            if_touching(load.friction_radius * w.z)};
}

} // namespace detail

/// The dashpot along the normal, c v at each point of the patch. If the sum would pull the faces together with more
/// than the bed's force, all of it is reduced to that.
template <class Real>
STYLOBATE_INLINE void spread_dashpot(const BedLoad<Real>& load, Real C_n, const BedComponents<Real>& rates,
                                     BedComponents<Real>& resistance)
{
    const Real zero(0.0), one(1.0);
    const Real v = rates.normal, bx = rates.tilt_x, by = rates.tilt_y;
    const Real force = C_n * fma(load.area, v, fma(load.first_x, bx, load.first_y * by));
    const auto pulls = force > load.force;
    const Real share = select(pulls, load.force / select(pulls, force, one), one);
    const Real scale = select(load.force > zero, share, zero);
    const Real c = C_n * scale;
    resistance.normal = force * scale;
    resistance.tilt_x = c * fma(load.first_x, v, fma(load.second_xx, bx, load.second_xy * by));
    resistance.tilt_y = c * fma(load.first_y, v, fma(load.second_xy, bx, load.second_yy * by));
}

/// The velocity of friction: sliding at the centre of the pressure, with the torsion as a path at the friction radius.
/// @return its size in this step, > 0 [m]
template <class Real>
STYLOBATE_INLINE Real sliding_of(const BedComponents<Real>& rates)
{
    return detail::length_of(rates.x, rates.y, rates.twist);
}

/// All of what a pressed bed does to the upper body. Where the faces are apart (`load.force` is 0), everything is 0 and
/// the springs are lost.
/// @param springs as the last step left them
/// @param dashpot_of (rates, resistance): sets the resistance along the normal and its first moments
/// @param limit_of (normal, rates) -> largest force of friction; 0 where `load.force` is 0 [N]
template <class Real, class Dashpot, class Limit>
STYLOBATE_INLINE BedForce<Real> bed_force(const BedLoad<Real>& load, const FrictionLaw<Real>& law,
                                          const BedMotion<Real>& motion, const FrictionSprings<Real>& springs,
                                          const Dashpot& dashpot_of, const Limit& limit_of)
{
    const Real zero(0.0), one(1.0);
    const Real per_N = one / select(load.force > zero, load.force, one);
    const Real px = load.moment_x * per_N, py = load.moment_y * per_N;
    const Vector<Real> centre{fma(load.t11, px, load.t12 * py), fma(load.t21, px, load.t22 * py),
                              zero - fma(load.slope_x, px, load.slope_y * py)};
    BedForce<Real> bed;
    bed.rates = detail::bed_rates(load, motion, centre);
    BedComponents<Real>& resistance = bed.dashpots;
    dashpot_of(bed.rates, resistance);
    bed.normal = max_of(load.force - resistance.normal, zero);

    // friction: elastic trial, then return to the limit
    const Real limit = limit_of(bed.normal, bed.rates);
    const Real sx = fma(law.K_t, bed.rates.x, springs.x), sy = fma(law.K_t, bed.rates.y, springs.y);
    const Real st = fma(torsion_ratio<Real>() * law.K_t, bed.rates.twist, springs.twist);
    const Real trial = detail::length_of(sx, sy, st);
    const Real kept = min_of(one, limit / trial);
    bed.springs = {sx * kept, sy * kept, st * kept};
    bed.excess = {sx - bed.springs.x, sy - bed.springs.y, st - bed.springs.twist};
    bed.slip = (trial - trial * kept) * law.per_K_t;
    // the total with the dashpot stays within the limit, too
    const Real C_t = law.C_t_per_dt * load.area;
    const Real fx = fma(C_t, bed.rates.x, bed.springs.x), fy = fma(C_t, bed.rates.y, bed.springs.y);
    const Real ft = fma(C_t, bed.rates.twist, bed.springs.twist);
    const Real scale = min_of(one, limit / detail::length_of(fx, fy, ft));
    const Real Fx = fx * scale, Fy = fy * scale, Ft = ft * scale;
    resistance.x = Fx - bed.springs.x, resistance.y = Fy - bed.springs.y, resistance.twist = Ft - bed.springs.twist;

    bed.force = {load.lateral_x - Fx, load.lateral_y - Fy, bed.normal};
    // moments of the dashpot on the upper face, turned to the joint's frame; then friction at the centre of the
    // pressure
    const Real Kx = fma(load.t11, resistance.tilt_x, load.t12 * resistance.tilt_y);
    const Real Ky = fma(load.t21, resistance.tilt_x, load.t22 * resistance.tilt_y);
    bed.torque = {load.torque.x - Ky + centre.z * Fy, load.torque.y + Kx - centre.z * Fx,
                  load.torque.z + fms(centre.y, Fx, centre.x * Fy) - load.friction_radius * Ft};
    return bed;
}

/// The same with a dashpot that is spread over the patch, and Coulomb's limit.
template <class Real>
STYLOBATE_INLINE BedForce<Real> bed_force(const BedLoad<Real>& load, const FrictionLaw<Real>& law,
                                          const BedMotion<Real>& motion, const FrictionSprings<Real>& springs)
{
    return bed_force(
        load, law, motion, springs,
        [&](const BedComponents<Real>& rates, BedComponents<Real>& resistance) {
            spread_dashpot(load, law.C_n_per_dt, rates, resistance);
        },
        [&law](Real normal, const BedComponents<Real>&) { return law.mu * normal; });
}

/// Energy of the springs of friction [J].
template <class Real>
STYLOBATE_INLINE Real spring_energy(const FrictionSprings<Real>& s, Real per_K_t)
{
    const Real per_ratio = Real(1.0 / torsion_ratio<double>());
    return Real(0.5) * fma(s.x, s.x, fma(s.y, s.y, s.twist * s.twist * per_ratio)) * per_K_t;
}

/// Energy that slipping took from the springs in this step [J]: the work of the mean of the forces before and after it,
/// less the energy that the springs gained.
/// @param before the springs as the last step left them
template <class Real>
STYLOBATE_INLINE Real slip_loss(const BedForce<Real>& bed, const FrictionSprings<Real>& before, Real per_K_t)
{
    const Real twist = bed.excess.twist * (bed.springs.twist + before.twist) * Real(1.0 / torsion_ratio<double>());
    return Real(0.5) * fma(bed.excess.x, bed.springs.x + before.x, fma(bed.excess.y, bed.springs.y + before.y, twist)) *
           per_K_t;
}

/// Energy that the dashpots took in this step [J]: the work of the mean of their forces before and after it, as central
/// differences weigh them.
/// @param before the dashpots of the last step; 0 where the faces were apart
template <class Real>
STYLOBATE_INLINE Real dashpot_loss(const BedForce<Real>& bed, const BedComponents<Real>& before)
{
    const BedComponents<Real>&r = bed.rates, &now = bed.dashpots;
    const Real normal = fma(now.normal + before.normal, r.normal,
                            fma(now.tilt_x + before.tilt_x, r.tilt_x, (now.tilt_y + before.tilt_y) * r.tilt_y));
    const Real along = fma(now.x + before.x, r.x, fma(now.y + before.y, r.y, (now.twist + before.twist) * r.twist));
    return Real(0.5) * (normal + along);
}

} // namespace stylobate::spatial
