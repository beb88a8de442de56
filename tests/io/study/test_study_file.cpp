/// The study file: defaults, every kind of mistake with its line and the words that help, settings.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "tests/io/study/study_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace stylobate {
namespace {

Lines single_lines(const std::string& excitation = "kind = \"none\"\nduration_s = 2")
{
    auto lines = surface_lines();
    lines[2] = "kind = \"single\"";
    lines[15] = excitation;
    lines[16] = lines[17] = lines[18] = lines[19] = "";
    return lines;
}

Study read(const Lines& lines, const std::vector<std::string>& settings = {})
{
    return parse_study(joined(lines), "temple.toml", settings);
}

/// Expects a refusal at `place` whose message has all the words.
void expect_refused(const std::string& text, const std::string& place, const std::vector<std::string>& words,
                    const std::vector<std::string>& settings = {})
{
    try {
        parse_study(text, "temple.toml", settings);
        ADD_FAILURE() << "accepted; expected a refusal at " << place << "\n" << text;
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.substr(0, place.size() + 2), place + ": ") << message;
        for (const auto& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in:\n" << message;
    }
}

/// One line of the surface study replaced, and the refusal at that line.
void expect_line_refused(int number, const std::string& line, const std::vector<std::string>& words)
{
    auto lines = surface_lines();
    lines[number] = line;
    expect_refused(joined(lines), "temple.toml:" + std::to_string(number), words);
}

TEST(StudyFile, ReadsEveryValueAndFillsInTheDefaults)
{
    const auto study = read(surface_lines());
    EXPECT_EQ(study.kind, StudyKind::surface);
    EXPECT_EQ(study.seed, 1u);
    EXPECT_EQ(study.realizations, 8u);
    EXPECT_EQ(study.total(), 8u * 15u);
    EXPECT_EQ(study.structure, equal_column(7, 1, 0.048, 0.029, 0.048, 0.1355));
    EXPECT_EQ(study.structure.gravity_m_s2, 9.81);
    EXPECT_EQ(study.contact.normal_stiffness_n_m2, 1e8);
    EXPECT_DOUBLE_EQ(study.contact.tangential_stiffness_n_m, 4.8e6); // K_N times the width
    EXPECT_EQ(study.contact.normal_damping_ratio, 0.1);
    EXPECT_EQ(study.contact.tangential_damping_ratio, 0.1);
    EXPECT_FALSE(study.contact.normal_damping_n_s_m);
    EXPECT_FALSE(study.contact.tangential_damping_n_s_m);
    EXPECT_EQ(study.contact.damping_per, DampingPer::contact);
    EXPECT_EQ(study.contact.friction, 0.68);
    EXPECT_EQ(study.excitation.kind, ExcitationKind::harmonic);
    EXPECT_EQ(study.excitation.start, HarmonicEdge::smooth);
    EXPECT_EQ(study.excitation.end, HarmonicEdge::smooth);
    EXPECT_EQ(study.excitation.ramp_cycles, 2);
    EXPECT_EQ(study.excitation.cycles, 8);
    EXPECT_EQ(study.excitation.phase_rad, 0);
    EXPECT_FALSE(study.excitation.tail_s);
    ASSERT_TRUE(study.surface);
    EXPECT_EQ(study.surface->frequency_hz.spacing, Spacing::log);
    EXPECT_EQ(study.surface->frequency_hz.count, 5);
    EXPECT_EQ(study.surface->pga_m_s2.spacing, Spacing::linear);
    ASSERT_EQ(study.perturbations.size(), 1u);
    EXPECT_EQ(study.perturbations[0].quantity, Quantity::friction);
    EXPECT_EQ(study.perturbations[0].distribution, DistributionKind::normal);
    EXPECT_EQ(study.perturbations[0].per, Per::joint);
    EXPECT_EQ(study.perturbations[0].cov, 0.10);
    EXPECT_EQ(study.perturbations[0].min, 0.3);
    EXPECT_FALSE(study.perturbations[0].max);
    EXPECT_EQ(study.initial.tilt_rad, 0);
    EXPECT_EQ(study.output.trajectory_rate_hz, 260); // 100 in 2 pi / p of a drum, p = 16.198 rad/s
    EXPECT_EQ(study.outcome.collapse_height_fraction, 0.6);
    EXPECT_EQ(study.run.precision, Precision::double_);
    EXPECT_EQ(study.run.step_fraction, 0.9);
    EXPECT_EQ(study.run.step_bound, StepBasis::block);
    EXPECT_FALSE(study.run.step_s);
    EXPECT_FALSE(study.run.allow_step_above_bound);
    EXPECT_EQ(study.run.max_invalid_fraction, 0.001);
}

TEST(StudyFile, AxesRunFromEndToEnd)
{
    const auto surface = read(surface_lines()).surface.value();
    for (int i = 0; i < 5; ++i) // 0.5 to 8 in five: each twice the last
        EXPECT_DOUBLE_EQ(surface.frequency_hz.value(i), 0.5 * (1 << i));
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(surface.pga_m_s2.value(i), 1 + 4 * i);
    const Axis odd{0.1, 0.7, 13, Spacing::log};
    EXPECT_EQ(odd.value(0), 0.1);
    EXPECT_EQ(odd.value(12), 0.7);
    const Axis one{3, 3, 1, Spacing::log};
    EXPECT_EQ(one.value(0), 3);
}

TEST(StudyFile, TheMassMayComeFromTheDensity)
{
    auto lines = surface_lines();
    lines[10] = "density_kg_m3 = 2000";
    EXPECT_DOUBLE_EQ(read(lines).structure.columns[0].drums[3].mass_kg, 2000 * 0.048 * 0.029 * 0.048);
}

TEST(StudyFile, ReadsTheOtherKindsOfExcitation)
{
    EXPECT_EQ(read(single_lines()).excitation.duration_s, 2);
    EXPECT_EQ(read(single_lines()).realizations, 8u);

    auto pulse = read(single_lines("kind = \"half_sine\"\nfrequency_hz = 2\npga_m_s2 = 3\ntail_s = 0"));
    EXPECT_EQ(pulse.excitation.kind, ExcitationKind::half_sine);
    EXPECT_EQ(pulse.excitation.frequency_hz, 2);
    EXPECT_EQ(pulse.excitation.pga_m_s2, 3);
    EXPECT_EQ(pulse.excitation.tail_s, 0);

    auto record =
        read(single_lines("kind = \"record\"\nfile = \"no/such/file.at2\"\nunit = \"gal\"\ncomponent = \"2\"\n"
                          "scale_to_pga_m_s2 = 4\ntime_scale = 0.5\nbaseline = false"))
            .excitation;
    EXPECT_EQ(record.file, "no/such/file.at2");
    EXPECT_EQ(record.unit, "cm/s2"); // gal by its other name
    EXPECT_EQ(record.component, "2");
    EXPECT_EQ(record.pga_m_s2, 4);
    EXPECT_EQ(record.time_scale, 0.5);
    EXPECT_FALSE(record.baseline);
}

TEST(StudyFile, ReadsEveryPerturbation)
{
    auto lines = surface_lines();
    lines[21] = R"(
phase = { distribution = "uniform" }
tilt = { distribution = "normal", sd_rad = 0.001 }
density = { distribution = "lognormal", sigma_ln = 0.1, per = "structure" }
drum_offset = { distribution = "normal", sd_m = 0.0002 }
drum_height = { distribution = "uniform", from = 0.028, to = 0.030 }
drum_width = { distribution = "normal", sd_m = 0.0002 }
damping_ratio = { distribution = "log_uniform", from = 0.05, to = 0.5 }
tangential_stiffness = { distribution = "normal", sd_n_m = 1e5 }
normal_stiffness = { distribution = "lognormal", sigma_ln = 0.7, max = 5e8 }
friction = { distribution = "normal", sd = 0.05, per = "structure" })";
    const auto p = read(lines).perturbations;
    ASSERT_EQ(p.size(), 10u);
    const Per want_per[] = {Per::structure, Per::structure, Per::structure, Per::structure, Per::block,
                            Per::block,     Per::block,     Per::structure, Per::structure, Per::structure};
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(p[i].quantity, static_cast<Quantity>(i)); // in the order of the enumeration, not of the file
        EXPECT_EQ(p[i].per, want_per[i]) << to_string(p[i].quantity);
    }
    EXPECT_EQ(p[0].sd, 0.05);
    EXPECT_EQ(p[1].sigma_ln, 0.7);
    EXPECT_EQ(p[1].max, 5e8);
    EXPECT_EQ(p[2].sd, 1e5);
    EXPECT_EQ(p[3].from, 0.05);
    EXPECT_EQ(p[3].to, 0.5);
    EXPECT_EQ(p[5].to, 0.030);
    EXPECT_EQ(p[9].from, 0);
    EXPECT_DOUBLE_EQ(p[9].to, 2 * std::acos(-1.0));
}

TEST(StudyFile, RefusesMisspeltKeys)
{
    expect_line_refused(7, "drum_widht_m = 0.048",
                        {"unknown key structure.drum_widht_m", "Did you mean drum_width_m?"});
    expect_line_refused(4, "[strcture]", {"unknown section strcture", "Did you mean structure?"});
    expect_line_refused(3, "realisations = 8", {"study.realisations", "Did you mean realizations?"});
    expect_line_refused(13, "zebra = 1", {"unknown key contact.zebra", "Known keys of contact:", "friction"});
    expect_line_refused(18, "frequency_hz = { from = 0.5, to = 8, cuont = 5 }",
                        {"surface.frequency_hz.cuont", "Did you mean count?"});
    expect_line_refused(21, "frictoin = { distribution = \"normal\", cov = 0.1 }",
                        {"perturbation.frictoin", "Did you mean friction?"});
}

TEST(StudyFile, RefusesMissingAndWrongUnits)
{
    expect_line_refused(7, "drum_width = 0.048",
                        {"structure.drum_width", "Did you mean drum_width_m? The unit is part"});
    expect_line_refused(
        7, "drum_width_mm = 48",
        {"structure.drum_width_mm", "Did you mean drum_width_m? The unit is part of the key. Convert the value"});
    expect_line_refused(12, "normal_stiffness = 1e8", {"Did you mean normal_stiffness_n_m2?"});
    expect_line_refused(19, "pga_g = { from = 0.1, to = 1, count = 3 }", {"Did you mean pga_m_s2?"});
    expect_line_refused(21, "drum_width = { distribution = \"normal\", sd = 0.0002 }",
                        {"perturbation.drum_width.sd", "Did you mean sd_m? The unit is part of the key."});
    expect_line_refused(21, "tilt = { distribution = \"normal\", sd_deg = 0.1 }", {"Did you mean sd_rad?"});
}

TEST(StudyFile, RefusesWrongTypes)
{
    expect_line_refused(5, "blocks = \"seven\"", {"structure.blocks = \"seven\"", "not a whole number", "[1, 200]"});
    expect_line_refused(5, "blocks = 6.5", {"structure.blocks = 6.5", "not a whole number"});
    expect_line_refused(7, "drum_width_m = \"0.048\"", {"\"0.048\" is a string, not a number", "(0, 40]", "metres"});
    expect_line_refused(7, "drum_width_m = true", {"true or false, not a number"});
    expect_line_refused(7, "drum_width_m = [0.048]", {"an array, not a number"});
    expect_line_refused(2, "kind = 3", {"study.kind = 3 is a whole number, not a string", "\"surface\""});
    expect_line_refused(19, "pga_m_s2 = 3", {"surface.pga_m_s2 = 3", "not a table"});
    expect_line_refused(21, "friction = 0.1", {"perturbation.friction = 0.1", "not a table"});
    expect_line_refused(3, "realizations = 1985-09-19", {"a date or time, not a whole number"});
}

TEST(StudyFile, RefusesMissingKeys)
{
    const auto without = [](int line) {
        auto lines = surface_lines();
        lines[line] = "";
        return joined(lines);
    };
    expect_refused(without(2), "temple.toml:1", {"study.kind is missing", "\"single\", \"surface\""});
    expect_refused(without(3), "temple.toml:1", {"study.realizations is missing", "[1, 1000000000]"});
    expect_refused(without(5), "temple.toml:4", {"structure.blocks is missing", "[1, 200]"});
    expect_refused(without(8), "temple.toml:4", {"structure.drum_height_m is missing", "(0, 40]", "metres"});
    expect_refused(without(10), "temple.toml:4", {"structure.drum_mass_kg is missing", "density_kg_m3"});
    expect_refused(without(13), "temple.toml:11", {"contact.friction is missing", "(0, 10]"});
    expect_refused(without(19), "temple.toml:17", {"surface.pga_m_s2 is missing", "from = ..., to = ..., count"});
    expect_refused("", "temple.toml", {"study.kind is missing"});

    auto lines = surface_lines();
    lines[17] = lines[18] = lines[19] = "";
    expect_refused(joined(lines), "temple.toml", {"surface is missing", "frequency_hz", "pga_m_s2"});
    expect_refused(joined(single_lines("kind = \"record\"")), "temple.toml:14",
                   {"excitation.file is missing", "--set excitation.file=PATH"});
    expect_refused(joined(single_lines("kind = \"none\"")), "temple.toml:14", {"excitation.duration_s is missing"});
    expect_refused(joined(single_lines("kind = \"harmonic\"\npga_m_s2 = 1")), "temple.toml:14",
                   {"excitation.frequency_hz is missing", "Hz"});
}

TEST(StudyFile, RefusesValuesOutOfRange)
{
    expect_line_refused(8, "drum_height_m = 1450",
                        {"structure.drum_height_m = 1450 is outside (0, 40].",
                         "\n  Lengths are in metres. Did you mean 1.450 (1450 mm) or 14.500 (1450 cm)?"});
    expect_line_refused(7, "drum_width_m = 155", {"Did you mean 0.155 (155 mm) or 1.550 (155 cm)?"});
    expect_line_refused(7, "drum_width_m = 35000", {"Did you mean 35.000 (35000 mm)?"});
    expect_line_refused(7, "drum_width_m = 48", {"is outside (0, 40]", "Did you mean 0.048 (48 mm) or 0.480 (48 cm)?"});
    expect_line_refused(7, "drum_width_m = 0", {"structure.drum_width_m = 0 is outside (0, 40]"});
    expect_line_refused(7, "drum_width_m = -0.048", {"= -0.048 is outside (0, 40]"});
    expect_line_refused(7, "drum_width_m = nan", {"= nan is outside"});
    expect_line_refused(7, "drum_width_m = inf", {"= inf is outside"});
    expect_line_refused(5, "blocks = 0", {"[1, 200]"});
    expect_line_refused(5, "blocks = 201", {"[1, 200]"});
    expect_line_refused(5, "blocks = -7", {"= -7 is outside [1, 200]"});
    expect_line_refused(6, "fixed_blocks = 7", {"structure.fixed_blocks = 7 is outside [0, 6]", "free"});
    expect_line_refused(3, "realizations = 0", {"study.realizations = 0 is outside [1, 1000000000]"});
    expect_line_refused(3, "realizations = 1000000001", {"outside [1, 1000000000]"});
    expect_line_refused(3, "realizations = inf", {"outside [1, 1000000000]"});
    expect_line_refused(3, "realizations = 100_000_000", {"15 cells", "1500000000", "fewer"});
    expect_line_refused(3, "seed = -1", {"study.seed = -1 is outside [0, 9223372036854775807]"});
    expect_line_refused(10, "drum_mass_kg = 135.5", {"structure.drum_mass_kg = 135.5", "density", "(0, 30000]"});
    expect_line_refused(10, "density_kg_m3 = 2.7e6", {"outside (0, 30000]"});
    expect_line_refused(12, "normal_stiffness_n_m2 = 1e16", {"(0, 1e+15]", "N/m2"});
    expect_line_refused(12, "normal_stiffness_n_m2 = 0", {"(0, 1e+15]"});
    expect_line_refused(13, "friction = 68",
                        {"contact.friction = 68 is outside (0, 10]", "Did you mean 0.680 (68 %)?"});
    expect_line_refused(16, "cycles = 3", {"excitation.cycles = 3", "two ramps of 2 cycles"});
    expect_line_refused(18, "frequency_hz = { from = 0, to = 8, count = 5 }", {"surface.frequency_hz.from = 0", "Hz"});
    expect_line_refused(18, "frequency_hz = { from = 9, to = 8, count = 5 }", {"from = 9 is above to = 8"});
    expect_line_refused(18, "frequency_hz = { from = 1, to = 8, count = 0 }", {"count = 0", "[1, 1000]"});
    expect_line_refused(18, "frequency_hz = { from = 1, to = 8, count = 1001 }", {"count = 1001", "[1, 1000]"});
    expect_line_refused(18, "frequency_hz = { from = 1, to = 8, count = 1 }", {"count = 1", "one value"});
    expect_line_refused(18, "frequency_hz = { from = 8, to = 8, count = 2 }", {"count = 2", "equal values"});
}

TEST(StudyFile, RefusesWordsThatAreNotAllowed)
{
    expect_line_refused(2, "kind = \"survey\"",
                        {"study.kind = \"survey\" is not allowed",
                         "Allowed: \"single\", \"surface\", \"fragility\", \"sensitivity\", \"rare\", \"survival\"."});
    expect_line_refused(2, "kind = \"Surface\"", {"Did you mean \"surface\"?"});
    expect_line_refused(5, "kind = \"colonade\"\nblocks = 7",
                        {"structure.kind = \"colonade\"", "\"column\"", "Did you mean \"colonnade\"?"});
    expect_line_refused(15, "kind = \"earthquake\"", {"excitation.kind", "\"half_sine\"", "\"record\""});
    expect_line_refused(15, "kind = \"harmonc\"", {"Did you mean \"harmonic\"?"});
    expect_line_refused(16, "start = \"smoth\"", {"excitation.start", "Did you mean \"smooth\"?"});
    expect_line_refused(13, "form = \"two_corners\"\nfriction = 0.6", {"contact.form", "Did you mean \"two_corner\"?"});
    expect_line_refused(13, "damping = \"end\"\nfriction = 0.6", {"contact.damping", "\"centroid\", \"ends\""});
    expect_line_refused(13, "damping_per = \"area\"", {"contact.damping_per", "\"chord\""});
    expect_line_refused(21, "friction = { distribution = \"gauss\" }", {"\"normal\", \"lognormal\", \"uniform\""});
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.1, per = \"block\" }",
                        {"perturbation.friction.per = \"block\"", "\"joint\", \"structure\""});
    expect_line_refused(21, "tilt = { distribution = \"lognormal\", sigma_ln = 1 }", {"\"normal\", \"uniform\"."});
    expect_refused(joined(single_lines("kind = \"record\"\nfile = \"a\"\nunit = \"ft/s2\"")), "temple.toml:17",
                   {"excitation.unit = \"ft/s2\"", "\"gal\""});
}

TEST(StudyFile, RefusesKeysThatTheKindDoesNotUse)
{
    auto record = surface_lines();
    record[15] = "kind = \"record\"\nfile = \"a.at2\"";
    expect_refused(joined(record), "temple.toml:17",
                   {"excitation.cycles = 8", "not used by excitation.kind = \"record\""});
    expect_line_refused(16, "duration_s = 3",
                        {"excitation.duration_s = 3 is not used by excitation.kind = \"harmonic\""});
    expect_line_refused(16, "frequency_hz = 3", {"excitation.frequency_hz", "surface.frequency_hz", "[surface]"});
    expect_line_refused(16, "pga_m_s2 = 3", {"excitation.pga_m_s2", "[surface]"});
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.1, sigma_ln = 0.1 }",
                        {"perturbation.friction.sigma_ln", "not used by distribution = \"normal\""});
    expect_line_refused(21, "friction = { distribution = \"uniform\", from = 0.3, to = 0.6, min = 0.4 }",
                        {"perturbation.friction.min", "not used by distribution = \"uniform\""});

    auto lines = single_lines();
    lines[17] = "[surface]";
    expect_refused(joined(lines), "temple.toml:18", {"surface", "not used by study.kind = \"single\""});
    lines = single_lines();
    lines[21] = "phase = { distribution = \"uniform\" }";
    expect_refused(joined(lines), "temple.toml:22", {"perturbation.phase", "excitation.kind = \"none\""});
    lines = surface_lines();
    lines[15] = "kind = \"none\"";
    lines[16] = "duration_s = 2";
    expect_refused(joined(lines), "temple.toml:15", {"excitation.kind = \"none\"", "has no motion"});
    lines[15] = "kind = \"record\"\nfile = \"a.at2\"";
    lines[16] = "time_scale = 2";
    expect_refused(joined(lines), "temple.toml:17", {"excitation.time_scale", "surface.frequency_hz"});
}

TEST(StudyFile, RefusesContradictions)
{
    expect_line_refused(10, "density_kg_m3 = 2000\ndrum_mass_kg = 0.1",
                        {"structure.density_kg_m3", "exclude each other"});
    auto lines = surface_lines();
    lines[13] = "friction = 0.68\nnormal_damping_ratio = 0.1\nnormal_damping_n_s_m = 3";
    expect_refused(joined(lines), "temple.toml:15", {"normal_damping_n_s_m = 3", "normal_damping_ratio", "exclude"});
    lines[13] = "friction = 0.68\ntangential_damping_ratio = 0.1\ntangential_damping_n_s_m = 3";
    expect_refused(joined(lines), "temple.toml:15", {"tangential_damping_n_s_m = 3", "exclude"});
    lines[13] = "friction = 0.68\nnormal_damping_n_s_m = 3";
    lines[21] = "damping_ratio = { distribution = \"log_uniform\", from = 0.05, to = 0.5 }";
    expect_refused(joined(lines), "temple.toml:22", {"perturbation.damping_ratio", "damping coefficient"});
    lines = surface_lines();
    lines[21] += "\n[run]\nstep_bound = \"joint\"";
    expect_refused(joined(lines), "temple.toml:23", {"run.step_bound", "\"block\", \"structure\""});
    lines = surface_lines();
    lines[21] += "\n[run]\nstep_fraction = 0.5\nstep_s = 1e-5";
    expect_refused(joined(lines), "temple.toml:24", {"run.step_s", "exclude each other"});
    lines = surface_lines();
    lines[21] += "\n[run]\nstep_fraction = 1.5";
    expect_refused(joined(lines), "temple.toml:23", {"step_fraction = 1.5", "run.allow_step_above_bound = true"});
}

TEST(StudyFile, SinglePrecisionKnowsThePapersModelAlone)
{
    auto lines = surface_lines();
    lines[21] += "\n[run]\nprecision = \"single\"";
    EXPECT_EQ(read(lines).run.precision, Precision::single);
    lines[21] += "\n[mechanisms]\nstribeck = { dynamic_friction = 0.5, velocity_m_s = 0.05 }";
    expect_refused(joined(lines), "temple.toml:23",
                   {"run.precision = \"single\"", "mechanisms.stribeck", "precision = \"double\""});
    lines = surface_lines();
    lines[13] += "\nform = \"points\"\n[run]\nprecision = \"single\"";
    expect_refused(joined(lines), "temple.toml:16", {"run.precision", "contact.form = \"points\""});
    lines = surface_lines();
    lines[13] += "\ndamping = \"ends\"\n[run]\nprecision = \"single\"";
    expect_refused(joined(lines), "temple.toml:16", {"run.precision", "contact.damping = \"ends\""});
    lines = surface_lines();
    EXPECT_NO_THROW(demand_double(read(lines), "temple.toml", "a diagnosis"));
    lines[21] += "\n[run]\nprecision = \"single\"";
    EXPECT_THROW(demand_double(read(lines), "temple.toml", "a diagnosis"), InputError);
    lines = surface_lines();
    lines[21] += "\n[run]\nprecision = \"half\"";
    expect_refused(joined(lines), "temple.toml:23", {"run.precision", "half", "single"});
}

TEST(StudyFile, RefusesPerturbationsThatLeaveThePhysicalRange)
{
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.5 }",
                        {"perturbation.friction.min is missing", "0.68", "min = 0.34"});
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.1, min = 5 }",
                        {"perturbation.friction.min = 5", "one draw in a million", "0.68"});
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.1, min = 0.7, max = 0.6 }",
                        {"min = 0.7 is not below max = 0.6"});
    // of the end that is wrong: the nominal value is 0.68
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.02, min = 0.1, max = 0.5 }",
                        {"perturbation.friction.max = 0.5 leaves", "nominal value in [contact] is 0.68"});
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0.02, min = 0.9, max = 1.0 }",
                        {"perturbation.friction.min = 0.9 leaves"});
    expect_line_refused(21, "drum_width = { distribution = \"normal\", sd_m = 0.0001, max = 0.01 }",
                        {"perturbation.drum_width.max = 0.01 leaves", "nominal value in [structure] is"});
    expect_line_refused(21, "friction = { distribution = \"normal\", cov = 0 }", {"cov = 0 is outside (0, 5]"});
    expect_line_refused(21, "friction = { distribution = \"normal\" }", {"perturbation.friction.sd is missing", "cov"});
    expect_line_refused(21, "friction = { distribution = \"normal\", sd = 0.1, cov = 0.1 }", {"exclude each other"});
    expect_line_refused(21, "friction = { distribution = \"uniform\", from = 0.6, to = 0.3 }",
                        {"from = 0.6 is not below to = 0.3"});
    expect_line_refused(21, "damping_ratio = { distribution = \"log_uniform\", from = 0, to = 0.3 }",
                        {"perturbation.damping_ratio.from = 0 is outside (0, 2]"});
    expect_line_refused(21, "drum_offset = { distribution = \"normal\", sd_m = 0.24 }",
                        {"sd_m = 0.24 is outside (0, 0.048]", "Did you mean 0.00024 (0.24 mm) or 0.0024 (0.24 cm)?"});
    expect_line_refused(21, "drum_offset = { distribution = \"normal\", cov = 0.1 }", {"drum_offset.cov", "not used"});
    expect_line_refused(21, "phase = { distribution = \"uniform\", from = 1 }", {"perturbation.phase.to is missing"});
}

TEST(StudyFile, RefusesWhatIsNotToml)
{
    expect_line_refused(9, "depth_m = ", {"not valid TOML"});
    expect_line_refused(9, "depth_m = 0.048 0.048", {"not valid TOML"});
    expect_line_refused(9, "drum_width_m = 0.05", {"not valid TOML", "drum_width_m"}); // given twice
    expect_line_refused(9, "depth_m = \"0.048", {"not valid TOML"});
    expect_line_refused(9, "depth_m = 0.0\xff\xfe", {"beyond ASCII"});
    expect_line_refused(9, "depth_m = \"0.0\xff\xfe\"", {"not valid TOML"});
    expect_line_refused(9, "d\xc3\xa9pth_m = 0.048", {"beyond ASCII"});
    expect_line_refused(9, "depth_m = \xc3\xa9", {"beyond ASCII"});
    expect_line_refused(9, "depth_m = 1\"\xc3\xa9 \"", {"a quote in the middle of a value"});
    expect_line_refused(5, "kind = \"column\"\"x\"", {"a quote in the middle of a value"});
    expect_line_refused(9, "depth_m = 7.\"\xc3\xa9\"", {"a quote in the middle of a value"});
    expect_line_refused(9, "depth_m = 7[\"\xc3\xa9\"]", {"a bracket in the middle of a value"});
    expect_line_refused(9, "depth_m = 7=\"\xc3\xa9\"", {"a quote in the middle of a value"});
    expect_line_refused(9, "depth_m = [7, 7=[\"\xc3\xa9\"]]", {"a bracket in the middle of a value"});
    expect_line_refused(9, "depth_m = [7, 7=\"\xc3\xa9\"]", {"a quote in the middle of a value"});
    expect_line_refused(5, "kind = \"\"\"column\"\"\"\nblocks = 7", {"three quotes"});
    expect_line_refused(5, "kind = \"s\xc3\xa9isme # \\\" \xc3\xa9\" # \xc3\xa9\nblocks = 7",
                        {"\"s\xc3\xa9isme # ", "not allowed"});
    expect_line_refused(5, "kind = 's\xc3\xa9isme\\' # \xc3\xa9\nblocks = 7", {"s\xc3\xa9isme", "not allowed"});
    expect_line_refused(4, "[.structure]", {"[section]"});
    expect_line_refused(4, "[{tructure]", {"[section]"});
    expect_line_refused(4, "  [[ #", {"[section]"});
    // nesting without end must not end the program
    std::string deep = "a";
    for (int i = 0; i < 300000; ++i)
        deep += ".a";
    expect_line_refused(9, deep + " = 1", {"a line of"});
    expect_line_refused(9, deep.substr(0, 8001) + " = 1", {"unknown key structure.a"});
    expect_line_refused(9, "depth_m = " + std::string(8000, '['), {"not valid TOML"});
}

TEST(StudyFile, SettingsOverrideTheFile)
{
    const auto lines = surface_lines();
    const auto study = read(lines, {"study.realizations=3", "structure.drum_width_m = 0.05", "study.seed=9",
                                    "surface.pga_m_s2.to=5", "perturbation.friction.cov=0.05", "initial.tilt_rad=0.01",
                                    "excitation.start=abrupt", "excitation.end=\"abrupt\"",
                                    "surface.frequency_hz={from=1, to=2, count=2}", "study.realizations=4"});
    EXPECT_EQ(study.realizations, 4u); // the last one counts
    EXPECT_EQ(study.seed, 9u);
    EXPECT_EQ(study.structure.columns[0].drums[0].width_m, 0.05);
    EXPECT_EQ(study.surface->pga_m_s2.to, 5);
    EXPECT_EQ(study.surface->pga_m_s2.from, 1);
    EXPECT_EQ(study.surface->frequency_hz.count, 2);
    EXPECT_EQ(study.perturbations[0].cov, 0.05);
    EXPECT_EQ(study.initial.tilt_rad, 0.01);
    EXPECT_EQ(study.excitation.start, HarmonicEdge::abrupt);
    EXPECT_EQ(study.excitation.end, HarmonicEdge::abrupt);

    const auto record = single_lines("kind = \"record\"");
    for (const std::string path :
         {"../data/sct190985.txt", "1985", "1985-09-19", "3.at2", "a b.txt", "true", "a=b.txt", "s\xc3\xa9isme.at2"})
        EXPECT_EQ(read(record, {"excitation.file=" + path}).excitation.file, path);
    EXPECT_EQ(read(record, {"excitation.file=a", "excitation.component=2"}).excitation.component, "2");
}

/// Numbers beyond what the parser of TOML takes are refused by the range of their key, in files and by --set.
TEST(StudyFile, NamesTheRangeOfNumbersThatNoKeyCanHave)
{
    const std::string seeds = "is outside [0, 9223372036854775807]";
    for (const char* huge :
         {"9223372036854775808", "-9223372036854775809", "18446744073709551616", "1e19", "1e400", "-1e400",
          "99_999_999_999_999_999_999", "0x8000000000000000", "0xFFFFFFFFFFFFFFFFFF", "inf", "-1"}) {
        expect_line_refused(3, std::string("seed = ") + huge, {"study.seed = ", seeds});
        expect_line_refused(3, std::string("realizations = ") + huge, {"is outside [1, 1000000000]"});
        expect_line_refused(7, std::string("drum_width_m = ") + huge, {"structure.drum_width_m = ", "is outside (0, "});
        const std::string setting = std::string("study.seed=") + huge;
        expect_refused(joined(surface_lines()), "--set " + setting, {"study.seed = ", seeds}, {setting});
        const std::string blocks = std::string("structure.blocks=") + huge;
        expect_refused(joined(surface_lines()), "--set " + blocks, {"is outside [1, 200]"}, {blocks});
    }
    expect_line_refused(3, "seed = 9223372036854775808", {"study.seed = 9223372036854775808 is outside"});
    expect_line_refused(18, "frequency_hz = { from = 0.5, to = 8, count = 99999999999999999999 } # 1e999",
                        {"surface.frequency_hz.count = 100000000000000000000 is outside", "[1, 1000]"});
    // within the range, but no whole number of its own
    expect_line_refused(3, "seed = 9.1e18", {"is a floating-point number above 2^53", "Write all digits"});
    EXPECT_EQ(read(surface_lines(), {"study.seed=9223372036854775807"}).seed, 9223372036854775807U);
    EXPECT_EQ(read(surface_lines(), {"study.seed=1e6"}).seed, 1000000U);
    // a text is a text, whatever is in it
    auto lines = surface_lines();
    lines[3] = "realizations = 8\ntitle = \"seed = 9223372036854775808\" # 9223372036854775808";
    EXPECT_EQ(read(lines, {}).title, "seed = 9223372036854775808");
    expect_line_refused(3, "realizations = 9 9223372036854775808", {"not valid TOML"});
}

TEST(StudyFile, RefusesBadSettingsByTheirName)
{
    const auto text = joined(surface_lines());
    const auto refused = [&](const std::string& setting, const std::vector<std::string>& words) {
        expect_refused(text, "--set " + setting, words, {setting});
    };
    refused("structure.blocks=500", {"structure.blocks = 500 is outside [1, 200]"});
    refused("structure.bloks=5", {"unknown key structure.bloks", "Did you mean blocks?"});
    refused("contact.friction=rough", {"contact.friction = \"rough\" is a string, not a number"});
    refused("structure.drum_width_m=0.0.5", {"\"0.0.5\" is a string, not a number"});
    refused("surface.pga_m_s2={from=1", {"not valid TOML"});
    refused("surface.pga_m_s2={from=1, to=2}", {"surface.pga_m_s2.count is missing"});
    refused("study.kind.x=1", {"study.kind = \"surface\" is a string, not a table"});
    expect_refused(text, "--set structure.drums.width_m=2.0",
                   {"structure.drums = [ ... ] is an array, not a table", "Give the whole list structure.drums."},
                   {"structure.drums=[{ width_m = 1.0, height_m = 1.0 }]", "structure.drums.width_m=2.0"});
    refused("study.seed", {"KEY=VALUE"});
    refused("study.seed=", {"no value"});
    refused("study..seed=1", {"dotted name"});
    refused("=1", {"dotted name"});
    refused("study.kind=\"\"", {"not allowed"});
    refused("output=3", {"output = 3", "not a table"});
    refused("study.kind=\xff", {"not valid text"});
    expect_refused(text, "--set", {"control characters"}, {"study.seed=1\n[run]"});
    // keys of the file are still named by their line
    auto lines = surface_lines();
    lines[7] = "drum_width_m = 48";
    expect_refused(joined(lines), "temple.toml:7", {"drum_width_m"}, {"study.seed=3"});
}

TEST(StudyFile, TheRecordIsFoundBesideTheStudy)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "stylobate_study_file";
    fs::create_directories(folder / "records");
    const auto write = [](const fs::path& file, const std::string& text) { std::ofstream(file) << text; };
    write(folder / "records/here.at2", "");
    write(folder / "study.toml", joined(single_lines("kind = \"record\"\nfile = \"records/here.at2\"")));
    write(folder / "absent.toml", joined(single_lines("kind = \"record\"\nfile = \"records/absent.at2\"")));

    EXPECT_EQ(read_study(folder / "study.toml").excitation.file, (folder / "records/here.at2").lexically_normal());
    EXPECT_EQ(read_study(folder / "absent.toml").excitation.file, "records/absent.at2");
    EXPECT_EQ(read_study(folder / "study.toml", {"excitation.file=records/here.at2"}).excitation.file,
              "records/here.at2"); // of the command line: from the working folder
    EXPECT_EQ(read_study(folder / "study.toml", {"excitation.file=/x/y.at2"}).excitation.file, "/x/y.at2");

    const auto refused = [](const fs::path& file, const std::string& word) {
        try {
            read_study(file);
            ADD_FAILURE() << file << " was accepted";
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find(file.string()), 0u) << message;
            EXPECT_NE(message.find(word), std::string::npos) << message;
        }
    };
    refused(folder / "nothing.toml", "No such file");
    refused(folder, "is a folder");
    write(folder / "large.toml", std::string(2000000, '#'));
    refused(folder / "large.toml", "larger than 1 MiB");
    fs::remove_all(folder);
}

TEST(StudyFile, TheStudiesOfTheProjectAreRead)
{
    const std::filesystem::path inputs = STYLOBATE_SOURCE_DIR "/studies/inputs";
    const auto column = read_study(inputs / "small_scale_column.toml");
    EXPECT_EQ(column.total(), 16u * 16u * 256u);
    EXPECT_EQ(static_cast<int>(column.structure.columns[0].drums.size()) - column.structure.columns[0].fixed_blocks, 6);
    EXPECT_EQ(column.contact.tangential_stiffness_n_m, 4.8e6);
    EXPECT_EQ(column.perturbations.size(), 9u);

    const auto record = read_study(inputs / "record.toml", {"excitation.file=quake.at2"});
    EXPECT_EQ(record.excitation.file, "quake.at2");
    EXPECT_EQ(record.surface->cells(), 36);
    EXPECT_THROW(read_study(inputs / "record.toml"), InputError);

    const auto pulse = read_study(inputs / "near_fault_pulse.toml");
    EXPECT_EQ(pulse.excitation.kind, ExcitationKind::pulse);
    EXPECT_EQ(pulse.perturbations.back().quantity, Quantity::pulse_gamma);
    const auto noise = read_study(inputs / "synthetic_earthquake.toml");
    EXPECT_EQ(noise.excitation.kind, ExcitationKind::noise);
    EXPECT_EQ(noise.total(), 36u * 32u);

    const auto rocking = read_study(inputs / "free_rocking.toml");
    EXPECT_EQ(rocking.excitation.kind, ExcitationKind::none);
    EXPECT_NEAR(rocking.initial.tilt_rad, std::atan(0.048 / 0.174) / 2, 1e-4);
}

} // namespace
} // namespace stylobate
