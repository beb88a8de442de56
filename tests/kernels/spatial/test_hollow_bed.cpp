/// Hollow beds and gaps: the ring's load against formulas of a ring and differences of its energy, and both in the
/// step.

#include "kernels/spatial/disc_bed.hpp"
#include "kernels/spatial/hollow_bed.hpp"
#include "kernels/spatial/polygon_bed.hpp"

#include "tests/kernels/spatial/long_real.hpp"
#include "tests/kernels/spatial/rotations.hpp"
#include "tests/kernels/spatial/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stylobate::spatial::hollow { // helpers have names of their own
namespace {

constexpr double pi = std::numbers::pi;
constexpr double k = 2e9, R = 0.5;

template <class Real>
BedLoad<Real> ring(const BedPose<Real>& pose, Real upper, Real lower, Real ratio)
{
    const DiscBed<Real> whole{Real(k), upper, lower}, inner{Real(k), ratio * upper, ratio * lower};
    return hollow_load(disc_bed(pose, whole), disc_bed(pose, inner));
}

template <class Real>
BedLoad<Real> frame(const BedPose<Real>& pose, const Rectangle<Real>& upper, const Rectangle<Real>& lower, Real ratio)
{
    const auto load = [&](Real part) {
        const auto of = [&](const Rectangle<Real>& r) {
            return Rectangle<Real>{r.centre_x, r.centre_y, part * r.half_x, part * r.half_y};
        };
        return polygon_bed(pose, PolygonBed<Real, 4>{Real(k), polygon_of(of(upper)), of(lower)});
    };
    return hollow_load(load(Real(1.0)), load(ratio));
}

/// @param along, across components of the upper face's rotation
BedPose<double> tilted(double along, double across, const Vec& place)
{
    return {minus_identity(rotation_by<double>(along, across, 0)), place};
}

TEST(SpatialHollowBed, EvenlyPressedRingCarriesItsArea)
{
    for (const double ratio : {0.1, 0.5, 0.8, 0.95}) {
        const double r = ratio * R, depth = 1e-5;
        const auto load = ring(tilted(0, 0, {0, 0, -depth}), R, R, ratio);
        const double area = pi * (R * R - r * r), second = pi / 4 * (std::pow(R, 4) - std::pow(r, 4));
        EXPECT_NEAR(load.area / area, 1, 1e-12);
        EXPECT_NEAR(load.force / (k * area * depth), 1, 1e-12);
        EXPECT_NEAR(load.energy / (k * area * depth * depth / 2), 1, 1e-12);
        EXPECT_NEAR(load.second_xx / second, 1, 1e-12);
        EXPECT_NEAR(load.second_yy / second, 1, 1e-12);
        EXPECT_NEAR(load.friction_radius, 2.0 / 3 * (R * R * R - r * r * r) / (R * R - r * r), 1e-12);
    }
}

/// The moment about the centre of a ring that is pressed everywhere: k I per tilt.
TEST(SpatialHollowBed, TiltIsResistedByTheSecondMomentOfTheRing)
{
    const double tilt = 1e-6, ratio = 0.7, r = ratio * R;
    const double second = pi / 4 * (std::pow(R, 4) - std::pow(r, 4));
    const auto load = ring(tilted(0, tilt, {0, 0, -1e-5}), R, R, ratio);
    EXPECT_NEAR(load.moment_x / (k * second * tilt), 1, 1e-9);
    EXPECT_NEAR(load.moment_y, 0, 1e-9 * load.moment_x);
    EXPECT_NEAR(load.torque.y / (-k * second * tilt), 1, 1e-4); // but for the lateral force of the shorter face
}

TEST(SpatialHollowBed, RectangularFrameCarriesItsArea)
{
    const double a = 0.6, b = 0.4, ratio = 0.5, depth = 1e-5, tilt = 1e-6;
    const Rectangle<double> face{0.1, -0.05, a, b};
    const auto load = frame(tilted(0, 0, {0, 0, -depth}), face, face, ratio);
    const double area = 4 * a * b * (1 - ratio * ratio);
    EXPECT_NEAR(load.area / area, 1, 1e-12);
    EXPECT_NEAR(load.force / (k * area * depth), 1, 1e-12);
    EXPECT_NEAR(load.moment_x / load.force, 0.1, 1e-12);
    EXPECT_NEAR(load.moment_y / load.force, -0.05, 1e-12);
    const auto turned = frame(tilted(0, tilt, {0, 0, -depth}), face, face, ratio);
    const double second = 4.0 / 3 * a * a * a * b * (1 - std::pow(ratio, 4));
    EXPECT_NEAR((turned.moment_x - 0.1 * turned.force) / (k * second * tilt), 1, 1e-6);
}

/// On its outer rim alone, it is the whole disc: the recess is not pressed.
TEST(SpatialHollowBed, RecessThatIsNotPressedChangesNothing)
{
    const auto pose = tilted(0.003, 0.004, {0.01, 0.02, 0.7 * R * 0.005});
    const auto load = ring(pose, R, 0.9 * R, 0.6), whole = disc_bed(pose, DiscBed<double>{k, R, 0.9 * R});
    ASSERT_GT(whole.force, 0);
    EXPECT_EQ(load.force, whole.force);
    EXPECT_EQ(load.torque.x, whole.torque.x);
    EXPECT_EQ(load.energy, whole.energy);
    EXPECT_EQ(load.friction_radius, whole.friction_radius);
}

/// Force and torque against central differences of the energy, in all six freedoms of the upper body at P.
template <class Load>
void expect_gradient(const Load& load_of, const Vector<LongReal>& turn, const Vector<LongReal>& place)
{
    const long double h = 3e-9L;
    const auto pose = [&](const Vector<LongReal>& by, const Vector<LongReal>& to) {
        return BedPose<LongReal>{minus_identity(product(rotation_by<LongReal>(by.x.v, by.y.v, by.z.v),
                                                        rotation_by<LongReal>(turn.x.v, turn.y.v, turn.z.v))),
                                 place + to};
    };
    const Vector<LongReal> none{0.0L, 0.0L, 0.0L};
    const auto here = load_of(pose(none, none));
    ASSERT_GT(here.force.v, 0);
    const long double want[6] = {here.lateral_x.v, here.lateral_y.v, here.force.v,
                                 here.torque.x.v,  here.torque.y.v,  here.torque.z.v};
    for (int f = 0; f < 6; ++f) {
        const auto energy = [&](long double by) {
            Vector<LongReal> moved = none;
            (f % 3 == 0 ? moved.x : f % 3 == 1 ? moved.y : moved.z) = by;
            return load_of(f < 3 ? pose(none, moved) : pose(moved, none)).energy.v;
        };
        const long double slope = (energy(h) - energy(-h)) / (2 * h);
        EXPECT_LT(std::fabs(want[f] + slope) / here.force.v, 1e-7L) << f;
    }
}

TEST(SpatialHollowBed, LoadIsTheGradientOfItsEnergy)
{
    for (const long double tilt : {1e-6L, 1e-4L, 2e-3L})
        for (const long double depth : {3e-4L, 2e-5L}) {
            const Vector<LongReal> turn{tilt, 0.6L * tilt, 0.01L}, place{0.02L, -0.03L, -depth};
            expect_gradient([](const BedPose<LongReal>& p) { return ring<LongReal>(p, 0.5L, 0.45L, 0.6L); }, turn,
                            place);
            const Rectangle<LongReal> upper{0.0L, 0.01L, 0.5L, 0.4L}, lower{0.0L, 0.0L, 0.45L, 0.6L};
            expect_gradient([&](const BedPose<LongReal>& p) { return frame<LongReal>(p, upper, lower, 0.6L); }, turn,
                            place);
        }
}

// ---- in the step ----------------------------------------------------------------------------------------------------

constexpr double mass = 1960, dt = 2e-5;

Scene column(BedKind kind, bool hollow, double ratio)
{
    Scene s(dt);
    const Scene::Law law{k, k, 0.6, 1e5, 1e5, hollow, ratio, 0};
    if (kind == BedKind::disc)
        s.drum({0, -0.5, 0}, 2 * R, 1, 1, true);
    else
        s.box({0, -0.5, 0}, {4 * R, 1, 3 * R}, 1, true);
    if (kind == BedKind::rectangle)
        s.box({0.02, 0.5, 0.01}, {2 * R, 1, 2 * R}, mass);
    else
        s.drum({0.02, 0.5, 0.01}, R, 1, mass);
    s.joint(0, 1, kind, {0.02, 0, 0.01}, law);
    s.build();
    return s;
}

TEST(SpatialHollowBed, StepPressesTheRing)
{
    const double ratio = 0.8, depth = 1e-6, bearing = 1 - ratio * ratio;
    for (const BedKind kind : {BedKind::disc, BedKind::rectangle, BedKind::round}) {
        Scene hollow = column(kind, true, ratio), whole = column(kind, false, 0);
        for (Scene* s : {&hollow, &whole})
            s->at(OfBody::y, 1) = -depth;
        EXPECT_NEAR(hollow.normal_force(0) / (bearing * whole.normal_force(0)), 1, 1e-9);
    }
}

/// Faces that are deeper in each other than the limit carry nothing: the limit is that of the ring.
TEST(SpatialHollowBed, DepthLimitIsThatOfTheRing)
{
    Scene s = column(BedKind::disc, true, 0.8);
    const double limit = s.at(OfJoint::depth_limit, 0);
    s.at(OfBody::y, 1) = -0.99 * limit;
    EXPECT_GT(s.normal_force(0), 0);
    s.at(OfBody::y, 1) = -1.01 * limit;
    EXPECT_EQ(s.normal_force(0), 0);
}

TEST(SpatialHollowBed, RatioOfZeroHasTheBitsOfAWholeBed)
{
    for (const BedKind kind : {BedKind::disc, BedKind::rectangle, BedKind::round}) {
        Scene hollow = column(kind, true, 0), whole = column(kind, false, 0);
        for (Scene* s : {&hollow, &whole}) {
            s->set_motion(1, {0.2, 0, -0.1}, {0.3, 0.1, -0.5});
            s->run(3000);
        }
        EXPECT_GT(whole.tilt(1), 1e-4);
        EXPECT_EQ(hollow.state(), whole.state());
    }
}

TEST(SpatialHollowBed, RockingKeepsItsEnergy)
{
    Scene s = column(BedKind::disc, true, 0.7);
    s.at(OfJoint::C_n, 0) = s.at(OfJoint::C_t, 0) = 0;
    s.at(OfBody::y, 1) = -mass * Scene::gravity_m_s2 / (k * pi * R * R * 0.51);
    s.set_motion(1, {0.25, 0, 0.1}, {0.2, 0, -0.5});
    s.run(1);
    const double before = s.balance(), moving = s.kinetic();
    s.run(20000);
    EXPECT_NEAR(s.balance(), before, 2e-3 * moving);
}

/// A box that moves towards a fixed one with a gap between them touches it once it has come so far, and not before.
TEST(SpatialGap, ClosesWhereTheFacesMeet)
{
    for (const Axis normal : {Axis::x, Axis::z}) {
        const double gap = 0.003;
        const Vec n{normal == Axis::x ? 1.0 : 0, 0, normal == Axis::z ? 1.0 : 0};
        Scene s(dt);
        s.box({0, 0, 0}, {1, 1, 1}, 1, true);
        s.box((1 + gap) * n, {1, 1, 1}, mass);
        s.joint(0, 1, BedKind::rectangle, 0.5 * n, {k, k, 0.6, 0, 0, false, 0, gap}, normal);
        s.build();
        const auto force_at = [&](double closed) {
            s.set_vector(OfBody::x, 1, -closed * n);
            return s.normal_force(0);
        };
        EXPECT_EQ(force_at(0), 0);
        EXPECT_EQ(force_at(gap - 1e-9), 0);
        EXPECT_NEAR(force_at(gap + 1e-6), k * 1e-6, 1e-6 * k * 1e-6);
    }
}

/// Both boxes turned together about a common point: the gap turns with them, and nothing touches.
TEST(SpatialGap, TurnsWithTheBodies)
{
    const double gap = 0.003, angle = 0.1;
    Scene s(dt);
    s.box({-5, 0, 0}, {1, 1, 1}, 1, true);
    s.box({0, 0, 0}, {1, 1, 1}, mass);
    s.box({1 + gap, 0, 0}, {1, 1, 1}, mass);
    s.joint(1, 2, BedKind::rectangle, {0.5, 0, 0}, {k, k, 0.6, 0, 0, false, 0, gap}, Axis::x);
    s.build();
    const auto turn = [&](double length) {
        for (int i : {1, 2})
            s.set_attitude(i, {0, 1, 0}, angle);
        s.set_vector(OfBody::x, 2, {length * std::cos(angle) - 1 - gap, 0, -length * std::sin(angle)});
        return s.normal_force(0);
    };
    EXPECT_EQ(turn(1 + 1e-9), 0);
    EXPECT_NEAR(turn(1 - 1e-6), k * 1e-6, 1e-5 * k * 1e-6);
}

} // namespace
} // namespace stylobate::spatial::hollow
