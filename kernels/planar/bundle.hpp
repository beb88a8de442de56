#pragma once
/// Bundle: the realizations that share one register, one in each lane.
///
/// Its memory is lists of fields (`row_list.hpp`): a field of a block is at a constant distance from the block's row,
/// and the fields that a step needs of a block are adjacent. The kernels allocate nothing: the caller provides the
/// memory, and writes and reads single lanes with `at`.

#include "kernels/planar/topology.hpp"
#include "kernels/row_list.hpp"

#include <cstddef>

namespace stylobate {

/// Fields of a block. Displacements are relative to the reference stack, in the frame of the base. "step": written by
/// it.
struct OfBlock {
    enum Field : int {
        x,               ///< [m] step
        y,               ///< [m] step
        theta,           ///< [rad], counter-clockwise; step
        dx,              ///< increment of the last step [m]; step
        dy,              ///< [m] step
        dtheta,          ///< [rad] step
        force_x,         ///< sum of the contact forces at the last step of a chunk [N]; step
        force_y,         ///< [N] step
        moment,          ///< [N m] step
        sine,            ///< of theta; step
        versine,         ///< 1 - cos theta; step
        half_width,      ///< [m]
        half_height,     ///< [m]
        mass,            ///< [kg]
        inertia,         ///< [kg m2]
        dt2_per_mass,    ///< dt2 / m [s2/kg]
        dt2_per_inertia, ///< dt2 / I [s2/(kg m2)]
        least_y,         ///< of its geometric centre: lower, it may have fallen [m]
        most_turn,       ///< |theta| beyond which it may have [rad]
        inside,          ///< last step of the chunk after which it was within both; -1: none. step
        count
    };
    static constexpr int traced = force_x; ///< number of fields, the first ones, that `BundleOf::trace` keeps
};

/// Fields of a joint.
struct OfJoint {
    enum Field : int {
        spring,        ///< elastic part of F_T [N]; step
        dashpot_force, ///< F_N - K_N A of the last step [N]; step
        shear_force,   ///< F_T of the last step [N]; step
        max_rotation,  ///< largest |relative rotation| so far [rad]; step
        elastic,       ///< energy of the normal spring at the last step of a chunk [J]; step
        reference_x,   ///< upper centre - lower centre in the reference stack [m]
        height,        ///< the same upwards [m]; of a bed the sum of the half heights
        depth_limit,   ///< of the closed form of the overlap [m]
        K_n,           ///< [N/m2]
        K_t,           ///< [N/m]
        C_n_per_dt,    ///< C_N / dt [N/m]
        C_t_per_dt,    ///< [N/m]
        C_n_chord,     ///< C_N / (dt x contact length) [N/m2]
        C_t_chord,     ///< [N/m2]
        mu,
        per_K_t,      ///< 1 / K_T [m/N]
        force_x,      ///< of a bed on its upper block in the last step, frame of the base [N]; step
        force_y,      ///< [N] step
        upper_moment, ///< the same about the upper block's centre [N m]; step
        lower_moment, ///< and about the lower block's [N m]; step
        count
    };
};

/// Fields of a realization as a whole. Energies are summed with the factors given, which the termination check divides
/// out once.
struct OfRealization {
    enum Field : int {
        gravity_dx,      ///< dt2 x horizontal gravity (tilted base) [m]
        gravity_dy,      ///< dt2 x vertical gravity, negative [m]
        base_step,       ///< second difference of the base displacement in the last step [m]; step
        slip,            ///< sum over beds and time of the slip [m]; step
        path,            ///< sum over beds and time of the relative path in contact [m]; step
        rocking_path,    ///< sum over beds and time of the path of the relative rotation [rad]; step
        friction_energy, ///< dissipated by slipping [J]; step
        dashpot_energy,  ///< 2 x the dissipation of the normal dashpots [J]; step
        shear_energy,    ///< 2 x the work against F_T: slip, dashpot and tangential spring [J]; step
        base_energy,     ///< 2 dt2 x the work of the base [J s2]; step
        peak_top,        ///< largest |x| of the top block's centre [m]; step
        top_path,        ///< sum over time of |dx| of the top block's centre [m]; step
        skin,            ///< how far a block may stray before the close pairs are listed again [m]
        kinetic,         ///< 2 dt2 x the kinetic energy at the last step of a chunk [J s2]; step
        potential,       ///< dt2 x the potential energy at the last step of a chunk [J s2]; step
        count
    };
};

/// Fields of a block's mechanisms (`planar/mechanisms/`); present only with a model with mechanisms. In it the
/// displacements of `OfBlock` are those of the centre of mass. All zero is neutral.
struct OfBlockMechanisms {
    enum Field : int {
        reference_x,   ///< centre of mass in the reference stack, from the point about which the base turns [m]
        reference_y,   ///< [m]
        eccentricity,  ///< centre of mass from the geometric centre, along the width [m]
        drag_per_mass, ///< c / m [1/m]
        drag_linear,   ///< dt d / m
        tie_spring,    ///< tie: dt2 k / m
        tie_dashpot,   ///< dt c / m
        tie_pull,      ///< dt2 f / m [m]
        tie_turning,   ///< dt c_r / I
        rod_right,     ///< rod: k_r [N/m]
        rod_left,      ///< k_l [N/m]
        rod_arm,       ///< its point above the geometric centre [m]
        rod_zero,      ///< displacement of its point at the start [m]
        rod_share,     ///< a, the part of the base's motion that its end does not follow
        rod_least,     ///< least and most of the path of its end [m]
        rod_most,      ///< [m]
        rod_step,      ///< v dt [m]
        rod_path,      ///< v (t - t_0) [m]; step
        nudge_x,       ///< nudging: dt2 x an external acceleration, which the host may write between two runs [m]
        nudge_y,       ///< [m]
        nudge_theta,   ///< [rad]
        count
    };
};

/// Fields of a joint's mechanisms. "step": written by the step.
struct OfJointMechanisms {
    enum Field : int {
        friction_drop,       ///< stribeck: 1 - mu_d / mu_s
        per_stribeck_step,   ///< stribeck: 1 / (v_s dt) [1/m]
        wear,                ///< friction_wear: k [1/m]
        adhesion,            ///< adhesion: c [N/m]
        dowel_stiffness,     ///< dowel: k_d [N/m]
        per_dowel_stiffness, ///< 1 / k_d, 0 without a dowel [m/N]
        dowel_yield,         ///< dowel: F_d [N]
        dowel_gap,           ///< dowel: [m]
        exponent,            ///< hertz: q - 1
        per_reference,       ///< hertz: 1 / reference overlap [1/m2]
        rate_per_dt,         ///< rate_damping: lambda / dt [1/m]
        face_dashpot,        ///< at the ends: area: share x C_N / (B dt) [N/m2]; other forms: C_N / dt [N/m]
        chip_left,           ///< corner_loss [m]
        chip_right,          ///< [m]
        left_of_lower,       ///< 1 where the left end of the common face is the lower block's, else 0
        right_of_lower,      ///< the same of the right end
        corner_wear,         ///< corner_wear [m/rad]
        wedge_sine,          ///< wedge: sine of the angle
        wedge_versine,       ///< and 1 - its cosine
        per_root_depth,      ///< points: 1 / sqrt(d_ref) [m^-1/2]
        slip,                ///< of this joint so far [m]; step
        turned,              ///< path of the relative rotation so far [rad]; step
        broken,              ///< adhesion: 1 once it has slipped or opened; step
        dowel_set,           ///< where the dowel's play is centred [m]; step
        dowel_at,            ///< offset of the faces at the last step [m]; step
        dowel_force,         ///< at the last step [N]; step
        couple,              ///< moment of the dashpots at the ends at the last step [N m]; step
        count
    };
};

/// Fields of the mechanisms of a realization as a whole.
struct OfRealizationMechanisms {
    enum Field : int {
        base_dx,      ///< increment of the base's displacement in the last step [m]; step
        base_dy,      ///< the same upwards [m]; step
        base_x,       ///< displacement of the base [m]; step
        joint_energy, ///< 2 x the energy taken by dowels, worn corners and strengthening [J]; step
        drag_energy,  ///< 2 dt2 x the work against drag and ties [J s2]; step
        count
    };
};

/// Fields of what strengthens a block (`planar/mechanisms/strengthening.hpp`); present only with a strengthened model.
/// All zero is neutral. The fields from `tendon_set` on are the memory of the path, which the step writes.
struct OfBlockStrengthening {
    enum Field : int {
        tendon_stiffness, ///< tendon: k [N/m]
        tendon_stretch,   ///< elongation at rest, T0 / k [m]
        tendon_yield,     ///< T_y [N]
        tendon_length,    ///< distance of the anchors at rest [m]
        tendon_x,         ///< from the lower anchor to the upper one in the reference stack [m]
        tendon_y,         ///< [m]
        clamp_pull,       ///< clamp: stiffness in tension [N/m]
        clamp_push,       ///< in compression [N/m]
        clamp_strength,   ///< [N]
        clamp_gap,        ///< free play to either side [m]
        clamp_break,      ///< elongation at which it breaks [m]
        clamp_length,     ///< place of its right end along the left block's axis at rest [m]
        clamp_x,          ///< its right end from the right block's geometric centre, in that block's frame [m]
        clamp_y,          ///< [m]
        tendon_set,       ///< plastic elongation [m]; step
        tendon_at,        ///< elongation since rest at the last step [m]; step
        tendon_force,     ///< at the last step [N]; step
        clamp_set,        ///< plastic elongation [m]; step
        clamp_at,         ///< elongation since rest at the last step [m]; step
        clamp_force,      ///< at the last step, tension positive [N]; step
        clamp_broken,     ///< 1 once it has broken; step
        held,             ///< energy stored in both [J]; step
        count
    };
    static constexpr int memory = tendon_set; ///< the first field that the step writes
};

/// Fields of what strengthens a bed. The fields from `bearing_at` on are the memory of the path.
struct OfJointStrengthening {
    enum Field : int {
        bearing_stiffness,  ///< bearing: k [N/m]
        bearing_dashpot,    ///< c / dt [N/m]
        bearing_per_radius, ///< 1 / R [1/m]
        rest_offset,        ///< offset of the faces at rest, from which bearing and mortar count [m]
        bond_tension,       ///< mortar: f_t D [N/m]
        bond_cohesion,      ///< mortar: c D [N/m]
        hold_limit,         ///< pull_out: F_a of one dowel [N]
        hold_stiffness,     ///< [N/m]
        per_hold_stiffness, ///< 1 / that, 0 without [m/N]
        hold_length,        ///< embedded length [m]
        hold_spread,        ///< of the dowels from the middle of the upper face [m]
        bond,               ///< mortar: 1 while it is whole; step
        bond_spring,        ///< its elastic shear force [N]; step
        bearing_at,         ///< offset at the last step, from `rest_offset` [m]; step
        bearing_force,      ///< at the last step [N]; step
        bond_offset,        ///< offset of the faces at the last step, from `rest_offset` [m]; step
        bond_opening,       ///< opening at the middle of the upper face at the last step [m]; step
        bond_pull,          ///< tension at the last step [N]; step
        bond_couple,        ///< its moment about that middle [N m]; step
        bond_shear,         ///< shear force at the last step [N]; step
        left_set,           ///< pull_out: plastic opening of the left dowel [m]; step
        left_at,            ///< its opening at the last step [m]; step
        left_force,         ///< its force at the last step [N]; step
        left_out,           ///< 1 once it is out; step
        right_set,          ///< the same of the right dowel; step
        right_at,           ///< step
        right_force,        ///< step
        right_out,          ///< step
        held,               ///< energy stored in all of them [J]; step
        count
    };
    static constexpr int memory = bearing_at; ///< the first field that the step writes from nothing
};

/// Additional fields of a block of the rigid form (`rigid/rigid_step.hpp`).
struct OfRigidBlock {
    enum Field : int {
        change_x,        ///< change of the increment by the last step [m]; step
        change_y,        ///< [m] step
        change_theta,    ///< [rad] step
        mass_per_dt2,    ///< m / dt2 [kg/s2]
        inertia_per_dt2, ///< I / dt2 [kg m2/s2]
        free_x,          ///< increment of this step without the contacts' forces [m]; step
        free_y,          ///< [m] step
        free_theta,      ///< [rad] step
        next_x,          ///< increment of this step with them [m]; step
        next_y,          ///< [m] step
        next_theta,      ///< [rad] step
        count
    };
};

/// Fields of a joint of rigid blocks, in the frame of its lower block: its ends are those of the faces' common part,
/// left and right.
struct OfRigidJoint {
    enum Field : int {
        left,        ///< 1 where the left end carries, else 0; step
        right,       ///< the same of the right end; step
        slips,       ///< 1 or -1: friction at its limit, on the upper block this way along the face; 0: it holds. step
        restitution, ///< of an end's closing velocity (Newton)
        expansion,   ///< of the impulse of the compression (Poisson)
        left_back,   ///< force of the expansion at the left end, in the step after an impact [N]; step
        right_back,  ///< at the right end [N]; step
        // of this step alone
        left_x,       ///< of the left end from the lower block's centre [m]
        right_x,      ///< of the right end [m]
        left_arm,     ///< the same from the upper block's centre [m]
        right_arm,    ///< [m]
        upper_arm,    ///< of the upper block's centre above the face [m]
        left_gap,     ///< of the faces at the left end [m]
        right_gap,    ///< [m]
        left_rate,    ///< what the last increments add to the gap [m]
        right_rate,   ///< [m]
        sliding,      ///< what they move the upper face along the lower one [m]
        left_tilt,    ///< slope of the upper face where the left end is a corner of the lower block, else 0
        right_tilt,   ///< the same of the right end
        left_lift,    ///< the left one's if the left end is the nearer one, else 0
        right_lift,   ///< the same of the right end
        left_bend,    ///< second-order change of the left gap in a step [m]
        right_bend,   ///< of the right one [m]
        bend_sliding, ///< and of the sliding, at the nearer end [m]
        usable,       ///< 1 where the faces have a common part
        left_goal,    ///< gap that the increments with the contacts' forces are to add [m]
        right_goal,   ///< [m]
        sliding_goal, ///< [m]

        next_left,            ///< what the next increments add to the gap [m]
        next_right,           ///< [m]
        next_sliding,         ///< [m]
        own,                  ///< response of the three rows to their own forces (6: 00 01 02 11 12 22) [m/N]
        inverse = own + 6,    ///< of the pivot (9)
        pivot = inverse + 9,  ///< while it is made (9)
        force = pivot + 9,    ///< at the left and right end and, on the upper block, along the face (3) [N]
        before = force + 3,   ///< the same of the last step (3) [N]; step
        closing = before + 3, ///< the forces of what closes the gaps (3) [N]
        // in frames, the friction at its limit is slope * N + rest:
        slope = closing + 3, ///< mu, or 0 while friction is held to a bound
        rest,                ///< of the expansion, or the bound [N]
        bound,               ///< mu N of forces that were found before [N]
        after_bound,         ///< mu N of those found with it [N]
        count
    };
};

/// Two joints that share a free block, or become related while others are eliminated.
struct OfRigidEdge {
    enum Field : int {
        response,               ///< rows of the earlier joint to the forces of the later one (9) [m/N]
        earlier = response + 9, ///< of the factor: the earlier joint's rows (9)
        later = earlier + 9,    ///< and the later one's (9)
        count = later + 9
    };
};

/// Additional fields of a realization of the rigid form.
struct OfRigid {
    enum Field : int {
        struck,  ///< 1 if an end met its face within the last step; step
        share,   ///< part of this step before an end meets its face
        expands, ///< 1 if a joint has an expansion
        count
    };
};

/// Values of one step in the table of the base's rotation.
struct OfPitch {
    enum Field : int {
        angle,     ///< [rad], counter-clockwise
        increment, ///< dt x its rate [rad]
        second,    ///< its second difference [rad]
        count
    };
};

/// Remainders of a block's displacements and increments (compensated sums): the true values are the sums of both.
struct OfRemainder {
    enum Field : int {
        x,      ///< [m] step
        y,      ///< [m] step
        theta,  ///< [rad] step
        dx,     ///< [m] step
        dy,     ///< [m] step
        dtheta, ///< [rad] step
        count
    };
};

/// Whether displacements and increments are compensated sums: in single precision (`THEORY.md` section 9).
template <class Number>
inline constexpr bool compensated = false;
template <>
inline constexpr bool compensated<float> = true;

/// The second difference of the base's displacement in each step of a chunk [m].
struct OfBase {
    enum Field : int { second, count };
};
/// The second difference of the base's vertical displacement in each step of a chunk [m].
struct OfVertical {
    enum Field : int { second, count };
};

namespace detail {

struct WithMechanisms {
    template <class Number>
    static constexpr bool in(const Topology& topology)
    {
        return topology.model.has_mechanism_rows();
    }
};
struct WithStrengthening {
    template <class Number>
    static constexpr bool in(const Topology& topology)
    {
        return topology.model.strengthened;
    }
};
struct OfRigidForm {
    template <class Number>
    static constexpr bool in(const Topology& topology)
    {
        return topology.model.rigid();
    }
};
struct WithRemainders {
    template <class Number>
    static constexpr bool in(const Topology&)
    {
        return compensated<Number>;
    }
};

/// The lists of the planar model; the tables of the base's motion are the last of them.
template <class Number>
using PlanarRows =
    RowList<Number, FieldList<OfBlock, RowOf::block>, FieldList<OfJoint, RowOf::joint>,
            FieldList<OfRealization, RowOf::realization>, FieldList<OfBlockMechanisms, RowOf::block, WithMechanisms>,
            FieldList<OfJointMechanisms, RowOf::joint, WithMechanisms>,
            FieldList<OfRealizationMechanisms, RowOf::realization, WithMechanisms>,
            FieldList<OfBlockStrengthening, RowOf::block, WithStrengthening>,
            FieldList<OfJointStrengthening, RowOf::joint, WithStrengthening>,
            FieldList<OfRigidBlock, RowOf::block, OfRigidForm>, FieldList<OfRigidJoint, RowOf::joint, OfRigidForm>,
            FieldList<OfRigidEdge, RowOf::edge, OfRigidForm>, FieldList<OfRigid, RowOf::realization, OfRigidForm>,
            FieldList<OfRemainder, RowOf::block, WithRemainders>, FieldList<OfVertical, RowOf::step, WithMechanisms>,
            FieldList<OfPitch, RowOf::step, WithMechanisms>, FieldList<OfBase, RowOf::step>>;

constexpr bool is_table(RowOf row)
{
    return row == RowOf::step;
}
constexpr bool is_state(RowOf row)
{
    return row != RowOf::step;
}

} // namespace detail

template <class Number>
struct BundleOf : detail::PlanarRows<Number> {
    int* close = nullptr; ///< (watched) the close pairs, for the kernel alone
    /// (steps x blocks x OfBlock::traced x lanes) where the step leaves the blocks' motion after each step of a run, so
    /// that lanes can be read at steps of their own without ending it; null: nowhere
    Number* trace = nullptr;
};

using Bundle = BundleOf<double>;

/// Registers of the tables of the base's motion.
constexpr std::size_t table_registers(const Topology& topology)
{
    return Bundle::registers(topology, detail::is_table);
}

/// Registers that a bundle needs, each of `lanes` numbers; the tables are the last of them.
template <class Number = double>
constexpr std::size_t bundle_registers(const Topology& topology)
{
    return BundleOf<Number>::registers(topology, detail::is_state) + table_registers(topology);
}

/// Gives the bundle its tables of the base's motion.
/// @param memory `table_registers` x lanes numbers
template <class Number>
constexpr void bind_tables(const Topology& topology, BundleOf<Number>& b, Number* memory)
{
    b.bind(topology, memory, detail::is_table);
}

/// Lays a bundle out.
/// @param memory `bundle_registers` x lanes numbers, aligned to 64 bytes
/// @param close `topology.watched` integers; null where there are none
template <class Number>
BundleOf<Number> bind_bundle(const Topology& topology, int lanes, Number* memory, int* close = nullptr)
{
    BundleOf<Number> b;
    b.lanes = lanes;
    b.bind(topology, memory, [](RowOf) { return true; });
    b.close = close;
    return b;
}

/// The bundle as seen from one of its lanes, for a stepper of that lane alone (`Strided`): the rows begin at its place,
/// and are `lanes` numbers apart as before. Where there are watched pairs, `close` has (watched x lanes) integers.
template <class Number>
constexpr BundleOf<Number> lane_of(BundleOf<Number> b, int lane)
{
    b.move_to_lane(lane);
    if (b.close != nullptr)
        b.close += lane;
    if (b.trace != nullptr)
        b.trace += lane;
    return b;
}

} // namespace stylobate
