// Dashpots at the ends of the patch (`face_damping`): by hand, what they never do, and how much an impact and rolling
// lose with them. Rigid blocks that rock lose what the angular momentum about the new edge takes (Housner): with it,
// the rate after the impact is e = 1 - 2 r^2 / (I / m + r^2 + h^2) of that before it, for an edge at the distance r
// from the axis and the centre of mass at the height h.

#include "kernels/spatial/disc_bed.hpp"
#include "tests/kernels/spatial/leaning.hpp"

#include "kernels/spatial/mechanisms/face_damping.hpp"

#include <gtest/gtest.h>

#include <random>

namespace stylobate::spatial {
namespace {

using J = OfJointMechanisms;

constexpr double g = Scene::gravity_m_s2, pi = std::numbers::pi;

enum class Foot { rim, edge, corner };

/// A block of radius or half width b and half height h that rocks from one side to the other in one plane.
struct Rocking {
    Foot foot;
    double b, h;

    double reach() const { return foot == Foot::corner ? std::numbers::sqrt2 * b : b; }
    double area() const { return (foot == Foot::rim ? pi : 4) * b * b; }
    double mass() const { return 2700 * area() * 2 * h; }
    double slenderness() const { return std::atan2(reach(), h); } ///< the angle at which it overturns
    /// I / m about a horizontal axis through the centre of mass.
    double gyration2() const { return foot == Foot::rim ? b * b / 4 + h * h / 3 : (b * b + h * h) / 3; }
    double rigid_restitution() const { return 1 - 2 * reach() * reach() / (gyration2() + reach() * reach() + h * h); }
    /// How high the centre of mass lies above its place at rest, over the distance to the pivot.
    double rise(double angle) const { return std::cos(slenderness() - angle) - std::cos(slenderness()); }
    /// Where the rigid block turns back after its first impact, as a part of the angle from which it fell.
    double rigid_turn_back(double angle) const
    {
        const double e = rigid_restitution(), left = e * e * rise(angle) + std::cos(slenderness());
        return (slenderness() - std::acos(std::min(left, 1.0))) / angle;
    }
};

/// @param ratio of the dashpots to critical ones;  @param share of the normal one at the ends
Scene standing(const Rocking& block, double k, double ratio, double share, double part_of_period = 0.05)
{
    const double K = k * block.area(), c = 2 * ratio * std::sqrt(K * block.mass());
    Scene s(part_of_period * std::sqrt(block.mass() / K));
    s.use_mechanisms();
    const Scene::Law law{k, K, 10, c, c};
    if (block.foot == Foot::rim) {
        s.drum({0, -block.h, 0}, 10 * block.b, 2 * block.h, 1, true);
        s.drum({0, block.h, 0}, block.b, 2 * block.h, block.mass());
        s.joint(0, 1, BedKind::disc, {0, 0, 0}, law);
    } else {
        s.box({0, -block.h, 0}, {20 * block.b, 2 * block.h, 20 * block.b}, 1, true);
        s.box({0, block.h, 0}, {2 * block.b, 2 * block.h, 2 * block.b}, block.mass());
        s.joint(0, 1, BedKind::rectangle, {0, 0, 0}, law);
    }
    s.build();
    s.at(J::face_share, 0) = share;
    s.at(J::face_dashpot, 0) = share * c / (2 * s.step_s());
    return s;
}

double energy(Scene& s)
{
    return s.kinetic() + s.potential() + s.elastic() + s.springs();
}

struct Landing {
    double turn_back;   ///< the first one, over the angle from which the block fell
    double restitution; ///< square root of the part of the energy above the state at rest that is left then
};

/// A block that falls from a part of its angle of overturning.
Landing land(const Rocking& block, double part, double k, double ratio, double share)
{
    Scene s = standing(block, k, ratio, share);
    const Vec towards = block.foot == Foot::corner ? Vec{std::sqrt(0.5), 0, std::sqrt(0.5)}
                        : block.foot == Foot::edge ? Vec{1, 0, 0}
                                                   : Vec{0.6, 0, 0.8};
    const double angle = part * block.slenderness();
    const Lean lean{towards, angle, block.reach(), block.h};
    place(s, 1, 0, lean, block.mass() * g);
    s.start_from_rest();
    s.run(1);
    const double start = energy(s);
    double most = 0;
    for (bool over = false; s.time_s() < 3 && !(over && 0 - lean_of(s, 1, lean) < 0.9 * most);) {
        s.run(1);
        over |= lean_of(s, 1, lean) < 0;
        most = std::max(most, 0 - lean_of(s, 1, lean));
    }
    const double given = block.mass() * g * std::hypot(block.reach(), block.h) * block.rise(angle);
    return {most / angle, std::sqrt(1 - (start - energy(s)) / given)};
}

constexpr Rocking slender_drum{Foot::rim, 0.024, 0.087}, stout_drum{Foot::rim, 0.025, 0.05},
    on_edge{Foot::edge, 0.024, 0.087}, on_corner{Foot::corner, 0.024, 0.087};

TEST(SpatialImpact, HousnersRestitutionInItsUsualForms)
{
    const double sine = std::sin(on_edge.slenderness()), R = slender_drum.b, h = slender_drum.h;
    EXPECT_NEAR(on_edge.rigid_restitution(), 1 - 1.5 * sine * sine, 1e-12);
    EXPECT_NEAR(slender_drum.rigid_restitution(), (4 * h * h / 3 - 0.75 * R * R) / (1.25 * R * R + 4 * h * h / 3),
                1e-12);
    EXPECT_NEAR(slender_drum.rigid_turn_back(0.5 * slender_drum.slenderness()), 0.734, 5e-4);
}

// With dashpots spread over the patch a landing takes a quarter to a half of what it takes from a rigid block, with
// those at the ends most of it. THEORY.md, section 10, has the table.
TEST(SpatialImpact, ALandingTakesWhatItTakesFromARigidBlock)
{
    for (const Rocking& block : {slender_drum, on_edge, on_corner}) {
        const double rigid = block.rigid_turn_back(0.5 * block.slenderness()), e = block.rigid_restitution();
        const bool round = block.foot == Foot::rim;
        for (const double k : {1e10, 1e11})
            for (const double ratio : {0.3, 0.5}) {
                const Landing at_ends = land(block, 0.5, k, ratio, 1), spread = land(block, 0.5, k, ratio, 0);
                EXPECT_NEAR(at_ends.turn_back, rigid, (round ? 0.1 : 0.06) * rigid) << k << ' ' << ratio;
                EXPECT_NEAR(at_ends.restitution, e, (round ? 0.04 : 0.035) * e) << k << ' ' << ratio;
                EXPECT_GT(spread.turn_back, 1.15 * rigid) << k << ' ' << ratio;
                EXPECT_GT(spread.restitution, 1.05 * e) << k << ' ' << ratio;
            }
    }
    // a stout drum loses half of its energy at once
    const double e = stout_drum.rigid_restitution();
    for (const double ratio : {0.3, 0.5}) {
        EXPECT_NEAR(land(stout_drum, 0.5, 1e10, ratio, 1).restitution, e, 0.12 * e) << ratio;
        EXPECT_GT(land(stout_drum, 0.5, 1e10, ratio, 0).restitution, 1.25 * e) << ratio;
    }
}

// A rigid drum that does not fall exactly along a line does not land: it rolls over its rim, ever so fast, to the other
// side, and loses nothing. Dashpots at the ends take no more from it than spread ones.
TEST(SpatialImpact, ADrumThatPassesItsRestPositionRollsOn)
{
    const double angle = 0.5 * slender_drum.slenderness(), R = slender_drum.b, h = slender_drum.h;
    const double given = slender_drum.mass() * g * std::hypot(R, h) * slender_drum.rise(angle);
    const double p = std::sqrt(g * std::hypot(R, h) / (slender_drum.gyration2() + R * R + h * h));
    double lost[2]{};
    for (const int share : {0, 1}) {
        Scene s = standing(slender_drum, 1e10, 0.5, share);
        const Lean lean{{1, 0, 0}, angle, R, h};
        place(s, 1, 0, lean, slender_drum.mass() * g);
        const Vec aside = 0.01 * p * lean.towards;
        s.set_motion(1, cross(lean.to_pivot(), aside), aside);
        s.run(1);
        const double start = energy(s);
        double least = angle, most = 0;
        while (s.time_s() < 1 && !(most > 2 * least && s.tilt(1) < 0.98 * most)) {
            s.run(1);
            if (s.tilt(1) < least)
                least = most = s.tilt(1);
            most = std::max(most, s.tilt(1));
        }
        EXPECT_NEAR(least, 0.006, 5e-4); // it never lay flat
        lost[share] = (start - energy(s)) / given;
    }
    const double e = slender_drum.rigid_restitution();
    EXPECT_LT(lost[1], 0.15 * (1 - e * e));
    EXPECT_NEAR(lost[1], lost[0], 0.3 * lost[0]);
}

TEST(SpatialImpact, ARollingDrumIsBrakedNoMoreThanBySpreadDashpots)
{
    // rolls on its rim, turning about it so that the rotation has no vertical part
    const double R = 0.024, h = 0.0145, angle = 0.1, rate = 66.37395833;
    const Rocking drum{Foot::rim, R, h};
    double lost[2]{};
    for (const int share : {0, 1}) {
        Scene s = standing(drum, 5e10, 0.3, share, 0.1);
        const Lean lean{{0, 0, 1}, angle, R, h};
        place(s, 1, 0, lean, drum.mass() * g);
        const Vec omega{0, 0, 0 - rate * std::tan(angle)};
        s.set_motion(1, cross(lean.to_pivot(), omega), omega);
        s.run(1);
        const double start = energy(s);
        while (s.time_s() < 2 * 2 * pi / rate)
            s.run(1);
        lost[share] = start - energy(s);
    }
    EXPECT_GT(lost[0], 0);
    EXPECT_NEAR(lost[1], lost[0], 0.03 * lost[0]);
}

// ---------------------------------------------------------------- the law itself

/// The load of a disc of radius 1 on a plane, deepest towards (cos, sin) of an angle.
BedLoad<double> disc_load(double depth, double slope, double towards, double k)
{
    const double x = slope * std::cos(towards), y = slope * std::sin(towards);
    // the rotation that tilts the normal by it
    const Quaternion<double> q{std::sqrt(1 - slope * slope / 4), 0 - y / 2, x / 2, 0};
    return disc_bed(BedPose<double>{minus_identity(q), {0, 0, 0 - depth}}, DiscBed<double>{k, 1, 1e3});
}

struct Resisted {
    BedComponents<double> rates, resistance;
    double power() const
    {
        return rates.normal * resistance.normal + rates.tilt_x * resistance.tilt_x + rates.tilt_y * resistance.tilt_y;
    }
};

Resisted resisted(const BedLoad<double>& load, double C, double share, double v, double bx, double by)
{
    Resisted of{{v, bx, by, 0, 0, 0}, {}};
    face_dashpot(load, FaceDamping<double>{share, share * C / 2, disc_reach2(0.0)}, C / pi, of.rates, of.resistance);
    return of;
}

TEST(SpatialFaceDamping, AtFullContactTwoDashpotsOnTheRim)
{
    const double towards = 0.7, C = 3, v = -2e-6, turn = 3e-6, aside = 5e-6;
    const BedLoad<double> load = disc_load(1e-3, 1e-4, towards, 1e9); // pressed so much that none pulls
    const double x = std::cos(towards), y = std::sin(towards);
    const Resisted both = resisted(load, C, 1, v, turn * x - aside * y, turn * y + aside * x);
    EXPECT_NEAR(both.resistance.normal, C * v, 1e-6 * C * 1e-6);
    EXPECT_NEAR(both.resistance.tilt_x * x + both.resistance.tilt_y * y, C * turn, 1e-5 * C * turn);
    // across it is spread: I / A = 1/4
    EXPECT_NEAR(both.resistance.tilt_y * x - both.resistance.tilt_x * y, C / 4 * aside, 1e-5 * C * aside);
}

TEST(SpatialFaceDamping, AWholeShareLiesBetweenNoneAndAll)
{
    const BedLoad<double> load = disc_load(2e-4, 4e-4, 2.1, 1e9);
    const double C = 3, v = -2e-6, bx = 3e-6, by = -1e-6;
    const Resisted none = resisted(load, C, 0, v, bx, by), all = resisted(load, C, 1, v, bx, by),
                   some = resisted(load, C, 0.3, v, bx, by);
    BedComponents<double> spread{};
    spread_dashpot(load, C / pi, none.rates, spread);
    for (const auto part :
         {&BedComponents<double>::normal, &BedComponents<double>::tilt_x, &BedComponents<double>::tilt_y}) {
        EXPECT_NEAR(none.resistance.*part, spread.*part, 1e-12 * C * 1e-6);
        EXPECT_NEAR(some.resistance.*part, 0.7 * none.resistance.*part + 0.3 * all.resistance.*part, 1e-12 * C * 1e-6);
    }
}

TEST(SpatialFaceDamping, NeverPullsNeverDrivesAndStaysBelowItsBound)
{
    std::mt19937_64 generator(20261129);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto in = [&](double least, double most) { return least + (most - least) * unit(generator); };
    int reduced = 0, whole = 0;
    for (int n = 0; n < 5000; ++n) {
        const double slope = std::pow(10, in(-5, -1)), depth = slope * in(-0.98, 1.5), share = in(0, 1), C = in(0, 1e4);
        const BedLoad<double> load = disc_load(depth, slope, in(-pi, pi), 1e6);
        if (!(load.force > 0))
            continue;
        const double size = std::pow(10, in(-6, 0));
        const Resisted r = resisted(load, C, share, in(-size, size), in(-size, size), in(-size, size));
        EXPECT_LE(r.resistance.normal, load.force * (1 + 1e-12)) << n;
        const double v = r.rates.normal, b2 = r.rates.tilt_x * r.rates.tilt_x + r.rates.tilt_y * r.rates.tilt_y;
        EXPECT_GE(r.power(), -1e-12 * C * (v * v + b2)) << n;
        EXPECT_LE(r.power(), 2.05 * C * (v * v + b2)) << n; // both ends lie on the face, within 2 % of its radius
        (r.resistance.normal > (1 - 1e-9) * load.force ? reduced : whole) += 1;
    }
    EXPECT_GT(reduced, 100);
    EXPECT_GT(whole, 100);
}

TEST(SpatialFaceDamping, TheReachOfARectangleIsItsEdgeOrItsCorner)
{
    const auto reach2 = [](double x, double y) { return rectangle_reach2(x, y, 0.3, 0.2, 0.0); };
    EXPECT_NEAR(reach2(1e-3, 0), 3, 1e-12); // (h / (h / sqrt 3))2
    EXPECT_NEAR(reach2(0, -1e-5), 3, 1e-12);
    EXPECT_NEAR(reach2(-2e-3, 3e-3), 6, 1e-12); // both corners' sides as steep
    EXPECT_NEAR(reach2(0, 0), 3, 1e-12);        // level
}

// Radius of gyration of rings: I / A = (R4 - r4) / 4 (R2 - r2), of frames (b4 - c4) / 3 (b2 - c2).
TEST(SpatialFaceDamping, TheReachOfARingIsItsRim)
{
    for (const double q : {0.0, 0.4, 0.9}) {
        const double R = 2, disc = R * R * (1 - std::pow(q, 4)) / (4 * (1 - q * q)),
                     frame = R * R * (1 - std::pow(q, 4)) / (3 * (1 - q * q));
        EXPECT_NEAR(disc_reach2(q), R * R / disc, 1e-12) << q;
        EXPECT_NEAR(rectangle_reach2(1.0, 0.0, R, R, q), R * R / frame, 1e-12) << q;
    }
}

} // namespace
} // namespace stylobate::spatial
