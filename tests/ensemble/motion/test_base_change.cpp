// What mechanisms make of the base's motion: gain, offset in time and harmonic distortion against their formulas in
// extended precision, for every kind of motion; motions through displacements; vertical records.

#include "ensemble/experiment.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/distortion.hpp"
#include "ensemble/numerics/elementary.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace stylobate {
namespace {

const long double pi = std::numbers::pi_v<long double>;

using Displacement = std::function<long double(long double)>;

std::vector<double> table(const BaseMotion& motion, double steps)
{
    std::vector<double> all;
    for (double first = 0; first < steps; first += chunk_steps) {
        all.resize(all.size() + chunk_steps);
        motion.fill(first, all.data() + all.size() - chunk_steps, 1);
    }
    return all;
}

/// Largest deviation of a table from the second differences of a displacement [m].
double table_error(const std::vector<double>& table, double step, const Displacement& u)
{
    long double worst = 0;
    for (std::size_t n = 0; n < table.size(); ++n) {
        const long double t = static_cast<long double>(n) * step, d = step;
        worst = std::max(worst, std::fabs(table[n] - (u(t + d) - 2 * u(t) + u(t - d))));
    }
    return static_cast<double>(worst);
}

RealizationHeader shaken(double frequency, double pga, double step, const BaseChange& change)
{
    RealizationHeader r;
    r.frequency_hz = frequency;
    r.pga_m_s2 = pga;
    r.step_s = step;
    r.change = change;
    return r;
}

long double ramp(long double x)
{
    const long double t = std::clamp(x, 0.0L, 1.0L);
    return t * t * t * (10 + t * (6 * t - 15));
}

TEST(BaseChange, AHarmonicMotionWithEverything)
{
    for (const bool is_abrupt : {false, true})
        for (const double offset : {0.0, 0.0127, -0.31}) {
            ExcitationSpec e;
            e.kind = ExcitationKind::harmonic;
            e.start = e.end = is_abrupt ? HarmonicEdge::abrupt : HarmonicEdge::smooth;
            RealizationHeader r = shaken(2.5, 3, 1e-3, {0.88, offset, 0.02, -0.01, 0.03, 0.04});
            r.phase_rad = 0.7;
            const BaseMotion motion(e, r, nullptr);
            const long double f = 2.5, amplitude = 0.88 * 3 / ((2 * pi * f) * (2 * pi * f));
            const auto wave = [](long double x) {
                return std::sin(x) + 0.02L * std::sin(2 * x) - 0.01L * std::cos(2 * x) + 0.03L * std::sin(3 * x) +
                       0.04L * std::cos(3 * x);
            };
            const Displacement own = [&](long double t) -> long double {
                if (t <= 0)
                    return 0;
                const long double c = std::min(f * t, 10.0L);
                const long double size = is_abrupt ? 1 : ramp(c / 2) * ramp((10 - c) / 2);
                return amplitude * size * (wave(2 * pi * c + 0.7L) - (is_abrupt ? wave(0.7L) : 0));
            };
            const Displacement u = [&](long double t) { return own(t + offset); };
            EXPECT_LT(table_error(table(motion, 4500), 1e-3, u), 4e-15 * amplitude) << is_abrupt << ' ' << offset;
            EXPECT_DOUBLE_EQ(motion.duration_s(), 4 - offset);
            for (const double t : {0.0, 0.3, 1.777, 3.9, 5.0})
                EXPECT_NEAR(motion.displacement_m(t), static_cast<double>(u(t)),
                            8e-15 * static_cast<double>(amplitude));
        }
}

TEST(BaseChange, OnTheHostAFormulaHasTheKernelsBits)
{
    for (const ExcitationKind kind : {ExcitationKind::harmonic, ExcitationKind::half_sine, ExcitationKind::full_sine}) {
        ExcitationSpec e;
        e.kind = kind;
        const BaseMotion motion(e, shaken(2.5, 3, 1.3e-4, {}), nullptr);
        const std::vector<double> host = table(motion, 40000);
        std::array<double, 8> v{};
        const FormulaParameters p{&v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]};
        motion.store(p, 0);
        for (double first = 0; first < 40000; first += chunk_steps) {
            std::array<double, chunk_steps> kernels;
            fill_base_table<double>(BaseMotion::formula(kind), p, &first, kernels.data());
            for (std::size_t k = 0; k < kernels.size(); ++k)
                ASSERT_EQ(host[static_cast<std::size_t>(first) + k], kernels[k]) << first << ' ' << k;
        }
    }
}

TEST(BaseChange, GainAndOffsetOfPulses)
{
    for (const ExcitationKind kind : {ExcitationKind::half_sine, ExcitationKind::full_sine, ExcitationKind::ricker,
                                      ExcitationKind::tapered, ExcitationKind::pulse}) {
        ExcitationSpec e;
        e.kind = kind;
        e.ramp_cycles = 2;
        RealizationHeader r = shaken(2, 3, 1e-3, {});
        r.pulse_gamma = 2;
        const BaseMotion plain(e, r, nullptr);
        for (const double offset : {0.0123, -0.2}) {
            r.change = {1.3, offset};
            const BaseMotion changed(e, r, nullptr);
            EXPECT_NEAR(changed.duration_s(), plain.duration_s() - offset, 1e-12);
            const Displacement u = [&](long double t) {
                return 1.3L * plain.displacement_m(static_cast<double>(t + offset));
            };
            double largest = 0;
            for (double t = 0; t < 7; t += 0.01)
                largest = std::max(largest, std::fabs(plain.displacement_m(t)));
            EXPECT_LT(table_error(table(changed, 7000), 1e-3, u), 5e-14 * largest)
                << static_cast<int>(kind); // times up to 7 s are known to 1e-15
        }
    }
}

/// A tone burst: u = A s(t / rise) s((T - t) / rise) sin(w t), sampled.
Motion burst(double amplitude, double frequency, double duration, double dt)
{
    std::vector<double> u;
    for (int i = 0; i * dt < duration + dt / 2; ++i) {
        const long double t = i * dt;
        u.push_back(
            static_cast<double>(amplitude * ramp(t / 2) * ramp((duration - t) / 2) * std::sin(2 * pi * frequency * t)));
    }
    Motion motion = motion_of(acceleration_through(u, dt), dt);
    motion.predominant_frequency_hz = frequency;
    return motion;
}

TEST(BaseChange, ARecordIsMovedInTime)
{
    const Motion record = burst(0.02, 2, 6, 0.005);
    ExcitationSpec e;
    e.kind = ExcitationKind::table;
    RealizationHeader r = shaken(1, 2 * record.pga_m_s2, 1.7e-4, {}); // stretched to twice its time, twice as strong
    const BaseMotion plain(e, r, &record);
    for (const double offset : {0.0127, -0.0127, -0.5, 1.0}) {
        r.change = {0.9, offset};
        const BaseMotion changed(e, r, &record);
        const Displacement u = [&](long double t) {
            return 0.9L * plain.displacement_m(static_cast<double>(t + offset));
        };
        // displacements of up to 1 m at times that are known to 2e-15 s
        EXPECT_LT(table_error(table(changed, 30000), 1.7e-4, u), 5e-15) << offset;
        EXPECT_NEAR(changed.duration_s(), 12 - offset, 1e-12);
    }
}

TEST(BaseChange, AJumpOfTheAccelerationAtTheStartComesLater)
{
    Motion motion = motion_of({1, 1, 1, 0}, 0.01); // begins with 1 m/s2 at once
    motion.predominant_frequency_hz = 1;
    ExcitationSpec e;
    e.kind = ExcitationKind::table;
    const BaseMotion later(e, shaken(1, 0, 1e-3, {1, -0.0045}), &motion);
    const Displacement u = [](long double t) { return t <= 0.0045L ? 0 : (t - 0.0045L) * (t - 0.0045L) / 2; };
    std::vector<double> start = table(later, 1);
    start.resize(20); // up to 0.02 s the acceleration is 1
    EXPECT_LT(table_error(start, 1e-3, u), 1e-19);
}

TEST(BaseChange, OvertonesOfASampledTone)
{
    const double amplitude = 0.02, f = 2;
    const Motion motion = burst(amplitude, f, 16, 0.005);
    const Distortion distortion(motion);
    const double measured = [&] {
        const BaseChange change{1, 0, 0.05, -0.03, 0.02, 0.04};
        const Motion distorted = distortion.distorted(motion, change);
        EXPECT_EQ(distorted.pga_m_s2, motion.pga_m_s2);
        long double worst = 0;
        for (std::size_t i = 500; i < 2700; ++i) { // where the burst is whole
            const long double x = 2 * pi * f * static_cast<long double>(i) * 0.005L;
            const long double want = amplitude * (std::sin(x) + 0.05L * std::sin(2 * x) - 0.03L * std::cos(2 * x) +
                                                  0.02L * std::sin(3 * x) + 0.04L * std::cos(3 * x));
            worst = std::max(worst, std::fabs(distorted.displacement_m[i] - want));
        }
        return static_cast<double>(worst) / amplitude;
    }();
    EXPECT_LT(measured, 5e-5); // the ramps at the ends reach so far
    EXPECT_EQ(distortion.distorted(motion, {}).acceleration_m_s2, motion.acceleration_m_s2);
}

TEST(BaseChange, DistortionKeepsRestAndScale)
{
    const Motion motion = burst(0.02, 2, 8, 0.005);
    const BaseChange change{1, 0, 0.1, 0.1, 0.1, 0.1};
    const Motion distorted = Distortion(motion).distorted(motion, change);
    EXPECT_NEAR(distorted.velocity_m_s.back(), motion.velocity_m_s.back(), 1e-6);
    EXPECT_NEAR(distorted.displacement_m.back(), motion.displacement_m.back(), 1e-5);
    Motion twice = motion;
    for (double& u : twice.displacement_m)
        u *= 2;
    for (double& a : twice.acceleration_m_s2)
        a *= 2;
    const Motion doubled = Distortion(twice).distorted(twice, change);
    for (std::size_t i = 0; i < distorted.acceleration_m_s2.size(); ++i)
        ASSERT_NEAR(doubled.acceleration_m_s2[i], 2 * distorted.acceleration_m_s2[i], 1e-12);
}

TEST(BaseChange, TheSplineThroughDisplacements)
{
    // a cubic that begins at rest and ends without acceleration is its own spline: u = t2 (3 T - t)
    const double dt = 0.01, end = 0.5;
    std::vector<double> u;
    for (int i = 0; i <= 50; ++i)
        u.push_back(i * dt * i * dt * (3 * end - i * dt));
    const std::vector<double> a = acceleration_through(u, dt);
    for (int i = 0; i <= 50; ++i)
        EXPECT_NEAR(a[static_cast<std::size_t>(i)], 6 * (end - i * dt), 1e-10);

    // of a sine it is off by 5 (w d)4 / 384 at most, between the samples too; ends where the acceleration is 0
    for (const int per_cycle : {16, 32, 64}) {
        const long double w = 2 * pi, d = 1.0L / per_cycle;
        std::vector<double> wave;
        for (int i = 0; i <= 3 * per_cycle + per_cycle / 4; ++i)
            wave.push_back(static_cast<double>(1 - std::cos(w * i * d)));
        Motion motion = motion_of(acceleration_through(wave, static_cast<double>(d)), static_cast<double>(d));
        motion.predominant_frequency_hz = 1;
        const BaseMotion base = BaseMotion::along(std::make_shared<const Motion>(motion), 1e-3);
        long double worst = 0;
        for (int k = 0; k < 8 * 3 * per_cycle; ++k) {
            const long double t = k * d / 8;
            worst = std::max(worst, std::fabs(base.displacement_m(static_cast<double>(t)) - (1 - std::cos(w * t))));
        }
        EXPECT_LT(worst, 1.01L * 5 / 384 * std::pow(w * d, 4.0L)) << per_cycle;
    }
}

Study study_of(ExcitationKind kind)
{
    Study study;
    study.structure = equal_column(3, 1, 0.048, 0.029, 0.048, 0.1355);
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 4.8e6;
    study.contact.friction = 0.68;
    study.excitation.kind = kind;
    study.excitation.frequency_hz = 2;
    study.excitation.pga_m_s2 = 3;
    study.excitation.from_hz = 1;
    study.excitation.to_hz = 4;
    study.excitation.duration_s = 8;
    study.realizations = 4;
    return study;
}

TEST(BaseChange, EveryMotionThatOscillatesIsDistorted)
{
    const Motion record = burst(0.02, 2, 8, 0.005);
    for (const ExcitationKind kind : {ExcitationKind::tapered, ExcitationKind::sweep, ExcitationKind::noise,
                                      ExcitationKind::record, ExcitationKind::table}) {
        Study study = study_of(kind);
        const Realization plain = Sampler(study, &record).realization(0);
        study.mechanisms.push_back({Mechanism::harmonic_distortion, {}, {0.05, 0, 0, 0}});
        const Sampler sampler(study, &record);
        const Realization r = sampler.realization(0);
        ASSERT_NE(r.motion, nullptr) << static_cast<int>(kind);
        EXPECT_TRUE(BaseMotion::on_host(study));
        const BaseMotion with(study.excitation, r, &record), without(study.excitation, plain, &record);
        EXPECT_NEAR(with.duration_s(), without.duration_s(), 1e-9);
        double largest = 0, difference = 0, end = 0;
        for (double t = 0; t < without.duration_s(); t += 0.003) {
            largest = std::max(largest, std::fabs(without.displacement_m(t)));
            end = std::fabs(with.displacement_m(t) - without.displacement_m(t));
            difference = std::max(difference, end);
        }
        // overtones of 5 % of the envelope, which is as high as the displacement
        EXPECT_GT(difference, 0.03 * largest) << static_cast<int>(kind);
        EXPECT_LT(difference, 0.06 * largest) << static_cast<int>(kind);
        EXPECT_LT(end, 1e-3 * largest) << static_cast<int>(kind);
        if (kind == ExcitationKind::record) { // of all realizations the same one
            EXPECT_EQ(sampler.realization(1).motion, sampler.realization(2).motion);
        }
    }
}

TEST(BaseChange, DrawnDistortionsAreEachRealizationsOwn)
{
    const Motion record = burst(0.02, 2, 8, 0.005);
    Study study = study_of(ExcitationKind::table);
    study.mechanisms.push_back({Mechanism::harmonic_distortion, {}, {0.05, 0, 0, 0}});
    MechanismPerturbation p;
    p.mechanism = Mechanism::harmonic_distortion;
    p.sd = 0.01;
    study.mechanism_perturbations = {p};
    const Sampler sampler(study, &record);
    const Realization a = sampler.realization(0), b = sampler.realization(1);
    EXPECT_EQ(a.change.second, a.inputs.back());
    EXPECT_NE(a.change.second, b.change.second);
    // the overtones are in proportion to the coefficient
    for (std::size_t i = 0; i < record.displacement_m.size(); i += 37) {
        const double u = record.displacement_m[i];
        EXPECT_NEAR((a.motion->displacement_m[i] - u) * b.change.second,
                    (b.motion->displacement_m[i] - u) * a.change.second, 1e-14);
    }
}

TEST(BaseChange, AVerticalRecordGoesWithTheHorizontalOne)
{
    const Motion record = burst(0.02, 2, 8, 0.005), up = burst(0.004, 5, 8, 0.005);
    Study study = study_of(ExcitationKind::record);
    study.excitation.pga_m_s2 = 3 * record.pga_m_s2;
    study.excitation.time_scale = 2;
    study.vertical = VerticalSpec{"up", "", "", true};
    study.mechanisms = {neutral_spec(Mechanism::vertical_motion, 0.68)};
    const Realization r = Sampler(study, &record, &up).realization(0);
    ASSERT_NE(r.vertical, nullptr);
    EXPECT_TRUE(r.with_mechanisms);
    EXPECT_EQ(r.vertical->dt_s, 0.01);
    EXPECT_NEAR(r.vertical->pga_m_s2, 3 * up.pga_m_s2, 1e-12);
    EXPECT_NEAR(r.vertical->acceleration_m_s2[700], 3 * up.acceleration_m_s2[700], 1e-12);
    EXPECT_NEAR(r.vertical->velocity_m_s[700], 6 * up.velocity_m_s[700], 1e-12);
    EXPECT_NEAR(r.vertical->displacement_m[700], 12 * up.displacement_m[700], 1e-12);

    // with a motion that is no record it is as it stands
    study.excitation = study_of(ExcitationKind::harmonic).excitation;
    EXPECT_EQ(Sampler(study, nullptr, &up).realization(0).vertical->acceleration_m_s2, up.acceleration_m_s2);
    EXPECT_THROW(Sampler(study, nullptr), std::invalid_argument);
}

TEST(BaseChange, AnExperimentKeepsItsMotions)
{
    const Motion record = burst(0.02, 2, 8, 0.005), up = burst(0.004, 5, 8, 0.005);
    Study study = study_of(ExcitationKind::record);
    study.vertical = VerticalSpec{"up", "", "", true};
    study.mechanisms = {neutral_spec(Mechanism::vertical_motion, 0.68)};
    const Experiment experiment(study, {.record = record, .vertical = up});
    ASSERT_NE(experiment.record(), nullptr);
    EXPECT_EQ(experiment.record()->acceleration_m_s2, record.acceleration_m_s2);
    EXPECT_EQ(experiment.motions().vertical->acceleration_m_s2, up.acceleration_m_s2);
    const Realization r = experiment.sampler().realization(3), want = Sampler(study, &record, &up).realization(3);
    EXPECT_EQ(r.vertical->acceleration_m_s2, want.vertical->acceleration_m_s2);
    EXPECT_EQ(r.inputs, want.inputs);
    EXPECT_THROW(Experiment(study, {.record = record}), std::invalid_argument);
    study.vertical.reset();
    study.mechanisms.clear();
    study.excitation.kind = ExcitationKind::harmonic;
    EXPECT_EQ(Experiment(study).record(), nullptr);
}

TEST(BaseChange, StudiesThatNeedTheHost)
{
    Study study = study_of(ExcitationKind::harmonic);
    EXPECT_FALSE(BaseMotion::on_host(study));
    study.mechanisms = {neutral_spec(Mechanism::sensor_gain, 0.68)};
    EXPECT_FALSE(BaseMotion::on_host(study)); // the kernels' amplitude
    study.mechanisms = {neutral_spec(Mechanism::time_offset, 0.68)};
    EXPECT_TRUE(BaseMotion::on_host(study));
    EXPECT_TRUE(BaseMotion::on_host(study_of(ExcitationKind::table)));
}

} // namespace
} // namespace stylobate
