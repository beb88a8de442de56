/// Pictures of structures in space: which body hides which, drawings and strips to scale, and what is refused.

#include "ensemble/spatial/spatial_poses.hpp"
#include "io/plots/plot_strip.hpp"
#include "io/plots/plot_structure.hpp"
#include "io/plots/solid_view.hpp"
#include "tests/io/plots/pixels.hpp"

#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

namespace stylobate {
namespace {

using PicturesInSpace = ExportFolder;

/// A stone face that looks at the viewer (brightness 0.62 + 0.38 x 0.699), the line of a fall and of a bed that
/// differs.
constexpr std::uint32_t facing = 0xcfc0a0, red = 0xc0271b;

PlacedSolid prism(const SpacePoint& middle, double x, double y, double z)
{
    return {{y / 2, {x / 2, z / 2}, {x / 2, z / 2}, false}, middle, Attitude()};
}

double polygon_area(const std::vector<ViewPoint>& points)
{
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ViewPoint &a = points[i], &b = points[(i + 1) % points.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

std::vector<std::size_t> order_of(const std::vector<PlacedSolid>& solids, const SolidView& view)
{
    std::vector<std::size_t> order;
    for (const SeenSolid& seen : painted(solids, view))
        order.push_back(seen.body);
    return order;
}

TEST(SolidView, WhatIsInFrontComesLater)
{
    // Two prisms one behind the other along z, and a beam on both.
    const std::vector<PlacedSolid> solids = {prism({0, 2.5, 0}, 1, 1, 5), prism({0, 1, 2}, 1, 2, 1),
                                             prism({0, 1, -2}, 1, 2, 1)};
    EXPECT_EQ(order_of(solids, SolidView::above()).back(), 0U);
    const std::vector<std::size_t> front = order_of(solids, SolidView::front());
    EXPECT_LT(std::ranges::find(front, 2U), std::ranges::find(front, 1U));
    EXPECT_EQ(order_of(solids, SolidView::oblique()), (std::vector<std::size_t>{2, 1, 0}));
    // The middle of a long wall is nearer to the viewer than that of a stone before its far end.
    const std::vector<PlacedSolid> wall = {prism({10, 1, 5.5}, 1, 1, 12), prism({9, 1, -0.2}, 0.5, 1, 0.5)};
    EXPECT_EQ(order_of(wall, {-1.2, 0.2}), (std::vector<std::size_t>{0, 1}));
}

/// The visible faces of a convex body cover its outline once.
/// The abacus' corners lie on one line with the points between them, and the sides below it in no plane.
TEST(SolidView, ACapitalWithAnEchinusLiesBelowItsBeam)
{
    const PlacedSolid capital = {{0.3, {0.4, 0.4}, {0.6, 0.6}, true, true}, {0, 0.3, 0}, Attitude()};
    const std::vector<PlacedSolid> solids = {prism({1.5, 0.95, 0}, 4.2, 0.7, 1), capital};
    const std::vector<std::size_t> below = {1, 0};
    EXPECT_EQ(order_of(solids, SolidView::above()), below);
    EXPECT_EQ(order_of(solids, SolidView::oblique()), below);
    const SeenSolid alone = painted({capital}, SolidView::above()).front();
    double top = 0; // the abacus is seen as a whole
    for (const SeenFace& face : alone.faces)
        top = std::max(top, polygon_area(face.points));
    EXPECT_NEAR(top, 1.44, 1e-12);
}

TEST(SolidView, FacesCoverTheOutline)
{
    for (const bool round : {true, false}) {
        PlacedSolid solid = {{0.6, {0.5, round ? 0.5 : 0.3}, {0.4, round ? 0.4 : 0.25}, round}, {1, 2, 3}, Attitude()};
        for (const std::array<double, 4>& turn :
             {std::array<double, 4>{1, 0, 0, 0}, {0.9, 0.3, -0.2, 0.1}, {0.1, 0.7, 0.2, -0.6}}) {
            solid.attitude = Attitude(turn);
            for (const SolidView& view :
                 {SolidView::front(), SolidView::side(), SolidView::above(), SolidView::oblique()}) {
                const SeenSolid seen = painted({solid}, view).front();
                double sum = 0;
                for (const SeenFace& face : seen.faces) {
                    EXPECT_GT(polygon_area(face.points), 0);
                    EXPECT_GE(face.brightness, 0.62);
                    EXPECT_LE(face.brightness, 1);
                    sum += polygon_area(face.points);
                }
                EXPECT_NEAR(sum, polygon_area(seen.outline), 1e-9);
            }
        }
    }
    const SeenSolid drum = painted({{{1, {1, 1}, {1, 1}, true}, {}, Attitude()}}, SolidView::above()).front();
    EXPECT_NEAR(polygon_area(drum.outline), 12 * std::sin(std::numbers::pi / 12), 1e-12) << "24 sides";
}

/// Two prisms of 2 m x 1.5 m x 1 m, one on the other.
Study two_prisms()
{
    Study study;
    study.structure.dimensions = 3;
    study.contact.friction = 0.68;
    ColumnSpec column;
    column.drums.assign(
        2, {.width_m = 2, .height_m = 1.5, .mass_kg = 8100, .shape = Shape::rectangle, .depth_m = 1, .top_width_m = 2});
    study.structure.columns = {column};
    return study;
}

/// Runs of a colour in a row: from, to.
std::vector<std::pair<double, double>> runs(const Pixels& pixels, std::size_t row, std::uint32_t colour)
{
    std::vector<std::pair<double, double>> found;
    for (std::size_t x = 0; x < pixels.width; ++x) {
        if (pixels.colour[row * pixels.width + x] != colour)
            continue;
        const auto at = static_cast<double>(x);
        if (found.empty() || found.back().second + 3 < at)
            found.emplace_back(at, at);
        found.back().second = at;
    }
    return found;
}

TEST_F(PicturesInSpace, ADrawingHasPlanAndElevationsToOneScale)
{
    Study study = two_prisms();
    plot_structure(study, "prisms", folder / "prisms.png");
    const Pixels pixels = decode(folder / "prisms.png");
    EXPECT_EQ(pixels.count.count(red), 0U);
    std::size_t top = 0;
    while (top < pixels.height && runs(pixels, top, facing).size() != 2)
        ++top;
    ASSERT_LT(top, pixels.height);
    const auto views = runs(pixels, top + 5, facing);
    ASSERT_EQ(views.size(), 2U) << "from the front and from the side";
    const double front = views[0].second - views[0].first + 2, side = views[1].second - views[1].first + 2;
    EXPECT_NEAR(front / side, 2, 0.03);
    std::size_t ground = top, plan = 0, bottom = 0;
    for (std::size_t y = top; y < pixels.height; ++y) {
        const std::size_t count = runs(pixels, y, facing).size();
        ground = count == 2 ? y : ground;
        plan = plan == 0 && y > ground + 50 && count == 1 ? y : plan;
        bottom = count == 1 ? y : bottom;
    }
    EXPECT_NEAR(static_cast<double>(ground - top + 2) / front, 3.0 / 2, 0.03);
    ASSERT_GT(plan, ground);
    EXPECT_NEAR(static_cast<double>(bottom - plan + 2) / front, 1.0 / 2, 0.03);
    const auto above = runs(pixels, plan + 5, facing);
    EXPECT_NEAR(above.front().first, views[0].first, 2) << "the plan lies below the elevation";

    plot_structure(study, "prisms", folder / "prisms.svg");
    const std::string svg = read_file(folder / "prisms.svg");
    for (const char* words : {"drums 1 to 2: 2 × 1 m, height 1.5 m, 8.1 t", "from the front", "from the side", ">plan<",
                              ">2 × 1.5 m<", ">3 m<", ">2 m<", ">1 m<"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;

    study.structure.columns[0].drums[1].bed.friction = 0.4;
    plot_structure(study, "prisms", folder / "bed.png");
    EXPECT_GT(decode(folder / "bed.png").count.count(red), 0U);
}

TEST_F(PicturesInSpace, ADrawingOfADrumWithAnAbacus)
{
    Study study = two_prisms();
    auto& drums = study.structure.columns[0].drums;
    drums[0] = {.width_m = 1.2, .height_m = 3, .mass_kg = 8000, .depth_m = 1.2, .top_width_m = 1};
    drums[1] = {
        .width_m = 1.4, .height_m = 0.5, .mass_kg = 2600, .shape = Shape::square, .depth_m = 1.4, .top_width_m = 1.4};
    plot_structure(study, "abacus", folder / "abacus.svg");
    const std::string svg = read_file(folder / "abacus.svg");
    for (const char* words : {"diameter 1.2 (top 1) m, height 3 m", "1.4 × 1.4 m, height 0.5 m", ">1.2 m<", ">1.4 m<",
                              ">3.5 m<", ">0.5 m<"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;
}

/// A block of 2 m x 1 m x 1 m on the ground that goes from x = 0 to `far`, and turns about y meanwhile.
Trajectory moving_block(std::size_t samples, double far)
{
    Trajectory t(spatial_channels);
    t.index = 3;
    t.role = {BlockRole::drum};
    t.column = {0};
    t.name = {"drum 1"};
    const auto set = [&](const char* name, double value) { t[name] = {value}; };
    set("rest_x_m", 0);
    set("rest_y_m", 0.5);
    set("rest_z_m", 0);
    set("half_height_m", 0.5);
    set("bottom_half_x_m", 1);
    set("top_half_x_m", 1);
    set("bottom_half_z_m", 0.5);
    set("top_half_z_m", 0.5);
    set("round", 0);
    for (std::size_t k = 0; k < samples; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(samples - 1, 1));
        t.time_s.push_back(4 * share);
        for (const char* name : {"y_m", "z_m", "q_x", "q_z", "base_x_m", "base_y_m", "base_z_m"})
            t[name].push_back(name == std::string("y_m") ? 0.5 : 0);
        t["x_m"].push_back(far * share);
        t["q_w"].push_back(std::cos(0.1 * share));
        t["q_y"].push_back(std::sin(0.1 * share));
    }
    return t;
}

TEST(StripInSpace, SnapshotsCatchTheMotion)
{
    // At rest but for one swing along z, 2.00 to 2.50 s.
    Trajectory t = moving_block(1001, 0);
    for (std::size_t k = 0; k < 1001; ++k) {
        const double u = (static_cast<double>(k) - 200) / 50;
        t["z_m"][k] = u > 0 && u < 1 ? 0.5 * std::sin(std::numbers::pi * u) : 0;
        t["q_w"][k] = 1;
        t["q_y"][k] = 0;
    }
    const auto chosen = snapshot_samples(t, 8);
    EXPECT_EQ(chosen.size(), 8U);
    EXPECT_TRUE(std::ranges::is_sorted(chosen));
    EXPECT_NE(std::ranges::find(chosen, 225U), chosen.end()) << "the peak of the swing is missed";
    for (const std::size_t samples : {1U, 2U, 7U, 8U, 9U}) {
        const auto few = snapshot_samples(moving_block(samples, 1), 8);
        EXPECT_EQ(std::set<std::size_t>(few.begin(), few.end()).size(), std::min<std::size_t>(samples, 8));
    }
    EXPECT_THROW(snapshot_samples(t, 1), InputError);
    t["q_w"].pop_back();
    EXPECT_THROW(snapshot_samples(t, 8), InputError);
}

TEST_F(PicturesInSpace, AStripDrawsFallsAndNothingThatIsNotKnown)
{
    const Trajectory t = moving_block(101, 3);
    plot_strip(t, {}, "block", folder / "a.png");
    const Pixels unknown = decode(folder / "a.png");
    EXPECT_EQ(unknown.width, 1800U);
    EXPECT_EQ(share(unknown, red, 3), 0);
    EXPECT_GT(share(unknown, 0x0072b2, 3), 0.0005) << "displacement and orbit of the top";
    EXPECT_GT(share(unknown, 0xd55e00, 3), 0.0002) << "the base";
    plot_strip(t, {2.0}, "block", folder / "a.png");
    EXPECT_GT(share(decode(folder / "a.png"), red, 3), 0.0002);
    plot_strip(t, {5.0}, "block", folder / "a.png");
    EXPECT_EQ(share(decode(folder / "a.png"), red, 3), 0) << "a fall after the last sample is none yet";
    plot_strip(t, {2.0}, "block", folder / "a.svg");
    const std::string svg = read_file(folder / "a.svg");
    for (const char* words : {"from the front, 4 s", "from the side, 4 s", "plan, 4 s, with the orbit of the top",
                              "along x [m]", "along z [mm]", "first drum 1 at 2.00 s"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;
    plot_strip(moving_block(1, 0), {}, "one sample", folder / "a.png");
}

TEST_F(PicturesInSpace, DamagedTrajectoriesAreRefused)
{
    const auto refused = [&](const char* words, const auto& change) {
        Trajectory t = moving_block(5, 1);
        change(t);
        const std::string said = message_of([&] { plot_strip(t, {}, "", folder / "a.png"); });
        EXPECT_NE(said.find(words), std::string::npos) << said;
    };
    refused("no sample to draw", [](Trajectory& t) { t["q_w"][0] = t["q_y"][0] = 0; });
    refused("not positive", [](Trajectory& t) { t["top_half_z_m"][0] = 0; });
    refused("tables of different sizes", [](Trajectory& t) { t["z_m"].pop_back(); });
    refused("no block above its base", [](Trajectory& t) { t.role[0] = BlockRole::ground; });
    EXPECT_NE(message_of([&] {
                  plot_strip(moving_block(5, 1), {1.0, 2.0}, "", folder / "a.png");
              }).find("fall times of 2 blocks and a trajectory of 1"),
              std::string::npos);
    EXPECT_EQ(entries(), 0U);
}

} // namespace
} // namespace stylobate
