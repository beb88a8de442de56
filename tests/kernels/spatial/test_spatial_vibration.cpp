// Small motions of drums that stay pressed: where they rest, and their natural frequencies.

#include "tests/kernels/spatial/scene.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace stylobate::spatial {

namespace {

constexpr double pi = std::numbers::pi, g = Scene::gravity_m_s2;
constexpr double R = 0.024, H = 0.029, mass = 0.1064214508, k = 1e8 / 0.048, K = k * pi * R * R;

Scene column(int drums, double step_ratio, double damping)
{
    const double c = 2 * damping * std::sqrt(K * mass);
    Scene s(step_ratio * std::sqrt(mass / K));
    s.drum({0, -H / 2, 0}, R, H, 1, true);
    for (int i = 0; i < drums; ++i)
        s.drum({0, (i + 0.5) * H, 0}, R, H, mass);
    for (int i = 0; i < drums; ++i)
        s.joint(i, i + 1, BedKind::disc, {0, i * H, 0}, {k, K, 100, c, c});
    s.build();
    double sink = 0;
    for (int i = 0; i < drums; ++i)
        s.at(OfBody::y, i + 1) = sink -= (drums - i) * mass * g / K;
    return s;
}

TEST(SpatialVibration, ADampedColumnRestsOnTheOverlapOfItsWeight)
{
    Scene s = column(6, 0.2, 0.3);
    for (int i = 1; i <= 6; ++i)
        s.at(OfBody::y, i) = 0;
    s.run(20'000);
    EXPECT_NEAR(s.at(OfBody::y, 1), -1.66156875e-6, 1e-14);
    EXPECT_NEAR(s.at(OfJoint::normal, 0), 6 * mass * g, 1e-7);
    EXPECT_LT(s.kinetic(), 1e-20);
    // stiffness of the bed: E = k A depth2 / 2
    EXPECT_NEAR(s.at(OfJoint::elastic, 0), 0.5 * 6 * mass * g * 1.66156875e-6, 1e-13);
}

/// A coordinate of a drum: along x, y, z, or the rotation about one of them.
using Coordinate = int;
constexpr Coordinate along_y = 1, along_z = 2, about_x = 3, about_y = 4, about_z = 5, along_x = 0;

double read(Scene& s, int i, Coordinate c)
{
    return c < 3 ? s.at(static_cast<OfBody::Field>(OfBody::x + c), i)
                 : 2 * s.at(static_cast<OfBody::Field>(OfBody::q_x + c - 3), i);
}
/// Frequencies [Hz] of two drums in some coordinates, measured one by one: started with velocities in the shape of a
/// natural mode of the matrices given, by the time of whole periods of its amplitude.
std::vector<double> measured(const std::vector<Coordinate>& coordinates, const Eigen::MatrixXd& stiffness,
                             const Eigen::VectorXd& masses)
{
    const Eigen::MatrixXd mass_matrix = masses.asDiagonal();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass_matrix);
    const auto n = static_cast<int>(coordinates.size());
    std::vector<double> frequencies;
    for (int mode = 0; mode < 2 * n; ++mode) {
        Scene s = column(2, 0.02, 0);
        for (int j = 0; j < 2; ++j) // equal faces lose a part of their common area with every displacement
            s.at(OfJoint::lower_half_1, j) = 1.1 * R;
        const double rest = s.at(OfBody::y, 1), rest_top = s.at(OfBody::y, 2);
        const Eigen::VectorXd shape = modes.eigenvectors().col(mode);
        for (int drum = 0; drum < 2; ++drum) {
            double v[6] = {};
            for (int i = 0; i < n; ++i)
                v[coordinates[static_cast<std::size_t>(i)]] = 1e-6 * shape(drum * n + i);
            s.set_motion(1 + drum, {v[0], v[1], v[2]}, {v[3], v[4], v[5]});
        }
        const auto amplitude = [&] {
            Eigen::VectorXd u(2 * n);
            for (int i = 0; i < 2 * n; ++i) {
                const Coordinate c = coordinates[static_cast<std::size_t>(i % n)];
                u(i) = read(s, 1 + i / n, c) - (c == along_y ? (i < n ? rest : rest_top) : 0);
            }
            return shape.dot(masses.cwiseProduct(u));
        };
        double before = amplitude(), first = 0, last = 0;
        for (int crossings = 0; crossings < 41 && s.time_s() < 0.5;) {
            s.run(1);
            const double now = amplitude();
            if ((now > 0) != (before > 0)) {
                last = s.time_s() - s.step_s() * now / (now - before);
                if (crossings++ == 0)
                    first = last;
            }
            before = now;
        }
        // central differences: sin(pi f dt) = w dt / 2
        frequencies.push_back(std::sin(pi * 20 / (last - first) * s.step_s()) / (pi * s.step_s()));
    }
    return frequencies;
}

/// Of a chain of two equal masses on a spring each.
Eigen::MatrixXd chain(double stiffness)
{
    Eigen::MatrixXd m(2, 2);
    m << 2 * stiffness, -stiffness, -stiffness, stiffness;
    return m;
}

TEST(SpatialVibration, TwoDrumsVibrateAlongTheirAxis)
{
    const std::vector<double> f = measured({along_y}, chain(K), Eigen::VectorXd::Constant(2, mass));
    EXPECT_NEAR(f[0], 585.441443, 1e-4);
    EXPECT_NEAR(f[1], 1532.705596, 1e-3);
}

TEST(SpatialVibration, AndTwistAtTheSameFrequencies)
{
    // the friction radius is 2/3 R (1 - 0.075 / xi2) at full contact: level faces have an infinite xi
    const double inertia = mass * R * R / 2;
    const std::vector<double> f = measured({about_y}, chain(K * R * R / 2), Eigen::VectorXd::Constant(2, inertia));
    EXPECT_NEAR(f[0], 585.441443, 1e-4);
    EXPECT_NEAR(f[1], 1532.705596, 1e-3);
}

class SpatialLateral : public ::testing::TestWithParam<bool> {};

TEST_P(SpatialLateral, TwoDrumsHaveTheFrequenciesOfTheirMatrices)
{
    // a lean about z by t moves the foot of a drum by + t H/2 along x and its head by - t H/2; about x along z reversed
    const bool in_x = GetParam();
    const double arm = in_x ? H / 2 : -H / 2, turning = K * R * R / 4;
    Eigen::MatrixXd slide(2, 4), turn(2, 4); // of the two beds; u1 t1 u2 t2
    slide << 1, arm, 0, 0, -1, arm, 1, arm;
    turn << 0, 1, 0, 0, 0, -1, 0, 1;
    const Eigen::MatrixXd stiffness = K * slide.transpose() * slide + turning * turn.transpose() * turn;
    const double inertia = mass * (R * R / 4 + H * H / 12);
    Eigen::VectorXd masses(4);
    masses << mass, inertia, mass, inertia;
    const std::vector<double> f =
        measured(in_x ? std::vector{along_x, about_z} : std::vector{along_z, about_x}, stiffness, masses);
    const double expected[] = {203.392915, 847.245944, 1620.632738, 1939.251423};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(f[i] / expected[i], 1, 1e-4) << i; // the leaning weight lowers the first one by 5e-5
}

INSTANTIATE_TEST_SUITE_P(AlongXAndZ, SpatialLateral, ::testing::Bool());

} // namespace

} // namespace stylobate::spatial
