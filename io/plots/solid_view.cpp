#include "io/plots/solid_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace stylobate {
namespace {

/// Twice the area of a triangle, > 0 where its corners are counter-clockwise.
double turn(const ViewPoint& a, const ViewPoint& b, const ViewPoint& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area(const std::vector<ViewPoint>& polygon)
{
    double twice = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        twice += turn(polygon[0], polygon[i - 1], polygon[i]);
    return twice / 2;
}

/// The convex outline of points, counter-clockwise (Andrew 1979).
std::vector<ViewPoint> convex_outline(std::vector<ViewPoint> points)
{
    std::ranges::sort(points,
                      [](const ViewPoint& a, const ViewPoint& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
    std::vector<ViewPoint> outline;
    for (int half = 0; half < 2; ++half) {
        const std::size_t first = outline.size();
        for (const ViewPoint& p : points) {
            while (outline.size() >= first + 2 && turn(outline[outline.size() - 2], outline.back(), p) <= 0)
                outline.pop_back();
            outline.push_back(p);
        }
        outline.pop_back(); // it begins the other half
        std::ranges::reverse(points);
    }
    return outline;
}

/// The part of a convex polygon that lies in another one (Sutherland and Hodgman 1974).
std::vector<ViewPoint> common_part(std::vector<ViewPoint> part, const std::vector<ViewPoint>& other)
{
    for (std::size_t i = 0; i < other.size() && part.size() > 2; ++i) {
        const ViewPoint &a = other[i], &b = other[(i + 1) % other.size()];
        std::vector<ViewPoint> kept;
        for (std::size_t k = 0; k < part.size(); ++k) {
            const ViewPoint &p = part[k], &q = part[(k + 1) % part.size()];
            const double u = turn(a, b, p), v = turn(a, b, q);
            if (u >= 0)
                kept.push_back(p);
            if ((u >= 0) != (v >= 0))
                kept.push_back({p.x + (q.x - p.x) * u / (u - v), p.y + (q.y - p.y) * u / (u - v)});
        }
        part = std::move(kept);
    }
    return part;
}

constexpr double edge_on = 1e-9; ///< of a unit normal towards the viewer: below it a face is not seen

struct Plane {
    SpacePoint at{}, normal{}; ///< in the viewer's frame; outwards, of length 1
};

/// A solid, and what decides on the order.
struct Appearance {
    SeenSolid seen;
    std::vector<Plane> planes; ///< of all faces
    double depth = 0;          ///< of its middle, towards the viewer
    double area = 0;
    double left = 0, right = 0, low = 0, high = 0;

    /// The middle of what a line of sight passes through.
    double depth_at(const ViewPoint& p) const
    {
        double front = std::numeric_limits<double>::infinity(), back = -front;
        for (const auto& [at, normal] : planes) {
            if (std::fabs(normal[2]) < edge_on)
                continue;
            const double here = at[2] - (normal[0] * (p.x - at[0]) + normal[1] * (p.y - at[1])) / normal[2];
            if (normal[2] > 0)
                front = std::min(front, here);
            else
                back = std::max(back, here);
        }
        return (front + back) / 2;
    }
};

/// Of a face whose corners may lie on one line, or not quite in one plane: through their middle, with the normal by
/// Newell's method (Sutherland, Sproull and Schumacker 1974).
Plane plane_of(const std::vector<std::size_t>& face, const std::vector<SpacePoint>& corners)
{
    Plane plane;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const SpacePoint &a = corners[face[i]], &b = corners[face[(i + 1) % face.size()]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
            plane.normal[k] += (a[u] - b[u]) * (a[v] + b[v]);
            plane.at[k] += a[k] / static_cast<double>(face.size());
        }
    }
    const double length = std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]);
    for (double& part : plane.normal)
        part /= length > 0 ? length : 1;
    return plane;
}

double brightness(const SpacePoint& normal)
{
    constexpr SpacePoint light = {-0.359, 0.619, 0.699}; // of length 1
    return 0.62 + 0.38 * std::max(0.0, normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2]);
}

Appearance appearance_of(const PlacedSolid& solid, std::size_t body, const SolidView& view)
{
    Appearance a;
    a.seen.body = body;
    std::vector<SpacePoint> corners = solid.corners();
    std::vector<ViewPoint> flat;
    for (SpacePoint& corner : corners) {
        corner = view.seen(corner);
        flat.push_back({corner[0], corner[1]});
    }
    const std::vector<std::vector<std::size_t>> faces = solid.faces();
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Plane plane = plane_of(faces[f], corners);
        a.planes.push_back(plane);
        if (plane.normal[2] < edge_on)
            continue;
        SeenFace face{{}, brightness(plane.normal), solid.shape.round && f > 1};
        for (const std::size_t corner : faces[f])
            face.points.push_back(flat[corner]);
        a.seen.faces.push_back(std::move(face));
    }
    a.seen.outline = convex_outline(std::move(flat));
    a.area = area(a.seen.outline);
    a.depth = view.seen(solid.middle)[2];
    const auto [left, right] = std::ranges::minmax(a.seen.outline, {}, &ViewPoint::x);
    const auto [low, high] = std::ranges::minmax(a.seen.outline, {}, &ViewPoint::y);
    a.left = left.x;
    a.right = right.x;
    a.low = low.y;
    a.high = high.y;
    return a;
}

/// Whether one solid hides a part of another one (true), or the other one a part of it (false).
std::optional<bool> hides(const Appearance& a, const Appearance& b)
{
    if (a.left >= b.right || b.left >= a.right || a.low >= b.high || b.low >= a.high)
        return std::nullopt;
    const std::vector<ViewPoint> both = common_part(a.seen.outline, b.seen.outline);
    constexpr double touching = 1e-4; // of the smaller outline: springs of contacts are short
    if (both.size() < 3 || area(both) < touching * std::min(a.area, b.area))
        return std::nullopt;
    ViewPoint middle;
    for (const ViewPoint& p : both) {
        middle.x += p.x / static_cast<double>(both.size());
        middle.y += p.y / static_cast<double>(both.size());
    }
    return a.depth_at(middle) > b.depth_at(middle);
}

} // namespace

SolidView SolidView::side()
{
    return {std::numbers::pi / 2, 0};
}

SolidView SolidView::above()
{
    return {0, std::numbers::pi / 2};
}

SpacePoint SolidView::seen(const SpacePoint& p) const
{
    const double ca = std::cos(azimuth_rad), sa = std::sin(azimuth_rad);
    const double ce = std::cos(elevation_rad), se = std::sin(elevation_rad);
    const double right = ca * p[0] - sa * p[2], near = sa * p[0] + ca * p[2]; // both level
    return {right, ce * p[1] - se * near, se * p[1] + ce * near};
}

std::vector<SeenSolid> painted(const std::vector<PlacedSolid>& solids, const SolidView& view)
{
    const std::size_t count = solids.size();
    std::vector<Appearance> all;
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(appearance_of(solids[i], i, view));
    std::vector<std::vector<std::size_t>> hiding(count); // those that hide a part of it
    std::vector<std::size_t> waits(count, 0);            // number of those that it hides a part of and that are left
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = i + 1; k < count; ++k)
            if (const std::optional<bool> first = hides(all[i], all[k])) {
                hiding[*first ? k : i].push_back(*first ? i : k);
                ++waits[*first ? i : k];
            }
    std::vector<SeenSolid> order;
    std::vector<bool> done(count, false);
    while (order.size() < count) {
        std::optional<std::size_t> next;
        for (std::size_t i = 0; i < count; ++i) {
            if (done[i])
                continue;
            const auto rank = [&](std::size_t k) { return std::pair(waits[k] > 0, all[k].depth); };
            if (!next || rank(i) < rank(*next))
                next = i;
        }
        done[*next] = true;
        for (const std::size_t front : hiding[*next])
            --waits[front];
        order.push_back(std::move(all[*next].seen));
    }
    return order;
}

} // namespace stylobate
