// The step in single precision: the same bits on every instruction set, whatever the lane and the neighbours, and next
// to what double precision gives.

#include "kernels/trig.hpp"
#include "tests/kernels/column_states.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace stylobate {

#if defined(__x86_64__)
extern const KernelTable portable_kernels; // taken for `scalar` on processors without a fused multiply-add
#endif

namespace {

using SingleState = std::vector<float>;

/// A state in single precision: the numbers rounded, the blocks' displacements and increments with their remainders.
SingleState rounded(const Column& column, const State& state)
{
    SingleState single(bundle_registers<float>(column.topology));
    // in one order, but for the remainders before the tables
    const auto as_float = [](double v) { return static_cast<float>(v); };
    const auto tables = static_cast<std::ptrdiff_t>(table_registers(column.topology));
    std::transform(state.begin(), state.end() - tables, single.begin(), as_float);
    std::transform(state.end() - tables, state.end(), single.end() - tables, as_float);
    State copy = state;
    const Bundle from = bind_bundle(column.topology, 1, copy.data());
    const auto to = bind_bundle(column.topology, 1, single.data());
    for (int i = 0; i < column.topology.blocks; ++i)
        for (auto [field, remainder] :
             {std::pair{OfBlock::x, OfRemainder::x}, std::pair{OfBlock::y, OfRemainder::y},
              std::pair{OfBlock::theta, OfRemainder::theta}, std::pair{OfBlock::dx, OfRemainder::dx},
              std::pair{OfBlock::dy, OfRemainder::dy}, std::pair{OfBlock::dtheta, OfRemainder::dtheta}})
            to.at(remainder, i, 0) = static_cast<float>(from.at(field, i, 0) - static_cast<double>(to.at(field, i, 0)));
    return single;
}

std::vector<SingleState> together(const Column& column, const KernelTable& table,
                                  const std::vector<SingleState>& starts, int first, int last)
{
    const auto lanes = static_cast<std::size_t>(table.single_lanes);
    const std::size_t fields = bundle_registers<float>(column.topology);
    Aligned<float> memory(fields * lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t i = 0; i < fields; ++i)
            memory.data[i * lanes + lane] = starts[lane][i];
    table.planar.run_single(column.topology, bind_bundle(column.topology, table.single_lanes, memory.data.get()), first,
                            last);
    std::vector<SingleState> ends(lanes, SingleState(fields));
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t i = 0; i < fields; ++i)
            ends[lane][i] = memory.data[i * lanes + lane];
    return ends;
}

SingleState alone(const Column& column, const SingleState& start, int first, int last)
{
    return together(column, kernels(Isa::scalar), {start}, first, last)[0];
}

/// Index of the first number that differs, or -1. One NaN is as good as another.
long first_difference(const SingleState& a, const SingleState& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]) &&
            !(std::isnan(a[i]) && std::isnan(b[i])))
            return static_cast<long>(i);
    return -1;
}

TEST(WideSingle, RegistersHoldTwiceAsMany)
{
    for (const Isa isa : usable_isas())
        EXPECT_EQ(kernels(isa).single_lanes, isa == Isa::scalar ? 1 : 2 * kernels(isa).lanes) << to_string(isa);
}

TEST(WideSingle, EachLaneHasTheBitsOfTheScalarKernel)
{
    StateMaker maker(21);
    int general = 0, closed = 0;
    for (int blocks = 1; blocks <= 20; ++blocks) {
        const Column column(blocks);
        for (int round = 0; round < 4; ++round)
            for (const Isa isa : usable_isas()) {
                std::vector<SingleState> starts;
                for (int lane = 0; lane < kernels(isa).single_lanes; ++lane) {
                    const State state = maker.make(column, any_pose(maker));
                    const int open = general_joints(column, state);
                    general += open;
                    closed += blocks - open;
                    starts.push_back(rounded(column, state));
                }
                const int last = round == 0 ? 1 : chunk_steps; // also a chunk of a single step
                const auto ends = together(column, kernels(isa), starts, 0, last);
                for (std::size_t lane = 0; lane < starts.size(); ++lane)
                    ASSERT_EQ(first_difference(ends[lane], alone(column, starts[lane], 0, last)), -1)
                        << to_string(isa) << ", lane " << lane << ", " << blocks << " blocks";
            }
    }
    // both ways through the overlap were taken, often
    EXPECT_GT(general, 1000);
    EXPECT_GT(closed, 1000);
}

#if defined(__x86_64__)
TEST(WideSingle, ScalarHasTheSameBitsWithoutTheInstruction)
{
    StateMaker maker(22);
    for (int blocks : {1, 6, 9}) {
        const Column column(blocks);
        for (int round = 0; round < 8; ++round) {
            const SingleState start = rounded(column, maker.make(column, any_pose(maker)));
            ASSERT_EQ(first_difference(together(column, portable_kernels, {start}, 0, chunk_steps)[0],
                                       alone(column, start, 0, chunk_steps)),
                      -1);
        }
    }
}
#endif

TEST(WideSingle, NeighboursDoNotMatter)
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const std::array poison{
        std::numeric_limits<float>::quiet_NaN(), infinite, -infinite, 1e38F, -1e38F, 1e-45F, 0.0F, -0.0F};
    StateMaker maker(23);
    for (const Isa isa : usable_isas())
        for (int blocks : {1, 6, 8, 9, 17}) {
            const Column column(blocks);
            for (int round = 0; round < 30; ++round) {
                const SingleState start = rounded(column, maker.make(column, any_pose(maker)));
                const SingleState want = alone(column, start, 0, chunk_steps);
                std::vector<SingleState> starts;
                for (int lane = 0; lane < kernels(isa).single_lanes; ++lane) {
                    SingleState other = rounded(column, maker.make(column, any_pose(maker)));
                    if (round % 3 == 1)
                        std::fill(other.begin(), other.end(), poison[maker.word() % poison.size()]);
                    if (round % 3 == 2)
                        for (float& value : other)
                            value = std::bit_cast<float>(static_cast<std::uint32_t>(maker.word()));
                    starts.push_back(std::move(other));
                }
                const std::size_t lane = maker.word() % starts.size();
                starts[lane] = start;
                ASSERT_EQ(first_difference(together(column, kernels(isa), starts, 0, chunk_steps)[lane], want), -1)
                    << to_string(isa) << ", lane " << lane << ", " << blocks << " blocks, round " << round;
            }
        }
}

TEST(WideSingle, AChunkInPiecesMovesTheBlocksAlike)
{
    StateMaker maker(24);
    const Column column(7);
    for (const Isa isa : usable_isas()) {
        std::vector<SingleState> starts;
        for (int lane = 0; lane < kernels(isa).single_lanes; ++lane)
            starts.push_back(rounded(column, maker.make(column, any_pose(maker))));
        const auto want = together(column, kernels(isa), starts, 0, chunk_steps);
        auto got = together(column, kernels(isa), starts, 0, 1);
        got = together(column, kernels(isa), got, 1, 40);
        got = together(column, kernels(isa), got, 40, chunk_steps);
        for (std::size_t lane = 0; lane < starts.size(); ++lane)
            ASSERT_EQ(first_difference(got[lane], want[lane]), -1) << to_string(isa) << ", lane " << lane;
    }
}

TEST(WideSingle, StandsNextToDoublePrecision)
{
    // 64 steps of 0.1 ms from the same state: what differs is rounding alone, before it can grow
    StateMaker maker(25);
    const Column column(6);
    for (const Pose pose : {Pose::aligned, Pose::standing})
        for (int round = 0; round < 20; ++round) {
            State state = maker.make(column, pose);
            while (bind_bundle(column.topology, 1, state.data()).at(OfJoint::K_n, 0, 0) > 5e7) // a stable step
                state = maker.make(column, pose);
            SingleState single = alone(column, rounded(column, state), 0, chunk_steps);
            Aligned<> memory(state.size());
            std::copy(state.begin(), state.end(), memory.data.get());
            const Bundle want = bind_bundle(column.topology, 1, memory.data.get());
            kernels(Isa::scalar).planar.run(column.topology, want, 0, chunk_steps);
            const auto got = bind_bundle(column.topology, 1, single.data());
            for (int i = 1; i <= 6; ++i) {
                const double depth = std::fabs(want.at(OfBlock::y, i, 0));
                EXPECT_NEAR(got.at(OfBlock::y, i, 0), want.at(OfBlock::y, i, 0), 1e-2 * depth) << "block " << i;
                EXPECT_NEAR(got.at(OfBlock::x, i, 0), want.at(OfBlock::x, i, 0), 2e-8) << "block " << i;
                EXPECT_NEAR(got.at(OfBlock::theta, i, 0), want.at(OfBlock::theta, i, 0), 2e-6) << "block " << i;
            }
        }
}

TEST(WideSingle, AThrownBlockKeepsItsPathForAHundredThousandSteps)
{
    // no contact: d(n) = d0 + n a and x(n) = x0 + n d0 + n (n + 1) a / 2, exactly
    const Column column(1);
    StateMaker maker(26);
    State state = maker.make(column, Pose::aligned);
    const Bundle b = bind_bundle(column.topology, 1, state.data());
    b.at(OfBlock::y, 1, 0) = 5;
    const double d0 = 2.3e-4, a = -9.81e-9 / 7;
    b.at(OfBlock::dy, 1, 0) = d0;
    b.at(OfBlock::dtheta, 1, 0) = 1e-6;
    b.at(OfRealization::gravity_dy, 0) = static_cast<double>(static_cast<float>(a));
    SingleState single = rounded(column, state);
    const int chunks = 1563;
    double n = 0;
    float plain_d = static_cast<float>(d0), plain = 5;
    for (int chunk = 0; chunk < chunks; ++chunk, n += chunk_steps) {
        single = alone(column, single, 0, chunk_steps);
        for (int k = 0; k < chunk_steps; ++k) {
            plain_d += static_cast<float>(a);
            plain += plain_d;
        }
    }
    const double step = static_cast<double>(static_cast<float>(a));
    const double want = 5 + n * d0 + n * (n + 1) / 2 * step;
    const auto end = bind_bundle(column.topology, 1, single.data());
    const auto whole = [&](OfBlock::Field field, OfRemainder::Field remainder) {
        return static_cast<double>(end.at(field, 1, 0)) + static_cast<double>(end.at(remainder, 1, 0));
    };
    EXPECT_NEAR(whole(OfBlock::dy, OfRemainder::dy), d0 + n * step, 1e-9 * d0);
    EXPECT_NEAR(whole(OfBlock::y, OfRemainder::y), want, 1e-7 * std::fabs(want));
    EXPECT_NEAR(whole(OfBlock::theta, OfRemainder::theta), n * 1e-6, 1e-7 * n * 1e-6);
    // and without the remainders it would have lost it
    EXPECT_GT(std::fabs(static_cast<double>(plain) - want), 1e-5 * std::fabs(want));
}

using Drives = std::vector<std::array<double, 9>>; // the parameters of the formula and the first step

/// The base motion of the realizations of a register.
template <class Number>
std::vector<Number> base_table(const KernelTable& table, const Drives& drives)
{
    const std::size_t lanes = drives.size();
    Aligned<> memory(9 * lanes);
    Aligned<Number> out(chunk_steps * lanes);
    std::array<double*, 9> row{};
    for (std::size_t i = 0; i < 9; ++i) {
        row[i] = memory.data.get() + i * lanes;
        for (std::size_t lane = 0; lane < lanes; ++lane)
            row[i][lane] = drives[lane][i];
    }
    const FormulaParameters p{row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7]};
    if constexpr (std::is_same_v<Number, float>)
        table.fill_single(MotionFormula::harmonic, p, row[8], out.data.get());
    else
        table.fill(MotionFormula::harmonic, p, row[8], out.data.get());
    return {out.data.get(), out.data.get() + out.count};
}

TEST(WideSingle, BaseMotionIsThatOfTheFormula)
{
    StateMaker maker(28);
    double largest = 0;
    for (const Isa isa : usable_isas())
        for (int round = 0; round < 400; ++round) {
            Drives drives;
            for (int lane = 0; lane < kernels(isa).single_lanes; ++lane) {
                const double rate = 1e-4 * std::exp(maker.uniform(std::log(0.3), std::log(30.0)));
                const double ramp = maker.uniform(0.5, 3), cycles = std::floor(maker.uniform(7, 20));
                // before, in, between and after the ramps, and about the ends of all these
                const double at = std::array{
                    0.0, ramp, maker.uniform(0, cycles), cycles - ramp, cycles, cycles + 1}[maker.word() % 6];
                const double first = std::max(0.0, std::floor(at / rate + maker.uniform(-70, 10)));
                const bool abrupt = maker.uniform(0, 1) < 0.3;
                drives.push_back({rate, maker.uniform(0.5, 10) * 1e-8 / (rate * rate), cycles, maker.uniform(-0.5, 0.5),
                                  0.3, abrupt ? 1e300 : 1 / ramp, abrupt ? 1e300 : 1 / ramp, 0, first});
            }
            const auto got = base_table<float>(kernels(isa), drives);
            for (std::size_t lane = 0; lane < drives.size(); ++lane) {
                const auto alone = base_table<float>(kernels(Isa::scalar), {drives[lane]});
                const auto want = base_table<double>(kernels(Isa::scalar), {drives[lane]});
                const double peak = 39.5 * drives[lane][0] * drives[lane][0] * drives[lane][1]; // (2 pi f dt)2 A
                for (std::size_t k = 0; k < chunk_steps; ++k) {
                    const float value = got[k * drives.size() + lane];
                    ASSERT_EQ(std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(alone[k]))
                        << to_string(isa) << ", lane " << lane << ", step " << k;
                    // half a unit in the last place, and what is left of differences of displacements in double
                    ASSERT_NEAR(static_cast<double>(value), want[k],
                                6.1e-8 * std::fabs(want[k]) + 1e-8 * peak + 1e-15 * drives[lane][1])
                        << "step " << k << " from " << drives[lane][8];
                    largest = std::max(largest, std::fabs(want[k]));
                }
            }
        }
    EXPECT_GT(largest, 1e-6);
}

TEST(WideSingle, SineAndVersineHaveTheirDigits)
{
    std::mt19937_64 engine(27);
    const auto ulps = [](float got, double exact) {
        int exponent = 0;
        std::frexp(exact, &exponent);
        return std::fabs(static_cast<double>(got) - exact) / std::ldexp(1.0, exponent - 24);
    };
    double worst_sine = 0, worst_versine = 0, worst_turned = 0;
    for (int i = 0; i < 400000; ++i) {
        const double size = std::exp(std::uniform_real_distribution<double>(std::log(1e-8), std::log(1e3))(engine));
        const auto x = static_cast<float>(i & 1 ? size : -size);
        const Angle<float> got = angle(x);
        const double exact = x, half = std::sin(exact / 2);
        if (std::fabs(exact) < std::numbers::pi / 4) {
            worst_sine = std::max(worst_sine, ulps(got.sine, std::sin(exact)));
            worst_versine = std::max(worst_versine, ulps(got.versine, 2 * half * half));
        } else {
            worst_turned = std::max({worst_turned, std::fabs(static_cast<double>(got.sine) - std::sin(exact)),
                                     std::fabs(static_cast<double>(got.versine) - 2 * half * half)});
        }
    }
    EXPECT_LT(worst_sine, 1.0);
    EXPECT_LT(worst_versine, 2.0);
    EXPECT_LT(worst_turned, 2.5 * static_cast<double>(std::numeric_limits<float>::epsilon()));
}

} // namespace
} // namespace stylobate
