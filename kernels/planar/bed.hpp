#pragma once
/// The formulas of a step for one bed and one block, as functions from values to values. `Stepper` (`step.hpp`) applies
/// them to every bed of a realization, whose values are rows in memory; on a device a lane of a warp applies them to
/// its own bed and block, whose values stay in registers (`kernels/lanes/`). `THEORY.md` derives them.

#include "kernels/planar/contact.hpp"
#include "kernels/planar/overlap.hpp"
#include "kernels/planar/rows.hpp"

namespace stylobate {

/// Where a block is, against its place at rest.
template <class Real>
struct Pose {
    Real sine, versine, theta;
    Real x, y; ///< of the geometric centre [m]
};

namespace detail {

/// Area and contact length below which two blocks do not touch.
inline constexpr double least_area = 1e-18;  // m2
inline constexpr double least_chord = 1e-12; // m

} // namespace detail

/// The size of a contact, and what the next quantities are divided by. Where the blocks do not touch, the area is 0 and
/// the divisors are 1.
template <class Real>
struct ContactSize {
    decltype(Real(0.0) < Real(0.0)) pressed; ///< whether the blocks touch
    Real area;                               ///< [m2]
    Real chord;                              ///< contact length [m]
    Real per_area, per_chord;                ///< 1 / area [1/m2], 1 / contact length [1/m]
};

/// @param o overlap of the two blocks
template <class Real>
STYLOBATE_INLINE ContactSize<Real> contact_size(const Overlap<Real>& o)
{
    const Real zero(0.0), one(1.0);
    ContactSize<Real> size;
    // the root and the two divisions are independent of each other
    const Real square = fma(o.normal_x, o.normal_x, o.normal_y * o.normal_y);
    size.pressed = (o.area > Real(detail::least_area)) & (square > Real(detail::least_chord * detail::least_chord));
    size.area = select(size.pressed, o.area, zero);
    size.per_area = one / select(size.pressed, o.area, one);
    size.chord = sqrt_of(square);
    size.per_chord = size.chord * (one / select(size.pressed, square, one));
    return size;
}

/// Where two blocks touch, in the base's frame, and how their faces move there.
template <class Real>
struct Touch {
    Real area, chord;        ///< area 0 where the blocks do not touch [m2], [m]
    Real normal_x, normal_y; ///< unit normal
    Real arm_x, arm_y;       ///< centroid from the lower block's centre [m]
    Real closing, sliding;   ///< of the faces against each other in the last step [m]; 0 where they do not touch
};

/// @param arm_x, arm_y centroid from the lower block's centre, in its frame [m]
/// @param lower_sine, lower_versine of the lower block's rotation
/// @param apart_x, apart_y upper centre - lower centre, frame of the base [m]
/// @param lower, upper motion of the blocks' centres in the last step
/// @param t written in place: as a value that is copied to where it stays, it took the processor's step a sixth longer
template <class Real>
STYLOBATE_INLINE void touch(const ContactSize<Real>& size, const Overlap<Real>& o, Real arm_x, Real arm_y,
                            Real lower_sine, Real lower_versine, Real apart_x, Real apart_y, const Planar<Real>& lower,
                            const Planar<Real>& upper, Touch<Real>& t)
{
    const Real zero(0.0), one(1.0);
    const Real normal_x = o.normal_x * size.per_chord, normal_y = o.normal_y * size.per_chord;
    const Real sine = lower_sine, cosine = one - lower_versine;
    const Real nx = fms(normal_x, cosine, normal_y * sine);
    const Real ny = fma(normal_x, sine, normal_y * cosine);
    const Real lx = fms(arm_x, cosine, arm_y * sine);
    const Real ly = fma(arm_x, sine, arm_y * cosine);
    const Real ux = lx - apart_x;
    const Real uy = ly - apart_y;
    const Real vx = fma(lower.theta, ly, fnma(upper.theta, uy, upper.x - lower.x));
    const Real vy = fnma(lower.theta, lx, fma(upper.theta, ux, upper.y - lower.y));
    t.area = size.area;
    t.chord = size.chord;
    t.normal_x = nx;
    t.normal_y = ny;
    t.arm_x = lx;
    t.arm_y = ly;
    // blocks that do not touch neither close nor slide
    t.closing = select(size.pressed, fnma(vx, nx, zero - vy * ny), zero);
    t.sliding = select(size.pressed, fms(vx, ny, vy * nx), zero);
}

/// What a contact does to its two blocks: force on the upper one, the opposite on the lower one [N], and the moments
/// about their centres [Nm], of which the lower block gets the negative one.
template <class Real>
struct BedLoad {
    Real x, y;
    Real upper_moment, lower_moment;
};

/// @param apart_x, apart_y as of `touch`
template <class Real>
STYLOBATE_INLINE BedLoad<Real> bed_load(const ContactForce<Real>& f, const Touch<Real>& t, Real apart_x, Real apart_y)
{
    BedLoad<Real> load;
    load.x = fms(f.normal, t.normal_x, f.tangential * t.normal_y);
    load.y = fma(f.normal, t.normal_y, f.tangential * t.normal_x);
    const Real upper_arm_x = t.arm_x - apart_x, upper_arm_y = t.arm_y - apart_y;
    load.upper_moment = fms(upper_arm_x, load.y, upper_arm_y * load.x);
    load.lower_moment = fms(t.arm_x, load.y, t.arm_y * load.x);
    return load;
}

/// Motion in the next step, by Eqs. 4 to 6: d += dt2 F / m.
/// @param force on the block [N], [Nm];  @param motion in this step [m], [rad]
/// @param push, gravity_dy dt2 x the acceleration of gravity against the base's [m]
template <class Real>
STYLOBATE_INLINE Planar<Real> next_motion(const Planar<Real>& force, const Planar<Real>& motion, Real dt2_per_mass,
                                          Real dt2_per_inertia, Real push, Real gravity_dy)
{
    return {fma(dt2_per_mass, force.x, motion.x + push), fma(dt2_per_mass, force.y, motion.y + gravity_dy),
            fma(dt2_per_inertia, force.theta, motion.theta)};
}

} // namespace stylobate
