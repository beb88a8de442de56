/// Synthetic pulses and sines: against their papers' formulas by quadrature in extended precision, their peaks, their
/// rest at both ends; and the elementary functions beneath them.

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/numerics/elementary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace stylobate::test_synthetic {
namespace {

using Real = long double;
const Real pi = std::numbers::pi_v<Real>;

// ---- elementary functions

/// Error in units of the last place of the wanted value.
double ulps(double got, Real want)
{
    const double nearest = static_cast<double>(want);
    const double ulp = std::nextafter(std::fabs(nearest), HUGE_VAL) - std::fabs(nearest);
    return static_cast<double>(std::fabs(static_cast<Real>(got) - want)) / ulp;
}

TEST(Elementary, ExponentialAndLogarithmAreGoodToTheLastBit)
{
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> exponent(-60, 20), number(1e-6, 4);
    double worst_exp = 0, worst_log = 0;
    for (int i = 0; i < 300000; ++i) {
        const double x = exponent(engine), y = i % 2 == 0 ? number(engine) : std::exp(exponent(engine));
        worst_exp = std::max(worst_exp, ulps(exp_of(x), std::exp(static_cast<Real>(x))));
        worst_log = std::max(worst_log, ulps(log_of(y), std::log(static_cast<Real>(y))));
    }
    EXPECT_LT(worst_exp, 1);
    EXPECT_LT(worst_log, 2);
    EXPECT_EQ(exp_of(0), 1);
    EXPECT_EQ(log_of(1), 0);
    EXPECT_DOUBLE_EQ(log_of(0x1p-53), -53 * std::numbers::ln2); // the smallest uniform number
}

TEST(Elementary, SineAndCosineOfAnyNumberOfCycles)
{
    for (double c = -3.7; c < 40; c += 0.0137) {
        const Real turn = 2 * pi * (static_cast<Real>(c) - std::nearbyint(c));
        ASSERT_NEAR(sine_of(c), static_cast<double>(std::sin(turn)), 3e-16) << c;
        ASSERT_NEAR(cosine_of(c), static_cast<double>(std::cos(turn)), 5e-16) << c;
    }
}

// ---- the motions

struct Case {
    std::string name;
    ExcitationSpec e;
    RealizationHeader r;
};

Case made(ExcitationKind kind, double frequency, const std::string& name)
{
    Case c;
    c.name = name + " " + std::to_string(frequency) + " Hz";
    c.e.kind = kind;
    c.r.frequency_hz = frequency;
    c.r.pga_m_s2 = 3.5;
    c.r.step_s = 5e-4 / std::max(frequency, 0.2);
    return c;
}

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const double f : {0.3, 1.0, 4.7}) {
        all.push_back(made(ExcitationKind::ricker, f, "ricker"));
        for (const double gamma : {1.0, 1.0001, 1.7, 3.0, 8.4})
            for (const double nu : {0.0, 1.1, -1.5707963267948966, 5.0}) {
                all.push_back(made(ExcitationKind::pulse, f, "pulse, gamma " + std::to_string(gamma)));
                all.back().r.pulse_gamma = gamma;
                all.back().r.phase_rad = nu;
            }
        for (const double ramp : {1.0, 2.0, 3.3})
            for (const double phase : {0.0, 0.7, -2.0}) {
                all.push_back(made(ExcitationKind::tapered, f, "tapered, ramp " + std::to_string(ramp)));
                all.back().e.ramp_cycles = ramp;
                all.back().e.cycles = 7.3;
                all.back().r.phase_rad = phase;
            }
    }
    for (const Spacing spacing : {Spacing::linear, Spacing::log})
        for (const bool up : {true, false}) {
            ExcitationSpec e;
            e.from_hz = up ? 0.7 : 6;
            e.to_hz = up ? 6 : 0.7;
            all.push_back(made(ExcitationKind::sweep, e.central_frequency_hz(), up ? "sweep up" : "sweep down"));
            all.back().e = e;
            all.back().e.kind = ExcitationKind::sweep;
            all.back().e.spacing = spacing;
            all.back().e.duration_s = 11;
            all.back().r.step_s = 1e-4;
        }
    return all;
}

/// The whole table of a motion, as the loop asks for it.
std::vector<double> table_of(const BaseMotion& motion, double step)
{
    std::vector<double> table;
    for (double first = 0; first * step < motion.duration_s() + 70 * step; first += chunk_steps) {
        std::vector<double> chunk(chunk_steps);
        motion.fill(first, chunk.data(), 1);
        table.insert(table.end(), chunk.begin(), chunk.end());
    }
    return table;
}

TEST(Synthetic, TableIsTheSecondDifferenceOfTheDisplacement)
{
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const BaseMotion motion(c.e, c.r, nullptr);
        const std::vector<double> table = table_of(motion, c.r.step_s);
        for (std::size_t n = 0; n < table.size(); n += 7) {
            const double t = static_cast<double>(n);
            const auto u = [&](double step) { return motion.displacement_m(step * c.r.step_s); };
            ASSERT_NEAR(table[n], u(t + 1) - 2 * u(t) + u(t - 1), 4e-15 * (1 + std::fabs(u(t)))) << n;
        }
    }
}

TEST(Synthetic, PeakOfTheAccelerationIsThePga)
{
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        // by the displacement's second differences, which know nothing of the formula of the acceleration
        const BaseMotion motion(c.e, c.r, nullptr);
        const double dt2 = c.r.step_s * c.r.step_s;
        double peak = 0;
        for (const double value : table_of(motion, c.r.step_s))
            peak = std::max(peak, std::fabs(value) / dt2);
        EXPECT_NEAR(peak, 3.5, 3e-5 * 3.5);
    }
}

TEST(Synthetic, StartsAndEndsAtRest)
{
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const BaseMotion motion(c.e, c.r, nullptr);
        const double h = 1e-4 * motion.duration_s(), end = motion.duration_s();
        EXPECT_EQ(motion.displacement_m(0), 0);
        EXPECT_EQ(motion.displacement_m(-1), 0);
        EXPECT_EQ(motion.displacement_m(end + 9), motion.displacement_m(end));
        double largest = 0;
        for (double t = 0; t <= end; t += 37 * h)
            largest = std::max(largest, std::fabs(motion.displacement_m(t)));
        // a motion that leaves with a velocity would move by v h, one at rest with acceleration 0 by less than a' h3 /
        // 6
        const double jerk = 4 * 2 * std::numbers::pi * c.r.frequency_hz * 10 * c.r.pga_m_s2;
        EXPECT_LT(std::fabs(motion.displacement_m(h)), jerk * h * h * h + 1e-15 * largest);
        EXPECT_LT(std::fabs(motion.displacement_m(end) - motion.displacement_m(end - h)),
                  jerk * h * h * h + 1e-14 * largest);
        // all but the velocity pulse come back to where they were
        if (c.e.kind != ExcitationKind::pulse) {
            EXPECT_LT(std::fabs(motion.displacement_m(end)), 1e-13 * largest);
        }
        // what has driven the structure adds up to no velocity
        double sum = 0;
        for (const double value : table_of(motion, c.r.step_s))
            sum += value;
        EXPECT_LT(std::fabs(sum), 1e-13 * std::max(1.0, largest));
    }
}

TEST(Synthetic, BitsDependOnTheStepOnly)
{
    for (const Case& c : cases()) {
        const BaseMotion motion(c.e, c.r, nullptr);
        std::vector<double> alone(chunk_steps), later(chunk_steps), wide(chunk_steps * 8, -7);
        motion.fill(128, alone.data(), 1);
        motion.fill(192, later.data(), 1);
        motion.fill(128, wide.data() + 3, 8);
        const BaseMotion again(c.e, c.r, nullptr);
        std::vector<double> other(chunk_steps);
        again.fill(192, other.data(), 1); // the second chunk without the first
        for (std::size_t k = 0; k < chunk_steps; ++k) {
            ASSERT_EQ(wide[8 * k + 3], alone[k]) << c.name;
            ASSERT_EQ(wide[8 * k + 2], -7) << c.name;
            ASSERT_EQ(other[k], later[k]) << c.name;
        }
    }
}

// ---- against the papers' formulas

/// Integral by Simpson's rule.
Real quadrature(const std::function<Real(Real)>& f, Real from, Real to, int parts)
{
    const Real h = (to - from) / (2 * parts);
    Real sum = f(from) + f(to);
    for (int i = 1; i < 2 * parts; ++i)
        sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
    return sum * h / 3;
}

TEST(Ricker, IsTheWaveletOfThePaper)
{
    const Case c = made(ExcitationKind::ricker, 1.6, "ricker");
    const SyntheticMotion motion(c.e, c.r);
    const Real t0 = 2 / 1.6L;
    EXPECT_DOUBLE_EQ(motion.duration_s(), 2.5);
    const auto a = [&](Real t) {
        const Real q = (pi * 1.6L * (t - t0)) * (pi * 1.6L * (t - t0));
        return 3.5L * (1 - 2 * q) * std::exp(-q);
    };
    for (double t = 0.01; t < 2.49; t += 0.0371) {
        EXPECT_NEAR(motion.acceleration_m_s2(t), static_cast<double>(a(t)), 1e-14);
        const Real u = quadrature([&](Real s) { return (t - s) * a(s); }, 0, t, 2000);
        EXPECT_NEAR(motion.displacement_m(t), static_cast<double>(u), 1e-13) << t;
    }
    EXPECT_DOUBLE_EQ(motion.acceleration_m_s2(1.25), 3.5);
}

TEST(VelocityPulse, IsThatOfMavroeidisAndPapageorgiou)
{
    const Real f = 1.3L;
    for (const double gamma : {1.0, 1.0000001, 1.5, 2.0, 3.7})
        for (const double nu : {0.0, 0.9, -1.5707963267948966, 2.8}) {
            const VelocityPulse pulse{1.3, nu / (2 * std::numbers::pi), gamma};
            const Real half = gamma / (2 * f);
            const auto v = [&](Real t) {
                const Real s = t - half;
                return (1 + std::cos(2 * pi * f * s / gamma)) * std::cos(2 * pi * f * s + nu) / 2;
            };
            const double duration = pulse.duration_s();
            EXPECT_NEAR(duration, static_cast<double>(2 * half), 1e-15);
            for (double t = 0; t <= duration; t += duration / 23) {
                EXPECT_NEAR(pulse.displacement(t), static_cast<double>(quadrature(v, 0, t, 1000)), 1e-11)
                    << gamma << ' ' << nu << ' ' << t;
                const Real h = 1e-5L;
                EXPECT_NEAR(pulse.acceleration(t), static_cast<double>((v(t + h) - v(t - h)) / (2 * h)), 1e-7)
                    << gamma << ' ' << nu << ' ' << t;
            }
            // the paper's final displacement, cos(nu) sin(pi gamma) / (2 pi f (1 - gamma2)) for a unit amplitude
            if (gamma > 1.01) {
                const Real last = std::cos(static_cast<Real>(nu)) * std::sin(pi * gamma) /
                                  (2 * pi * f * (1 - static_cast<Real>(gamma) * gamma));
                EXPECT_NEAR(pulse.displacement(duration), static_cast<double>(last), 1e-15) << gamma << ' ' << nu;
            }
        }
}

TEST(VelocityPulse, ItsPhaseIsDrawnIntoTheRealization)
{
    Case c = made(ExcitationKind::pulse, 1, "pulse");
    c.r.pulse_gamma = 2;
    const SyntheticMotion cosine(c.e, c.r);
    c.r.phase_rad = std::numbers::pi;
    const SyntheticMotion turned(c.e, c.r);
    for (double t = 0.1; t < 2; t += 0.1)
        EXPECT_NEAR(turned.displacement_m(t), -cosine.displacement_m(t), 1e-15);
}

TEST(TaperedSine, AccelerationIsTheTaperTimesTheSine)
{
    const double f = 2.2;
    for (const double ramp : {1.0, 2.0, 2.7})
        for (const double phase : {0.0, 0.21, 0.5}) {
            const double cycles = 9.3;
            const TaperedSine sine(f, cycles, ramp, phase);
            const auto a = [&](Real t) {
                const Real c = f * t, edge = std::min(c, cycles - c);
                const Real w = edge < ramp ? (1 - std::cos(pi * edge / ramp)) / 2 : 1;
                return w * std::sin(2 * pi * (c + phase));
            };
            double largest_rest = 0;
            for (double t = 0; t <= sine.duration_s(); t += 0.1573) {
                const double rest = sine.rest().acceleration(f * t);
                ASSERT_NEAR(sine.acceleration(t) + rest, static_cast<double>(a(t)), 1e-13);
                largest_rest = std::max(largest_rest, std::fabs(rest));
                const Real moved = quadrature([&](Real s) { return (t - s) * a(s); }, 0, t, 4000);
                const double correction = sine.rest().displacement(f * t) / (f * f);
                ASSERT_NEAR(sine.displacement(t) + correction, static_cast<double>(moved), 2e-8) << t;
            }
            // the polynomial that brings it to rest is small beside the sine
            EXPECT_LT(largest_rest, ramp == 1 ? 0.035 : 0.006) << ramp << ' ' << phase;
        }
}

TEST(TaperedSine, DoesNotOvershootInItsRamp)
{
    // of the ramped displacement: 11 % for a ramp of one cycle, 1.7 % for two
    for (const double ramp : {1.0, 2.0}) {
        const TaperedSine sine(1, 10, ramp, 0);
        double in_ramp = 0;
        for (double c = 0; c < ramp; c += 0.001)
            in_ramp = std::max(in_ramp, std::fabs(sine.acceleration(c)));
        EXPECT_LT(in_ramp, 1 + (ramp == 1 ? 0.03 : 0.005));
    }
}

TEST(SineSweep, GoesThroughItsFrequencies)
{
    for (const Spacing spacing : {Spacing::linear, Spacing::log})
        for (const bool up : {true, false}) {
            const double from = up ? 0.5 : 8, to = up ? 8 : 0.5, duration = 40;
            const SineSweep sweep(from, to, spacing, duration, 2);
            const auto frequency = [&](double t) {
                return spacing == Spacing::log ? from * std::pow(to / from, t / duration)
                                               : from + (to - from) * t / duration;
            };
            EXPECT_NEAR(sweep.cycles(),
                        static_cast<double>(
                            quadrature([&](Real t) { return frequency(static_cast<double>(t)); }, 0, duration, 2000)),
                        1e-9);
            // by the distance of two upward crossings of the acceleration
            std::vector<double> crossings;
            const double h = 1e-4;
            for (double t = h; t < duration - h; t += h) {
                const double a = sweep.acceleration(t), b = sweep.acceleration(t + h);
                if (a < 0 && b >= 0)
                    crossings.push_back(t + h * a / (a - b));
            }
            ASSERT_NEAR(static_cast<double>(crossings.size()), sweep.cycles(), 1.5);
            double worst = 0, lowest = 1e9, highest = 0;
            for (std::size_t i = 4; i + 5 < crossings.size(); ++i) { // between the ramps
                const double got = 1 / (crossings[i + 1] - crossings[i]);
                const double want = frequency((crossings[i + 1] + crossings[i]) / 2);
                worst = std::max(worst, std::fabs(got / want - 1));
                lowest = std::min(lowest, got);
                highest = std::max(highest, got);
            }
            EXPECT_LT(worst, spacing == Spacing::log ? 0.004 : 0.02);
            EXPECT_LT(lowest, spacing == Spacing::log ? 1 : 2);
            EXPECT_GT(highest, 6.5);
        }
}

TEST(SineSweep, AccelerationIsTheDisplacementsAndNearlyConstant)
{
    for (const Spacing spacing : {Spacing::linear, Spacing::log}) {
        const SineSweep sweep(0.5, 10, spacing, 60, 2);
        const double h = 2e-5;
        double peak = 0, least_peak = 10, in_cycle = 0, last = 0;
        for (double t = 0.01; t < 59.9; t += 0.00107) {
            const double a = sweep.acceleration(t);
            const double second =
                (sweep.displacement(t + h) - 2 * sweep.displacement(t) + sweep.displacement(t - h)) / (h * h);
            ASSERT_NEAR(a, second, 1e-4);
            peak = std::max(peak, std::fabs(a));
            // the peak of every half cycle on the plateau
            if (a * last < 0) {
                if (t > 5 && t < 59.5)
                    least_peak = std::min(least_peak, in_cycle);
                in_cycle = 0;
            }
            in_cycle = std::max(in_cycle, std::fabs(a));
            last = a;
        }
        EXPECT_LT(peak, 1.02); // the ramp of two cycles overshoots by 2.0 % at most
        EXPECT_GT(least_peak, 0.99);
    }
}

TEST(SineSweep, StretchesWithTheFrequencyOfTheRealization)
{
    Case c = made(ExcitationKind::sweep, 0, "sweep");
    c.e.from_hz = 1;
    c.e.to_hz = 4;
    c.e.duration_s = 20;
    c.r.frequency_hz = 2; // the central one
    const SyntheticMotion plain(c.e, c.r);
    EXPECT_EQ(plain.duration_s(), 20);
    c.r.frequency_hz = 6;
    const SyntheticMotion squeezed(c.e, c.r);
    EXPECT_DOUBLE_EQ(squeezed.duration_s(), 20.0 / 3);
    for (double t = 0.1; t < 20; t += 0.37)
        EXPECT_NEAR(squeezed.acceleration_m_s2(t / 3), plain.acceleration_m_s2(t), 1e-10);
}

TEST(RestPolynomial, EndsWhereItIsToldTo)
{
    const RestPolynomial p(3, 0.7, -1.2, 4);
    const double h = 1e-4;
    EXPECT_EQ(p.displacement(0), 0);
    EXPECT_NEAR(p.displacement(3), 0.7, 1e-14);
    EXPECT_NEAR((p.displacement(3 + h) - p.displacement(3 - h)) / (2 * h), -1.2, 1e-6);
    EXPECT_NEAR((p.displacement(3 + h) - 2 * p.displacement(3) + p.displacement(3 - h)) / (h * h), 4, 1e-5);
    EXPECT_NEAR(p.acceleration(3), 4, 1e-12);
    EXPECT_EQ(p.acceleration(0), 0);
    EXPECT_NEAR((p.displacement(1 + h) - 2 * p.displacement(1) + p.displacement(1 - h)) / (h * h), p.acceleration(1),
                1e-5);
}

} // namespace
} // namespace stylobate::test_synthetic
