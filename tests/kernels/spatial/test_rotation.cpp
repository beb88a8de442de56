/// Rotation in space against closed forms, a fine Runge-Kutta solution of Euler's equations, and conservation.

#include "kernels/spatial/rotation.hpp"

#include "tests/kernels/spatial/rotations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {
namespace {

using spatial::Axis;
using Quaternion = spatial::Quaternion<double>;
using Vector = spatial::Vector<double>;

struct Body {
    double x, y, z; ///< inertias [kg m2]
    Axis axis() const { return spatial::correction_axis(1 / x, 1 / y, 1 / z); }
    spatial::Inertia<double> inertia() const { return spatial::inertia_of(1 / x, 1 / y, 1 / z, axis()); }
};

/// A homogeneous box of unit mass.
Body box(double a, double b, double c)
{
    return {(b * b + c * c) / 12, (a * a + c * c) / 12, (a * a + b * b) / 12};
}

/// v in the body's frame, by Rodrigues' formula for the conjugate.
Vector in_body(const Quaternion& q, const Vector& v)
{
    const Vector e{-q.x, -q.y, -q.z}, t = 2.0 * cross(e, v);
    return v + q.w * t + cross(e, t);
}

double energy(const Body& body, const Quaternion& q, const Vector& l)
{
    const Vector b = in_body(q, l);
    return (b.x * b.x / body.x + b.y * b.y / body.y + b.z * b.z / body.z) / 2;
}

double length(const Quaternion& q)
{
    return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}

/// The attitude after the time t from rest of all torques: Euler's equations in the body's frame, with q' = q w / 2, by
/// the classical Runge-Kutta method.
Quaternion runge_kutta(const Body& body, Quaternion q, const Vector& l, double t, int steps)
{
    using State = std::array<double, 7>;
    const auto rate = [&](const State& s) {
        const double x = s[4] / body.x, y = s[5] / body.y, z = s[6] / body.z;
        return State{(-s[1] * x - s[2] * y - s[3] * z) / 2,
                     (s[0] * x + s[2] * z - s[3] * y) / 2,
                     (s[0] * y + s[3] * x - s[1] * z) / 2,
                     (s[0] * z + s[1] * y - s[2] * x) / 2,
                     s[5] * z - s[6] * y,
                     s[6] * x - s[4] * z,
                     s[4] * y - s[5] * x};
    };
    const auto plus = [](State a, double h, const State& b) {
        for (std::size_t i = 0; i < a.size(); ++i)
            a[i] += h * b[i];
        return a;
    };
    const Vector b = in_body(q, l);
    State s{q.w, q.x, q.y, q.z, b.x, b.y, b.z};
    const double h = t / steps;
    for (int i = 0; i < steps; ++i) {
        const State k1 = rate(s), k2 = rate(plus(s, h / 2, k1)), k3 = rate(plus(s, h / 2, k2)),
                    k4 = rate(plus(s, h, k3));
        s = plus(plus(plus(plus(s, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    }
    const double n = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + s[3] * s[3]);
    return {s[0] / n, s[1] / n, s[2] / n, s[3] / n};
}

TEST(SpatialRotation, SmallRotationKeepsItsDigits)
{
    // rotation by 1e-8 about x: sine 1e-8, versine 5e-17
    const auto m = spatial::minus_identity(rotation_by<double>(1e-8, 0, 0));
    EXPECT_NEAR(m.m32 / 1e-8, 1, 1e-15);
    EXPECT_NEAR(m.m23 / -1e-8, 1, 1e-15);
    EXPECT_NEAR(m.m22 / -5e-17, 1, 1e-15);
    EXPECT_NEAR(m.m33 / -5e-17, 1, 1e-15);
    EXPECT_EQ(m.m11, 0);
}

TEST(SpatialRotation, MatrixRotatesAsRodrigues)
{
    // a third of a turn about (1, 1, 1) takes x to y, y to z, z to x
    const double third = 2 * std::acos(-1.0) / 3 / std::sqrt(3.0);
    const auto m = spatial::minus_identity(rotation_by<double>(third, third, third));
    const Vector v = rotated(m, Vector{2, 3, 5}), back = rotated_back(m, v);
    EXPECT_NEAR(v.x, 5, 1e-14);
    EXPECT_NEAR(v.y, 2, 1e-14);
    EXPECT_NEAR(v.z, 3, 1e-14);
    EXPECT_NEAR(back.x, 2, 1e-14);
    EXPECT_NEAR(back.y, 3, 1e-14);
    EXPECT_NEAR(back.z, 5, 1e-14);
}

TEST(SpatialRotation, RelativeRotationIsConjugateTimesUpper)
{
    const Quaternion lower = rotation_by<double>(0.3, -1.1, 0.4), relative = rotation_by<double>(-0.2, 0.1, 2.0);
    EXPECT_LT(angle_between(relative, spatial::relative_rotation(lower, product(lower, relative))), 1e-15);
}

TEST(SpatialRotation, DirectionsAreTheColumnsOfTheMatrix)
{
    const Quaternion q = rotation_by<double>(0.3, -1.1, 0.4);
    const auto m = spatial::minus_identity(q);
    const auto same = [](const Vector& a, const Vector& b) {
        EXPECT_NEAR(a.x, b.x, 1e-15);
        EXPECT_NEAR(a.y, b.y, 1e-15);
        EXPECT_NEAR(a.z, b.z, 1e-15);
    };
    same(spatial::direction_of<Axis::x>(q), rotated(m, Vector{1, 0, 0}));
    same(spatial::direction_of<Axis::y>(q), rotated(m, Vector{0, 1, 0}));
    same(spatial::direction_of<Axis::z>(q), rotated(m, Vector{0, 0, 1}));
}

TEST(SpatialRotation, CorrectionIsAboutTheLongAxis)
{
    const auto axis = [](const Body& b) { return b.axis(); };
    EXPECT_EQ(axis(box(3.0, 0.8, 0.9)), Axis::x);
    EXPECT_EQ(axis(box(0.9, 0.8, 3.0)), Axis::z);
    EXPECT_EQ(axis(box(1.0, 0.5, 1.0)), Axis::none);
    EXPECT_EQ(axis({2, 1, 2}), Axis::none);
}

TEST(SpatialRotation, IncrementIsInverseInertiaTimesMomentum)
{
    for (const Body& body : {box(3.0, 0.8, 0.9), box(0.9, 0.8, 3.0), Body{2, 1, 2}}) {
        const Quaternion q = rotation_by<double>(0.7, -0.4, 1.9);
        const Vector l{0.3, -0.2, 0.5}, b = in_body(q, l);
        const Vector want = rotated(spatial::minus_identity(q), Vector{b.x / body.x, b.y / body.y, b.z / body.z});
        const Vector w = spatial::angular_increment(q, l, body.inertia(), body.axis());
        EXPECT_NEAR(w.x, want.x, 1e-14);
        EXPECT_NEAR(w.y, want.y, 1e-14);
        EXPECT_NEAR(w.z, want.z, 1e-14);
    }
}

/// A step of a symmetric body is its exact motion, whichever axis is that of symmetry: a turn about the momentum at the
/// rate L / I_t, and one about the own axis e at the rate L_e (1/I_e - 1/I_t).
TEST(SpatialRotation, SymmetricTopMovesAsItsClosedForm)
{
    const double across = 1.3, own = 0.9;
    struct {
        Body body;
        Vector axis;
    } tops[] = {
        {{across, own, across}, {0, 1, 0}}, {{own, across, across}, {1, 0, 0}}, {{across, across, own}, {0, 0, 1}}};
    for (const auto& top : tops) {
        const Quaternion start = rotation_by<double>(0.5, -0.8, 1.2);
        const Vector l{0.004, 0.006, -0.005};
        const int steps = 100000;
        Quaternion q = start;
        for (int i = 0; i < steps; ++i)
            q = spatial::turned(q, l, top.body.inertia(), top.body.axis());
        const Vector b = in_body(start, l);
        const long double spin = static_cast<long double>(dot(b, top.axis)) * (1 / own - 1 / across) * steps;
        const long double turns = steps / static_cast<long double>(across);
        const Quaternion want = product(product(rotation_by<double>(turns * l.x, turns * l.y, turns * l.z), start),
                                        rotation_by<double>(spin * top.axis.x, spin * top.axis.y, spin * top.axis.z));
        EXPECT_LT(angle_between(q, want), 1e-11); // of 675 rad
        EXPECT_NEAR(length(q), 1, 1e-15);
    }
}

/// Beams in all three directions over 1e5 steps. The specification of the spatial model has 5.7e-8 of the energy and
/// 2.3e-4 rad for the one along x; the tall block turns fastest about its axis.
TEST(SpatialRotation, ThreeInertiasKeepTheirEnergy)
{
    struct {
        Body body;
        double energy, attitude;
    } beams[] = {
        {box(3.0, 0.8, 0.9), 6e-8, 2.5e-4}, {box(0.9, 0.8, 3.0), 6e-8, 2.5e-4}, {box(0.8, 3.0, 0.9), 4e-7, 2.5e-4}};
    const double dt = 0.01;
    for (const auto& beam : beams) {
        const Body& body = beam.body;
        const Vector l{dt * 0.6 * body.x, dt * 1.0 * body.y, dt * 0.15 * body.z};
        const Quaternion start = spatial::no_rotation<double>();
        const double first = energy(body, start, l);
        Quaternion q = start;
        double half = 0, all = 0;
        const int steps = 100000;
        for (int i = 0; i < steps; ++i) {
            q = spatial::turned(q, l, body.inertia(), body.axis());
            all = std::max(all, std::fabs(energy(body, q, l) / first - 1));
            if (i == steps / 2)
                half = all;
        }
        EXPECT_LT(all, beam.energy);
        EXPECT_LT(all, 1.05 * half); // no drift
        EXPECT_LT(angle_between(q, runge_kutta(body, start, l, steps, 4 * steps)), beam.attitude);
        EXPECT_NEAR(length(q), 1, 1e-15);
    }
}

TEST(SpatialRotation, ErrorFallsWithTheSquareOfTheStep)
{
    const Body body = box(1.0, 0.7, 0.4);
    const Quaternion start = rotation_by<double>(0.5, -0.8, 1.2);
    const Vector momentum{0.06, 0.1, -0.05};
    const Quaternion want = runge_kutta(body, start, momentum, 10, 20000);
    const auto error = [&](int steps) {
        Quaternion q = start;
        for (int i = 0; i < steps; ++i)
            q = spatial::turned(q, (10.0 / steps) * momentum, body.inertia(), body.axis());
        return angle_between(q, want);
    };
    const double coarse = error(200), fine = error(400);
    EXPECT_GT(coarse, 1e-6);
    EXPECT_NEAR(coarse / fine, 4, 0.1);
}

} // namespace
} // namespace stylobate
