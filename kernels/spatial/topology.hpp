#pragma once
/// Which bodies meet at which joints: a list, so that a column and a colonnade are the same to the kernel. It is the
/// same for all realizations of a bundle.

#include "kernels/row_list.hpp"
#include "kernels/spatial/rotation.hpp"

namespace stylobate::spatial {

/// The law of a bed: which faces it joins.
enum class BedKind {
    disc,      ///< disc on disc
    rectangle, ///< rectangle on rectangle
    round      ///< disc, as a regular polygon of 16 corners, on a rectangle
};

struct TopologyJoint {
    int lower = 0; ///< the bed is described in this body's frame
    int upper = 0;
    BedKind kind = BedKind::disc;
    Axis normal = Axis::y; ///< of the lower body's face: a bed has y, a butt joint x or z
    /// The normal points along the axis in the opposite direction: where a round block carries a beam, the beam's face
    /// is the `lower` one, as the law asks, although it lies above.
    bool reversed = false;
    bool hollow = false; ///< only a ring of the faces bears (`OfJoint::inner_ratio`); a ratio of 0 is neutral
};

/// Which step runs a bundle, and which rows it has.
struct StepModel {
    bool mechanisms = false; ///< a mechanism of a joint or a body (`mechanisms/`) may be other than neutral
    friend bool operator==(const StepModel&, const StepModel&) = default;
};

/// Bodies are numbered with the fixed ones first: they move with the base, and are not stepped.
/// A view: the lists belong to the caller. (No container here: what is compiled for one instruction set must not leak
/// into functions that others share.)
struct Topology {
    int bodies = 0;
    int fixed = 0; ///< bodies 0 .. fixed - 1
    int top = 0;   ///< body whose displacement is followed
    int joints = 0;
    const TopologyJoint* joint = nullptr; ///< (joints)
    const Axis* correction = nullptr;     ///< (bodies) `correction_axis` of each
    const int* joint_lists = nullptr;     ///< (`joint_lists_size`) what `list_joints` makes
    StepModel model{};
    /// How many rows a list of fields has.
    constexpr int rows(RowOf of) const
    {
        return of == RowOf::block   ? bodies
               : of == RowOf::joint ? joints
               : of == RowOf::edge  ? 0
               : of == RowOf::step  ? chunk_steps
                                    : 1;
    }
    constexpr int free_bodies() const { return bodies - fixed; }
};

/// How many integers `list_joints` writes.
inline int joint_lists_size(const Topology& topology)
{
    return topology.bodies + 1 + 2 * topology.joints;
}

/// Lists the joints of every body, for the sum of its forces: those of body i are entries lists[i] to lists[i + 1] - 1,
/// in the order of the joints; an entry is twice the joint's number, and one more where the body is its lower one.
/// @param lists (`joint_lists_size`) the caller's, to live as long as the topology
inline void list_joints(Topology& topology, int* lists)
{
    int at = topology.bodies + 1;
    for (int i = 0; i < topology.bodies; ++i) {
        lists[i] = at;
        for (int j = 0; j < topology.joints; ++j)
            if (topology.joint[j].upper == i || topology.joint[j].lower == i)
                lists[at++] = 2 * j + (topology.joint[j].lower == i);
    }
    lists[topology.bodies] = at;
    topology.joint_lists = lists;
}

} // namespace stylobate::spatial
