// Every instruction set gives each realization the bits that it has alone, whatever its lane and its neighbours.

#include "tests/kernels/column_states.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace stylobate {

#if defined(__x86_64__)
extern const KernelTable portable_kernels; // taken for `scalar` on processors without a fused multiply-add
#endif

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of all usable instruction sets; and those that step two registers at a time as tables of their own.
std::vector<KernelTable> tables()
{
    std::vector<KernelTable> found;
    for (const Isa isa : usable_isas()) {
        found.push_back(kernels(isa));
        KernelTable twice = kernels(isa);
        if (twice.planar.run_twice == nullptr)
            continue;
        twice.lanes *= 2;
        twice.planar.run = twice.planar.run_twice;
        twice.fill = twice.fill_twice;
        found.push_back(twice);
    }
    return found;
}

/// Steps one realization with the scalar kernel.
State alone(const Column& column, const State& start, int first, int last)
{
    Aligned<> memory(start.size());
    std::copy(start.begin(), start.end(), memory.data.get());
    kernels(Isa::scalar).planar.run(column.topology, bind_bundle(column.topology, 1, memory.data.get()), first, last);
    return State(memory.data.get(), memory.data.get() + memory.count);
}

/// Steps realizations together, one in each lane.
std::vector<State> together(const Column& column, const KernelTable& table, const std::vector<State>& starts, int first,
                            int last)
{
    const auto lanes = static_cast<std::size_t>(table.lanes);
    const std::size_t fields = column.registers();
    Aligned<> memory(fields * lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t i = 0; i < fields; ++i)
            memory.data[i * lanes + lane] = starts[lane][i];
    table.planar.run(column.topology, bind_bundle(column.topology, table.lanes, memory.data.get()), first, last);
    std::vector<State> ends(lanes, State(fields));
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t i = 0; i < fields; ++i)
            ends[lane][i] = memory.data[i * lanes + lane];
    return ends;
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

TEST(Wide, EachLaneHasTheBitsOfTheScalarKernel)
{
    StateMaker maker(1);
    int general = 0, closed = 0;
    for (int blocks = 1; blocks <= 20; ++blocks) {
        const Column column(blocks);
        for (int round = 0; round < 6; ++round)
            for (const KernelTable& table : tables()) {
                std::vector<State> starts;
                for (int lane = 0; lane < table.lanes; ++lane) {
                    starts.push_back(maker.make(column, any_pose(maker)));
                    const int open = general_joints(column, starts.back());
                    general += open;
                    closed += blocks - open;
                }
                const int last = round == 0 ? 1 : chunk_steps; // also a chunk of a single step
                const std::vector<State> ends = together(column, table, starts, 0, last);
                for (std::size_t lane = 0; lane < starts.size(); ++lane)
                    ASSERT_EQ(first_difference(ends[lane], alone(column, starts[lane], 0, last)), -1)
                        << to_string(table.isa) << " x " << table.lanes << ", lane " << lane << ", " << blocks
                        << " blocks";
            }
    }
    // both ways through the overlap were taken, often
    EXPECT_GT(general, 1000);
    EXPECT_GT(closed, 1000);
}

#if defined(__x86_64__)
TEST(Wide, ScalarHasTheSameBitsWithoutTheInstruction)
{
    StateMaker maker(7);
    for (int blocks : {1, 6, 9}) {
        const Column column(blocks);
        for (int round = 0; round < 8; ++round) {
            const State start = maker.make(column, any_pose(maker));
            ASSERT_EQ(first_difference(together(column, portable_kernels, {start}, 0, chunk_steps)[0],
                                       alone(column, start, 0, chunk_steps)),
                      -1);
        }
    }
}
#endif

TEST(Wide, TheStepMovesTheBlocks)
{
    // so that the comparisons here cannot pass because nothing happens
    StateMaker maker(2);
    const Column column(6);
    const State start = maker.make(column, Pose::rocking), end = alone(column, start, 0, chunk_steps);
    int changed = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
        changed += std::bit_cast<std::uint64_t>(start[i]) != std::bit_cast<std::uint64_t>(end[i]);
    EXPECT_GT(changed, 6 * 11);
    for (double value : end)
        ASSERT_TRUE(std::isfinite(value));
}

TEST(Wide, NeighboursDoNotMatter)
{
    StateMaker maker(3);
    const std::vector<double> poison{nan_value, infinite, -infinite, 1e308, -1e308, 5e-324, 0.0, -0.0};
    for (const KernelTable& table : tables()) {
        for (int blocks : {1, 6, 8, 9, 17}) {
            const Column column(blocks);
            for (int round = 0; round < 40; ++round) {
                const State start = maker.make(column, any_pose(maker));
                const State want = alone(column, start, 0, chunk_steps);
                std::vector<State> starts;
                for (int lane = 0; lane < table.lanes; ++lane) {
                    State other = maker.make(column, any_pose(maker));
                    if (round % 3 == 1)
                        std::fill(other.begin(), other.end(), poison[maker.word() % poison.size()]);
                    if (round % 3 == 2)
                        for (double& value : other)
                            value = std::bit_cast<double>(maker.word());
                    starts.push_back(std::move(other));
                }
                const std::size_t lane = maker.word() % starts.size();
                starts[lane] = start;
                ASSERT_EQ(first_difference(together(column, table, starts, 0, chunk_steps)[lane], want), -1)
                    << to_string(table.isa) << " x " << table.lanes << ", lane " << lane << ", " << blocks
                    << " blocks, round " << round;
            }
        }
    }
}

TEST(Wide, AChunkInPiecesMovesTheBlocksAlike)
{
    StateMaker maker(4);
    for (const KernelTable& table : tables()) {
        const Column column(7);
        std::vector<State> starts;
        for (int lane = 0; lane < table.lanes; ++lane)
            starts.push_back(maker.make(column, any_pose(maker)));
        const std::vector<State> want = together(column, table, starts, 0, chunk_steps);
        std::vector<State> got = together(column, table, starts, 0, 1);
        got = together(column, table, got, 1, 40);
        got = together(column, table, got, 40, chunk_steps);
        for (std::size_t lane = 0; lane < starts.size(); ++lane)
            ASSERT_EQ(first_difference(got[lane], want[lane]), -1)
                << to_string(table.isa) << " x " << table.lanes << ", lane " << lane;
    }
}

TEST(Wide, OrderOfTheJointsDoesNotMoveTheBlocks)
{
    StateMaker maker(5);
    for (int blocks : {2, 6, 9, 20}) {
        const Column upward(blocks);
        std::vector<int> order(static_cast<std::size_t>(blocks));
        for (int j = 0; j < blocks; ++j)
            order[static_cast<std::size_t>(j)] = j;
        for (int round = 0; round < 20; ++round) {
            std::shuffle(order.begin(), order.end(), std::mt19937_64(maker.word()));
            const Column shuffled(blocks, order);
            const State start = maker.make(upward, any_pose(maker));
            State permuted = start;
            const Bundle from = bind_bundle(upward.topology, 1, const_cast<double*>(start.data()));
            const Bundle to = bind_bundle(shuffled.topology, 1, permuted.data());
            const auto copy_joints = [&](const Bundle& source, const Bundle& target, bool back) {
                for (int j = 0; j < blocks; ++j)
                    for (int f = 0; f < OfJoint::count; ++f) {
                        const int k = order[static_cast<std::size_t>(j)];
                        const auto field = static_cast<OfJoint::Field>(f);
                        target.at(field, back ? k : j, 0) = source.at(field, back ? j : k, 0);
                    }
            };
            copy_joints(from, to, false);
            State want = alone(upward, start, 0, chunk_steps), got = alone(shuffled, permuted, 0, chunk_steps);
            // put the joints back; sums over all joints are rounded in another order, and only compared roughly
            State back = got;
            copy_joints(bind_bundle(shuffled.topology, 1, got.data()), bind_bundle(upward.topology, 1, back.data()),
                        true);
            const Bundle a = bind_bundle(upward.topology, 1, want.data()),
                         c = bind_bundle(upward.topology, 1, back.data());
            for (auto field :
                 {OfRealization::slip, OfRealization::path, OfRealization::rocking_path, OfRealization::friction_energy,
                  OfRealization::dashpot_energy, OfRealization::shear_energy}) {
                const double scale = std::fabs(a.at(field, 0)) + 1e-12;
                ASSERT_NEAR(c.at(field, 0), a.at(field, 0), 1e-9 * scale) << "field " << field;
                c.at(field, 0) = a.at(field, 0);
            }
            ASSERT_EQ(first_difference(back, want), -1) << blocks << " blocks, round " << round;
        }
    }
}

/// Parameters of one lane.
struct Drive {
    double values[8];
};

Drive random_drive(StateMaker& maker, MotionFormula formula)
{
    const bool abrupt_start = maker.uniform(0, 1) < 0.3, abrupt_end = maker.uniform(0, 1) < 0.3;
    const double phase = maker.uniform(-0.5, 0.5);
    const double ramp = maker.uniform(0.5, 4), f = std::exp(maker.uniform(std::log(0.1), std::log(60.0)));
    const double cycles = formula == MotionFormula::pulse ? 0.5 * static_cast<double>(1 + maker.word() % 2)
                                                          : std::floor(maker.uniform(4, 20));
    return {{f * 1e-4, maker.uniform(0.001, 0.5), cycles, phase, abrupt_start ? std::sin(6.283185307179586 * phase) : 0,
             abrupt_start ? 1e300 : 1 / ramp, abrupt_end ? 1e300 : 1 / ramp, cycles == 0.5 ? 2.0 : 0.0}};
}

std::vector<double> filled(const KernelTable& table, MotionFormula formula, const std::vector<Drive>& drives,
                           const std::vector<double>& first)
{
    const auto lanes = static_cast<std::size_t>(table.lanes);
    Aligned<> memory((9 + chunk_steps) * 8 * lanes);
    std::vector<double*> rows;
    for (std::size_t i = 0; i < 9; ++i)
        rows.push_back(memory.data.get() + i * lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        for (std::size_t i = 0; i < 8; ++i)
            rows[i][lane] = drives[lane].values[i];
        rows[8][lane] = first[lane];
    }
    const FormulaParameters p{rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7]};
    double* out = memory.data.get() + 16 * lanes;
    table.fill(formula, p, rows[8], out);
    return std::vector<double>(out, out + chunk_steps * lanes);
}

TEST(Wide, BaseMotionHasTheSameBitsInEveryLane)
{
    StateMaker maker(6);
    double largest = 0;
    for (MotionFormula formula : {MotionFormula::still, MotionFormula::harmonic, MotionFormula::pulse})
        for (const KernelTable& table : tables()) {
            for (int round = 0; round < 100; ++round) {
                std::vector<Drive> drives;
                std::vector<double> first;
                for (int lane = 0; lane < table.lanes; ++lane) {
                    drives.push_back(random_drive(maker, formula));
                    // before, in, around the end of, and after the motion
                    const double steps = drives.back().values[2] / drives.back().values[0];
                    const double where[] = {0.0, std::floor(maker.uniform(0, steps)), std::floor(steps) - 30,
                                            steps * 3};
                    first.push_back(std::floor(where[maker.word() % 4]));
                    if (round % 4 == 3 && lane > 0)
                        drives.back() = Drive{{nan_value, infinite, nan_value, 1e308, nan_value, 0, 0, nan_value}};
                }
                const std::vector<double> got = filled(table, formula, drives, first);
                for (std::size_t lane = 0; lane < drives.size(); ++lane) {
                    if (round % 4 == 3 && lane > 0)
                        continue;
                    const std::vector<double> want =
                        filled(kernels(Isa::scalar), formula, {drives[lane]}, {first[lane]});
                    for (std::size_t k = 0; k < want.size(); ++k) {
                        ASSERT_EQ(std::bit_cast<std::uint64_t>(got[k * drives.size() + lane]),
                                  std::bit_cast<std::uint64_t>(want[k]))
                            << to_string(table.isa) << " x " << table.lanes << ", lane " << lane << ", step " << k;
                        largest = std::max(largest, std::fabs(want[k]));
                    }
                }
            }
        }
    EXPECT_GT(largest, 1e-6);
}

TEST(Wide, NamesOfTheInstructionSetsAreReadBack)
{
    for (Isa isa : usable_isas()) {
        Isa read = Isa::neon;
        ASSERT_TRUE(parse_isa(to_string(isa), read));
        EXPECT_EQ(read, isa);
        EXPECT_EQ(kernels(isa).isa, isa);
    }
    Isa read = Isa::scalar;
    EXPECT_FALSE(parse_isa("avx", read));
    EXPECT_FALSE(parse_isa("", read));
}

} // namespace
} // namespace stylobate
