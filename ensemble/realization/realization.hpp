#pragma once
/// One perturbed structure and its base motion: a pure function of (study, seed, index). Plain data, SI units.

#include "ensemble/model/realization.hpp"
#include "ensemble/realization/planar_structure.hpp"
#include "ensemble/realization/spatial_structure.hpp"

#include <cstdint>

namespace stylobate {

/// It has a structure in the plane, or one in space; the other one is empty.
struct Realization : RealizationHeader, PlanarStructure {
    SpatialStructure space{};

    bool spatial() const { return !space.solids.empty(); }
    /// Blocks that are stepped.
    std::uint64_t free_blocks() const { return spatial() ? space.free_solids() : PlanarStructure::free_blocks(); }
};

} // namespace stylobate
