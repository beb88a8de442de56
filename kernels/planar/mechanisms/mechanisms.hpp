#pragma once
/// How the mechanisms act together: the overlap of a bed, its force, its dowel, and the other forces on a block.
///
/// Expensive mechanisms are skipped where they are neutral in all realizations of the register: at its neutral value
/// each gives the same bits, so a neighbour's mechanism changes nothing.

#include "kernels/planar/contact.hpp"
#include "kernels/planar/mechanism.hpp"
#include "kernels/planar/mechanisms/adhesion.hpp"
#include "kernels/planar/mechanisms/corner_loss.hpp"
#include "kernels/planar/mechanisms/corner_wear.hpp"
#include "kernels/planar/mechanisms/dowel.hpp"
#include "kernels/planar/mechanisms/drag.hpp"
#include "kernels/planar/mechanisms/eccentricity.hpp"
#include "kernels/planar/mechanisms/face_damping.hpp"
#include "kernels/planar/mechanisms/friction_wear.hpp"
#include "kernels/planar/mechanisms/hertz.hpp"
#include "kernels/planar/mechanisms/points.hpp"
#include "kernels/planar/mechanisms/rate_damping.hpp"
#include "kernels/planar/mechanisms/rod.hpp"
#include "kernels/planar/mechanisms/strengthening.hpp"
#include "kernels/planar/mechanisms/stribeck.hpp"
#include "kernels/planar/mechanisms/table_pitch.hpp"
#include "kernels/planar/mechanisms/tie.hpp"
#include "kernels/planar/mechanisms/two_corner.hpp"
#include "kernels/planar/mechanisms/vertical_motion.hpp"
#include "kernels/planar/mechanisms/wedge.hpp"
#include "kernels/planar/rows.hpp"

namespace stylobate {

/// The faces of a bed as the mechanisms left them.
template <class Real>
struct BedFaces {
    PairSizes<Real> sizes;
    Real depth_limit;
    FaceLoss<Real> loss;
    Real wedge_sine, wedge_versine;
    Real per_root_depth; ///< of the form `points`
};

/// Overlap of a bed in the lower block's frame; `points` are in the frame of what is left of its face.
/// @param general does the same for any position, in the lanes where the form does not hold:
///        general(place, sizes, fits, overlap, points)
template <ContactForm form, class Real, int count, class Mask, class General>
STYLOBATE_INLINE Overlap<Real> bed_overlap(const Placement<Real>& place, const BedFaces<Real>& faces, Mask fits,
                                           FormPoints<Real, count>& points, const General& general)
{
    const Placement<Real> turned = onto_wedge(place, faces.wedge_sine, faces.wedge_versine);
    const ChippedPair<Real> pair =
        chipped_pair(turned, faces.sizes.lower_half_width, faces.sizes.upper_half_width, faces.loss);
    Overlap<Real> o;
    if constexpr (form == ContactForm::two_corner)
        o = two_corner_overlap(pair.place, pair.lower_half_width, pair.upper_half_width, faces.depth_limit, points,
                               fits);
    else if constexpr (form == ContactForm::points)
        o = points_overlap(pair.place, pair.lower_half_width, pair.upper_half_width, faces.depth_limit,
                           faces.per_root_depth, points, fits);
    else
        o = stacked_overlap(pair.place, pair.lower_half_width, pair.upper_half_width, faces.depth_limit, fits);
    if (any(!fits)) [[unlikely]]
        general(pair.place,
                PairSizes<Real>{pair.lower_half_width, faces.sizes.lower_half_height, pair.upper_half_width,
                                faces.sizes.upper_half_height},
                fits, o, points);
    o.moment_x = fma(pair.shift, o.area, o.moment_x);
    off_wedge(o, faces.wedge_sine, faces.wedge_versine);
    return o;
}

/// The general overlap in the lanes where a form does not hold; its points are then the ends of the chord.
template <class Real, int count, class Mask>
STYLOBATE_INLINE void take_general(const Placement<Real>& place, const PairSizes<Real>& sizes, Mask fits,
                                   Overlap<Real>& o, FormPoints<Real, count>& points)
{
    const Overlap<Real> g = general_overlap(place, sizes);
    o = select(fits, o, g);
    if constexpr (count > 0) {
        const Real zero(0.0), area = max_of(g.area, Real(1e-300));
        const Real length = sqrt_of(fma(g.normal_x, g.normal_x, g.normal_y * g.normal_y));
        const Real right = lever_share(area, length, place.sine), middle = g.moment_x / area;
        for (int i = 0; i < count; ++i) {
            const bool end = i == 0 || i + 1 == count;
            const Real share = end ? (i == 0 ? Real(1.0) - right : right) : zero;
            const Real arm = end ? (i == 0 ? zero - right * length : (Real(1.0) - right) * length) : zero;
            points.x[i] = select(fits, points.x[i], middle + arm);
            points.area[i] = select(fits, points.area[i], share * area);
            points.weight[i] = select(fits, points.weight[i], end ? Real(0.5) : zero);
        }
        points.moment = select(fits, points.moment, g.moment_x);
    }
}

/// The motion of the faces of a bed in this step.
template <class Real>
struct BedMotion {
    Real area, chord;
    Real closing, sliding; ///< at the centroid [m]
    Real turning;          ///< upper rotation - lower rotation [rad]
    Real sine;             ///< of the relative rotation
    Real cosine;
};

template <class Real>
struct BedForce {
    ContactForce<Real> contact;
    Real couple; ///< on the upper block [N m]
    Real mu;     ///< in this step
};

/// Normal force of a form with points of its own.
/// @param points shares and arms of the form's springs, in `FormPoints::area` and `x`
/// @param bed elastic force and what is left of the dashpot at the centroid [N]
template <class Real, int count, class Mask>
STYLOBATE_INLINE FaceForce<Real> form_force(const FormPoints<Real, count>& points, Real dashpot, Mask pressed, Real bed,
                                            Real closing, Real turning)
{
    FacePoints<Real, count> face;
    for (int i = 0; i < count; ++i) {
        face.share[i] = points.area[i];
        face.arm[i] = points.x[i];
        face.dashpot[i] = select(pressed, points.weight[i] * dashpot, Real(0.0));
    }
    return face_force(face, bed, closing, turning);
}

/// The contact law of a bed of such a form without mechanisms. Arguments as those of `contact_force` and `form_force`.
/// @param couple on the upper block [N m]
template <class Real, int count>
STYLOBATE_INLINE ContactForce<Real> points_force(Real dashpot, const JointLaw<Real>& law, Real area, Real chord,
                                                 Real closing, Real sliding, Real turning, Real spring,
                                                 const FormPoints<Real, count>& points, Real& couple)
{
    const auto pressed = area > Real(0.0);
    const Real bed = fma(fma(law.C_n_chord, chord, law.C_n_per_dt), closing, law.K_n * area);
    const FaceForce<Real> normal = form_force(points, dashpot, pressed, bed, closing, turning);
    couple = normal.couple;
    ContactForce<Real> contact =
        friction_force(law, select(pressed, law.mu * normal.normal, Real(0.0)), chord, sliding, spring);
    contact.normal = normal.normal;
    return contact;
}

/// The contact law of a bed with its mechanisms.
/// @param points shares and arms of the form's springs, in `FormPoints::area` and `x`
template <class Real, class Layout, int count>
STYLOBATE_INLINE BedForce<Real> bed_force(const Rows<Real, Layout>& rows, int joint, const JointLaw<Real>& law,
                                          Real spring, const BedMotion<Real>& m, const FormPoints<Real, count>& points)
{
    using J = OfJointMechanisms;
    const Real zero(0.0), one(1.0);
    const auto pressed = m.area > zero;

    // normal
    Real elastic = law.K_n * m.area;
    const Real exponent = rows.get(J::exponent, joint);
    if (any(exponent != zero))
        elastic = elastic * hertz_factor(exponent, rows.get(J::per_reference, joint), m.area);
    const Real C_n =
        rate_coefficient(rows.get(J::rate_per_dt, joint), elastic, fma(law.C_n_chord, m.chord, law.C_n_per_dt));
    const Real bed = fma(C_n, m.closing, elastic);
    Real F_n = max_of(bed, zero), couple = zero;
    const Real dashpot = rows.get(J::face_dashpot, joint);
    if constexpr (count > 0) {
        const FaceForce<Real> f = form_force(points, dashpot, pressed, bed, m.closing, m.turning);
        F_n = f.normal;
        couple = f.couple;
    } else if (any(dashpot != zero)) {
        const Real wedge =
            fnma(m.cosine, rows.get(J::wedge_sine, joint), m.sine * (one - rows.get(J::wedge_versine, joint)));
        const Real right = lever_share(select(pressed, m.area, one), m.chord, wedge);
        const Real c = select(pressed, Real(0.5) * dashpot * m.chord, zero);
        const FacePoints<Real, 2> face{{one - right, right}, {zero - right * m.chord, (one - right) * m.chord}, {c, c}};
        const FaceForce<Real> f = face_force(face, bed, m.closing, m.turning);
        F_n = select(dashpot > zero, f.normal, F_n);
        couple = select((dashpot > zero) & pressed, f.couple, zero);
    }

    // friction
    Real mu = law.mu;
    const Real drop = rows.get(J::friction_drop, joint);
    if (any(drop != zero))
        mu = mu * stribeck_factor(drop, rows.get(J::per_stribeck_step, joint), m.sliding);
    mu = mu * wear_factor(rows.get(J::wear, joint), rows.get(J::slip, joint));
    const Real broken = rows.get(J::broken, joint);
    const Real limit = adhesion_limit(mu * F_n, rows.get(J::adhesion, joint), m.chord, broken);
    ContactForce<Real> contact = friction_force(law, select(pressed, limit, zero), m.chord, m.sliding, spring);
    contact.normal = F_n;
    if (rows.strengthened()) { // the bond carries the shear until it breaks
        const auto bonded = rows.get(OfJointStrengthening::bond, joint) != zero;
        contact.tangential = select(bonded, zero, contact.tangential);
        contact.spring = select(bonded, zero, contact.spring);
        contact.excess = select(bonded, zero, contact.excess);
    }
    rows.put(J::broken, joint, adhesion_broken(broken, pressed, contact.excess));
    return {contact, couple, mu};
}

/// The dowel of a bed: adds to the sums of forces of its two blocks.
/// @param place of the upper block's bottom face, from the lower one;  @param apart_x, apart_y from the lower centre of
///        mass to the upper one, frame of the base
/// @return 2 x the work of this step against it [J]
template <class Real, class Layout>
STYLOBATE_INLINE Real add_dowel(const Rows<Real, Layout>& rows, int joint, int lower, int upper,
                                const Placement<Real>& place, Real apart_x, Real apart_y)
{
    using J = OfJointMechanisms;
    const Real stiffness = rows.get(J::dowel_stiffness, joint);
    if (!any(stiffness != Real(0.0)))
        return Real(0.0);
    const Real offset = place.x - rows.get(OfJoint::reference_x, joint);
    const DowelForce<Real> f =
        dowel_force(stiffness, rows.get(J::per_dowel_stiffness, joint), rows.get(J::dowel_yield, joint),
                    rows.get(J::dowel_gap, joint), offset, rows.get(J::dowel_set, joint));
    const auto in = place.depth + Real(dowel_reach) * rows.get(OfJoint::depth_limit, joint) > Real(0.0);
    const Real force = select(in, f.force, Real(0.0));
    const Real work = (force + rows.get(J::dowel_force, joint)) * (offset - rows.get(J::dowel_at, joint));
    rows.put(J::dowel_set, joint, select(in, f.set, rows.get(J::dowel_set, joint)));
    rows.put(J::dowel_force, joint, force);
    rows.put(J::dowel_at, joint, offset);

    const Real sine = rows.get(OfBlock::sine, lower), cosine = Real(1.0) - rows.get(OfBlock::versine, lower);
    const Real arm_x = place.x - rows.get(OfBlockMechanisms::eccentricity, lower);
    const Real arm_y = rows.get(OfBlock::half_height, lower) - place.depth;
    const Real lx = fms(arm_x, cosine, arm_y * sine), ly = fma(arm_x, sine, arm_y * cosine);
    const Real ux = lx - apart_x, uy = ly - apart_y;
    const Real fx = force * cosine, fy = force * sine; // on the lower block
    rows.put(OfBlock::force_x, lower, rows.get(OfBlock::force_x, lower) + fx);
    rows.put(OfBlock::force_y, lower, rows.get(OfBlock::force_y, lower) + fy);
    rows.put(OfBlock::moment, lower, rows.get(OfBlock::moment, lower) + fms(lx, fy, ly * fx));
    rows.put(OfBlock::force_x, upper, rows.get(OfBlock::force_x, upper) - fx);
    rows.put(OfBlock::force_y, upper, rows.get(OfBlock::force_y, upper) - fy);
    rows.put(OfBlock::moment, upper, rows.get(OfBlock::moment, upper) - fms(ux, fy, uy * fx));
    return work;
}

/// What follows the contact force of a bed: its dowel, what strengthens it, and the wear by slip and
/// rocking.
/// @param s intermediate values of the bed (`JointScratch`);  @param turning as in `BedMotion`
/// @return 2 x the energy that these dissipated or stored [J]
/// @tparam Mechanism the stepper's
template <class Mechanism, class Real, class Layout, class Scratch>
STYLOBATE_INLINE Real after_force(const Rows<Real, Layout>& rows, TopologyJoint blocks, int joint, const Scratch& s,
                                  const ContactForce<Real>& f, Real turning)
{
    using J = OfJointMechanisms;
    Real energy = add_dowel(rows, joint, blocks.lower, blocks.upper, s.place, s.apart_x, s.apart_y);
    if (rows.strengthened())
        energy = energy + Strengthening<Real, Mechanism, Layout>::bed(rows, blocks, joint, s.place, s.apart_x,
                                                                      s.apart_y, f.normal, turning);
    rows.put(J::slip, joint, fma(f.excess, rows.get(OfJoint::per_K_t, joint), rows.get(J::slip, joint)));
    const Real wear = rows.get(J::corner_wear, joint);
    if (any(wear != Real(0.0))) {
        const Real path = abs_of(turning);
        rows.put(J::turned, joint, rows.get(J::turned, joint) + path);
        energy =
            energy + Real(2.0) * worn_energy(rows.get(OfJoint::K_n, joint), s.area, s.chord, s.place.sine, wear * path);
    }
    return energy;
}

/// The other accelerations of the blocks in one step, times dt2.
template <class Real, class Layout>
class MechanismPull {
public:
    STYLOBATE_INLINE MechanismPull(const Rows<Real, Layout>& rows, int step)
        : rows_(rows), pitch_{rows.get(OfPitch::angle, step), rows.get(OfPitch::increment, step),
                              rows.get(OfPitch::second, step)},
          gravity_x_(rows.get(OfRealization::gravity_dx)), gravity_y_(rows.get(OfRealization::gravity_dy)),
          base_(rows.get(OfBase::second, step)), vertical_(rows.get(OfVertical::second, step)),
          base_dx_(rows.get(OfRealizationMechanisms::base_dx)), base_dy_(rows.get(OfRealizationMechanisms::base_dy)),
          base_x_(rows.get(OfRealizationMechanisms::base_x)), level_x_(gravity_x_ - base_),
          level_y_(vertical_pull(gravity_y_, vertical_)), x_(level_x_), y_(level_y_)
    {
        const Real zero(0.0);
        pitched_ = any((pitch_.angle != zero) | (pitch_.increment != zero) | (pitch_.second != zero));
        if (pitched_) {
            const Pull<Real> turned = turned_pull(pitch_, level_x_, level_y_);
            x_ = turned.x;
            y_ = turned.y;
        }
        const Real next_dx = base_dx_ + base_;
        rows.put(OfRealizationMechanisms::base_dx, next_dx);
        rows.put(OfRealizationMechanisms::base_x, base_x_ + next_dx);
        rows.put(OfRealizationMechanisms::base_dy, base_dy_ + vertical_);
    }

    /// New increments of block `i` that had dx, dy, dtheta in the last step, under the sums of its contact forces.
    STYLOBATE_INLINE void step(int i, const Planar<Real>& force, Real dx, Real dy, Real dtheta, Planar<Real>& e)
    {
        using B = OfBlockMechanisms;
        const Real mass = rows_.get(OfBlock::mass, i), inertia = rows_.get(OfBlock::inertia, i);
        Real px = x_ + rows_.get(B::nudge_x, i), py = y_ + rows_.get(B::nudge_y, i);
        Real ptheta = rows_.get(B::nudge_theta, i);
        add_rod(i, px, ptheta);
        Real lab_x = dx + base_dx_, lab_y = dy + base_dy_;
        if (pitched_) {
            const Real x = rows_.get(B::reference_x, i) + rows_.get(OfBlock::x, i);
            const Real y = rows_.get(B::reference_y, i) + rows_.get(OfBlock::y, i);
            const Pull<Real> turning = turning_pull(pitch_, x, y, dx, dy);
            px = px + turning.x;
            py = py + turning.y;
            ptheta = ptheta - pitch_.second;
            lab_x = fnma(pitch_.increment, y, lab_x);
            lab_y = fma(pitch_.increment, x, lab_y);
        }
        Real slow_x(0.0), slow_y(0.0), slow_theta(0.0);
        const Real drag = rows_.get(B::drag_per_mass, i), linear = rows_.get(B::drag_linear, i);
        const bool dragged = any((drag != Real(0.0)) | (linear != Real(0.0)));
        if (dragged) {
            const Real factor = drag_factor(drag, linear, lab_x, lab_y);
            slow_x = factor * lab_x;
            slow_y = factor * lab_y;
        }
        const Real spring = rows_.get(B::tie_spring, i), dashpot = rows_.get(B::tie_dashpot, i);
        const Real pull = rows_.get(B::tie_pull, i), turning = rows_.get(B::tie_turning, i);
        const Real none(0.0);
        const bool tied = any((spring != none) | (dashpot != none) | (pull != none) | (turning != none));
        if (tied) {
            slow_x = tie_resistance(spring, dashpot, pull, rows_.get(OfBlock::x, i), dx, slow_x);
            slow_theta = turning * dtheta;
        }
        e.x = fma(rows_.get(OfBlock::dt2_per_mass, i), force.x, (dx + px) - slow_x);
        e.y = fma(rows_.get(OfBlock::dt2_per_mass, i), force.y, (dy + py) - slow_y);
        e.theta = fma(rows_.get(OfBlock::dt2_per_inertia, i), force.theta, (dtheta + ptheta) - slow_theta);
        if (dragged || tied)
            drag_energy_ = fma(mass, fma(slow_x, dx + e.x, slow_y * (dy + e.y)), drag_energy_);
        if (tied)
            drag_energy_ = fma(inertia * slow_theta, dtheta + e.theta, drag_energy_);
        // beyond what the baseline's balance has: gravity and the base in the frame at rest
        drive_energy_ = fma(mass, fma(px - level_x_, dx + e.x, (py - gravity_y_) * (dy + e.y)),
                            fma(inertia * ptheta, dtheta + e.theta, drive_energy_));
    }

    /// 2 dt2 x the work of the step's nudging on all blocks.
    STYLOBATE_INLINE Real drive_energy() const { return drive_energy_; }
    STYLOBATE_INLINE void end() const
    {
        rows_.put(OfRealizationMechanisms::drag_energy, rows_.get(OfRealizationMechanisms::drag_energy) + drag_energy_);
    }

private:
    /// The rod of a block, as dt2 x its accelerations; its end goes on.
    STYLOBATE_INLINE void add_rod(int i, Real& px, Real& ptheta) const
    {
        using B = OfBlockMechanisms;
        const Real none(0.0), right = rows_.get(B::rod_right, i), left = rows_.get(B::rod_left, i);
        const auto held = (right != none) | (left != none);
        if (!any(held))
            return;
        const Real e = rows_.get(B::eccentricity, i), arm = rows_.get(B::rod_arm, i), path = rows_.get(B::rod_path, i);
        const Real sine = rows_.get(OfBlock::sine, i), versine = rows_.get(OfBlock::versine, i);
        const Real centre = centre_from_mass_x(rows_.get(OfBlock::x, i), e, versine);
        const Real end =
            rod_end(path, rows_.get(B::rod_least, i), rows_.get(B::rod_most, i), rows_.get(B::rod_share, i), base_x_);
        const Real force = rod_force(right, left, end - (rod_point(centre, arm, sine) - rows_.get(B::rod_zero, i)));
        const Real up = fms(arm, Real(1.0) - versine, e * sine); // of the point above the centre of mass
        px = select(held, fma(rows_.get(OfBlock::dt2_per_mass, i), force, px), px);
        ptheta = select(held, fnma(rows_.get(OfBlock::dt2_per_inertia, i), up * force, ptheta), ptheta);
        rows_.put(B::rod_path, i, path + rows_.get(B::rod_step, i));
    }

    const Rows<Real, Layout>& rows_;
    const Pitch<Real> pitch_;
    const Real gravity_x_, gravity_y_, base_, vertical_, base_dx_, base_dy_, base_x_;
    const Real level_x_, level_y_; ///< gravity and the base's acceleration, in the level frame
    Real x_, y_;                   ///< the same in the base's
    bool pitched_ = false;
    Real drag_energy_{0.0}, drive_energy_{0.0};
};

} // namespace stylobate
