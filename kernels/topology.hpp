#pragma once
/// Which blocks meet at which joints: a list, so that a column, a colonnade and a heap are the same to the kernel.
///
/// The list begins with the beds, on which blocks lie at rest: they are worked on in every step. Behind them come the
/// watched pairs, blocks that lie on no common bed but may meet: they are worked on only while they are close.

#include "kernels/model.hpp"

namespace stylobate {

struct TopologyJoint {
    int lower = 0; ///< the overlap is described in this block's frame
    int upper = 0;
};

/// Blocks are numbered with the fixed ones first: they ride on the base, and are not stepped.
/// A view: the joints belong to the caller. (No container here: what is compiled for one instruction set must not
/// leak into functions that others share.)
struct Topology {
    int blocks = 0;
    int fixed = 0; ///< blocks 0 .. fixed - 1
    int top = 0;   ///< block whose displacement is followed
    int joints = 0;
    const TopologyJoint* joint = nullptr; ///< (joints)
    int watched = 0;                      ///< so many of the joints, the last ones, are watched pairs
    Model model{};                        ///< which step is run, and whether the bundle has the extensions' rows
    int beds() const { return joints - watched; }
    int free_blocks() const { return blocks - fixed; }
};

} // namespace stylobate
