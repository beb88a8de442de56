/// Studies, records and motions of one's own.

#include "stylobate/stylobate.hpp"
#include "tests/program/program.hpp"

#include "ensemble/motion/base_motion.hpp"
#include "io/records/ground_motion.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate {
namespace {

/// A single column that is shaken by something else in each test.
const std::string single = R"([study]
kind = "single"
seed = 3
realizations = 12
[structure]
kind = "column"
blocks = 4
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 1e7
tangential_stiffness_n_m = 4.8e5
friction = 0.68
[excitation]
kind = "none"
duration_s = 1
[perturbation]
drum_offset = { distribution = "normal", sd_m = 0.0005, per = "block" }
)";

double sway(double time_s)
{
    return 9 * std::sin(2 * std::numbers::pi * 3 * time_s) * std::exp(-time_s);
}

using LibraryInputs = Program;

TEST_F(LibraryInputs, AStudySaysWhatItsFileSays)
{
    api::Study study = api::Study::from_file(column_study, {"study.realizations=3"});
    EXPECT_EQ(study.text(), read_study(column_study, {"study.realizations=3"}).text);
    EXPECT_EQ(study.kind(), "surface");
    EXPECT_EQ(study.seed(), 1U);
    EXPECT_EQ(study.realizations(), 16U * 16U * 3U);
    const api::Study before = study;
    study.set("surface.pga_m_s2.count=4");
    EXPECT_EQ(study.realizations(), 16U * 4U * 3U);
    EXPECT_EQ(before.realizations(), 16U * 16U * 3U) << "a copy is another study";
    EXPECT_THROW(study.set("surface.pga_m_s2.count=0"), api::InputError);
    EXPECT_EQ(study.realizations(), 16U * 4U * 3U);
    EXPECT_EQ(api::Study::from_text(study.text()).text(), study.text());
    // a key that takes the place of another one's default
    api::Study text = api::Study::from_text(single);
    text.set("contact.normal_damping_n_s_m=5");
    EXPECT_NE(text.text().find("normal_damping_n_s_m = 5"), std::string::npos);
    EXPECT_THROW(api::Study::from_text("[study]\nkind = \"srface\"\n"), api::InputError);
}

TEST_F(LibraryInputs, AFunctionOfTimeShakesAsItsSamplesInAFile)
{
    constexpr double dt_s = 0.0078125; // exact, so that the file says the same step
    std::string samples, study = single;
    for (int i = 0; i <= 256; ++i)
        samples += fmt::format("{} {}\n", i * dt_s, sway(i * dt_s));
    write_bytes(folder / "sway.txt", samples);
    study.replace(study.find("kind = \"none\"\nduration_s = 1"), 28,
                  "kind = \"record\"\nfile = \"sway.txt\"\nunit = \"m/s2\"\nbaseline = false");
    write_bytes(folder / "study.toml", study);
    ASSERT_EQ(run({"run", "study.toml", "-o", "want.h5", "--quiet"}).status, 0);
    const ResultReader want(folder / "want.h5");

    const api::Experiment experiment(api::Study::from_text(single), sway, dt_s, 2.0);
    EXPECT_EQ(experiment.realizations(), 12U);
    EXPECT_NE(experiment.study().text().find("kind = \"record\""), std::string::npos);
    const api::Result got = api::run(experiment);
    ASSERT_EQ(got.outcomes().size(), 12U);
    double most = 0;
    for (const api::Outcome& outcome : got.outcomes()) {
        EXPECT_EQ(outcome.peak_top_displacement_m, want.row(outcome.index).outcome.peak_top_displacement_m);
        EXPECT_EQ(outcome.energy_friction_j, want.row(outcome.index).outcome.energy_friction_j);
        most = std::max(most, outcome.peak_top_displacement_m);
    }
    EXPECT_GT(most, 0.001) << "it was shaken";
    EXPECT_EQ(api::replay(experiment, 5).outcome.peak_top_displacement_m, got.outcomes()[5].peak_top_displacement_m);
}

TEST_F(LibraryInputs, ARecordTakesThePlaceOfTheExcitation)
{
    write_bytes(folder / "burst.at2", Burst{}.at2());
    const api::Record record = api::Record::read(folder / "burst.at2");
    // in a surface it is scaled to the cells, as by the program
    const std::vector<std::string> cells = {"study.realizations=2", "surface.frequency_hz={from=2.0,to=4.0,count=2}",
                                            "surface.pga_m_s2={from=4.0,to=12.0,count=2}",
                                            "perturbation={ friction = { distribution = \"normal\", cov = 0.1 } }"};
    api::Study named = api::Study::from_file(column_study, cells);
    named.set(fmt::format("excitation={{ kind = \"record\", file = \"{}\" }}", (folder / "burst.at2").string()));
    const api::Result want = api::run(api::Experiment(named));
    const api::Result got = api::run(api::Experiment(api::Study::from_file(column_study, cells), record));
    ASSERT_EQ(got.outcomes().size(), 8U);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(got.outcomes()[i].peak_top_displacement_m, want.outcomes()[i].peak_top_displacement_m);

    // a phase is a sine's, and drawn in the study as it stands
    EXPECT_THROW(api::Experiment(api::Study::from_file(column_study), record), api::InputError);
    const std::string fragility = STYLOBATE_SOURCE_DIR "/studies/inputs/fragility_column.toml";
    EXPECT_THROW(api::Experiment(api::Study::from_file(fragility), record), api::InputError);
}

TEST_F(LibraryInputs, MotionsThatAreNoneAreRefused)
{
    const api::Study study = api::Study::from_text(single);
    const auto zero = [](double) { return 0.0; };
    const auto nan = [](double t) { return t > 1 ? std::numeric_limits<double>::quiet_NaN() : 1.0; };
    EXPECT_THROW(api::Experiment(study, zero, 0.01, 1), api::InputError);
    EXPECT_THROW(api::Experiment(study, nan, 0.01, 2), api::InputError);
    EXPECT_THROW(api::Experiment(study, sway, 0, 2), api::InputError);
    EXPECT_THROW(api::Experiment(study, sway, 0.01, -1), api::InputError);
    EXPECT_THROW(api::Experiment(study, sway, 0.5, 2), api::InputError);
    EXPECT_THROW(api::Experiment(study, sway, 1e-12, 2), api::InputError);
    EXPECT_THROW(api::Record::from_samples(std::vector<double>(20, 1e6), 0.01), api::InputError);
}

TEST_F(LibraryInputs, RecordsSayWhatTheProgramSaysOfThem)
{
    write_bytes(folder / "burst.at2", Burst{}.at2());
    const JsonValue said = json_of(run({"record", "burst.at2", "--json"}));
    ASSERT_EQ(said.items.size(), 1U);
    const api::Record record = api::Record::read(folder / "burst.at2");
    const api::Intensity intensity = record.intensity();
    EXPECT_EQ(record.format(), said.items[0]["format"].text);
    EXPECT_EQ(record.dt_s(), said.items[0]["dt_s"].number);
    EXPECT_EQ(record.duration_s(), said.items[0]["duration_s"].number);
    EXPECT_EQ(static_cast<double>(record.acceleration_m_s2().size()), said.items[0]["samples"].number);
    EXPECT_EQ(intensity.pga_m_s2, said.items[0]["pga_m_s2"].number);
    EXPECT_EQ(intensity.pgv_m_s, said.items[0]["pgv_m_s"].number);
    EXPECT_EQ(intensity.pgd_m, said.items[0]["pgd_m"].number);
    EXPECT_EQ(intensity.arias_m_s, said.items[0]["arias_m_s"].number);
    EXPECT_EQ(intensity.d5_95_s, said.items[0]["d5_95_s"].number);
    EXPECT_EQ(intensity.cav_m_s, said.items[0]["cav_m_s"].number);
    EXPECT_EQ(intensity.mean_frequency_hz, said.items[0]["mean_frequency_hz"].number);
    EXPECT_EQ(record.spectral_acceleration_m_s2({0.5}).front(), said.items[0]["sa"].items[3]["sa_m_s2"].number);
    EXPECT_EQ(record.spectral_acceleration_m_s2({0}).front(), intensity.pga_m_s2);
    EXPECT_THROW(record.spectral_acceleration_m_s2({-1}), api::InputError);
    EXPECT_THROW(record.spectral_acceleration_m_s2({1}, 1), api::InputError);
    EXPECT_THROW(api::Record::read(folder / "none.at2"), api::InputError);
}

TEST_F(LibraryInputs, ADiagnosisNeedsMeasuredData)
{
    write_bytes(folder / "no.h5", "nothing");
    EXPECT_THROW(api::diagnose(folder / "no.h5"), api::InputError);
    EXPECT_THROW(api::diagnose(folder / "none.h5"), api::InputError);
}

} // namespace
} // namespace stylobate
