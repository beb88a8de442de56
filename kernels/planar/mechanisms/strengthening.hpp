#pragma once
/// How what strengthens a structure acts on it: at the beds `bearing`, `mortar` and `pull_out`, at the blocks `tendon`
/// and `clamp`. All of it adds to the sums of forces of its blocks, beside the contacts.
///
/// It is put in when the structure is at rest: offsets, elongations and openings count from there. Each is skipped
/// where it is neutral in all realizations of the register. Works are summed with `joint_energy`, and `held` is what is
/// stored.

#include "kernels/planar/mechanisms/bearing.hpp"
#include "kernels/planar/mechanisms/clamp.hpp"
#include "kernels/planar/mechanisms/dowel.hpp"
#include "kernels/planar/mechanisms/mortar.hpp"
#include "kernels/planar/mechanisms/pull_out.hpp"
#include "kernels/planar/mechanisms/tendon.hpp"
#include "kernels/planar/mechanisms/wedge.hpp"
#include "kernels/planar/rows.hpp"

namespace stylobate {

/// Forces of a bed on its upper block, at the middle of that block's bottom face, in the frame of the lower block, and
/// what they do.
template <class Real>
struct BedHold {
    Real along{0.0};  ///< against the offset [N]
    Real normal{0.0}; ///< towards the lower block [N]
    Real couple{0.0}; ///< of the normal forces about the middle, over the cosine of the relative rotation [N m]
    Real work{0.0};   ///< 2 x the work of this step against them [J]
    Real held{0.0};   ///< energy stored [J]
};

/// @param normal of the contact [N]
template <class Real, class Layout>
STYLOBATE_INLINE void hold_bearing(const Rows<Real, Layout>& rows, int joint, const Placement<Real>& place, Real normal,
                                   BedHold<Real>& hold)
{
    using R = OfJointStrengthening;
    const Real zero(0.0);
    const Real stiffness = rows.get(R::bearing_stiffness, joint), dashpot = rows.get(R::bearing_dashpot, joint);
    const Real per_radius = rows.get(R::bearing_per_radius, joint);
    if (!any((stiffness != zero) | (dashpot != zero) | (per_radius != zero)))
        return;
    const Real offset = (place.x - rows.get(OfJoint::reference_x, joint)) - rows.get(R::rest_offset, joint);
    const Real change = offset - rows.get(R::bearing_at, joint);
    const auto in = place.depth + Real(dowel_reach) * rows.get(OfJoint::depth_limit, joint) > zero;
    const Real force = select(in, bearing_force(stiffness, dashpot, per_radius, normal, offset, change), zero);
    hold.along = hold.along + force;
    hold.work = fma(force + rows.get(R::bearing_force, joint), change, hold.work);
    hold.held = hold.held + select(in, Real(0.5) * offset * offset * fma(normal, per_radius, stiffness), zero);
    rows.put(R::bearing_at, joint, offset);
    rows.put(R::bearing_force, joint, force);
}

/// The bond of a bed; where it breaks, its shear goes over to the friction.
/// @param turning of the upper block against the lower one in this step [rad]
template <class Real, class Layout>
STYLOBATE_INLINE void hold_bond(const Rows<Real, Layout>& rows, TopologyJoint blocks, int joint,
                                const Placement<Real>& place, Real normal, Real turning, BedHold<Real>& hold)
{
    using R = OfJointStrengthening;
    using J = OfJointMechanisms;
    const Real zero(0.0), bond = rows.get(R::bond, joint);
    if (!any(bond != zero))
        return;
    const Placement<Real> p = onto_wedge(place, rows.get(J::wedge_sine, joint), rows.get(J::wedge_versine, joint));
    const Real bl = rows.get(OfBlock::half_width, blocks.lower), bu = rows.get(OfBlock::half_width, blocks.upper);
    const Real left = max_of((zero - bl) - p.x, zero - bu) + rows.get(J::chip_left, joint);
    const Real right = min_of(bl - p.x, bu) - rows.get(J::chip_right, joint);
    const Real opening = zero - p.depth;
    const BondPull<Real> pull = bond_pull(left, right, fma(left, p.sine, opening), fma(right, p.sine, opening));
    const Real K_n = rows.get(OfJoint::K_n, joint), length = right - left;
    Real tension = K_n * pull.force, couple = K_n * pull.couple;

    const Real offset = (place.x - rows.get(OfJoint::reference_x, joint)) - rows.get(R::rest_offset, joint);
    const Real sliding = offset - rows.get(R::bond_offset, joint);
    const Real spring = fma(rows.get(OfJoint::K_t, joint), sliding, rows.get(R::bond_spring, joint));
    const Real C_t = fma(rows.get(OfJoint::C_t_chord, joint), length, rows.get(OfJoint::C_t_per_dt, joint));
    Real shear = fma(C_t, sliding, spring);
    const Real limit =
        fma(rows.get(R::bond_cohesion, joint), length, rows.get(OfJoint::mu, joint) * max_of(normal - tension, zero));

    const auto bonded = bond != zero;
    const auto breaks = bonded & ((K_n * pull.most > rows.get(R::bond_tension, joint)) | (abs_of(shear) > limit));
    const Real whole = select(breaks, zero, bond);
    const auto holds = whole != zero;
    tension = select(holds, tension, zero);
    couple = select(holds, couple, zero);
    shear = select(holds, shear, zero);
    Real work = (tension + rows.get(R::bond_pull, joint)) * (opening - rows.get(R::bond_opening, joint));
    work = fma(couple + rows.get(R::bond_couple, joint), turning, work);
    work = fma(shear + rows.get(R::bond_shear, joint), sliding, work);
    hold.along = hold.along + shear;
    hold.normal = hold.normal + tension;
    hold.couple = hold.couple + couple;
    hold.work = hold.work + select(bonded, work, zero);
    const Real sheared = Real(0.5) * spring * spring * rows.get(OfJoint::per_K_t, joint);
    hold.held = hold.held + select(holds, fma(K_n, pull.energy, sheared), zero);

    rows.put(OfJoint::spring, joint, select(breaks, spring, rows.get(OfJoint::spring, joint)));
    rows.put(R::bond, joint, whole);
    rows.put(R::bond_spring, joint, select(holds, spring, zero));
    rows.put(R::bond_offset, joint, offset);
    rows.put(R::bond_opening, joint, opening);
    rows.put(R::bond_pull, joint, tension);
    rows.put(R::bond_couple, joint, couple);
    rows.put(R::bond_shear, joint, shear);
}

/// The two dowels against the opening of a bed.
template <class Real, class Layout>
STYLOBATE_INLINE void hold_dowels(const Rows<Real, Layout>& rows, int joint, const Placement<Real>& place,
                                  BedHold<Real>& hold)
{
    using R = OfJointStrengthening;
    const Real zero(0.0), limit = rows.get(R::hold_limit, joint);
    if (!any(limit != zero))
        return;
    const Real stiffness = rows.get(R::hold_stiffness, joint), per = rows.get(R::per_hold_stiffness, joint);
    const Real length = rows.get(R::hold_length, joint), spread = rows.get(R::hold_spread, joint);
    const auto one = [&](Real arm, R::Field set, R::Field at, R::Field force, R::Field out) {
        const Real opening = max_of(fms(arm, place.sine, place.depth), zero);
        const HoldForce<Real> f =
            hold_force(limit, stiffness, per, length, opening, rows.get(set, joint), rows.get(out, joint));
        hold.normal = hold.normal + f.force;
        hold.couple = fma(f.force, arm, hold.couple);
        hold.work = fma(f.force + rows.get(force, joint), opening - rows.get(at, joint), hold.work);
        hold.held = fma(Real(0.5) * f.force * f.force, per, hold.held);
        rows.put(set, joint, f.set);
        rows.put(at, joint, opening);
        rows.put(force, joint, f.force);
        rows.put(out, joint, f.out);
    };
    one(zero - spread, R::left_set, R::left_at, R::left_force, R::left_out);
    one(spread, R::right_set, R::right_at, R::right_force, R::right_out);
}

/// What a bed has beside its contact and its dowel: adds to the sums of forces of its two blocks.
/// @param place of the upper block's bottom face, from the lower one;  @param apart_x, apart_y from the lower centre of
///        mass to the upper one, frame of the base;  @param normal of the contact [N]
/// @return 2 x the work of this step against it [J]
template <class Real, class Layout>
STYLOBATE_INLINE Real add_bed_strengthening(const Rows<Real, Layout>& rows, TopologyJoint blocks, int joint,
                                            const Placement<Real>& place, Real apart_x, Real apart_y, Real normal,
                                            Real turning)
{
    BedHold<Real> hold;
    hold_bearing(rows, joint, place, normal, hold);
    hold_bond(rows, blocks, joint, place, normal, turning, hold);
    hold_dowels(rows, joint, place, hold);
    rows.put(OfJointStrengthening::held, joint, hold.held);

    const auto [lower, upper] = blocks;
    const Real sine = rows.get(OfBlock::sine, lower), cosine = Real(1.0) - rows.get(OfBlock::versine, lower);
    const Real arm_x = place.x - rows.get(OfBlockMechanisms::eccentricity, lower);
    const Real arm_y = rows.get(OfBlock::half_height, lower) - place.depth;
    const Real lx = fms(arm_x, cosine, arm_y * sine), ly = fma(arm_x, sine, arm_y * cosine);
    const Real ux = lx - apart_x, uy = ly - apart_y;
    const Real couple = hold.couple * place.cosine;
    const Real fx = fms(hold.along, cosine, hold.normal * sine); // on the lower block
    const Real fy = fma(hold.along, sine, hold.normal * cosine);
    rows.put(OfBlock::force_x, lower, rows.get(OfBlock::force_x, lower) + fx);
    rows.put(OfBlock::force_y, lower, rows.get(OfBlock::force_y, lower) + fy);
    rows.put(OfBlock::moment, lower, rows.get(OfBlock::moment, lower) + (fms(lx, fy, ly * fx) + couple));
    rows.put(OfBlock::force_x, upper, rows.get(OfBlock::force_x, upper) - fx);
    rows.put(OfBlock::force_y, upper, rows.get(OfBlock::force_y, upper) - fy);
    rows.put(OfBlock::moment, upper, rows.get(OfBlock::moment, upper) - (fms(ux, fy, uy * fx) + couple));
    return hold.work;
}

/// The tendon of a block.
/// @param work 2 x the work of this step against it, added [J]
/// @return energy stored [J]
template <class Real, class Layout>
STYLOBATE_INLINE Real add_tendon(const Rows<Real, Layout>& rows, int i, Real& work)
{
    using R = OfBlockStrengthening;
    const Real zero(0.0), one(1.0), stiffness = rows.get(R::tendon_stiffness, i);
    if (!any(stiffness != zero))
        return zero;
    const Real sine = rows.get(OfBlock::sine, i), versine = rows.get(OfBlock::versine, i);
    const Real e = rows.get(OfBlockMechanisms::eccentricity, i), h = rows.get(OfBlock::half_height, i);
    // the upper anchor: its displacement, and where it is from the centre of mass
    const Real moved_x = rows.get(OfBlock::x, i) + fms(e, versine, h * sine);
    const Real moved_y = rows.get(OfBlock::y, i) - fma(e, sine, h * versine);
    const Real arm_x = fms(e, versine, h * sine) - e, arm_y = h - fma(e, sine, h * versine);
    const Real x = rows.get(R::tendon_x, i) + moved_x, y = rows.get(R::tendon_y, i) + moved_y;
    const Real length = sqrt_of(fma(x, x, y * y));
    const Real elongation = length - rows.get(R::tendon_length, i);
    const TendonForce<Real> f = tendon_force(stiffness, rows.get(R::tendon_stretch, i), rows.get(R::tendon_yield, i),
                                             elongation, rows.get(R::tendon_set, i));
    const Real part = f.tension / select(length > zero, length, one);
    const Real fx = zero - part * x, fy = zero - part * y;
    rows.put(OfBlock::force_x, i, rows.get(OfBlock::force_x, i) + fx);
    rows.put(OfBlock::force_y, i, rows.get(OfBlock::force_y, i) + fy);
    rows.put(OfBlock::moment, i, rows.get(OfBlock::moment, i) + fms(arm_x, fy, arm_y * fx));
    work = fma(f.tension + rows.get(R::tendon_force, i), elongation - rows.get(R::tendon_at, i), work);
    rows.put(R::tendon_set, i, f.set);
    rows.put(R::tendon_at, i, elongation);
    rows.put(R::tendon_force, i, f.tension);
    return Real(0.5) * f.tension * f.tension / select(stiffness > zero, stiffness, one);
}

/// The clamps between a block and its neighbour at the right. Parameters as those of `add_tendon`.
template <class Real, class Layout>
STYLOBATE_INLINE Real add_clamp(const Rows<Real, Layout>& rows, int left, int right, Real& work)
{
    using R = OfBlockStrengthening;
    using B = OfBlockMechanisms;
    const Real zero(0.0), one(1.0), pull = rows.get(R::clamp_pull, left);
    if (!any(pull != zero))
        return zero;
    // the clamp's right end, from the right centre of mass and from the left one, frame of the base
    const Real sine = rows.get(OfBlock::sine, right), cosine = one - rows.get(OfBlock::versine, right);
    const Real qx = rows.get(R::clamp_x, left) - rows.get(B::eccentricity, right), qy = rows.get(R::clamp_y, left);
    const Real rx = fms(qx, cosine, qy * sine), ry = fma(qx, sine, qy * cosine);
    const Real lx = (rows.get(B::reference_x, right) - rows.get(B::reference_x, left)) +
                    (rows.get(OfBlock::x, right) - rows.get(OfBlock::x, left)) + rx;
    const Real ly = (rows.get(B::reference_y, right) - rows.get(B::reference_y, left)) +
                    (rows.get(OfBlock::y, right) - rows.get(OfBlock::y, left)) + ry;
    const Real tx = one - rows.get(OfBlock::versine, left), ty = rows.get(OfBlock::sine, left);
    const Real elongation = fma(lx, tx, ly * ty) - rows.get(R::clamp_length, left);
    const ClampForce<Real> f = clamp_force(pull, rows.get(R::clamp_push, left), rows.get(R::clamp_strength, left),
                                           rows.get(R::clamp_gap, left), rows.get(R::clamp_break, left), elongation,
                                           rows.get(R::clamp_set, left), rows.get(R::clamp_broken, left));
    const Real fx = f.force * tx, fy = f.force * ty; // on the left block
    rows.put(OfBlock::force_x, left, rows.get(OfBlock::force_x, left) + fx);
    rows.put(OfBlock::force_y, left, rows.get(OfBlock::force_y, left) + fy);
    rows.put(OfBlock::moment, left, rows.get(OfBlock::moment, left) + fms(lx, fy, ly * fx));
    rows.put(OfBlock::force_x, right, rows.get(OfBlock::force_x, right) - fx);
    rows.put(OfBlock::force_y, right, rows.get(OfBlock::force_y, right) - fy);
    rows.put(OfBlock::moment, right, rows.get(OfBlock::moment, right) - fms(rx, fy, ry * fx));
    work = fma(f.force + rows.get(R::clamp_force, left), elongation - rows.get(R::clamp_at, left), work);
    rows.put(R::clamp_set, left, f.set);
    rows.put(R::clamp_at, left, elongation);
    rows.put(R::clamp_force, left, f.force);
    rows.put(R::clamp_broken, left, f.broken);
    return f.held;
}

/// Tendons and clamps of all blocks: adds to the sums of forces of the blocks, before these are stepped.
template <class Real, class Layout>
STYLOBATE_INLINE void add_block_strengthening(const Rows<Real, Layout>& rows, const Topology& topology)
{
    Real work = rows.get(OfRealizationMechanisms::joint_energy);
    for (int i = 0; i < topology.blocks; ++i) {
        Real held(0.0);
        if (i >= topology.fixed)
            held = add_tendon(rows, i, work);
        const int right = topology.clamped_to(i);
        if (right >= 0)
            held = held + add_clamp(rows, i, right, work);
        rows.put(OfBlockStrengthening::held, i, held);
    }
    rows.put(OfRealizationMechanisms::joint_energy, work);
}

/// The two calls of a step. They are not inlined, so as not to slow down a step that has no strengthening, and get a
/// copy of the rows for the reason that `step.hpp` gives.
/// @tparam Mechanism the stepper's, which makes them functions of its file alone
template <class Real, class Mechanism, class Layout>
struct Strengthening {
    STYLOBATE_APART static Real bed(Rows<Real, Layout> rows, TopologyJoint blocks, int joint,
                                    const Placement<Real>& place, Real apart_x, Real apart_y, Real normal, Real turning)
    {
        return add_bed_strengthening(rows, blocks, joint, place, apart_x, apart_y, normal, turning);
    }
    STYLOBATE_APART static void blocks(Rows<Real, Layout> rows, Topology topology)
    {
        add_block_strengthening(rows, topology);
    }
};

template <class Mechanism, class Real, class Layout>
STYLOBATE_INLINE void strengthen_blocks(const Rows<Real, Layout>& rows, const Topology& topology)
{
    if (rows.strengthened())
        Strengthening<Real, Mechanism, Layout>::blocks(rows, topology);
}

} // namespace stylobate
