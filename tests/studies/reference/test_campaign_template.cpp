/// Campaigns to begin with: each is read as it stands when its table has rows.

#include "ensemble/model/input_error.hpp"
#include "io/measured/measured_file.hpp"
#include "studies/reference/campaign_template.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>
#include <string>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

/// Twelve rows: the blocks stay in their places, everything else is 0.
std::string table_of_rest(const std::string& header)
{
    std::string text = header + "\n";
    for (int i = 0; i < 12; ++i) {
        std::istringstream names(header);
        std::string row;
        for (std::string name; std::getline(names, name, ',');) {
            row += row.empty() ? "" : ",";
            std::smatch block;
            if (name == "Time [s]")
                row += std::to_string(0.01 * i);
            else if (std::regex_match(name, block, std::regex("Marker([0-9]) Y \\[mm\\]")))
                row += std::to_string(14.5 + 29 * std::stoi(block[1]));
            else
                row += "0";
        }
        text += row + "\n";
    }
    return text;
}

class CampaignTemplates : public testing::TestWithParam<RunKind> {
protected:
    CampaignTemplates()
        : folder_(fs::temp_directory_path() / ("stylobate_template_" + std::to_string(std::random_device{}())))
    {
        fs::create_directories(folder_ / "runs");
    }
    ~CampaignTemplates() override { fs::remove_all(folder_); }

    Campaign read(const std::string& toml, const std::string& rows)
    {
        std::ofstream(folder_ / "campaign.toml") << toml;
        if (!rows.empty())
            std::ofstream(folder_ / "runs" / (made.run + ".csv")) << rows;
        return read_campaign(folder_);
    }

    CampaignTemplate made = campaign_template(GetParam());
    fs::path folder_;
};

TEST_P(CampaignTemplates, IsReadOnceItsTableHasRows)
{
    const RunKind kind = GetParam();
    const Campaign campaign = read(made.toml, made.header.empty() ? "" : table_of_rest(made.header));
    EXPECT_EQ(campaign.specimen.blocks(), 4);
    EXPECT_EQ(campaign.runs.size(), kind == RunKind::shake ? 1u : 0u);
    EXPECT_EQ(campaign.tests.size(), kind == RunKind::shake ? 0u : 1u);
    for (const Finding& finding : campaign.findings)
        EXPECT_EQ(finding.severity, Severity::note) << finding.place << ": " << finding.text;
    const MeasuredRun& run = kind == RunKind::shake ? campaign.runs[0] : campaign.tests[0];
    EXPECT_EQ(run.test, kind);
    EXPECT_EQ(run.forces.size(), kind == RunKind::pull || kind == RunKind::push ? 1u : 0u);
    EXPECT_EQ(run.base_tilt_rad.empty(), kind != RunKind::board && kind != RunKind::tilt);
    if (kind != RunKind::rest) {
        EXPECT_EQ(run.time_s.size(), 12u);
        EXPECT_NEAR(run.blocks.y_m.values[1], 0.0435, 1e-12);
    }
    for (const ForceGauge& gauge : run.forces)
        EXPECT_EQ(gauge.value_n.values.size(), 12u);
}

/// What stands there as a comment is a key, too.
TEST_P(CampaignTemplates, CommentedKeysAreKnown)
{
    std::string text = std::regex_replace(made.toml, std::regex("\n# taped [^\n]*"), "");
    text = std::regex_replace(text, std::regex("\n# ([a-z_0-9]+ = )"), "\n$1");
    const Campaign campaign = read(text, made.header.empty() ? "" : table_of_rest(made.header));
    EXPECT_EQ(campaign.laboratory.force_n, 5);
    EXPECT_EQ(campaign.laboratory.cost, (std::vector<std::pair<RunKind, double>>{{RunKind::pull, 2}}));
    EXPECT_EQ(campaign.specimen.bearing_left_m.size(), 4u);
}

TEST_P(CampaignTemplates, AnEmptyTableOfATestIsRefused)
{
    if (GetParam() == RunKind::shake || GetParam() == RunKind::rest)
        return;
    try {
        read(made.toml, made.header + "\n");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("there are no samples"), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Each, CampaignTemplates, testing::ValuesIn(run_kinds),
                         [](const auto& info) { return std::string(to_string(info.param)); });

} // namespace
} // namespace stylobate
