/// `stylobate diagnose`, as its user runs it: what it refuses, and what it says of data that lack something.

#include "io/files/hdf5.hpp"
#include "tests/program/program.hpp"

#include <cmath>

namespace stylobate {
namespace {

/// What is left out of a campaign, or wrong with it.
struct Flaw {
    bool no_blocks = false;
    bool no_rotation = false;
    bool not_seen = false; ///< NaN everywhere
    bool backwards = false;
    double half_width_m = 0.024;
    double rate_hz = 500;
};

/// Two drums that ride on a table: a campaign as a laboratory's program writes it.
void write_campaign(const fs::path& file, const Flaw& flaw)
{
    constexpr std::size_t samples = 1000;
    constexpr std::size_t drums = 2;
    hdf5::Handle made = hdf5::create_file(file, 0);
    hdf5::write_text(made.id(), "format", "stylobate-measured");
    hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, 1);
    hdf5::write_text(made.id(), "specimen", "two drums");
    hdf5::write_real(made.id(), "gravity_m_s2", 9.81);
    const hdf5::Handle specimen = hdf5::create_group(made.id(), "specimen");
    hdf5::write_real(specimen.id(), "friction_nominal", 0.7);
    const auto column = [&](const char* name, const std::vector<double>& values) {
        hdf5::write_array(specimen.id(), name, values, {drums}, "");
    };
    column("half_width_m", {flaw.half_width_m, 0.024});
    column("half_height_m", {0.03, 0.03});
    column("depth_m", {0.048, 0.048});
    column("mass_kg", {0.3, 0.3});
    column("rest_x_m", {0, 0});
    column("rest_y_m", {0.03, 0.09});
    hdf5::write_array(specimen.id(), "joints", std::vector<std::int32_t>{-1, 0, 0, 1}, {drums, 2}, "");

    std::vector<double> time, base, x, y, theta;
    for (std::size_t i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / flaw.rate_hz;
        time.push_back(flaw.backwards ? 2 - t : t);
        base.push_back(0.001 * std::sin(12 * t));
        for (std::size_t b = 0; b < drums; ++b) {
            x.push_back(flaw.not_seen ? NAN : base.back());
            y.push_back(flaw.not_seen ? NAN : b == 0 ? 0.03 : 0.09);
            theta.push_back(flaw.not_seen ? NAN : 0);
        }
    }
    const hdf5::Handle runs = hdf5::create_group(made.id(), "runs");
    const hdf5::Handle run = hdf5::create_group(runs.id(), "000");
    hdf5::write_number(run.id(), "motion_id", H5T_STD_I32LE, 0);
    hdf5::write_number(run.id(), "repeat", H5T_STD_I32LE, 0);
    hdf5::write_text(run.id(), "kind", "harmonic");
    hdf5::write_real(run.id(), "rate_hz", flaw.rate_hz);
    hdf5::write_array(run.id(), "time_s", time, {samples}, "s");
    const hdf5::Handle table = hdf5::create_group(run.id(), "base");
    hdf5::write_array(table.id(), "displacement_m", base, {samples}, "m");
    if (flaw.no_blocks)
        return;
    const hdf5::Handle blocks = hdf5::create_group(run.id(), "blocks");
    hdf5::write_array(blocks.id(), "x_m", x, {samples, drums}, "m");
    hdf5::write_array(blocks.id(), "y_m", y, {samples, drums}, "m");
    if (!flaw.no_rotation)
        hdf5::write_array(blocks.id(), "theta_rad", theta, {samples, drums}, "rad");
}

class Diagnose : public Program {
protected:
    void refuses(const Flaw& flaw, const Words& parts) const
    {
        write_campaign(folder / "campaign.h5", flaw);
        expect_refused(Words{"diagnose", "campaign.h5", "--nulls", "0"}, parts);
    }
};

TEST_F(Diagnose, DataThatCannotBeDiagnosedAreRefusedInOneMessage)
{
    refuses({.no_blocks = true}, {"campaign.h5", "blocks/x_m, blocks/y_m, blocks/theta_rad"});
    refuses({.no_rotation = true}, {"campaign.h5", "no run has blocks/theta_rad"});
    refuses({.not_seen = true}, {"campaign.h5", "run 000", "NaN everywhere"});
    refuses({.backwards = true}, {"campaign.h5", "run 000", "time_s", "A clock must increase"});
    refuses({.half_width_m = 15000}, {"campaign.h5", "half_width_m", "15000", "block 0"});
    refuses({.rate_hz = 100}, {"campaign.h5", "samples every 0.01 s, too few"});
}

TEST_F(Diagnose, FilesThatAreNoMeasuredDataAreRefused)
{
    expect_refused(Words{"diagnose", "campain.h5"}, {"campain.h5", "there is no such file"});
    write_bytes(folder / "text.h5", "not HDF5\n");
    expect_refused(Words{"diagnose", "text.h5"}, {"text.h5", "cannot be read as measured data", "io/FORMAT.md"});
}

TEST_F(Diagnose, TestsOfAnotherSpecimenAreRefused)
{
    write_campaign(folder / "campaign.h5", {});
    write_campaign(folder / "wide.h5", {.half_width_m = 0.03});
    write_campaign(folder / "shaken.h5", {});
    expect_refused(Words{"diagnose", "campaign.h5", "--tests", "wide.h5"},
                   {"wide.h5", "is of another specimen than campaign.h5", "half_width_m 0.03 m for block 0"});
    expect_refused(Words{"diagnose", "campaign.h5", "--tests", "shaken.h5"},
                   {"shaken.h5", "has no test of a single joint", "MEASURED"});
    expect_refused(Words{"diagnose", "campaign.h5", "--tests", "missing.h5"}, {"missing.h5", "there is no such file"});
    EXPECT_EQ(names(), (Words{"campaign.h5", "shaken.h5", "wide.h5"})) << "nothing is written";
}

TEST_F(Diagnose, OptionsAreCheckedBeforeAnythingIsWorkedOn)
{
    write_campaign(folder / "campaign.h5", {});
    expect_refused(Words{"diagnose", "campaign.h5", "--nulls", "-1"}, {"--nulls", "-1", "0 to 10000"});
    expect_refused(Words{"diagnose", "campaign.h5", "-o", "missing/d.h5"}, {"missing/d.h5", "folder"});
    expect_refused(Words{"diagnose", "campaign.h5", "-o", "campaign.h5"}, {"campaign.h5", "choose another output"});
    expect_refused(Words{"diagnose", "campaign.h5", "-o", "."}, {"folder"});
    expect_refused(Words{"diagnose", "campaign.h5", "--set", "contact.frictoin=0.3"},
                   {"contact.frictoin", "Did you mean", "friction"});
    std::string study = read_bytes(column_study);
    ASSERT_NE(study.find("\nfriction ="), std::string::npos);
    write_bytes(folder / "study.toml", study.replace(study.find("\nfriction ="), 11, "\nfrictoin ="));
    expect_refused(Words{"diagnose", "campaign.h5", "--study", "study.toml"}, {"study.toml", "frictoin"});
}

TEST_F(Diagnose, ItSaysWhatItCouldNotJudge)
{
    write_campaign(folder / "campaign.h5", {}); // nothing rocks and nothing slides
    const Ended ended = run(Words{"diagnose", "campaign.h5", "-o", "d.h5", "--nulls", "0", "--json", "--quiet"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(ended.err, "");
    const JsonValue json = json_of(ended);
    EXPECT_EQ(json["verdict"].text, "none");
    EXPECT_NE(json["text"].text.find("Not tested: "), std::string::npos) << json["text"].text;
    for (const char* part : {"balance of forces", "joints and blocks"})
        EXPECT_NE(json["text"].text.find(part), std::string::npos) << json["text"].text;
    EXPECT_EQ(json["heading"].text, "No cause identified");
    const Ended text = run(Words{"diagnose", "campaign.h5", "-o", "d.h5", "--nulls", "0", "--force", "--quiet"});
    EXPECT_NE(text.out.find("Verdict: No cause identified\n"), std::string::npos) << text.out;
    EXPECT_EQ(text.out.find("null distribution"), std::string::npos) << "none was simulated\n" << text.out;
    EXPECT_EQ(text.err, "");
    EXPECT_EQ(names(), (Words{"campaign.h5", "d.h5"}));

    const Ended told = run(Words{"info", "d.h5"});
    EXPECT_EQ(told.status, 0) << testing::PrintToString(told);
    EXPECT_NE(told.out.find("d.h5: a diagnosis of campaign.h5 (1 run)"), std::string::npos) << told.out;
}

} // namespace
} // namespace stylobate
