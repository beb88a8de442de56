/// What is told and drawn of indices: columns that do not collide, too few samples, indices that are not determined.

#include "studies/kinds/sensitivity/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

using namespace stylobate;

namespace {

/// Two factors, one of them with a long name, and intervals around their indices.
SensitivityTable table_of(double lower, double upper)
{
    SensitivityTable table;
    table.method = "sobol";
    table.interval = "resampling 0.95";
    table.outcomes = {"collapse"};
    table.units = {""};
    table.meanings = {"1 if a block has fallen, else 0"};
    table.factors = {"phase", "normal_stiffness_of_every_joint"};
    table.acts = {1, 1};
    table.rows = 200;
    table.mean.add(0.5, 0.4, 0.6);
    table.explained.add(0.5, 0.4, 0.6);
    for (const char* name : {"first", "total", "value_first", "value_total"}) {
        table.indices.push_back({name, {}});
        table.indices.back().of.add(0.25, 0.2, 0.3);
        table.indices.back().of.add(0.1, lower, upper);
    }
    return table;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines(1);
    for (const char c : text)
        if (c == '\n')
            lines.emplace_back();
        else
            lines.back() += c;
    return lines;
}

std::string remarks_of(const SensitivityTable& table)
{
    std::string all;
    for (const std::string& remark : sensitivity_remarks(table))
        all += remark + "\n";
    return all;
}

class SensitivityPicture : public ::testing::Test {
protected:
    std::string drawn(double lower, double upper) const
    {
        const std::filesystem::path png =
            std::filesystem::temp_directory_path() / ("stylobate_sensitivity_" + std::to_string(getpid()) + ".png");
        plot_sensitivity(table_of(lower, upper), "Sensitivity", png);
        std::ifstream file(png, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        std::filesystem::remove(png);
        return bytes;
    }
};

} // namespace

TEST(SensitivityText, ColumnsDoNotCollide)
{
    const std::vector<std::string> lines = lines_of(sensitivity_text(table_of(-0.00021645, 0.0000123456)));
    const std::size_t head = 2;
    ASSERT_NE(lines[head].find("first index"), std::string::npos) << lines[head];
    for (const std::string name :
         {"first index", "total index", "first, of single outcomes", "total, of single outcomes"}) {
        const std::size_t at = lines[head].find(name), end = at + name.size();
        ASSERT_NE(at, std::string::npos) << lines[head];
        for (std::size_t line = head; line < head + 3; ++line) {
            ASSERT_LE(end, lines[line].size()) << lines[line];
            EXPECT_NE(lines[line][end - 1], ' ') << "a column ends under its heading: " << lines[line];
            EXPECT_TRUE(end == lines[line].size() || lines[line].substr(end, 2) == "  ") << lines[line];
        }
    }
}

TEST(SensitivityText, TooFewSamplesAreSaid)
{
    EXPECT_EQ(remarks_of(table_of(0.1, 0.28)).find("Too few"), std::string::npos);
    // 0.4 wide with 200 rows: half of it takes four times as many
    const std::string wide = remarks_of(table_of(-0.1, 0.3));
    EXPECT_NE(wide.find("Raise sensitivity.samples to about 800."), std::string::npos) << wide;
    EXPECT_NE(wide.find("normal stiffness of every joint"), std::string::npos) << wide;
    // nothing of an interval was possible: the index is not determined
    SensitivityTable table = table_of(0.1, 0.2);
    table.indices[0].of.value[1] = table.indices[0].of.lower[1] = table.indices[0].of.upper[1] = std::nan("");
    const std::string outside = remarks_of(table);
    EXPECT_NE(
        outside.find("the interval of the first index of normal stiffness of every joint (collapse) lies outside 0 "
                     "to 1, so it is not determined"),
        std::string::npos)
        << outside;
    EXPECT_NE(outside.find("samples to about 800."), std::string::npos) << outside;
    EXPECT_NE(sensitivity_text(table).find("not determined"), std::string::npos);
}

/// Intervals that reach the ends of the axis, 0 and 1.
TEST_F(SensitivityPicture, IntervalsAreNotCut)
{
    EXPECT_NE(drawn(0, 1), drawn(0.02, 1));
    EXPECT_NE(drawn(0, 1), drawn(0, 0.98));
}
