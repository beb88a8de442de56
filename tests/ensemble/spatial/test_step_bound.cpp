// The safe step of structures in space: the published table, closed forms, and drums that roll.

#include "ensemble/model/input_error.hpp"
#include "ensemble/spatial/structure/step_bound.hpp"
#include "tests/ensemble/spatial/standing.hpp"
#include "tests/kernels/spatial/scene.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

/// A column of equal drums on a fixed one; its step bound in 1/w1, w1^2 = k A / m.
/// @param ends share of the normal dashpots at the ends of the contacts
double column_bound(double radius, double half_height, double damping, double ends = 0, int drums = 6)
{
    const double mass = 1000, k = 1e9;
    Standing s;
    int below = s.drum({0, -2 * half_height, 0}, radius, 2 * half_height, mass, true);
    for (int i = 0; i < drums; ++i) {
        const int above = s.drum({0, 2 * half_height * i, 0}, radius, 2 * half_height, mass);
        s.bed(below, above, {k, 0.7, damping, mass});
        below = above;
    }
    for (SolidJoint& joint : s.r.space.joints)
        joint.mechanisms.face_damping = ends;
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

/// Gives a body a push and a spin, and looks at it 8 chunks later: it may drift by the push in each step.
/// @param angle of the push, from x to z
void expect_bounded(Standing& s, int body, double angle, bool bounded)
{
    using B = spatial::OfBody;
    constexpr double push = 1e-7; // of a step [m]; turns likewise [rad]
    s.settle();
    const Standing::Vec from = s.u(body);
    s.at(B::dx, body) = push * std::cos(angle);
    s.at(B::dz, body) = push * std::sin(angle);
    s.at(B::l_y, body) = push * s.solid(body).inertia_kg_m2[1];
    s.run(8 * chunk_steps);
    const Standing::Vec moved = s.u(body) - from;
    const double most = std::max(std::hypot(moved.x, moved.z), std::fabs(s.at(B::turn_y, body)));
    EXPECT_EQ(most < 1e4 * push, bounded) << "step " << s.r.step_s << ", angle " << angle << ", moved " << most;
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

// A ring resists a spin farther out than its whole face, but no farther than the rim, which the states have anyway.
TEST(SpatialStepBound, ARingIsNotShorterThanItsWholeFace)
{
    const double mass_of = 1000, k = 1e9;
    const auto bound = [&](double ratio, double damping, bool of_its_area) {
        Standing s;
        const int base = s.drum({0, -1, 0}, 0.5, 1, mass_of, true), drum = s.drum({0, 0, 0}, 0.5, 1, mass_of);
        SolidJoint& bed = s.r.space.joints[static_cast<std::size_t>(s.bed(base, drum, {k, 0.7, damping, mass_of}))];
        bed.inner_ratio = ratio;
        if (of_its_area) { // as structures are built
            const double part = 1 - ratio * ratio;
            bed.tangential_stiffness_n_m *= part;
            bed.normal_damping_n_s_m3 /= std::sqrt(part);
            bed.tangential_damping_n_s_m3 /= std::sqrt(part);
        }
        return spatial_step_bound_s(s.r);
    };
    constexpr std::array<double, 3> ratio{0.3, 0.6, 0.9}, damped{1.032, 1.143, 1.362},
        damped_of_its_area{1.033, 1.178, 1.989};
    for (std::size_t i = 0; i < ratio.size(); ++i) {
        EXPECT_NEAR(bound(ratio[i], 0, false) / bound(0, 0, false), 1, 1e-9) << ratio[i]; // the rim governs
        EXPECT_NEAR(bound(ratio[i], 0.3, false) / bound(0, 0.3, false), damped[i], 6e-4) << ratio[i];
        EXPECT_NEAR(bound(ratio[i], 0, true) / bound(0, 0, true), 1 / std::sqrt(1 - ratio[i] * ratio[i]), 1e-8)
            << ratio[i];
        EXPECT_NEAR(bound(ratio[i], 0.3, true) / bound(0, 0.3, true), damped_of_its_area[i], 6e-4) << ratio[i];
    }
    EXPECT_NEAR(bound(1e-4, 0.3, false) / bound(0, 0.3, false), 1, 1e-6);
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

// Two free drums without friction whose dowel is far stiffer than their beds. Its relative motion has the exact rate
// k_d (1/m + h2/I) of both drums together, that is twice that of one with the other held: the bound is the limit.
TEST(SpatialStepBound, OfADowel)
{
    constexpr double kg = 1000, high = 0.5, k_d = 1e12;
    const auto pair = [](double step_s) {
        auto s = std::make_unique<Standing>();
        s->r.step_s = step_s;
        const int base = s->drum({0, -1, 0}, 0.5, 1, kg, true), low = s->drum({0, 0, 0}, 0.5, 2 * high, kg),
                  top = s->drum({0, 2 * high, 0}, 0.5, 2 * high, kg);
        s->bed(base, low, {1e8, 0.7});
        const int bed = s->bed(low, top, {1e8, 0});
        for (SolidJoint& joint : s->r.space.joints)
            joint.tangential_stiffness_n_m = 1e3;
        JointMechanisms& dowel = s->r.space.joints[static_cast<std::size_t>(bed)].mechanisms;
        dowel.dowel_stiffness_n_m = k_d;
        dowel.dowel_yield_n = 1e12;
        return s;
    };
    const double bound = spatial_step_bound_s(pair(1)->r), I = kg * (0.25 / 4 + 4 * high * high / 12),
                 exact = 2 / std::sqrt(2 * k_d * (1 / kg + high * high / I));
    EXPECT_NEAR(bound / exact, 1, 1e-3);
    EXPECT_LE(bound, exact);
    for (const double angle : {0.0, 2.0})
        for (const double part : {0.98, 1.02})
            expect_bounded(*pair(part * bound), 2, angle, part < 1);
}

// A tie holds its body to the base: k / m of its spring, and dashpots that are stable up to 2 m / c and 2 I / c_r.
TEST(SpatialStepBound, OfTies)
{
    constexpr double kg = 1000;
    const auto tied = [](double step_s, const BlockMechanisms& tie) {
        auto s = std::make_unique<Standing>();
        s->r.step_s = step_s;
        const int base = s->drum({0, -1, 0}, 0.5, 1, kg, true), drum = s->drum({0, 0, 0}, 0.5, 1, kg);
        s->bed(base, drum, {1e8, 0});
        s->r.space.joints[0].tangential_stiffness_n_m = 1e3;
        s->solid(drum).mechanisms = tie;
        return s;
    };
    BlockMechanisms spring, dashpot, turning;
    spring.tie_n_m = 1e12;
    dashpot.tie_n_s_m = 1e9;
    turning.tie_n_m_s = 1e9;
    const double I = kg * std::min(0.25 / 2, 0.25 / 4 + 1.0 / 12);
    const std::pair<BlockMechanisms, double> ties[] = {
        {spring, 2 / std::sqrt(1e12 / kg)}, {dashpot, 2 * kg / 1e9}, {turning, 2 * I / 1e9}};
    for (const auto& [tie, exact] : ties) {
        const double bound = spatial_step_bound_s(tied(1, tie)->r);
        EXPECT_NEAR(bound / exact, 1, 1e-3);
        EXPECT_LE(bound, exact * (1 + 1e-9));
        for (const double part : {0.98, 1.02})
            expect_bounded(*tied(part * bound, tie), 1, 0.7, part < 1);
    }
}

// ---- dashpots at the ends -------------------------------------------------------------------------------------------

// A slab whose dashpots govern, with C of the whole face. Spread ones resist a lift most, 4 m = 2 dt C. The ends of a
// disc resist a turn at full contact, 4 I = 2 dt C R2. A square that stands on a corner has all of C there, against its
// lift and its turn together: 4 = 2 dt C (1 / m + 2 b2 / I).
TEST(SpatialStepBound, DashpotsAtTheEndsHaveTheirLever)
{
    const double b = 0.5, height = 0.1, kg = 1000, ratio = 100;
    for (const bool round : {true, false})
        for (const double share : {0.0, 1.0}) {
            Standing s;
            const int base = s.body({0, -1, 0}, b, b, 1, kg, round, true),
                      slab = s.body({0, 0, 0}, b, b, height, kg, round);
            SolidJoint& bed = s.r.space.joints[static_cast<std::size_t>(s.bed(base, slab, {1, 0.7, ratio, kg}))];
            bed.tangential_stiffness_n_m = bed.tangential_damping_n_s_m3 = 0;
            bed.mechanisms.face_damping = share;
            const double C = bed.normal_damping_n_s_m3 * bed.area_m2,
                         turn = b * b / (s.solid(slab).inertia_kg_m2[0] / kg), most = round ? turn : 1 + 2 * turn;
            EXPECT_GT(most, 3);
            EXPECT_NEAR(spatial_step_bound_s(s.r) * C / (2 * kg) * (share > 0 ? most : 1), 1, 2e-3) << round << share;
        }
}

TEST(SpatialStepBound, AShareLiesBetweenNoneAndAll)
{
    for (const double damping : {0.3, 0.5}) {
        const double none = column_bound(0.5, 0.5, damping), half = column_bound(0.5, 0.5, damping, 0.5),
                     all = column_bound(0.5, 0.5, damping, 1);
        EXPECT_LT(all, half) << damping;
        EXPECT_LT(half, none) << damping;
        EXPECT_EQ(column_bound(0.5, 0.5, 0, 1), column_bound(0.5, 0.5, 0)); // without dashpots there are none
    }
}

/// Squares of the velocity and of the rotation at the edge of a block that was pushed at rest, over that of the push.
/// (Kinetic energy is a product of two steps, and negative where they alternate.)
struct Pushed {
    double most, last;
};

Pushed push(bool round, double b, double half, double damping, double part_of_bound)
{
    using namespace spatial;
    const double k = 3e9, area = (round ? std::numbers::pi : 4) * b * b, kg = 2700 * area * 2 * half,
                 c = 2 * damping * std::sqrt(k * area * kg);
    Standing held;
    const int ground = held.body({0, -1, 0}, 10 * b, 10 * b, 1, 1, round, true),
              block = held.body({0, 0, 0}, b, b, 2 * half, kg, round);
    held.bed(ground, block, {k, 10, damping, kg});
    held.r.space.joints[0].mechanisms.face_damping = 1;
    Scene s(part_of_bound * spatial_step_bound_s(held.r));
    s.use_mechanisms();
    if (round) {
        s.drum({0, -1, 0}, 10 * b, 2, 1, true);
        s.drum({0, half, 0}, b, 2 * half, kg);
    } else {
        s.box({0, -1, 0}, {20 * b, 2, 20 * b}, 1, true);
        s.box({0, half, 0}, {2 * b, 2 * half, 2 * b}, kg);
    }
    s.joint(0, 1, round ? BedKind::disc : BedKind::rectangle, {0, 0, 0}, {k, k * area, 10, c, c});
    s.build();
    s.at(spatial::OfJointMechanisms::face_share, 0) = 1;
    s.at(spatial::OfJointMechanisms::face_dashpot, 0) = c / (2 * s.step_s());
    s.set_vector(spatial::OfBody::x, 1, {0, -kg * Scene::gravity_m_s2 / (k * area), 0});
    const double v = 1e-3;
    s.set_motion(1, {v, 0.2 * v, 0.7 * v}, {v / b, v / b, v / b});
    Pushed of{};
    for (int i = 0; i < 5000; ++i) {
        s.run(1);
        const Vec moves = s.velocity(1), turns = b * s.omega(1);
        of.last = (dot(moves, moves) + dot(turns, turns)) / (v * v);
        of.most = std::max(of.most, of.last);
    }
    return of;
}

TEST(SpatialStepBound, BlocksWithDashpotsAtTheEndsAreStableBelowIt)
{
    for (const bool round : {true, false})
        for (const double half : {0.3, 0.5, 1.8})
            for (const double damping : {0.1, 0.3, 0.5, 1.0}) {
                EXPECT_LT(push(round, 0.5, half, damping, 0.95).last, 1e-5) << round << ' ' << half << ' ' << damping;
                EXPECT_GT(push(round, 0.5, half, damping, 1.3).most, 10) << round << ' ' << half << ' ' << damping;
            }
}

TEST(SpatialStepBound, TheStructureAtFullContactIsRefused)
{
    Standing s;
    const int base = s.drum({0, -1, 0}, 0.5, 1, 1000, true), drum = s.drum({0, 0, 0}, 0.5, 1, 1000);
    s.bed(base, drum, {1e9});
    EXPECT_THROW(spatial_step_bound_s(s.r, StepBasis::structure), InputError);
}

} // namespace stylobate
