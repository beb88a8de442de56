// What a step in space conserves: momentum, angular momentum, and energy with what friction and dashpots take.

#include "tests/kernels/spatial/leaning.hpp"

#include <gtest/gtest.h>

namespace stylobate::spatial {

namespace {

constexpr double g = Scene::gravity_m_s2;

/// A drum, a drum and a beam that press on each other in free flight, spinning and sliding.
Scene free_flight()
{
    const double radius = 0.5, height = 1, mass = 2000, area = std::numbers::pi * radius * radius, K = 1e9;
    Scene s(0.01 / std::sqrt(K / mass)); // a contact takes hundreds of steps
    const double c = 0.2 * std::sqrt(K * mass);
    s.drum({0, 0.5 * height, 0}, radius, height, mass);
    s.drum({0.02, 1.5 * height, 0.03}, 0.9 * radius, height, 0.9 * mass);
    s.box({0.1, 2.5 * height, 0.05}, {1.2, height, 0.8}, mass);
    const Scene::Law law{K / area, K, 0.6, c, c};
    s.joint(0, 1, BedKind::disc, {0, height, 0}, law);
    s.joint(1, 2, BedKind::rectangle, {0, 2 * height, 0}, law);
    s.build();
    s.at(OfRealization::gravity_dy) = 0;
    s.set_motion(0, {0, 0.01, 0}, {0, 0.2, 0});
    s.set_motion(1, {0.01, 0, 0}, {0, 0, 0.01});
    s.set_motion(2, {0.02, -0.01, 0.01}, {0.01, 0.3, 0.01});
    return s;
}

TEST(SpatialBalance, MomentumAndAngularMomentumAreKeptInAHundredThousandSteps)
{
    Scene s = free_flight();
    const Vec p = s.momentum(), l = s.angular_momentum();
    double p_error = 0, l_error = 0;
    int pressed = 0;
    for (int n = 0; n < 20'000; ++n) {
        s.run(5);
        p_error = std::max(p_error, length(s.momentum() - p) / length(p));
        l_error = std::max(l_error, length(s.angular_momentum() - l) / length(l));
        pressed += s.at(OfJoint::normal, 0) > 0 && s.at(OfJoint::normal, 1) > 0;
    }
    EXPECT_GT(pressed, 20);
    EXPECT_GT(s.at(OfJoint::slip, 0), 1e-4);
    EXPECT_GT(s.at(OfJoint::slip, 1), 1e-4);
    // each step rounds once in each of the bodies: 1e-16 x sqrt(1e5)
    EXPECT_LT(p_error, 1e-13);
    EXPECT_LT(l_error, 1e-13);
}

/// A block on a fixed one of the same face, thrown so that it slides, spins, rolls or rocks.
struct Throw {
    BedKind kind;
    double mu, tilt, x_m, x_m_s, spin_rad_s;
    double most; ///< residual at a step of 0.2 / w, over m g R / 2
};
constexpr Throw throws[] = {{BedKind::disc, 0.1, 0.15, 0.006, 0.12, 0, 3e-5},
                            {BedKind::disc, 0.4, 0.25, 0.002, 0, 8, 4e-4},
                            {BedKind::rectangle, 0.4, 0.25, 0.002, 0, 0, 4e-4}};

struct Energies {
    double residual = 0; ///< largest, over m g R / 2
    double rises = 0;    ///< sum of all rises of the mechanical energy from step to step, over its loss
    double friction = 0, dashpots = 0;
};

Energies thrown(const Throw& of, double step_ratio, double damping)
{
    const double R = 0.024, h = 0.029, mass = 0.2128, k = 1e8 / 0.048;
    const bool round = of.kind == BedKind::disc;
    const double K = k * (round ? std::numbers::pi : 4) * R * R, c = 2 * damping * std::sqrt(K * mass);
    Scene s(step_ratio * std::sqrt(mass / K / 6));
    if (round) {
        s.drum({0, -0.01, 0}, R, 0.02, 1, true);
        s.drum({0, h, 0}, R, 2 * h, mass);
    } else {
        s.box({0, -0.01, 0}, {2 * R, 0.02, 2 * R}, 1, true);
        s.box({0, h, 0}, {2 * R, 2 * h, 2 * R}, mass);
    }
    s.joint(0, 1, of.kind, {0, 0, 0}, {k, K, of.mu, c, c});
    s.build();
    s.set_attitude(1, {std::cos(0.4), 0, 0 - std::sin(0.4)}, of.tilt);
    double up = R;
    do { // as low as it may be without touching
        up -= 1e-6;
        s.set_vector(OfBody::x, 1, {of.x_m, up - 1e-6, 0.001});
    } while (!(s.normal_force(0) > 0));
    s.at(OfBody::y, 1) = up;
    s.set_motion(1, {of.x_m_s, 0, 0.05}, {0, of.spin_rad_s, 0});
    s.run(2);
    const double start = s.balance(), mechanical = start - s.friction() - s.dashpots(), scale = 0.5 * mass * g * R;
    double before = mechanical;
    Energies e;
    while (s.time_s() < 0.12 && s.tilt(1) < 1.2 && s.at(OfBody::y, 1) > -0.01) {
        s.run(1);
        e.residual = std::max(e.residual, std::fabs(s.balance() - start) / scale);
        const double now = s.balance() - s.friction() - s.dashpots();
        e.rises += std::max(0.0, now - before);
        before = now;
    }
    e.rises /= mechanical - before;
    e.friction = s.friction() / scale;
    e.dashpots = s.dashpots() / scale;
    return e;
}

class SpatialEnergy : public ::testing::TestWithParam<Throw> {};

TEST_P(SpatialEnergy, ResidualIsSmallAndGoesWithTheStep)
{
    const Energies coarse = thrown(GetParam(), 0.2, 0.1), fine = thrown(GetParam(), 0.05, 0.1);
    EXPECT_LT(coarse.residual, GetParam().most);
    EXPECT_LT(fine.residual, 0.4 * coarse.residual);
    EXPECT_GT(coarse.friction, 0.01);
    EXPECT_GT(coarse.dashpots, 1e-4);
}

TEST_P(SpatialEnergy, NothingIsGained)
{
    const Energies e = thrown(GetParam(), 0.2, 0.1);
    EXPECT_LT(e.rises, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Throws, SpatialEnergy, ::testing::ValuesIn(throws),
                         [](const auto& info) { return "Throw" + std::to_string(info.index); });

TEST(SpatialBalance, TheBaseDoesTheWorkThatTheBlocksGet)
{
    // a column of discs and an abacus, shaken along x, y and z
    const double R = 0.5, mass = 1960, k = 1.3e9, K = k * std::numbers::pi * R * R, c = 0.2 * std::sqrt(K * mass);
    Scene s(0.1 * std::sqrt(mass / K));
    s.drum({0, -0.5, 0}, 1.5, 1, 1, true);
    for (int i = 0; i < 3; ++i)
        s.drum({0, i + 0.5, 0}, R, 1, mass);
    s.box({0, 3.2, 0}, {1.2, 0.4, 1.2}, 1440);
    for (int i = 0; i < 4; ++i)
        s.joint(i, i + 1, BedKind::disc, {0, 1.0 * i, 0}, {k, K, 0.5, c, c});
    s.build();
    const auto base = [](double t) {
        return Vec{4 * std::sin(9 * t), 1.5 * std::sin(23 * t), 4 * std::sin(7 * t + 1)};
    };
    const double start = (s.run(1, base), s.balance());
    double residual = 0, work = 0;
    while (s.time_s() < 2) {
        s.run(1, base);
        work = std::max(work, std::fabs(s.base_work()));
        residual = std::max(residual, std::fabs(s.balance() - start));
    }
    EXPECT_GT(work, 1000);
    EXPECT_GT(s.tilt(4), 1e-4);
    EXPECT_LT(residual, 2e-3 * work);
}

} // namespace

} // namespace stylobate::spatial
