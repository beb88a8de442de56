/// The figures of a rare event, by hand.

#include "studies/kinds/rare/rare_figures.hpp"
#include "tests/io/plots/pixels.hpp"

#include <cmath>
#include <limits>

namespace stylobate {
namespace {

using RareFigures = ExportFolder;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Two repeats of three and two levels; the second came to no collapse.
RareTable some_rare_event()
{
    RareTable table;
    table.probability = 1e-3;
    table.lower = 4e-4;
    table.upper = 2e-3;
    table.realizations = 560;
    table.repeats = {0.002, 0};
    table.levels = 3;
    table.threshold_m = {no_number, 0.011, 0.015, no_number, 0.012, no_number};
    table.share = {0.1, 0.1, 0.2, 0.1, 0, no_number};
    table.acceptance = table.stuck = {no_number, 0.4, 0.4, no_number, 0.4, no_number};
    return table;
}

TEST_F(RareFigures, ChainsAreTheProductsOfTheShares)
{
    const std::vector<Figure> figures = rare_figures(some_rare_event());
    ASSERT_EQ(figures.size(), 2U);
    ASSERT_EQ(figures[0].series.size(), 2U);
    // by hand: above 11 mm is a tenth, above 15 mm a tenth of it; of the second repeat a tenth is above 12 mm
    EXPECT_EQ(figures[0].series[0].x, (std::vector<double>{0.011, 0.015}));
    EXPECT_EQ(figures[0].series[0].y, (std::vector<double>{0.1, 0.1 * 0.1}));
    EXPECT_EQ(figures[0].series[1].x, (std::vector<double>{0.012}));
    EXPECT_EQ(figures[0].series[1].y, (std::vector<double>{0.1}));
    const FigureSeries& mean = figures[1].series.back();
    EXPECT_EQ(mean.y, (std::vector<double>{1e-3}));
    EXPECT_EQ(mean.low, (std::vector<double>{4e-4}));
    EXPECT_EQ(mean.high, (std::vector<double>{2e-3}));
}

TEST_F(RareFigures, AreAPicture)
{
    plot_rare(some_rare_event(), "it's rare", folder / "rare.svg");
    const std::string svg = read_file(folder / "rare.svg");
    EXPECT_NE(svg.find("it&#39;s rare"), std::string::npos);
    EXPECT_NE(svg.find("1 of 2 repeats without a collapse, counted as 0"), std::string::npos) << svg;
    RareTable open = some_rare_event(); // too few repeats for an interval
    open.lower = open.upper = no_number;
    plot_rare(open, "", folder / "open.png");
    EXPECT_GT(share(decode(folder / "open.png"), 0xd55e00, 2), 0.00002) << "their mean";
    RareTable none = some_rare_event(); // no repeat reached a collapse
    none.probability = none.lower = none.upper = no_number;
    none.repeats = {0, 0};
    plot_rare(none, "", folder / "none.svg");
    EXPECT_NE(read_file(folder / "none.svg").find("no data"), std::string::npos);
    EXPECT_THROW(plot_rare(RareTable{}, "", folder / "empty.png"), InputError);
}

} // namespace
} // namespace stylobate
