#include "io/plots/solid_sheet.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace stylobate {
namespace {

/// "#rrggbb", darker.
std::string shaded(int rgb, double brightness)
{
    const auto part = [&](int shift) { return std::lround(((rgb >> shift) & 255) * brightness); };
    return fmt::format("#{:02x}{:02x}{:02x}", part(16), part(8), part(0));
}

} // namespace

std::vector<ShadedPolygon> shaded_solids(const std::vector<DrawnSolid>& solids, const SolidView& view)
{
    std::vector<PlacedSolid> placed;
    for (const DrawnSolid& each : solids)
        placed.push_back(each.solid);
    std::vector<ShadedPolygon> polygons;
    for (SeenSolid& seen : painted(placed, view)) {
        const DrawnSolid& each = solids[seen.body];
        const int colour = each.look == SolidLook::fixed    ? 0xa89a7d
                           : each.look == SolidLook::lintel ? 0xb9cddb
                                                            : 0xead9b5;
        const char* edge = each.fallen ? "#c0271b" : each.look == SolidLook::lintel ? "#27475c" : "#4a3b24";
        for (SeenFace& face : seen.faces) {
            const std::string fill = shaded(colour, face.brightness);
            // a border in the colour of the face: no light comes between two of them
            polygons.push_back({std::move(face.points), fill, face.smooth ? fill : edge, 0.5});
        }
        polygons.push_back({std::move(seen.outline), "", edge, each.fallen ? 1.0 : 0.7});
    }
    return polygons;
}

void draw_solids(DrawingSheet& sheet, const std::vector<DrawnSolid>& solids, const SolidView& view,
                 const SheetPlace& place)
{
    for (const ShadedPolygon& polygon : shaded_solids(solids, view)) {
        std::vector<std::array<double, 2>> on_sheet;
        for (const ViewPoint& point : polygon.points)
            on_sheet.push_back(place.of(point));
        sheet.polygon(on_sheet, polygon.fill, polygon.line, 2 * polygon.line_width);
    }
}

void draw_ground(DrawingSheet& sheet, double left, double right, double back, double front, const SolidView& view,
                 const SheetPlace& place)
{
    std::vector<std::array<double, 2>> corners;
    for (const auto& [x, z] : {std::pair(left, front), {right, front}, {right, back}, {left, back}})
        corners.push_back(place.of(view.place({x, 0, z})));
    sheet.polygon(corners, "#d9dde1", "#9aa1a8", 1);
}

void draw_axes(DrawingSheet& sheet, const SolidView& view, double x, double y)
{
    constexpr double length = 34, letter = 18;
    for (const auto& [name, axis] :
         {std::pair<const char*, SpacePoint>{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}}) {
        const ViewPoint to = view.place(axis);
        const double seen = std::hypot(to.x, to.y);
        if (seen < 0.25)
            continue;
        sheet.line(x, y, x + to.x * length, y - to.y * length, "#303030", 2);
        const double far = length + letter / seen;
        sheet.text(name, x + to.x * far, y - to.y * far, letter);
    }
}

} // namespace stylobate
