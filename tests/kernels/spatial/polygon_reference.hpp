#pragma once
/// Slow integrals over the patch of a polygon on a rectangle, strip by strip, and poses of one over the other.

#include "kernels/spatial/polygon_bed.hpp"
#include "tests/kernels/spatial/rotations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace stylobate::spatial {

/// Two faces, and where the upper one lies: tilt by `tilt` downwards in the direction `azimuth`, after a twist.
struct Scene {
    std::vector<double> x, y; ///< corners of the upper face [m]
    Rectangle<double> lower;
    double tilt, azimuth, twist, offset_x, offset_y;
    double depth; ///< of the deepest point of the upper face over the lower one [m]
};

/// Half of a plane: a x + b y + c > 0.
struct HalfPlane {
    double a, b, c;
};

/// Place of the upper face in double precision, with the depth of the scene.
struct Placed {
    Quaternion<double> q;
    Vector<double> place;
    std::vector<HalfPlane> sides; ///< of the upper face: inside, over the rectangle
    HalfPlane depth;              ///< below the lower face
};

/// The part of a polygon in a half plane, corner by corner (Sutherland and Hodgman 1974).
inline std::vector<std::array<double, 2>> part_of(const std::vector<std::array<double, 2>>& polygon, const HalfPlane& h)
{
    std::vector<std::array<double, 2>> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto& p = polygon[i];
        const auto& q = polygon[(i + 1) % polygon.size()];
        const double u = h.a * p[0] + h.b * p[1] + h.c, v = h.a * q[0] + h.b * q[1] + h.c;
        if (u > 0)
            part.push_back(p);
        if ((u > 0) != (v > 0))
            part.push_back({p[0] + u / (u - v) * (q[0] - p[0]), p[1] + u / (u - v) * (q[1] - p[1])});
    }
    return part;
}

/// @return no sides where the upper face is beside the lower one
inline Placed placed(const Scene& s)
{
    Placed p;
    p.q = product(rotation_by<double>(-s.tilt * std::sin(s.azimuth), s.tilt * std::cos(s.azimuth), 0),
                  rotation_by<double>(0, 0, s.twist));
    const Matrix<double> m = minus_identity(p.q);
    p.depth = {-m.m31, -m.m32, 0};
    const HalfPlane X{1 + m.m11, m.m12, s.offset_x - s.lower.centre_x},
        Y{m.m21, 1 + m.m22, s.offset_y - s.lower.centre_y};
    std::vector<HalfPlane> sides;
    for (const int sign : {-1, 1}) {
        sides.push_back({sign * X.a, sign * X.b, sign * X.c + s.lower.half_x});
        sides.push_back({sign * Y.a, sign * Y.b, sign * Y.c + s.lower.half_y});
    }
    std::vector<std::array<double, 2>> patch;
    for (std::size_t i = 0; i < s.x.size(); ++i)
        patch.push_back({s.x[i], s.y[i]});
    for (const HalfPlane& h : sides)
        patch = part_of(patch, h);
    double deepest = -1e300;
    for (const auto& c : patch)
        deepest = std::max(deepest, p.depth.a * c[0] + p.depth.b * c[1]);
    p.depth.c = s.depth - deepest;
    p.place = {s.offset_x, s.offset_y, -p.depth.c};
    if (patch.size() < 3)
        return p;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        const std::size_t j = (i + 1) % s.x.size();
        const double ex = s.x[j] - s.x[i], ey = s.y[j] - s.y[i];
        sides.push_back({-ey, ex, ey * s.x[i] - ex * s.y[i]});
    }
    p.sides = sides;
    return p;
}

/// What is integrated.
struct PatchSums {
    double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    double pressure = 0, moment_x = 0, moment_y = 0, polar = 0; ///< with the weight depth
    double energy = 0;                                          ///< with half the depth's square
};

/// Integrates over the patch: `add(x, y, d, w)` is called with points of the upper face, their depths and their weights
/// [m2]. The midpoint rule over `strips` strips; along each, Gauss' rule of three points between the ends that the half
/// planes leave of it. The strips run at 0.5 rad to the axes, so that no side of the patch lies along them.
template <class Add>
void integrate(const Scene& s, const Placed& p, int strips, const Add& add)
{
    const double cosine = std::cos(0.5), sine = std::sin(0.5);
    std::vector<HalfPlane> sides = p.sides;
    sides.push_back(p.depth);
    std::vector<std::array<double, 2>> patch;
    for (std::size_t i = 0; i < s.x.size(); ++i)
        patch.push_back({s.x[i], s.y[i]});
    for (const HalfPlane& h : sides)
        patch = part_of(patch, h);
    double low = 1e300, high = -1e300; // only to place the strips
    for (const auto& c : patch) {
        const double across = cosine * c[1] - sine * c[0];
        low = std::min(low, across), high = std::max(high, across);
    }
    for (int i = 0; i < strips; ++i) {
        const double width = (high - low) / strips, across = low + (i + 0.5) * width;
        double from = -1e9, to = 1e9; // along the strip
        for (const HalfPlane& h : sides) {
            const double a = cosine * h.a + sine * h.b, c = (cosine * h.b - sine * h.a) * across + h.c;
            if (a > 0)
                from = std::max(from, -c / a);
            else if (a < 0)
                to = std::min(to, -c / a);
        }
        for (int point = -1; point <= 1 && to > from; ++point) {
            const double along = 0.5 * (from + to) + 0.5 * (to - from) * std::sqrt(0.6) * point;
            const double x = cosine * along - sine * across, y = sine * along + cosine * across;
            add(x, y, p.depth.a * x + p.depth.b * y + p.depth.c,
                width * (to - from) * (point == 0 ? 8.0 / 18 : 5.0 / 18));
        }
    }
}

/// Integrals over the patch, on the upper face, about its anchor.
inline PatchSums patch_sums(const Scene& s, const Placed& p, int strips)
{
    PatchSums sum;
    integrate(s, p, strips, [&](double x, double y, double d, double w) {
        sum.area += w, sum.x += w * x, sum.y += w * y;
        sum.xx += w * x * x, sum.xy += w * x * y, sum.yy += w * y * y;
        sum.pressure += w * d, sum.moment_x += w * d * x, sum.moment_y += w * d * y;
        sum.polar += w * d * (x * x + y * y), sum.energy += 0.5 * w * d * d;
    });
    return sum;
}

} // namespace stylobate::spatial
