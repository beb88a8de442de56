/// Windows in motion on a page: what its script is given are the places of the file, and what needs no script has the
/// errors and a moment of each window.

#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/measured/windows/motion_page.hpp"
#include "tests/program/json.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"
#include "tests/studies/report/animation_reader.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <regex>

namespace stylobate {
namespace {

std::string page_of(const WindowMotions& motion)
{
    Document page("motion", "");
    add_motion(page, motion);
    return html_of(page);
}

JsonValue animations_of(const std::string& page)
{
    const std::string mark = "<script type=\"application/json\" id=\"animations\">";
    const std::size_t at = page.find(mark);
    if (at == std::string::npos)
        return {};
    const std::size_t begin = at + mark.size();
    return JsonParser::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(MotionPage, GivesItsScriptThePlacesOfTheFile)
{
    const WindowMotions motion = sample_motion();
    const JsonValue store = animations_of(page_of(motion));
    const double px_m = store["px_m"].number, quantum_px = store["quantum_px"].number;
    ASSERT_EQ(store["list"].items.size(), 2U);
    ASSERT_EQ(store["layers"].items.size(), 3U);
    ASSERT_EQ(store["blocks"].items.size(), 7U); // a fixed one, and two of each layer
    EXPECT_EQ(store["blocks"].items[6].text, "block 1");
    EXPECT_LE(quantum_px * store["apart"].number, 0.0101);
    const std::vector<std::string> names = {"calibrated baseline", "extended study", "measured"};
    const std::vector<std::size_t> tracks = {1, 2, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(store["layers"].items[i]["name"].text, names[i]);
        EXPECT_EQ(store["layers"].items[i]["first"].number, static_cast<double>(1 + 2 * i));
        EXPECT_EQ(store["layers"].items[i]["count"].number, 2);
    }
    const WindowMotion& window = motion.windows[0];
    const JsonValue& one = store["list"].items[0];
    EXPECT_NEAR(one["start_s"].number, 1.2, 1e-12);
    EXPECT_NEAR(one["rate_hz"].number, 50, 1e-9);
    EXPECT_TRUE(one["gone"].items.empty());
    const ReadBack back = read_back(one["data"].text, static_cast<std::size_t>(one["samples"].number), 7, quantum_px);
    ASSERT_EQ(back.base_px.size(), 11U);
    for (std::size_t k = 0; k < 11; ++k) {
        EXPECT_NEAR(back.base_px[k], window.samples[k].base_x_m * px_m, quantum_px);
        EXPECT_NEAR(back.x_px[0][k], 0, quantum_px); // the fixed block, in the middle of the drawing
        EXPECT_NEAR(back.y_px[0][k], 0.3 * px_m, quantum_px);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t b = 0; b < 2; ++b) {
                const BlockPlace& place = window.tracks[tracks[i]].places[2 * k + b];
                const std::size_t drawn = 1 + 2 * i + b;
                EXPECT_NEAR(back.x_px[drawn][k], (place.x_m - 2) * px_m, quantum_px);
                EXPECT_NEAR(back.y_px[drawn][k], place.y_m * px_m, quantum_px);
                EXPECT_NEAR(back.theta_rad[drawn][k], place.theta_rad, 1e-4);
            }
    }
    EXPECT_NEAR(store["rest"].items[2].items[0].number, 0.1 * px_m, 1e-3); // block 1, from the middle
    EXPECT_NEAR(store["rest"].items[2].items[1].number, 1.35 * px_m, 1e-3);
}

TEST(MotionPage, PutsAnUnevenClockOnEvenTimesAndHidesWhatWasNotSeen)
{
    const WindowMotions motion = sample_motion();
    const MotionStage stage(motion);
    const WindowMotion& window = motion.windows[1];
    const Trajectory t = stage.trajectory(window);
    ASSERT_EQ(t.time_s.size(), 11U);
    EXPECT_NEAR(t.time_s[5], 0.6, 1e-12); // of the samples at 0.58 and 0.608 s
    const double share = 0.02 / 0.028;
    const double before = window.tracks[0].places[2 * 4].x_m, after = window.tracks[0].places[2 * 5].x_m;
    EXPECT_NEAR(t["x_m"][5 * 7 + 5], before + share * (after - before), 1e-12);
    EXPECT_EQ(t["x_m"][4 * 7 + 5], before); // even samples are taken as they are
    const JsonValue store = animations_of(page_of(motion));
    const JsonValue& gone = store["list"].items[1]["gone"];
    ASSERT_EQ(gone.items.size(), 1U);
    EXPECT_EQ(gone.items[0].items[0].number, 6); // block 1, measured
    EXPECT_EQ(gone.items[0].items[1].number, 7);
    EXPECT_EQ(gone.items[0].items[2].number, 7);
}

TEST(MotionPage, DrawsDisplacementsAsLargeAsTheyFit)
{
    WindowMotions motion = sample_motion();
    const MotionStage stage(motion);
    // the farthest is block 1 of the extended study at the end: 0.001 x 2 x 3 x 11 m
    const double px = 0.066 * stage.scale().px_m, room = std::min(50.0, 0.5 * stage.scale().px_m);
    EXPECT_LE(stage.larger() * px, room);
    const double next = stage.larger() == 2 ? 5 : stage.larger() == 5 ? 10 : 2;
    EXPECT_GT(next * px, room);
    motion.windows[1].tracks[1].places[3].x_m += 3; // it flies away
    EXPECT_EQ(MotionStage(motion).larger(), 1);
    motion.windows[1].tracks[1].places[3].x_m = std::nan("");
    EXPECT_EQ(MotionStage(motion).larger(), stage.larger());
    for (WindowMotion& window : motion.windows)
        for (MotionTrack& track : window.tracks)
            for (std::size_t i = 0; i < track.places.size(); ++i)
                track.places[i] = {motion.blocks[i % 2].rest_x_m, motion.blocks[i % 2].rest_y_m, 0};
    EXPECT_EQ(MotionStage(motion).larger(), 100);
    EXPECT_EQ(MotionStage(motion).apart(), 100);
}

TEST(MotionPage, DrawsModelsAsFarFromTheMeasuredBlocksAsTheyFit)
{
    WindowMotions motion = sample_motion();
    for (WindowMotion& window : motion.windows)
        for (std::size_t track = 1; track < 3; ++track)
            for (std::size_t i = 0; i < window.tracks[0].places.size(); ++i) { // a hundredth of the difference
                const BlockPlace& measured = window.tracks[0].places[i];
                BlockPlace& place = window.tracks[track].places[i];
                place.x_m = measured.x_m + (place.x_m - measured.x_m) / 100;
                place.y_m = measured.y_m + (place.y_m - measured.y_m) / 100;
                place.theta_rad = measured.theta_rad + (place.theta_rad - measured.theta_rad) / 100;
            }
    const MotionStage stage(motion);
    const double px_m = stage.scale().px_m, larger = stage.larger(), apart = stage.apart();
    EXPECT_GT(apart, larger);
    EXPECT_LE(apart * 0.044 / 100 * px_m, std::min(25.0, 0.25 * px_m)); // the extended study's block 1 at the end
    const WindowMotion& window = motion.windows[1];
    const Trajectory t = stage.trajectory(window);
    const auto at = [&](std::size_t track, std::size_t sample, std::size_t block) -> const BlockPlace& {
        return window.tracks[track].places[2 * sample + block];
    };
    const auto [x, y, turn] = stage.drawn(t, 10, 1 + 2 + 1); // block 1 of the extended study
    EXPECT_NEAR(x, (0.1 + larger * (at(0, 10, 1).x_m - 2.1) + apart * (at(2, 10, 1).x_m - at(0, 10, 1).x_m)) * px_m,
                1e-9);
    EXPECT_NEAR(y, (1.35 + larger * (at(0, 10, 1).y_m - 1.35) + apart * (at(2, 10, 1).y_m - at(0, 10, 1).y_m)) * px_m,
                1e-9);
    EXPECT_NEAR(turn, larger * at(0, 10, 1).theta_rad + apart * (at(2, 10, 1).theta_rad - at(0, 10, 1).theta_rad),
                1e-12);
    // where the measured one is not known, the model against its rest
    EXPECT_NEAR(stage.drawn(t, 7, 1 + 2 + 1)[0], (0.1 + larger * (at(2, 7, 1).x_m - 2.1)) * px_m, 1e-9);
    // what flies off in another window is drawn no farther than 60 px away, if it must be to scale
    motion.windows[1].tracks[1].places[3].x_m += 3;
    EXPECT_EQ(MotionStage(motion).apart(), MotionStage(motion).larger());
    motion.windows[1].tracks[1].places[3].x_m -= 3;
    const std::string page = page_of(motion);
    EXPECT_NE(page.find("differences from the measured blocks"), std::string::npos);
    EXPECT_EQ(animations_of(page)["apart"].number, apart);
}

TEST(MotionPage, HasATableAndAPictureForWhoRunsNoScript)
{
    const WindowMotions motion = sample_motion();
    const std::string page = page_of(motion);
    for (const char* cell : {"<td class=\"n\">worst of all</td>", "<td class=\"n\">typical: the median</td>",
                             ">36.1 (block 1, x)<", ">1.5 (block 0, theta)<", ">29 of 57<", ">005 &lt;i&gt;<"})
        EXPECT_NE(page.find(cell), std::string::npos) << cell;
    EXPECT_EQ(page.find("005 <i>"), std::string::npos);
    // block 0 of the measured track where the baseline is farthest from it: the differences grow to the end
    const MotionStage stage(motion);
    const AnimationStage& scale = stage.scale();
    EXPECT_EQ(MotionStage::farthest(motion, motion.windows[0]), 10U);
    const BlockPlace& place = motion.windows[0].tracks[0].places[2 * 10];
    const std::size_t panel = page.find("viewBox=\"-");
    const std::size_t at = page.find("<rect class=\"block measured\"", panel);
    ASSERT_NE(at, std::string::npos);
    const std::string block = page.substr(at, page.find("/>", at) - at);
    std::smatch numbers;
    ASSERT_TRUE(
        std::regex_search(block, numbers, std::regex(R"(translate\(([-\d.]+) ([-\d.]+)\) rotate\(([-\d.]+)\))")));
    EXPECT_NEAR(std::stod(numbers[1]), stage.larger() * (place.x_m - 2) * scale.px_m, 0.006);
    EXPECT_NEAR(std::stod(numbers[2]), scale.ground_px - (0.85 + stage.larger() * (place.y_m - 0.85)) * scale.px_m,
                0.006);
    EXPECT_NEAR(std::stod(numbers[3]), -stage.larger() * place.theta_rad * 180 / std::numbers::pi, 6e-4);
    // of two windows two panels, each with one fixed block and two of each track
    const std::size_t figure = page.find("<figure>"), end = page.find("</figure>");
    const std::string picture = page.substr(figure, end - figure);
    std::size_t blocks = 0;
    for (std::size_t i = picture.find("class=\"block"); i != std::string::npos;
         i = picture.find("class=\"block", i + 1))
        ++blocks;
    EXPECT_EQ(blocks, 2 * 7 + 3U); // and the legend
}

TEST(MotionPage, PicturesTheMomentOfTheLargestDifference)
{
    WindowMotions motion = sample_motion();
    WindowMotion& window = motion.windows[0];
    window.tracks[1].places[2 * 6 + 1].theta_rad += 0.1;
    EXPECT_EQ(MotionStage::farthest(motion, window), 6U);
    EXPECT_NE(page_of(motion).find(">run 004, 1.32 s<"), std::string::npos);
    window.tracks[2].places[2 * 3].x_m += 1; // of another model than the first
    EXPECT_EQ(MotionStage::farthest(motion, window), 6U);
    for (BlockPlace& place : window.tracks[1].places)
        place.x_m = std::nan("");
    EXPECT_EQ(MotionStage::farthest(motion, window), 10U);
    EXPECT_NE(page_of(motion).find(">run 004, 1.40 s<"), std::string::npos);
}

TEST(MotionPage, OfADiagnosisSaysWhyThereIsNone)
{
    Diagnosis d = filled_diagnosis();
    const std::string shown = html_of(diagnosis_page(d, "d.h5"));
    EXPECT_TRUE(animations_of(shown).has("list"));
    EXPECT_EQ(shown.find("not shown in motion:"), std::string::npos); // the scripts have the words too
    d.motion.reset();                                                 // as a file of format version 2
    const std::string none = html_of(diagnosis_page(d, "d.h5"));
    EXPECT_FALSE(animations_of(none).has("list"));
    EXPECT_NE(none.find("not shown in motion: d.h5 was written by an earlier version"), std::string::npos);
    EXPECT_EQ(none.find("<div data-player"), std::string::npos);
    d.cost.window_simulations = 0;
    EXPECT_EQ(html_of(diagnosis_page(d, "d.h5")).find("not shown in motion:"), std::string::npos);
}

} // namespace
} // namespace stylobate
