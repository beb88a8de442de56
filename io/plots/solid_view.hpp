#pragma once
/// Solids in space as a viewer far away sees them: their visible faces, in the order in which they are painted.

#include "ensemble/spatial/placed_solid.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

/// To the right and upwards, in the unit of the solids.
struct ViewPoint {
    double x = 0, y = 0;
};

/// Who looks at the scene; parallel lines stay parallel.
struct SolidView {
    double azimuth_rad = 0;   ///< from z towards x. 0: x is to the right; a quarter of a turn: z is to the left
    double elevation_rad = 0; ///< 0: level; a quarter of a turn: straight from above, x to the right and z downwards

    static SolidView front() { return {}; }
    static SolidView side();
    static SolidView above();
    static SolidView oblique() { return {0.52, 0.35}; }

    /// To the right, upwards, and towards the viewer.
    SpacePoint seen(const SpacePoint& p) const;
    ViewPoint place(const SpacePoint& p) const
    {
        const SpacePoint at = seen(p);
        return {at[0], at[1]};
    }
};

struct SeenFace {
    std::vector<ViewPoint> points; ///< counter-clockwise
    double brightness = 1;         ///< in (0, 1]: the light comes from the upper left of the viewer
    bool smooth = false;           ///< a side of a drum: it has no edges of its own
};

struct SeenSolid {
    std::size_t body = 0;        ///< its place in the list
    std::vector<SeenFace> faces; ///< those that look at the viewer
    std::vector<ViewPoint> outline;
};

/// The solids back to front: each after all those that it hides a part of. One line of sight through two solids decides
/// which of them hides the other one: a plane separates convex solids that do not overlap, so that all such lines meet
/// them in the same order. Where three or more hide each other in turn there is no such order; then the farthest comes
/// first.
/// @param solids that do not overlap but for the short springs of contacts; each is finite and has a volume
std::vector<SeenSolid> painted(const std::vector<PlacedSolid>& solids, const SolidView& view);

} // namespace stylobate
