/// Tests of single joints in measured data: files of version 2, what they refuse, and that no such test is read as a
/// shake run.

#include "io/files/hdf5.hpp"
#include "io/measured/campaign_writer.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_motion.hpp"
#include "tests/io/measured/measured_samples.hpp"
#include "tests/io/measured/same_campaign.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

/// Every field of version 2 in use.
Campaign campaign_with_tests()
{
    Campaign campaign = sample_campaign(3);
    campaign.runs.resize(1);
    campaign.tests = sample_tests(campaign.specimen);
    campaign.specimen.centre_of_mass_m = {1e-4, nan_value, -2e-4};
    campaign.specimen.bearing_left_m = {0, 0.0003, nan_value};
    campaign.specimen.bearing_right_m = {0.0001, 0, 0};
    campaign.laboratory.stroke_m = 0.02;
    campaign.laboratory.tilt_rad = 0.7;
    campaign.laboratory.force_n = 0;
    campaign.laboratory.may_dismantle = false;
    campaign.laboratory.cost = {{RunKind::pull, 2}, {RunKind::rest, 0.5}};
    return campaign;
}

MeasuredRun& test_of(Campaign& campaign, RunKind kind)
{
    return *std::ranges::find(campaign.tests, kind, &MeasuredRun::test);
}

std::vector<std::string> run_names(const std::vector<MeasuredRun>& runs)
{
    std::vector<std::string> names;
    for (const MeasuredRun& run : runs)
        names.push_back(run.name);
    return names;
}

bool finding_at(const Campaign& campaign, const std::string& place, const std::string& part)
{
    return std::ranges::any_of(campaign.findings, [&](const Finding& f) {
        return f.place == place && f.text.find(part) != std::string::npos;
    });
}

/// The text with one part of it replaced. @pre it is there
std::string replaced(std::string text, const std::string& old, const std::string& other)
{
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), other);
}

/// Refused with all these parts, as HDF5 and as a folder; and accepted before.
void expect_test_refused(const std::vector<std::string>& parts, const std::function<void(Campaign&)>& change)
{
    Campaign campaign = campaign_with_tests();
    change(campaign);
    for (const char* name : {"a.h5", "a"}) {
        const MeasuredFolder folder("refused_tests");
        write_campaign(campaign, folder / name);
        const std::string text = refusal([&] { read_campaign(folder / name); });
        EXPECT_FALSE(text.empty()) << name << ' ' << parts.front();
        for (const std::string& part : parts)
            EXPECT_NE(text.find(part), std::string::npos) << part << " not in: " << text;
    }
}

TEST(JointTestFile, RoundTripIsBitForBit)
{
    const Campaign campaign = campaign_with_tests();
    for (const char* name : {"a.h5", "a"}) {
        const MeasuredFolder folder("tests");
        write_campaign(campaign, folder / name);
        expect_same(campaign, read_campaign(folder / name));
    }
}

TEST(JointTestFile, UnitsAndTypesOfOtherProgramsAreConverted)
{
    const MeasuredFolder folder("foreign_tests");
    {
        hdf5::Handle file = hdf5::create_file(folder / "a.h5", 0);
        hdf5::write_text(file.id(), "format", "stylobate-measured");
        hdf5::write_real(file.id(), "format_version", 2);
        const hdf5::Handle specimen = hdf5::create_group(file.id(), "specimen");
        const auto list = [](const hdf5::Handle& group, const char* name, const std::vector<double>& values,
                             const char* unit) { hdf5::write_array(group.id(), name, values, {values.size()}, unit); };
        for (const char* name : {"half_width_m", "half_height_m", "depth_m"})
            list(specimen, name, {0.02, 0.02}, "m");
        list(specimen, "mass_kg", {150, 150}, "g");
        list(specimen, "centre_of_mass_m", {0.5, nan_value}, "mm");
        hdf5::write_array(specimen.id(), "joints", std::vector<double>{-1, 0, 0, 1}, {2, 2}, "");
        const hdf5::Handle laboratory = hdf5::create_group(file.id(), "laboratory");
        hdf5::write_number(laboratory.id(), "may_dismantle", H5T_STD_U8LE, 0);
        const hdf5::Handle runs = hdf5::create_group(file.id(), "runs");
        const hdf5::Handle run = hdf5::create_group(runs.id(), "1");
        hdf5::write_text(run.id(), "kind", "pull");
        hdf5::write_real(run.id(), "joint", 1);
        hdf5::write_array(run.id(), "taped", std::vector<std::int32_t>{1, 0, -1}, {1, 3}, "");
        list(run, "time_s", {0, 10, 20}, "ms");
        const hdf5::Handle dummies = hdf5::create_group(run.id(), "dummies");
        list(dummies, "block", {1}, "");
        list(dummies, "mass_kg", {90}, "g");
        list(dummies, "half_width_m", {2}, "cm");
        list(dummies, "half_height_m", {0.01}, "m");
        const hdf5::Handle forces = hdf5::create_group(run.id(), "force");
        const hdf5::Handle gauge = hdf5::create_group(forces.id(), "left one");
        hdf5::write_real(gauge.id(), "block", 1);
        hdf5::write_real(gauge.id(), "height_m", 0.01);
        list(gauge, "value_n", {0, 500, 1000}, "mN");
        hdf5::write_real(hdf5::open_object(gauge.id(), "value_n").id(), "noise_sd", 20);
        const hdf5::Handle base = hdf5::create_group(run.id(), "base");
        list(base, "tilt_rad", {0, 90, 45}, "deg");
        file.close();
    }
    const Campaign campaign = read_campaign(folder / "a.h5");
    EXPECT_DOUBLE_EQ(campaign.specimen.centre_of_mass_m[0], 0.0005);
    EXPECT_FALSE(campaign.laboratory.may_dismantle);
    ASSERT_EQ(campaign.tests.size(), 1u);
    const MeasuredRun& run = campaign.tests[0];
    EXPECT_EQ(run.taped, (std::vector<std::vector<int>>{{1, 0}}));
    EXPECT_EQ(run.dummies, (std::vector<Dummy>{{1, 0.09, 0.02, 0.01, 0, 0}}));
    ASSERT_EQ(run.forces.size(), 1u);
    EXPECT_EQ(run.forces[0].name, "left one");
    EXPECT_EQ(run.forces[0].value_n.values, (std::vector<double>{0, 0.5, 1}));
    EXPECT_DOUBLE_EQ(*run.forces[0].value_n.noise_sd, 0.02);
    EXPECT_TRUE(run.forces[0].to_laboratory);
    EXPECT_DOUBLE_EQ(run.base_tilt_rad.values[1], std::numbers::pi / 2);
}

TEST(JointTestFile, TheBaseOfATestIsNoShaking)
{
    const MeasuredFolder folder("excitation");
    write_campaign(campaign_with_tests(), folder / "a.h5");
    EXPECT_NO_THROW(read_base_table(folder / "a.h5", "000"));
    const std::string text = refusal([&] { read_base_table(folder / "a.h5", "slide"); });
    EXPECT_NE(text.find("is a test (slide) on joint 1"), std::string::npos) << text;
    EXPECT_NE(text.find("000"), std::string::npos) << text;
}

TEST(JointTestFile, APlanIsReadBack)
{
    Campaign campaign = campaign_with_tests();
    for (MeasuredRun& run : campaign.tests) {
        run.blocks = {};
        for (ForceGauge& gauge : run.forces)
            gauge.value_n = {};
    }
    MeasuredRun& drop = test_of(campaign, RunKind::drop); // hands hold it until it is released
    for (std::size_t i = 0; i < drop.time_s.size(); ++i)
        for (int b = 0; b < 3; ++b) {
            const bool held = b == 1 && drop.time_s[i] <= 0.2;
            drop.blocks.x_m.values.push_back(held ? 0 : nan_value);
            drop.blocks.y_m.values.push_back(held ? 0.0755 : nan_value);
            drop.blocks.theta_rad.values.push_back(held ? 0 : nan_value);
        }
    for (const char* name : {"a.h5", "a"}) {
        const MeasuredFolder folder("plan");
        write_campaign(campaign, folder / name);
        expect_same(campaign, read_campaign(folder / name));
    }
}

TEST(JointTestFile, OnlyFreeShakeRunsAreShakeRuns)
{
    Campaign campaign = campaign_with_tests();
    MeasuredRun held = campaign.runs[0], leaning = held, part = held, whole = held;
    held.name = "held";
    held.released_s = 0.1;
    leaning.name = "leaning";
    leaning.base_tilt_rad.values.assign(leaning.time_s.size(), 0.01);
    part.name = "part";
    part.present = {0, 1};
    for (Series* series : {&part.blocks.x_m, &part.blocks.y_m, &part.blocks.theta_rad})
        for (std::size_t i = 2; i < series->values.size(); i += 3)
            series->values[i] = nan_value;
    whole.name = "whole";
    whole.present = {2, 0, 1};
    campaign.runs.insert(campaign.runs.end(), {held, leaning, part, whole});
    for (const char* name : {"a.h5", "a"}) {
        const MeasuredFolder folder("apart");
        write_campaign(campaign, folder / name);
        const Campaign read = read_campaign(folder / name);
        EXPECT_EQ(run_names(read.runs), (std::vector<std::string>{"000", "whole"}));
        EXPECT_EQ(run_names(read.tests), (std::vector<std::string>{"board", "drop", "held", "leaning", "part", "pull",
                                                                   "push", "rest", "slide", "tilt"}));
        EXPECT_TRUE(finding_at(read, "run held, kind", "held by hands"));
        EXPECT_TRUE(finding_at(read, "run leaning, kind", "the table tilted"));
        EXPECT_TRUE(finding_at(read, "run part, kind", "blocks removed"));
        EXPECT_FALSE(finding_at(read, "run whole, kind", ""));
    }
}

TEST(JointTestFile, UnknownKindsAreLeftOutAndReported)
{
    const MeasuredFolder folder("kinds");
    write_campaign(campaign_with_tests(), folder / "a");
    const fs::path toml = folder / "a/campaign.toml";
    write_content(toml, replaced(content_of(toml), "kind = \"pull\"", "kind = \"pul\"\nnobody = \"knows\""));
    const Campaign read = read_campaign(folder / "a");
    EXPECT_EQ(run_names(read.tests), (std::vector<std::string>{"board", "drop", "push", "rest", "slide", "tilt"}));
    EXPECT_TRUE(finding_at(read, "run pull, kind", "Did you mean \"pull\"?"));
}

TEST(JointTestFile, InVersion1AKindIsThatOfTheMotion)
{
    const MeasuredFolder folder("old");
    Campaign campaign = sample_campaign(2);
    campaign.runs[1].kind = "push";
    write_campaign(campaign, folder / "a");
    const fs::path toml = folder / "a/campaign.toml";
    std::string text = replaced(content_of(toml), "format_version = 2", "format_version = 1");
    text = replaced(text, "\n[laboratory]\nmay_dismantle = true\n", "");
    for (int i = 0; i < 3; ++i)
        text = replaced(replaced(text, "kind = \"shake\"\n", ""), "motion = ", "kind = ");
    write_content(toml, text);
    const Campaign read = read_campaign(folder / "a");
    expect_same(campaign, read);
    EXPECT_TRUE(finding_at(read, "run 001, kind", "format_version = 2"));
    EXPECT_FALSE(finding_at(read, "run 000, kind", ""));

    write_content(toml, text + "joint = 1\n");
    EXPECT_NE(refusal([&] { read_campaign(folder / "a"); }).find("joint"), std::string::npos);
    write_content(toml, text + "\n[columns]\n\"a\" = \"x0_m\"\n");
    EXPECT_NE(refusal([&] { read_campaign(folder / "a"); }).find("columns"), std::string::npos);
}

TEST(JointTestCheck, JointsAndBlocksMustExist)
{
    expect_test_refused({"run pull", "joint 3, which does not exist", "0 to 2"},
                        [](Campaign& c) { test_of(c, RunKind::pull).joint = 3; });
    expect_test_refused({"run push: clamped names joint -1"},
                        [](Campaign& c) { test_of(c, RunKind::push).clamped = {-1}; });
    expect_test_refused({"joint 1 is under test and clamped"}, [](Campaign& c) {
        test_of(c, RunKind::pull).clamped = {0, 1};
    });
    expect_test_refused({"run slide", "is a test of a joint", "Name the joint"},
                        [](Campaign& c) { test_of(c, RunKind::slide).joint.reset(); });
    expect_test_refused({"present names block 7", "the blocks are 0 to 2"}, [](Campaign& c) {
        test_of(c, RunKind::slide).present = {0, 1, 7};
    });
    expect_test_refused({"the tested joint names block 2", "not among the blocks present"},
                        [](Campaign& c) { test_of(c, RunKind::slide).joint = 2; });
}

TEST(JointTestCheck, TapedGroupsHangTogether)
{
    expect_test_refused({"blocks 0 and 2", "not adjacent"}, [](Campaign& c) {
        MeasuredRun& run = test_of(c, RunKind::pull);
        run.present.clear();
        run.taped = {{0, 2}};
    });
    expect_test_refused({"fewer than two"}, [](Campaign& c) { test_of(c, RunKind::pull).taped = {{1}}; });
    expect_test_refused({"block 1 twice"}, [](Campaign& c) { test_of(c, RunKind::pull).taped = {{0, 1}, {1, 0}}; });
    Campaign campaign = campaign_with_tests();
    MeasuredRun& run = test_of(campaign, RunKind::pull);
    run.present.clear();
    for (Series* series : {&run.blocks.x_m, &run.blocks.y_m, &run.blocks.theta_rad})
        for (double& value : series->values)
            value = std::isnan(value) ? 0.1 : value;
    run.taped = {{2, 0, 1}}; // in any order
    const MeasuredFolder folder("taped");
    write_campaign(campaign, folder / "a.h5");
    expect_same(campaign, read_campaign(folder / "a.h5"));
}

TEST(JointTestCheck, DummiesAreKnownBodies)
{
    expect_test_refused({"run tilt", "mass_kg = 0", "Weigh it"},
                        [](Campaign& c) { test_of(c, RunKind::tilt).dummies[1].mass_kg = 0; });
    expect_test_refused({"half_height_m = 0"},
                        [](Campaign& c) { test_of(c, RunKind::tilt).dummies[0].half_height_m = 0; });
    expect_test_refused({"dummies names block 2", "not among the blocks present"},
                        [](Campaign& c) { test_of(c, RunKind::tilt).dummies[0].block = 2; });
}

TEST(JointTestCheck, ForcesActOnTheBody)
{
    expect_test_refused({"run pull", "needs the force", "no gauge"},
                        [](Campaign& c) { test_of(c, RunKind::pull).forces.clear(); });
    expect_test_refused({"run push", "force/Rod_A/value_n is absent", "force_Rod_A_n"},
                        [](Campaign& c) { test_of(c, RunKind::push).forces[0].value_n = {}; });
    expect_test_refused({"height_m = 7.25", "from 0 to 0.029 m", "Did you mean 0.00725?"},
                        [](Campaign& c) { test_of(c, RunKind::pull).forces[0].height_m = 7.25; });
    expect_test_refused({"gain_sd = 3"}, [](Campaign& c) { test_of(c, RunKind::pull).forces[0].gain_sd = 3; });
    expect_test_refused({"beyond 1e+07 N"},
                        [](Campaign& c) { test_of(c, RunKind::pull).forces[0].value_n.values[4] = 1e9; });
    expect_test_refused({"force/Rod_A names block 2", "not among"},
                        [](Campaign& c) { test_of(c, RunKind::pull).forces[0].block = 2; });
}

TEST(JointTestCheck, TiltsAreRadians)
{
    expect_test_refused({"run board", "base/tilt_rad has the value 39", "degrees", "0.68"}, [](Campaign& c) {
        std::vector<double>& tilt = test_of(c, RunKind::board).base_tilt_rad.values;
        for (std::size_t i = 0; i < tilt.size(); ++i)
            tilt[i] = 39.0 * static_cast<double>(i) / static_cast<double>(tilt.size() - 1);
        tilt.front() = 39;
    });
    for (const RunKind kind : {RunKind::board, RunKind::tilt})
        expect_test_refused({std::string("run ") + to_string(kind), "base/tilt_rad is absent", "base_tilt_deg"},
                            [&](Campaign& c) { test_of(c, kind).base_tilt_rad = {}; });
}

TEST(JointTestCheck, BlocksAreThoseSaid)
{
    expect_test_refused({"run drop", "blocks/x_m has values of block 2", "not among the blocks present"},
                        [](Campaign& c) { test_of(c, RunKind::drop).blocks.x_m.values[122 - 3] = 0.01; });
    expect_test_refused({"run drop", "block 1 is present but was never seen"}, [](Campaign& c) {
        MeasuredRun& run = test_of(c, RunKind::drop);
        for (Series* series : {&run.blocks.x_m, &run.blocks.y_m, &run.blocks.theta_rad})
            for (std::size_t i = 1; i < series->values.size(); i += 3)
                series->values[i] = nan_value;
    });
}

TEST(JointTestCheck, SpecimenAndLaboratoryAreSi)
{
    expect_test_refused({"centre_of_mass_m: 0.2 of block 0", "Did you mean 0.0002?"},
                        [](Campaign& c) { c.specimen.centre_of_mass_m[0] = 0.2; });
    expect_test_refused({"bearing_left_m: 0.3 of joint 1"}, [](Campaign& c) { c.specimen.bearing_left_m[1] = 0.3; });
    expect_test_refused({"laboratory: tilt_rad = 40"}, [](Campaign& c) { c.laboratory.tilt_rad = 40; });
    expect_test_refused({"laboratory: cost_pull = 0"}, [](Campaign& c) { c.laboratory.cost[0].second = 0; });

    const MeasuredFolder folder("joints");
    Campaign campaign = campaign_with_tests();
    campaign.specimen.bearing_right_m.pop_back();
    EXPECT_NE(refusal([&] {
                  write_campaign(campaign, folder / "a.h5");
              }).find("bearing_right_m has 2 values where the specimen has 3 joints"),
              std::string::npos);
}

/// A run of 10 samples whose table another program has written.
constexpr const char* tracked_toml = R"toml([campaign]
format = "stylobate-measured"
format_version = 2

[specimen]
half_width_m = [0.024, 0.024]
half_height_m = [0.0145, 0.0145]
depth_m = [0.048, 0.048]
mass_kg = [0.1355, 0.1355]
rest_x_m = [0.0, 0.0]
rest_y_m = [0.0145, 0.0435]
joints = [[-1, 0], [0, 1]]

[columns]
"Frame" = "ignore"
"Time (ms)" = "time_ms"
"Marker3 X [mm]" = "x1_mm"
"Marker3 Y [mm]" = "y1_mm"
"Marker3 angle" = "theta1_deg"
"Rod [N]" = "force_rod_n"

[[run]]
name = "a"
kind = "push"
joint = 1
present = [0, 1]
clamped = [0]

[[run.force]]
name = "rod"
block = 1
height_m = 0.026
)toml";

std::string tracked_csv(const std::string& header = "Frame,Time (ms),Marker3 X [mm],Marker3 Y [mm],Marker3 angle,"
                                                    "Rod [N]")
{
    std::string text = header + "\n";
    for (int i = 0; i < 10; ++i)
        text += std::to_string(i) + "," + std::to_string(2 * i) + "," + std::to_string(i) + ",43.5,90,0.5\n";
    return text;
}

class MeasuredColumns : public ::testing::Test {
protected:
    MeasuredColumns() { fs::create_directories(folder / "a/runs"); }
    Campaign read(const std::string& toml, const std::string& csv)
    {
        write_content(folder / "a/campaign.toml", toml);
        write_content(folder / "a/runs/a.csv", csv);
        return read_campaign(folder / "a");
    }
    void expect_table_refused(const std::vector<std::string>& parts, const std::string& toml, const std::string& csv)
    {
        const std::string text = refusal([&] { read(toml, csv); });
        EXPECT_FALSE(text.empty()) << parts.front();
        for (const std::string& part : parts)
            EXPECT_NE(text.find(part), std::string::npos) << part << " not in: " << text;
    }
    MeasuredFolder folder{"columns"};
};

TEST_F(MeasuredColumns, AnotherProgramsTableIsRead)
{
    const Campaign campaign = read(tracked_toml, tracked_csv());
    ASSERT_EQ(campaign.tests.size(), 1u);
    const MeasuredRun& run = campaign.tests[0];
    EXPECT_DOUBLE_EQ(run.time_s[9], 0.018);
    EXPECT_DOUBLE_EQ(run.blocks.x_m.values[19], 0.009);
    EXPECT_TRUE(std::isnan(run.blocks.x_m.values[18]));
    EXPECT_DOUBLE_EQ(run.blocks.theta_rad.values[1], std::numbers::pi / 2);
    EXPECT_EQ(run.forces[0].value_n.values, std::vector<double>(10, 0.5));
    EXPECT_FALSE(run.forces[0].to_laboratory) << "a rod that pushes is on the table";
}

TEST_F(MeasuredColumns, ConflictsAreRefused)
{
    expect_table_refused({"campaign.toml:17", "has the unit m, but the column is named in mm"},
                         replaced(tracked_toml, "\"x1_mm\"", "\"x1_m\""), tracked_csv());
    expect_table_refused({"has the unit s, but the column is named in ms"},
                         replaced(tracked_toml, "\"time_ms\"", "\"time_s\""), tracked_csv());
    expect_table_refused({"\"Marker3 X [mm]\" and \"Marker3 Y [mm]\" are the same series"},
                         replaced(tracked_toml, "\"y1_mm\"", "\"x1_mm\""), tracked_csv());
    expect_table_refused({"\"Marker3 X [mm]\" and \"x1_m\" are the same series"}, tracked_toml,
                         tracked_csv("Frame,Time (ms),Marker3 X [mm],Marker3 Y [mm],x1_m,Rod [N]"));
    expect_table_refused({"is no name of a column", "x0_m"}, replaced(tracked_toml, "\"x1_mm\"", "\"x1_furlong\""),
                         tracked_csv());
    expect_table_refused({"the column \"Marker3 Z [mm]\" is not known", "Did you mean \"Marker3 "}, tracked_toml,
                         tracked_csv("Frame,Time (ms),Marker3 Z [mm],Marker3 Y [mm],Marker3 angle,Rod [N]"));
    expect_table_refused({"is of a gauge \"rod\" that the run does not have", "[[run.force]]"},
                         replaced(tracked_toml, "name = \"rod\"", "name = \"other\""), tracked_csv());
}

TEST_F(MeasuredColumns, NamesThatNoTableHasAreReported)
{
    const Campaign campaign =
        read(replaced(tracked_toml, "\"Rod [N]\"", "\"Rob [N]\" = \"ignore\"\n\"Rod [N]\""), tracked_csv());
    EXPECT_TRUE(finding_at(campaign, "columns, \"Rob [N]\"", "no table has"));
    EXPECT_FALSE(finding_at(campaign, "columns, \"Rod [N]\"", ""));
}

TEST_F(MeasuredColumns, AForceNeedsItsHeightAndBlock)
{
    expect_table_refused({"height_m is missing", "lower face"}, replaced(tracked_toml, "height_m = 0.026", ""),
                         tracked_csv());
    expect_table_refused({"block is missing"}, replaced(tracked_toml, "block = 1\nheight", "height"), tracked_csv());
    expect_table_refused({"\"floor\"", "laboratory"}, std::string(tracked_toml) + "to = \"floor\"\n", tracked_csv());
    expect_table_refused({"mass_kg"}, std::string(tracked_toml) + "[[run.dummy]]\nblock = 1\n", tracked_csv());
}

TEST(JointTestsOfAnotherFile, ContinueTheSequence)
{
    Campaign campaign = campaign_with_tests(), more = campaign_with_tests();
    const std::size_t before = campaign.tests.size();
    campaign.tests.back().run_order = 40;
    for (std::size_t r = 0; r < more.tests.size(); ++r)
        more.tests[r].run_order = static_cast<int>(r);
    more.source = "more.h5";
    more.specimen.centre_of_mass_m = {0, 0, 5e-4};
    more.specimen.bearing_left_m.clear();
    more.specimen.mass_kg[0] *= 1.004; // weighed anew
    add_tests_of(more, campaign);
    ASSERT_EQ(campaign.tests.size(), 2 * before);
    for (std::size_t r = before; r < campaign.tests.size(); ++r)
        EXPECT_EQ(campaign.tests[r].run_order, 41 + static_cast<int>(r - before)) << "after those that are there";
    EXPECT_EQ(campaign.specimen.centre_of_mass_m[2], 5e-4);
    EXPECT_EQ(campaign.specimen.bearing_left_m[1], 0.0003) << "not measured again";
    EXPECT_TRUE(finding_at(campaign, "more.h5", "1 shake runs are left out"));

    more.specimen.mass_kg[0] *= 1.05;
    const std::string text = refusal([&] { add_tests_of(more, campaign); });
    for (const char* part : {"more.h5", "another specimen", "mass_kg", "block 0"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_EQ(campaign.tests.size(), 2 * before) << "nothing is added";
}

} // namespace
} // namespace stylobate
