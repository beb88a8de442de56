#include "studies/measured/windows/motion_page.hpp"

#include "studies/measured/windows/motion_stage.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {

namespace {

constexpr double least_watched_s = 3; ///< that the longest window lasts on the screen
constexpr double quanta_a_px = 100;   ///< of what is drawn: the reader may enlarge it more

std::string excess_words(const MotionTrack& track)
{
    return track.excess ? fmt::format("{:.1f} (block {}, {})", *track.excess, track.block, track.coordinate)
                        : std::string("not known");
}

std::string title_of(const WindowMotion& window)
{
    std::string errors;
    for (std::size_t i = 1; i < window.tracks.size(); ++i)
        errors += fmt::format("{} of {} {}", i == 1 ? "excess" : ",", model_words(window.tracks[i].model),
                              excess_words(window.tracks[i]));
    return fmt::format("Run {}, {:.2f} to {:.2f} s, {}: {}", window.run, window.from_s, window.to_s,
                       choice_words(window), errors);
}

/// Samples at which a block of the drawing is not known: [[block, first, last]].
Json gone_json(const Trajectory& t)
{
    Json gone = Json::list();
    const std::size_t blocks = t.blocks(), n = t.time_s.size();
    for (std::size_t b = 0; b < blocks; ++b)
        for (std::size_t k = 0; k < n; ++k) {
            if (is_known(t, k * blocks + b))
                continue;
            const std::size_t first = k;
            while (k + 1 < n && !is_known(t, (k + 1) * blocks + b))
                ++k;
            gone.item_as_is(fmt::format("[{},{},{}]", b, first, k));
        }
    return gone;
}

/// The fastest of the player's speeds at which the longest window can be watched.
double watched_speed(const WindowMotions& motion)
{
    double longest = 0;
    for (const WindowMotion& window : motion.windows)
        longest = std::max(longest, window.samples.back().time_s - window.samples.front().time_s);
    for (const double speed : {1.0, 0.5, 0.25, 0.1})
        if (longest >= speed * least_watched_s)
            return speed;
    return 0.05;
}

std::string size_words(const MotionStage& stage)
{
    if (stage.apart() == 1)
        return "All is drawn to scale.";
    if (stage.apart() == stage.larger())
        return fmt::format("Displacements from rest are drawn {:g} times as large.", stage.larger());
    return fmt::format(
        "Displacements from rest are drawn {}, differences from the measured blocks {:g} times as large.",
        stage.larger() == 1 ? "to scale" : fmt::format("{:g} times as large", stage.larger()), stage.apart());
}

std::string motion_json(const WindowMotions& motion, const MotionStage& stage)
{
    AnimationStage scale = stage.scale();
    scale.quantum_px = 1 / (quanta_a_px * stage.apart());
    Json list = Json::list(), layers = Json::list(), rest = Json::list();
    for (const WindowMotion& window : motion.windows) {
        const Trajectory t = stage.trajectory(window);
        const Animation animation = animation_of(t, scale, 1);
        const double spacing = (t.time_s.back() - t.time_s.front()) / static_cast<double>(animation.samples - 1);
        list.item(Json::object()
                      .member("title", title_of(window))
                      .member("start_s", t.time_s.front())
                      .member("rate_hz", 1 / spacing)
                      .member("samples", animation.samples)
                      .member("gone", gone_json(t))
                      .member("falls", Json::list())
                      .member("data", animation.data));
    }
    for (const MotionLayer& layer : stage.layers())
        layers.item(Json::object()
                        .member("name", layer.name)
                        .member("look", layer.look)
                        .member("first", layer.first)
                        .member("count", motion.free_blocks()));
    for (const auto& [x, y] : stage.rest_px())
        rest.item_as_is(fmt::format("[{:.6g},{:.6g}]", x, y));
    return animation_store(scale, 0, stage.blocks())
        .member("layers", layers)
        .member("rest", rest)
        .member("larger", stage.larger())
        .member("apart", stage.apart())
        .member("speed", watched_speed(motion))
        .member("list", list)
        .text();
}

HtmlTable motion_table(const WindowMotions& motion)
{
    HtmlTable table{"nlrr", {"window", "run", "from [s]", "to [s]"}, {}, ""};
    const std::vector<MotionTrack>& tracks = motion.windows.front().tracks;
    for (std::size_t i = 1; i < tracks.size(); ++i) {
        table.align += 'l';
        table.head.emplace_back("excess of " + model_words(tracks[i].model));
    }
    table.align += 'r';
    table.head.emplace_back("rank");
    for (const WindowMotion& window : motion.windows) {
        std::vector<Html> row{choice_words(window), window.run, fmt::format("{:.2f}", window.from_s),
                              fmt::format("{:.2f}", window.to_s)};
        for (std::size_t i = 1; i < window.tracks.size(); ++i)
            row.emplace_back(excess_words(window.tracks[i]));
        row.emplace_back(fmt::format("{} of {}", window.rank, window.ranked));
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

void add_motion(HtmlPage& page, const WindowMotions& motion)
{
    const MotionStage stage(motion);
    page.heading("Measured and simulated blocks in motion");
    page.paragraph("Outlined: the measured blocks. Filled: simulations, which followed the measured motion up to the "
                   "start of a window and run freely from there to its end. " +
                   size_words(stage));
    page.data("animations", motion_json(motion, stage));
    page.player();
    page.figure(motion_svg(motion, stage), fmt::format("The moment of each window at which {} is farthest from the "
                                                       "measured blocks.",
                                                       model_words(motion.windows.front().tracks[1].model)));
    page.table(motion_table(motion));
    page.note(fmt::format("Excess: error in units of what noise and a lag of some milliseconds cause, of the block and "
                          "coordinate that is off most; a fast block may be far off and within it. Rank: by the excess "
                          "of {} among all windows. Shown are the worst window of all, the median one, and the worst "
                          "ones of other runs.",
                          model_words(motion.windows.front().tracks[1].model)));
}

std::string no_motion_words(const std::string& file, const std::string& code_version)
{
    return fmt::format(
        "The measured and simulated blocks are not shown in motion: {} was written by an earlier version "
        "of the program ({}), which did not store them. Make it again to see them.",
        file, code_version);
}

namespace {

constexpr double picture_px = 900, gap_px = 12, heading_px = 40, legend_px = 34;
constexpr double beside_px = 65; ///< at each side of a structure
constexpr double letter_px = 7.5;

/// The blocks of a window at a sample. @param width_px of the ground, its middle being 0
std::string blocks_at(std::size_t sample, const Trajectory& t, const MotionStage& stage, double width_px)
{
    const AnimationStage& scale = stage.scale();
    std::string out =
        fmt::format("<rect class=\"ground\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                    -width_px / 2, scale.ground_px, width_px, scale.height_px - scale.ground_px);
    for (std::size_t b = 0; b < t.blocks(); ++b) {
        if (!is_known(t, sample * t.blocks() + b))
            continue;
        const auto [x, y, turn] = stage.drawn(t, sample, b);
        const double w = t.half_width_m[b] * scale.px_m, h = t.half_height_m[b] * scale.px_m;
        out += fmt::format("<rect class=\"block {}\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                           "transform=\"translate({:.2f} {:.2f}) rotate({:.3f})\"/>\n",
                           stage.blocks()[b].look, -w, -h, 2 * w, 2 * h, x, scale.ground_px - y,
                           -turn * 180 / std::numbers::pi);
    }
    return out;
}

std::string legend(const MotionStage& stage, double y)
{
    std::string out;
    double x = 2;
    for (const MotionLayer& layer : stage.layers()) {
        out += fmt::format("<rect class=\"block {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"22\" height=\"12\"/>\n",
                           layer.look, x, y);
        out += svg_text(x + 29, y + 11, "start", layer.name);
        x += 58 + letter_px * static_cast<double>(layer.name.size());
    }
    return out;
}

} // namespace

Html motion_svg(const WindowMotions& motion, const MotionStage& stage)
{
    const AnimationStage& scale = stage.scale();
    double widest = 0; // of the structure
    for (const ShownBlock& block : motion.blocks)
        widest = std::max(widest, 2 * (std::abs(block.rest_x_m - scale.middle_m) + block.half_width_m) * scale.px_m);
    const auto n = static_cast<double>(motion.windows.size());
    const double inside = std::min(scale.width_px, widest + 2 * beside_px); // of a panel, before it is made smaller
    const double smaller = std::min(1.0, ((picture_px + gap_px) / n - gap_px) / inside);
    const double width = smaller * inside, height = smaller * scale.height_px;
    std::string out;
    for (std::size_t i = 0; i < motion.windows.size(); ++i) {
        const WindowMotion& window = motion.windows[i];
        const Trajectory t = stage.trajectory(window);
        const std::size_t sample = MotionStage::farthest(motion, window);
        const double left = static_cast<double>(i) * (width + gap_px);
        out += svg_text(left + width / 2, 14, "middle", fmt::format("run {}, {:.2f} s", window.run, t.time_s[sample]));
        out += svg_text(left + width / 2, 31, "middle", choice_words(window), " font-size=\"11\"");
        out += fmt::format("<svg x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                           "viewBox=\"{:.1f} 0 {:.1f} {:.1f}\">\n{}</svg>\n",
                           left, heading_px, width, height, -inside / 2, inside, scale.height_px,
                           blocks_at(sample, t, stage, inside));
    }
    out += legend(stage, heading_px + height + 14);
    return Html::ready(fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"stage\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
        "role=\"img\" aria-label=\"Measured and simulated blocks in {2} of the windows; the table below has their "
        "errors\" "
        "font-family=\"inherit\" font-size=\"13\">\n{3}</svg>",
        picture_px, heading_px + height + legend_px, motion.windows.size(), out));
}

} // namespace stylobate
