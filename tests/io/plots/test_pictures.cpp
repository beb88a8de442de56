/// Pictures decoded and their colours counted; what a drawing has; what is said when there is no picture.

#include "io/plots/picture_file.hpp"
#include "io/plots/plot_maps.hpp"
#include "io/plots/plot_strip.hpp"
#include "io/plots/plot_surface.hpp"
#include "io/store/surface_axis.hpp"
#include "tests/io/plots/pixels.hpp"
#include "tests/io/store/export_cases.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

using Pictures = ExportFolder;

/// Sets a variable of the environment for the length of a scope.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name)
    {
        if (const char* old = std::getenv(name))
            old_ = old;
        ::setenv(name, value.c_str(), 1);
    }
    ~Environment()
    {
        if (old_.empty())
            ::unsetenv(name_);
        else
            ::setenv(name_, old_.c_str(), 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::string old_;
};

/// The points of the first path that has a look, in pixels.
std::vector<std::array<double, 2>> points_of(const std::string& svg, const std::string& look)
{
    for (std::size_t at = svg.find("<path d=\""); at != std::string::npos; at = svg.find("<path d=\"", at + 1)) {
        const std::string element = svg.substr(at, svg.find("/>", at) - at);
        if (element.find(look) == std::string::npos)
            continue;
        std::string data = element.substr(9, element.find('"', 9) - 9);
        std::replace_if(
            data.begin(), data.end(), [](char c) { return c == 'M' || c == 'L' || c == 'Z'; }, ' ');
        std::istringstream in(data);
        std::vector<std::array<double, 2>> points;
        for (std::array<double, 2> p{}; in >> p[0] >> p[1];)
            points.push_back(p);
        return points;
    }
    return {};
}

/// The numbers that stand at the left of a panel: the height of their middle [px] and what they say.
std::vector<std::pair<double, std::string>> numbers_at_axis(const std::string& svg)
{
    std::vector<std::pair<double, std::string>> numbers;
    const std::regex text("<text x=\"[0-9.]+\" y=\"([0-9.]+)\" text-anchor=\"end\"[^>]*>(-?[0-9.e+-]+)</text>");
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), text); it != std::sregex_iterator(); ++it)
        numbers.emplace_back(std::stod((*it)[1]) - 0.35 * 26, (*it)[2]); // the baseline of type of 26 px
    return numbers;
}

TEST(CellAxis, ScaleAndCells)
{
    const CellAxis log = make_cell_axis({1, 10, 100}, "frequency_hz");
    EXPECT_TRUE(log.log);
    EXPECT_NEAR(log.edges[0], std::pow(10, -0.5), 1e-12);
    EXPECT_NEAR(log.edges[1], std::pow(10, 0.5), 1e-12);
    EXPECT_NEAR(log.edges[3], std::pow(10, 2.5), 1e-10);
    const CellAxis linear = make_cell_axis({1, 2, 3}, "pga_m_s2");
    EXPECT_FALSE(linear.log);
    EXPECT_EQ(linear.edges, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
    EXPECT_EQ(make_cell_axis({1, 12}, "pga_m_s2").edges.front(), 0);
    const CellAxis lone = make_cell_axis({4}, "pga_m_s2");
    EXPECT_LT(lone.edges[0], 4);
    EXPECT_GT(lone.edges[1], 4);
    EXPECT_THROW(make_cell_axis({}, "pga_m_s2"), InputError);
    EXPECT_THROW(make_cell_axis({1, 1}, "pga_m_s2"), InputError);
    EXPECT_THROW(make_cell_axis({1, no_number}, "pga_m_s2"), InputError);
}

TEST(Texts, Words)
{
    EXPECT_EQ(describe_interval("wilson 0.95"), "95 % Wilson interval");
    EXPECT_EQ(describe_interval("jeffreys 0.999"), "99.9 % Jeffreys interval");
    EXPECT_EQ(describe_interval("motions 0.95"), "95 % interval, clustered by motion");
    EXPECT_EQ(describe_interval("something else"), "something else");
    EXPECT_EQ(describe_interval(""), "");
    SurfaceTable surface = some_surface(3, 2);
    EXPECT_EQ(describe_realizations(surface), "1536 realizations, 256 in each of 3 × 2 cells");
    surface.trials[1] = 250;
    EXPECT_EQ(describe_realizations(surface), "1530 realizations, 250 to 256 in each of 3 × 2 cells");
}

TEST(Slice, NearestRowsOnTheAxisScale)
{
    SurfaceTable surface = some_surface();
    surface.frequency_hz = {1, 2, 4, 8, 16};
    // 2.9 is nearer to 4 on the logarithmic axis (midpoint 2.828), 2.8 to 2; two that meet in one row are one.
    EXPECT_EQ(slice_rows(surface, {2.9}), std::vector<std::size_t>{2});
    EXPECT_EQ(slice_rows(surface, {2.8}), std::vector<std::size_t>{1});
    EXPECT_EQ(slice_rows(surface, {16, 1, 15}), (std::vector<std::size_t>{0, 4}));
    EXPECT_EQ(slice_rows(surface, {}), (std::vector<std::size_t>{0, 2, 4}));
    for (const double bad : {0.0, -1.0, 0.9, 17.0, no_number}) // none is drawn instead of another
        EXPECT_THROW(slice_rows(surface, {bad}), InputError);
    EXPECT_THROW(slice_rows(surface, std::vector<double>(7, 1.0)), InputError);
}

TEST(Strip, SnapshotsAreAscendingAndCatchTheMotion)
{
    // At rest but for one swing, 2.00 to 2.50 s.
    Trajectory t = some_trajectory(2, 0.5, 1, 1001);
    for (std::size_t s = 0; s < 1001; ++s) {
        const double u = (static_cast<double>(s) - 200) / 50;
        t["theta_rad"][2 * s + 1] = u > 0 && u < 1 ? 0.2 * std::sin(std::acos(-1.0) * u) : 0;
        t["x_m"][2 * s + 1] = 0;
        t["y_m"][2 * s + 1] = 1.5;
    }
    const auto chosen = snapshot_samples(t, 8);
    ASSERT_EQ(chosen.size(), 8U);
    EXPECT_EQ(chosen.front(), 0U);
    EXPECT_EQ(chosen.back(), 1000U);
    EXPECT_EQ(std::set<std::size_t>(chosen.begin(), chosen.end()).size(), 8U);
    EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
    EXPECT_NE(std::find(chosen.begin(), chosen.end(), 225U), chosen.end()) << "the peak of the swing is missed";

    for (const std::size_t samples : {1U, 2U, 7U, 8U, 9U, 10U}) {
        const auto few = snapshot_samples(some_trajectory(3, 1, 1, samples), 8);
        EXPECT_EQ(few.size(), std::min<std::size_t>(samples, 8));
        EXPECT_EQ(std::set<std::size_t>(few.begin(), few.end()).size(), few.size());
        EXPECT_LT(few.back(), samples);
    }
    EXPECT_THROW(snapshot_samples(t, 1), InputError);
    EXPECT_THROW(snapshot_samples(t, 17), InputError);
    t["theta_rad"][2 * 300] = no_number; // what comes after it is not drawn
    EXPECT_EQ(snapshot_samples(t, 8).back(), 299U);
    t["x_m"][0] = no_number;
    EXPECT_THROW(snapshot_samples(t, 8), InputError);
    EXPECT_THROW(snapshot_samples(Trajectory{}, 8), InputError);
}

TEST_F(Pictures, SurfaceShowsItsProbabilities)
{
    const fs::path file = folder / "a surface's \"picture\" 100%.png";
    plot_surface(some_surface(), "collapse", "it's \"q\" _x_ 50 % {a^2} `date` @b & <c> \\n", file);
    const Pixels pixels = decode(file);
    EXPECT_GE(pixels.width, 1600U);
    EXPECT_GE(pixels.height, 1200U);
    EXPECT_GT(pixels.colours, 100U);
    EXPECT_EQ(entries(), 1U) << "something else was left in the folder";

    // Half of the cells sure to collapse, half sure to stand: either end of the colour map over half of the frame.
    SurfaceTable halves = some_surface();
    for (std::size_t cell = 0; cell < halves.probability.size(); ++cell)
        halves.probability[cell] = cell % 12 < 6 ? 0 : 1;
    plot_surface(halves, "collapse", "halves", folder / "halves.png");
    const Pixels two = decode(folder / "halves.png");
    const double frame = 0.76 * 0.75;
    EXPECT_NEAR(share(two, 0x440154, 8), frame / 2, 0.03);
    EXPECT_NEAR(share(two, 0xfde725, 8), frame / 2, 0.03);
    EXPECT_LT(share(two, 0xb8b8b8, 1), 0.001);

    // One of three rows: a third of the frame, whatever lies in the others.
    SurfaceTable rows = some_surface(3, 5);
    rows.frequency_hz = {1, 2, 3};
    for (std::size_t cell = 0; cell < rows.probability.size(); ++cell)
        rows.probability[cell] = cell < 5 ? 1 : 0;
    plot_surface(rows, "collapse", "rows", folder / "rows.png");
    EXPECT_NEAR(share(decode(folder / "rows.png"), 0xfde725, 8), frame / 3, 0.02);

    // Without a trial: grey.
    for (std::size_t cell = 0; cell < 96; ++cell)
        halves.probability[cell] = no_number;
    plot_surface(halves, "collapse", "", folder / "grey.png");
    EXPECT_NEAR(share(decode(folder / "grey.png"), 0xb8b8b8, 1), frame / 2, 0.03);
}

TEST_F(Pictures, SmallAndOddSurfaces)
{
    SurfaceTable one = some_surface(2, 2);
    one.frequency_hz.resize(1);
    one.pga_m_s2.resize(1);
    one.trials = {0};
    one.collapses = {0};
    one.probability = one.lower = one.upper = {no_number};
    plot_surface(one, "collapse", "nothing", folder / "nothing.png");
    EXPECT_GT(decode(folder / "nothing.png").colours, 10U);
    plot_slice(one, {}, "collapse", "nothing", folder / "slice.png");
    EXPECT_GT(decode(folder / "slice.png").colours, 10U);
    one.trials = {4};
    one.probability = {0.5};
    one.lower = {0.1};
    one.upper = {0.9};
    plot_surface(one, "collapse", "one cell", folder / "one.png");
    EXPECT_GT(share(decode(folder / "one.png"), 0x21918c, 8), 0.5);
}

TEST_F(Pictures, SliceShowsEachCurve)
{
    plot_slice(some_surface(), {1, 2, 5}, "collapse", "100 % \"slices\"", folder / "s.png");
    const Pixels pixels = decode(folder / "s.png");
    EXPECT_GE(pixels.width, 1600U);
    EXPECT_GE(pixels.height, 1200U);
    for (const std::uint32_t colour : {0x1f5673U, 0xd55e00U, 0x009e73U})
        EXPECT_GT(share(pixels, colour, 2), 0.0005) << std::hex << colour;
    EXPECT_LT(share(pixels, 0x7b4b94, 2), 1e-5) << "a fourth curve";

    // A band from 0.25 to 0.75 over the eleven twelfths of the axis between the outer cells' centres.
    SurfaceTable flat = some_surface();
    flat.probability.assign(flat.probability.size(), 0.5);
    flat.lower.assign(flat.lower.size(), 0.25);
    flat.upper.assign(flat.upper.size(), 0.75);
    plot_slice(flat, {1}, "collapse", "", folder / "flat.png");
    const Pixels drawn = decode(folder / "flat.png");
    const Extent axes = extent(drawn, 0x5a6672);
    const double area = static_cast<double>(drawn.width) * drawn.height;
    const double frame = (axes.right - axes.left) * (axes.bottom - axes.top) / area;
    // 0.22 of the colour on white; the curve, its marks and grid lines cover a little of it
    EXPECT_NEAR(share(drawn, 0xced9e0, 4), frame * 11 / 12 * 0.5 / 1.03, 0.03);
}

TEST_F(Pictures, SliceShowsCurvesThatCoincide)
{
    SurfaceTable surface = some_surface(3, 12);
    for (std::size_t i = 12; i < 36; ++i) { // all rows as the first one
        surface.probability[i] = surface.probability[i - 12];
        surface.lower[i] = surface.lower[i - 12];
        surface.upper[i] = surface.upper[i - 12];
    }
    plot_slice(surface, surface.frequency_hz, "collapse", "", folder / "same.png");
    const Pixels pixels = decode(folder / "same.png");
    // the curves, without the marks at the cells and the legend: in a column of pixels between two cells each colour is
    // there
    const Extent axes = extent(pixels, 0x5a6672);
    const double pga = 3.5; // midway between two values
    const auto x = static_cast<std::size_t>(axes.left + (axes.right - axes.left) * (pga - 0.5) / 12);
    for (const std::uint32_t colour : {0x1f5673U, 0xd55e00U, 0x009e73U}) {
        std::size_t found = 0;
        for (auto y = static_cast<std::size_t>(axes.top); y < static_cast<std::size_t>(axes.bottom); ++y)
            found += similar(pixels.colour[y * pixels.width + x], colour, 20);
        EXPECT_GE(found, 2U) << std::hex << colour;
    }
}

TEST_F(Pictures, AsTheEndingSays)
{
    plot_surface(some_surface(), "collapse", "A title", folder / "a.svg");
    EXPECT_TRUE(read_file(folder / "a.svg").starts_with("<?xml"));
    EXPECT_NE(read_file(folder / "a.svg").find("A title"), std::string::npos);
    plot_surface(some_surface(), "collapse", "A title", folder / "a.pdf");
    EXPECT_TRUE(read_file(folder / "a.pdf").starts_with("%PDF"));
    plot_surface(some_surface(), "collapse", "A title", folder / "a.png");
    EXPECT_TRUE(read_file(folder / "a.png").starts_with("\x89PNG"));
}

TEST_F(Pictures, TheEndOfAScaleThatMoreLiesBeyondIsMarked)
{
    MapPicture picture;
    picture.frequency_hz = {1, 2, 3};
    picture.pga_m_s2 = {1, 2, 3};
    MapPanel panel;
    panel.high = 2;
    panel.value = {0, 0.5, 1, 1, 1.5, 2, 1, 2, 2};
    picture.panels = {panel};
    picture.columns = 1;
    plot_maps(picture, folder / "inside.svg");
    EXPECT_EQ(read_file(folder / "inside.svg").find("≥"), std::string::npos);
    picture.panels[0].value.back() = 7; // drawn in the same colour
    plot_maps(picture, folder / "beyond.svg");
    EXPECT_NE(read_file(folder / "beyond.svg").find("≥ 2"), std::string::npos);
    picture.panels[0].low = 0.4;
    plot_maps(picture, folder / "both.svg");
    EXPECT_NE(read_file(folder / "both.svg").find("≤ 0.4"), std::string::npos);
}

TEST_F(Pictures, StripDrawsDrumsToScale)
{
    // At rest the drums' area on the picture follows from the scale: 8 snapshots, each B x 7 H, one of 7 drums fixed.
    for (const double size : {1.0, 40.0}) {
        Trajectory t = some_trajectory(7, 0.048 * size, 0.029 * size);
        for (std::size_t k = 0; k < t["x_m"].size(); ++k) {
            t["theta_rad"][k] = 0;
            t["x_m"][k] = k % 7 == 0 ? 0 : 1e-9 * static_cast<double>(k);
            t["y_m"][k] = (static_cast<double>(k % 7) + 0.5) * 0.029 * size;
        }
        plot_strip(t, {}, "strip's 100 % \"title\"", folder / "strip.png");
        const Pixels pixels = decode(folder / "strip.png");
        EXPECT_GE(pixels.width, 1600U);
        EXPECT_GE(pixels.height, 1200U);
        const Extent free_drums = extent(pixels, 0xead9b5);
        const double height = free_drums.bottom - free_drums.top;
        EXPECT_GT(height, 350);
        EXPECT_NEAR(free_drums.area / (8 * height * height), 0.048 / (6 * 0.029), 0.02);
        EXPECT_NEAR(free_drums.area / extent(pixels, 0xa89a7d).area, 6, 0.3);
        EXPECT_GT(share(pixels, 0x6f6f6f, 3), 0.005) << "the base";
        EXPECT_GT(share(pixels, 0x0072b2, 3), 0.0003) << "displacement of the top";
        EXPECT_GT(share(pixels, 0xd55e00, 3), 0.0003) << "displacement of the base";
    }
}

TEST_F(Pictures, StripCountsTheTopFromUpright)
{
    // A block that starts leaned by 0.1 rad about its corner: drawn is where its centre is against upright,
    // h sin(theta) + b (1 - cos(theta)) to the left, and not how far it has gone from its lean.
    Trajectory t = some_trajectory(1, 0.5, 2, 2);
    const double theta[] = {0.1, -0.05};
    for (std::size_t s = 0; s < 2; ++s) {
        const double lean = std::abs(theta[s]);
        t["theta_rad"][s] = theta[s];
        t["x_m"][s] = (theta[s] > 0 ? -1 : 1) * (std::sin(lean) + 0.25 * (1 - std::cos(lean)));
        t["y_m"][s] = std::cos(lean) + 0.25 * std::sin(lean);
    }
    plot_strip(t, {}, "", folder / "strip.svg");
    const std::string svg = read_file(folder / "strip.svg");
    const std::vector<std::array<double, 2>> drawn = points_of(svg, "stroke:#0072b2");
    ASSERT_EQ(drawn.size(), 2U);
    // the numbers beside the panel give its scale: those at heights between the two points, or near them
    std::map<double, double> value_at; // pixels to mm
    for (const auto& [y, text] : numbers_at_axis(svg))
        if (y > std::min(drawn[0][1], drawn[1][1]) - 25 && y < std::max(drawn[0][1], drawn[1][1]) + 25)
            value_at[y] = std::stod(text);
    ASSERT_GE(value_at.size(), 2U);
    const auto [y0, v0] = *value_at.begin();
    const auto [y1, v1] = *value_at.rbegin();
    for (std::size_t s = 0; s < 2; ++s) {
        const double drawn_mm = v0 + (drawn[s][1] - y0) / (y1 - y0) * (v1 - v0);
        EXPECT_NEAR(drawn_mm, 1000 * t["x_m"][s], 1.5) << s; // a point of the axis is 1.5 mm
    }
}

TEST_F(Pictures, StripTurnsDrumsCounterClockwise)
{
    // Two samples, two snapshots of one drum in the air.
    const double width = 2;
    const double height = 1;
    const double angle = 0.4;
    Trajectory t = some_trajectory(1, width, height, 2);
    t["theta_rad"] = {angle, angle};
    t["x_m"] = {0, 1e-9};
    t["y_m"] = {1, 1};
    plot_strip(t, {}, "", folder / "turned.png");
    const Extent drums = extent(decode(folder / "turned.png"), 0xead9b5);
    const double scale = (drums.bottom - drums.top) / (width * std::sin(angle) + height * std::cos(angle));
    EXPECT_NEAR(drums.area / (scale * scale), 2 * width * height, 0.08);
    // The lower left corner is the lowest one: left of the middle of the drum that it belongs to.
    const double drum = scale * (width * std::cos(angle) + height * std::sin(angle));
    const double from_left =
        std::min(std::abs(drums.lowest_x - drums.left), std::abs(drums.lowest_x - drums.right + drum));
    EXPECT_NEAR(from_left, scale * height * std::sin(angle), 0.03 * drum);
}

TEST_F(Pictures, StripHasARodInEverySnapshot)
{
    MechanismSpec rod = neutral_spec(Mechanism::rod, 0.6);
    rod.places = {2};
    rod.values[0] = rod.values[1] = 1e4;
    const std::vector<Fastening> held = fastenings({rod}, 0.6, lay_out(equal_column(3, 0, 1.2, 0.8, 1, 100)));
    const auto lines = [&](const std::vector<Fastening>& fastenings) {
        plot_strip(some_trajectory(3, 1.2, 0.8), {}, "", folder / "rod.svg", 5, fastenings);
        const std::string svg = read_file(folder / "rod.svg");
        std::size_t count = 0;
        for (std::size_t at = svg.find("stroke:#1d2730"); at != std::string::npos;
             at = svg.find("stroke:#1d2730", at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(lines(held), 5U);
    EXPECT_EQ(lines({}), 0U);
}

TEST_F(Pictures, StripOfAnyColumn)
{
    for (const std::size_t blocks : {1U, 2U, 48U}) {
        plot_strip(some_trajectory(blocks, 1.2, 0.8), {}, "column", folder / "c.png", 5);
        EXPECT_GT(decode(folder / "c.png").colours, 50U);
    }
    plot_strip(some_trajectory(3, 1, 1, 1), {}, "one sample", folder / "c.png");
    // A recorded ground far wider than the column does not change its scale.
    Trajectory ground = some_trajectory(1, 0.1, 0.3);
    const double without = [&] {
        plot_strip(ground, {}, "", folder / "c.png");
        return share(decode(folder / "c.png"), 0xead9b5, 3);
    }();
    Trajectory with = ground;
    with["rest_x_m"] = {0, 0};
    with["rest_y_m"] = {0.15, -0.5};
    with["half_width_m"] = {0.05, 50};
    with["half_height_m"] = {0.15, 0.5};
    with.role.push_back(BlockRole::drum); // to be told by its place
    with.name.emplace_back("ground");
    with.column.push_back(-1);
    for (auto* values : {&with["x_m"], &with["y_m"], &with["theta_rad"]}) {
        std::vector<double> both;
        for (const double v : *values) {
            both.push_back(v);
            both.push_back(values == &with["y_m"] ? -0.5 : 0.0);
        }
        *values = both;
    }
    plot_strip(with, {}, "", folder / "c.png");
    EXPECT_NEAR(share(decode(folder / "c.png"), 0xead9b5, 3), without, 1e-3 * without);
}

/// Of the first and the last sample alone, so that two snapshots are drawn, in which no block covers another.
FallingColonnade before_and_after()
{
    FallingColonnade c = falling_colonnade(2);
    const FallingColonnade all = falling_colonnade();
    const std::size_t blocks = all.trajectory.blocks();
    Trajectory& t = c.trajectory;
    t.time_s.back() = all.trajectory.time_s.back();
    for (const char* pose : {"x_m", "y_m", "theta_rad"}) {
        const std::vector<double>& from = all.trajectory[pose];
        std::copy(from.end() - static_cast<std::ptrdiff_t>(blocks), from.end(),
                  t[pose].begin() + static_cast<std::ptrdiff_t>(blocks));
    }
    return c;
}

TEST_F(Pictures, StripOfAFallenColonnadeHoldsEveryBlock)
{
    const FallingColonnade c = before_and_after();
    plot_strip(c.trajectory, c.fall_time_s, "colonnade", folder / "c.png");
    const Pixels pixels = decode(folder / "c.png");
    const Extent drums = extent(pixels, 0xead9b5);
    const Extent fixed = extent(pixels, 0xa89a7d);
    const Extent epistyles = extent(pixels, 0xb9cddb);
    // areas: 12 free drums and 3 fixed ones of 1.2 x 1, two epistyles of 3 x 0.8; outlines take a little from each
    EXPECT_NEAR(drums.area / fixed.area, 4, 0.12);
    EXPECT_NEAR(drums.area / epistyles.area, 3, 0.09);
    // One scale for both axes: from the left edge of the first fixed drum to the right edge of the third are 7.2 m,
    // from their lower edge to the epistyles' upper one 5.8 m.
    const auto row = static_cast<std::size_t>(fixed.bottom) - 10;
    double right = 0;
    int runs = 0;
    for (std::size_t k = 1; k < pixels.width && runs < 3; ++k) {
        const auto is_fixed = [&](std::size_t i) {
            return similar(pixels.colour[row * pixels.width + i], 0xa89a7d, 3);
        };
        if (is_fixed(k - 1) && !is_fixed(k)) {
            ++runs;
            right = static_cast<double>(k);
        }
    }
    EXPECT_NEAR((right - fixed.left) / 7.2, (fixed.bottom - epistyles.top) / 5.8, 0.5);
    EXPECT_GT(share(pixels, 0xc0271b, 3), 0.001) << "outlines of the fallen, and their panel";

    // what is not known to have fallen is not said to have
    plot_strip(c.trajectory, {}, "colonnade", folder / "unknown.png");
    const Pixels unknown = decode(folder / "unknown.png");
    EXPECT_EQ(share(unknown, 0xc0271b, 3), 0);
    EXPECT_EQ(unknown.height + 243, pixels.height) << "a panel less";
    EXPECT_NEAR(extent(unknown, 0xead9b5).area, drums.area, 0.02 * drums.area);
    // a fall after the last sample is none yet
    std::vector<double> later(17, -1);
    later[3] = 8.5;
    plot_strip(c.trajectory, later, "colonnade", folder / "later.png");
    EXPECT_EQ(share(decode(folder / "later.png"), 0xc0271b, 3), 0);
}

TEST_F(Pictures, StripOfWhatIsWideTakesSeveralRows)
{
    const FallingColonnade c = falling_colonnade();
    plot_strip(c.trajectory, c.fall_time_s, "colonnade", folder / "c.png");
    const Pixels pixels = decode(folder / "c.png");
    EXPECT_GT(pixels.height, 1350U + 243U);
    // In one row of 1593 pixels eight snapshots of at least 7.2 m leave less than 28 pixels for each metre. The fixed
    // drums are never covered: 3 of 1.2 m2 in each snapshot.
    const double pixels_per_m = std::sqrt(extent(pixels, 0xa89a7d).area / (8 * 3.6));
    EXPECT_GT(pixels_per_m, 1.1 * 1593 / (8 * 7.2));
    for (const std::size_t snapshots : {2U, 3U, 5U, 16U}) {
        plot_strip(c.trajectory, c.fall_time_s, "colonnade", folder / "c.png", snapshots);
        EXPECT_GT(extent(decode(folder / "c.png"), 0xb9cddb).area, 1000) << snapshots;
    }
}

TEST_F(Pictures, BadInputLeavesNoFile)
{
    const FallingColonnade c = falling_colonnade(3);
    EXPECT_NE(message_of([&] {
                  plot_strip(c.trajectory, {1.0, 2.0}, "", folder / "a.png");
              }).find("fall times of 2 blocks and a trajectory of 17"),
              std::string::npos);
    for (const auto& change : std::vector<std::function<void(Trajectory&)>>{[](Trajectory& t) { t.role.pop_back(); },
                                                                            [](Trajectory& t) { t.name.pop_back(); }}) {
        Trajectory t = c.trajectory;
        change(t);
        message_of([&] { plot_strip(t, {}, "", folder / "a.png"); });
    }
    SurfaceTable damaged = some_surface();
    damaged.trials.pop_back();
    message_of([&] { plot_surface(damaged, "collapse", "", folder / "a.png"); });
    message_of([&] { plot_slice(damaged, {1}, "collapse", "", folder / "a.png"); });
    message_of([&] { plot_surface(SurfaceTable{}, "collapse", "", folder / "a.png"); });
    message_of([&] { plot_slice(SurfaceTable{}, {1}, "collapse", "", folder / "a.png"); });
    Trajectory flat = some_trajectory(2, 1, 1);
    flat["half_height_m"][1] = 0;
    message_of([&] { plot_strip(flat, {}, "", folder / "a.png"); });
    EXPECT_EQ(entries(), 0U);
    EXPECT_NE(
        message_of([&] { plot_surface(some_surface(), "collapse", "", folder / "missing" / "a.png"); }).find("missing"),
        std::string::npos);
    message_of([&] { plot_surface(some_surface(), "collapse", "", folder); });
    EXPECT_EQ(entries(), 0U);
}

TEST_F(Pictures, WithoutLibrsvgOnlySvg)
{
    // What has been loaded once stays loaded, so a process of its own tries it.
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            ::setenv("STYLOBATE_LIBRSVG", "/none/such.so", 1);
            plot_surface(some_surface(), "collapse", "", folder / "a.svg");
            try {
                plot_surface(some_surface(), "collapse", "", folder / "a.png");
            } catch (const InputError& missing) {
                std::fputs(missing.what(), stderr);
                std::exit(fs::exists(folder / "a.svg") && !fs::exists(folder / "a.png") ? 0 : 1);
            }
            std::exit(2);
        },
        ::testing::ExitedWithCode(0), "apt install librsvg2-2");
}

TEST_F(Pictures, NoFontsIsAnError)
{
    if (std::system("command -v fc-list > /dev/null") != 0)
        GTEST_SKIP() << "fc-list is not installed: fonts cannot be looked for";
    std::ofstream(folder / "fonts.conf") << "<?xml version=\"1.0\"?><fontconfig><dir>" << (folder / "none").string()
                                         << "</dir><cachedir>" << (folder / "cache").string()
                                         << "</cachedir></fontconfig>\n";
    const Environment fonts("FONTCONFIG_FILE", (folder / "fonts.conf").string());
    EXPECT_NE(
        message_of([&] { plot_surface(some_surface(), "collapse", "", folder / "a.png"); }).find("fonts-dejavu-core"),
        std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "a.png"));
}

} // namespace
} // namespace stylobate
