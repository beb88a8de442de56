#pragma once
/// Solids in space on a sheet.

#include "io/plots/sheet.hpp"
#include "io/plots/solid_view.hpp"

#include <array>
#include <string>
#include <vector>

namespace stylobate {

/// Where a view lies on a sheet.
struct SheetPlace {
    double x = 0, y = 0;  ///< pixels of the view's origin
    double per_metre = 1; ///< pixels

    std::array<double, 2> of(const ViewPoint& p) const { return {x + p.x * per_metre, y - p.y * per_metre}; }
};

/// How a block is drawn.
enum class SolidLook { stone, lintel, fixed };

struct DrawnSolid {
    PlacedSolid solid;
    SolidLook look = SolidLook::stone;
    bool fallen = false; ///< its outline is red
};

/// Of a face or an outline, in the unit of the solids.
struct ShadedPolygon {
    std::vector<ViewPoint> points;
    std::string fill, line; ///< "#rrggbb"; "": none
    double line_width = 1;
};

/// The faces and outlines of solids, in the order in which they are painted: those in front over those behind.
std::vector<ShadedPolygon> shaded_solids(const std::vector<DrawnSolid>& solids, const SolidView& view);

/// `shaded_solids`, on a sheet.
void draw_solids(DrawingSheet& sheet, const std::vector<DrawnSolid>& solids, const SolidView& view,
                 const SheetPlace& place);

/// A rectangle of level ground. @param left, right along x, back, front along z [m], at the height 0
void draw_ground(DrawingSheet& sheet, double left, double right, double back, double front, const SolidView& view,
                 const SheetPlace& place);

/// The directions of the axes, as seen in a view. @param x, y pixels of their origin
void draw_axes(DrawingSheet& sheet, const SolidView& view, double x, double y);

} // namespace stylobate
