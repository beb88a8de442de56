/// What a diagnosis names is what the extended study runs: both ways of putting a cause into the model agree.

#include "io/measured/campaign_writer.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_motion.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/diagnosis/pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <set>

namespace stylobate {
namespace {

/// Two columns of one drum under an epistyle; each stands on a block fixed to the table.
Specimen small_colonnade()
{
    Specimen s;
    s.name = "colonnade";
    s.friction_nominal = 0.6;
    s.half_width_m = {0.03, 0.03, 0.075};
    s.half_height_m = {0.05, 0.05, 0.03};
    s.depth_m = {0.06, 0.06, 0.06};
    s.mass_kg = {0.9, 0.9, 1.4};
    s.rest_x_m = {-0.05, 0.05, 0};
    s.rest_y_m = {0.05, 0.05, 0.13};
    s.joints = {{-1, 0}, {-1, 1}, {0, 2}, {1, 2}};
    return s;
}

Study study_of(const SpecimenStructure& built)
{
    Study study;
    study.realizations = 1;
    study.structure = built.structure;
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 4.8e6;
    study.contact.friction = 0.6;
    study.excitation.frequency_hz = 3;
    study.excitation.pga_m_s2 = 3;
    return study;
}

double size_of(const Cause& cause)
{
    const std::string& m = cause.mechanism;
    return m == "joint_friction"  ? 0.7
           : m == "stribeck"      ? 0.8
           : m == "dowel"         ? 2e4
           : m == "drag"          ? 0.3
           : m == "friction_wear" ? 0.5
                                  : 1e-3;
}

class CauseModel : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Specimens, CauseModel, testing::Bool(),
                         [](const auto& with) { return with.param ? "colonnade" : "column"; });

TEST_P(CauseModel, TheStudyRunsWhatWasFitted)
{
    const Specimen specimen = GetParam() ? small_colonnade() : sample_specimen();
    const SpecimenStructure built = build_specimen(specimen);
    CampaignScales scales;
    scales.time_s = 0.1;
    std::set<std::string> mechanisms;
    std::vector<Cause> causes = balance_causes(specimen, scales);
    causes.push_back({"table_pitch", "base", "rotation_rad_s2_m", "rad s2/m", 0});
    causes.push_back({"vertical_motion", "base", "ratio", "", 0});
    causes.push_back({"adhesion", "joint 1", "adhesion_n_m", "N/m", 0, 1});
    Cause yielding{"dowel", "joint 1", "yield_n", "N", 0, 1};
    yielding.fixed = 2e-4; // the slip at which it yields
    causes.push_back(yielding);
    causes.push_back({"rate_damping", "joint 1", "rate_s_m", "s/m", 0, 1});
    for (const char* parameter : {"stiffness_n_m", "dashpot_n_s_m", "force_n", "turning_dashpot_n_m_s"})
        causes.push_back({"tie", "block 1", parameter, "", 0, -1, 1});
    for (const Cause& cause : causes) {
        SCOPED_TRACE(cause.label());
        mechanisms.insert(cause.mechanism);
        const SizedCause sized{cause, size_of(cause)};
        const Study baseline = study_of(built);
        const Realization plain = Sampler(baseline, nullptr).realization(0);
        Realization applied = plain;
        apply_cause(sized, built, applied);
        Study extended = baseline;
        add_mechanism(sized, built, extended);
        ASSERT_EQ(extended.mechanisms.size(), 1u);
        const Realization sampled = Sampler(extended, nullptr).realization(0);

        EXPECT_TRUE(sampled.with_mechanisms || cause.mechanism == "joint_friction");
        bool changed = applied.base != plain.base;
        ASSERT_EQ(sampled.joints.size(), applied.joints.size());
        for (std::size_t j = 0; j < applied.joints.size(); ++j) {
            const JointMechanisms &a = applied.joints[j].mechanisms, &b = sampled.joints[j].mechanisms;
            EXPECT_DOUBLE_EQ(applied.joints[j].friction, sampled.joints[j].friction) << j;
            EXPECT_DOUBLE_EQ(a.dynamic_ratio, b.dynamic_ratio) << j;
            EXPECT_EQ(a.stribeck_velocity_m_s, b.stribeck_velocity_m_s) << j;
            EXPECT_EQ(a.wear_per_m, b.wear_per_m) << j;
            EXPECT_EQ(a.adhesion_n_m, b.adhesion_n_m) << j;
            EXPECT_EQ(a.dowel_stiffness_n_m, b.dowel_stiffness_n_m) << j;
            EXPECT_EQ(a.dowel_yield_n, b.dowel_yield_n) << j;
            EXPECT_EQ(a.dowel_gap_m, b.dowel_gap_m) << j;
            EXPECT_EQ(a.chip_left_m, b.chip_left_m) << j;
            EXPECT_EQ(a.chip_right_m, b.chip_right_m) << j;
            EXPECT_EQ(a.corner_wear_m_rad, b.corner_wear_m_rad) << j;
            EXPECT_EQ(a.rate_s_m, b.rate_s_m) << j;
            changed =
                changed || !(a == plain.joints[j].mechanisms) || applied.joints[j].friction != plain.joints[j].friction;
        }
        ASSERT_EQ(sampled.blocks.size(), applied.blocks.size());
        for (std::size_t b = 0; b < applied.blocks.size(); ++b) {
            if (applied.blocks[b].mass_kg > 0) {
                EXPECT_EQ(applied.blocks[b].mechanisms, sampled.blocks[b].mechanisms) << b;
            }
            changed = changed || !(applied.blocks[b].mechanisms == plain.blocks[b].mechanisms);
        }
        EXPECT_EQ(applied.base, sampled.base);
        EXPECT_TRUE(changed);
        if (cause.parameter == "yield_n") { // the force at the end of the elastic slip is the yield force
            const JointMechanisms& dowel = applied.joints[static_cast<std::size_t>(built.bed[1])].mechanisms;
            EXPECT_DOUBLE_EQ(dowel.dowel_stiffness_n_m * 2e-4, dowel.dowel_yield_n);
            EXPECT_EQ(dowel.dowel_yield_n, sized.size);
        }
    }
    EXPECT_EQ(mechanisms.size(), 13u); // the eight of the balance and five more
}

/// The distortion as `TableDistortion` defines it, of a sine of unit amplitude at a phase.
double distorted_sine(const TableDistortion& d, double gain, double psi)
{
    const double z = std::sin(psi);
    if (d.polynomial)
        return gain * z + d.size[0] * z * z + d.size[1] * z * (z * z - 0.75);
    return gain * z + d.size[0] * std::sin(2 * psi) + d.size[1] * std::cos(2 * psi) + d.size[2] * std::sin(3 * psi) +
           d.size[3] * std::cos(3 * psi);
}

TEST(ExtendedStudy, HasTheDistortionOfTheBase)
{
    constexpr double frequency_hz = 2, amplitude_m = 0.01, dt = 0.001, gain = 1.05;
    constexpr double omega = 2 * std::numbers::pi * frequency_hz;
    std::vector<double> acceleration;
    for (int i = 0; i <= 12000; ++i)
        acceleration.push_back(-amplitude_m * omega * omega * std::sin(omega * dt * i));
    Motion motion = motion_of(acceleration, dt);
    for (std::size_t i = 0; i < motion.displacement_m.size(); ++i) { // it comes with its velocity
        motion.velocity_m_s[i] += amplitude_m * omega;
        motion.displacement_m[i] += amplitude_m * omega * dt * static_cast<double>(i);
    }
    motion.predominant_frequency_hz = frequency_hz;

    for (const bool polynomial : {true, false}) {
        TableDistortion found;
        found.polynomial = polynomial;
        found.size = polynomial ? std::vector<double>{-0.11, 0.06} : std::vector<double>{0.05, -0.03, 0.02, 0.01};
        Study extended = study_of(build_specimen(sample_specimen()));
        extended.excitation.kind = ExcitationKind::table;
        extended.mechanisms = {neutral_spec(Mechanism::sensor_gain, 0.6)};
        extended.mechanisms.front().values[0] = gain;
        add_distortion(found, gain, extended);
        ASSERT_EQ(extended.mechanisms.size(), 2u);
        EXPECT_EQ(extended.mechanisms.front().mechanism, Mechanism::harmonic_distortion);
        const Realization r = Sampler(extended, &motion).realization(0);
        ASSERT_TRUE(r.motion);
        EXPECT_EQ(r.change.gain, gain);
        // away from the ends, where the overtones rise and fall: accelerations, by second differences of the definition
        for (double t = 4; t < 8; t += 0.013) {
            const double psi = omega * t, h = 1e-3;
            const double bend = (distorted_sine(found, gain, psi + h) - 2 * distorted_sine(found, gain, psi) +
                                 distorted_sine(found, gain, psi - h)) /
                                (h * h);
            const double at = t / dt;
            const auto i = static_cast<std::size_t>(std::lround(at));
            EXPECT_NEAR(gain * r.motion->acceleration_m_s2[i] / (amplitude_m * omega * omega), bend,
                        0.015) // the transform of a sine that is cut at both ends
                << polynomial << ' ' << t;
        }
    }
}

/// Three blocks that ride on a table whose motion has a second harmonic and a vertical part, three motions; nothing
/// else.
Campaign riding(double second, double vertical)
{
    Campaign campaign;
    campaign.specimen = sample_specimen();
    const Specimen& s = campaign.specimen;
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    for (int r = 0; r < 4; ++r) {
        const double amplitude_m = 0.003 + 0.001 * r, omega = 2 * std::numbers::pi * (3 - 0.25 * r);
        const auto wave = [&](double t, int order) {
            const auto ramp = [](double x) {
                const double c = std::clamp(x, 0.0, 1.0);
                return c * c * c * (10 - 15 * c + 6 * c * c);
            };
            return amplitude_m * ramp((t - 0.3) / 0.6) * ramp((3.7 - t) / 0.6) * std::sin(order * omega * (t - 0.3));
        };
        MeasuredRun run;
        run.name = "00" + std::to_string(r);
        run.motion_id = r;
        run.kind = "harmonic";
        run.rate_hz = 500;
        run.base_displacement_m.noise_sd = 2e-5;
        run.blocks.x_m.noise_sd = run.blocks.y_m.noise_sd = 5e-5;
        run.blocks.theta_rad.noise_sd = 1e-3;
        for (int i = 0; i <= 2000; ++i) {
            const double t = i / 500.0, x = wave(t, 1) + second * wave(t, 2);
            run.time_s.push_back(t);
            run.base_displacement_m.values.push_back(wave(t, 1) + 2e-5 * normal(random));
            for (std::size_t b = 0; b < s.rest_x_m.size(); ++b) {
                run.blocks.x_m.values.push_back(s.rest_x_m[b] + x + 5e-5 * normal(random));
                run.blocks.y_m.values.push_back(s.rest_y_m[b] + vertical * x + 5e-5 * normal(random));
                run.blocks.theta_rad.values.push_back(1e-3 * normal(random));
            }
        }
        campaign.runs.push_back(std::move(run));
    }
    return campaign;
}

TEST_P(CauseModel, ADashpotOfOneJointIsAtTheEndsOfItsFaceInAStudy)
{
    const SpecimenStructure built = build_specimen(GetParam() ? small_colonnade() : sample_specimen());
    const Cause dashpot{"face_damping", "joint 1", "dashpot_n_s_m", "N s/m", 0, 1};
    const Study baseline = study_of(built);
    const Realization plain = Sampler(baseline, nullptr).realization(0);
    Realization applied = plain;
    apply_cause({dashpot, 40}, built, applied);
    Study extended = baseline;
    add_mechanism({dashpot, 40}, built, extended);
    // a study has one damping ratio: the strength is that of all joints
    const Realization sampled = Sampler(extended, nullptr).realization(0);
    const auto here = static_cast<std::size_t>(built.bed[1]);
    for (std::size_t j = 0; j < plain.joints.size(); ++j) {
        EXPECT_EQ(sampled.joints[j].mechanisms.face_damping, j == here ? 1 : 0) << j;
        EXPECT_EQ(applied.joints[j].normal_damping_n_s_m, plain.joints[j].normal_damping_n_s_m + (j == here ? 40 : 0))
            << j;
    }
    EXPECT_DOUBLE_EQ(applied.joints[here].mechanisms.face_damping, 40 / applied.joints[here].normal_damping_n_s_m);
}

TEST(ExtendedStudy, HasWhatTheBaseDoesAndRuns)
{
    const MeasuredFolder folder("extended");
    Campaign campaign = riding(0.05, 0.12);
    campaign.source = (folder / "campaign.h5").string();
    write_campaign(campaign, campaign.source);
    DiagnosisOptions options;
    options.plan = EnsemblePlan::with(0); // only direct tests name causes
    options.run = {best_isa(), 1};
    Observer observer;
    const std::optional<Diagnosis> d = diagnose(
        campaign, default_study(campaign), options, [](const std::string&) {}, observer);
    ASSERT_TRUE(d);
    ASSERT_EQ(d->verdict, Verdict::named) << d->verdict_text;
    for (const Missing& missing : d->missing)
        EXPECT_EQ(missing.what.find("extended study"), std::string::npos) << missing.why;

    const Study extended = parse_study(d->extended_study.value(), "extended.toml");
    const auto value = [&](Mechanism mechanism, std::size_t parameter) {
        for (const MechanismSpec& spec : extended.mechanisms)
            if (spec.mechanism == mechanism)
                return spec.values[parameter];
        return std::numeric_limits<double>::quiet_NaN();
    };
    EXPECT_NEAR(value(Mechanism::harmonic_distortion, 0), 0.05, 0.004);
    EXPECT_NEAR(value(Mechanism::harmonic_distortion, 1), 0, 0.004);
    EXPECT_NEAR(value(Mechanism::harmonic_distortion, 2), 0, 0.004);
    EXPECT_NEAR(value(Mechanism::vertical_motion, 0), 0.12, 0.005);

    // it runs, and what shakes it is the table as it was
    const Motion base = read_base_table(extended.excitation.file, extended.excitation.run);
    const Experiment experiment(extended, {.record = base});
    const Realization r = experiment.sampler().realization(0);
    EXPECT_NEAR(r.base.vertical_ratio, 0.12, 0.005);
    RunPlan plan;
    plan.total = extended.realizations;
    int valid = 0;
    plan.sink = [&](const Realization&, const Outcome& o) { valid += o.state != State::invalid; };
    run_ensemble(experiment, options.run, plan, observer);
    EXPECT_EQ(valid, static_cast<int>(extended.realizations));
}

} // namespace
} // namespace stylobate
