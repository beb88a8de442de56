/// From a record to a motion and its measures, against closed forms, a Runge-Kutta solution, and the measures that
/// NumPy gave for real records (`summary.csv` beside them, whose README.md states how each was computed).

#include "ensemble/model/input_error.hpp"
#include "io/records/ground_motion.hpp"
#include "tests/io/store/csv_line.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace stylobate {
namespace {

constexpr double pi = std::numbers::pi;

Record record_of(const std::function<double(double)>& a, double dt, std::size_t n)
{
    Record record;
    record.file = "made";
    record.component = "one";
    record.dt_s = dt;
    for (std::size_t i = 0; i < n; ++i)
        record.acceleration_m_s2.push_back(a(dt * static_cast<double>(i)));
    return record;
}

double peak(const std::vector<double>& values)
{
    double largest = 0;
    for (const double value : values)
        largest = std::max(largest, std::fabs(value));
    return largest;
}

// ---- integration

TEST(Integration, OfALinearAccelerationIsExact)
{
    // a = 2 - 3 t
    const Motion m = make_motion(record_of([](double t) { return 2 - 3 * t; }, 0.01, 301), false);
    for (std::size_t i = 0; i < 301; ++i) {
        const double t = 0.01 * static_cast<double>(i);
        ASSERT_NEAR(m.velocity_m_s[i], 2 * t - 1.5 * t * t, 1e-12);
        ASSERT_NEAR(m.displacement_m[i], t * t - 0.5 * t * t * t, 1e-12);
    }
    EXPECT_EQ(m.pga_m_s2, 7);
    EXPECT_DOUBLE_EQ(m.duration_s(), 3);
    EXPECT_EQ(m.source, "made, one");
}

TEST(Integration, OfASineIsOfSecondOrder)
{
    const double w = 2 * pi * 1.5;
    const auto error = [w](double dt) {
        const auto n = static_cast<std::size_t>(std::lround(4 / dt)) + 1;
        const Motion m = make_motion(record_of([w](double t) { return std::sin(w * t); }, dt, n), false);
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double t = dt * static_cast<double>(i);
            largest = std::max(largest, std::fabs(m.displacement_m[i] - (t / w - std::sin(w * t) / (w * w))));
        }
        return largest;
    };
    EXPECT_LT(error(0.01), 4 / w * (w * 0.01) * (w * 0.01) / 8);
    EXPECT_NEAR(error(0.02) / error(0.01), 4, 0.1);
}

/// The corrected motion too is linear between its samples: each step is checked by itself.
void expect_consistent(const Motion& m)
{
    const double d = m.dt_s;
    const std::vector<double>&a = m.acceleration_m_s2, &v = m.velocity_m_s, &u = m.displacement_m;
    ASSERT_EQ(v.size(), a.size());
    ASSERT_EQ(u.size(), a.size());
    EXPECT_EQ(v[0], 0);
    EXPECT_EQ(u[0], 0);
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
        ASSERT_NEAR(v[i + 1] - v[i], d * (a[i] + a[i + 1]) / 2, 1e-12);
        ASSERT_NEAR(u[i + 1] - u[i], v[i] * d + d * d * (a[i] / 3 + a[i + 1] / 6), 1e-12);
    }
}

void expect_rest_at_both_ends(const Motion& m)
{
    EXPECT_EQ(m.acceleration_m_s2.front(), 0);
    EXPECT_EQ(m.acceleration_m_s2.back(), 0);
    EXPECT_LT(std::fabs(m.velocity_m_s.back()), 1e-12 * peak(m.velocity_m_s));
    EXPECT_LT(std::fabs(m.displacement_m.back()), 1e-11 * peak(m.displacement_m));
}

// ---- baseline

/// A burst with no net velocity or displacement, at rest for a while on both sides: what a perfect record holds.
double burst(double t)
{
    const double s = t - 15;
    const double q = (pi * 1.2 * s) * (pi * 1.2 * s);
    return 3 * (1 - 2 * q) * std::exp(-q) + 2 * std::exp(-s * s / 8) * std::sin(2 * pi * 4 * s);
}

TEST(Baseline, LeavesAGoodRecordAlone)
{
    const Record record = record_of(burst, 0.005, 6001);
    const Motion raw = make_motion(record, false), m = make_motion(record, true);
    expect_consistent(m);
    expect_rest_at_both_ends(m);
    for (std::size_t i = 0; i < 6001; ++i) {
        ASSERT_NEAR(m.acceleration_m_s2[i], raw.acceleration_m_s2[i], 1e-3 * raw.pga_m_s2);
        // the polynomial also takes what little a pulse of velocity has in common with it
        ASSERT_NEAR(m.displacement_m[i], raw.displacement_m[i], 0.08 * peak(raw.displacement_m));
    }
    EXPECT_EQ(m.predominant_frequency_hz, raw.predominant_frequency_hz);
}

TEST(Baseline, TakesOutADriftThatWasPutIn)
{
    const Motion good = make_motion(record_of(burst, 0.005, 6001), true);
    // an offset, a slope, a bend and a swing of the zero line: metres of displacement at the end
    const auto drifting = [](double t) {
        return burst(t) + 0.05 + 0.004 * t - 0.0003 * t * t + 4e-5 * t * (t - 15) * (t - 30);
    };
    const Record record = record_of(drifting, 0.005, 6001);
    const Motion raw = make_motion(record, false), m = make_motion(record, true);
    EXPECT_GT(std::fabs(raw.displacement_m.back()), 5);
    expect_consistent(m);
    expect_rest_at_both_ends(m);
    // what is left of it comes from the tapered ends
    const double left = 0.02 * peak(good.displacement_m) + 0.01;
    for (std::size_t i = 0; i < 6001; ++i)
        ASSERT_NEAR(m.displacement_m[i], good.displacement_m[i], left);
    EXPECT_NEAR(m.pga_m_s2, good.pga_m_s2, 0.005 * good.pga_m_s2);
}

TEST(Baseline, RestAtBothEndsWhateverTheLength)
{
    for (const std::size_t n : {fewest_samples, fewest_samples + 1, std::size_t{37}, std::size_t{1000}}) {
        const Motion m = make_motion(record_of([](double t) { return std::sin(9 * t) + 0.3; }, 0.02, n), true);
        expect_consistent(m);
        expect_rest_at_both_ends(m);
        EXPECT_GT(m.pga_m_s2, 0);
    }
}

TEST(Baseline, ScalesWithTheRecord)
{
    Record record = record_of(burst, 0.01, 3001);
    const Motion once = make_motion(record, true);
    for (double& a : record.acceleration_m_s2)
        a *= -4; // exact in binary
    const Motion scaled = make_motion(record, true);
    for (std::size_t i = 0; i < 3001; ++i)
        ASSERT_EQ(scaled.displacement_m[i], -4 * once.displacement_m[i]);
    EXPECT_EQ(scaled.predominant_frequency_hz, once.predominant_frequency_hz);
}

TEST(Baseline, ReportsWhatItHasDone)
{
    const auto drifting = [](double t) { return burst(t) + 0.05; };
    const Record record = record_of(drifting, 0.005, 6001); // 30 s
    const BaselineReport good = make_motion(record_of(burst, 0.005, 6001), true).baseline;
    const BaselineReport raw = make_motion(record, false).baseline, r = make_motion(record, true).baseline;
    // the offset alone: 0.05 x 30 m/s, 0.05 x 900 / 2 m; the burst adds nothing to speak of
    EXPECT_NEAR(r.residual_velocity_before_m_s, 1.5, 1e-6);
    EXPECT_NEAR(r.residual_displacement_before_m, 22.5, 1e-5);
    EXPECT_LT(std::fabs(r.residual_velocity_m_s), 1e-12);
    EXPECT_LT(std::fabs(r.residual_displacement_m), 1e-11);
    EXPECT_EQ(raw.residual_velocity_m_s, r.residual_velocity_before_m_s);
    EXPECT_EQ(raw.pga_change(), 0);
    EXPECT_EQ(r.pga_before_m_s2, peak(record.acceleration_m_s2));
    EXPECT_NEAR(r.pga_change(), good.pga_m_s2 / (good.pga_before_m_s2 + 0.05) - 1, 2e-3);
    const Motion m = make_motion(record, true);
    EXPECT_EQ(r.pgv_m_s, peak(m.velocity_m_s));
    EXPECT_EQ(r.pgd_m, peak(m.displacement_m));
    EXPECT_TRUE(m.corrected);
    EXPECT_FALSE(m.band_pass);
    // what is at rest at both ends loses next to nothing
    EXPECT_LT(std::fabs(good.pga_change()), 1e-3);
    EXPECT_LT(std::fabs(good.residual_velocity_before_m_s), 1e-6);
}

// ---- filter

/// Gain of a digital Butterworth prototype from its poles: |1 / product of (i x - p_k)|.
double from_poles(double x)
{
    std::complex<double> product = 1;
    for (int k = 0; k < 4; ++k)
        product *= std::complex<double>(0, x) - std::polar(1.0, pi * (2.0 * k + 5) / 8);
    return 1 / std::abs(product);
}

TEST(BandPass, GainIsThatOfButterworthsPoles)
{
    const BandPass corners{0.2, 20};
    for (const double f : {0.01, 0.1, 0.2, 0.3, 2.0, 15.0, 20.0, 40.0, 90.0})
        EXPECT_NEAR(band_pass_gain(f, corners), from_poles(0.2 / f) * from_poles(f / 20), 1e-12) << f;
    EXPECT_NEAR(band_pass_gain(0.2, corners), std::sqrt(0.5), 1e-9);
    EXPECT_EQ(band_pass_gain(0, corners), 0);
}

TEST(BandPass, SinesPassWithTheirGainAndWithoutDelay)
{
    const BandPass corners{0.5, 10};
    const double dt = 0.01;
    for (const double f : {0.25, 0.4, 0.5, 0.7, 2.0, 8.0, 10.0, 14.0, 25.0}) {
        // a packet of which the band is narrow
        const auto packet = [f](double t) {
            return std::exp(-(t - 60) * (t - 60) / 450) * std::cos(2 * pi * f * (t - 60));
        };
        std::vector<double> a = record_of(packet, dt, 12001).acceleration_m_s2;
        band_pass(a, dt, corners);
        const double gain = from_poles(0.5 / f) * from_poles(f / 10);
        EXPECT_NEAR(a[6000], gain, 0.012 * gain + 1e-4) << f; // of the packet's width: 1.1 % at 0.25 Hz
        for (std::size_t i = 0; i < 6000; i += 10)
            ASSERT_NEAR(a[6000 + i], a[6000 - i], 1e-10) << f; // symmetrical: no phase
    }
}

TEST(BandPass, PaddingKeepsTheEndsApart)
{
    // an impulse near the end rings there and not at the start
    std::vector<double> a(1000);
    a[990] = 1;
    band_pass(a, 0.01, {1, 20});
    double first = 0;
    for (std::size_t i = 0; i < 100; ++i)
        first = std::max(first, std::fabs(a[i]));
    EXPECT_LT(first, 1e-4 * peak(a));
}

TEST(BandPass, IsAPartOfTheCorrectionWhereItIsAskedFor)
{
    // a swing of the zero line that the polynomial cannot follow: 1 cycle in 7.5 s
    const auto swinging = [](double t) { return burst(t) + 0.08 * std::sin(2 * pi * t / 7.5) * std::sin(pi * t / 30); };
    const Record record = record_of(swinging, 0.005, 6001);
    const Motion good = make_motion(record_of(burst, 0.005, 6001), true);
    const Motion plain = make_motion(record, true), filtered = make_motion(record, true, BandPass{0.3, 40});
    expect_consistent(filtered);
    expect_rest_at_both_ends(filtered);
    ASSERT_TRUE(filtered.band_pass);
    EXPECT_EQ(filtered.band_pass->low_hz, 0.3);
    const auto away = [&](const Motion& m) {
        double largest = 0;
        for (std::size_t i = 0; i < 6001; ++i)
            largest = std::max(largest, std::fabs(m.displacement_m[i] - good.displacement_m[i]));
        return largest;
    };
    EXPECT_GT(away(plain), 0.08);
    EXPECT_LT(away(filtered), 0.2 * away(plain));
    EXPECT_NEAR(filtered.pga_m_s2, good.pga_m_s2, 0.03 * good.pga_m_s2);
    // the record must be able to carry the high corner
    EXPECT_THROW(make_motion(record, true, BandPass{0.3, 100}), InputError);
}

TEST(Motion, NothingToShakeWithIsRefused)
{
    EXPECT_THROW(make_motion(record_of(burst, 0.01, fewest_samples - 1), false), InputError);
    EXPECT_THROW(make_motion(record_of([](double) { return 0; }, 0.01, 100), false), InputError);
    EXPECT_THROW(make_motion(record_of([](double) { return 0.7; }, 0.01, 100), true), InputError);
    EXPECT_NO_THROW(make_motion(record_of([](double) { return 0.7; }, 0.01, 100), false));
}

// ---- measures

TEST(Intensity, AriasAndItsDurationOfAnExponential)
{
    // a = exp(-t): the integral of a2 up to t is (1 - exp(-2 t)) / 2
    const Record record = record_of([](double t) { return std::exp(-t); }, 0.002, 6001); // 12 s: complete to 4e-11
    const IntensityMeasures im = intensity_measures(record);
    EXPECT_NEAR(im.arias_m_s, pi / (2 * 9.80665) * 0.5, 1e-6);
    EXPECT_NEAR(im.d5_95_s, (std::log(20.0) - std::log(1 / 0.95)) / 2, 1e-5);
    EXPECT_EQ(im.pga_m_s2, 1);
}

TEST(Intensity, MeasuresOfAHarmonic)
{
    // 20 cycles of a sin(w t): CAV 4 a / w a cycle, Arias pi / (2 g) a2 / 2 of the duration, and 90 % of it in 90 %
    const double a = 2.5, f = 1.6, w = 2 * pi * f, duration = 20 / f;
    const Record record = record_of([&](double t) { return a * std::sin(w * t); }, duration / 20000, 20001);
    const IntensityMeasures im = intensity_measures(record);
    EXPECT_NEAR(im.pga_m_s2, a, 1e-6);
    EXPECT_NEAR(im.cav_m_s, 20 * 4 * a / w, 1e-4);
    EXPECT_NEAR(im.arias_m_s, pi / (2 * 9.80665) * a * a / 2 * duration, 1e-6);
    EXPECT_NEAR(im.d5_95_s, 0.9 * duration, 0.01);
    EXPECT_NEAR(im.predominant_frequency_hz, f, 0.02 * f);
    EXPECT_NEAR(im.mean_frequency_hz, f, 2e-4);
    EXPECT_EQ(im.pgv_per_pga_s, im.pgv_m_s / im.pga_m_s2);
}

TEST(Intensity, MeasuresOfAHalfSineAndABoxcar)
{
    // between zeros. Half a sine of length T: CAV 2 a T / pi, Arias a2 T / 2; a box: CAV a T, Arias a2 T, 90 % in 0.9 T
    const double a = 3, T = 0.4, dt = 1e-4;
    const auto inside = [&](double t) { return t >= 2 && t <= 2 + T; };
    const IntensityMeasures half = intensity_measures(
        record_of([&](double t) { return inside(t) ? a * std::sin(pi * (t - 2) / T) : 0; }, dt, 50001));
    EXPECT_NEAR(half.pga_m_s2, a, 1e-6);
    EXPECT_NEAR(half.cav_m_s, 2 * a * T / pi, 1e-6);
    EXPECT_NEAR(half.arias_m_s, pi / (2 * 9.80665) * a * a * T / 2, 1e-6);
    const IntensityMeasures box =
        intensity_measures(record_of([&](double t) { return inside(t) ? -a : 0; }, dt, 50001));
    EXPECT_NEAR(box.cav_m_s, a * T, 2 * a * dt);
    EXPECT_NEAR(box.arias_m_s, pi / (2 * 9.80665) * a * a * T, 1e-3);
    EXPECT_NEAR(box.d5_95_s, 0.9 * T, 2 * dt);
}

TEST(Intensity, AbsoluteVelocityCountsBothSigns)
{
    // samples +1, -1, +1, ... make triangles: a quarter of the time at |a| between 0 and 1, so 1/2 on the average
    const Record record = record_of([](double t) { return std::lround(t / 0.01) % 2 == 0 ? 1.0 : -1.0; }, 0.01, 1001);
    EXPECT_NEAR(intensity_measures(record).cav_m_s, 5, 1e-9);
}

TEST(Intensity, OfABlockThatRocks)
{
    IntensityMeasures im;
    im.pga_m_s2 = 4.905;
    im.pgv_m_s = 0.6;
    im.predominant_frequency_hz = 1.5;
    // a column of 1 x 4 m: p = 1.889156 rad/s, tan alpha = 0.25
    const RockingMeasures m = rocking_measures(im, 0.5, 2, 9.81);
    EXPECT_EQ(m.tan_alpha, 0.25);
    EXPECT_NEAR(m.p_rad_s, 1.889156352, 1e-9);
    EXPECT_NEAR(m.pga_over_g_tan_alpha, 2, 1e-12);
    EXPECT_NEAR(m.p_pgv_over_g_tan_alpha, 1.889156352 * 0.6 / 2.4525, 1e-9);
    EXPECT_NEAR(m.omega_p_over_p, 2 * pi * 1.5 / 1.889156352, 1e-8);
}

TEST(Intensity, AriasGrowsWithTheSquare)
{
    Record record = record_of(burst, 0.01, 3001);
    const double once = intensity_measures(record).arias_m_s;
    for (double& a : record.acceleration_m_s2)
        a *= 3;
    EXPECT_NEAR(intensity_measures(record).arias_m_s, 9 * once, 1e-12 * once);
}

TEST(Intensity, VelocityAndDisplacementOfARampedSine)
{
    // a long sine that comes and goes slowly: v = a / w, u = a / w2
    const double w = 2 * pi * 2;
    const auto envelope = [](double t) { return std::exp(-(t - 20) * (t - 20) / 18); };
    const IntensityMeasures im =
        intensity_measures(record_of([&](double t) { return 1.7 * envelope(t) * std::sin(w * t); }, 0.005, 8001));
    EXPECT_NEAR(im.pga_m_s2, 1.7, 0.002 * 1.7);
    EXPECT_NEAR(im.pgv_m_s, 1.7 / w, 0.003 * 1.7 / w);
    EXPECT_NEAR(im.pgd_m, 1.7 / (w * w), 0.006 * 1.7 / (w * w));
}

TEST(Fourier, PeakOfASineIsItsFrequency)
{
    for (const double f : {0.3, 0.97, 2.5, 7.77, 19.1})
        for (const std::size_t n : {4000u, 4096u, 4097u, 5003u}) { // a power of two, and not
            const Record record = record_of(
                [f](double t) { return 0.4 + std::sin(pi * t / 25) * std::sin(2 * pi * f * t + 0.3); }, 0.005, n);
            EXPECT_NEAR(predominant_frequency(record.acceleration_m_s2, 0.005), f, 0.01 * f) << n;
            EXPECT_NEAR(intensity_measures(record).mean_frequency_hz, f, 0.04 * f) << n;
        }
    EXPECT_EQ(predominant_frequency(std::vector<double>(100, 2.5), 0.01), 0);
}

TEST(Fourier, StrongerOfTwoSinesWins)
{
    const auto two = [](double low, double high) {
        return record_of([=](double t) { return low * std::sin(2 * pi * 0.8 * t) + high * std::sin(2 * pi * 5 * t); },
                         0.01, 4000);
    };
    // smoothing spreads a line over a band in proportion to its frequency, so the amplitudes weigh as a / f
    EXPECT_NEAR(predominant_frequency(two(1, 3).acceleration_m_s2, 0.01), 0.8, 0.01);
    EXPECT_NEAR(predominant_frequency(two(1, 12).acceleration_m_s2, 0.01), 5, 0.05);
}

/// The mean frequency by the plain sums of the definition.
TEST(Fourier, MeanFrequencyIsThatOfTheDefinition)
{
    for (const std::size_t n : {601u, 640u, 997u}) {
        const Record record = record_of(burst, 0.04, n);
        const std::vector<double>& a = record.acceleration_m_s2;
        const double mean = std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(n);
        double squares = 0, periods = 0;
        for (std::size_t k = 1; k <= n / 2; ++k) {
            const double f = static_cast<double>(k) / (0.04 * static_cast<double>(n));
            double c = 0, s = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const double angle = 2 * pi * static_cast<double>(i * k % n) / static_cast<double>(n);
                c += (a[i] - mean) * std::cos(angle);
                s += (a[i] - mean) * std::sin(angle);
            }
            if (f >= 0.25 && f <= 20) {
                squares += c * c + s * s;
                periods += (c * c + s * s) / f;
            }
        }
        EXPECT_NEAR(intensity_measures(record).mean_frequency_hz, squares / periods, 1e-9) << n;
    }
}

// ---- response spectrum

TEST(ResponseSpectrum, OfASineIsTheClosedForm)
{
    // u'' + 2 z w u' + w2 u = -sin(W t), from rest; resonant, above, below and far below
    const double W = 2 * pi * 1.25, z = 0.05, duration = 24;
    const Record record = record_of([W](double t) { return std::sin(W * t); }, 0.001, 24001); // 30 whole cycles
    for (const double period : {0.8, 0.4, 1.7, 0.05}) {
        const double w = 2 * pi / period, wd = w * std::sqrt(1 - z * z);
        const double p = w * w - W * W, q = 2 * z * w * W, denominator = p * p + q * q;
        // steady part S sin + C cos, and the free vibration that makes it start at rest
        const double S = -p / denominator, C = q / denominator;
        const double A = -C, B = (z * w * A - S * W) / wd;
        double largest = 0;
        for (double t = 0; t <= duration; t += 0.0005)
            largest =
                std::max(largest, std::fabs(S * std::sin(W * t) + C * std::cos(W * t) +
                                            std::exp(-z * w * t) * (A * std::cos(wd * t) + B * std::sin(wd * t))));
        EXPECT_NEAR(spectral_acceleration(record, {period})[0], w * w * largest, 5e-4 * w * w * largest) << period;
    }
    // at resonance 1 / (2 z) times the PGA once it has built up
    EXPECT_NEAR(spectral_acceleration(record, {0.8})[0], 10 * (1 - std::exp(-z * W * duration)), 0.03);
}

TEST(ResponseSpectrum, StiffAndSoftLimits)
{
    const Record record = record_of(burst, 0.01, 3001);
    const double pga = peak(record.acceleration_m_s2);
    EXPECT_EQ(spectral_acceleration(record, {0})[0], pga);
    EXPECT_NEAR(spectral_acceleration(record, {0.002})[0], pga, 0.01 * pga);
    // a soft oscillator stays where it is: u is minus the ground's displacement
    const double w = 2 * pi / 300;
    const double pgd = peak(make_motion(record, false).displacement_m);
    EXPECT_NEAR(spectral_acceleration(record, {300}, 0)[0] / (w * w), pgd, 0.03 * pgd);
}

TEST(ResponseSpectrum, FreeVibrationAfterAShockCounts)
{
    // half a sine of duration 0.2 s, no damping: the peak comes after it, (2 r / |1 - r2|) cos(pi / (2 r))
    const Record record = record_of([](double t) { return std::sin(pi * t / 0.2); }, 0.002, 101);
    for (const double period : {0.7, 1.5, 6.0}) {
        const double r = period / 0.4, want = 2 * r / (r * r - 1) * std::cos(pi / (2 * r));
        EXPECT_NEAR(spectral_acceleration(record, {period}, 0)[0], want, 3e-4 * want) << period;
    }
}

/// Any record, samples far apart: fourth-order Runge-Kutta in a thousand parts of each interval.
TEST(ResponseSpectrum, AgreesWithRungeKuttaOnRaggedSamples)
{
    const Record record = record_of([](double t) { return std::sin(37 * t * t) + std::cos(11 * t); }, 0.05, 80);
    const std::vector<double>& a = record.acceleration_m_s2;
    for (const double period : {0.11, 0.6, 2.5})
        for (const double z : {0.0, 0.05, 0.4}) {
            const double w = 2 * pi / period;
            double u = 0, v = 0, largest = 0;
            constexpr int parts = 1000;
            const double h = 0.05 / parts;
            const auto end = static_cast<std::size_t>(80 + period / 2 / 0.05 + 1);
            for (std::size_t i = 0; i + 1 < end; ++i)
                for (int j = 0; j < parts; ++j) {
                    const double a0 = i + 1 < a.size() ? a[i] : 0, a1 = i + 1 < a.size() ? a[i + 1] : 0;
                    const auto force = [&](double x, double y, double part) {
                        return -(a0 + (a1 - a0) * (j + part) / parts) - 2 * z * w * y - w * w * x;
                    };
                    const double k1 = force(u, v, 0), k2 = force(u + h / 2 * v, v + h / 2 * k1, 0.5),
                                 k3 = force(u + h / 2 * v + h * h / 4 * k1, v + h / 2 * k2, 0.5),
                                 k4 = force(u + h * v + h * h / 2 * k2, v + h * k3, 1);
                    u += h * v + h * h / 6 * (k1 + k2 + k3);
                    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
                    largest = std::max(largest, std::fabs(u));
                }
            const double want = w * w * largest;
            EXPECT_NEAR(spectral_acceleration(record, {period}, z)[0], want, 2e-4 * want) << period << ' ' << z;
        }
}

// ---- measured records

struct Row {
    std::string file;
    std::size_t component = 0; ///< rows of one file come in the order of its components
    std::size_t n = 0;
    double dt_s = 0, duration_s = 0, pga_m_s2 = 0, d5_95_s = 0, predominant_hz = 0, mean_hz = 0;
};

std::filesystem::path records_folder()
{
    return std::filesystem::path(STYLOBATE_DATA_DIR) / "records";
}

/// The AT2 and text files; the other formats have readers of their own.
std::vector<Row> summary()
{
    std::ifstream in(records_folder() / "summary.csv");
    std::vector<Row> rows;
    std::map<std::string, std::size_t> components;
    std::string line;
    for (std::getline(in, line); std::getline(in, line);) {
        const auto cells = cells_of(line);
        if (!cells[0].starts_with("at2/") && !cells[0].starts_with("text/"))
            continue;
        rows.push_back({cells[0], components[cells[0]]++, std::stoul(cells[2]), std::stod(cells[3]),
                        std::stod(cells[4]), std::stod(cells[5]), std::stod(cells[7]), std::stod(cells[8]),
                        std::stod(cells[11])});
    }
    return rows;
}

Record read_row(const Row& row)
{
    std::string unit = "m/s2";
    if (row.file.starts_with("at2/"))
        unit = "";
    else if (row.file == "text/sct190985.txt")
        unit = "g";
    else if (row.file.find("20140203") != std::string::npos)
        unit = "cm/s2";
    return read_records(records_folder() / row.file, unit).at(row.component);
}

class MeasuredRecords : public ::testing::Test {
protected:
    void SetUp() override
    {
        if (!std::filesystem::exists(records_folder() / "summary.csv"))
            GTEST_SKIP() << "no measured records in " << records_folder();
    }
};

TEST_F(MeasuredRecords, MeasuresAreThoseOfTheSummary)
{
    const auto rows = summary();
    EXPECT_GE(rows.size(), 30u);
    for (const Row& row : rows) {
        SCOPED_TRACE(row.file + " " + std::to_string(row.component));
        const Record record = read_row(row);
        ASSERT_EQ(record.acceleration_m_s2.size(), row.n);
        EXPECT_EQ(record.dt_s, row.dt_s);
        EXPECT_NEAR(record.dt_s * static_cast<double>(row.n - 1), row.duration_s, 0.01 * row.duration_s);
        const IntensityMeasures im = intensity_measures(record);
        EXPECT_NEAR(im.pga_m_s2, row.pga_m_s2, 1e-3 * row.pga_m_s2);
        EXPECT_NEAR(im.d5_95_s, row.d5_95_s, 0.01 * row.d5_95_s);
        // The table gives two decimals, which at these frequencies is up to 1.9 % (0.27 Hz). Without this allowance
        // one component, the E-W one of sct190985.txt, would be 1.2 % off: 0.4940 Hz against "0.50".
        constexpr double rounding = 0.005;
        EXPECT_NEAR(im.predominant_frequency_hz, row.predominant_hz, 0.01 * row.predominant_hz + rounding);
        EXPECT_NEAR(im.mean_frequency_hz, row.mean_hz, 0.005 * row.mean_hz + rounding);
    }
}

TEST_F(MeasuredRecords, CorrectionEndsAtRestAndKeepsThePga)
{
    for (const Row& row : summary()) {
        SCOPED_TRACE(row.file + " " + std::to_string(row.component));
        const Record record = read_row(row);
        const Motion m = make_motion(record, true);
        expect_consistent(m);
        expect_rest_at_both_ends(m);
        // Spitak.dat is cut at both ends while the ground moves: it begins with 4 % of its PGA and ends, 18 s later,
        // with 6 %, and as it stands leaves with 0.6 m/s. Its mean is 1.7 % of the PGA below zero, and at the time of
        // the peak, which is positive, the polynomial takes out as much again.
        const double allowed = row.file == "text/Spitak.dat" ? 0.04 : 0.002;
        EXPECT_NEAR(m.pga_m_s2, peak(record.acceleration_m_s2), allowed * m.pga_m_s2);
        // With a filter the polynomial has little left to do: half of Spitak's change goes.
        if (row.file == "text/Spitak.dat") {
            EXPECT_NEAR(m.baseline.pga_change(), 0.035, 0.002);
            EXPECT_NEAR(make_motion(record, true, BandPass{0.05, 24}).baseline.pga_change(), 0.016, 0.002);
        }
        // the ground did not go further than strong earthquakes take it
        EXPECT_LT(peak(m.displacement_m), 1.0);
    }
}

} // namespace
} // namespace stylobate
