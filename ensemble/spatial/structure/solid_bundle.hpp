#pragma once
/// A structure in space as the kernel sees it: which bodies meet at which joints, and the parameters of a realization
/// in its lane of a bundle.

#include "ensemble/realization/realization.hpp"
#include "kernels/spatial/bundle.hpp"

#include <vector>

namespace stylobate {

/// The topology that all realizations of a study share, with the lists that it refers to. The kernel numbers the fixed
/// bodies that carry something first, then the free ones in their order.
class SolidTopology {
public:
    /// @param pattern one of the realizations
    explicit SolidTopology(const SpatialStructure& pattern);
    SolidTopology(const SolidTopology&) = delete;
    SolidTopology& operator=(const SolidTopology&) = delete;

    const spatial::Topology& kernel() const { return topology_; }
    /// Kernel's body -> realization's solid.
    const std::vector<int>& order() const { return order_; }
    /// Realization's solid -> kernel's body, -1 for one that touches no free body.
    int place_of(std::size_t solid) const { return place_of_[solid]; }

private:
    std::vector<int> order_, place_of_;
    std::vector<spatial::TopologyJoint> joints_;
    std::vector<spatial::Axis> corrections_;
    std::vector<int> lists_;
    spatial::Topology topology_;
};

/// Writes a realization into a lane that is all zeros: all parameters of its bodies, joints and mechanisms, and the
/// reference state (upright, faces just touching, but for those that a wedge turns).
void store_solids(const Realization& realization, const SolidTopology& topology, const spatial::Bundle& bundle,
                  int lane);

} // namespace stylobate
