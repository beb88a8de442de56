// Base motion against its formulas in extended precision, and along a record against exact integration.

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/synthetic_sine.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "kernels/base_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace stylobate::test_base_motion {
namespace {

const long double pi = std::numbers::pi_v<long double>;

/// One lane's parameters, with the formulas once more.
struct Drive {
    MotionFormula formula = MotionFormula::harmonic;
    double rate = 1e-3;     ///< cycles per step
    double amplitude = 0.1; ///< [m]
    double cycles = 10;
    double phase = 0; ///< cycles
    bool abrupt_start = false, abrupt_end = false;
    double ramp = 2; ///< cycles

    static long double ramp_of(long double x)
    {
        const long double t = std::clamp(x, 0.0L, 1.0L);
        return t * t * t * (10 + t * (6 * t - 15));
    }
    /// sin(2 pi c), with the whole cycles taken off first
    static long double sine(long double c) { return std::sin(2 * pi * (c - std::nearbyint(c))); }

    /// U at a time in cycles [m].
    long double exact(long double c) const
    {
        if (formula == MotionFormula::still || c <= 0)
            return 0;
        if (formula == MotionFormula::pulse) {
            const long double end = cycles;
            if (c <= end)
                return amplitude * (2 * pi * c - sine(c));
            return amplitude * (2 * pi * end - sine(end) + 2 * pi * (1 - std::cos(2 * pi * end)) * (c - end));
        }
        const long double t = std::min(c, static_cast<long double>(cycles));
        const long double start = abrupt_start ? 1 : ramp_of(t / ramp);
        const long double end = abrupt_end ? 1 : ramp_of((cycles - t) / ramp);
        return amplitude * start * end * (sine(t + phase) - (abrupt_start ? sine(phase) : 0));
    }

    /// Calls with the kernel's parameters.
    template <class Call>
    auto with(Call call) const
    {
        double r = rate, a = amplitude, c = cycles, p = phase;
        double offset = abrupt_start && formula == MotionFormula::harmonic ? static_cast<double>(sine(phase)) : 0;
        double start = abrupt_start ? 1e300 : 1 / ramp, end = abrupt_end ? 1e300 : 1 / ramp;
        double velocity = std::fmod(cycles, 1) == 0.5 ? 2 : 0;
        return call(FormulaParameters{&r, &a, &c, &p, &offset, &start, &end, &velocity});
    }
    double displacement(double n) const
    {
        return with([&](const FormulaParameters& p) { return base_displacement<double>(formula, p, n); });
    }
    /// Second differences of `chunk_steps` steps.
    std::vector<double> table(double first) const
    {
        std::vector<double> values(chunk_steps);
        with([&](const FormulaParameters& p) {
            fill_base_table<double>(formula, p, &first, values.data());
            return 0;
        });
        return values;
    }
};

std::vector<Drive> drives()
{
    std::vector<Drive> all;
    for (double rate : {1e-3, 7.3e-4, 1.0 / 64, 0.0137})
        for (double amplitude : {0.1, 2.7e-4}) {
            for (double phase : {0.0, 0.25, -0.37})
                for (int edges = 0; edges < 4; ++edges)
                    all.push_back({MotionFormula::harmonic, rate, amplitude, 10, phase, (edges & 1) != 0,
                                   (edges & 2) != 0, edges == 0 ? 2.0 : 0.5});
            for (double cycles : {0.5, 1.0})
                all.push_back({MotionFormula::pulse, rate, amplitude, cycles});
        }
    return all;
}

TEST(BaseMotion, NothingBeforeItStarts)
{
    for (const Drive& d : drives())
        for (double n : {0.0, -1.0, -1000.0})
            ASSERT_EQ(d.displacement(n), 0) << static_cast<int>(d.formula) << ' ' << d.phase << ' ' << d.abrupt_start;
}

TEST(BaseMotion, DisplacementIsTheFormula)
{
    double worst = 0;
    for (const Drive& d : drives())
        for (double n = 1; n * d.rate < 1.3 * d.cycles; n += 7) {
            const long double want = d.exact(static_cast<long double>(n) * d.rate);
            const double scale = d.formula == MotionFormula::pulse ? 2 * std::numbers::pi * d.amplitude : d.amplitude;
            worst = std::max(worst, static_cast<double>(std::fabs(d.displacement(n) - want)) / scale);
        }
    // 10 cycles are known to 1e-15, and a ramp of half a cycle rises by 3.75 in one
    EXPECT_LT(worst, 8e-15);
}

TEST(BaseMotion, TableIsTheSecondDifference)
{
    for (const Drive& d : drives())
        for (double first = 0; first * d.rate < 1.2 * d.cycles; first += 192) {
            const std::vector<double> table = d.table(first);
            for (int k = 0; k < chunk_steps; ++k) {
                const long double n = static_cast<long double>(first) + k;
                const long double want =
                    d.exact((n + 1) * d.rate) - 2 * d.exact(n * d.rate) + d.exact((n - 1) * d.rate);
                const double scale =
                    d.formula == MotionFormula::pulse ? 4 * std::numbers::pi * d.amplitude * d.cycles : d.amplitude;
                ASSERT_NEAR(table[static_cast<std::size_t>(k)], static_cast<double>(want), 2e-14 * scale)
                    << "step " << first + k << " of " << d.cycles / d.rate;
            }
        }
}

TEST(BaseMotion, LatePhasesKeepTheirDigits)
{
    // 1e8 steps: the phase itself is 1e5 cycles, and is known to 1e-16 of one
    Drive d{MotionFormula::harmonic, 1.0371e-3, 0.1, 1e6, 0.2};
    for (double n : {1e6, 1e7 + 3, 1e8 + 7, 3e8 + 1})
        for (int k = 0; k < 100; ++k) {
            const double at = n + k;
            // the exact product needs more than extended precision: its whole cycles are taken off in parts
            const long double high = std::nearbyint(at * d.rate);
            const auto rest = static_cast<long double>(std::fma(at, d.rate, -static_cast<double>(high)));
            const long double want = d.amplitude * Drive::sine(rest + d.phase);
            ASSERT_NEAR(d.displacement(at), static_cast<double>(want), 3e-16 * d.amplitude * 4) << at;
        }
}

TEST(BaseMotion, StillIsStill)
{
    const Drive d{MotionFormula::still};
    EXPECT_EQ(d.displacement(100), 0);
    for (double value : d.table(0))
        ASSERT_EQ(value, 0);
}

TEST(BaseMotion, NothingAfterItEnds)
{
    // an abrupt end holds the last displacement, a smooth one comes back to zero, a pulse leaves at constant velocity
    for (const Drive& d : drives()) {
        const double over = std::ceil(d.cycles / d.rate) + 2;
        for (double value : d.table(over))
            ASSERT_EQ(value, 0);
        if (d.formula == MotionFormula::harmonic && !d.abrupt_end) {
            ASSERT_EQ(d.displacement(over), 0);
        }
    }
}

/// Peak acceleration over A w2 while the ramp lasts, at phase 0 and at the phase at which it is largest: values of the
/// closed form of the second derivative, maximized over time and phase outside of this program; the motion of a phase
/// half a cycle later has the opposite sign.
TEST(BaseMotion, SmoothStartOvershoots)
{
    struct Case {
        double ramp, at_zero, worst_phase, worst; ///< phase in cycles
    };
    for (const Case& c : {Case{0.5, 1.585378, 0.4333, 1.613729}, Case{1, 1.112157, 0.4383, 1.120532},
                          Case{2, 1.017513, 0.4398, 1.019693}, Case{3, 1.005911, 0.4472, 1.006512}}) {
        const auto peak = [&](double phase) {
            const Drive d{MotionFormula::harmonic, 2.5e-4, 1, 10, phase, false, false, c.ramp};
            double largest = 0;
            for (double first = 0; first * d.rate < c.ramp + 1; first += chunk_steps)
                for (double value : d.table(first))
                    largest = std::max(largest, std::fabs(value));
            const double w = 2 * std::numbers::pi * d.rate;
            return largest / (w * w);
        };
        // second differences and the largest of steps are too small by the order of the square of a step
        EXPECT_NEAR(peak(0), c.at_zero, 4e-6) << c.ramp;
        EXPECT_NEAR(peak(c.worst_phase), c.worst, 4e-6) << c.ramp;
        for (int i = 0; i < 25; ++i)
            EXPECT_LT(peak(i / 50.0), c.worst + 1e-6) << c.ramp << ' ' << i;
        EXPECT_NEAR(ramp_overshoot(c.ramp), c.worst, 6e-7) << c.ramp;
    }
}

TEST(BaseMotion, PulseHasASineOfAcceleration)
{
    for (double cycles : {0.5, 1.0}) {
        const Drive d{MotionFormula::pulse, 1e-3, 0.05, cycles};
        const double w = 2 * std::numbers::pi * d.rate; // per step
        double velocity = 0;
        for (double first = 0; first * d.rate < cycles + 0.2; first += chunk_steps) {
            const std::vector<double> table = d.table(first);
            for (int k = 0; k < chunk_steps; ++k) {
                const double c = (first + k) * d.rate;
                const double want = c < cycles ? d.amplitude * w * w * std::sin(2 * std::numbers::pi * c) : 0;
                // where the sine begins and ends its bend is felt within a step
                const double bend = c == 0 || std::fabs(c - cycles) < d.rate ? d.amplitude * w * w * w / 6 : 0;
                ASSERT_NEAR(table[static_cast<std::size_t>(k)], want, 2e-5 * d.amplitude * w * w + 1.001 * bend);
                velocity += table[static_cast<std::size_t>(k)];
            }
        }
        // 2 a / w after half a sine, none after a full one
        EXPECT_NEAR(velocity, cycles == 0.5 ? 2 * d.amplitude * w : 0, 1e-12);
        const double far = 3 / d.rate;
        EXPECT_NEAR(d.displacement(far + 1) - d.displacement(far), cycles == 0.5 ? 2 * d.amplitude * w : 0, 1e-14);
    }
}

// ---- the ensemble's side --------------------------------------------------------------------------------------------

Realization shaken(double frequency, double pga, double step)
{
    Realization r;
    r.frequency_hz = frequency;
    r.pga_m_s2 = pga;
    r.step_s = step;
    return r;
}

/// Second differences as the ensemble makes them of a formula.
std::vector<double> formula_table(const BaseMotion& motion, ExcitationKind kind, double first)
{
    double v[8] = {};
    const FormulaParameters p{&v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]};
    motion.store(p, 0);
    std::vector<double> table(chunk_steps);
    fill_base_table<double>(BaseMotion::formula(kind), p, &first, table.data());
    return table;
}

TEST(BaseMotion, FormulasTakeTheirParametersFromTheStudy)
{
    for (ExcitationKind kind : {ExcitationKind::harmonic, ExcitationKind::half_sine, ExcitationKind::full_sine})
        for (HarmonicEdge edge : {HarmonicEdge::smooth, HarmonicEdge::abrupt}) {
            ExcitationSpec e;
            e.kind = kind;
            e.start = edge;
            Realization r = shaken(2.5, 3, 1e-4);
            r.phase_rad = 5; // more than half a turn
            const BaseMotion motion(e, r, nullptr);
            const double cycles = kind == ExcitationKind::harmonic ? 10 : kind == ExcitationKind::half_sine ? 0.5 : 1;
            EXPECT_DOUBLE_EQ(motion.duration_s(), cycles / 2.5);
            EXPECT_EQ(motion.displacement_m(0), 0);
            EXPECT_EQ(motion.displacement_m(-1), 0);
            double peak = 0;
            for (double first = 0; first < 4e4; first += chunk_steps) {
                const std::vector<double> table = formula_table(motion, kind, first);
                for (int k = 0; k < chunk_steps; ++k) {
                    const double n = first + k;
                    const double want = motion.displacement_m((n + 1) * r.step_s) -
                                        2 * motion.displacement_m(n * r.step_s) +
                                        motion.displacement_m((n - 1) * r.step_s);
                    ASSERT_NEAR(table[static_cast<std::size_t>(k)], want, 1e-14);
                    // an abrupt start from a phase has a velocity at once: left out of the peak
                    if (n > 0 && n < 1.5e4)
                        peak = std::max(peak, std::fabs(table[static_cast<std::size_t>(k)]) / (1e-4 * 1e-4));
                }
            }
            EXPECT_NEAR(peak, 3, kind == ExcitationKind::harmonic && edge == HarmonicEdge::smooth ? 0.12 : 1e-4);
        }
}

/// A record with the integrals that its definition asks for, in extended precision.
struct TestRecord {
    Motion motion;
    std::vector<long double> velocity, displacement;

    TestRecord(double dt, std::size_t count, std::uint64_t seed)
    {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> normal;
        std::vector<double>& a = motion.acceleration_m_s2;
        a.push_back(0);
        for (std::size_t i = 1; i + 1 < count; ++i)
            a.push_back(0.6 * a.back() + normal(engine));
        a.push_back(0);
        velocity = displacement = {0};
        const long double d = dt;
        for (std::size_t i = 1; i < count; ++i) {
            displacement.push_back(displacement.back() + velocity.back() * d +
                                   d * d * (2 * a[i - 1] + static_cast<long double>(a[i])) / 6);
            velocity.push_back(velocity.back() + d * (static_cast<long double>(a[i - 1]) + a[i]) / 2);
        }
        motion.dt_s = dt;
        for (std::size_t i = 0; i < count; ++i) {
            motion.velocity_m_s.push_back(static_cast<double>(velocity[i]));
            motion.displacement_m.push_back(static_cast<double>(displacement[i]));
            motion.pga_m_s2 = std::max(motion.pga_m_s2, std::fabs(a[i]));
        }
        motion.predominant_frequency_hz = 2;
    }

    /// U at a time of the record [m].
    long double exact(long double t) const
    {
        if (t <= 0)
            return 0;
        const std::vector<double>& a = motion.acceleration_m_s2;
        const long double d = motion.dt_s;
        const std::size_t i = std::min(static_cast<std::size_t>(t / d), a.size() - 1);
        const long double s = t - static_cast<long double>(i) * d;
        long double u = displacement[i] + velocity[i] * s + a[i] * s * s / 2;
        if (i + 1 < a.size())
            u += (static_cast<long double>(a[i + 1]) - a[i]) * s * s * s / (6 * d);
        return u;
    }
};

ExcitationSpec along_record()
{
    ExcitationSpec e;
    e.kind = ExcitationKind::record;
    return e;
}

/// Largest deviation of the table from the second difference of the exact displacement, over dt2 x PGA.
double table_error(const TestRecord& record, double frequency, double pga, double step)
{
    const BaseMotion motion(along_record(), shaken(frequency, pga, step), &record.motion);
    const long double stretch = record.motion.predominant_frequency_hz / static_cast<long double>(frequency);
    const long double scale =
        (pga > 0 ? pga / static_cast<long double>(record.motion.pga_m_s2) : 1) * stretch * stretch;
    const double reached = pga > 0 ? pga : record.motion.pga_m_s2;
    double worst = 0;
    for (double first = 0; first * step < motion.duration_s() + 100 * step; first += chunk_steps) {
        std::vector<double> table(chunk_steps);
        motion.fill(first, table.data(), 1);
        for (int k = 0; k < chunk_steps; ++k) {
            const long double t = (static_cast<long double>(first) + k) * step / stretch, d = step / stretch;
            const long double want = scale * (record.exact(t + d) - 2 * record.exact(t) + record.exact(t - d));
            worst = std::max(worst, static_cast<double>(std::fabs(table[static_cast<std::size_t>(k)] - want)));
        }
    }
    return worst / (step * step * reached);
}

TEST(BaseMotion, RecordTableIsTheSecondDifferenceOfTheExactIntegral)
{
    const TestRecord record(0.005, 400, 1);
    for (double step : {1e-5, 1e-4, 1.7e-4, 5e-4, 1.2345e-3, 2.4e-3})
        EXPECT_LT(table_error(record, 2, 0, step), 1e-8) << step;
}

TEST(BaseMotion, RecordInStepsLongerThanHalfASample)
{
    const TestRecord record(0.005, 400, 2);
    for (double step : {0.0026, 0.004, 0.005, 0.0073, 0.02})
        EXPECT_LT(table_error(record, 2, 0, step), 1e-8) << step;
}

TEST(BaseMotion, RecordIsStretchedAndScaled)
{
    const TestRecord record(0.01, 300, 3);
    for (double frequency : {0.5, 2.0, 7.0})
        for (double pga : {0.0, 1.0, 9.0}) {
            EXPECT_LT(table_error(record, frequency, pga, 1.3e-4), 1e-8) << frequency << " Hz, " << pga;
            const BaseMotion motion(along_record(), shaken(frequency, pga, 1.3e-4), &record.motion);
            EXPECT_NEAR(motion.duration_s(), 2.99 * 2 / frequency, 1e-12);
            const long double stretch = 2 / static_cast<long double>(frequency);
            const double scale = pga > 0 ? pga / record.motion.pga_m_s2 : 1;
            for (double t : {0.0, 0.0017, 0.33, 0.5, 0.777})
                EXPECT_NEAR(motion.displacement_m(t),
                            static_cast<double>(scale * stretch * stretch * record.exact(t / stretch)),
                            1e-14 * scale * static_cast<double>(stretch * stretch));
        }
}

TEST(BaseMotion, RecordIsLaidIntoItsLane)
{
    const TestRecord record(0.005, 50, 4);
    const BaseMotion motion(along_record(), shaken(2, 0, 1e-4), &record.motion);
    std::vector<double> alone(chunk_steps), wide(chunk_steps * 4, -7);
    motion.fill(64, alone.data(), 1);
    motion.fill(64, wide.data() + 2, 4);
    for (std::size_t k = 0; k < chunk_steps; ++k) {
        EXPECT_EQ(wide[4 * k + 2], alone[k]);
        EXPECT_EQ(wide[4 * k], -7);
        EXPECT_EQ(wide[4 * k + 1], -7);
        if (4 * k + 3 < wide.size()) {
            EXPECT_EQ(wide[4 * k + 3], -7);
        }
    }
}

TEST(BaseMotion, RecordIsOverAfterItsEnd)
{
    const TestRecord record(0.005, 50, 5);
    const BaseMotion motion(along_record(), shaken(2, 0, 1e-4), &record.motion);
    std::vector<double> table(chunk_steps, 1);
    motion.fill(51 * 50, table.data(), 1);
    for (double value : table)
        EXPECT_EQ(value, 0);
}

/// A block of 1 x 4 m: half the diagonal is sqrt(17) / 2 = 2.0615528 m, p = sqrt(3 x 9.81 / (4 R)) = 1.88915635 rad/s.
TEST(TailAfterShaking, ByHand)
{
    Realization r;
    r.blocks.resize(2);
    r.blocks[0].fixed = true;
    r.blocks[1].half_width_m = 0.5;
    r.blocks[1].half_height_m = r.blocks[1].y_m = 2;
    r.blocks[1].mass_kg = 1;
    r.joints.resize(1);
    r.joints[0].upper = 1;
    EXPECT_NEAR(tail_after_shaking(scales_of(r)), 12 / 1.88915635, 1e-6);
    EXPECT_NEAR(longest_tail(scales_of(r)), 240 / 1.88915635, 2e-5);
    ExcitationSpec excitation;
    excitation.kind = ExcitationKind::half_sine;
    EXPECT_EQ(tail_s(excitation, scales_of(r)), tail_after_shaking(scales_of(r)));
    excitation.tail_s = 3;
    EXPECT_EQ(tail_s(excitation, scales_of(r)), 3);
    excitation.kind = ExcitationKind::none;
    EXPECT_EQ(tail_s(excitation, scales_of(r)), 0);
}

} // namespace
} // namespace stylobate::test_base_motion
