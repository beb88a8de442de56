/// What a model leaves out: the sentence against the figures that docs/space.md has, and the table on the pages.

#include "studies/report/left_out.hpp"

#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace stylobate {
namespace {

/// The shares of a row of the table [%], by the words in its first cell.
std::vector<double> shares_of(const HtmlTable& table, const std::string& words)
{
    std::vector<double> shares;
    for (const std::vector<Html>& row : table.rows)
        if (row.front().markup == words)
            for (std::size_t i = 1; i < row.size(); ++i)
                shares.push_back(std::strtod(row[i].markup.c_str(), nullptr));
    return shares;
}

std::string text_of(const std::string& page)
{
    std::ifstream file(std::string(STYLOBATE_SOURCE_DIR) + "/" + page);
    EXPECT_TRUE(file) << page;
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(LeftOut, TheFactorIsThatOfTheMeasuredPage)
{
    const HtmlTable table = left_out_evidence();
    ASSERT_EQ(table.head.size(), 4U);
    EXPECT_EQ(table.head[1].markup, "3 m/s²");
    EXPECT_EQ(table.head[2].markup, "4 m/s²");
    EXPECT_TRUE(table.caption.starts_with("Share of collapsed realizations")) << table.caption;
    EXPECT_EQ(table.align, "lrrr");
    const std::vector<double> plane = shares_of(table, "in the plane, along x"),
                              space = shares_of(table, "round, in space, both components at once");
    ASSERT_EQ(plane.size(), 3U);
    ASSERT_EQ(space.size(), 3U);
    EXPECT_NE(left_out_text(2).find("two to four times as often at a PGA of 3 to 4 m/s²"), std::string::npos);
    EXPECT_EQ(std::lround(space[0] / plane[0]), 4);
    EXPECT_EQ(std::lround(space[1] / plane[1]), 2);
}

/// The table inside the program has every row of the page.
TEST(LeftOut, ThePagesHaveTheTableOfTheMeasuredPage)
{
    const std::string page = text_of("docs/space.md");
    EXPECT_NE(page.find(space_evidence()), std::string::npos);
    const HtmlTable table = left_out_evidence();
    EXPECT_GT(table.rows.size(), 5U);
    for (const std::vector<Html>& row : table.rows) {
        ASSERT_EQ(row.size(), table.head.size());
        EXPECT_NE(page.find("| " + plain_text(row[0]) + " | " + plain_text(row[1]) + " | "), std::string::npos);
    }
    Document html("title", "");
    add_left_out(html, 2);
    const std::string text = html_of(html);
    const std::size_t sentence = text.find("<summary>" + Html(left_out_text(2)).markup + "</summary>"),
                      share = text.find("in the plane, along x"), end = text.find("</details>");
    EXPECT_LT(sentence, share);
    EXPECT_LT(share, end);
    EXPECT_NE(end, std::string::npos);
}

/// Pages of docs with a planar headline number have the sentence, with a link; README has rows of the measured table.
TEST(LeftOut, StandsOnThePagesOfTheDocumentation)
{
    const std::string name = "docs/space.md", sentence = left_out_text(2);
    const std::string before = sentence.substr(0, sentence.find(name));
    for (const char* page : {"README.md", "docs/check.md", "docs/decisions.md", "docs/fragility.md", "docs/past.md",
                             "docs/risk.md", "docs/sensitivity.md", "docs/twins.md"}) {
        const std::string link = page == std::string("README.md") ? name : "space.md";
        EXPECT_NE(text_of(page).find(before + "[" + link + "](" + link + "))."), std::string::npos) << page;
    }
    const std::string start = text_of("README.md"), measured(space_evidence());
    const std::string mark = "<!-- scripts/space.sh writes what follows -->\n\n";
    std::istringstream rows(start.substr(start.find(mark) + mark.size()));
    int compared = 0;
    for (std::string row; std::getline(rows, row) && !row.empty(); ++compared)
        EXPECT_NE(measured.find(row + "\n"), std::string::npos) << row;
    EXPECT_EQ(compared, 5);
}

TEST(LeftOut, IsThatOfTheModelOfTheStudy)
{
    const std::string folder = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/";
    const Study plane = read_study(folder + "small_scale_column.toml"),
                space = read_study(folder + "round_column.toml");
    EXPECT_EQ(left_out_text(plane), left_out_text(2));
    EXPECT_EQ(left_out_text(space), left_out_text(3));
    EXPECT_NE(left_out_text(2), left_out_text(3));
    EXPECT_EQ(left_out_text_of(plane.text), left_out_text(2));
    EXPECT_EQ(left_out_text_of(space.text), left_out_text(3));
    EXPECT_EQ(left_out_text_of("[study]\nkind = \"of another time\"\n"), std::nullopt);
    for (const int dimensions : {2, 3}) { // one sentence with the page of its evidence
        const std::string text = left_out_text(dimensions);
        EXPECT_EQ(text.find(". "), std::string::npos) << text;
        EXPECT_TRUE(text.ends_with(" (docs/space.md).")) << text;
    }
}

} // namespace
} // namespace stylobate
