/// Synthetic earthquakes: spectrum, envelope, independence, peak and rest; all with fixed seeds, false-alarm rates
/// stated. And the way of a drawn shaking from the study to the loop.

#include "ensemble/experiment.hpp"
#include "ensemble/motion/synthetic_noise.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace stylobate::test_synthetic_noise {
namespace {

constexpr double pi = std::numbers::pi;

ExcitationSpec noise(double rise, double strong, double decay)
{
    ExcitationSpec e;
    e.kind = ExcitationKind::noise;
    e.rise_s = rise;
    e.strong_s = strong;
    e.decay_s = decay;
    return e;
}

double peak(const std::vector<double>& values)
{
    double largest = 0;
    for (const double value : values)
        largest = std::max(largest, std::fabs(value));
    return largest;
}

/// Clough and Penzien's power over that of the white noise; with no low cut Kanai and Tajimi's.
double power(double f, double ground, double z_g, double cut, double z_f)
{
    const double x = f / ground, y = f / cut;
    const double kanai_tajimi = (1 + 4 * z_g * z_g * x * x) / ((1 - x * x) * (1 - x * x) + 4 * z_g * z_g * x * x);
    return kanai_tajimi * std::pow(y, 4) / ((1 - y * y) * (1 - y * y) + 4 * z_f * z_f * y * y);
}

/// One-sided power of samples a[first .. first + count - 1] at a frequency, with a Hann window.
double periodogram(const std::vector<double>& a, std::size_t first, std::size_t count, double f, double dt)
{
    // Goertzel's recursion
    const double turn = 2 * pi * f * dt, c = 2 * std::cos(turn);
    double s1 = 0, s2 = 0, weight = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double w = 0.5 - 0.5 * std::cos(2 * pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
        weight += w * w;
        const double s0 = w * a[first + i] + c * s1 - s2;
        s2 = s1;
        s1 = s0;
    }
    return 2 * dt * (s1 * s1 + s2 * s2 - c * s1 * s2) / weight;
}

TEST(Noise, SpectrumIsThatOfCloughAndPenzien)
{
    // 150 motions x 11 frequencies in a band, of which a Hann window leaves about 5 independent: the mean of a band has
    // a relative standard deviation of 1 / sqrt(150 x 5) = 3.7 %. 14 bands within 4.5 of them: a false alarm in 1e4.
    ExcitationSpec e = noise(1, 20.48, 0.5);
    constexpr std::uint64_t motions = 150;
    for (const double z_g : {0.6, 0.3}) {
        e.ground_damping_ratio = z_g;
        const double ground = 2;
        const SyntheticNoise made(e, ground);
        ASSERT_EQ(made.dt_s(), 0.005);
        constexpr std::size_t count = 4096, first = 200; // the strong phase
        const std::vector<double> bands = {0.2, 0.5, 1, 2, 3, 5, 10};
        std::vector<double> got(bands.size());
        for (std::uint64_t i = 0; i < motions; ++i) {
            const std::vector<double> a = made.acceleration(11, i, Stream::base_noise);
            for (std::size_t b = 0; b < bands.size(); ++b)
                for (int k = -5; k <= 5; ++k)
                    got[b] += periodogram(a, first, count, bands[b] + k / (count * 0.005), 0.005) / (11.0 * motions);
        }
        for (std::size_t b = 0; b < bands.size(); ++b) {
            double want = 0;
            for (int k = -5; k <= 5; ++k) {
                const double f = bands[b] + k / (count * 0.005), x = pi * f * 0.005;
                // white noise of unit variance a sample has the one-sided power 2 d, and is linear between samples
                want += 2 * 0.005 * power(f, ground, z_g, ground * 0.1, 0.6) * std::pow(std::sin(x) / x, 4) / 11;
            }
            EXPECT_NEAR(got[b], want, 4.5 * 0.037 * want) << bands[b] << " Hz, " << z_g;
        }
    }
}

TEST(Noise, EnvelopeSwellsAndFades)
{
    // mean square over windows of 0.5 s and 600 motions: about 600 x 5 independent values, a relative standard
    // deviation of 2.6 %; 8 windows within 4.5 of them and 3 % for the lag of the filters: a false alarm in 1e4
    const ExcitationSpec e = noise(4, 6, 3);
    const SyntheticNoise made(e, 5);
    const double d = made.dt_s();
    const std::vector<double> starts = {1, 2, 3, 5, 7, 9, 11, 14, 17};
    std::vector<double> square(starts.size());
    constexpr std::uint64_t motions = 600;
    for (std::uint64_t i = 0; i < motions; ++i) {
        const std::vector<double> a = made.acceleration(3, i, Stream::base_noise);
        for (std::size_t w = 0; w < starts.size(); ++w)
            for (double t = starts[w]; t < starts[w] + 0.5; t += d) {
                const double value = a[static_cast<std::size_t>(std::lround(t / d))];
                square[w] += value * value;
            }
    }
    const double strong = (square[3] + square[4] + square[5]) / 3;
    for (std::size_t w = 0; w < starts.size(); ++w) {
        double want = 0; // the mean of the squared envelope, by the definition
        for (double t = starts[w] + 0.05; t < starts[w] + 0.5; t += 0.1) {
            const double envelope = t < 4 ? t * t / 16 : t < 10 ? 1 : std::exp(-(t - 10) / 3);
            want += envelope * envelope / 5;
        }
        EXPECT_NEAR(square[w] / strong, want, (4.5 * 0.026 + 0.03) * want + 0.003) << starts[w];
        EXPECT_NEAR(made.envelope(starts[w] + 0.25),
                    starts[w] + 0.25 < 4    ? std::pow((starts[w] + 0.25) / 4, 2)
                    : starts[w] + 0.25 < 10 ? 1
                                            : std::exp(-(starts[w] + 0.25 - 10) / 3),
                    1e-15);
    }
    EXPECT_NEAR(made.duration_s(), 25, 2 * d);
}

TEST(Noise, MotionsAreIndependent)
{
    // correlation over the strong phase of neighbours in the index: its standard deviation is 1 / sqrt(2 B T); measured
    // among far apart ones it is 0.08 here. 200 pairs: the mean within 4 of 0.08 / sqrt(200), none above 5.5.
    const SyntheticNoise made(noise(1, 10, 1), 2.5);
    const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b) {
        double ab = 0, aa = 0, bb = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            ab += a[i] * b[i];
            aa += a[i] * a[i];
            bb += b[i] * b[i];
        }
        return ab / std::sqrt(aa * bb);
    };
    double sum = 0, squares = 0, largest = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const double r = correlation(made.acceleration(1, i, Stream::base_noise),
                                     i % 2 == 0 ? made.acceleration(1, i + 1, Stream::base_noise)
                                                : made.acceleration(2, i, Stream::base_noise));
        sum += r;
        squares += r * r;
        largest = std::max(largest, std::fabs(r));
    }
    EXPECT_LT(std::fabs(sum / 200), 4 * 0.08 / std::sqrt(200.0));
    EXPECT_NEAR(std::sqrt(squares / 200), 0.08, 0.02);
    EXPECT_LT(largest, 5.5 * 0.08);
    EXPECT_NE(made.acceleration(1, 0, Stream::base_noise), made.acceleration(1, 0, Stream::mean_peak));
    EXPECT_EQ(made.acceleration(1, 7, Stream::base_noise), made.acceleration(1, 7, Stream::base_noise));
}

TEST(Noise, StartsAndEndsAtRest)
{
    for (const double f : {0.4, 2.5, 9.0})
        for (std::uint64_t i = 0; i < 5; ++i) {
            const SyntheticNoise made(noise(1, 4, 1.5), f);
            const Motion m = made.motion_of_peak(5, i, 4);
            EXPECT_NEAR(m.pga_m_s2, 4, 1e-14);
            EXPECT_EQ(m.acceleration_m_s2.front(), 0);
            EXPECT_EQ(m.acceleration_m_s2.back(), 0);
            EXPECT_LT(std::fabs(m.velocity_m_s.back()), 1e-12 * peak(m.velocity_m_s));
            EXPECT_LT(std::fabs(m.displacement_m.back()), 1e-11 * peak(m.displacement_m));
            // exact integrals of an acceleration that is linear between its samples
            const double d = m.dt_s;
            for (std::size_t k = 0; k + 1 < m.acceleration_m_s2.size(); k += 17) {
                const double a = m.acceleration_m_s2[k], b = m.acceleration_m_s2[k + 1];
                ASSERT_NEAR(m.velocity_m_s[k + 1] - m.velocity_m_s[k], d * (a + b) / 2, 1e-14);
                ASSERT_NEAR(m.displacement_m[k + 1] - m.displacement_m[k],
                            m.velocity_m_s[k] * d + d * d * (a / 3 + b / 6), 1e-14);
            }
        }
}

// ---- from the study

const std::string structure = R"(
[structure]
blocks = 4
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.0855
[contact]
normal_stiffness_n_m2 = 1e7
friction = 0.68
)";

Study study_of(const std::string& excitation, const std::string& more = {})
{
    return parse_study("[study]\nkind = \"single\"\nrealizations = 400\n" + structure + "[excitation]\n" + excitation +
                           "\n" + more,
                       "made.toml");
}

const std::string short_noise = "kind = \"noise\"\nfrequency_hz = 4\npga_m_s2 = 2\nrise_s = 0.5\nstrong_s = 2\n"
                                "decay_s = 0.3\n";

TEST(Shaking, PgaIsEachRealizationsOrTheMean)
{
    const Experiment each_experiment(study_of(short_noise));
    const Sampler& each = each_experiment.sampler();
    const Experiment mean_experiment(study_of(short_noise + "pga_of = \"mean\"\n"));
    const Sampler& mean = mean_experiment.sampler();
    double sum = 0, squares = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const Realization one = each.realization(i), other = mean.realization(i);
        EXPECT_NEAR(one.motion->pga_m_s2, 2, 1e-14);
        EXPECT_EQ(one.pga_m_s2, 2);
        EXPECT_EQ(other.pga_m_s2, 2);
        sum += other.motion->pga_m_s2;
        squares += other.motion->pga_m_s2 * other.motion->pga_m_s2;
        // the same motion but for its scale
        const double scale = other.motion->pga_m_s2 / 2;
        for (std::size_t k = 0; k < one.motion->acceleration_m_s2.size(); k += 50)
            ASSERT_NEAR(other.motion->acceleration_m_s2[k], scale * one.motion->acceleration_m_s2[k], 1e-13);
    }
    // both means, of 400 here and of 128 in the scale, have a standard error of cov / sqrt(n): 4 of the sum of them,
    // a false alarm in 15,000
    const double cov = std::sqrt(squares / 400 - sum * sum / 160000) / (sum / 400);
    EXPECT_GT(cov, 0.05);
    EXPECT_LT(cov, 0.3);
    EXPECT_NEAR(sum / 400, 2, 4 * 2 * cov * std::sqrt(1.0 / 400 + 1.0 / 128));
}

TEST(Shaking, NoiseIsAPureFunctionOfSeedAndIndex)
{
    const Study study = study_of(short_noise);
    const Sampler sampler(study, nullptr);
    std::vector<std::vector<double>> want;
    for (std::uint64_t i = 0; i < 12; ++i)
        want.push_back(sampler.realization(i).motion->acceleration_m_s2);
    for (std::uint64_t i = 1; i < 12; ++i)
        EXPECT_NE(want[i], want[i - 1]);
    // backwards, and from four threads at once
    std::vector<std::thread> threads;
    std::vector<int> same(4);
    for (std::size_t k = 0; k < 4; ++k)
        threads.emplace_back([&, k] {
            for (std::uint64_t i = 12; i-- > 0;)
                same[k] += sampler.realization(i).motion->acceleration_m_s2 == want[i] ? 1 : 0;
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(same, std::vector<int>(4, 12));
    Study other = study;
    other.seed = 2;
    EXPECT_NE(Sampler(other, nullptr).realization(0).motion->acceleration_m_s2, want[0]);
}

TEST(Shaking, SurfaceAxesAreTheGroundsFrequencyAndThePga)
{
    const Study study = parse_study("[study]\nkind = \"surface\"\nrealizations = 3\n" + structure +
                                        "[excitation]\nkind = \"noise\"\npga_of = \"mean\"\nrise_s = 0.5\n"
                                        "strong_s = 1\ndecay_s = 0.2\n[surface]\n"
                                        "frequency_hz = { from = 1, to = 8, count = 2 }\n"
                                        "pga_m_s2 = { from = 1, to = 3, count = 3 }\n",
                                    "made.toml");
    const Sampler sampler(study, nullptr);
    for (std::uint64_t i = 0; i < study.total(); ++i) {
        const Realization r = sampler.realization(i);
        EXPECT_EQ(r.frequency_hz, i < 9 ? 1 : 8);
        EXPECT_EQ(r.pga_m_s2, 1 + static_cast<double>(i / 3 % 3));
        const SyntheticNoise made(study.excitation, r.frequency_hz);
        EXPECT_EQ(r.motion->acceleration_m_s2,
                  made.motion(study.seed, i, r.pga_m_s2 / made.mean_peak(study.seed)).acceleration_m_s2);
    }
}

TEST(Shaking, PulsesAreDrawn)
{
    const Study study = study_of("kind = \"pulse\"\nfrequency_hz = 2\npga_m_s2 = 3\ngamma = 1.6\nphase_rad = 0.3\n",
                                 "[perturbation]\npulse_frequency = { distribution = \"lognormal\", sigma_ln = 0.3 }\n"
                                 "pulse_gamma = { distribution = \"normal\", sd = 0.4, min = 1, max = 3 }\n"
                                 "phase = { distribution = \"uniform\" }\n");
    const Sampler sampler(study, nullptr);
    EXPECT_EQ(sampler.input_names(), (std::vector<std::string>{"phase", "pulse_frequency", "pulse_gamma"}));
    double ln_f = 0;
    std::set<double> gammas;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const Realization r = sampler.realization(i);
        EXPECT_EQ(r.inputs, (std::vector<double>{r.phase_rad, r.frequency_hz, r.pulse_gamma}));
        EXPECT_EQ(r.pga_m_s2, 3);
        EXPECT_GE(r.pulse_gamma, 1);
        EXPECT_LE(r.pulse_gamma, 3);
        ln_f += std::log(r.frequency_hz / 2) / 400;
        gammas.insert(r.pulse_gamma);
    }
    EXPECT_LT(std::fabs(ln_f), 4 * 0.3 / 20); // a false alarm in 15,000
    EXPECT_EQ(gammas.size(), 400u);
    // without perturbation the study's own
    const Realization plain =
        Experiment(study_of("kind = \"pulse\"\nfrequency_hz = 2\npga_m_s2 = 3\ngamma = 1.6\nphase_rad = 0.3\n"))
            .sampler()
            .realization(0);
    EXPECT_EQ(plain.frequency_hz, 2);
    EXPECT_EQ(plain.pulse_gamma, 1.6);
    EXPECT_EQ(plain.phase_rad, 0.3);
}

using Bits = std::vector<std::uint64_t>;

std::map<std::uint64_t, Bits> run(const Study& study, Isa isa, int threads)
{
    std::map<std::uint64_t, Bits> outcomes;
    RunPlan plan;
    plan.total = 24;
    plan.sink = [&](const Realization& realization, const Outcome& o) {
        Bits& bits = outcomes[realization.index];
        for (const double value : {o.peak_top_displacement_m, o.residual_top_displacement_m, o.total_sliding_m,
                                   o.total_rocking_rad, o.energy_base_work_j, o.end_time_s})
            bits.push_back(std::bit_cast<std::uint64_t>(value));
        EXPECT_NE(o.state, State::invalid) << realization.index;
        EXPECT_LT(std::fabs(o.energy_residual), 0.05) << realization.index;
    };
    Observer observer;
    run_ensemble(Experiment(study), {isa, threads}, plan, observer);
    return outcomes;
}

TEST(Shaking, OutcomesHaveTheSameBitsForEveryWidthAndThreadCount)
{
    const std::string tail = "tail_s = 0.2\n";
    for (const std::string& excitation :
         {short_noise, std::string("kind = \"ricker\"\nfrequency_hz = 4\npga_m_s2 = 4\n"),
          std::string("kind = \"pulse\"\nfrequency_hz = 3\npga_m_s2 = 3\n"),
          std::string("kind = \"tapered\"\nfrequency_hz = 6\npga_m_s2 = 3\ncycles = 5\n"),
          std::string("kind = \"sweep\"\nfrom_hz = 2\nto_hz = 8\nduration_s = 1.5\npga_m_s2 = 3\n")}) {
        SCOPED_TRACE(excitation);
        const Study study = study_of(
            excitation + tail, "[perturbation]\nnormal_stiffness = { distribution = \"lognormal\", sigma_ln = 0.3 }\n");
        const auto want = run(study, Isa::scalar, 1);
        ASSERT_EQ(want.size(), 24u);
        EXPECT_NE(want.at(0), want.at(1));
        for (const Isa isa : usable_isas())
            EXPECT_EQ(run(study, isa, 2), want) << to_string(isa);
    }
}

} // namespace
} // namespace stylobate::test_synthetic_noise
