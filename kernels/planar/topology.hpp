#pragma once
/// Which blocks meet at which joints: a list, so that a column, a colonnade and a heap are the same to the kernel.
///
/// The list begins with the beds, on which blocks lie at rest: they are evaluated in every step. They are followed by
/// the watched pairs, blocks that share no bed but may meet: they are evaluated only while they are close.

#include "kernels/planar/step_model.hpp"
#include "kernels/row_list.hpp"

namespace stylobate {

struct TopologyJoint {
    int lower = 0; ///< the overlap is described in this block's frame
    int upper = 0;
};

/// Numbers of an edge in `Topology::rigid_order`.
inline constexpr int rigid_edge_numbers = 5;

/// Blocks are numbered with the fixed ones first: they move with the base, and are not stepped.
/// A view: the joints belong to the caller. (No container here: what is compiled for one instruction set must not
/// leak into functions that others share.)
struct Topology {
    int blocks = 0;
    int fixed = 0; ///< blocks 0 .. fixed - 1
    int top = 0;   ///< block whose displacement is followed
    int joints = 0;
    const TopologyJoint* joint = nullptr; ///< (joints)
    int watched = 0;                      ///< number of joints, the last ones, that are watched pairs
    StepModel model{};                    ///< which step is run, and whether the bundle has the mechanisms' rows
    const int* bed_lists = nullptr;       ///< (`bed_lists_size`) what `list_beds` makes, and the clamped blocks
    bool stack = false; ///< the beds are those of one column: bed j lies between block fixed - 1 + j and the next one
    const int* rigid_order = nullptr; ///< of the rigid form: what `rigid_order` makes (`rigid_order.hpp`)
    int rigid_edges = 0;              ///< and the pairs of beds in it
    constexpr int beds() const { return joints - watched; }
    /// How many rows a list of fields has.
    constexpr int rows(RowOf of) const
    {
        return of == RowOf::block   ? blocks
               : of == RowOf::joint ? joints
               : of == RowOf::edge  ? rigid_edges
               : of == RowOf::step  ? chunk_steps
                                    : 1;
    }
    constexpr int free_blocks() const { return blocks - fixed; }
    /// (strengthened) The block that a clamp joins to block i, at its right; -1: none.
    constexpr int clamped_to(int i) const { return bed_lists[blocks + 1 + 2 * beds() + i]; }
};

/// How many integers `list_beds` writes.
inline int bed_lists_size(const Topology& topology)
{
    return topology.blocks + 1 + 2 * topology.beds() + (topology.model.strengthened ? topology.blocks : 0);
}

/// Sees whether the beds are a stack, and lists the beds of every block, for the sum of its forces: those of block i
/// are entries lists[i] to lists[i + 1] - 1, in the order of the joints; an entry is twice the bed's number, and one
/// more where the block is its lower one. With a strengthened model the blocks that clamps join follow, all -1 at
/// first.
/// @param lists (`bed_lists_size`) the caller's, to live as long as the topology
inline void list_beds(Topology& topology, int* lists)
{
    topology.stack = topology.free_blocks() == topology.beds() && topology.fixed > 0 &&
                     (topology.fixed == 1 || topology.watched > 0);
    for (int bed = 0; bed < topology.beds(); ++bed)
        topology.stack &=
            topology.joint[bed].lower == topology.fixed - 1 + bed && topology.joint[bed].upper == topology.fixed + bed;
    int at = topology.blocks + 1;
    for (int i = 0; i < topology.blocks; ++i) {
        lists[i] = at;
        for (int bed = 0; bed < topology.beds(); ++bed)
            if (topology.joint[bed].upper == i || topology.joint[bed].lower == i)
                lists[at++] = 2 * bed + (topology.joint[bed].lower == i);
    }
    lists[topology.blocks] = at;
    while (at < bed_lists_size(topology))
        lists[at++] = -1;
    topology.bed_lists = lists;
}

} // namespace stylobate
