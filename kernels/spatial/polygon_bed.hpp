#pragma once
/// The bed of a convex polygon on a rectangle, in closed form: the upper face of n corners (a rectangle, or a regular
/// polygon in the place of a disc) on the rectangular lower face. THEORY.md derives it.
///
/// The patch is the part of the upper face that is deeper than 0 and lies over the rectangle. Depth and place over the
/// rectangle are linear on the upper face, so the patch is a polygon. Its outline consists of
///
///   1. the edges of the upper face, cut at depth 0, and the line of depth 0 that closes them;
///      each of these pieces is cut by the four lines on which the sides of the rectangle lie;
///   2. on each of the four lines the part between the points where outline 1 leaves and enters, cut by the other
///   sides.
///
/// The integrals over the patch are sums over the pieces of this outline (Green's theorem). On which side of a line a
/// point lies is decided once for each point, and both pieces that meet there use it: the pieces then close for any
/// input. Faces that are flush up to rounding need this: their common edge counts once, as part of 1 or as part of 2.
///
/// The force across the normal comes from the sides of the rectangle: a patch that ends there changes in size when the
/// upper face moves. The patch's other ends move with the upper face, or have depth 0.

#include "kernels/spatial/bed.hpp"

namespace stylobate::spatial {

/// A rectangle along the joint's axes, in the plane of its face [m]. The coordinates have their origin in the face's
/// anchor. (In a joint with the normal y, the joint's axes x and y are the body's axes z and x.)
template <class Real>
struct Rectangle {
    Real centre_x, centre_y;
    Real half_x, half_y;
};

/// A convex polygon in the plane of its face, counter-clockwise about the joint's normal, from the face's anchor [m].
template <class Real, int corners>
struct Polygon {
    Real x[corners], y[corners];
};

/// @pre half sizes > 0
template <class Real, int corners>
struct PolygonBed {
    Real stiffness;               ///< k [N/m3]
    Polygon<Real, corners> upper; ///< from the anchor of the upper face
    Rectangle<Real> lower;        ///< from the anchor of the lower face
};

template <class Real>
STYLOBATE_INLINE Polygon<Real, 4> polygon_of(const Rectangle<Real>& r)
{
    const Real left = r.centre_x - r.half_x, right = r.centre_x + r.half_x;
    const Real low = r.centre_y - r.half_y, high = r.centre_y + r.half_y;
    return {{left, right, right, left}, {low, low, high, high}};
}

/// A regular polygon of 16 corners on the circle of the radius given; no corner lies on an axis.
template <class Real>
STYLOBATE_INLINE Polygon<Real, 16> sixteen_corners(Real centre_x, Real centre_y, Real radius)
{
    // cosines of pi/16, 3 pi/16, 5 pi/16, 7 pi/16: backwards they are the sines
    const double cosines[4] = {0.98078528040323044913, 0.83146961230254523708, 0.55557023301960222474,
                               0.19509032201612826785};
    Polygon<Real, 16> p;
    for (int i = 0; i < 4; ++i) {
        const Real x = radius * Real(cosines[i]), y = radius * Real(cosines[3 - i]);
        p.x[i] = centre_x + x, p.y[i] = centre_y + y;
        p.x[i + 4] = centre_x - y, p.y[i + 4] = centre_y + x;
        p.x[i + 8] = centre_x - x, p.y[i + 8] = centre_y - y;
        p.x[i + 12] = centre_x + y, p.y[i + 12] = centre_y - x;
    }
    return p;
}

namespace detail {

/// A point of the upper face: from the origin of the integrals on that face, and from the centre of the rectangle in
/// the joint's frame [m].
template <class Real>
struct FacePoint {
    Real x, y;
    Real X, Y;
};

template <class Real>
STYLOBATE_INLINE FacePoint<Real> between(const FacePoint<Real>& a, const FacePoint<Real>& b, Real t)
{
    return {fma(t, b.x - a.x, a.x), fma(t, b.y - a.y, a.y), fma(t, b.X - a.X, a.X), fma(t, b.Y - a.Y, a.Y)};
}

template <class Real, class Mask>
STYLOBATE_INLINE FacePoint<Real> select_point(Mask mask, const FacePoint<Real>& yes, const FacePoint<Real>& no)
{
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.X, no.X), select(mask, yes.Y, no.Y)};
}

/// Gauss' rule of two points on the unit interval has the points g and 1 - g.
template <class Real>
STYLOBATE_INLINE Real gauss_point()
{
    return Real(0.21132486540518711775);
}

/// Moments of the patch about the origin, up to the third: the sums of the triangles from the origin to the pieces of
/// the outline. `finish` multiplies by the common factors.
template <class Real>
struct PatchMoments {
    Real area, x, y, xx, xy, yy;
    Real cubic_x, cubic_y; ///< of p |p|^2

    STYLOBATE_INLINE void add(Real x1, Real y1, Real x2, Real y2)
    {
        const Real g = gauss_point<Real>(), ex = x2 - x1, ey = y2 - y1;
        const Real twice = fms(x1, ey, y1 * ex); // 0 to the bit for a piece without length
        const Real ax = fma(g, ex, x1), ay = fma(g, ey, y1), bx = fnma(g, ex, x2), by = fnma(g, ey, y2);
        const Real axx = ax * ax, ayy = ay * ay, bxx = bx * bx, byy = by * by;
        const Real a2 = axx + ayy, b2 = bxx + byy;
        area = area + twice;
        x = fma(twice, x1 + x2, x);
        y = fma(twice, y1 + y2, y);
        xx = fma(twice, axx + bxx, xx);
        xy = fma(twice, fma(ax, ay, bx * by), xy);
        yy = fma(twice, ayy + byy, yy);
        cubic_x = fma(twice, fma(ax, a2, bx * b2), cubic_x);
        cubic_y = fma(twice, fma(ay, a2, by * b2), cubic_y);
    }

    STYLOBATE_INLINE PatchMoments finish() const
    {
        const Real half = Real(0.5), sixth = Real(1.0 / 6), eighth = Real(0.125), tenth = Real(0.1);
        return {half * area, sixth * x,   sixth * y,       eighth * xx,
                eighth * xy, eighth * yy, tenth * cubic_x, tenth * cubic_y};
    }
};

/// Where the outline leaves and enters the inner side of a line: coordinates along the line.
template <class Real>
struct Crossing {
    Real leave, enter;
};

/// Crossings of the lines of the rectangle's four sides.
template <class Real>
struct Crossings {
    Crossing<Real> low_x, high_x, low_y, high_y;
};

/// The part of a piece that remains, from 0 to 1 along the piece.
template <class Real>
struct Part {
    Real begin, end;
};

/// Cuts a piece by one line.
/// @param from, to  distances of the ends from the line, > 0 inside
/// @param per_run   1 / (from - to); any number where the ends are equal
/// @param along, run  coordinate along the line at the beginning, and its growth over the piece
template <class Real>
STYLOBATE_INLINE void cut(Real from, Real to, Real per_run, Real along, Real run, Part<Real>& part, Crossing<Real>& c)
{
    const Real zero(0.0), one(1.0);
    const auto from_in = from > zero, to_in = to > zero;
    const Real t = clamp(from * per_run, zero, one);
    const Real place = fma(t, run, along);
    c.leave = select(from_in & !to_in, place, c.leave);
    c.enter = select(to_in & !from_in, place, c.enter);
    part.begin = max_of(part.begin, select(from_in, zero, select(to_in, t, one)));
    part.end = min_of(part.end, select(to_in, one, select(from_in, t, zero)));
}

/// Adds the part of a piece of the outline that lies over the rectangle, and notes where it crosses the four lines.
template <class Real>
STYLOBATE_INLINE void clip_piece(const FacePoint<Real>& from, const FacePoint<Real>& to, const Rectangle<Real>& lower,
                                 Crossings<Real>& crossings, PatchMoments<Real>& patch)
{
    const Real zero(0.0), one(1.0), tiny = Real(Extreme<NumberOf<Real>>::tiny);
    const Real run_X = to.X - from.X, run_Y = to.Y - from.Y;
    const Real per_X = one / select(abs_of(run_X) > tiny, run_X, one);
    const Real per_Y = one / select(abs_of(run_Y) > tiny, run_Y, one);
    Part<Real> part{zero, one};
    cut(lower.half_x + from.X, lower.half_x + to.X, zero - per_X, from.Y, run_Y, part, crossings.low_x);
    cut(lower.half_x - from.X, lower.half_x - to.X, per_X, from.Y, run_Y, part, crossings.high_x);
    cut(lower.half_y + from.Y, lower.half_y + to.Y, zero - per_Y, from.X, run_X, part, crossings.low_y);
    cut(lower.half_y - from.Y, lower.half_y - to.Y, per_Y, from.X, run_X, part, crossings.high_y);
    const Real end = max_of(part.begin, part.end);
    const Real ex = to.x - from.x, ey = to.y - from.y;
    patch.add(fma(part.begin, ex, from.x), fma(part.begin, ey, from.y), fma(end, ex, from.x), fma(end, ey, from.y));
}

/// Adds the outline's pieces on the upper face: edges cut at depth 0, and the line of depth 0.
/// @param depth of the corners [m]
template <class Real, int corners>
STYLOBATE_INLINE void clip_outline(const FacePoint<Real> (&corner)[corners], const Real (&depth)[corners],
                                   const Rectangle<Real>& lower, Crossings<Real>& crossings, PatchMoments<Real>& patch)
{
    const Real zero(0.0), one(1.0), tiny = Real(Extreme<NumberOf<Real>>::tiny);
    FacePoint<Real> leave{zero, zero, zero, zero}, enter = leave; // where the outline emerges and sinks in
    for (int i = 0; i < corners; ++i) {
        const int next = i + 1 == corners ? 0 : i + 1;
        const auto deep = depth[i] > zero, next_deep = depth[next] > zero;
        const Real fall = depth[i] - depth[next];
        const Real t = clamp(depth[i] / select(abs_of(fall) > tiny, fall, one), zero, one);
        const FacePoint<Real> flat = between(corner[i], corner[next], t);
        leave = select_point(deep & !next_deep, flat, leave);
        enter = select_point(next_deep & !deep, flat, enter);
        // an edge above the lower face becomes one point: it adds nothing and crosses nothing
        clip_piece(select_point(deep, corner[i], flat), select_point(next_deep, corner[next], flat), lower, crossings,
                   patch);
    }
    clip_piece(leave, enter, lower, crossings, patch);
}

/// How the upper face lies over the lower one.
template <class Real>
struct FaceMap {
    Real t11, t12, t21, t22; ///< from the upper face to the joint's frame
    Real per_area;           ///< area of the upper face per area of the lower one below it, 1 / (t11 t22 - t12 t21)
    Real slope_x, slope_y;   ///< growth of the depth on the upper face
    Real depth;              ///< at the anchor [m]
    Real shift_x, shift_y;   ///< from the anchor of the upper face to the centre of the rectangle [m]
    Real origin_x, origin_y; ///< of the integrals, on the upper face [m]
};

/// Elastic force of the rectangle's sides, and its torque about P.
template <class Real>
struct SideForce {
    Real x, y;
    Vector<Real> torque;
};

/// Adds the piece of the outline on the line of one side, and the side's force on the upper body: outwards, k d^2 / 2
/// per length of the upper face's shadow.
/// @param limit   coordinate of the side, from the centre of the rectangle [m]; its sign is that of the outward normal
/// @param reach   half the side's length [m]
template <bool across_x, class Real>
STYLOBATE_INLINE void add_side(const FaceMap<Real>& map, Real k, Real limit, Real reach, const Crossing<Real>& crossing,
                               PatchMoments<Real>& patch, SideForce<Real>& force)
{
    const Real zero(0.0), one(1.0), least = zero - reach;
    const Real w1 = clamp(crossing.leave, least, reach), w2 = clamp(crossing.enter, least, reach);
    // ends in the joint's frame and on the upper face, both from P
    const Real X1 = map.shift_x + (across_x ? limit : w1), Y1 = map.shift_y + (across_x ? w1 : limit);
    const Real X2 = map.shift_x + (across_x ? limit : w2), Y2 = map.shift_y + (across_x ? w2 : limit);
    const Real x1 = map.per_area * fms(map.t22, X1, map.t12 * Y1), y1 = map.per_area * fms(map.t11, Y1, map.t21 * X1);
    const Real x2 = map.per_area * fms(map.t22, X2, map.t12 * Y2), y2 = map.per_area * fms(map.t11, Y2, map.t21 * X2);
    patch.add(x1 - map.origin_x, y1 - map.origin_y, x2 - map.origin_x, y2 - map.origin_y);

    // d^2 along the side: Gauss' rule of two points is exact for it and for its moments
    const Real per_point = turn_sign(Real(0.25) * k * map.per_area * abs_of(w2 - w1), limit);
    for (int point = 0; point < 2; ++point) {
        const Real s = point == 0 ? gauss_point<Real>() : one - gauss_point<Real>();
        const Real rise = fma(map.slope_x, fma(s, x2 - x1, x1), map.slope_y * fma(s, y2 - y1, y1));
        const Real depth = max_of(map.depth + rise, zero);
        const Real f = per_point * depth * depth;
        if constexpr (across_x) {
            force.x = force.x + f;
            force.torque.y = fnma(rise, f, force.torque.y);
            force.torque.z = fnma(fma(s, Y2 - Y1, Y1), f, force.torque.z);
        } else {
            force.y = force.y + f;
            force.torque.x = fma(rise, f, force.torque.x);
            force.torque.z = fma(fma(s, X2 - X1, X1), f, force.torque.z);
        }
    }
}

/// What the patch carries, from its moments about the origin of `map`.
template <class Real>
STYLOBATE_INLINE BedLoad<Real> patch_load(const FaceMap<Real>& map, Real k, const PatchMoments<Real>& patch,
                                          const SideForce<Real>& side)
{
    const Real zero(0.0), one(1.0), half(0.5), two(2.0);
    const Real ax = map.slope_x, ay = map.slope_y, ox = map.origin_x, oy = map.origin_y;
    const Real d = fma(ax, ox, fma(ay, oy, map.depth));
    // force and first moments of the pressure k (d + a.p) about the origin
    const Real pressed = k * fma(d, patch.area, fma(ax, patch.x, ay * patch.y));
    const auto touching = pressed > zero; // rounding can leave less than nothing of a patch that just vanished
    const Real N = select(touching, pressed, zero);
    const Real Kx = select(touching, k * fma(d, patch.x, fma(patch.xx, ax, patch.xy * ay)), zero);
    const Real Ky = select(touching, k * fma(d, patch.y, fma(patch.xy, ax, patch.yy * ay)), zero);
    // polar moment of the pressure about its centre
    const Real per_N = one / select(touching, N, one);
    const Real cx = Kx * per_N, cy = Ky * per_N;
    const Real polar = k * fma(d, patch.xx + patch.yy, fma(ax, patch.cubic_x, ay * patch.cubic_y));
    const Real gyration2 = max_of(fnma(cx, cx, fnma(cy, cy, polar * per_N)), zero);

    BedLoad<Real> load;
    load.force = N;
    load.energy = half * fma(d, N, fma(ax, Kx, ay * Ky));
    load.lateral_x = side.x;
    load.lateral_y = side.y;
    load.moment_x = fma(ox, N, Kx);
    load.moment_y = fma(oy, N, Ky);
    load.torque = {side.torque.x + fma(map.t21, load.moment_x, map.t22 * load.moment_y),
                   side.torque.y - fma(map.t11, load.moment_x, map.t12 * load.moment_y), side.torque.z};
    const Real area = select(touching, patch.area, zero);
    const Real first_x = select(touching, patch.x, zero), first_y = select(touching, patch.y, zero);
    load.area = area;
    load.first_x = fma(area, ox, first_x);
    load.first_y = fma(area, oy, first_y);
    load.second_xx = fma(area * ox, ox, fma(two * ox, first_x, select(touching, patch.xx, zero)));
    load.second_yy = fma(area * oy, oy, fma(two * oy, first_y, select(touching, patch.yy, zero)));
    load.second_xy = fma(area * ox, oy, fma(ox, first_y, fma(oy, first_x, select(touching, patch.xy, zero))));
    // the mean distance from the centre is 0.943 of the radius of gyration for a disc, 0.937 for a square, 0.866 for a
    // line of even pressure
    load.friction_radius = select(touching, Real(0.92) * sqrt_of(gyration2), zero);
    load.t11 = map.t11, load.t12 = map.t12, load.t21 = map.t21, load.t22 = map.t22;
    load.slope_x = ax, load.slope_y = ay;
    return load;
}

} // namespace detail

/// The elastic load of the bed and its patch. Coordinates on the upper face turn with the upper body.
/// @pre the angle between the two normals is less than 90 degrees
template <class Real, int corners>
STYLOBATE_INLINE BedLoad<Real> polygon_bed(const BedPose<Real>& pose, const PolygonBed<Real, corners>& bed)
{
    const Real zero(0.0), one(1.0);
    const Matrix<Real>& m = pose.turn;
    const Polygon<Real, corners>& upper = bed.upper;
    const Rectangle<Real>& lower = bed.lower;
    detail::FaceMap<Real> map;
    map.t11 = one + m.m11, map.t12 = m.m12, map.t21 = m.m21, map.t22 = one + m.m22;
    map.per_area = one / max_of(one + m.m33, Real(1e-3)); // a rotation: t11 t22 - t12 t21 = r33
    map.slope_x = zero - m.m31, map.slope_y = zero - m.m32;
    map.depth = zero - pose.place.z;
    map.shift_x = lower.centre_x - pose.place.x, map.shift_y = lower.centre_y - pose.place.y;

    // the deepest corner is the origin: sums about a far one would lose the digits of a face that stands on its corner
    Real depth[corners];
    map.origin_x = upper.x[0], map.origin_y = upper.y[0];
    Real deepest = zero;
    for (int i = 0; i < corners; ++i) {
        depth[i] = fma(map.slope_x, upper.x[i], fma(map.slope_y, upper.y[i], map.depth));
        const auto deeper = depth[i] > deepest;
        deepest = select(deeper, depth[i], deepest);
        map.origin_x = select(deeper, upper.x[i], map.origin_x);
        map.origin_y = select(deeper, upper.y[i], map.origin_y);
    }
    detail::FacePoint<Real> corner[corners];
    for (int i = 0; i < corners; ++i)
        corner[i] = {upper.x[i] - map.origin_x, upper.y[i] - map.origin_y,
                     fma(map.t11, upper.x[i], fms(map.t12, upper.y[i], map.shift_x)),
                     fma(map.t21, upper.x[i], fms(map.t22, upper.y[i], map.shift_y))};

    detail::PatchMoments<Real> patch{zero, zero, zero, zero, zero, zero, zero, zero};
    const detail::Crossing<Real> none{zero, zero};
    detail::Crossings<Real> crossings{none, none, none, none};
    detail::clip_outline(corner, depth, lower, crossings, patch);
    detail::SideForce<Real> side{zero, zero, zero_vector<Real>()};
    detail::add_side<true>(map, bed.stiffness, zero - lower.half_x, lower.half_y, crossings.low_x, patch, side);
    detail::add_side<true>(map, bed.stiffness, lower.half_x, lower.half_y, crossings.high_x, patch, side);
    detail::add_side<false>(map, bed.stiffness, zero - lower.half_y, lower.half_x, crossings.low_y, patch, side);
    detail::add_side<false>(map, bed.stiffness, lower.half_y, lower.half_x, crossings.high_y, patch, side);
    return detail::patch_load(map, bed.stiffness, patch.finish(), side);
}

} // namespace stylobate::spatial
