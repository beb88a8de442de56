#include "studies/windows/motion_picture.hpp"

#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {
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
