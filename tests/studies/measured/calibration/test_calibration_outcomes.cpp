/// Calibration from a table of outcomes: it finds what the outcomes were made with, and refuses what says too little.

#include "tests/io/measured/measured_samples.hpp"

#include "ensemble/sampling/sampler.hpp"
#include "io/measured/measured_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/calibration/calibration_evidence.hpp"
#include "studies/measured/calibration/outcome_tests.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {
namespace {

/// A column of three drums on a fixed one, shaken by one cycle of a sine.
const std::string column = R"(
[study]
kind = "single"
seed = 5
[structure]
kind = "column"
blocks = 4
fixed_blocks = 1
drum_width_m = 0.05
drum_height_m = 0.05
depth_m = 0.05
drum_mass_kg = 0.4
[contact]
normal_stiffness_n_m2 = 2e7
tangential_stiffness_n_m = 1e6
normal_damping_ratio = 0.1
tangential_damping_ratio = 0.1
friction = 0.7
[excitation]
kind = "full_sine"
frequency_hz = 3
pga_m_s2 = 4
[perturbation]
friction = { distribution = "normal", cov = 0.05, per = "joint" }
drum_width = { distribution = "normal", cov = 0.01, per = "block" }
)";

Study study_with(const std::vector<std::string>& settings = {})
{
    return parse_study(column, "column.toml", settings);
}

/// What a laboratory writes down: each of 20 motions three times, the peak velocity over peak acceleration of a sine of
/// one cycle, 1 / (pi f), and who fell. @param truth settings of the study that is in the laboratory
std::string table_of(const std::vector<std::string>& truth)
{
    std::string csv = "pga_m_s2,pgv_over_pga_s,toppled\n";
    for (const double frequency_hz : {2.0, 3.5, 5.0, 6.0, 7.0})
        for (const double pga_m_s2 : {4.5, 7.5, 10.5, 14.0}) {
            std::vector<std::string> settings = truth;
            settings.push_back(fmt::format("excitation.frequency_hz={}", frequency_hz));
            settings.push_back(fmt::format("excitation.pga_m_s2={}", pga_m_s2));
            settings.push_back(fmt::format("study.seed={}", 900 + csv.size())); // other draws than the calibration's
            settings.push_back("study.realizations=3");
            const Study study = study_with(settings);
            RunPlan plan;
            plan.total = study.realizations;
            plan.sink = [&](const Realization&, const Outcome& o) {
                csv += fmt::format("{},{:.10f},{}\n", pga_m_s2, 1 / (std::numbers::pi * frequency_hz),
                                   o.state == State::collapsed ? "yes" : "no");
            };
            Observer observer;
            run_ensemble(Experiment(study), {best_isa(), 1}, plan, observer);
        }
    return csv;
}

CalibrationOptions brief(const Study& start, const std::string& key)
{
    CalibrationOptions options;
    options.keys = {fit_key(start, key)};
    options.scan = 24;
    options.refine = 10;
    options.surface = 16;
    options.profile = 9;
    options.ensemble = 16;
    return options;
}

Calibration calibrated(const OutcomeTable& table, const Study& start, const CalibrationOptions& options)
{
    Observer observer;
    Calibration found = calibrate(table, start, options, {best_isa(), 2}, observer);
    EXPECT_TRUE(found.complete);
    return found;
}

void expect_found(const char* file, const std::vector<std::string>& truth, const std::string& key, double value,
                  double within)
{
    const MeasuredFolder folder(file);
    write_content(folder / "outcomes.csv", table_of(truth));
    const OutcomeTable table = read_outcomes(folder / "outcomes.csv");
    ASSERT_EQ(table.rows.size(), 60u);
    const Study start = study_with();
    const Calibration found = calibrated(table, start, brief(start, key));
    EXPECT_TRUE(found.from_outcomes);
    EXPECT_TRUE(found.notes.empty()) << found.notes.front();
    const FormCalibration& form = found.forms.front();
    const FittedParameter& p = form.parameters.front();
    SCOPED_TRACE(fmt::format("{} = {} ({} to {}), is {}", p.key, p.value, p.low, p.high, value));
    EXPECT_LT(std::fabs(std::log(p.value / value)), within);
    EXPECT_LE(p.low, value);
    EXPECT_GE(p.high, value);
    EXPECT_TRUE(p.bounded_below && p.bounded_above);
    EXPECT_TRUE(p.effective && !p.determined) << "found by the search: a value of the model";
    EXPECT_GT(form.score, form.nominal_score + 5);
    EXPECT_GT(form.held_out.total, 0) << "tests that were left out are predicted better than by the start";
    EXPECT_EQ(form.held_out.groups, 6U) << "20 motions in six folds";
    ASSERT_EQ(form.runs.size(), 60u);
    EXPECT_EQ(form.runs[0].run, "line 2");
    EXPECT_EQ(form.runs[3].motion_id, 1);
}

TEST(CalibrationFromOutcomesStatistics, FindsTheFriction)
{
    expect_found("friction", {"contact.friction=0.3"}, "contact.friction=0.15:0.9", 0.3, 0.15);
}

TEST(CalibrationFromOutcomesStatistics, FindsTheWidthOfTheDrums)
{
    expect_found("width", {"structure.drum_width_m=0.042"}, "structure.drum_width_m=0.03:0.07", 0.042, 0.05);
}

TEST(CalibrationFromOutcomesStatistics, SaysWhereAllEndedAlike)
{
    const MeasuredFolder folder("alike");
    write_content(folder / "outcomes.csv", "pga_m_s2,frequency_hz,fell\n1,3,0\n2,3,0\n3,,0\n");
    const Study start = study_with();
    CalibrationOptions options = brief(start, "contact.friction=0.15:0.9");
    options.scan = 4;
    options.refine = 4;
    options.surface = 4;
    options.profile = 3;
    const Calibration found = calibrated(read_outcomes(folder / "outcomes.csv"), start, options);
    ASSERT_FALSE(found.notes.empty());
    EXPECT_NE(found.notes.front().find("all stood"), std::string::npos) << found.notes.front();
}

TEST(OutcomeTests, RowsBecomeTheStudysMotions)
{
    const MeasuredFolder folder("rows");
    std::string samples = "time_s,acceleration_m_s2\n";
    for (int i = 0; i <= 200; ++i)
        samples += fmt::format("{},{}\n", 0.005 * i, 2 * std::sin(0.02 * std::numbers::pi * i));
    write_content(folder / "base.csv", samples);

    // of a study with a sine of one cycle: peak velocity over peak acceleration 1 / (pi f)
    write_content(folder / "a.csv",
                  fmt::format("pga_g,frequency_hz,pgv_over_pga_s,fell\n0.5,,{},1\n0.5,,{},0\n1,4,,1\n1,,,1\n",
                              1 / (2.5 * std::numbers::pi), 1 / (2.5 * std::numbers::pi)));
    const OutcomeTests a = outcome_tests(read_outcomes(folder / "a.csv"), study_with());
    ASSERT_EQ(a.shakings.size(), 3u); // the first two are one motion
    ASSERT_EQ(a.tests.size(), 4u);
    EXPECT_EQ(a.tests[1].shaking, 0u);
    EXPECT_NEAR(a.shakings[0].excitation.frequency_hz, 2.5, 1e-4);
    EXPECT_DOUBLE_EQ(a.shakings[0].excitation.pga_m_s2, 0.5 * 9.80665);
    EXPECT_EQ(a.shakings[1].excitation.frequency_hz, 4);
    EXPECT_EQ(a.shakings[2].excitation.frequency_hz, 3); // the study's

    // an abrupt sine keeps its frequency and its amplitude
    const Study harmonic = study_with({"excitation.kind=harmonic", "excitation.cycles=8"});
    write_content(folder / "b.csv", "amplitude_mm,frequency_hz,fell\n10,2,1\n");
    const OutcomeTests b = outcome_tests(read_outcomes(folder / "b.csv"), harmonic);
    EXPECT_EQ(b.shakings[0].excitation.frequency_hz, 2);
    EXPECT_NEAR(b.shakings[0].excitation.pga_m_s2, 0.01 * std::pow(4 * std::numbers::pi, 2), 1e-12);
    EXPECT_EQ(b.shakings[0].excitation.cycles, 8);

    // files lie beside the table; one may be scaled
    const Study table = study_with({"excitation={kind=\"table\",file=\"base.csv\"}"});
    write_content(folder / "c.csv", "motion_file,pga_m_s2,fell\nbase.csv,,1\nbase.csv,3,1\n");
    const OutcomeTests c = outcome_tests(read_outcomes(folder / "c.csv"), table);
    ASSERT_EQ(c.shakings.size(), 2u);
    EXPECT_EQ(c.shakings[0].motion, c.shakings[1].motion);
    EXPECT_NEAR(c.shakings[0].motion->pga_m_s2, 2, 1e-9);
    EXPECT_EQ(c.shakings[0].excitation.pga_m_s2, 0);
    EXPECT_EQ(c.shakings[1].excitation.pga_m_s2, 3);
}

/// The samples have two cycles of 2 sin(4 pi t), whose velocity (1 - cos(4 pi t)) / (2 pi) has a peak of 1 / pi.
TEST(OutcomeTests, ARecordIsStretchedToTheFrequencyOfTheRow)
{
    const MeasuredFolder folder("stretched");
    std::string samples = "time_s,acceleration_m_s2\n";
    for (int i = 0; i <= 200; ++i)
        samples += fmt::format("{},{}\n", 0.005 * i, 2 * std::sin(0.02 * std::numbers::pi * i));
    write_content(folder / "base.csv", samples);
    const Study study =
        study_with({fmt::format("excitation={{kind=\"table\",file=\"{}\"}}", (folder / "base.csv").string())});
    write_content(folder / "t.csv",
                  "pga_m_s2,frequency_hz,pgv_over_pga_s,fell\n3,1,,1\n3,4,,1\n3,,0.477465,1\n3,,,1\n");
    const OutcomeTests found = outcome_tests(read_outcomes(folder / "t.csv"), study);
    ASSERT_EQ(found.shakings.size(), 4U);
    EXPECT_NEAR(found.shakings[0].excitation.time_scale, 2, 0.02) << "2 Hz in a row of 1 Hz";
    EXPECT_NEAR(found.shakings[1].excitation.time_scale, 0.5, 0.005);
    EXPECT_NEAR(found.shakings[2].excitation.time_scale, 3, 0.003) << "0.477 s over 1 / (2 pi)";
    EXPECT_EQ(found.shakings[3].excitation.time_scale, 1);
}

/// Shares of falls in ensembles of the study's seed + k for shaking k: the mean (falls + 1/2) / (n + 1) of Jeffreys'
/// posterior. Four equal shakings of which some fall, and a weak one.
TEST(OutcomeEvidence, ScoresAreLogarithmsOfTheSharesOfItsEnsembles)
{
    constexpr std::uint64_t n = 12;
    const std::vector<double> pga_m_s2 = {7.5, 7.5, 7.5, 7.5, 0.5};
    const auto study_of = [&](std::size_t k, std::uint64_t seed) {
        return study_with({"excitation.frequency_hz=6", fmt::format("excitation.pga_m_s2={}", pga_m_s2[k]),
                           fmt::format("study.realizations={}", n), fmt::format("study.seed={}", seed)});
    };
    const auto falls = [&](std::size_t k, std::uint64_t seed) {
        Study study = study_of(k, seed);
        study.outcome.follow = Follow::collapse;
        double fallen = 0;
        RunPlan plan;
        plan.total = n;
        plan.sink = [&](const Realization&, const Outcome& o) { fallen += o.state == State::collapsed; };
        Observer observer;
        run_ensemble(Experiment(study), {best_isa(), 1}, plan, observer);
        return fallen;
    };
    OutcomeTests tests;
    for (std::size_t k = 0; k < 5; ++k) {
        tests.shakings.push_back({study_of(k, 5).excitation, nullptr});
        tests.tests.push_back({2 * k, k, true});
        tests.tests.push_back({2 * k + 1, k, false});
    }
    const Study study = study_with(); // of seed 5
    const auto evidence = outcome_evidence(tests, study.perturbations, n);
    ASSERT_TRUE(evidence);
    EXPECT_EQ(evidence->runs().back(), 9U);
    Observer observer;
    ASSERT_TRUE(evidence->add({study}, {best_isa(), 1}, observer));
    const std::vector<double> scores = evidence->own_scores(0, {});
    ASSERT_EQ(scores.size(), 10U);
    for (std::size_t k = 0; k < 5; ++k) {
        const double fallen = falls(k, 5 + k);
        EXPECT_NEAR(scores[2 * k], std::log((fallen + 0.5) / (n + 1)), 1e-12) << k;
        EXPECT_NEAR(scores[2 * k + 1], std::log((n - fallen + 0.5) / (n + 1)), 1e-12) << k;
    }
    EXPECT_NE(scores[0], scores[2]) << "else the seeds are not seen";
    EXPECT_NE(scores[2], scores[4]);
    EXPECT_NEAR(scores[8], std::log(0.5 / 13), 1e-12) << "none falls under the weak one";
    EXPECT_EQ(evidence->cost().simulations, 5 * n);
}

TEST(Tolerances, AreThoseOfTheSpecimenAndFivePercentOfFriction)
{
    Specimen specimen;
    specimen.width_tolerance = 0.02;
    specimen.placement_tolerance_m = 0;
    specimen.mass_tolerance = 0.01;
    const std::vector<Perturbation> drawn = tolerances(specimen);
    ASSERT_EQ(drawn.size(), 3U) << "what is placed exactly is not drawn";
    EXPECT_EQ(drawn[0].quantity, Quantity::friction);
    EXPECT_EQ(drawn[0].per, Per::joint);
    EXPECT_EQ(drawn[0].cov, 0.05);
    EXPECT_EQ(drawn[1].quantity, Quantity::drum_width);
    EXPECT_EQ(drawn[1].cov, 0.02);
    EXPECT_EQ(drawn[2].quantity, Quantity::density);
    EXPECT_EQ(drawn[2].cov, 0.01);
}

TEST(OutcomeTests, WhatSaysTooLittleIsRefused)
{
    const MeasuredFolder folder("refused");
    const auto expect_refused = [&](const std::string& text, const std::vector<std::string>& settings,
                                    const std::string& part) {
        write_content(folder / "t.csv", text);
        const Study study = study_with(settings);
        Observer observer;
        const std::string message = refusal([&] {
            calibrate(read_outcomes(folder / "t.csv"), study, brief(study, "contact.friction=0.15:0.9"),
                      {best_isa(), 1}, observer);
        });
        EXPECT_NE(message.find("t.csv"), std::string::npos) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect_refused("fell,pga_m_s2\n", {}, "a calibration is not possible");
    expect_refused("fell,amplitude_m,frequency_hz\n1,0.01,2\n", {}, "t.csv:2: an amplitude and a frequency are those");
    expect_refused("fell,pga_m_s2\n1,3\n", {"excitation={kind=\"none\",duration_s=1}"},
                   "does not define the base motion");
    expect_refused("fell,motion_file\n1,absent.at2\n", {}, "t.csv:2: its motion cannot be used");
    expect_refused("fell,pga_m_s2,pgv_over_pga_s\n1,3,1e-9\n", {}, "outside [0.001, 1000]");
}

} // namespace
} // namespace stylobate
