#pragma once
/// One step of all realizations of a bundle: the heart of Stylobate. `THEORY.md` goes through it symbol by symbol.
///
///   angles      sine and versine of every block's rotation
///   geometry    where each joint's upper block lies, seen from its lower one
///   overlap     area, centroid and direction of the contact (closed form; general where that does not hold)
///   faces       relative displacement of the faces in the last step, at the centroid
///   forces      Eqs. 1 to 3, the energy terms, and the sums over the blocks
///   update      Eqs. 4 to 6 as d += dt2 F / m, u += d
///
/// The phases run over all joints (in groups that fit the first-level cache) with their intermediate values in memory:
/// neighbouring joints are independent within a phase, so that the processor works on several at once, where one pass
/// from geometry to force would wait for each result in turn.
///
/// Beds go through the phases in every step. Watched pairs (`topology.hpp`) do where their bounding boxes meet; which
/// pairs come so close is looked for only when a block has strayed. Neither changes a bit of the result: a pair that
/// does not touch adds nothing, so it makes no difference whether it was worked on for a neighbour's sake.

#include "kernels/contact.hpp"
#include "kernels/mechanism.hpp"
#include "kernels/mechanisms/extended.hpp"
#include "kernels/overlap.hpp"
#include "kernels/rows.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

namespace detail {

/// Joints that go through the phases together.
inline constexpr int joint_group = 8;

/// Area and contact length below which two blocks do not touch.
inline constexpr double least_area = 1e-18;  // m2
inline constexpr double least_chord = 1e-12; // m

/// What a contact form hands on besides: nothing where it has no points of its own.
template <class Real, int count>
struct PointScratch {
    FormPoints<Real, count> points; // overlap -> forces: shares of the force, and places along the contact
};
template <class Real>
struct PointScratch<Real, 0> {
};

/// What the phases hand on, per joint.
template <class Real, int points>
struct JointScratch : PointScratch<Real, points> {
    Placement<Real> place;         // geometry -> overlap
    Real apart_x, apart_y;         // geometry -> faces: upper centre - lower centre, frame of the base
    Real area, chord;              // overlap -> forces
    Real arm_x, arm_y;             // overlap -> faces: centroid from the lower block's centre, in its frame
    Real normal_x, normal_y;       // overlap -> faces: lower block's frame; faces -> forces: frame of the base
    Real lower_arm_x, lower_arm_y; // faces -> forces: centroid from the blocks' centres, frame of the base
    Real upper_arm_x, upper_arm_y; //
    Real closing, sliding;         // faces -> forces
};

/// The two kinds of joints, as the phases tell them apart.
struct Bed {
    static constexpr bool at_rest = true;
};
struct Pair {
    static constexpr bool at_rest = false;
};

} // namespace detail

/// @tparam watching whether there are watched pairs
template <class Real, class Mechanism, bool watching>
class Stepper : Rows<Real> {
public:
    Stepper(const Topology& topology, const Bundle& bundle) : Rows<Real>(bundle), topology_(topology) {}

    /// Steps `first` to `last - 1` of the table of base motion; the energies are those of the last one.
    STYLOBATE_INLINE void run(int first, int last) const
    {
        Scratch scratch[detail::joint_group];
        const int beds = topology_.beds();
        [[maybe_unused]] int close = -1;
        for (int step = first; step < last; ++step) {
            const bool audit = step + 1 == last;
            angles();
            for (int begin = 0; begin < beds; begin += detail::joint_group)
                contacts<detail::Bed>(
                    beds - begin < detail::joint_group ? beds - begin : detail::joint_group,
                    [begin](int j) { return begin + j; }, scratch, audit);
            if constexpr (watching)
                close = pairs(close, scratch, audit);
            update(step, audit);
        }
    }

private:
    using Scratch = detail::JointScratch<Real, Mechanism::points>;

    using Rows<Real>::get;
    using Rows<Real>::put;
    using Rows<Real>::b_;

    /// Displacement of a block's geometric centre.
    STYLOBATE_INLINE Real centre_x(int i) const
    {
        if constexpr (Mechanism::extended)
            return centre_from_mass_x(get(OfBlock::x, i), get(OfBlockExtension::eccentricity, i),
                                      get(OfBlock::versine, i));
        else
            return get(OfBlock::x, i);
    }
    STYLOBATE_INLINE Real centre_y(int i) const
    {
        if constexpr (Mechanism::extended)
            return centre_from_mass_y(get(OfBlock::y, i), get(OfBlockExtension::eccentricity, i),
                                      get(OfBlock::sine, i));
        else
            return get(OfBlock::y, i);
    }

    /// From geometry to forces, for `count` joints; `joint(j)` is the j-th of them.
    template <class Kind, class JointOf>
    STYLOBATE_INLINE void contacts(int count, JointOf joint, Scratch* scratch, bool audit) const
    {
        for (int j = 0; j < count; ++j)
            geometry<Kind>(joint(j), scratch[j]);
        for (int j = 0; j < count; ++j)
            overlap<Kind>(joint(j), scratch[j], audit);
        for (int j = 0; j < count; ++j)
            faces(joint(j), scratch[j]);
        forces<Kind>(count, joint, scratch);
    }

    STYLOBATE_INLINE void angles() const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Angle<Real> a = angle(get(OfBlock::theta, i));
            put(OfBlock::sine, i, a.sine);
            put(OfBlock::versine, i, a.versine);
            put(OfBlock::force_x, i, Real(0.0));
            put(OfBlock::force_y, i, Real(0.0));
            put(OfBlock::moment, i, Real(0.0));
        }
    }

    /// Relative placement. Of a bed from relative displacements and versines: nothing large cancels.
    template <class Kind>
    STYLOBATE_INLINE void geometry(int joint, Scratch& s) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        const Real sl = get(OfBlock::sine, lower), vl = get(OfBlock::versine, lower);
        const Real su = get(OfBlock::sine, upper), vu = get(OfBlock::versine, upper);
        const Real one(1.0);
        const Real cl = one - vl, cu = one - vu;
        const Real x = get(OfJoint::reference_x, joint) + (centre_x(upper) - centre_x(lower));
        const Real rise = centre_y(upper) - centre_y(lower);
        const Real height = get(OfJoint::height, joint);
        const Real y = rise + height;
        const Real hu = get(OfBlock::half_height, upper);
        const Real versine = fnma(su, sl, fnma(vl, vu, vl + vu));
        const Real sine = fms(su, cl, cu * sl);
        s.place.sine = sine;
        s.place.cosine = one - versine;
        s.place.x = fma(x, cl, fma(y, sl, hu * sine));
        s.apart_x = x;
        s.apart_y = y;
        if constexpr (Mechanism::extended) { // from centre of mass to centre of mass
            const Real el = get(OfBlockExtension::eccentricity, lower), eu = get(OfBlockExtension::eccentricity, upper);
            s.apart_x = fma(eu, cu, fnma(el, cl, x));
            s.apart_y = fma(eu, su, fnma(el, sl, y));
        }
        if constexpr (!Kind::at_rest) {
            s.place.depth = fma(x, sl, fnma(y, cl, fma(hu, s.place.cosine, get(OfBlock::half_height, lower))));
            return;
        }
        s.place.depth = fma(x, sl, fms(height, vl, fma(hu, versine, rise * cl)));
        const Real rotation = abs_of(get(OfBlock::theta, upper) - get(OfBlock::theta, lower));
        put(OfJoint::max_rotation, joint, max_of(get(OfJoint::max_rotation, joint), rotation));
    }

    template <class Kind>
    STYLOBATE_INLINE void overlap(int joint, Scratch& s, bool audit) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        const Overlap<Real> o = meet<Kind>(joint, s);

        // one division for both: 1 / (area x chord)
        const Real zero(0.0);
        const Real chord = sqrt_of(fma(o.normal_x, o.normal_x, o.normal_y * o.normal_y));
        const auto pressed = (o.area > Real(detail::least_area)) & (chord > Real(detail::least_chord));
        s.area = select(pressed, o.area, zero);
        s.chord = chord;
        const Real inverse = Real(1.0) / select(pressed, o.area * chord, Real(1.0));
        const Real per_area = chord * inverse, per_chord = s.area * inverse;
        s.arm_x = o.moment_x * per_area;
        s.arm_y = fnma(o.moment_depth, per_area, get(OfBlock::half_height, lower));
        s.normal_x = o.normal_x * per_chord;
        s.normal_y = o.normal_y * per_chord;
        if constexpr (Mechanism::extended)
            s.arm_x = s.arm_x - get(OfBlockExtension::eccentricity, lower);
        if constexpr (Mechanism::points > 0 && Kind::at_rest) {
            const Real middle = s.points.moment * per_area;
            for (int i = 0; i < Mechanism::points; ++i) {
                s.points.x[i] = s.points.x[i] - middle;
                s.points.area[i] = s.points.area[i] * per_area;
            }
        }
        if (audit)
            put(OfJoint::elastic, joint, select(pressed, get(OfJoint::K_n, joint) * o.elastic, zero));
    }

    /// (A function of its own, so that what it returns is never copied: in halves, that stalls the AVX2 kernel.)
    template <class Kind>
    STYLOBATE_INLINE Overlap<Real> meet(int joint, Scratch& s) const
    {
        const Placement<Real>& place = s.place;
        if constexpr (!Kind::at_rest)
            return general(joint, place);
        else if constexpr (Mechanism::extended)
            return meet_extended(joint, s);
        const auto [lower, upper] = topology_.joint[joint];
        auto fits = place.sine < place.sine;
        Overlap<Real> o = stacked_overlap(place, get(OfBlock::half_width, lower), get(OfBlock::half_width, upper),
                                          get(OfJoint::depth_limit, joint), fits);
        if (any(!fits)) [[unlikely]]
            fall_back(joint, place, fits, o);
        return o;
    }

    STYLOBATE_INLINE Overlap<Real> meet_extended(int joint, Scratch& s) const
    {
        using J = OfJointExtension;
        const auto [lower, upper] = topology_.joint[joint];
        const PairSizes<Real> sizes{get(OfBlock::half_width, lower), get(OfBlock::half_height, lower),
                                    get(OfBlock::half_width, upper), get(OfBlock::half_height, upper)};
        const Real narrow = min_of(sizes.lower_half_width, sizes.upper_half_width);
        const Real wear = get(J::corner_wear, joint), turned = get(J::turned, joint);
        const BedFaces<Real> faces{sizes,
                                   get(OfJoint::depth_limit, joint),
                                   face_loss(worn_corner(get(J::chip_left, joint), wear, turned, narrow),
                                             worn_corner(get(J::chip_right, joint), wear, turned, narrow),
                                             get(J::left_of_lower, joint), get(J::right_of_lower, joint)),
                                   get(J::wedge_sine, joint),
                                   get(J::wedge_versine, joint),
                                   get(J::per_root_depth, joint)};
        const auto far = [this](const Placement<Real>& place, const PairSizes<Real>& left, auto fits, Overlap<Real>& o,
                                auto& points) { fall_back(place, left, fits, o, points); };
        if constexpr (Mechanism::points > 0) {
            return bed_overlap<Mechanism::form>(s.place, faces, s.place.sine < s.place.sine, s.points, far);
        } else {
            FormPoints<Real, 0> none;
            return bed_overlap<Mechanism::form>(s.place, faces, s.place.sine < s.place.sine, none, far);
        }
    }

    template <class Mask, int count>
#if defined(__GNUC__)
    __attribute__((noinline))
#endif
    void
    fall_back(const Placement<Real>& place, const PairSizes<Real>& sizes, Mask fits, Overlap<Real>& o,
              FormPoints<Real, count>& points) const
    {
        take_general(place, sizes, fits, o, points);
    }

    STYLOBATE_INLINE Overlap<Real> general(int joint, const Placement<Real>& place) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        return general_overlap(place,
                               PairSizes<Real>{get(OfBlock::half_width, lower), get(OfBlock::half_height, lower),
                                               get(OfBlock::half_width, upper), get(OfBlock::half_height, upper)});
    }

    /// The general overlap, for the realizations whose closed form does not hold. Rare, so kept out of the way.
    template <class Mask>
#if defined(__GNUC__)
    __attribute__((noinline))
#endif
    void
    fall_back(int joint, const Placement<Real>& place, Mask fits, Overlap<Real>& o) const
    {
        const Overlap<Real> g = general(joint, place);
        o.area = select(fits, o.area, g.area);
        o.moment_x = select(fits, o.moment_x, g.moment_x);
        o.moment_depth = select(fits, o.moment_depth, g.moment_depth);
        o.normal_x = select(fits, o.normal_x, g.normal_x);
        o.normal_y = select(fits, o.normal_y, g.normal_y);
        o.elastic = select(fits, o.elastic, g.elastic);
    }

    STYLOBATE_INLINE void faces(int joint, Scratch& s) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        const Real zero(0.0);
        const Real sine = get(OfBlock::sine, lower), cosine = Real(1.0) - get(OfBlock::versine, lower);
        const Real nx = fms(s.normal_x, cosine, s.normal_y * sine);
        const Real ny = fma(s.normal_x, sine, s.normal_y * cosine);
        const Real lx = fms(s.arm_x, cosine, s.arm_y * sine);
        const Real ly = fma(s.arm_x, sine, s.arm_y * cosine);
        const Real ux = lx - s.apart_x;
        const Real uy = ly - s.apart_y;
        const Real wl = get(OfBlock::dtheta, lower), wu = get(OfBlock::dtheta, upper);
        const Real vx = fma(wl, ly, fnma(wu, uy, get(OfBlock::dx, upper) - get(OfBlock::dx, lower)));
        const Real vy = fnma(wl, lx, fma(wu, ux, get(OfBlock::dy, upper) - get(OfBlock::dy, lower)));
        // blocks that do not touch neither close nor slide
        const auto pressed = s.area > zero;
        s.closing = select(pressed, fnma(vx, nx, zero - vy * ny), zero);
        s.sliding = select(pressed, fms(vx, ny, vy * nx), zero);
        s.normal_x = nx;
        s.normal_y = ny;
        s.lower_arm_x = lx;
        s.lower_arm_y = ly;
        s.upper_arm_x = ux;
        s.upper_arm_y = uy;
    }

    /// The sums over a block take its joints in the order of the list. A pair adds to them only where it touches: so
    /// they have the same bits whether or not it was worked on.
    template <class Kind, class JointOf>
    STYLOBATE_INLINE void forces(int count, JointOf joint_of, const Scratch* scratch) const
    {
        Real dashpot_energy = get(OfRealization::dashpot_energy), shear_energy = get(OfRealization::shear_energy);
        Real friction_energy = get(OfRealization::friction_energy);
        Real slip_sum = get(OfRealization::slip), path = get(OfRealization::path);
        Real rocking_path = get(OfRealization::rocking_path);
        [[maybe_unused]] Real joint_energy(0.0);
        for (int j = 0; j < count; ++j) {
            const int joint = joint_of(j);
            const Scratch& s = scratch[j];
            const auto [lower, upper] = topology_.joint[joint];
            const JointLaw<Real> law{get(OfJoint::K_n, joint),        get(OfJoint::K_t, joint),
                                     get(OfJoint::C_n_per_dt, joint), get(OfJoint::C_t_per_dt, joint),
                                     get(OfJoint::C_n_chord, joint),  get(OfJoint::C_t_chord, joint),
                                     get(OfJoint::mu, joint)};
            const Real spring = get(OfJoint::spring, joint);
            constexpr bool extended = Mechanism::extended && Kind::at_rest;
            ContactForce<Real> f;
            [[maybe_unused]] Real couple(0.0), mu = law.mu;
            [[maybe_unused]] const Real turning = get(OfBlock::dtheta, upper) - get(OfBlock::dtheta, lower);
            if constexpr (extended) {
                const BedMotion<Real> motion{s.area,  s.chord,      s.closing,     s.sliding,
                                             turning, s.place.sine, s.place.cosine};
                BedForce<Real> bed;
                if constexpr (Mechanism::points > 0)
                    bed = bed_force(*this, joint, law, spring, motion, s.points);
                else
                    bed = bed_force(*this, joint, law, spring, motion, FormPoints<Real, 0>{});
                f = bed.contact;
                couple = bed.couple;
                mu = bed.mu;
            } else {
                f = contact_force(law, s.area, s.chord, s.closing, s.sliding, spring);
            }
            put(OfJoint::spring, joint, f.spring);

            const Real fx = fms(f.normal, s.normal_x, f.tangential * s.normal_y);
            const Real fy = fma(f.normal, s.normal_y, f.tangential * s.normal_x);
            const auto pressed = s.area > Real(0.0);
            const auto sum = [&](OfBlock::Field field, int block, Real with) {
                put(field, block, Kind::at_rest ? with : select(pressed, with, get(field, block)));
            };
            sum(OfBlock::force_x, upper, get(OfBlock::force_x, upper) + fx);
            sum(OfBlock::force_y, upper, get(OfBlock::force_y, upper) + fy);
            const Real upper_moment = fms(s.upper_arm_x, fy, s.upper_arm_y * fx);
            const Real lower_moment = fms(s.lower_arm_x, fy, s.lower_arm_y * fx);
            sum(OfBlock::moment, upper,
                get(OfBlock::moment, upper) + (extended ? upper_moment + couple : upper_moment));
            sum(OfBlock::force_x, lower, get(OfBlock::force_x, lower) - fx);
            sum(OfBlock::force_y, lower, get(OfBlock::force_y, lower) - fy);
            sum(OfBlock::moment, lower,
                get(OfBlock::moment, lower) - (extended ? lower_moment + couple : lower_moment));

            // energy: the work of this step is its displacement times the mean of the forces at its two ends
            const Real dashpot = fnma(law.K_n, s.area, f.normal);
            dashpot_energy = fma(dashpot + get(OfJoint::dashpot_force, joint), s.closing, dashpot_energy);
            if constexpr (extended) {
                using J = OfJointExtension;
                dashpot_energy = fnma(couple + get(J::couple, joint), turning, dashpot_energy);
                put(J::couple, joint, couple);
                joint_energy = joint_energy + after_force(joint, s, f, turning);
            }
            put(OfJoint::dashpot_force, joint, dashpot);
            shear_energy = fma(f.tangential + get(OfJoint::shear_force, joint), s.sliding, shear_energy);
            put(OfJoint::shear_force, joint, f.tangential);
            const Real slip = f.excess * get(OfJoint::per_K_t, joint);
            friction_energy = fma(slip, (extended ? mu : law.mu) * f.normal, friction_energy);
            if constexpr (Kind::at_rest) {
                slip_sum = slip_sum + slip;
                path = path + abs_of(s.sliding);
                rocking_path = rocking_path + abs_of(get(OfBlock::dtheta, upper) - get(OfBlock::dtheta, lower));
            }
        }
        put(OfRealization::dashpot_energy, dashpot_energy);
        put(OfRealization::shear_energy, shear_energy);
        put(OfRealization::friction_energy, friction_energy);
        put(OfRealization::slip, slip_sum);
        put(OfRealization::path, path);
        put(OfRealization::rocking_path, rocking_path);
        if constexpr (Mechanism::extended && Kind::at_rest)
            put(OfRealizationExtension::joint_energy, get(OfRealizationExtension::joint_energy) + joint_energy);
    }

    /// What follows the contact force of a bed: its dowel, and what its slip and its rocking wear off.
    /// @return 2 x the energy that these took [J]
    STYLOBATE_INLINE Real after_force(int joint, const Scratch& s, const ContactForce<Real>& f, Real turning) const
    {
        using J = OfJointExtension;
        const auto [lower, upper] = topology_.joint[joint];
        Real energy = add_dowel<Real>(*this, joint, lower, upper, s.place, s.apart_x, s.apart_y);
        put(J::slip, joint, fma(f.excess, get(OfJoint::per_K_t, joint), get(J::slip, joint)));
        const Real wear = get(J::corner_wear, joint);
        if (any(wear != Real(0.0))) {
            const Real path = abs_of(turning);
            put(J::turned, joint, get(J::turned, joint) + path);
            energy =
                energy + Real(2.0) * worn_energy(get(OfJoint::K_n, joint), s.area, s.chord, s.place.sine, wear * path);
        }
        return energy;
    }

    /// Whether a block of any realization has moved so far since `look_around` that a pair may have come close unseen.
    STYLOBATE_INLINE bool strayed() const
    {
        const Real skin = get(OfRealization::skin);
        auto far = skin < skin;
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Real x = abs_of(get(OfBlock::x, i) - get(OfNeighbourhood::x, i));
            const Real y = abs_of(get(OfBlock::y, i) - get(OfNeighbourhood::y, i));
            const Real turned = abs_of(get(OfBlock::theta, i) - get(OfNeighbourhood::theta, i));
            Real radius = get(OfBlock::half_width, i) + get(OfBlock::half_height, i);
            if constexpr (Mechanism::extended)
                radius = radius + abs_of(get(OfBlockExtension::eccentricity, i));
            far = far | (fma(radius, turned, max_of(x, y)) > skin);
        }
        return any(far);
    }

    /// Whether the bounding boxes of a pair are less than `margin` apart, or it still carries a force to be ended.
    STYLOBATE_INLINE auto meets(int joint, Real margin) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        const Real one(1.0);
        const Real sl = abs_of(get(OfBlock::sine, lower)), cl = abs_of(one - get(OfBlock::versine, lower));
        const Real su = abs_of(get(OfBlock::sine, upper)), cu = abs_of(one - get(OfBlock::versine, upper));
        const Real bl = get(OfBlock::half_width, lower), hl = get(OfBlock::half_height, lower);
        const Real bu = get(OfBlock::half_width, upper), hu = get(OfBlock::half_height, upper);
        const Real x = abs_of(get(OfJoint::reference_x, joint) + (centre_x(upper) - centre_x(lower)));
        const Real y = abs_of(get(OfJoint::height, joint) + (centre_y(upper) - centre_y(lower)));
        const Real reach_x = fma(bl, cl, fma(hl, sl, fma(bu, cu, hu * su)));
        const Real reach_y = fma(bl, sl, fma(hl, cl, fma(bu, su, hu * cu)));
        const Real carried = abs_of(get(OfJoint::spring, joint)) + abs_of(get(OfJoint::shear_force, joint)) +
                             abs_of(get(OfJoint::dashpot_force, joint));
        return ((x - reach_x < margin) & (y - reach_y < margin)) | (carried > Real(0.0));
    }

    /// Lists the pairs that can meet before a block has strayed by the skin: those less than two skins apart.
    /// @return how many
    STYLOBATE_INLINE int look_around() const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            put(OfNeighbourhood::x, i, get(OfBlock::x, i));
            put(OfNeighbourhood::y, i, get(OfBlock::y, i));
            put(OfNeighbourhood::theta, i, get(OfBlock::theta, i));
        }
        const Real margin = get(OfRealization::skin) * Real(2.0);
        int close = 0;
        for (int joint = topology_.beds(); joint < topology_.joints; ++joint)
            if (any(meets(joint, margin)))
                b_.close[close++] = joint;
        return close;
    }

    /// The watched pairs that meet, in the order of the list. Kept out of the way of the beds.
    /// @param close how many pairs are listed as close; -1: none has been looked for
    /// @return how many are now
#if defined(__GNUC__)
    __attribute__((noinline))
#endif
    int
    pairs(int close, Scratch* scratch, bool audit) const
    {
        if (close < 0 || strayed())
            close = look_around();
        if (audit)
            for (int joint = topology_.beds(); joint < topology_.joints; ++joint)
                put(OfJoint::elastic, joint, Real(0.0));
        // boxes that touch to rounding are let in
        const Real margin = get(OfRealization::skin) * Real(1e-3);
        for (int next = 0; next < close;) {
            int group[detail::joint_group], count = 0;
            for (; next < close && count < detail::joint_group; ++next)
                if (any(meets(b_.close[next], margin)))
                    group[count++] = b_.close[next];
            contacts<detail::Pair>(
                count, [&group](int j) { return group[j]; }, scratch, audit);
        }
        return close;
    }

    /// Energies at the positions that the step starts from. The kinetic one is the product of the velocities half a
    /// step before and after: with it, and the works as above, the balance of the scheme is exact.
    STYLOBATE_INLINE void update(int step, bool audit) const
    {
        const Real gx = get(OfRealization::gravity_dx), gy = get(OfRealization::gravity_dy);
        const Real base = this->base(step);
        const Real push = gx - base;
        [[maybe_unused]] auto pull = [&] {
            if constexpr (Mechanism::extended)
                return ExtendedPull<Real>(*this, step);
            else
                return 0;
        }();
        Real kinetic(0.0), potential(0.0), momentum(0.0);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Real dx = get(OfBlock::dx, i), dy = get(OfBlock::dy, i), dtheta = get(OfBlock::dtheta, i);
            const Real x = get(OfBlock::x, i), y = get(OfBlock::y, i);
            const Real per_mass = get(OfBlock::dt2_per_mass, i), mass = get(OfBlock::mass, i);
            Real ex, ey, etheta;
            if constexpr (Mechanism::extended) {
                pull.step(i, dx, dy, dtheta, ex, ey, etheta);
            } else {
                ex = fma(per_mass, get(OfBlock::force_x, i), dx + push);
                ey = fma(per_mass, get(OfBlock::force_y, i), dy + gy);
                etheta = fma(get(OfBlock::dt2_per_inertia, i), get(OfBlock::moment, i), dtheta);
            }
            momentum = fma(mass, dx, momentum);
            if (audit) {
                const Real twice = fma(dx, ex, dy * ey);
                kinetic = fma(mass, twice, fma(get(OfBlock::inertia, i), dtheta * etheta, kinetic));
                potential = fnma(mass, fma(gx, x, gy * y), potential);
            }
            put(OfBlock::dx, i, ex);
            put(OfBlock::dy, i, ey);
            put(OfBlock::dtheta, i, etheta);
            put(OfBlock::x, i, x + ex);
            put(OfBlock::y, i, y + ey);
            put(OfBlock::theta, i, get(OfBlock::theta, i) + etheta);
        }
        const Real both = get(OfRealization::base_step) + base;
        Real base_energy = fnma(both, momentum, get(OfRealization::base_energy));
        if constexpr (Mechanism::extended) {
            base_energy = base_energy + pull.drive_energy();
            pull.end();
        }
        put(OfRealization::base_energy, base_energy);
        put(OfRealization::base_step, base);
        put(OfRealization::peak_top, max_of(get(OfRealization::peak_top), abs_of(get(OfBlock::x, topology_.top))));
        put(OfRealization::top_path, get(OfRealization::top_path) + abs_of(get(OfBlock::dx, topology_.top)));
        if (audit) {
            put(OfRealization::kinetic, kinetic);
            put(OfRealization::potential, potential);
        }
    }

    const Topology& topology_;
};

/// Runs steps `first` to `last - 1` of the chunk for all realizations of the bundle.
template <class Real, class Mechanism = Baseline>
void run_steps(const Topology& topology, const Bundle& bundle, int first, int last)
{
    if (topology.watched > 0)
        Stepper<Real, Mechanism, true>(topology, bundle).run(first, last);
    else
        Stepper<Real, Mechanism, false>(topology, bundle).run(first, last);
}

} // namespace stylobate
