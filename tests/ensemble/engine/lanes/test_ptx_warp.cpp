/// The machine that runs the PTX of kernels, with small kernels (`tiny.cu`): a right one has the numbers of plain C++,
/// and of each mistake the machine reports what it is, or has a wrong number in some order.

#include "tests/ensemble/engine/lanes/ptx_warp.hpp"
#include "tests/ensemble/engine/lanes/tiny.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tiny {
ptx::Kernels kernels(); // generated
}

namespace {

constexpr int lanes = 32, warps = 2, blocks = 3, threads = blocks * warps * lanes;
constexpr std::size_t shared_bytes = warps * lanes * 2 * sizeof(double);

void launch(ptx::Machine& machine, std::string_view name, const std::vector<char>& parameters, int count,
            int threads_per_block, std::size_t dynamic_bytes, unsigned seed)
{
    machine.run(ptx::kernel_named(tiny::kernels(), name), parameters.data(), parameters.size(), count,
                threads_per_block, dynamic_bytes, seed);
}

/// What `sums` computes before the lanes exchange results: a loop over rounds, and in it loops over lanes.
std::vector<double> mixed(std::vector<double> x, int n, int rounds)
{
    for (int k = 0; k < rounds; ++k) {
        const std::vector<double> old = x;
        for (int thread = 0; thread < threads; ++thread) {
            const int lane = thread % lanes, below = lane == 0 ? thread : thread - 1;
            const double above = lane == lanes - 1 ? 0 : old[(thread + 1) * n + k % n];
            const double product = old[below * n] * old[below * n + n - 1];
            for (int i = 0; i < n; ++i)
                x[thread * n + i] = std::fma(old[thread * n + i], 0.75, above) - product;
        }
    }
    return x;
}

double weighed(double of_a, double of_b, int times, double a, double b)
{
    for (; times > 0; --times) {
        const double sum = of_a * a + of_b * b;
        b = std::exchange(a, sum);
        std::swap(of_a, of_b);
    }
    return of_a * a + of_b * b;
}

std::vector<tiny::Output> expected(const std::vector<double>& x, int n, double divisor)
{
    std::vector<tiny::Output> out(threads);
    for (int thread = 0; thread < threads; ++thread) {
        tiny::Output& o = out[thread];
        const double first = x[thread * n], last = x[thread * n + n - 1];
        for (int i = 0; i < n; ++i)
            o.sum = i == 0 ? first : o.sum + x[thread * n + i];
        o.quotient = first / divisor;
        o.root = std::sqrt(std::fabs(last));
        o.fused = std::fma(first, last, -(first * last));
        o.weighed = weighed(0.3, 0.9, thread % 4, first, o.quotient);
        o.small = std::min(first, last);
        o.large = std::max(first, last);
        double powers[4] = {1, 1.25, 1.25 * 1.25, 1.25 * 1.25 * 1.25};
        powers[thread / 4 % 4] += 0.5;
        o.power = powers[thread % 4];
        o.whole = static_cast<long long>(o.root * 1e6);
        o.divided = (thread * 1000003 - 77777) / 7 - thread % 5 + 4 * o.whole;
    }
    for (int thread = 0; thread < threads; ++thread) {
        tiny::Output& o = out[thread];
        const int first = thread / lanes * lanes, lane = thread % lanes;
        o.from_other = out[first + (lane * 7 + 3) % lanes].sum;
        o.from_above = lane < lanes - 2 ? (lane + 2) * (lane + 2) : lane * lane;
        for (int other = 0; other < lanes; ++other)
            o.votes |= out[first + other].sum > 0 ? 1U << other : 0;
        o.bits = std::popcount(o.votes) + 10000 * std::countl_zero(o.votes);
        o.bits += o.votes == 0 ? 0 : 100 * (std::countr_zero(o.votes) + 1);
    }
    return out;
}

void expect_same(const tiny::Output& a, const tiny::Output& b, int thread)
{
    const auto number = [&](double tiny::Output::*member, const char* name) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a.*member), std::bit_cast<std::uint64_t>(b.*member))
            << name << " of thread " << thread << ": " << a.*member << ", " << b.*member;
    };
    number(&tiny::Output::sum, "sum");
    number(&tiny::Output::quotient, "quotient");
    number(&tiny::Output::root, "root");
    number(&tiny::Output::fused, "fused");
    number(&tiny::Output::from_other, "from_other");
    number(&tiny::Output::weighed, "weighed");
    number(&tiny::Output::small, "small");
    number(&tiny::Output::large, "large");
    number(&tiny::Output::power, "power");
    EXPECT_EQ(a.whole, b.whole) << thread;
    EXPECT_EQ(a.divided, b.divided) << thread;
    EXPECT_EQ(a.from_above, b.from_above) << thread;
    EXPECT_EQ(a.any, b.any) << thread;
    EXPECT_EQ(a.bits, b.bits) << thread;
    EXPECT_EQ(a.votes, b.votes) << thread;
}

/// The answers of a kernel of one warp that reads and writes 32 numbers.
std::vector<double> answers(ptx::Machine& machine, std::string_view name, const std::vector<double>& in, unsigned seed,
                            std::size_t dynamic_bytes = lanes * sizeof(double))
{
    std::vector<double> out(lanes);
    launch(machine, name, ptx::packed(in.data(), out.data()), 1, lanes, dynamic_bytes, seed);
    return out;
}

/// first, first + 1, ...
std::vector<double> counted(double first)
{
    std::vector<double> in(lanes);
    for (int i = 0; i < lanes; ++i)
        in[i] = first + i;
    return in;
}

/// What the machine states of a kernel.
std::string error_of(const char* name, const std::vector<double>& in,
                     std::size_t dynamic_bytes = lanes * sizeof(double))
{
    ptx::Machine machine;
    for (int again = 0; again < 2; ++again) // after an error the machine goes on with other kernels
        try {
            answers(machine, name, in, 1, dynamic_bytes);
            return "none";
        } catch (const ptx::Error& error) {
            if (again == 1)
                return error.what();
            EXPECT_EQ(answers(machine, "remembers", in, 1)[0], in[1]);
        }
    return {};
}

class PtxWarpSums : public testing::TestWithParam<int> {};

TEST_P(PtxWarpSums, HaveTheNumbersOfPlainCode)
{
    const int n = GetParam();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-0.5, 0.5);
    std::vector<double> values(threads * n);
    for (double& v : values)
        v = number(random);
    ptx::Machine machine;
    int positive = 0;
    for (const int rounds : {0, 1, 2, 3, 8}) {
        const std::vector<tiny::Output> right = expected(mixed(values, n, rounds), n, 0.3);
        for (unsigned seed = 1; seed <= 5; ++seed) {
            std::vector<tiny::Output> out(threads);
            const tiny::Input in{values.data(), 0.3};
            launch(machine, "sums<" + std::to_string(n) + ">", ptx::packed(in, out.data(), rounds), blocks,
                   warps * lanes, shared_bytes, seed);
            for (int thread = 0; thread < threads; ++thread)
                expect_same(out[thread], right[thread], thread);
        }
        for (const tiny::Output& o : right)
            positive += o.votes != 0 && o.votes != ~0U;
    }
    EXPECT_GT(positive, threads) << "the lanes should not all have the same sign";
    EXPECT_GT(machine.meetings(), 0);
}

INSTANTIATE_TEST_SUITE_P(Values, PtxWarpSums, testing::Values(2, 3));

TEST(PtxWarp, SeesAMissingBarrier)
{
    const std::vector<double> in = counted(1);
    ptx::Machine machine;
    int wrong = 0, wrong_with_barrier = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const std::vector<double> without = answers(machine, "forgets", in, seed);
        const std::vector<double> with = answers(machine, "remembers", in, seed);
        for (int i = 0; i < lanes; ++i) {
            wrong += without[i] != in[(i + 1) % lanes];
            wrong_with_barrier += with[i] != in[(i + 1) % lanes];
        }
    }
    EXPECT_EQ(wrong_with_barrier, 0);
    // each lane is wrong where it runs before its neighbour: half of 640, with a deviation of at most 13
    EXPECT_GT(wrong, 320 - 5 * 13);
    EXPECT_LT(wrong, 320 + 5 * 13);
}

TEST(PtxWarp, ReportsWhatItIsGivenWrong)
{
    const std::vector<double> in = counted(1);
    const std::string apart = error_of("parts", in);
    EXPECT_TRUE(apart.starts_with("lanes wait at different instructions: lanes 0 to 15 in line ")) << apart;
    EXPECT_NE(apart.find(", lanes 16 to 31 in line "), std::string::npos) << apart;
    const std::string few = error_of("few", in);
    EXPECT_TRUE(few.starts_with("not all lanes are named in line ")) << few;
    EXPECT_EQ(error_of("leaves", in), "none");
    const std::string left = error_of("leaves", counted(-2)); // -2, -1, 0, 1, ...
    EXPECT_TRUE(left.starts_with("some lanes wait: lanes 2 to 31 in line ")) << left;
    EXPECT_TRUE(left.ends_with("; others have ended: lanes 0 to 1")) << left;
    const std::string outside = error_of("remembers", in, 31 * sizeof(double));
    EXPECT_TRUE(outside.starts_with("lane 31 asks for 8 bytes at ")) << outside; // all 32 write, and one has no place
    EXPECT_TRUE(outside.ends_with(": outside, or not aligned")) << outside;
}

TEST(PtxWarp, RefusesLaunchesThatADeviceWouldRefuse)
{
    ptx::Machine machine;
    const std::vector<double> in = counted(1);
    std::vector<double> out(lanes);
    const std::vector<char> parameters = ptx::packed(in.data(), out.data());
    EXPECT_THROW(launch(machine, "remembers", ptx::packed(in.data()), 1, lanes, 256, 1), ptx::Error);
    EXPECT_THROW(launch(machine, "remembers", parameters, 1, 48, 256, 1), ptx::Error);
    EXPECT_THROW(launch(machine, "remembers", parameters, 1, lanes, 255, 1), ptx::Error);
    EXPECT_THROW(launch(machine, "sums", parameters, 1, lanes, 256, 1), ptx::Error);
    EXPECT_THROW(launch(machine, "sums<4>", parameters, 1, lanes, 256, 1), ptx::Error);
    EXPECT_NO_THROW(launch(machine, "remembers", parameters, 1, lanes, 256, 1));
    EXPECT_EQ(out[31], in[0]);
}

} // namespace
