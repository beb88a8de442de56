/// Counter-based random numbers, and the distributions that are drawn with them.

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

using namespace stylobate;

namespace {

using Words = std::array<std::uint64_t, 4>;

/// Philox4x64-10 as in the paper, written out with schoolbook multiplication.
Words philox(Words c, std::uint64_t k0, std::uint64_t k1)
{
    const auto multiply = [](std::uint64_t a, std::uint64_t b) {
        const std::uint64_t a0 = a & 0xffffffffU, a1 = a >> 32, b0 = b & 0xffffffffU, b1 = b >> 32;
        const std::uint64_t middle = a1 * b0 + ((a0 * b0) >> 32);
        const std::uint64_t cross = a0 * b1 + (middle & 0xffffffffU);
        return std::array{a1 * b1 + (middle >> 32) + (cross >> 32), a * b}; // high, low
    };
    for (int round = 0; round < 10; ++round) {
        const auto p0 = multiply(0xD2E7470EE14C6C93U, c[0]);
        const auto p1 = multiply(0xCA5A826395121157U, c[2]);
        c = {p1[0] ^ c[1] ^ k0, p1[1], p0[0] ^ c[3] ^ k1, p0[1]};
        k0 += 0x9E3779B97F4A7C15U;
        k1 += 0xBB67AE8584CAA73BU;
    }
    return c;
}

double lower_tail(double z)
{
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}
double upper_tail(double z)
{
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}
double density(double z)
{
    return std::exp(-z * z / 2) / std::sqrt(2 * M_PI);
}

Perturbation normal(double sd)
{
    Perturbation p;
    p.sd = sd;
    return p;
}

Perturbation lognormal(double sigma)
{
    Perturbation p;
    p.distribution = DistributionKind::lognormal;
    p.sigma_ln = sigma;
    return p;
}

Perturbation between(DistributionKind kind, double from, double to)
{
    Perturbation p;
    p.distribution = kind;
    p.from = from;
    p.to = to;
    return p;
}

/// Mean of f(value) over the distribution, by the midpoint rule in u: no chance in it.
double mean(const Distribution& distribution, const std::function<double(double)>& f)
{
    constexpr int n = 200000;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum += f(distribution.value((i + 0.5) / n));
    return sum / n;
}

double identity(double x)
{
    return x;
}

/// Chi-squared of `bins` equal bins.
template <class Draw>
double chi_squared(int n, int bins, const Draw& draw)
{
    std::vector<int> count(static_cast<std::size_t>(bins));
    for (int i = 0; i < n; ++i)
        ++count[static_cast<std::size_t>(draw(static_cast<std::uint64_t>(i)) * bins)];
    const double expected = static_cast<double>(n) / bins;
    double sum = 0;
    for (const int c : count)
        sum += (c - expected) * (c - expected) / expected;
    return sum;
}

} // namespace

TEST(Random, KnownAnswers)
{
    // the known-answer vectors of Random123 for philox4x64 with 10 rounds
    EXPECT_EQ(philox({0, 0, 0, 0}, 0, 0),
              (Words{0x16554d9eca36314cU, 0xdb20fe9d672d0fdcU, 0xd7e772cee186176bU, 0x7e68b68aec7ba23bU}));
    const std::uint64_t all = ~std::uint64_t(0);
    EXPECT_EQ(philox({all, all, all, all}, all, all),
              (Words{0x87b092c3013fe90bU, 0x438c3c67be8d0224U, 0x9cc7d7c69cd777b6U, 0xa09caebf594f0ba0U}));
    EXPECT_EQ(philox({0x243f6a8885a308d3U, 0x13198a2e03707344U, 0xa4093822299f31d0U, 0x082efa98ec4e6c89U},
                     0x452821e638d01377U, 0xbe5466cf34e90c6cU),
              (Words{0xa528f45403e61d95U, 0x38c72dbd566e9788U, 0xa5a1610e72fd18b5U, 0x57bd43b5e52b7fe6U}));

    // the draws are these words, keyed and counted as documented
    EXPECT_EQ(random_bits(0, 0, Stream::friction, 0), 0x16554d9eca36314cU);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const std::uint64_t seed = i * i * 0x123456789abcdefU, index = i * 77 + (i << 40), element = i % 13;
        for (const Stream stream : {Stream::friction, Stream::drum_width, Stream::phase})
            EXPECT_EQ(random_bits(seed, index, stream, element),
                      philox({static_cast<std::uint64_t>(stream), element, 0, 0}, seed, index)[0]);
    }
}

TEST(Random, StreamsKeepTheirNumbers)
{
    // a changed number would change every realization of every older study
    EXPECT_EQ(static_cast<int>(Stream::friction), 0);
    EXPECT_EQ(static_cast<int>(Stream::normal_stiffness), 1);
    EXPECT_EQ(static_cast<int>(Stream::tangential_stiffness), 2);
    EXPECT_EQ(static_cast<int>(Stream::damping_ratio), 3);
    EXPECT_EQ(static_cast<int>(Stream::drum_width), 4);
    EXPECT_EQ(static_cast<int>(Stream::drum_height), 5);
    EXPECT_EQ(static_cast<int>(Stream::drum_offset), 6);
    EXPECT_EQ(static_cast<int>(Stream::density), 7);
    EXPECT_EQ(static_cast<int>(Stream::tilt), 8);
    EXPECT_EQ(static_cast<int>(Stream::phase), 9);
}

TEST(Random, UniformIsOpenAndOnItsGrid)
{
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const double u = uniform01(3, i, Stream::density, 1);
        ASSERT_GT(u, 0);
        ASSERT_LT(u, 1);
        const double k = std::ldexp(u, 53);
        ASSERT_EQ(k, std::floor(k));
        ASSERT_EQ(std::fmod(k, 2), 1);
        ASSERT_EQ(1 - (1 - u), u);
        // the highest 52 bits of the word, rounded to the middle of their cell
        const std::uint64_t word = random_bits(3, i, Stream::density, 1);
        ASSERT_EQ(u, std::ldexp(static_cast<double>(word >> 12), -52) + 0x1p-53);
    }
}

TEST(Random, UniformAlongEveryAxis)
{
    // chi-squared with 999 degrees of freedom: mean 999, sd 44.7. Five times |x - 999| < 5 sd: a right generator
    // fails with a probability of about 5e-6; the seed is fixed, so it fails always or never.
    const int n = 200000;
    const double allowed = 5 * std::sqrt(2.0 * 999);
    EXPECT_NEAR(chi_squared(n, 1000, [](auto i) { return uniform01(i, 5, Stream::friction, 2); }), 999, allowed);
    EXPECT_NEAR(chi_squared(n, 1000, [](auto i) { return uniform01(1, i, Stream::friction, 2); }), 999, allowed);
    EXPECT_NEAR(chi_squared(n, 1000, [](auto i) { return uniform01(1, 5, static_cast<Stream>(i), 2); }), 999, allowed);
    EXPECT_NEAR(chi_squared(n, 1000, [](auto i) { return uniform01(1, 5, Stream::friction, i); }), 999, allowed);
    // the lowest bits are as random as the highest
    EXPECT_NEAR(chi_squared(n, 1000,
                            [](auto i) {
                                const double low = std::ldexp(uniform01(1, i, Stream::tilt, 0), 30);
                                return low - std::floor(low);
                            }),
                999, allowed);
}

TEST(Random, NeighboursAreUncorrelated)
{
    // the correlation of n pairs has sd 1 / sqrt(n); 4 pairs at 5 sd: false alarm about 2e-6
    const int n = 200000;
    const auto correlation = [&](auto&& first, auto&& second) {
        double sum = 0;
        for (std::uint64_t i = 0; i < n; ++i)
            sum += 12 * (first(i) - 0.5) * (second(i) - 0.5);
        return sum / n;
    };
    const auto base = [](std::uint64_t i) { return uniform01(1, i, Stream::friction, 0); };
    const double allowed = 5 / std::sqrt(n);
    EXPECT_NEAR(correlation(base, [](auto i) { return uniform01(1, i, Stream::friction, 1); }), 0, allowed);
    EXPECT_NEAR(correlation(base, [](auto i) { return uniform01(1, i + 1, Stream::friction, 0); }), 0, allowed);
    EXPECT_NEAR(correlation(base, [](auto i) { return uniform01(2, i, Stream::friction, 0); }), 0, allowed);
    EXPECT_NEAR(correlation(base, [](auto i) { return uniform01(1, i, Stream::normal_stiffness, 0); }), 0, allowed);
}

TEST(Random, OrderAndThreadsChangeNothing)
{
    const int n = 4000;
    std::vector<double> forward(n), threaded(n);
    for (int i = 0; i < n; ++i)
        forward[static_cast<std::size_t>(i)] = uniform01(9, static_cast<std::uint64_t>(i), Stream::density, 4);
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t)
        threads.emplace_back([&, t] {
            for (int i = n - 1 - t; i >= 0; i -= 3)
                threaded[static_cast<std::size_t>(i)] = uniform01(9, static_cast<std::uint64_t>(i), Stream::density, 4);
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(forward, threaded);
}

TEST(Distribution, ClosedFormQuantiles)
{
    // quantiles of the standard normal to the digits of the tables
    const Distribution standard(normal(2), 10);
    EXPECT_DOUBLE_EQ(standard.value(0.5), 10);
    EXPECT_NEAR(standard.value(0.975), 10 + 2 * 1.959963984540054, 1e-14 * 10);
    EXPECT_NEAR(standard.value(0.025), 10 - 2 * 1.959963984540054, 1e-14 * 10);
    EXPECT_NEAR(standard.value(0.9), 10 + 2 * 1.2815515655446004, 1e-14 * 10);

    Perturbation relative;
    relative.cov = 0.1;
    EXPECT_NEAR(Distribution(relative, 0.68).value(0.9), 0.68 * (1 + 0.1 * 1.2815515655446004), 1e-15);
    EXPECT_NEAR(Distribution(relative, -0.68).value(0.9), 0.68 * (-1 + 0.1 * 1.2815515655446004), 1e-15);

    EXPECT_NEAR(Distribution(lognormal(0.7), 1e8).value(0.9) / (1e8 * std::exp(0.7 * 1.2815515655446004)), 1, 1e-14);
    EXPECT_DOUBLE_EQ(Distribution(lognormal(0.7), 1e8).value(0.5), 1e8);

    EXPECT_DOUBLE_EQ(Distribution(between(DistributionKind::uniform, -1, 3), 77).value(0.25), 0);
    EXPECT_NEAR(Distribution(between(DistributionKind::log_uniform, 0.05, 0.5), 77).value(0.5), std::sqrt(0.025),
                1e-16);
}

TEST(Distribution, InvertsTheProbability)
{
    const Distribution standard(normal(1), 0);
    for (double u = 0x1p-53; u < 0.5; u *= 1.7) {
        EXPECT_NEAR(lower_tail(standard.value(u)) / u, 1, 1e-12) << u;
        const double v = 1 - u;
        EXPECT_NEAR(upper_tail(standard.value(v)) / (1 - v), 1, 1e-12) << u;
    }
}

TEST(Distribution, TruncationLeavesNoMassAtTheEnds)
{
    Perturbation p = normal(1);
    p.min = -0.5;
    p.max = 2;
    const Distribution distribution(p, 0);
    const double low = lower_tail(-0.5), high = lower_tail(2);
    double last = -0.5;
    for (int i = 1; i < 1000; ++i) {
        const double u = i / 1000.0;
        const double x = distribution.value(u);
        EXPECT_NEAR(lower_tail(x), low + u * (high - low), 1e-15);
        EXPECT_GT(x, last);
        last = x;
    }
    EXPECT_NEAR(distribution.value(0x1p-53), -0.5, 1e-15);
    EXPECT_LE(distribution.value(1 - 0x1p-53), 2);
}

TEST(Distribution, KeepsItsAccuracyInTheTails)
{
    for (const double far : {6.0, 10.0, 20.0, 35.0}) {
        for (const bool upper : {false, true}) {
            Perturbation p = normal(1);
            (upper ? p.min : p.max) = upper ? far : -far;
            const Distribution distribution(p, 0);
            for (const double u : {1e-6, 0.1, 0.5, 0.9, 0.999999}) {
                const double x = distribution.value(u);
                const double left = upper ? upper_tail(x) / upper_tail(far) : lower_tail(x) / lower_tail(-far);
                // rounding of x alone moves the tail by far2 ulp
                EXPECT_NEAR(left, upper ? 1 - u : u, 4e-16 * far * far + 1e-12 * left)
                    << far << ' ' << upper << ' ' << u;
            }
        }
    }
    // both limits on one side, where 1 - p would be the same double for both
    Perturbation p = normal(1);
    p.min = 12;
    p.max = 12.5;
    const Distribution distribution(p, 0);
    const double x = distribution.value(0.5);
    EXPECT_NEAR(upper_tail(x) / (0.5 * (upper_tail(12) + upper_tail(12.5))), 1, 1e-11);
}

TEST(Distribution, MomentsOfTheTruncatedNormal)
{
    const double mu = 0.68, sd = 0.068, a = 0.6, b = 0.9;
    Perturbation p;
    p.cov = 0.1;
    p.min = a;
    p.max = b;
    const Distribution distribution(p, mu);
    const double alpha = (a - mu) / sd, beta = (b - mu) / sd;
    const double mass = lower_tail(beta) - lower_tail(alpha);
    const double shift = (density(alpha) - density(beta)) / mass;
    const double want = mu + sd * shift;
    const double variance = sd * sd * (1 + (alpha * density(alpha) - beta * density(beta)) / mass - shift * shift);
    EXPECT_NEAR(mean(distribution, identity), want, 1e-8);
    EXPECT_NEAR(mean(distribution, [&](double x) { return (x - want) * (x - want); }), variance, 1e-8);
}

TEST(Distribution, MomentsOfTheTruncatedLognormal)
{
    const double nominal = 1e8, s = 0.7, a = 3e7, b = 4e8;
    Perturbation p = lognormal(s);
    p.min = a;
    p.max = b;
    const double alpha = std::log(a / nominal) / s, beta = std::log(b / nominal) / s;
    const double mass = lower_tail(beta) - lower_tail(alpha);
    const double want = nominal * std::exp(s * s / 2) * (lower_tail(beta - s) - lower_tail(alpha - s)) / mass;
    EXPECT_NEAR(mean(Distribution(p, nominal), identity) / want, 1, 1e-8);
    EXPECT_NEAR(mean(Distribution(lognormal(s), nominal), identity) / (nominal * std::exp(s * s / 2)), 1, 1e-4);
}

TEST(Distribution, MomentsOfTheUniformOnes)
{
    Perturbation p = between(DistributionKind::uniform, 1, 5);
    p.max = 3;
    EXPECT_NEAR(mean(Distribution(p, 0), identity), 2, 1e-9);
    EXPECT_NEAR(mean(Distribution(p, 0), [](double x) { return (x - 2) * (x - 2); }), 4.0 / 12, 1e-9);
    p = between(DistributionKind::log_uniform, 0.01, 0.5);
    p.min = 0.05;
    EXPECT_NEAR(mean(Distribution(p, 0), identity), 0.45 / std::log(10.0), 1e-9);
}

TEST(Distribution, WithoutSpreadItIsTheNominalValue)
{
    EXPECT_EQ(Distribution(normal(0), 0.68).value(0.1), 0.68);
    EXPECT_EQ(Distribution(lognormal(0), 0.68).value(0.9), 0.68);
    Perturbation p;
    p.cov = 0.1;
    EXPECT_EQ(Distribution(p, 0).value(0.3), 0);
    EXPECT_EQ(Distribution(between(DistributionKind::log_uniform, 2, 2), 0).value(0.3), 2);
}

TEST(Distribution, RefusesLimitsThatLeaveNothing)
{
    Perturbation p = normal(1);
    p.quantity = Quantity::drum_width;
    p.min = 100;
    try {
        Distribution(p, 0);
        FAIL() << "no exception";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("perturbation.drum_width"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("100"), std::string::npos) << error.what();
    }
    p.min = 2;
    p.max = 1;
    EXPECT_THROW(Distribution(p, 0), InputError);
    p = normal(0);
    p.min = 2;
    EXPECT_THROW(Distribution(p, 1), InputError);
    p = lognormal(0.5);
    p.max = 0;
    EXPECT_THROW(Distribution(p, 1), InputError);
    EXPECT_THROW(Distribution(lognormal(0.5), 0), InputError);
    p = between(DistributionKind::uniform, 0, 1);
    p.min = 2;
    EXPECT_THROW(Distribution(p, 0.5), InputError);
}

TEST(NormalDraw, IsTheQuantileOfTheNormalDistribution)
{
    // tables: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.5
    EXPECT_NEAR(to_normal(0.975), 1.959963984540054, 1e-14);
    EXPECT_NEAR(to_normal(0.999), 3.090232306167813, 1e-14);
    EXPECT_EQ(to_normal(0.5), 0);
    // the inverse of the distribution function, by the error function of the C library
    for (double u = 0x1p-53; u < 0.5; u = u < 0.01 ? 3 * u : u + 0.0071) {
        const double z = to_normal(u);
        EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / u, 1, 1e-14 * (1 + z * z)) << u;
        if (u > 1e-3) {
            EXPECT_NEAR(to_normal(1 - u), -z, 1e-12 * std::fabs(z)) << u;
        }
    }
}
