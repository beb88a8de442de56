// Mechanisms in space, each against its closed form, through the real kernel; and what must hold with all of them.

#include "kernels/spatial/mechanisms/dowel.hpp"
#include "tests/kernels/spatial/scene.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>

namespace stylobate::spatial {
namespace {

using B = OfBodyMechanisms;
using J = OfJointMechanisms;

constexpr double g = Scene::gravity_m_s2;

/// A low disc on a plane, which slides without rocking. Directions are azimuths from x towards z.
class Slab {
public:
    static constexpr double radius = 0.5, height = 0.1, mass = 200, stiffness = 1e9;

    explicit Slab(double mu, double step_s = 1e-4) : scene(step_s)
    {
        scene.use_mechanisms();
        const int ground = scene.drum({0, -0.5, 0}, 100, 1, 1, true);
        body = scene.drum({0, height / 2, 0}, radius, height, mass);
        scene.joint(ground, body, BedKind::disc, {0, 0, 0}, {stiffness, 1e8, mu, 2e5, 8e4});
        scene.build();
        scene.set_vector(OfBody::x, body, {0, -mass * g / (stiffness * area()), 0});
    }
    static double area() { return std::numbers::pi * radius * radius; }
    static Vec along(double azimuth) { return {std::cos(azimuth), 0, std::sin(azimuth)}; }
    /// Tilts the plane by `angle`, downwards in that direction.
    void tilt(double angle, double azimuth)
    {
        const double dt2 = scene.step_s() * scene.step_s();
        const Vec pull = dt2 * g * std::sin(angle) * along(azimuth);
        scene.set_vector(OfRealization::gravity_dx, 0, {pull.x, -dt2 * g * std::cos(angle), pull.z});
    }
    double moved(double azimuth) { return dot(scene.vector(OfBody::x, body), along(azimuth)); }
    double across(double azimuth) { return std::fabs(moved(azimuth + std::numbers::pi / 2)); }

    Scene scene;
    int body;
};

// ---- friction -------------------------------------------------------------------------------------------------------

/// Time until a velocity v has gone with v' = -rate (mu_d + (mu_s - mu_d) exp(-v / v_s)): with E = exp(v / v_s),
/// E' = -rate / v_s (mu_d E + mu_s - mu_d).
double stopping_time(double v, double v_s, double mu_s, double mu_d, double rate)
{
    const double more = (mu_s - mu_d) / mu_d;
    return v_s / (rate * mu_d) * std::log((std::exp(v / v_s) + more) / (1 + more));
}

/// Until it moves by less than a thousandth of the start in a step.
template <class Speed>
double time_to_stop(Scene& s, const Speed& speed)
{
    const double least = 1e-3 * speed();
    while (speed() > least && s.time_s() < 5)
        s.run(1);
    return s.time_s();
}

TEST(SpatialStribeck, SlidingStopsWhenItsEquationSaysInAnyDirection)
{
    const double mu = 0.5, ratio = 0.4, v_s = 0.2, v = 0.8;
    for (const double azimuth : {0.0, 0.7, 4.0}) {
        Slab slab(mu);
        Scene& s = slab.scene;
        s.at(J::friction_drop, 0) = 1 - ratio;
        s.at(J::per_stribeck_step, 0) = 1 / (v_s * s.step_s());
        s.set_motion(slab.body, v * Slab::along(azimuth), {0, 0, 0});
        const double want = stopping_time(v, v_s, mu, ratio * mu, g);
        EXPECT_NEAR(time_to_stop(s, [&] { return length(s.velocity(slab.body)); }), want, 5e-3 * want);
        EXPECT_LT(slab.across(azimuth), 1e-3 * slab.moved(azimuth));
        EXPECT_GT(want, 1.3 * v / (mu * g)); // plain friction would have stopped it earlier
    }
}

TEST(SpatialStribeck, SpinIsAPathAtTheFrictionRadius)
{
    // v = 2/3 R omega with v' = -(2/3 R)^2 m / I g mu = -8/9 g mu
    const double mu = 0.5, ratio = 0.4, v_s = 0.2, v = 0.8;
    Slab slab(mu);
    Scene& s = slab.scene;
    s.at(J::friction_drop, 0) = 1 - ratio;
    s.at(J::per_stribeck_step, 0) = 1 / (v_s * s.step_s());
    s.set_motion(slab.body, {0, 0, 0}, {0, v / (2 * Slab::radius / 3), 0});
    s.run(1);
    const double want = stopping_time(v, v_s, mu, ratio * mu, 8 * g / 9);
    EXPECT_NEAR(time_to_stop(s, [&] { return s.omega(slab.body).y; }), want, 5e-3 * want);
}

TEST(SpatialFrictionWear, TheSlopeOfItsOwnSlipDecides)
{
    // S'' = A + B S with A = g (sin - mu cos), B = g mu k cos: S = A / B (cosh(w t) - 1) + v / w sinh(w t), w2 = B
    const double mu = 0.4, k = 0.5, angle = std::atan(0.5), azimuth = 2.2, v = 0.3;
    Slab slab(mu);
    Scene& s = slab.scene;
    s.at(J::wear, 0) = k;
    slab.tilt(angle, azimuth);
    s.set_motion(slab.body, v * Slab::along(azimuth), {0, 0, 0});
    s.run(7000);
    const double A = g * (std::sin(angle) - mu * std::cos(angle)), w2 = g * mu * k * std::cos(angle);
    const double w = std::sqrt(w2), t = s.time_s();
    const double want = A / w2 * (std::cosh(w * t) - 1) + v / w * std::sinh(w * t);
    EXPECT_NEAR(slab.moved(azimuth), want, 1e-3 * want);
    EXPECT_NEAR(s.at(OfJoint::slip, 0), want, 1e-3 * want);
    EXPECT_GT(want, 1.05 * (v * t + 0.5 * A * t * t)); // which plain friction would not reach
}

TEST(SpatialAdhesion, TheFirstSlipBeginsAtFrictionAndBond)
{
    const double mu = 0.4, angle = std::atan(0.5), azimuth = 5.1, W = Slab::mass * g;
    const double needed = W * (std::sin(angle) - mu * std::cos(angle)) / Slab::area();
    for (const double times : {0.98, 1.02}) {
        Slab slab(mu);
        Scene& s = slab.scene;
        s.at(J::adhesion, 0) = times * needed;
        // slowly, so that nothing swings
        for (int k = 1; k <= 1000; ++k) {
            slab.tilt(angle * k / 1000, azimuth);
            s.run(10);
        }
        s.run(5000);
        EXPECT_EQ(s.at(J::broken, 0), times < 1);
        if (times > 1)
            EXPECT_LT(slab.moved(azimuth), 1e-4);
        else // once it is broken, friction is all there is: for half a second after the ramp
            EXPECT_NEAR(slab.moved(azimuth), 0.5 * g * (std::sin(angle) - mu * std::cos(angle)) * 0.25, 0.004);
    }
}

TEST(SpatialAdhesion, HoldsASpinAtTheFrictionRadiusAndIsLostWhereFacesPart)
{
    // the largest torque is (mu N + c A) 2/3 R: the spring of the twist, a torque over that radius, at mu N + c A
    const double mu = 0.4, c = 5e3, limit = mu * Slab::mass * g + c * Slab::area();
    for (const double times : {0.98, 1.02}) {
        Slab slab(mu);
        Scene& s = slab.scene;
        s.at(J::adhesion, 0) = c;
        s.run(1);
        s.at(OfJoint::spring_twist, 0) = times * limit;
        s.run(1);
        EXPECT_EQ(s.at(J::broken, 0), times > 1) << times;
    }
    Slab slab(mu);
    Scene& s = slab.scene;
    s.at(J::adhesion, 0) = c;
    s.run(1);
    EXPECT_EQ(s.at(J::broken, 0), 0);
    s.set_vector(OfBody::x, slab.body, {0, 1e-6, 0});
    s.run(1);
    EXPECT_EQ(s.at(J::broken, 0), 1);
}

// ---- dowel ----------------------------------------------------------------------------------------------------------

TEST(SpatialDowel, StopsTheSlideWhereItsEnergySaysInAnyDirection)
{
    // no friction: W sin s = k (s - gap)^2 / 2 at the farthest point
    const double k = 2e4, gap = 0.003, angle = std::atan(0.3), pull = Slab::mass * g * std::sin(angle);
    const double want = gap + pull / k + std::sqrt(pull * pull / (k * k) + 2 * pull * gap / k);
    for (const double azimuth : {0.0, 1.1, 3.9}) {
        Slab slab(0);
        Scene& s = slab.scene;
        s.at(J::dowel_stiffness, 0) = k;
        s.at(J::per_dowel_stiffness, 0) = 1 / k;
        s.at(J::dowel_yield, 0) = 1e9;
        s.at(J::dowel_gap, 0) = gap;
        slab.tilt(angle, azimuth);
        double most = 0;
        while (s.time_s() < 0.6) {
            s.run(1);
            most = std::max(most, slab.moved(azimuth));
        }
        EXPECT_NEAR(most, want, 1e-3 * want);
        EXPECT_LT(slab.across(azimuth), 1e-9);
    }
}

TEST(SpatialDowel, YieldsWithItsForceAndLosesItsWork)
{
    const double k = 2e6, yield = 300, angle = std::atan(0.3), azimuth = 0.6;
    Slab slab(0);
    Scene& s = slab.scene;
    s.at(J::dowel_stiffness, 0) = k;
    s.at(J::per_dowel_stiffness, 0) = 1 / k;
    s.at(J::dowel_yield, 0) = yield;
    slab.tilt(angle, azimuth);
    s.run(5000);
    // elastic: F / k (1 - cos w t), F the pull, until the force is that of the yield; then with what is left of F
    const double F = Slab::mass * g * std::sin(angle), w = std::sqrt(k / Slab::mass);
    const double begins = std::acos(1 - yield / F) / w, v = F / k * w * std::sin(w * begins), t = s.time_s() - begins;
    const double want = yield / k + v * t + 0.5 * (F - yield) / Slab::mass * t * t;
    EXPECT_NEAR(slab.moved(azimuth), want, 1e-3 * want);
    const double at = std::hypot(s.at(J::dowel_at, 0), s.at(J::dowel_at, 0, 1));
    EXPECT_NEAR(s.mechanisms(), yield * (at - yield / k / 2), 1e-6 * s.mechanisms());
}

TEST(SpatialDowel, ACircularPathDragsItsSetOnASmallerCircle)
{
    // the set is dragged like a body on a rod of the length gap + F / k: it ends up on the circle of which the rod is a
    // tangent, and loses F times that path in each turn
    const double k = 1e6, yield = 500, gap = 1e-3, path = 4e-3, rod = gap + yield / k,
                 ring = std::sqrt(path * path - rod * rod);
    double set_x = 0, set_y = 0, x = 0, y = 0, force_x = 0, force_y = 0, work = 0, start = 0;
    const int turns = 12, steps = 20000;
    for (int n = 0; n <= turns * steps; ++n) {
        const double phase = 2 * std::numbers::pi * n / steps;
        const double to_x = path * std::cos(phase), to_y = path * std::sin(phase);
        const DowelForce<double> f = dowel_force(k, 1 / k, yield, gap, to_x, to_y, set_x, set_y);
        work += 0.5 * ((f.x + force_x) * (to_x - x) + (f.y + force_y) * (to_y - y));
        force_x = f.x, force_y = f.y, set_x = f.set_x, set_y = f.set_y, x = to_x, y = to_y;
        EXPECT_LE(std::hypot(f.x, f.y), yield * (1 + 1e-12));
        if (n == (turns - 1) * steps)
            start = work;
    }
    EXPECT_NEAR(std::hypot(set_x, set_y), ring, 1e-4 * ring); // of first order in the step
    EXPECT_NEAR(work - start, yield * 2 * std::numbers::pi * ring, 1e-4 * (work - start));
}

TEST(SpatialDowel, IsOutWhereItsFaceHasLifted)
{
    const double k = 2e6;
    for (const double part : {0.99, 1.01}) { // of a quarter of the lower body's height: depth_limit is a tenth of it
        Slab slab(0);
        Scene& s = slab.scene;
        s.at(J::dowel_stiffness, 0) = k;
        s.at(J::per_dowel_stiffness, 0) = 1 / k;
        s.at(J::dowel_yield, 0) = 1e9;
        const double reach = Slab::height / 4;
        s.set_vector(OfBody::x, slab.body, {0.01, part * reach, -0.02});
        s.run(1);
        EXPECT_NEAR(s.at(J::dowel_force, 0), part < 1 ? -0.02 * k : 0, 1e-6);   // along z
        EXPECT_NEAR(s.at(J::dowel_force, 0, 1), part < 1 ? 0.01 * k : 0, 1e-6); // along x
        EXPECT_NEAR(s.velocity(slab.body).x, part < 1 ? -0.01 * k / Slab::mass * s.step_s() : 0, 1e-12);
    }
}

// ---- eccentricity ---------------------------------------------------------------------------------------------------

/// A block on the ground with its centre of mass beside its axis: the anchors alone differ (`Solid::eccentricity_m`).
class Eccentric {
public:
    static constexpr double radius = 0.4, height = 2, mass = 2000;

    Eccentric(double stiffness, const Vec& e) : scene(1e-4)
    {
        const double area = std::numbers::pi * radius * radius;
        const int ground = scene.drum({0, -1, 0}, 100, 2, 1, true);
        body = scene.drum({0, height / 2, 0}, radius, height, mass);
        const double damping = 2 * 0.3 * std::sqrt(stiffness * area * mass);
        scene.joint(ground, body, BedKind::disc, {0, 0, 0}, {stiffness, stiffness, 0.9, damping, damping});
        scene.build();
        scene.set_vector(OfJoint::upper_anchor, 0, Vec{0, -height / 2, 0} - e);
        // the centre of the disc stays at the axis: in the reference state the centre of mass is at e
        scene.set_vector(OfJoint::lower_anchor, 0, Vec{0, 1, 0});
        scene.set_vector(OfBody::x, body, {0, -mass * g / (stiffness * area), 0});
    }

    Scene scene;
    int body;
};

TEST(SpatialEccentricity, RestsAtTheTiltOfItsMomentInItsDirection)
{
    // (k pi R^4/4 - W h) tilt = W e
    const double stiffness = 1e8, e = 0.02, azimuth = 0.9, R = Eccentric::radius, W = Eccentric::mass * g;
    Eccentric block(stiffness, e * Slab::along(azimuth));
    Scene& s = block.scene;
    s.run(80000);
    const double want = W * e / (stiffness * std::numbers::pi * R * R * R * R / 4 - W * Eccentric::height / 2);
    EXPECT_NEAR(s.tilt(block.body), want, 2e-3 * want);
    EXPECT_NEAR(std::atan2(s.axis(block.body).z, s.axis(block.body).x), azimuth, 1e-3);
}

TEST(SpatialEccentricity, OverturnsAtTheArmThatIsLeftInEachDirection)
{
    // a slowly growing acceleration of the base: g (R -+ e) / h of a rigid block
    const double stiffness = 3e10, e = 0.06, azimuth = 2.5;
    for (const double side : {1.0, -1.0}) {
        Eccentric block(stiffness, e * Slab::along(azimuth));
        Scene& s = block.scene;
        const double limit = g * (Eccentric::radius - side * e) / (Eccentric::height / 2);
        // the base runs away from the side to which the block falls
        const Vec way = -side * Slab::along(azimuth);
        const double ramp = 2, to = 1.03 * limit;
        double overturns = 0;
        while (s.time_s() < 3 && overturns == 0) {
            s.run(chunk_steps, [&](double t) { return std::min(t / ramp, 1.0) * to * way; });
            if (s.tilt(block.body) > 0.1)
                overturns = s.time_s();
        }
        // it takes some tenths of a second to lean so far
        EXPECT_GT(overturns, 0.93 * limit / to * ramp) << side;
        EXPECT_LT(overturns, ramp + 0.9) << side;
        EXPECT_GT(side * dot(s.axis(block.body), Slab::along(azimuth)), 0.09);
        Eccentric other(stiffness, e * Slab::along(azimuth));
        other.scene.run(30000, [&](double t) { return std::min(t / ramp, 1.0) * 0.93 * limit * way; });
        EXPECT_LT(other.scene.tilt(other.body), 0.02) << side;
    }
}

// ---- wedge ----------------------------------------------------------------------------------------------------------

/// @param about rotation of the face about x and z [rad]
void set_wedge(Scene& s, int j, double about_x, double about_z)
{
    const double angle = std::hypot(about_x, about_z), per = std::sin(angle / 2) / angle;
    s.at(J::wedge, j) = per * about_z;
    s.at(J::wedge, j, 1) = per * about_x;
}

TEST(SpatialWedge, ABlockRestsAtTheSlopeOfItsFace)
{
    // on the turned face it leans by the slope, and by what its weight adds: tilt (1 - W h / K) = slope
    const double stiffness = 1e9, about_x = 0.006, about_z = -0.011, slope = std::hypot(about_x, about_z);
    Eccentric block(stiffness, {0, 0, 0});
    Scene& s = block.scene;
    s.use_mechanisms();
    s.build();
    set_wedge(s, 0, about_x, about_z);
    s.set_attitude(block.body, {about_x / slope, 0, about_z / slope}, slope);
    s.set_vector(OfBody::x, block.body, {-about_z, -1e-5, about_x}); // of the centre, 1 m above the face
    s.run(40000);
    const double R = Eccentric::radius, W = Eccentric::mass * g;
    const double want = slope / (1 - W * Eccentric::height / 2 / (stiffness * std::numbers::pi * R * R * R * R / 4));
    EXPECT_NEAR(s.tilt(block.body), want, 1e-3 * (want - slope) + 1e-6);
    EXPECT_GT(want - slope, 1e-5);
    // rotated about (x, z): the axis goes to (-about_z, about_x)
    EXPECT_NEAR(s.axis(block.body).x, -about_z * want / slope, 1e-5);
    EXPECT_NEAR(s.axis(block.body).z, about_x * want / slope, 1e-5);
}

TEST(SpatialWedge, ASlabSlidesDownItsFace)
{
    const double mu = 0.1, slope = 0.3;
    Slab slab(mu);
    Scene& s = slab.scene;
    set_wedge(s, 0, 0.6 * slope, 0.8 * slope);
    s.set_attitude(slab.body, {0.6, 0, 0.8}, slope);
    const double half = Slab::height / 2;
    s.set_vector(OfBody::x, slab.body,
                 {-0.8 * half * std::sin(slope), half * (std::cos(slope) - 1), 0.6 * half * std::sin(slope)});
    const Vec start = s.centre(slab.body);
    s.run(4000);
    // down: against the horizontal part of the normal's opposite, (-0.8, 0.6) of it
    const double a = g * (std::sin(slope) - mu * std::cos(slope)), path = 0.5 * a * s.time_s() * s.time_s();
    const Vec way = s.centre(slab.body) - start;
    EXPECT_NEAR(way.x, -0.8 * path * std::cos(slope), 5e-3 * path);
    EXPECT_NEAR(way.z, 0.6 * path * std::cos(slope), 5e-3 * path);
    EXPECT_NEAR(way.y, -path * std::sin(slope), 5e-3 * path);
    // along the face: nothing presses but the weight, and friction alone loses
    const double W = Slab::mass * g * std::cos(slope);
    EXPECT_NEAR(s.at(OfJoint::normal, 0), W, 1e-3 * W);
    EXPECT_NEAR(s.friction(), mu * W * path, 5e-3 * mu * W * path);
    EXPECT_LT(s.dashpots(), 1e-3 * s.friction());
}

// ---- tie and base ---------------------------------------------------------------------------------------------------

TEST(SpatialTie, SwingsWithItsFrequencyAndLosesWhatItsDashpotTakes)
{
    // without friction: x'' = -w2 x - 2 d x' + f / m, along x and z
    const double k = 8e4, c = 200, f = 50, m = Slab::mass, d = c / (2 * m), w = std::sqrt(k / m - d * d);
    Slab slab(0);
    Scene& s = slab.scene;
    const double dt = s.step_s();
    s.at(B::tie_spring, slab.body) = dt * dt * k / m;
    s.at(B::tie_dashpot, slab.body) = dt * c / m;
    s.at(B::tie_pull, slab.body) = dt * dt * f / m;
    s.set_vector(OfBody::x, slab.body, {0.01 + f / k, s.at(OfBody::y, slab.body), -0.02});
    s.start_from_rest();
    s.run(1);
    const double start = s.balance();
    s.run(9998);
    const double t = s.time_s();
    const auto swing = [&](double at) { return std::exp(-d * at) * (std::cos(w * at) + d / w * std::sin(w * at)); };
    EXPECT_NEAR(s.at(OfBody::x, slab.body), f / k + 0.01 * swing(t), 2e-5);
    EXPECT_NEAR(s.at(OfBody::z, slab.body), -0.02 * swing(t), 4e-5);
    EXPECT_NEAR(s.balance(), start, 1e-9 * s.mechanisms());
    EXPECT_GT(s.mechanisms(), 0.5 * 0.5 * k * 0.0005);
}

TEST(SpatialTie, ItsTurningDashpotSlowsASpin)
{
    const double c_r = 30, inertia = 0.5 * Slab::mass * Slab::radius * Slab::radius;
    Slab slab(0);
    Scene& s = slab.scene;
    s.at(B::tie_turning, slab.body) = s.step_s() * c_r;
    s.set_motion(slab.body, {0, 0, 0}, {0, 2, 0});
    s.run(10000);
    EXPECT_NEAR(s.omega(slab.body).y, 2 * std::exp(-c_r / inertia * s.time_s()), 1e-3);
    EXPECT_NEAR(s.kinetic() + s.mechanisms(), 0.5 * inertia * 4, 1e-3 * inertia);
}

TEST(SpatialVerticalMotion, FrictionFollowsTheWeightUnderAnAcceleratedBase)
{
    // a base that sinks at 0.4 g leaves 0.6 of the weight: it slips above mu 0.6 g, and holds below
    const double mu = 0.5, part = 0.6;
    for (const double times : {0.97, 1.03}) {
        Slab slab(mu);
        Scene& s = slab.scene;
        const double stiffness = Slab::stiffness * Slab::area();
        s.set_vector(OfBody::x, slab.body, {0, -part * Slab::mass * g / stiffness, 0});
        const double a = times * mu * part * g;
        const auto base = [&](double t) {
            return Vec{0.6 * std::min(10 * t, 1.0) * a, (part - 1) * g, 0.8 * std::min(10 * t, 1.0) * a};
        };
        s.run(1000, base);
        EXPECT_NEAR(s.at(OfJoint::normal, 0), part * Slab::mass * g, 1e-3 * Slab::mass * g);
        s.run(2000, base);
        const double moved = length(s.vector(OfBody::x, slab.body));
        if (times < 1)
            EXPECT_LT(moved, 1e-4);
        else
            EXPECT_NEAR(moved, 0.5 * 0.03 * mu * part * g * 0.2 * 0.2, 4e-4);
    }
}

// ---- all of them ----------------------------------------------------------------------------------------------------

/// Two drums and a beam on a ground, shaken in three directions.
struct Shaken {
    explicit Shaken(bool with_mechanisms, double step_s = 1e-4, double damping = 2e4) : scene(step_s)
    {
        const Scene::Law law{1e9, 8e8, 0.4, damping, damping};
        scene.use_mechanisms(with_mechanisms);
        const int ground = scene.box({0, -0.5, 0}, {4, 1, 4}, 1, true);
        const int low = scene.drum({0, 0.5, 0}, 0.5, 1, 1900), high = scene.drum({0, 1.5, 0}, 0.46, 1, 1700);
        const int beam = scene.box({0, 2.3, 0}, {2, 0.6, 0.8}, 2500);
        scene.joint(ground, low, BedKind::rectangle, {0, 0, 0}, law);
        scene.joint(low, high, BedKind::disc, {0, 1, 0}, law);
        scene.joint(beam, high, BedKind::round, {0, 2, 0}, law, Axis::y, true);
        scene.build();
        scene.set_vector(OfBody::x, low, {0, -8e-5, 0});
        scene.set_vector(OfBody::x, high, {0, -1.4e-4, 0});
        scene.set_vector(OfBody::x, beam, {0, -1.8e-4, 0});
    }
    void shake(long steps)
    {
        scene.run(steps, [](double t) {
            return Vec{5 * std::sin(20 * t), 2 * std::sin(31 * t), 4 * std::sin(17 * t + 1) - 4 * std::sin(1.0)};
        });
    }

    Scene scene;
};

struct Case {
    std::string name;
    std::function<void(Scene&)> set;
};

void each_joint(Scene& s, const std::function<void(int)>& set)
{
    for (int j = 0; j < s.topology().joints; ++j)
        set(j);
}

std::vector<Case> cases()
{
    return {{"stribeck",
             [](Scene& s) {
                 each_joint(s, [&s](int j) {
                     s.at(J::friction_drop, j) = 0.5;
                     s.at(J::per_stribeck_step, j) = 1 / (0.05 * s.step_s());
                 });
             }},
            {"friction_wear", [](Scene& s) { each_joint(s, [&s](int j) { s.at(J::wear, j) = 3; }); }},
            {"adhesion", [](Scene& s) { each_joint(s, [&s](int j) { s.at(J::adhesion, j) = 2e3; }); }},
            {"dowel",
             [](Scene& s) {
                 each_joint(s, [&s](int j) {
                     s.at(J::dowel_stiffness, j) = 1e8;
                     s.at(J::per_dowel_stiffness, j) = 1e-8;
                     s.at(J::dowel_yield, j) = 3e3;
                     s.at(J::dowel_gap, j) = 2e-5;
                 });
             }},
            {"face_damping",
             [](Scene& s) {
                 each_joint(s, [&s](int j) {
                     s.at(J::face_share, j) = 0.6;
                     s.at(J::face_dashpot, j) = 0.6 * 2e4 / (2 * s.step_s());
                 });
             }},
            {"wedge",
             [](Scene& s) {
                 set_wedge(s, 1, 1e-4, -2e-4);
                 set_wedge(s, 2, -2e-4, 1e-4);
                 s.at(J::wedge_at, 2) = 0.1;
             }},
            {"tie", [](Scene& s) {
                 for (int i = 1; i < s.topology().bodies; ++i) {
                     s.at(B::tie_spring, i) = s.step_s() * s.step_s() * 1e5 / s.mass(i);
                     s.at(B::tie_dashpot, i) = s.step_s() * 2e3 / s.mass(i);
                     s.at(B::tie_pull, i) = s.step_s() * s.step_s() * 200 / s.mass(i);
                     s.at(B::tie_turning, i) = s.step_s() * 500;
                 }
             }}};
}

TEST(SpatialMechanisms, NeutralOnesGiveTheBitsOfThePlainStep)
{
    Shaken plain(false), neutral(true);
    plain.shake(6000);
    neutral.shake(6000);
    const auto same = [&](auto field, int rows) {
        using Field = decltype(field);
        for (int row = 0; row < rows; ++row)
            for (int f = 0; f < Bundle::fields<Field>; ++f)
                EXPECT_EQ(std::bit_cast<std::uint64_t>(plain.scene.bundle().at(static_cast<Field>(f), row, 0)),
                          std::bit_cast<std::uint64_t>(neutral.scene.bundle().at(static_cast<Field>(f), row, 0)))
                    << typeid(Field).name() << ' ' << row << ' ' << f;
    };
    same(OfBody::x, plain.scene.topology().bodies);
    same(OfJoint::spring_1, plain.scene.topology().joints);
    same(OfRealization::dt2, 1);
    EXPECT_GT(plain.scene.friction(), 10); // it slips and rocks
}

TEST(SpatialMechanisms, EachChangesTheMotionAndLosesNoEnergy)
{
    Shaken plain(true);
    plain.shake(6000);
    for (const Case& of : cases()) {
        double lacks[2]{};
        for (int halved = 0; halved < 2; ++halved) {
            Shaken shaken(true, halved ? 5e-5 : 1e-4);
            of.set(shaken.scene);
            Scene& s = shaken.scene;
            s.run(1);
            const double start = s.balance();
            shaken.shake(halved ? 12000 : 6000);
            const double through = s.friction() + s.dashpots() + s.mechanisms() + s.kinetic();
            lacks[halved] = std::fabs(s.balance() - start) / through;
            EXPECT_GT(length(s.vector(OfBody::x, 3) - plain.scene.vector(OfBody::x, 3)), 1e-7) << of.name;
        }
        EXPECT_LT(lacks[0], 2e-3) << of.name;
        EXPECT_LT(lacks[1], 1.5e-3) << of.name;
    }
}

} // namespace
} // namespace stylobate::spatial
