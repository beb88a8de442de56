/// Every check of measured data fires on what it is for, and not on good data.

#include "io/measured/measured_check.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_layout.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace stylobate {
namespace {

using Change = std::function<void(Campaign&)>;

/// The warning or note that a change brings about.
void expect_found(Severity severity, const std::string& place, const std::string& part, const Change& change)
{
    Campaign campaign = sample_campaign();
    change(campaign);
    check_campaign(campaign);
    for (const Finding& finding : campaign.findings)
        if (finding.severity == severity && finding.place == place && finding.text.find(part) != std::string::npos)
            return;
    ADD_FAILURE() << place << ": " << part << " not among " << campaign.findings.size() << " findings"
                  << (campaign.findings.empty()
                          ? ""
                          : ", the first: " + campaign.findings[0].place + ": " + campaign.findings[0].text);
}

void expect_refused(const std::string& part, const Change& change)
{
    Campaign campaign = sample_campaign();
    change(campaign);
    const std::string text = refusal([&] { check_campaign(campaign); });
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in: " << text;
}

TEST(MeasuredCheck, GoodDataPass)
{
    Campaign campaign = sample_campaign();
    check_campaign(campaign);
    for (const Finding& finding : campaign.findings)
        ADD_FAILURE() << finding.place << ": " << finding.text;
}

TEST(MeasuredCheck, PracticeCampaignsBringNoWarning)
{
    const auto files = practice_campaigns();
    if (files.empty())
        GTEST_SKIP() << "no practice campaigns beside this checkout";
    for (const auto& file : files)
        for (const Finding& finding : read_campaign(file).findings) {
            EXPECT_EQ(finding.severity, Severity::note) << file << ' ' << finding.place << ": " << finding.text;
            EXPECT_TRUE(finding.text.find("zero of the cameras") != std::string::npos ||
                        finding.text.find("the command") != std::string::npos)
                << file << ' ' << finding.place << ": " << finding.text;
        }
}

TEST(MeasuredCheck, SizesInOtherUnitsAreRefused)
{
    expect_refused("Did you mean 0.024?", [](Campaign& c) { c.specimen.half_width_m[0] = 24; });
    expect_refused("specimen/half_height_m: 30000 of block 2",
                   [](Campaign& c) { c.specimen.half_height_m[2] = 30000; });
    expect_refused("mass in grams", [](Campaign& c) { c.specimen.mass_kg[1] = 135.5; });
    expect_refused("density of 101", [](Campaign& c) { c.specimen.mass_kg[1] = 0.00677; });
    expect_refused("rest_y_m", [](Campaign& c) { c.specimen.rest_y_m[0] = 435; });
    expect_refused("gravity_m_s2", [](Campaign& c) { c.specimen.gravity_m_s2 = -9.81; });
    expect_refused("blocks/x_m has the value", [](Campaign& c) { c.runs[1].blocks.x_m.values[7] = 450; });
}

TEST(MeasuredCheck, ContradictoryGeometryIsRefused)
{
    expect_refused("joint 1: blocks 0 and 1 do not touch at rest", [](Campaign& c) { c.specimen.rest_y_m[1] += 0.01; });
    expect_refused("joint 2: blocks 1 and 2 are beside each other", [](Campaign& c) { c.specimen.rest_x_m[2] = 0.1; });
    expect_refused("block 2 has no joint", [](Campaign& c) { c.specimen.joints.pop_back(); });
    expect_refused("blocks 0 and 2 overlap", [](Campaign& c) {
        c.specimen.rest_y_m[2] = c.specimen.rest_y_m[0] + 0.005;
        c.specimen.joints[2] = {-1, 1};
        c.specimen.joints[1] = {0, 1};
        c.specimen.joints[0] = {-1, 0};
        c.specimen.joints.pop_back();
        c.specimen.joints.emplace_back(1, 2);
        c.specimen.half_height_m[2] = 0.0145;
        c.specimen.rest_y_m[1] = c.specimen.rest_y_m[0] + 0.029;
        c.specimen.joints.clear();
    });
}

TEST(MeasuredCheck, ClocksAreChecked)
{
    expect_refused("A clock must increase", [](Campaign& c) { c.runs[0].time_s[9] = c.runs[0].time_s[8]; });
    expect_refused("none is missing", [](Campaign& c) { c.runs[0].time_s[9] = nan_value; });
    expect_found(Severity::warning, "run 001, time_s", "1 gap", [](Campaign& c) {
        for (std::size_t i = 800; i < c.runs[1].time_s.size(); ++i)
            c.runs[1].time_s[i] += 0.004;
    });
    expect_found(Severity::note, "run 001, time_s", "resampled", [](Campaign& c) { c.runs[1].time_s[8] += 0.0005; });
    expect_found(Severity::warning, "run 001, time_s", "the clock is used",
                 [](Campaign& c) { c.runs[1].rate_hz = 200; });
    expect_found(Severity::note, "run 001, base", "its clock (\"table\")",
                 [](Campaign& c) { c.runs[1].base_clock = "table"; });
}

TEST(MeasuredCheck, SensorsAreChecked)
{
    const std::string acceleration = "run 000, base/acceleration_m_s2";
    expect_found(Severity::warning, acceleration, "saturated", [](Campaign& c) {
        for (double& a : c.runs[0].base_acceleration_m_s2.values)
            a = std::clamp(a, -0.4, 0.4);
    });
    expect_found(Severity::warning, acceleration, "it has a constant offset of", [](Campaign& c) {
        for (double& a : c.runs[0].base_acceleration_m_s2.values)
            a += 0.1;
    });
    expect_found(Severity::warning, acceleration, "before the motion its mean is 0.1", [](Campaign& c) {
        c.runs[0].base_displacement_m = {};
        for (double& a : c.runs[0].base_acceleration_m_s2.values)
            a += 0.1;
    });
    expect_found(Severity::warning, "run 000, base", "integrated twice is", [](Campaign& c) {
        for (double& a : c.runs[0].base_acceleration_m_s2.values)
            a *= 0.9;
    });
    expect_found(Severity::note, "run 000, base", "the command",
                 [](Campaign& c) { c.runs[0].base_source = BaseSource::command; });
    expect_found(Severity::warning, acceleration, "noise_sd is 0.002",
                 [](Campaign& c) { c.runs[0].base_acceleration_m_s2.noise_sd = 0.002; });
    expect_found(Severity::warning, "run 000, blocks/x_m, block 1", "filtered before?",
                 [](Campaign& c) { c.runs[0].blocks.x_m.noise_sd = 5e-4; });
    expect_refused("noise_sd = -1", [](Campaign& c) { c.runs[0].blocks.x_m.noise_sd = -1; });
    expect_found(Severity::warning, "run 001, base/acceleration_m_s2", "it repeats motion 0 of run 000",
                 [](Campaign& c) {
                     std::vector<double>& a = c.runs[1].base_acceleration_m_s2.values;
                     std::rotate(a.begin(), a.begin() + 30, a.end()); // 60 ms
                 });
    expect_found(Severity::note, "run 001, repeat", "the same motion_id 0 and repeat 0",
                 [](Campaign& c) { c.runs[1].repeat = 0; });
}

TEST(MeasuredCheck, MissingValuesAreToldOrRefused)
{
    expect_refused("run 000: blocks/y_m is NaN everywhere", [](Campaign& c) {
        std::fill(c.runs[0].blocks.y_m.values.begin(), c.runs[0].blocks.y_m.values.end(), nan_value);
    });
    expect_found(Severity::note, "run 000, blocks/x_m, block 1", "1 of 1501 values are missing",
                 [](Campaign& c) { c.runs[0].blocks.x_m.values[3 * 700 + 1] = nan_value; });
    expect_found(Severity::warning, "run 000, blocks/x_m, block 2", "never seen", [](Campaign& c) {
        for (std::size_t i = 2; i < c.runs[0].blocks.x_m.values.size(); i += 3)
            c.runs[0].blocks.x_m.values[i] = nan_value;
    });
}

TEST(MeasuredCheck, RestPlacesAreChecked)
{
    expect_found(Severity::note, "run 000, blocks/x_m", "12 mm from their nominal positions: the zero of the cameras",
                 [](Campaign& c) {
                     for (double& x : c.runs[0].blocks.x_m.values)
                         x += 0.012;
                 });
    expect_found(Severity::warning, "run 000, blocks/x_m, block 1", "at rest it is 5 mm", [](Campaign& c) {
        for (std::size_t i = 1; i < c.runs[0].blocks.x_m.values.size(); i += 3)
            c.runs[0].blocks.x_m.values[i] += 0.005;
    });
    expect_found(Severity::warning, "run 000, blocks/theta_rad, block 2", "rotated by 0.03", [](Campaign& c) {
        for (std::size_t i = 2; i < c.runs[0].blocks.theta_rad.values.size(); i += 3)
            c.runs[0].blocks.theta_rad.values[i] += 0.03;
    });
}

TEST(MeasuredCheck, CollapsesAreChecked)
{
    const std::string place = "run 000, collapsed";
    expect_found(Severity::warning, place, "collapse_time_s = 1", [](Campaign& c) { c.runs[0].collapse_time_s = 1; });
    expect_found(Severity::warning, place, "outside the clock", [](Campaign& c) { c.runs[0].collapse_time_s = 9; });
    expect_found(Severity::warning, place, "block 2 lies on its side",
                 [](Campaign& c) { c.runs[0].blocks.theta_rad.values.back() = 1.5; });
    expect_found(Severity::warning, place, "upright and visible", [](Campaign& c) { c.runs[0].collapsed = true; });
}

} // namespace
} // namespace stylobate
