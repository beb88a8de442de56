#pragma once
/// Bundle of the spatial model: the realizations that share one register, one in each lane.
///
/// Its memory is lists of fields (`row_list.hpp`), as the planar one's. Axes: x and y span the plane of the planar
/// model, y points upwards, z towards the viewer. A lane whose numbers are all 0 is empty: it steps without effect.

#include "kernels/spatial/topology.hpp"

#include <cstddef>

namespace stylobate::spatial {

/// Fields of a body. Displacements are those of the centre of mass relative to the reference state, in the frame of
/// the base. The axes of the body's frame are principal axes, and those of the base in the reference state. "step":
/// written by it.
struct OfBody {
    enum Field : int {
        x,                 ///< [m] step
        y,                 ///< [m] step
        z,                 ///< [m] step
        q_w,               ///< attitude: unit quaternion, 1 0 0 0 in the reference state; step
        q_x,               ///< step
        q_y,               ///< step
        q_z,               ///< step
        dx,                ///< increment of the last step [m]; step
        dy,                ///< [m] step
        dz,                ///< [m] step
        turn_x,            ///< omega dt, in the frame of the base [rad]; step, from q and l
        turn_y,            ///< [rad] step
        turn_z,            ///< [rad] step
        l_x,               ///< dt x angular momentum about the centre of mass, frame of the base [kg m2]; step
        l_y,               ///< [kg m2] step
        l_z,               ///< [kg m2] step
        matrix,            ///< R(q) - 1, row by row (9); step, from q
        mass = matrix + 9, ///< [kg]
        dt2_per_mass,      ///< dt2 / m [s2/kg]; of a fixed body 0, as the three that follow
        per_sphere,        ///< `Inertia::sphere` [1/(kg m2)]
        per_top,           ///< `Inertia::top` [1/(kg m2)]
        per_correction,    ///< `Inertia::correction` [1/(kg m2)]
        least_y,           ///< of its centre: lower, it may have fallen [m]
        least_upright,     ///< cosine of the angle from its upright position: less, and it may have fallen
        inside,            ///< last step of the chunk after which it was within both; -1: none. step
        count
    };
    static constexpr int traced = l_x; ///< number of fields, the first ones, that `BundleOf::trace` keeps
};

/// Fields of a joint. The joint's frame has the axes of the lower body in cyclic order, the normal third: y is followed
/// by z and x. "1" and "2" are its first two axes.
struct OfJoint {
    enum Field : int {
        spring_1,     ///< elastic part of the friction [N]; step
        spring_2,     ///< [N] step
        spring_twist, ///< that of its torque, over the friction radius [N]; step
        dashpot,      ///< resistances of the dashpots at the last step, in the order of `BedComponents` (6); step
        normal = dashpot + 6, ///< force along the normal at the last step [N]; step
        elastic,              ///< energy of the bed at the last step of a chunk [J]; step
        slip,                 ///< sum over time [m]; step
        most_tilt,            ///< largest versine of the angle between the two faces so far; step
        most_twist, ///< largest |sin(twist / 2)| cos(tilt / 2) of the two bodies about the normal so far; step
        stiffness,  ///< k [N/m3]
        K_t,        ///< tangential stiffness [N/m]
        per_K_t,    ///< 1 / K_t [m/N]
        C_n,        ///< normal dashpot per area and step: c_n / dt [N/m3]
        C_t,        ///< tangential one [N/m3]
        mu,
        depth_limit,  ///< a mean depth beyond it is no contact [m]
        lower_anchor, ///< from the lower body's centre of mass to the point where the faces meet in the reference
                      ///< state, in the body's frame (3); with a gap each body's is on its own face [m]
        upper_anchor = lower_anchor + 3, ///< the same from the upper body's (3) [m]
        lower_half_1 = upper_anchor + 3, ///< half size of the lower face; of a disc its radius [m]
        lower_half_2,                    ///< [m]
        lower_centre_1,                  ///< centre of the lower face from the anchor [m]
        lower_centre_2,                  ///< [m]
        upper_half_1,                    ///< half size of the upper face; of what is round its radius [m]
        upper_half_2,                    ///< [m]
        upper_centre_1,                  ///< centre of the upper face from the anchor; of disc on disc 0 [m]
        upper_centre_2,                  ///< [m]
        inner_ratio, ///< of a hollow bed: inner over outer size of the faces; read where the topology has it
        gap,         ///< of a butt joint: from the lower to the upper anchor in the reference state, along the normal;
                     ///< not read of beds [m]
        force,       ///< on the upper body in the last step, frame of the base (3) [N]; step
        upper_moment = force + 3,        ///< the same about the upper body's centre of mass (3) [N m]; step
        lower_moment = upper_moment + 3, ///< and about the lower body's (3) [N m]; step
        count = lower_moment + 3
    };
};

/// Fields of a realization as a whole. Energies are summed with the factors given, which the termination check divides
/// out once.
struct OfRealization {
    enum Field : int {
        dt2,         ///< dt2 [s2]
        gravity_dx,  ///< dt2 x gravity [m]
        gravity_dy,  ///< negative [m]
        gravity_dz,  ///< [m]
        base_step_x, ///< second difference of the base displacement in the last step [m]; step
        base_step_y, ///< [m] step
        base_step_z, ///< [m] step
        across_x,    ///< unit vector, horizontal, across the plane in which the base moves mainly
        across_z,
        slip,            ///< sum over joints and time of the slip, with that of the spin at the friction radius [m];
                         ///< step
        friction_energy, ///< dissipated by slipping [J]; step
        dashpot_energy,  ///< dissipated by the normal and tangential dashpots [J]; step
        base_energy,     ///< 2 dt2 x the work of the base [J s2]; step
        peak_radial,     ///< largest x2 + z2 of the top body's centre [m2]; step
        peak_across,     ///< largest |across . (x, z)| of the top body's centre [m]; step
        kinetic,         ///< 2 dt2 x the kinetic energy at the last step of a chunk [J s2]; step
        potential,       ///< dt2 x the energy of gravity and ties at the last step of a chunk [J s2]; step
        count
    };
};

/// Fields of a body's mechanisms (`spatial/mechanisms/`); present only with a model with mechanisms. All zero is
/// neutral.
struct OfBodyMechanisms {
    enum Field : int {
        tie_spring,  ///< tie: dt2 k / m
        tie_dashpot, ///< tie: dt c / m
        tie_pull,    ///< tie: dt2 f / m [m]
        tie_turning, ///< tie: dt c_r [kg m2]
        count
    };
};

/// Fields of a joint's mechanisms, in the joint's axes; as `OfBodyMechanisms`.
struct OfJointMechanisms {
    enum Field : int {
        friction_drop,              ///< stribeck: 1 - mu_d / mu_s
        per_stribeck_step,          ///< stribeck: 1 / (v_s dt) [1/m]
        wear,                       ///< friction_wear: k [1/m]
        adhesion,                   ///< adhesion: c [Pa]
        dowel_stiffness,            ///< dowel: k_d [N/m]
        per_dowel_stiffness,        ///< 1 / k_d, 0 without a dowel [m/N]
        dowel_yield,                ///< dowel: F_d [N]
        dowel_gap,                  ///< dowel: [m]
        face_share,                 ///< face_damping: share of the normal dashpot at the ends of the patch
        face_dashpot,               ///< face_damping: the most of each end, share C / (2 dt) [N/m]
        wedge,                      ///< wedge: vector part of the face's rotation, along the face (2)
        wedge_at = wedge + 2,       ///< the point about which it is turned, from the anchor (2) [m]
        broken = wedge_at + 2,      ///< adhesion: 1 once it has slipped or opened; step
        dowel_set,                  ///< where the dowel's play is centred (2) [m]; step
        dowel_at = dowel_set + 2,   ///< offset of the faces at the last step; 0 without a dowel (2) [m]; step
        dowel_force = dowel_at + 2, ///< on the upper body, against its offset, at the last step (2) [N]; step
        count = dowel_force + 2
    };
};

/// Fields of the mechanisms of a realization as a whole.
struct OfRealizationMechanisms {
    enum Field : int {
        joint_energy, ///< 2 x the work against dowels [J]; step
        tie_energy,   ///< 2 dt2 x the work against the dashpots of ties [J s2]; step
        tie_pending,  ///< what the last step's dashpots of ties add to it with the next step [J s2]; step
        count
    };
};

/// The second difference of the base's displacement in each step of a chunk [m], along x, y and z.
struct OfBaseX {
    enum Field : int { second, count };
};
struct OfBaseY {
    enum Field : int { second, count };
};
struct OfBaseZ {
    enum Field : int { second, count };
};

namespace detail {

struct WithMechanisms {
    template <class Number>
    static constexpr bool in(const Topology& topology)
    {
        return topology.model.mechanisms;
    }
};

/// The lists of the spatial model; the tables of the base's motion are the last of them.
template <class Number>
using SpatialRows =
    RowList<Number, FieldList<OfBody, RowOf::block>, FieldList<OfJoint, RowOf::joint>,
            FieldList<OfRealization, RowOf::realization>, FieldList<OfBodyMechanisms, RowOf::block, WithMechanisms>,
            FieldList<OfJointMechanisms, RowOf::joint, WithMechanisms>,
            FieldList<OfRealizationMechanisms, RowOf::realization, WithMechanisms>, FieldList<OfBaseX, RowOf::step>,
            FieldList<OfBaseY, RowOf::step>, FieldList<OfBaseZ, RowOf::step>>;

} // namespace detail

template <class Number>
struct BundleOf : detail::SpatialRows<Number> {
    /// (steps x bodies x OfBody::traced x lanes) where the step leaves the bodies' motion after each step of a run, so
    /// that lanes can be read at steps of their own without ending it; null: nowhere
    Number* trace = nullptr;
};

using Bundle = BundleOf<double>;

/// Registers that a bundle needs, each of `lanes` numbers; the three tables of the base's motion are the last of them.
template <class Number = double>
constexpr std::size_t bundle_registers(const Topology& topology)
{
    return BundleOf<Number>::registers(topology, [](RowOf) { return true; });
}

/// Lays a bundle out.
/// @param memory `bundle_registers` x lanes numbers, aligned to 64 bytes
template <class Number>
BundleOf<Number> bind_bundle(const Topology& topology, int lanes, Number* memory)
{
    BundleOf<Number> b;
    b.lanes = lanes;
    b.bind(topology, memory, [](RowOf) { return true; });
    return b;
}

/// The bundle as seen from one of its lanes, for a stepper of that lane alone (`Strided`): the rows begin at its place,
/// and are `lanes` numbers apart as before.
template <class Number>
constexpr BundleOf<Number> lane_of(BundleOf<Number> b, int lane)
{
    b.move_to_lane(lane);
    if (b.trace != nullptr)
        b.trace += lane;
    return b;
}

} // namespace stylobate::spatial
