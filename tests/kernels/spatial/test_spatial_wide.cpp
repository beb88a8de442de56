// Every instruction set gives each realization in space the bits that it has alone, whatever its lane and its
// neighbours.

#include "tests/kernels/spatial/scene.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#if defined(__x86_64__)
namespace stylobate {
extern const KernelTable portable_kernels; // taken for `scalar` on processors without a fused multiply-add
}
#endif

namespace stylobate::spatial {

namespace {

using State = std::vector<double>;

/// How the bodies of a random state lie.
enum class Pose { reference, standing, rocking, heap };
constexpr Pose poses[] = {Pose::reference, Pose::standing, Pose::rocking, Pose::heap};

/// Two columns with beams of three directions: discs on discs of other sizes, a beam on an abacus and one on a round
/// drum, each of them also hollow, butt joints along x with a gap and along z, bodies with three inertias.
void build_colonnade(Scene& s, bool with_mechanisms)
{
    s.use_mechanisms(with_mechanisms);
    const Scene::Law law{1e9, 8e8, 0.6, 3e5, 2e5}, ring{1e9, 8e8, 0.6, 3e5, 2e5, true, 0.5},
        apart{1e9, 8e8, 0.6, 3e5, 2e5, false, 0, 1e-6};
    const int ground_1 = s.box({0, -0.5, 0}, {3, 1, 3}, 1, true), ground_2 = s.box({3, -0.5, 0}, {3, 1, 3}, 1, true);
    const int low_1 = s.drum({0, 0.5, 0}, 0.5, 1, 1900), high_1 = s.drum({0, 1.5, 0}, 0.46, 1, 1700);
    const int abacus = s.box({0, 2.15, 0}, {1.2, 0.3, 1.2}, 1000);
    const int low_2 = s.drum({3, 0.5, 0}, 0.5, 1, 1900), high_2 = s.drum({3, 1.65, 0}, 0.5, 1.3, 2500);
    const int left = s.box({-0.05, 2.65, 0}, {3.1, 0.7, 0.9}, 5000), right = s.box({3, 2.65, 0}, {3, 0.7, 0.9}, 4800);
    const int across = s.box({0, 2.65, 1.45}, {0.9, 0.7, 2}, 3000);
    s.joint(ground_1, low_1, BedKind::disc, {0, 0, 0}, law);
    s.joint(low_1, high_1, BedKind::disc, {0, 1, 0}, law);
    s.joint(high_1, abacus, BedKind::disc, {0, 2, 0}, law);
    s.joint(ground_2, low_2, BedKind::rectangle, {3, 0, 0}, law);
    s.joint(low_2, high_2, BedKind::disc, {3, 1, 0}, ring);
    s.joint(abacus, left, BedKind::rectangle, {0, 2.3, 0}, ring);
    s.joint(abacus, across, BedKind::rectangle, {0, 2.3, 0}, law);
    s.joint(right, high_2, BedKind::round, {3, 2.3, 0}, ring, Axis::y, true);
    s.joint(left, right, BedKind::rectangle, {1.5, 2.65, 0}, apart, Axis::x);
    s.joint(left, across, BedKind::rectangle, {0, 2.65, 0.45}, law, Axis::z);
    s.build();
}

class StateMaker {
public:
    explicit StateMaker(std::uint64_t seed) : engine_(seed) {}

    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    std::uint64_t word() { return engine_(); }
    Pose any_pose() { return poses[word() % std::size(poses)]; }

    /// A random state of the scene, which is left in it, too.
    State make(Scene& s, Pose pose)
    {
        s.build();
        const double dt = s.step_s();
        for (int i = s.topology().fixed; i < s.topology().bodies; ++i)
            move(s, i, pose);
        for (int j = 0; j < s.topology().joints; ++j) {
            for (OfJoint::Field f : {OfJoint::stiffness, OfJoint::C_n, OfJoint::C_t, OfJoint::mu})
                s.at(f, j) *= std::exp(uniform(-0.5, 0.5));
            for (OfJoint::Field f : {OfJoint::lower_half_1, OfJoint::upper_half_1, OfJoint::lower_half_2})
                s.at(f, j) *= uniform(0.98, 1.02);
            for (int f = OfJoint::spring_1; pose != Pose::reference && f < OfJoint::normal; ++f)
                s.at(static_cast<OfJoint::Field>(f), j) = uniform(-1e4, 1e4);
        }
        if (s.topology().model.mechanisms)
            give_mechanisms(s);
        s.at(OfRealization::gravity_dx) = dt * dt * uniform(-0.1, 0.1);
        s.at(OfRealization::across_x) = uniform(-1, 1);
        s.at(OfRealization::across_z) = uniform(-1, 1);
        double x = 0, y = 0, z = 0;
        for (int k = 0; k < chunk_steps; ++k) {
            s.bundle().at(OfBaseX::second, k, 0) = x = 0.9 * x + dt * dt * uniform(-2, 2);
            s.bundle().at(OfBaseY::second, k, 0) = y = 0.9 * y + dt * dt * uniform(-1, 1);
            s.bundle().at(OfBaseZ::second, k, 0) = z = 0.9 * z + dt * dt * uniform(-2, 2);
        }
        return s.state();
    }

private:
    /// Each one in a part of the realizations, in a part of the joints and bodies.
    void give_mechanisms(Scene& s)
    {
        using J = OfJointMechanisms;
        using M = OfBodyMechanisms;
        const double dt = s.step_s();
        const std::uint64_t some = word();
        const auto gives = [&](int mechanism) { return (some >> mechanism & 1) && word() % 4 > 0; };
        for (int j = 0; j < s.topology().joints; ++j) {
            if (gives(0)) {
                s.at(J::friction_drop, j) = uniform(0, 1);
                s.at(J::per_stribeck_step, j) = 1 / (uniform(0.001, 0.5) * dt);
            }
            if (gives(1)) {
                s.at(J::wear, j) = uniform(0, 100);
                s.at(OfJoint::slip, j) = uniform(0, 0.01);
            }
            if (gives(2)) {
                s.at(J::adhesion, j) = uniform(0, 1e5);
                s.at(J::broken, j) = static_cast<double>(word() % 2);
            }
            if (gives(3)) {
                const double k = std::pow(10, uniform(6, 9));
                s.at(J::dowel_stiffness, j) = k;
                s.at(J::per_dowel_stiffness, j) = 1 / k;
                s.at(J::dowel_yield, j) = uniform(0, 1e4);
                s.at(J::dowel_gap, j) = uniform(0, 1e-3);
                for (int f = J::dowel_set; f < J::count; ++f)
                    s.at(J::dowel_set, j, f - J::dowel_set) = uniform(-1e-3, 1e-3);
            }
            if (gives(4))
                for (int f = J::wedge; f < J::broken; ++f)
                    s.at(J::wedge, j, f - J::wedge) = uniform(-0.02, 0.02);
        }
        for (int j = 0; j < s.topology().joints; ++j)
            if (gives(6)) {
                s.at(J::face_share, j) = uniform(0, 1);
                s.at(J::face_dashpot, j) = uniform(0, 1e4) / dt;
            }
        for (int i = s.topology().fixed; i < s.topology().bodies; ++i)
            if (gives(5)) {
                s.at(M::tie_spring, i) = dt * dt * uniform(-1e2, 1e3);
                s.at(M::tie_dashpot, i) = dt * uniform(0, 10);
                s.at(M::tie_pull, i) = dt * dt * uniform(-2, 2);
                s.at(M::tie_turning, i) = dt * uniform(0, 1e3);
            }
    }

    Vec random_vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }

    void move(Scene& s, int i, Pose pose)
    {
        if (pose == Pose::reference)
            return;
        const double dt = s.step_s();
        const double size = pose == Pose::standing  ? std::pow(10.0, uniform(-16, -5))
                            : pose == Pose::rocking ? 0.05
                                                    : 2;
        const double speed = pose == Pose::standing ? 1e-3 : pose == Pose::rocking ? 0.3 : 3;
        const Vec way = random_vector(1);
        s.set_attitude(i, 1 / length(way) * way, uniform(0, size));
        s.set_vector(OfBody::x, i, random_vector(0.1 * size) - Vec{0, pose == Pose::heap ? 0.3 : 1e-5, 0});
        s.set_vector(OfBody::dx, i, random_vector(dt * speed));
        s.set_vector(OfBody::l_x, i, random_vector(dt * speed * s.inertia(i).x));
        s.at(OfBody::least_y, i) = uniform(-0.5, 0);
        s.at(OfBody::least_upright, i) = uniform(0, 1);
    }

    std::mt19937_64 engine_;
};

/// Steps realizations together, one in each lane.
std::vector<State> together(const Topology& topology, const KernelTable& table, const std::vector<State>& starts,
                            int first, int last)
{
    const auto lanes = static_cast<std::size_t>(table.lanes);
    const std::size_t fields = starts[0].size();
    const SceneMemory memory = scene_memory(fields * lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t i = 0; i < fields; ++i)
            memory[i * lanes + lane] = starts[lane][i];
    table.spatial.run(topology, bind_bundle(topology, table.lanes, memory.get()), first, last);
    std::vector<State> ends(lanes, State(fields));
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t i = 0; i < fields; ++i)
            ends[lane][i] = memory[i * lanes + lane];
    return ends;
}

State alone(const Topology& topology, const State& start, int first, int last)
{
    return together(topology, kernels(Isa::scalar), {start}, first, last)[0];
}

/// Index of the first double that differs, or -1. One NaN is as good as another.
long first_difference(const State& a, const State& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i]) &&
            !(std::isnan(a[i]) && std::isnan(b[i])))
            return static_cast<long>(i);
    return -1;
}

/// @param whether the model has mechanisms
class SpatialWide : public ::testing::TestWithParam<bool> {
protected:
    SpatialWide() { build_colonnade(scene, GetParam()); }

    Scene scene{1e-4};
};

INSTANTIATE_TEST_SUITE_P(Models, SpatialWide, ::testing::Bool(), [](const ::testing::TestParamInfo<bool>& model) {
    return model.param ? "mechanisms" : "plain";
});

TEST_P(SpatialWide, EachLaneHasTheBitsOfTheScalarKernel)
{
    StateMaker maker(1);
    for (int round = 0; round < 40; ++round)
        for (const Isa isa : usable_isas()) {
            std::vector<State> starts;
            for (int lane = 0; lane < kernels(isa).lanes; ++lane)
                starts.push_back(maker.make(scene, maker.any_pose()));
            const int last = round == 0 ? 1 : chunk_steps;
            const std::vector<State> ends = together(scene.topology(), kernels(isa), starts, 0, last);
            for (std::size_t lane = 0; lane < starts.size(); ++lane)
                ASSERT_EQ(first_difference(ends[lane], alone(scene.topology(), starts[lane], 0, last)), -1)
                    << to_string(isa) << ", lane " << lane << ", round " << round;
        }
}

#if defined(__x86_64__)
TEST_P(SpatialWide, ScalarHasTheSameBitsWithoutTheInstruction)
{
    StateMaker maker(2);
    for (int round = 0; round < 8; ++round) {
        const State start = maker.make(scene, maker.any_pose());
        ASSERT_EQ(first_difference(together(scene.topology(), portable_kernels, {start}, 0, chunk_steps)[0],
                                   alone(scene.topology(), start, 0, chunk_steps)),
                  -1);
    }
}
#endif

TEST_P(SpatialWide, TheStatesAreOfEveryKind)
{
    // so that the comparisons here cannot pass because nothing happens
    StateMaker maker(3);
    std::vector<int> pressed(static_cast<std::size_t>(scene.topology().joints)), open = pressed, slipped = pressed;
    for (int round = 0; round < 200; ++round) {
        const State start = maker.make(scene, poses[1 + round % 3]);
        scene.run(chunk_steps);
        for (int j = 0; j < scene.topology().joints; ++j) {
            const auto k = static_cast<std::size_t>(j);
            pressed[k] += scene.at(OfJoint::normal, j) > 0;
            open[k] += !(scene.at(OfJoint::normal, j) > 0);
            slipped[k] += scene.at(OfJoint::slip, j) > 0;
        }
    }
    for (std::size_t j = 0; j < pressed.size(); ++j) {
        EXPECT_GT(pressed[j], 10) << j;
        EXPECT_GT(open[j], 10) << j;
        EXPECT_GT(slipped[j], 10) << j;
    }
}

TEST_P(SpatialWide, NeighboursDoNotMatter)
{
    StateMaker maker(4);
    const double infinite = std::numeric_limits<double>::infinity();
    const std::vector<double> poison{std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, 1e308, 5e-324, 0.0};
    for (const Isa isa : usable_isas())
        for (int round = 0; round < 60; ++round) {
            const State start = maker.make(scene, maker.any_pose());
            const State want = alone(scene.topology(), start, 0, chunk_steps);
            std::vector<State> starts;
            for (int lane = 0; lane < kernels(isa).lanes; ++lane) {
                State other = maker.make(scene, maker.any_pose());
                if (round % 3 == 1)
                    std::fill(other.begin(), other.end(), poison[maker.word() % poison.size()]);
                if (round % 3 == 2)
                    for (double& value : other)
                        value = std::bit_cast<double>(maker.word());
                starts.push_back(std::move(other));
            }
            const std::size_t lane = maker.word() % starts.size();
            starts[lane] = start;
            ASSERT_EQ(first_difference(together(scene.topology(), kernels(isa), starts, 0, chunk_steps)[lane], want),
                      -1)
                << to_string(isa) << ", lane " << lane << ", round " << round;
        }
}

TEST_P(SpatialWide, AChunkInPiecesHasTheSameBits)
{
    StateMaker maker(5);
    for (const Isa isa : usable_isas())
        for (int round = 0; round < 6; ++round) {
            std::vector<State> starts;
            for (int lane = 0; lane < kernels(isa).lanes; ++lane)
                starts.push_back(maker.make(scene, maker.any_pose()));
            const std::vector<State> want = together(scene.topology(), kernels(isa), starts, 0, chunk_steps);
            std::vector<State> got = together(scene.topology(), kernels(isa), starts, 0, 1);
            got = together(scene.topology(), kernels(isa), got, 1, 40);
            got = together(scene.topology(), kernels(isa), got, 40, chunk_steps);
            for (std::size_t lane = 0; lane < starts.size(); ++lane)
                ASSERT_EQ(first_difference(got[lane], want[lane]), -1) << to_string(isa) << ", lane " << lane;
        }
}

TEST(SpatialWideMechanisms, NeutralOnesGiveTheBitsOfThePlainStep)
{
    Scene plain(1e-4), neutral(1e-4), others(1e-4);
    build_colonnade(plain, false);
    build_colonnade(neutral, true);
    build_colonnade(others, true);
    StateMaker maker(6);
    const auto size = bundle_registers(plain.topology());
    const auto tables = static_cast<std::size_t>(3 * chunk_steps);
    for (const Isa isa : usable_isas())
        for (int round = 0; round < 20; ++round) {
            const State start = maker.make(plain, maker.any_pose());
            const State want = alone(plain.topology(), start, 0, chunk_steps);
            // the same with rows of mechanisms before the tables, all neutral, beside lanes that have some
            State same(start);
            same.insert(same.end() - static_cast<std::ptrdiff_t>(tables), bundle_registers(neutral.topology()) - size,
                        0.0);
            std::vector<State> starts;
            for (int lane = 0; lane < kernels(isa).lanes; ++lane)
                starts.push_back(maker.make(others, maker.any_pose()));
            const std::size_t lane = maker.word() % starts.size();
            starts[lane] = same;
            State got = together(neutral.topology(), kernels(isa), starts, 0, chunk_steps)[lane];
            got.resize(size - tables);
            State rest(want);
            rest.resize(size - tables);
            ASSERT_EQ(first_difference(got, rest), -1) << to_string(isa) << ", lane " << lane << ", round " << round;
        }
}

} // namespace

} // namespace stylobate::spatial
