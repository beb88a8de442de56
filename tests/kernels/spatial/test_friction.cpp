// Dashpot and friction of a bed in space: limits by hand, sums over the patch by brute force, and the energy that is
// lost.

#include "kernels/spatial/friction.hpp"

#include "tests/kernels/spatial/polygon_reference.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace stylobate::spatial {
namespace {

class Random {
public:
    double in(double least, double most) { return least + (most - least) * unit_(generator_); }
    Vector<double> vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }

private:
    std::mt19937_64 generator_{20260716};
    std::uniform_real_distribution<double> unit_{0, 1};
};

const FrictionLaw<double> no_dashpots{1e6, 1e-6, 0, 0, 0.7};
const FrictionSprings<double> at_rest{0, 0, 0};

/// A level disc of 0.5 m radius that is pressed evenly by 100 N, in closed form.
BedLoad<double> level_disc()
{
    const double R = 0.5, area = std::numbers::pi * R * R, second = area * R * R / 4;
    return {100, 0, 0, {0, 0, 0}, 0, 0, 1e-3, area, 0, 0, second, 0, second, 2 * R / 3, 1, 0, 0, 1, 0, 0};
}

double size(double x, double y, double z)
{
    return std::sqrt(x * x + y * y + z * z);
}

TEST(SpatialFriction, SticksWithItsStiffness)
{
    // 1e6 N/m by 2e-6 m and -1e-6 m; the limit of 70 N is far away
    const BedForce<double> bed = bed_force(level_disc(), no_dashpots, {{2e-6, -1e-6, 0}, {0, 0, 0}}, at_rest);
    EXPECT_DOUBLE_EQ(bed.force.x, -2);
    EXPECT_DOUBLE_EQ(bed.force.y, 1);
    EXPECT_DOUBLE_EQ(bed.force.z, 100);
    EXPECT_DOUBLE_EQ(bed.springs.x, 2);
    EXPECT_EQ(bed.torque.z, 0);
    EXPECT_EQ(bed.slip, 0);
    // torsion of K_t spread evenly over the disc: K_t R2/2 = 125000 N m
    const BedForce<double> spun = bed_force(level_disc(), no_dashpots, {{0, 0, 0}, {0, 0, 1e-6}}, at_rest);
    EXPECT_NEAR(spun.torque.z, -0.125, 1e-16);
    EXPECT_EQ(spun.force.x, 0);
}

TEST(SpatialFriction, SlidesOnTheConeAgainstTheMotion)
{
    const BedForce<double> bed = bed_force(level_disc(), no_dashpots, {{3e-3, -4e-3, 0}, {0, 0, 0}}, at_rest);
    EXPECT_NEAR(bed.force.x, -0.7 * 100 * 0.6, 1e-12);
    EXPECT_NEAR(bed.force.y, 0.7 * 100 * 0.8, 1e-12);
    // the trial force is 5000 N, 4930 N more than the limit
    EXPECT_NEAR(bed.slip, 4930 / 1e6, 1e-15);
    // the next step slides by all of its motion
    const BedForce<double> next = bed_force(level_disc(), no_dashpots, {{3e-3, -4e-3, 0}, {0, 0, 0}}, bed.springs);
    EXPECT_NEAR(next.slip, 5e-3, 1e-15);
}

TEST(SpatialFriction, SpinsAtTwoThirdsOfRadiusTimesLimit)
{
    // evenly pressed disc: the integral of mu p r over the face is 2/3 mu N R
    const BedForce<double> bed = bed_force(level_disc(), no_dashpots, {{0, 0, 0}, {0, 0, -0.1}}, at_rest);
    EXPECT_NEAR(bed.torque.z, 2.0 / 3 * 0.7 * 100 * 0.5, 1e-12);
    EXPECT_NEAR(size(bed.force.x, bed.force.y, 0), 0, 1e-12);
}

TEST(SpatialFriction, ForcesAndTorsionLieInASphere)
{
    Random random;
    FrictionSprings<double> springs = at_rest;
    FrictionLaw<double> law = no_dashpots;
    int limited = 0;
    for (int n = 0; n < 2000; ++n) {
        law.C_t_per_dt = n % 2 ? random.in(0, 1e6) : 0;
        const BedMotion<double> motion{random.vector(3e-5), random.vector(3e-5)};
        const BedForce<double> bed = bed_force(level_disc(), law, motion, springs);
        springs = bed.springs;
        const double total = size(bed.force.x, bed.force.y, bed.torque.z / (1.0 / 3));
        EXPECT_LE(total, 70 * (1 + 1e-14)) << n;
        EXPECT_LE(size(springs.x, springs.y, springs.twist), 70 * (1 + 1e-14)) << n;
        limited += total > 69.9999;
        // the dashpots along the face cannot drive: they are a projection on the sphere (Moreau)
        EXPECT_GE(bed.dashpots.x * bed.rates.x + bed.dashpots.y * bed.rates.y + bed.dashpots.twist * bed.rates.twist,
                  -1e-18)
            << n;
    }
    EXPECT_GT(limited, 300);
    EXPECT_LT(limited, 1900);
}

TEST(SpatialFriction, ActsAtTheCentreOfThePressure)
{
    // 100 N at (0.2, -0.1) of the face, which is tilted and turned: the force of friction has the arm of that point
    BedLoad<double> load = level_disc();
    const Matrix<double> m = minus_identity(rotation_by<double>(0.02, -0.03, 0.4));
    load.t11 = 1 + m.m11, load.t12 = m.m12, load.t21 = m.m21, load.t22 = 1 + m.m22;
    load.slope_x = -m.m31, load.slope_y = -m.m32;
    load.moment_x = 20, load.moment_y = -10;
    load.torque = {1, 2, 3};
    load.lateral_x = 0.5;
    const Vector<double> arm = rotated(m, {0.2, -0.1, 0});
    const Vector<double> w{1e-5, -2e-5, 3e-5}, v{2e-5, 1e-5, -1e-5};
    const BedForce<double> bed = bed_force(load, no_dashpots, {v, w}, at_rest);
    const Vector<double> slide = v + cross(w, arm);
    EXPECT_NEAR(bed.rates.x, slide.x, 1e-19);
    EXPECT_NEAR(bed.rates.y, slide.y, 1e-19);
    EXPECT_NEAR(bed.force.x - 0.5, -1e6 * slide.x, 1e-12);
    const Vector<double> torque = cross(arm, {bed.force.x - 0.5, bed.force.y, 0});
    EXPECT_NEAR(bed.torque.x, 1 + torque.x, 1e-12);
    EXPECT_NEAR(bed.torque.y, 2 + torque.y, 1e-12);
    EXPECT_NEAR(bed.torque.z, 3 + torque.z - 1.125e6 * w.z / 9, 1e-12); // (R 2/3)2 = 1/9 m2
}

TEST(SpatialFriction, NothingWhereFacesAreApart)
{
    BedLoad<double> load = level_disc();
    load.force = 0;
    const FrictionLaw<double> law{1e6, 1e-6, 1e5, 1e5, 0.7};
    for (const double v : {1e-3, -1e-3}) {
        const BedForce<double> bed = bed_force(load, law, {{v, v, v}, {v, -v, v}}, {5, 4, 3});
        EXPECT_EQ(size(bed.force.x, bed.force.y, bed.force.z), 0);
        EXPECT_EQ(size(bed.torque.x, bed.torque.y, bed.torque.z), 0);
        EXPECT_EQ(size(bed.springs.x, bed.springs.y, bed.springs.twist), 0);
    }
}

TEST(SpatialFriction, SpringsAndSlipTakeTheWorkToRounding)
{
    // a disc that is moved at random: the work of the mean force of each step is the springs' energy plus the loss
    Random random;
    BedLoad<double> load = level_disc();
    load.moment_x = 10, load.moment_y = 25, load.slope_x = 0.02, load.slope_y = -0.01;
    FrictionSprings<double> springs = at_rest;
    Vector<double> force{0, 0, 0}, torque{0, 0, 0};
    double work = 0, loss = 0;
    int slipped = 0;
    for (int n = 0; n < 1000; ++n) {
        const BedMotion<double> motion{random.vector(3e-5), random.vector(3e-5)};
        const BedForce<double> bed = bed_force(load, no_dashpots, motion, springs);
        const Vector<double> now{-bed.force.x, -bed.force.y, 0};
        const Vector<double> turning{-bed.torque.x, -bed.torque.y, -bed.torque.z};
        work += 0.5 * dot(now + force, motion.displacement) + 0.5 * dot(turning + torque, motion.rotation);
        force = now, torque = turning;
        loss += slip_loss(bed, springs, no_dashpots.per_K_t);
        springs = bed.springs;
        slipped += bed.slip > 0;
        ASSERT_NEAR(work, loss + spring_energy(springs, no_dashpots.per_K_t), 1e-13 * (1 + work)) << n;
    }
    EXPECT_GT(slipped, 100);
    EXPECT_LT(slipped, 900);
    EXPECT_GT(loss, 0.1 * work);
}

TEST(SpatialFriction, EnergyOfSlidingAndSpinningByHand)
{
    // once on the limit, a step of sliding takes mu N times its way; one of spinning takes 2/3 mu N R times its angle
    const BedForce<double> slid = bed_force(level_disc(), no_dashpots, {{1e-3, 0, 0}, {0, 0, 0}}, {70, 0, 0});
    EXPECT_NEAR(slip_loss(slid, {70, 0, 0}, 1e-6), 70 * 1e-3, 1e-15);
    const BedForce<double> spun = bed_force(level_disc(), no_dashpots, {{0, 0, 0}, {0, 0, 1e-3}}, {0, 0, 70});
    EXPECT_NEAR(slip_loss(spun, {0, 0, 70}, 1e-6), 70.0 / 3 * 1e-3, 1e-15);
    // 70 N on 1e6 N/m, and 70/3 N m on 125000 N m
    EXPECT_NEAR(spring_energy(FrictionSprings<double>{70, 0, 0}, 1e-6), 0.5 * 70 * 70e-6, 1e-18);
    EXPECT_NEAR(spring_energy(FrictionSprings<double>{0, 0, 70}, 1e-6), 0.5 * 70 / 3.0 * 70 / 3.0 / 125000, 1e-18);
}

TEST(SpatialDashpot, ByHand)
{
    // 5e4 N/m3 on pi/4 m2, closing by 1e-5 m; then opening so fast that it would pull; then a tilt about the middle
    const FrictionLaw<double> law{1e6, 1e-6, 5e4, 0, 0.7};
    const double c = 5e4 * std::numbers::pi / 4;
    EXPECT_NEAR(bed_force(level_disc(), law, {{0, 0, -1e-5}, {0, 0, 0}}, at_rest).normal, 100 + 1e-5 * c, 1e-12);
    EXPECT_NEAR(bed_force(level_disc(), law, {{0, 0, 1e-5}, {0, 0, 0}}, at_rest).normal, 100 - 1e-5 * c, 1e-12);
    EXPECT_EQ(bed_force(level_disc(), law, {{0, 0, 1}, {0, 0, 0}}, at_rest).normal, 0);
    // second moment of the disc: R2/4 of its area
    const BedForce<double> tilted = bed_force(level_disc(), law, {{0, 0, 0}, {2e-5, -3e-5, 0}}, at_rest);
    EXPECT_NEAR(tilted.torque.x, -2e-5 * c / 16, 1e-15);
    EXPECT_NEAR(tilted.torque.y, 3e-5 * c / 16, 1e-15);
    EXPECT_NEAR(tilted.normal, 100, 1e-12);
    // the loss is the work of the mean force: half of it where the dashpots begin
    EXPECT_NEAR(dashpot_loss(tilted, BedComponents<double>{}), 0.5 * 13e-10 * c / 16, 1e-18);
    EXPECT_NEAR(dashpot_loss(tilted, tilted.dashpots), 13e-10 * c / 16, 1e-18);
}

/// A pose of a rectangle over another one.
Scene rectangle_scene(Random& random, bool tilted)
{
    Scene s{{-0.9, 1.1, 1.1, -0.9}, {-0.8, -0.8, 0.7, 0.7}, {0.1, 0, 1.0, 0.9}, 0, 0, 0, 0, 0, 0};
    s.tilt = tilted ? random.in(0.01, 0.3) : 1e-6, s.azimuth = random.in(0, 6.3), s.twist = random.in(-0.6, 0.6);
    s.offset_x = random.in(-0.5, 0.5), s.offset_y = random.in(-0.5, 0.5), s.depth = s.tilt * random.in(0.5, 3);
    return s;
}

BedLoad<double> load_of(const Scene& s, const Placed& p, double stiffness)
{
    Polygon<double, 4> upper;
    for (int i = 0; i < 4; ++i)
        upper.x[i] = s.x[static_cast<std::size_t>(i)], upper.y[i] = s.y[static_cast<std::size_t>(i)];
    return polygon_bed(BedPose<double>{minus_identity(p.q), p.place}, PolygonBed<double, 4>{stiffness, upper, s.lower});
}

TEST(SpatialDashpot, IsASumOverThePatch)
{
    Random random;
    for (int n = 0; n < 20; ++n) {
        const Scene s = rectangle_scene(random, n % 2);
        const Placed p = placed(s);
        ASSERT_FALSE(p.sides.empty());
        const BedLoad<double> load = load_of(s, p, 1e9);
        FrictionLaw<double> law{1e6, 1e-6, 3e5, 0, 0}; // without friction: only the dashpot is left
        const BedMotion<double> motion{random.vector(1e-6), random.vector(1e-6)};
        const BedForce<double> bed = bed_force(load, law, motion, at_rest);
        ASSERT_GT(bed.normal, 0);
        // each point of the patch: c v along the normal, at its place
        Vector<double> torque{0, 0, 0};
        double force = 0;
        const Matrix<double> m = minus_identity(p.q);
        integrate(s, p, 4000, [&](double x, double y, double, double w) {
            const Vector<double> arm = rotated(m, {x, y, 0});
            const double f = -3e5 * w * (motion.displacement + cross(motion.rotation, arm)).z;
            force += f;
            torque = torque + cross(arm, {0, 0, f});
        });
        const double close = 1e-6 * 3e5 * 4e-6; // corners of the patch within a strip
        EXPECT_NEAR(bed.force.z - load.force, force, close) << n;
        EXPECT_NEAR(bed.torque.x - load.torque.x, torque.x, close) << n;
        EXPECT_NEAR(bed.torque.y - load.torque.y, torque.y, close) << n;
        EXPECT_NEAR(bed.torque.z - load.torque.z, 0, 1e-12) << n;
    }
}

TEST(SpatialDashpot, NeverPullsAndNeverDrives)
{
    Random random;
    int reduced = 0;
    for (int n = 0; n < 2000; ++n) {
        const Scene s = rectangle_scene(random, n % 2);
        const BedLoad<double> load = load_of(s, placed(s), 1e6);
        const FrictionLaw<double> law{1e6, 1e-6, random.in(0, 1e9), random.in(0, 1e6), 0.7};
        const double size = s.depth * std::pow(10, random.in(-4, 0));
        const BedForce<double> bed = bed_force(load, law, {random.vector(size), random.vector(size)}, at_rest);
        EXPECT_GE(bed.normal, 0) << n;
        reduced += bed.normal == 0;
        const BedComponents<double>&d = bed.dashpots, &r = bed.rates;
        const double terms[] = {d.normal * r.normal, d.tilt_x * r.tilt_x, d.tilt_y * r.tilt_y};
        const double rounding = 1e-13 * (std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]));
        EXPECT_GE(terms[0] + terms[1] + terms[2], -rounding) << n;
        EXPECT_LE(std::hypot(bed.springs.x, bed.springs.y), 0.7 * bed.normal * (1 + 1e-12)) << n;
    }
    EXPECT_GT(reduced, 100);
    EXPECT_LT(reduced, 1900);
}

} // namespace
} // namespace stylobate::spatial
