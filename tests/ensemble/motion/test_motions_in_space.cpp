/// The three motions of a base in space: closed forms, samples made by hand, and the statistics of noise with fixed
/// seeds.

#include "ensemble/motion/motions_in_space.hpp"

#include "ensemble/motion/noise_in_space.hpp"
#include "ensemble/motion/shaking.hpp"
#include "kernels/base_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace stylobate::test_motions_in_space {
namespace {

constexpr double pi = std::numbers::pi;

Study shaken_by(ExcitationKind kind)
{
    Study study;
    study.structure.dimensions = 3;
    study.excitation.kind = kind;
    study.excitation.frequency_hz = 2;
    study.excitation.pga_m_s2 = 4;
    return study;
}

/// The shaking of a realization, with the phase of the study.
RealizationHeader shaking_of(const Study& study, const Motion* record = nullptr, const Motion* second = nullptr,
                             std::uint64_t index = 0, const Motion* vertical = nullptr)
{
    RealizationHeader header;
    header.index = index;
    header.step_s = 1e-3;
    const Shaking shaking(study, record, vertical, nullptr, second);
    shaking.apply(study,
                  {study.excitation.phase_rad, study.excitation.frequency_hz, study.excitation.gamma,
                   study.excitation.direction_deg * pi / 180},
                  {}, header);
    return header;
}

std::array<BaseMotion, 3> motions_of(const Study& study, const RealizationHeader& header,
                                     const Motion* record = nullptr)
{
    return motions_in_space(study.excitation, header, record);
}

std::vector<double> table_of(const BaseMotion& motion, double first_step)
{
    std::vector<double> table(chunk_steps);
    motion.fill(first_step, table.data(), 1);
    return table;
}

double largest(const std::vector<double>& values)
{
    double most = 0;
    for (const double value : values)
        most = std::max(most, std::fabs(value));
    return most;
}

/// Largest length of the vector of two accelerations.
double longest(const std::vector<double>& a, const std::vector<double>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::hypot(a[i], b[i]));
    return most;
}

/// Samples that peak at different times: 3 and -4 at once, 5 of the first one alone.
Motion first_by_hand()
{
    return motion_of({0, 1, 3, -1, 5, 0, 0, 0}, 0.01);
}
Motion second_by_hand()
{
    return motion_of({0, 0, -4, 2, 1, 0, 0, 0}, 0.01);
}

TEST(MotionsInSpace, TheFirstComponentHasTheBitsOfThePlane)
{
    for (const ExcitationKind kind : {ExcitationKind::harmonic, ExcitationKind::full_sine, ExcitationKind::ricker,
                                      ExcitationKind::pulse, ExcitationKind::tapered, ExcitationKind::noise}) {
        Study plane = shaken_by(kind), space = plane;
        plane.structure.dimensions = 2;
        space.excitation.direction_deg = 37;
        space.excitation.second_ratio = 0.8;
        space.excitation.vertical_ratio = 0.5;
        const RealizationHeader in_plane = shaking_of(plane), in_space = shaking_of(space);
        EXPECT_DOUBLE_EQ(in_space.direction_rad, 37 * pi / 180);
        const BaseMotion want(plane.excitation, in_plane, nullptr);
        const auto got = motions_of(space, in_space);
        for (const double first_step : {0.0, 300.0, 5000.0})
            EXPECT_EQ(table_of(got[0], first_step), table_of(want, first_step)) << static_cast<int>(kind);
        EXPECT_EQ(got[0].duration_s(), want.duration_s());
    }
}

TEST(MotionsInSpace, AHarmonicHasItsSecondComponentAtItsPhase)
{
    Study study = shaken_by(ExcitationKind::harmonic);
    ExcitationSpec& e = study.excitation;
    e.second_ratio = 0.6;
    e.second_phase_deg = 50;
    e.vertical_ratio = 0.3;
    e.phase_rad = 0.4;
    const auto motions = motions_of(study, shaking_of(study));
    const double w = 2 * pi * e.frequency_hz, amplitude = e.pga_m_s2 / (w * w);
    for (double t = 1.1; t < 3.9; t += 0.037) { // the plateau: 2 to 8 of 10 cycles
        EXPECT_NEAR(motions[0].displacement_m(t), amplitude * std::sin(w * t + 0.4), 1e-12) << t;
        EXPECT_NEAR(motions[1].displacement_m(t), 0.6 * amplitude * std::sin(w * t + 0.4 + 50 * pi / 180), 1e-12) << t;
        EXPECT_NEAR(motions[2].displacement_m(t), 0.3 * amplitude * std::sin(w * t + 0.4), 1e-12) << t;
    }
}

TEST(MotionsInSpace, ComponentsThatAreNotThereAreAtRest)
{
    const Motion record = first_by_hand();
    for (const ExcitationKind kind : {ExcitationKind::harmonic, ExcitationKind::half_sine, ExcitationKind::ricker,
                                      ExcitationKind::noise, ExcitationKind::record}) {
        const Study study = shaken_by(kind);
        Motion moved = record;
        moved.predominant_frequency_hz = 2;
        const Motion* first = kind == ExcitationKind::record ? &moved : nullptr;
        const auto motions = motions_of(study, shaking_of(study, first), first);
        EXPECT_GT(largest(table_of(motions[0], 0)), 0) << static_cast<int>(kind);
        for (const std::size_t other : {1U, 2U}) {
            EXPECT_EQ(largest(table_of(motions[other], 0)), 0) << static_cast<int>(kind);
            EXPECT_EQ(motions[other].displacement_m(0.1), 0) << static_cast<int>(kind);
            EXPECT_TRUE(std::isfinite(motions[other].duration_s()));
            // the kernels' formula divides by its rate
            std::array<double, 8> v{};
            motions[other].store({&v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]}, 0);
            EXPECT_TRUE(BaseMotion::on_host(study) || v[0] > 0) << static_cast<int>(kind);
        }
    }
}

TEST(MotionsInSpace, PgaOfAHarmonicPairByItsDefinition)
{
    for (const double ratio : {0.3, 1.0, 1.7})
        for (const double phase_deg : {0.0, 30.0, 90.0, 137.0, -200.0}) {
            double at_once = 0;
            for (int i = 0; i < 200000; ++i) {
                const double t = 2 * pi * i / 200000;
                at_once = std::max(at_once, std::hypot(std::sin(t), ratio * std::sin(t + phase_deg * pi / 180)));
            }
            Study study = shaken_by(ExcitationKind::harmonic);
            ExcitationSpec& e = study.excitation;
            e.second_ratio = ratio;
            e.second_phase_deg = phase_deg;
            const auto over_first = [&](OfPair definition) {
                e.pga_of_pair = definition;
                const RealizationHeader header = shaking_of(study);
                EXPECT_EQ(header.pga_m_s2, 4);
                return 1 / header.first_share;
            };
            EXPECT_EQ(over_first(OfPair::first), 1);
            EXPECT_NEAR(over_first(OfPair::larger), std::max(1.0, ratio), 1e-15);
            EXPECT_NEAR(over_first(OfPair::geometric_mean), std::sqrt(ratio), 1e-15);
            EXPECT_NEAR(over_first(OfPair::at_once), at_once, 1e-9) << ratio << ' ' << phase_deg;
        }
}

TEST(MotionsInSpace, PgaOfATaperedAndAPulsePairAtOnce)
{
    for (const ExcitationKind kind : {ExcitationKind::tapered, ExcitationKind::pulse}) {
        Study study = shaken_by(kind);
        study.excitation.second_ratio = 0.8;
        study.excitation.second_phase_deg = 70;
        study.excitation.pga_of_pair = OfPair::at_once;
        const auto motions = motions_of(study, shaking_of(study));
        // from second differences of the displacements, 1e-4 s apart
        const double d = 1e-4;
        double at_once = 0;
        const auto acceleration = [&](std::size_t i, double t) {
            const BaseMotion& m = motions[i];
            return (m.displacement_m(t + d) - 2 * m.displacement_m(t) + m.displacement_m(t - d)) / (d * d);
        };
        for (double t = 2 * d; t < motions[0].duration_s(); t += d)
            at_once = std::max(at_once, std::hypot(acceleration(0, t), acceleration(1, t)));
        EXPECT_NEAR(at_once, 4, 4e-6) << static_cast<int>(kind);
    }
}

TEST(MotionsInSpace, RecordsHaveOneFactorAndOneTime)
{
    Motion first = first_by_hand(), second = second_by_hand(), up = motion_of({0, 2, -2, 0, 0, 0, 0, 0}, 0.01);
    first.predominant_frequency_hz = 10;
    Study study = shaken_by(ExcitationKind::record);
    ExcitationSpec& e = study.excitation;
    e.second = ComponentSpec{};
    study.vertical = VerticalSpec{};
    e.time_scale = 2;
    e.pga_m_s2 = 10;
    const struct {
        OfPair definition;
        double pga; // of the samples above
    } cases[] = {{OfPair::first, 5},
                 {OfPair::larger, 5},
                 {OfPair::geometric_mean, std::sqrt(20.0)},
                 {OfPair::at_once, std::sqrt(26.0)}}; // 5 and 1, more than 3 and 4
    for (const auto& each : cases) {
        e.pga_of_pair = each.definition;
        const RealizationHeader header = shaking_of(study, &first, &second, 0, &up);
        EXPECT_EQ(header.pga_m_s2, 10);
        const auto motions = motions_of(study, header, &first);
        const double factor = 10 / each.pga;
        const std::array<const Motion*, 3> samples = {&first, &second, &up};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < first.displacement_m.size(); ++i) // twice as long: u grows fourfold
                EXPECT_NEAR(motions[c].displacement_m(0.02 * static_cast<double>(i)),
                            4 * factor * samples[c]->displacement_m[i], 1e-13)
                    << c << ' ' << i;
    }
    e.pga_m_s2 = 0; // as it stands
    EXPECT_NEAR(shaking_of(study, &first, &second, 0, &up).pga_m_s2, std::sqrt(26.0), 1e-14);
    EXPECT_THROW(shaking_of(study, &first, nullptr, 0, &up), std::invalid_argument);
}

TEST(MotionsInSpace, NoiseOfTwoComponentsHasThePgaOfItsDefinition)
{
    Study study = shaken_by(ExcitationKind::noise);
    study.excitation.second_ratio = 0.8;
    study.excitation.vertical_ratio = 0.5;
    for (std::uint64_t index = 0; index < 5; ++index) {
        study.realizations = 5;
        const auto pga = [&](OfPair definition) {
            study.excitation.pga_of_pair = definition;
            const RealizationHeader r = shaking_of(study, nullptr, nullptr, index);
            const std::vector<double>&a = r.motion->acceleration_m_s2, &b = r.second->acceleration_m_s2;
            return std::array{largest(a), std::max(largest(a), largest(b)), std::sqrt(largest(a) * largest(b)),
                              longest(a, b)};
        };
        EXPECT_NEAR(pga(OfPair::first)[0], 4, 1e-12);
        EXPECT_NEAR(pga(OfPair::larger)[1], 4, 1e-12);
        EXPECT_NEAR(pga(OfPair::geometric_mean)[2], 4, 1e-12);
        EXPECT_NEAR(pga(OfPair::at_once)[3], 4, 1e-12);
    }
}

TEST(MotionsInSpace, NoiseHasTheCorrelationAndTheRatioThatAreStated)
{
    // At one time of the strong phase, over 2000 shakings: Fisher's z of a correlation has the standard deviation
    // 1 / sqrt(1997), the logarithm of a ratio of two standard deviations at most 1 / sqrt(2000). 9 comparisons within
    // 4 of them: a false alarm in 2000.
    constexpr std::uint64_t count = 2000;
    ExcitationSpec e = shaken_by(ExcitationKind::noise).excitation;
    e.rise_s = 0.2;
    e.strong_s = 0.4;
    e.decay_s = 0.1;
    e.second_ratio = 0.8;
    const SyntheticNoise noise(e, 2);
    for (const double correlation : {0.0, 0.7, -0.4}) {
        e.second_correlation = correlation;
        std::vector<double> a, b, c;
        for (std::uint64_t i = 0; i < count; ++i) {
            const HorizontalNoise pair = horizontal_noise(noise, e, 11, i, Stream::base_noise, Stream::second_noise);
            const std::size_t at = pair.first.size() / 2;
            a.push_back(pair.first[at]);
            b.push_back(pair.second[at]);
            c.push_back(noise.acceleration(11, i, Stream::vertical_noise)[at]);
        }
        const auto dot = [&](const std::vector<double>& x, const std::vector<double>& y) {
            double sum = 0;
            for (std::size_t i = 0; i < count; ++i)
                sum += x[i] * y[i];
            return sum / static_cast<double>(count);
        };
        const auto z = [&](const std::vector<double>& x, const std::vector<double>& y) {
            return std::atanh(dot(x, y) / std::sqrt(dot(x, x) * dot(y, y)));
        };
        const double sd = 1 / std::sqrt(static_cast<double>(count) - 3);
        EXPECT_NEAR(z(a, b), std::atanh(correlation), 4 * sd) << correlation;
        EXPECT_NEAR(z(a, c), 0, 4 * sd);
        EXPECT_NEAR(std::log(dot(b, b) / dot(a, a)) / 2, std::log(0.8), 4 * sd) << correlation;
    }
}

TEST(MotionsInSpace, ThePgaOfNoiseCanBeTheMeanOfThePairs)
{
    // The mean of 128 peaks is known to 1 % (their coefficient of variation is about 0.12), that of 200 realizations
    // too: within 5 %, more than three standard deviations of the difference.
    Study study = shaken_by(ExcitationKind::noise);
    study.excitation.second_ratio = 0.8;
    study.excitation.pga_of = PgaOf::mean;
    study.excitation.pga_of_pair = OfPair::at_once;
    study.excitation.strong_s = 2;
    study.realizations = 200;
    const Shaking shaking(study, nullptr, nullptr);
    double sum = 0;
    for (std::uint64_t i = 0; i < study.realizations; ++i) {
        RealizationHeader header;
        header.index = i;
        shaking.apply(study, {}, {}, header);
        sum += longest(header.motion->acceleration_m_s2, header.second->acceleration_m_s2);
    }
    EXPECT_NEAR(sum / 200, 4, 0.2);
}

TEST(MotionsInSpace, ARealizationIsAFunctionOfItsIndex)
{
    Study study = shaken_by(ExcitationKind::noise);
    study.realizations = 8;
    study.excitation.second_ratio = 1;
    study.excitation.vertical_ratio = 1;
    const RealizationHeader once = shaking_of(study, nullptr, nullptr, 3),
                            again = shaking_of(study, nullptr, nullptr, 3),
                            other = shaking_of(study, nullptr, nullptr, 4);
    EXPECT_EQ(once.second->acceleration_m_s2, again.second->acceleration_m_s2);
    EXPECT_EQ(once.vertical->acceleration_m_s2, again.vertical->acceleration_m_s2);
    EXPECT_NE(once.second->acceleration_m_s2, other.second->acceleration_m_s2);
    EXPECT_NE(once.vertical->acceleration_m_s2, other.vertical->acceleration_m_s2);
    EXPECT_NE(once.second->acceleration_m_s2, once.motion->acceleration_m_s2);
    EXPECT_NE(once.vertical->acceleration_m_s2, once.second->acceleration_m_s2);
}

TEST(MotionsInSpace, GainChangesTheHorizontalComponentsAndAnOffsetAll)
{
    Study study = shaken_by(ExcitationKind::noise);
    study.excitation.second_ratio = 0.8;
    study.excitation.vertical_ratio = 0.5;
    RealizationHeader plain = shaking_of(study), changed = plain;
    changed.change.gain = 1.1;
    changed.change.offset_s = 0.25;
    const auto a = motions_of(study, plain), b = motions_of(study, changed);
    for (const std::size_t c : {0U, 1U, 2U})
        for (const double t : {0.5, 3.0, 6.3})
            EXPECT_NEAR(b[c].displacement_m(t), (c == 2 ? 1 : 1.1) * a[c].displacement_m(t + 0.25), 1e-12) << c;
}

TEST(MotionsInSpace, OvertonesChangeBothHorizontalComponents)
{
    for (const ExcitationKind kind : {ExcitationKind::noise, ExcitationKind::tapered, ExcitationKind::record}) {
        Motion first = first_by_hand(), second = second_by_hand();
        first.predominant_frequency_hz = 10;
        const bool recorded = kind == ExcitationKind::record;
        Study study = shaken_by(kind);
        if (recorded)
            study.excitation.second = ComponentSpec{};
        else
            study.excitation.second_ratio = 0.8;
        study.mechanisms = {neutral_spec(Mechanism::harmonic_distortion, 0.6)};
        study.mechanisms.front().values[0] = 0.1;
        const Shaking shaking(study, recorded ? &first : nullptr, nullptr, nullptr, recorded ? &second : nullptr);
        const auto displaced = [&](double overtone) {
            RealizationHeader header;
            header.step_s = 1e-3;
            header.change.second = overtone;
            shaking.apply(study, {}, {}, header);
            const auto motions = motions_of(study, header, &first);
            const double middle = 0.47 * motions[0].duration_s();
            return std::array{motions[0].displacement_m(middle), motions[1].displacement_m(middle)};
        };
        const auto plain = displaced(0), half = displaced(0.05), whole = displaced(0.1);
        for (const std::size_t c : {0U, 1U}) {
            EXPECT_GT(std::fabs(whole[c] - plain[c]), 1e-6 * std::fabs(plain[c])) << static_cast<int>(kind) << ' ' << c;
            // in proportion; of a record that of the study's mechanism, made once
            const double of_half = recorded ? whole[c] - plain[c] : 2 * (half[c] - plain[c]);
            EXPECT_NEAR(whole[c] - plain[c], of_half, 1e-8) << static_cast<int>(kind) << ' ' << c;
        }
    }
}

} // namespace
} // namespace stylobate::test_motions_in_space
