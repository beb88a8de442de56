#include "ensemble/model/plan_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stylobate {
namespace {

/// Integral of sqrt(R^2 - x^2) from 0 to x.
double under_arc(double radius, double x)
{
    const double s = std::sqrt(std::max(radius * radius - x * x, 0.0));
    return (x * s + radius * radius * std::asin(std::clamp(x / radius, -1.0, 1.0))) / 2;
}

/// Area of a disc about the origin between x = `left` and `right` and z = `low` and `high`. Between two of the points
/// where the circle meets `low` or `high`, each bound is a straight line or the arc.
double disc_in_rectangle(double radius, double left, double right, double low, double high)
{
    left = std::clamp(left, -radius, radius);
    right = std::clamp(right, -radius, radius);
    std::array<double, 6> at{left, right, left, left, left, left};
    std::size_t n = 2;
    for (const double z : {low, high})
        if (std::abs(z) < radius) {
            const double x = std::sqrt(radius * radius - z * z);
            at[n++] = std::clamp(-x, left, right);
            at[n++] = std::clamp(x, left, right);
        }
    std::sort(at.begin(), at.end());
    double area = 0;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const double from = at[i], to = at[i + 1], middle = (from + to) / 2;
        const double s = std::sqrt(std::max(radius * radius - middle * middle, 0.0));
        if (!(std::min(high, s) > std::max(low, -s)))
            continue;
        const double arc = under_arc(radius, to) - under_arc(radius, from);
        area += (s < high ? arc : high * (to - from)) - (-s > low ? -arc : low * (to - from));
    }
    return area;
}

/// Area of the lens of two discs.
double lens(double a, double b, double apart)
{
    if (apart >= a + b)
        return 0;
    const double smaller = std::min(a, b);
    if (apart <= std::abs(a - b))
        return std::numbers::pi * smaller * smaller;
    const auto segment = [](double radius, double chord_at) { // cut off at a distance from the centre
        return radius * radius * std::acos(std::clamp(chord_at / radius, -1.0, 1.0)) -
               chord_at * std::sqrt(std::max(radius * radius - chord_at * chord_at, 0.0));
    };
    const double from_a = (apart * apart + a * a - b * b) / (2 * apart);
    return segment(a, from_a) + segment(b, apart - from_a);
}

} // namespace

double PlanFace::area_m2() const
{
    return round ? std::numbers::pi * half_x_m * half_x_m : 4 * half_x_m * half_z_m;
}

double outside_m(const PlanFace& face, double x_m, double z_m)
{
    const double x = std::abs(x_m - face.x_m), z = std::abs(z_m - face.z_m);
    if (face.round)
        return std::hypot(x, z) - face.half_x_m;
    const double beyond_x = x - face.half_x_m, beyond_z = z - face.half_z_m;
    if (beyond_x > 0 && beyond_z > 0)
        return std::hypot(beyond_x, beyond_z);
    return std::max(beyond_x, beyond_z);
}

double gap_m(const PlanFace& a, const PlanFace& b)
{
    if (a.round)
        return outside_m(b, a.x_m, a.z_m) - a.half_x_m;
    if (b.round)
        return outside_m(a, b.x_m, b.z_m) - b.half_x_m;
    return outside_m({false, b.x_m, b.z_m, a.half_x_m + b.half_x_m, a.half_z_m + b.half_z_m}, a.x_m, a.z_m);
}

double common_area_m2(const PlanFace& a, const PlanFace& b)
{
    if (a.round && b.round)
        return lens(a.half_x_m, b.half_x_m, std::hypot(a.x_m - b.x_m, a.z_m - b.z_m));
    if (!a.round && b.round)
        return common_area_m2(b, a);
    if (a.round)
        return disc_in_rectangle(a.half_x_m, b.x_m - b.half_x_m - a.x_m, b.x_m + b.half_x_m - a.x_m,
                                 b.z_m - b.half_z_m - a.z_m, b.z_m + b.half_z_m - a.z_m);
    return common_rectangle(a, b).area_m2();
}

PlanFace common_rectangle(const PlanFace& a, const PlanFace& b)
{
    const auto common = [](double a_at, double a_half, double b_at, double b_half, double& middle, double& half) {
        const double from = std::max(a_at - a_half, b_at - b_half), to = std::min(a_at + a_half, b_at + b_half);
        middle = (from + to) / 2;
        half = std::max((to - from) / 2, 0.0);
    };
    PlanFace face;
    face.round = false;
    common(a.x_m, a.half_x_m, b.x_m, b.half_x_m, face.x_m, face.half_x_m);
    common(a.z_m, a.half_z_m, b.z_m, b.half_z_m, face.z_m, face.half_z_m);
    return face;
}

} // namespace stylobate
