/// The structure of a study on a page: blocks to scale with taper and capital, and the interventions that are marked.

#include "io/study/study_file.hpp"
#include "studies/results/structure_sketch.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

namespace stylobate {
namespace {

std::size_t times_in(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

Study sketched(const std::string& file, const std::vector<std::string>& settings = {})
{
    return read_study(std::string(STYLOBATE_SOURCE_DIR "/studies/inputs/") + file, settings);
}

const std::string dowels = "mechanisms.dowel={stiffness_n_m=1e8,yield_n=1e5}";

TEST(StructureSketch, HasEveryBlockAndMarksNothingInTheBaseline)
{
    const std::string html = structure_sketch(sketched("doric_column.toml")).markup;
    EXPECT_EQ(times_in(html, "<rect"), 9U + 1U); // eight drums, the capital, the ground
    EXPECT_EQ(html.find("swatch"), std::string::npos);
    EXPECT_EQ(html.find("<line"), std::string::npos);
    // colours are the page's, so that the drawing is dark where the page is
    EXPECT_EQ(html.find('#'), std::string::npos);
}

TEST(StructureSketch, MarksInterventions)
{
    const std::string bars = structure_sketch(sketched("doric_column.toml", {dowels})).markup;
    EXPECT_EQ(times_in(bars, "<line"), 9U); // a bar through each of nine joints
    EXPECT_NE(bars.find("dowel (all 9 joints)"), std::string::npos) << bars;
    const std::string some =
        structure_sketch(
            sketched("doric_column.toml", {"mechanisms.dowel={stiffness_n_m=1e8,yield_n=1e5,joints=[2,3]}"}))
            .markup;
    EXPECT_EQ(times_in(some, "<line"), 2U);
    EXPECT_NE(some.find("dowel (2 of 9 joints)"), std::string::npos) << some;
    const std::string tendon =
        structure_sketch(sketched("doric_column.toml", {"mechanisms.tendon={stiffness_n_m=1e8}"})).markup;
    EXPECT_EQ(times_in(tendon, "<line"), 1U);
    EXPECT_NE(tendon.find("tendon (block 8)"), std::string::npos) << tendon;
    const std::string bearing =
        structure_sketch(sketched("doric_column.toml", {"mechanisms.bearing={stiffness_n_m=1e6}"})).markup;
    EXPECT_NE(bearing.find("bearing (joint 0)"), std::string::npos) << bearing;
}

TEST(StructureSketch, MarksInAComparisonWhatTheBaseDoesNotHave)
{
    const Study base = sketched("doric_column.toml"), doweled = sketched("doric_column.toml", {dowels});
    EXPECT_EQ(structure_sketch(doweled, &doweled).markup.find("swatch"), std::string::npos);
    EXPECT_NE(structure_sketch(doweled, &base).markup.find("dowel (all 9 joints)"), std::string::npos);
    const std::string smoother =
        structure_sketch(sketched("doric_column.toml", {"contact.friction=0.4"}), &base).markup;
    EXPECT_NE(smoother.find("other contact (all 9 joints)"), std::string::npos) << smoother;
    const std::string wider =
        structure_sketch(sketched("doric_column.toml", {"structure.capital={width_m=1.8,height_m=0.5}"}), &base).markup;
    EXPECT_NE(wider.find("other size or mass (block 8)"), std::string::npos) << wider;
}

/// Widths of the polygons of a view, at the lowest and the highest of their corners [px].
std::vector<std::pair<double, double>> lowest_and_highest_widths(const std::string& view)
{
    std::vector<std::pair<double, double>> widths;
    const std::regex polygon("<path d=\"([^\"]*)\" style=\"fill:var"), corner("([-0-9.]+) ([-0-9.]+)");
    for (std::sregex_iterator found(view.begin(), view.end(), polygon), end; found != end; ++found) {
        const std::string corners = (*found)[1];
        double top = 1e9, bottom = -1e9, top_from = 1e9, top_to = -1e9, bottom_from = 1e9, bottom_to = -1e9;
        for (const bool measured : {false, true})
            for (std::sregex_iterator at(corners.begin(), corners.end(), corner); at != end; ++at) {
                const double x = std::stod((*at)[1]), y = std::stod((*at)[2]);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
                if (measured && y < top + 0.11) {
                    top_from = std::min(top_from, x);
                    top_to = std::max(top_to, x);
                }
                if (measured && y > bottom - 0.11) {
                    bottom_from = std::min(bottom_from, x);
                    bottom_to = std::max(bottom_to, x);
                }
            }
        widths.emplace_back(bottom_to - bottom_from, top_to - top_from);
    }
    return widths;
}

TEST(StructureSketch, InSpaceHasTaperAndPlan)
{
    const Study study = sketched("round_column.toml", {"structure.top_width_m=0.7"});
    const std::string html = structure_sketch(study).markup;
    for (const char* view : {"from the front", "from above"})
        EXPECT_NE(html.find(view), std::string::npos) << view;
    EXPECT_EQ(html.find("from the side"), std::string::npos) << "a round column is the same from there";
    const auto widths = lowest_and_highest_widths(html.substr(0, html.find("from the front</div>")));
    ASSERT_EQ(widths.size(), 6U);
    for (const auto& [bottom, top] : widths)
        EXPECT_LT(top, bottom - 0.5);
    EXPECT_NE(sketch_caption(study).find("from above"), std::string::npos);
    EXPECT_EQ(sketch_caption(sketched("doric_column.toml")).find("from above"), std::string::npos);
}

} // namespace
} // namespace stylobate
