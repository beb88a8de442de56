// The safe step of structures in space: the published table, closed forms, and drums that roll.

#include "ensemble/model/input_error.hpp"
#include "ensemble/spatial/structure/step_bound.hpp"
#include "tests/ensemble/spatial/standing.hpp"
#include "tests/kernels/spatial/scene.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

/// A column of equal drums on a fixed one; its step bound in 1/w1, w1^2 = k A / m.
double column_bound(double radius, double half_height, double damping, int drums = 6)
{
    const double mass = 1000, k = 1e9;
    Standing s;
    int below = s.drum({0, -2 * half_height, 0}, radius, 2 * half_height, mass, true);
    for (int i = 0; i < drums; ++i) {
        const int above = s.drum({0, 2 * half_height * i, 0}, radius, 2 * half_height, mass);
        s.bed(below, above, {k, 0.7, damping, mass});
        below = above;
    }
    return spatial_step_bound_s(s.r) * std::sqrt(k * std::numbers::pi * radius * radius / mass);
}

/// A drum that rolls on its rim: how it moves in 0.3 s with a step.
struct Rolled {
    double tilt = 0;     ///< at the end [rad]
    double friction = 0; ///< energy lost in it, over the weight times the radius times the tilt
};

constexpr double radius = 0.024, half_height = 0.0145, mass = 0.1355 * std::numbers::pi / 4, bed_k = 1e8 / 0.048;
constexpr double start_tilt = 0.1;

Rolled roll(double step_s, double damping)
{
    using namespace spatial;
    const double area = std::numbers::pi * radius * radius, c = 2 * damping * std::sqrt(bed_k * area * mass);
    Scene s(step_s);
    const int base = s.drum({0, -half_height, 0}, radius, 2 * half_height, mass, true);
    const int drum = s.drum({0, half_height, 0}, radius, 2 * half_height, mass);
    s.joint(base, drum, BedKind::disc, {0, 0, 0}, {bed_k, bed_k * area, 5, c, c});
    s.build();
    // a steady wobble on the rim at x = R, whose contact point is at rest: the rate of precession of a disc that rolls
    // without a forward motion (the prototype's root for these sizes)
    const double rate = 66.37395833, sine = std::sin(start_tilt), cosine = std::cos(start_tilt), sink = 2.2e-6;
    s.set_attitude(drum, {0, 0, 1}, -start_tilt);
    s.set_vector(OfBody::x, drum,
                 {radius - (radius * cosine - half_height * sine),
                  radius * sine + half_height * cosine - half_height - sink, 0});
    const Vec omega{-rate * sine / cosine, 0, 0};
    const Vec contact{radius * cosine - half_height * sine, -half_height * cosine - radius * sine, 0};
    s.set_motion(drum, -1.0 * cross(omega, contact), omega);
    s.run(static_cast<long>(0.3 / step_s));
    return {s.tilt(drum), s.friction() / (mass * Scene::gravity_m_s2 * radius * start_tilt)};
}

double rolling_bound_s(double damping)
{
    Standing s;
    const int base = s.drum({0, -2 * half_height, 0}, radius, 2 * half_height, mass, true),
              drum = s.drum({0, 0, 0}, radius, 2 * half_height, mass);
    s.bed(base, drum, {bed_k, 5, damping, mass});
    return spatial_step_bound_s(s.r);
}

} // namespace

// kernels/spatial/THEORY.md, section 9: computed there by an independent program.
TEST(SpatialStepBound, IsThePublishedTable)
{
    struct Row {
        double radius, half_height;
        std::array<double, 4> bounds; ///< for damping ratios 0, 0.1, 0.3, 0.5
    };
    const Row rows[] = {{0.024, 0.0145, {0.577, 0.568, 0.358, 0.248}},
                        {1, 1, {0.519, 0.487, 0.292, 0.198}},
                        {0.5, 1, {0.470, 0.425, 0.243, 0.162}}};
    constexpr std::array<double, 4> damping{0, 0.1, 0.3, 0.5};
    for (const Row& row : rows)
        for (std::size_t i = 0; i < damping.size(); ++i)
            EXPECT_NEAR(column_bound(row.radius, row.half_height, damping[i]), row.bounds[i], 5e-4)
                << row.radius / row.half_height << ' ' << damping[i];
}

// A drum on a fixed one has one bed, whose energy is its own: without dashpots the bound is sqrt 2 times as long as
// that of the same bed between two free bodies.
TEST(SpatialStepBound, AFixedNeighbourTakesNoShare)
{
    Standing fixed, free;
    for (Standing* s : {&fixed, &free}) {
        const int low = s->drum({0, -1, 0}, 0.5, 1, 1000, s == &fixed), high = s->drum({0, 0, 0}, 0.5, 1, 1000);
        s->bed(low, high, {1e9});
    }
    EXPECT_NEAR(spatial_step_bound_s(fixed.r) / spatial_step_bound_s(free.r), std::sqrt(2.0), 1e-8);
}

// A body on a frictionless rectangle without dashpots: the stiffest motions are those of the full face, k A / m and
// k I / I_x.
TEST(SpatialStepBound, WithoutFrictionItIsThatOfTheFullFace)
{
    for (const double half_z : {0.3, 0.8}) {
        Standing s;
        const double half_x = 0.5, height = 0.2, kg = 1000, k = 1e9;
        const int base = s.body({0, -1, 0}, half_x, half_z, 1, kg, false, true),
                  slab = s.body({0, 0, 0}, half_x, half_z, height, kg, false);
        const int bed = s.bed(base, slab, {k});
        s.r.space.joints[static_cast<std::size_t>(bed)].tangential_stiffness_n_m = 0;
        const double area = 4 * half_x * half_z;
        double most = k * area / kg;
        for (const double half : {half_x, half_z})
            most = std::max(most, k * area * half * half / 3 / (kg * (half * half / 3 + height * height / 12)));
        EXPECT_NEAR(spatial_step_bound_s(s.r) * std::sqrt(most) / 2, 1, 1e-8);
    }
}

// The same of a slab on a hollow bed: area and second moment are those of the frame.
TEST(SpatialStepBound, AHollowBedIsThatOfItsFrame)
{
    for (const double half_z : {0.3, 0.8}) {
        Standing s;
        const double half_x = 0.5, height = 0.2, kg = 1000, k = 1e9, ratio = 0.6;
        const int base = s.body({0, -1, 0}, half_x, half_z, 1, kg, false, true),
                  slab = s.body({0, 0, 0}, half_x, half_z, height, kg, false);
        SolidJoint& bed = s.r.space.joints[static_cast<std::size_t>(s.bed(base, slab, {k}))];
        bed.tangential_stiffness_n_m = 0;
        bed.inner_ratio = ratio;
        const double whole = 4 * half_x * half_z, area = (1 - ratio * ratio) * whole;
        double most = k * area / kg;
        for (const double half : {half_x, half_z})
            most = std::max(most, k * whole * (1 - std::pow(ratio, 4)) * half * half / 3 /
                                      (kg * (half * half / 3 + height * height / 12)));
        EXPECT_NEAR(spatial_step_bound_s(s.r) * std::sqrt(most) / 2, 1, 1e-6);
    }
}

// With the same friction spring a ring resists a spin farther out than the whole face, but no farther than the rim,
// which the states of the bound have anyway.
TEST(SpatialStepBound, ARingIsNotLongerThanItsWholeFace)
{
    const auto bound = [](double ratio) {
        Standing s;
        const int base = s.drum({0, -1, 0}, 0.5, 1, 1000, true), drum = s.drum({0, 0, 0}, 0.5, 1, 1000);
        SolidJoint& bed = s.r.space.joints[static_cast<std::size_t>(s.bed(base, drum, {1e6}))]; // friction governs
        bed.tangential_stiffness_n_m = 1e9;
        bed.inner_ratio = ratio;
        return spatial_step_bound_s(s.r);
    };
    EXPECT_LE(bound(0.6), bound(0) * (1 + 1e-12));
    EXPECT_NEAR(bound(1e-4) / bound(0), 1, 1e-6);
}

// A square's corners are farther from its axis than the rim of the disc in it.
TEST(SpatialStepBound, SquaresAreBelowTheirDiscs)
{
    const auto bound = [](bool round) {
        Standing s;
        const double mass_of = round ? 1000 : 4000 / std::numbers::pi;
        int below = s.body({0, -1, 0}, 0.5, 0.5, 1, mass_of, round, true);
        for (int i = 0; i < 3; ++i) {
            const int above = s.body({0, 1.0 * i, 0}, 0.5, 0.5, 1, mass_of, round);
            s.bed(below, above, {1e9, 0.7, 0.1, mass_of});
            below = above;
        }
        return spatial_step_bound_s(s.r);
    };
    EXPECT_LT(bound(false), bound(true));
    EXPECT_GT(bound(false), 0.7 * bound(true));
}

// The sum over a beam's joints is that of all it touches: a beam that butts another one has a shorter step.
TEST(SpatialStepBound, ButtJointsCount)
{
    const auto bound = [](bool butted) {
        Standing s;
        const double kg = 100; // so light that it governs
        std::array<int, 3> blocks{};
        for (int c = 0; c < 3; ++c)
            blocks[static_cast<std::size_t>(c)] = s.body({3.0 * c, -1, 0}, 0.5, 0.5, 1, 1000, false, true);
        const int left = s.beam({1.5, 0, 0}, 1.5, 0.4, 0.5, kg), right = s.beam({4.5, 0, 0}, 1.5, 0.4, 0.5, kg);
        s.bed(blocks[0], left, {1e9});
        s.bed(blocks[1], left, {1e9});
        s.bed(blocks[1], right, {1e9});
        s.bed(blocks[2], right, {1e9});
        if (butted)
            s.butt(left, right, {1e9});
        return spatial_step_bound_s(s.r);
    };
    EXPECT_LT(bound(true), 0.95 * bound(false));
}

TEST(SpatialStepBound, ARollingDrumIsStableBelowIt)
{
    for (const double damping : {0.0, 0.1}) {
        const double bound = rolling_bound_s(damping);
        const Rolled fine = roll(0.2 * bound, damping), near = roll(0.9 * bound, damping);
        EXPECT_GT(fine.tilt, 0.08) << damping; // it rolls on
        EXPECT_NEAR(near.tilt, fine.tilt, 0.03 * start_tilt) << damping;
        EXPECT_LT(near.friction, fine.friction + 0.01) << damping;
    }
}

// Far above the bound the spin on the rim is unstable: what it gains is lost in friction, and the drum settles.
TEST(SpatialStepBound, ARollingDrumIsUnstableFarAboveIt)
{
    const double bound = rolling_bound_s(0);
    const Rolled fine = roll(0.2 * bound, 0), above = roll(1.6 * bound, 0);
    EXPECT_GT(std::fabs(above.tilt - fine.tilt) + above.friction, 0.1);
}

TEST(SpatialStepBound, TheStructureAtFullContactIsRefused)
{
    Standing s;
    const int base = s.drum({0, -1, 0}, 0.5, 1, 1000, true), drum = s.drum({0, 0, 0}, 0.5, 1, 1000);
    s.bed(base, drum, {1e9});
    EXPECT_THROW(spatial_step_bound_s(s.r, StepBasis::structure), InputError);
}

} // namespace stylobate
