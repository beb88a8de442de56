#pragma once
/// In which order the rigid form eliminates the forces of the beds (`kernels/planar/rigid/rigid_step.hpp`): found once
/// for a topology.

#include "kernels/planar/topology.hpp"

#include <vector>

namespace stylobate {

struct RigidOrder {
    int edges = 0; ///< pairs of beds that share a free block, or become related by the elimination of others
    /// What the step reads:
    ///   of each edge        earlier bed, later bed, the shared block (-1: none), and whether that is the upper (1) or
    ///                       the lower one (-1) of the earlier and of the later bed
    ///   of each pivot       its bed, the number n of later beds that it is related to, these with their edges (n
    ///   pairs),
    ///                       and where their products go (n x n): -1 to a pivot, else twice an edge, and 1 more for the
    ///                       rows of the later bed
    ///   of each pivot       where it begins in this list, the last one first
    std::vector<int> list;
};

/// The bed with the fewest relations comes first; of several the last and the first one by turns. So a column is gone
/// through from both ends, without any further relation, and neighbours in the list do not wait for each other's
/// results.

RigidOrder rigid_order(const Topology& topology);

} // namespace stylobate
