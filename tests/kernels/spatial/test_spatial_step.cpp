// What the step in space leaves for the host: outcome sums, watch, trace; lanes that are empty; bodies that have fallen
// past each other.

#include "tests/kernels/spatial/leaning.hpp"

#include <gtest/gtest.h>

namespace stylobate::spatial {

namespace {

constexpr double g = Scene::gravity_m_s2, pi = std::numbers::pi;
constexpr double R = 0.5, mass = 1960, k = 1e9, K = k * pi * R * R;

Scene column(int drums, double mu = 0.6)
{
    const double c = 0.2 * std::sqrt(K * mass);
    Scene s(0.1 * std::sqrt(mass / K));
    s.drum({0, -0.5, 0}, 2 * R, 1, 1, true);
    for (int i = 0; i < drums; ++i)
        s.drum({0, i + 0.5, 0}, R, 1, mass);
    for (int i = 0; i < drums; ++i)
        s.joint(i, i + 1, BedKind::disc, {0, 1.0 * i, 0}, {k, K, mu, c, c});
    s.build();
    for (int i = 1; i <= drums; ++i)
        s.at(OfBody::y, i) = (i == 1 ? 0 : s.at(OfBody::y, i - 1)) - (drums + 1 - i) * mass * g / K;
    return s;
}

TEST(SpatialStep, AnEmptyLaneDoesNothing)
{
    // every kind of joint and body, all numbers 0
    const TopologyJoint joints[] = {{0, 1, BedKind::disc, Axis::y, false, true},
                                    {1, 2, BedKind::rectangle, Axis::y, false, true},
                                    {2, 3, BedKind::rectangle, Axis::x, false},
                                    {3, 1, BedKind::round, Axis::y, true, true}};
    const Axis correction[] = {Axis::none, Axis::none, Axis::x, Axis::z};
    Topology topology{4, 1, 3, 4, joints, correction};
    std::vector<int> lists(static_cast<std::size_t>(joint_lists_size(topology)));
    list_joints(topology, lists.data());
    for (const Isa isa : usable_isas()) {
        const int lanes = kernels(isa).lanes;
        const std::size_t count = bundle_registers(topology) * static_cast<std::size_t>(lanes);
        const SceneMemory memory = scene_memory(count);
        const Bundle b = bind_bundle(topology, lanes, memory.get());
        for (int chunk = 0; chunk < 3; ++chunk)
            kernels(isa).spatial.run(topology, b, 0, chunk_steps);
        for (int i = 1; i < 4; ++i) {
            EXPECT_EQ(b.at(OfBody::inside, i, 0), chunk_steps - 1);
            b.at(OfBody::inside, i, 0) = 0;
        }
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_TRUE(std::isfinite(memory[i])) << i;
        for (const auto f : {OfRealization::slip, OfRealization::friction_energy, OfRealization::dashpot_energy,
                             OfRealization::base_energy, OfRealization::peak_radial, OfRealization::kinetic})
            EXPECT_EQ(b.at(f, 0), 0);
        for (int i = 0; i < 4; ++i)
            for (int f = 0; f < OfBody::matrix; ++f)
                EXPECT_EQ(b.at(static_cast<OfBody::Field>(f), i, 0), 0);
    }
}

TEST(SpatialStep, PeaksAreThoseOfTheMotion)
{
    Scene s = column(3);
    s.at(OfRealization::across_x) = 0.6;
    s.at(OfRealization::across_z) = -0.8;
    const auto base = [](double t) { return Vec{3 * std::sin(12 * t), 0, 2 * std::sin(17 * t)}; };
    double radial = 0, across = 0, tilt = 0, twist = 0;
    s.set_motion(3, {0, 0, 0}, {0, 0.05, 0});
    for (int n = 0; n < 30'000; ++n) {
        const auto lower = s.attitude(2), upper = s.attitude(3); // before the step: what the bed sees
        const Quaternion<double> r = relative_rotation(lower, upper);
        tilt = std::max(tilt, 2 * std::asin(std::hypot(r.x, r.z)));
        twist = std::max(twist, std::fabs(r.y));
        s.run(1, base);
        const Vec u = s.vector(OfBody::x, 3);
        radial = std::max(radial, std::hypot(u.x, u.z));
        across = std::max(across, std::fabs(0.6 * u.x - 0.8 * u.z));
    }
    ASSERT_GT(tilt, 1e-3);
    ASSERT_GT(across, 1e-3);
    EXPECT_NEAR(std::sqrt(s.at(OfRealization::peak_radial)), radial, 1e-15);
    EXPECT_NEAR(s.at(OfRealization::peak_across), across, 1e-15);
    EXPECT_NEAR(std::acos(1 - s.at(OfJoint::most_tilt, 2)), tilt, 1e-9);
    EXPECT_NEAR(s.at(OfJoint::most_twist, 2), twist, 1e-15);
}

TEST(SpatialStep, SlipIsThatOfTheFaces)
{
    // a drum that slides straight on a wide one: its path less what the spring takes
    Scene s = column(1, 0.1);
    s.set_motion(1, {0.12, 0, -0.05}, {0, 0, 0});
    s.run(200'000);
    EXPECT_LT(length(s.velocity(1)), 1e-6);
    const Vec u = s.vector(OfBody::x, 1);
    const double path = std::hypot(u.x, u.z);
    EXPECT_NEAR(path, 0.13 * 0.13 / (2 * 0.1 * g), 0.01 * path);
    EXPECT_NEAR(s.at(OfJoint::slip, 0), path, 5e-3 * path);
    EXPECT_EQ(s.at(OfJoint::slip, 0), s.at(OfRealization::slip));
    EXPECT_NEAR(s.friction(), 0.5 * mass * 0.13 * 0.13, 0.01 * s.friction());
}

TEST(SpatialStep, InsideIsTheLastStepWithinTheLimits)
{
    // a drum that rocks through its upright position
    Scene s = column(1), single = column(1);
    const double limit = std::cos(0.02);
    place(s, 1, 0, {{0.6, 0, 0.8}, 0.05, R, 0.5}, mass * g);
    s.at(OfBody::least_upright, 1) = limit;
    int came = 0, left = 0, outside = 0;
    for (int chunk = 0; chunk < 100; ++chunk) {
        const std::vector<double> start = s.state();
        std::copy(start.begin(), start.end(), single.bundle().begin[0]);
        int expected = -1, within = 0;
        for (int n = 0; n < chunk_steps; ++n) {
            single.run(1);
            if (!(single.axis(1).y < limit)) {
                expected = n;
                ++within;
            }
        }
        s.run(chunk_steps);
        ASSERT_EQ(s.at(OfBody::inside, 1), expected) << chunk;
        outside += expected < 0;
        came += expected == chunk_steps - 1 && within < chunk_steps;
        left += expected >= 0 && expected < chunk_steps - 1;
    }
    EXPECT_GT(outside, 0);
    EXPECT_GT(came, 0);
    EXPECT_GT(left, 0);

    s.at(OfBody::least_upright, 1) = -2;
    s.at(OfBody::least_y, 1) = 1; // higher than it can be
    s.run(chunk_steps);
    EXPECT_EQ(s.at(OfBody::inside, 1), -1);
}

TEST(SpatialStep, TheTraceHasTheMotionAfterEachStep)
{
    Scene s = column(2), single = column(2);
    s.set_motion(2, {0.1, 0, 0.2}, {0.3, 0.1, 0});
    single.set_motion(2, {0.1, 0, 0.2}, {0.3, 0.1, 0});
    const int bodies = s.topology().bodies;
    std::vector<double> trace(static_cast<std::size_t>(20 * bodies * OfBody::traced));
    Bundle traced = s.bundle();
    traced.trace = trace.data();
    kernels(Isa::scalar).spatial.run(s.topology(), traced, 0, 20);
    for (int step = 0; step < 20; ++step) {
        single.run(1);
        for (int i = 1; i < bodies; ++i)
            for (int f = 0; f < OfBody::traced; ++f)
                ASSERT_EQ(trace[static_cast<std::size_t>((step * bodies + i) * OfBody::traced + f)],
                          single.at(static_cast<OfBody::Field>(f), i));
    }
}

TEST(SpatialStep, ABodyThatHasFallenPastAnotherIsNotThrownOut)
{
    // the upper drum lies beside and below the face on which it rested: no bed, though their faces' planes are crossed
    for (const double tilt : {0.0, 0.5, 1.5, 2.5}) {
        Scene s = column(2);
        s.set_attitude(2, {1, 0, 0}, tilt);
        s.set_vector(OfBody::x, 2, {0.3, -0.4, 0.2});
        s.run(1);
        EXPECT_EQ(s.at(OfJoint::normal, 1), 0) << tilt;
        EXPECT_EQ(s.at(OfJoint::elastic, 1), 0) << tilt;
        EXPECT_NEAR(s.velocity(2).y, -g * s.step_s(), 1e-15);
        s.run(2000);
        EXPECT_LT(length(s.velocity(2)), 2 * g * s.time_s()) << tilt;
    }
    // and one that is pressed by many times its weight is in contact
    Scene s = column(2);
    s.at(OfBody::y, 2) = -0.05;
    s.run(1);
    EXPECT_NEAR(s.at(OfJoint::normal, 1), K * (0.05 + s.at(OfBody::y, 1)), 0.01 * K * 0.05);
}

} // namespace

} // namespace stylobate::spatial
