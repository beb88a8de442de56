/// The safe step and the linear vibrations, against digits of studies/evidence/verification/reference_values.py
/// (the weight as a dead load) and against a stack assembled another way.

#include "ensemble/planar/planar_model.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "tests/ensemble/planar/equal_drums.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

using namespace stylobate;

namespace {

LinearResponse response(const Column& column, double gravity = 9.81)
{
    Realization r = make(column);
    r.gravity_m_s2 = gravity;
    return linear_response(r);
}

/// Without gravity.
LinearResponse weightless(Realization r)
{
    r.gravity_m_s2 = 0;
    return linear_response(r);
}

StepBound bound(const Column& column)
{
    return step_bound(make(column));
}

/// Part of a contact that is pressed, from -1 to 1 over the face.
struct Part {
    double from = -1, to = 1;
};

struct Matrices {
    Eigen::MatrixXd M, K, C;
};

/// The stack without gravity as a bed of discrete springs at Gauss points (exact for a linear gap), with the dashpots
/// at the middle of each contact.
Matrices springs(const Realization& r, const std::vector<Part>& parts)
{
    const auto n = static_cast<Eigen::Index>(3 * (r.blocks.size() - 1));
    Matrices m{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
    for (std::size_t b = 1; b < r.blocks.size(); ++b) {
        const auto at = static_cast<Eigen::Index>(3 * (b - 1));
        m.M(at, at) = m.M(at + 1, at + 1) = r.blocks[b].mass_kg;
        m.M(at + 2, at + 2) = r.blocks[b].inertia_kg_m2;
    }
    for (std::size_t j = 0; j < r.joints.size(); ++j) {
        const Joint& joint = r.joints[j];
        const double b = r.blocks[1].half_width_m;
        const double h = r.blocks[1].half_height_m;
        // displacement (direction x or y) of the upper face less that of the lower face at the abscissa x
        const auto relative = [&](bool vertical, double x) {
            Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
            const auto up = static_cast<Eigen::Index>(3 * (joint.upper - 1));
            v(up + (vertical ? 1 : 0)) = 1;
            v(up + 2) = vertical ? x : h;
            if (joint.lower > 0) {
                const auto low = static_cast<Eigen::Index>(3 * (joint.lower - 1));
                v(low + (vertical ? 1 : 0)) = -1;
                v(low + 2) = vertical ? -x : h;
            }
            return v;
        };
        const double middle = b * (parts[j].from + parts[j].to) / 2;
        const double half = b * (parts[j].to - parts[j].from) / 2;
        for (const double side : {-1.0, 1.0}) {
            const Eigen::VectorXd gap = relative(true, middle + side * half / std::sqrt(3.0));
            m.K += joint.normal_stiffness_n_m2 * half * gap * gap.transpose();
        }
        const Eigen::VectorXd slide = relative(false, middle);
        const Eigen::VectorXd open = relative(true, middle);
        const double share = joint.damping_chord_m > 0 ? 2 * half / joint.damping_chord_m : 1;
        m.K += joint.tangential_stiffness_n_m * slide * slide.transpose();
        m.C += share * joint.tangential_damping_n_s_m * slide * slide.transpose();
        if (joint.mechanisms.face_damping == 0)
            m.C += share * joint.normal_damping_n_s_m * open * open.transpose();
        else
            for (const double side : {-half, half}) {
                const Eigen::VectorXd end = relative(true, middle + side);
                m.C += half / (2 * b) * joint.normal_damping_n_s_m * end * end.transpose();
            }
    }
    return m;
}

/// Largest growth per step of (u[n], u[n-1]) under the central difference with the backward dashpot.
double spectral_radius(const Matrices& m, double dt)
{
    const Eigen::Index n = m.M.rows();
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd inverse = m.M.inverse();
    Eigen::MatrixXd map = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    map.topLeftCorner(n, n) = 2 * one - dt * dt * inverse * m.K - dt * inverse * m.C;
    map.topRightCorner(n, n) = dt * inverse * m.C - one;
    map.bottomLeftCorner(n, n) = one;
    return Eigen::EigenSolver<Eigen::MatrixXd>(map, false).eigenvalues().cwiseAbs().maxCoeff();
}

/// True while 4 M - 2 dt C - dt2 K is positive definite.
bool stable(const Matrices& m, double dt)
{
    const Eigen::MatrixXd left = 4 * m.M - 2 * dt * m.C - dt * dt * m.K;
    return Eigen::LLT<Eigen::MatrixXd>(left).info() == Eigen::Success;
}

} // namespace

TEST(LinearResponse, LowestFrequencyOfTheSpecimens)
{
    EXPECT_NEAR(response(spec).frequency_hz[0], 36.925220, 5e-7);
    EXPECT_NEAR(response(mono).frequency_hz[0], 52.459709, 5e-7);
    EXPECT_NEAR(response(with(spec, 1e7)).frequency_hz[0], 11.600457, 5e-7);
    EXPECT_NEAR(response(with(spec, 1e9)).frequency_hz[0], 116.843819, 5e-7);
    EXPECT_NEAR(response(with(spec, 7.46820e6)).frequency_hz[0], 10, 1e-4);
    EXPECT_NEAR(response(with(spec, 2.94390e7)).frequency_hz[0], 20, 1e-4);
    EXPECT_NEAR(response(with(spec, 6.60571e7)).frequency_hz[0], 30, 1e-4);
}

/// One block on its bed slides by x and turns by t about its centre, h above the bed (THEORY.md, section 1):
///   K = | k_t    k_t h                    |    M = diag(m, I)    C = | c_t    c_t h       |
///       | k_t h  k_th + k_t h2 - W h       |                         | c_t h  c_t h2 + c_th |
/// with k_th = K_N B3 / 12, c_th = 0 for a dashpot at the centroid and C_N B2 / 4 for dashpots at the ends, a half
/// each.
TEST(FirstMode, OfOneBlockByHand)
{
    for (const bool ends : {false, true}) {
        Column column = with(mono, 1e8, 0.1);
        column.ends = ends;
        const double m = 0.813, B = 0.048, H = 0.174, h = H / 2, g = 9.81, k_n = 1e8 * B, I = m * (B * B + H * H) / 12;
        const double c = 2 * 0.1 * std::sqrt(k_n * m), c_th = ends ? c * B * B / 4 : 0;
        const double a = k_n / m, b = k_n * h, d = (1e8 * B * B * B / 12 + k_n * h * h - m * g * h) / I;
        const double w2 = (a + d) / 2 - std::sqrt((a - d) * (a - d) / 4 + b * b / (m * I));
        const double x = -b / (k_n - m * w2); // beside a turn of 1
        const double work = c * (x + h) * (x + h) + c_th, mass = m * x * x + I;
        const FirstMode mode = first_mode(make(column));
        EXPECT_NEAR(mode.frequency_hz, std::sqrt(w2) / (2 * std::numbers::pi), 1e-9 * mode.frequency_hz);
        EXPECT_NEAR(mode.damping_ratio, work / (2 * std::sqrt(w2) * mass), 1e-6 * mode.damping_ratio) << ends;
    }
}

/// Two blocks: against the roots of det(M s2 + C s + K) = 0, the matrices from springs at Gauss points.
TEST(FirstMode, OfTwoBlocks)
{
    for (const bool ends : {false, true}) {
        Column column = with(spec, 1e8, 0.1);
        column.free_blocks = 2;
        column.ends = ends;
        const Realization r = make(column);
        Matrices s = springs(r, std::vector<Part>(r.joints.size()));
        const double W = column.mass * 9.81, h = column.height / 2;
        s.K(2, 2) -= (2 * W + W) * h; // a joint takes N h from each of its blocks
        s.K(5, 5) -= W * h;
        const Eigen::Index n = s.M.rows();
        Eigen::MatrixXd map = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        map.topRightCorner(n, n).setIdentity();
        map.bottomLeftCorner(n, n) = -s.M.inverse() * s.K;
        map.bottomRightCorner(n, n) = -s.M.inverse() * s.C;
        const Eigen::VectorXcd roots = Eigen::EigenSolver<Eigen::MatrixXd>(map, false).eigenvalues();
        std::complex<double> first = 1e30;
        for (const std::complex<double>& root : roots)
            if (root.imag() > 0 && std::abs(root) < std::abs(first))
                first = root;
        const FirstMode mode = first_mode(r);
        EXPECT_NEAR(mode.frequency_hz, std::abs(first) / (2 * std::numbers::pi), 1e-3 * mode.frequency_hz) << ends;
        EXPECT_NEAR(mode.damping_ratio, -first.real() / std::abs(first), 0.01 * mode.damping_ratio) << ends;
    }
}

/// The specimens of docs/verification.md: dashpots at the ends damp the first mode by 0.114 of their ratio, at the
/// centroid hardly.
TEST(FirstMode, DampingOfTheSpecimens)
{
    for (const double K_N : {1e7, 1e8, 1e9}) {
        Column column = with(spec, K_N, 0.1);
        EXPECT_LT(first_mode(make(column)).damping_ratio, 2e-4);
        column.ends = true;
        EXPECT_NEAR(first_mode(make(column)).damping_ratio, 0.0114, 3e-4) << K_N;
    }
}

/// As the dense solution, and for any number of blocks.
TEST(FirstMode, OfTallStacks)
{
    for (const int blocks : {1, 3, 12, 30}) {
        Column column = with(spec, 1e10);
        column.free_blocks = blocks;
        const double dense = response(column).frequency_hz[0];
        EXPECT_NEAR(first_mode(make(column)).frequency_hz, dense, 1e-8 * dense) << blocks;
    }
    Column cube{.width = 1, .height = 1, .mass = 2700};
    cube.normal_stiffness = 3e9;
    for (const int blocks : {100, 101, 200}) { // they buckle from 59 on
        cube.free_blocks = blocks;
        EXPECT_EQ(first_mode(make(cube)).frequency_hz, 0) << blocks;
    }
}

TEST(LinearResponse, BucklesUnderItsWeightAtTheKnownStiffness)
{
    EXPECT_EQ(response(with(spec, 148349 * 0.9999)).frequency_hz[0], 0);
    EXPECT_GT(response(with(spec, 148349 * 1.0001)).frequency_hz[0], 0);
    EXPECT_EQ(response(with(mono, 75289.83 * 0.9999)).frequency_hz[0], 0);
    EXPECT_GT(response(with(mono, 75289.83 * 1.0001)).frequency_hz[0], 0);
}

TEST(LinearResponse, AxialModesOfTheChain)
{
    // axial motion is not coupled to the rest: each of these is among the frequencies
    const auto nearest = [](const std::vector<double>& all, double f) {
        double best = 1e300;
        for (const double g : all)
            best = std::min(best, std::abs(g - f));
        return best;
    };
    const std::vector<double> all = response(spec).frequency_hz;
    ASSERT_EQ(all.size(), 18U);
    for (int i = 1; i <= 6; ++i) {
        const double w1 = std::sqrt(1e8 * 0.048 / 0.1355);
        EXPECT_LT(nearest(all, w1 / M_PI * std::sin((2 * i - 1) * M_PI / 26)), 1e-6) << i;
    }
    EXPECT_LT(nearest(all, 228.360153), 1e-6);
    EXPECT_LT(nearest(all, 1839.476756), 1e-6);
    Column one = spec;
    one.free_blocks = 1;
    EXPECT_LT(nearest(response(one).frequency_hz, 947.264153), 1e-6);
}

TEST(LinearResponse, CriticalSteps)
{
    EXPECT_NEAR(response(spec).undamped_step_s, 1.601232e-4, 5e-11);
    EXPECT_NEAR(response(spec).step_s, response(spec).undamped_step_s, 1e-15);
    Column one = spec;
    one.free_blocks = 1;
    EXPECT_NEAR(response(one).undamped_step_s, 2.264420e-4, 5e-11);
    // with dashpots, without the weight's 3e-6
    EXPECT_NEAR(response(with(spec, 1e8, 0.1), 0).step_s, 1.349618e-4, 5e-11);
    EXPECT_NEAR(response(with(spec, 1e8, 0.3), 0).step_s, 0.952181e-4, 5e-11);
    EXPECT_NEAR(response(with(spec, 1e8, 0.5), 0).step_s, 0.700472e-4, 5e-11);
    EXPECT_NEAR(response(with(spec, 1e8, 0.1)).step_s, 1.349618e-4, 1e-9);
}

TEST(LinearResponse, CriticalStepIsWhereTheOneStepMapBeginsToGrow)
{
    for (const double xi : {0.0, 0.05, 0.1, 0.3, 0.5, 1.0}) {
        for (const double ratio : {0.2, 1.0, 4.0}) {
            Column column = with(spec, 1e8, xi);
            column.ratio = ratio;
            const Matrices m = springs(make(column), std::vector<Part>(6));
            const double dt = response(column, 0).step_s;
            EXPECT_LT(spectral_radius(m, 0.999 * dt), 1 + 1e-6) << xi << ' ' << ratio;
            EXPECT_GT(spectral_radius(m, 1.001 * dt), 1 + 1e-3) << xi << ' ' << ratio;
        }
    }
}

TEST(StepBound, SpecimenDigits)
{
    EXPECT_NEAR(bound(spec).dt_s, 1.356191e-4, 5e-11);
    EXPECT_EQ(bound(spec).governed_by, StepLimit::stiffness);
    EXPECT_TRUE(std::isinf(bound(spec).edge_s));
    EXPECT_NEAR(bound(with(spec, 1e8, 0.1)).dt_s, 1.061170e-4, 5e-11);
    EXPECT_NEAR(bound(with(spec, 1e8, 0.1)).stiffness_s, 1.356191e-4, 5e-11);
    EXPECT_EQ(bound(with(spec, 1e8, 0.1)).governed_by, StepLimit::dashpot);
    // axial motion alone would say 1.730437e-4, which is not safe
    EXPECT_LT(bound(spec).dt_s, 1.730437e-4);
}

TEST(StepBound, ClosedFormOfInnerBlocks)
{
    for (const double ratio : {0.1, 0.5, 1.0, 5.0}) {
        for (const double slenderness : {0.2, 1.0, 3.0}) {
            Column column = spec;
            column.ratio = ratio;
            column.height = slenderness * column.width;
            const double k_n = column.normal_stiffness * column.width;
            const double k_t = ratio * k_n;
            const double B2 = column.width * column.width;
            const double H2 = column.height * column.height;
            const double w2 = std::max({4 * k_n / column.mass, 4 * k_t / column.mass,
                                        (12 * k_t * H2 + 4 * k_n * B2) / (column.mass * (B2 + H2))});
            // the lowest and inner blocks have two joints, the top one a single joint, which is never stiffer
            EXPECT_NEAR(bound(column).dt_s, 2 / std::sqrt(w2), 1e-12 * bound(column).dt_s) << ratio << slenderness;
        }
    }
}

TEST(StepBound, IsSafeOverTheScan)
{
    for (const int n : {1, 2, 3, 6, 12, 20}) {
        for (const double slenderness : {0.2, 0.6, 1.0, 2.0, 8.0}) {
            for (const double ratio : {0.1, 0.5, 1.0, 5.0}) {
                for (const double xi : {0.0, 0.1, 0.3, 0.5}) {
                    Column column = with(spec, 1e8, xi);
                    column.free_blocks = n;
                    column.height = slenderness * column.width;
                    column.ratio = ratio;
                    column.chord = true; // the full contact alone
                    const double exact = response(column, 0).step_s;
                    EXPECT_LE(bound(column).dt_s, exact * (1 + 1e-9))
                        << n << ' ' << slenderness << ' ' << ratio << ' ' << xi;
                    if (xi == 0) {
                        EXPECT_GE(bound(column).dt_s, 0.5 * exact) << n << ' ' << slenderness << ' ' << ratio;
                    }
                }
            }
        }
    }
}

TEST(StepBound, IsSafeForPartialContacts)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 4000; ++trial) {
        Column column = spec;
        column.free_blocks = 1 + trial % 7;
        column.height = column.width * std::exp(std::log(0.2) + uniform(random) * std::log(40.0));
        column.ratio = std::exp(std::log(0.1) + uniform(random) * std::log(50.0));
        column.xi = trial % 3 == 0 ? 0 : 0.5 * uniform(random);
        column.chord = trial % 2 == 1;
        std::vector<Part> parts;
        for (int j = 0; j < column.free_blocks; ++j) {
            const double length = 2 * std::pow(uniform(random), 3);
            switch (static_cast<int>(3 * uniform(random))) {
            case 0:
                parts.push_back({-1, -1 + length});
                break;
            case 1:
                parts.push_back({1 - length, 1});
                break;
            default:
                parts.push_back({});
            }
        }
        const double dt = bound(column).dt_s;
        EXPECT_TRUE(stable(springs(make(column), parts), dt * (1 - 1e-9)))
            << "blocks " << column.free_blocks << " H/B " << column.height / column.width << " r " << column.ratio
            << " xi " << column.xi << " chord " << column.chord;
    }
}

TEST(StepBound, DashpotAtAnEdge)
{
    // K_T too small to matter and no C_T: one block at its corner against a fixed one, dt C_N (1/m + b2/I) = 1
    Column column = with(mono, 1e8, 1.0);
    Realization r = make(column);
    r.joints[0].tangential_damping_n_s_m = 0;
    const StepBound got = step_bound(r);
    const double rate = r.joints[0].normal_damping_n_s_m * (1 / 0.813 + 0.024 * 0.024 / r.blocks[1].inertia_kg_m2);
    EXPECT_NEAR(got.edge_s * rate, 1, 1e-12);

    // two equal blocks: their rotations' cross terms cancel, so that the normal direction stands alone
    const Realization stack = make(with(spec, 1e8, 0.5));
    const double both =
        stack.joints[0].normal_damping_n_s_m * 2 * (1 / 0.1355 + 0.024 * 0.024 / stack.blocks[1].inertia_kg_m2);
    EXPECT_NEAR(step_bound(stack).edge_s * both, 1, 1e-12);
    EXPECT_EQ(step_bound(stack).governed_by, StepLimit::edge_dashpot);

    // in proportion to the chord it vanishes at the edge
    column = with(spec, 1e8, 0.5);
    column.chord = true;
    EXPECT_TRUE(std::isinf(bound(column).edge_s));
    EXPECT_EQ(bound(column).governed_by, StepLimit::dashpot);
}

TEST(StepBound, CoefficientsGivenAsSuch)
{
    // C_N alone, far from the ratio's: full contact, so z = C_N w / (2 k_n)
    Realization r = make(spec);
    for (Joint& joint : r.joints) {
        joint.normal_damping_n_s_m = 300;
        joint.damping_chord_m = 0.048;
    }
    const StepBound got = step_bound(r);
    const double w = 2 / 1.356191e-4;
    const double z = 300 * w / (2 * 1e8 * 0.048);
    EXPECT_NEAR(got.dt_s, 2 / w * (std::sqrt(1 + z * z) - z), 1e-10);
    EXPECT_LE(got.dt_s, weightless(r).step_s);
}

TEST(StepBound, StiffestJointGovernsWhereverItIs)
{
    for (std::size_t j = 0; j < 6; ++j) {
        Realization r = make(spec);
        r.joints[j].normal_stiffness_n_m2 = 1e10;
        const StepBound got = step_bound(r);
        EXPECT_LE(got.dt_s, weightless(r).step_s * (1 + 1e-9));
        EXPECT_LT(got.dt_s, 0.3 * bound(spec).dt_s);
        EXPECT_TRUE(got.block == static_cast<int>(j) || got.block == static_cast<int>(j) + 1) << got.block;
    }
}

TEST(StepBound, OffsetBlocks)
{
    // a contact off the centres couples translation and rotation; the bound must still hold
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-0.012, 0.012);
    for (int trial = 0; trial < 100; ++trial) {
        Realization r = make(with(spec, 1e8, 0.1));
        for (Block& block : r.blocks)
            block.x_m = uniform(random);
        EXPECT_LE(step_bound(r).dt_s, weightless(r).step_s);
    }
}

StepBound structure_bound(const Column& column)
{
    const Realization r = make(column);
    return structure_step_bound(r, step_bound(r));
}

TEST(StepBound, StiffTiesShortenIt)
{
    Realization r = make(with(spec, 1e8, 0));
    Block& top = r.blocks.back();
    const double k = 1e12; // much stiffer than the contacts: 2 / w of the block on its tie, halved in w2 as all bounds
    top.mechanisms.tie_n_m = k;
    EXPECT_NEAR(step_bound(r).dt_s, 2 / std::sqrt(2 * k / top.mass_kg), 1e-3 * step_bound(r).dt_s);
    EXPECT_EQ(step_bound(r).block, static_cast<int>(r.blocks.size()) - 1);
    top.mechanisms.tie_n_m = -100;
    const double held = step_bound(r).dt_s;
    top.mechanisms.tie_n_m = 0;
    r.with_mechanisms = true;
    EXPECT_EQ(held, step_bound(r).dt_s) << "what drives away shortens no step";
    top.mechanisms.tie_n_s_m = 1e7;
    EXPECT_LT(step_bound(r).dt_s, 0.1 * held);
    EXPECT_EQ(step_bound(r).governed_by, StepLimit::dashpot);
}

TEST(StructureStepBound, IsTheExactCriticalStepAtFullContact)
{
    for (const int n : {1, 2, 6, 12})
        for (const double ratio : {0.2, 1.0, 4.0})
            for (const double xi : {0.0, 0.05, 0.1, 0.3, 0.5, 1.0}) {
                Column column = with(spec, 1e8, xi);
                column.free_blocks = n;
                column.ratio = ratio;
                column.ends = true;
                // from the eigenvalues of the companion matrix, another way altogether, with the weight's 1e-5
                const double exact = linear_response(make(column)).step_s;
                const double got = structure_bound(column).dt_s;
                EXPECT_LE(got, exact * (1 + 1e-9)) << n << ' ' << ratio << ' ' << xi;
                EXPECT_GE(got, exact * (1 - 2e-4)) << n << ' ' << ratio << ' ' << xi;
            }
}

TEST(StructureStepBound, IsSafeForPartialContactsAndLongerThanThatOfTheBlocks)
{
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 2000; ++trial) {
        Column column = spec;
        column.free_blocks = 1 + trial % 7;
        column.height = column.width * std::exp(std::log(0.2) + uniform(random) * std::log(40.0));
        column.ratio = std::exp(std::log(0.1) + uniform(random) * std::log(50.0));
        column.xi = trial % 3 == 0 ? 0 : 0.5 * uniform(random);
        column.chord = trial % 2 == 1;
        column.ends = true;
        std::vector<Part> parts;
        for (int j = 0; j < column.free_blocks; ++j) {
            const double length = 2 * std::pow(uniform(random), 3);
            const double kind = uniform(random);
            parts.push_back(kind < 0.4 ? Part{-1, -1 + length} : kind < 0.8 ? Part{1 - length, 1} : Part{});
        }
        const double dt = structure_bound(column).dt_s;
        EXPECT_GE(dt, step_bound(make(column)).dt_s * (1 - 1e-9)) << trial;
        EXPECT_TRUE(stable(springs(make(column), parts), dt * (1 - 1e-9))) << trial;
    }
}

TEST(StructureStepBound, LeavesDashpotsElsewhereAlone)
{
    Realization r = make(with(spec, 1e8, 0.1));
    EXPECT_EQ(structure_step_bound(r, step_bound(r)).dt_s, step_bound(r).dt_s);
    r.form = ContactForm::two_corner;
    EXPECT_EQ(structure_step_bound(r, step_bound(r)).dt_s, step_bound(r).dt_s);
    r.form = ContactForm::area;
    for (Joint& joint : r.joints)
        joint.mechanisms.face_damping = 1; // at the ends, in proportion to the contact's length
    EXPECT_GT(structure_step_bound(r, step_bound(r)).dt_s, 1.1 * step_bound(r).dt_s);
}

/// The engine itself: a stack at rest, in which rounding alone is there to grow.
TEST(StructureStepBound, LargestStableStepOfTheEngineIsJustAboveIt)
{
    for (const double xi : {0.05, 0.1, 0.3, 0.5}) {
        Column column = with(spec, 1e8, xi);
        column.ends = true;
        Realization r = make(column);
        for (std::size_t i = 0; i < r.blocks.size(); ++i)
            r.blocks[i].half_width_m *= 1 - 2e-3 * static_cast<double>(i); // no two sides are flush
        for (Joint& joint : r.joints)
            joint.friction = 0.68;
        const double bound = structure_step_bound(r, step_bound(r)).dt_s;
        Study study;
        study.excitation.kind = ExcitationKind::none;
        study.excitation.duration_s = 1000;
        const auto grows = [&](double dt) {
            r.step_s = dt;
            LaneSet set(study, nullptr, kernels(Isa::scalar), r);
            set.load(0, r);
            const Snapshot rest = set.snapshot(0);
            for (int n = 0; n < 100; ++n)
                set.advance();
            const Snapshot now = set.snapshot(0);
            double moved = 0;
            for (std::size_t i = 0; i < now.x_m.size(); ++i)
                moved = std::max({moved, std::abs(now.x_m[i] - rest.x_m[i]), std::abs(now.y_m[i] - rest.y_m[i])});
            return !(moved < 1e-8);
        };
        double low = 0.7 * bound, high = 1.5 * bound;
        EXPECT_FALSE(grows(low)) << xi;
        EXPECT_TRUE(grows(high)) << xi;
        while (high - low > 2e-3 * bound)
            (grows((low + high) / 2) ? high : low) = (low + high) / 2;
        EXPECT_GT(low / bound, 0.995) << xi;
        EXPECT_LT(high / bound, 1.06) << xi;
    }
}
