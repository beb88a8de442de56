#include "bench/rigid_reference/contact_point.hpp"

namespace stylobate::reference {

namespace {

struct Vector {
    double x, y;
};
double dot(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y;
}

/// Directions along and across the faces of a body.
struct Axes {
    Vector along, across;
    explicit Axes(double theta) : along{std::cos(theta), std::sin(theta)}, across{-along.y, along.x} {}
};

bool is_of_upper(Corner corner)
{
    return corner == Corner::upper_left || corner == Corner::upper_right;
}

/// From the centre of a block to its corner: a lower one of the upper block, an upper one of the lower block.
Vector arm(const Body& body, const Axes& axes, Corner corner)
{
    const double b = (corner == Corner::upper_left || corner == Corner::lower_left ? -1 : 1) * body.half_width_m;
    const double h = (is_of_upper(corner) ? -1 : 1) * body.half_height_m;
    return {b * axes.along.x + h * axes.across.x, b * axes.along.y + h * axes.across.y};
}

Twist row(Vector direction, double moment)
{
    return {direction.x, direction.y, moment};
}

} // namespace

Meeting meeting(const Body& lower, const Body& upper, const Twist& at_lower, const Twist& at_upper, Corner corner)
{
    const bool of_upper = is_of_upper(corner);
    const Axes lower_axes(at_lower.theta), upper_axes(at_upper.theta);
    const Axes& face = of_upper ? lower_axes : upper_axes;
    const Body& with_face = of_upper ? lower : upper;
    const double side = of_upper ? 1 : -1;
    const Vector to = arm(of_upper ? upper : lower, of_upper ? upper_axes : lower_axes, corner);
    const Vector d{side * (at_upper.x - at_lower.x) + to.x, side * (at_upper.y - at_lower.y) + to.y};
    const double along = dot(d, face.along);
    return {side * dot(d, face.across) - with_face.half_height_m, side * along,
            std::fabs(along) <= with_face.half_width_m};
}

ContactRows rows(const Body& lower, const Body& upper, const Twist& at_lower, const Twist& at_upper, Corner corner)
{
    const bool of_upper = is_of_upper(corner);
    const Axes lower_axes(at_lower.theta), upper_axes(at_upper.theta);
    const Axes& face = of_upper ? lower_axes : upper_axes;
    const double side = of_upper ? 1 : -1;
    const Vector to = arm(of_upper ? upper : lower, of_upper ? upper_axes : lower_axes, corner);
    const Vector d{side * (at_upper.x - at_lower.x) + to.x, side * (at_upper.y - at_lower.y) + to.y};
    const Vector turned{-to.y, to.x}; // how the corner moves when its own block turns
    const Vector n = face.across, t = face.along;
    const Twist corner_normal = row({side * n.x, side * n.y}, side * dot(n, turned));
    const Twist face_normal = row({-side * n.x, -side * n.y}, -side * dot(d, t));
    const Twist corner_along = row({side * t.x, side * t.y}, side * dot(t, turned));
    const Twist face_along = row({-side * t.x, -side * t.y}, side * dot(d, n));
    if (of_upper)
        return {face_normal, corner_normal, face_along, corner_along};
    return {corner_normal, face_normal, corner_along, face_along};
}

} // namespace stylobate::reference
