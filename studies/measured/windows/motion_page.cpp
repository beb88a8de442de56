#include "studies/measured/windows/motion_page.hpp"

#include "ensemble/model/structure.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace stylobate {

namespace {

constexpr double farthest_px = 50; ///< that a corner is drawn away from where it rests, or half of the widest block
constexpr double apart_px = 25;    ///< that it is drawn away from the measured one in the first window, or a quarter
constexpr double inside_px = 60;   ///< that it is drawn away from the measured one in any window
constexpr double even = 0.02;      ///< of the spacing of samples

constexpr double sizes[] = {100, 50, 20, 10, 5, 2};

/// The largest of the sizes, or 1, that leaves a length within its room.
double size_within(double length_px, double room_px)
{
    const auto* const found = std::ranges::find_if(sizes, [&](double size) { return size * length_px <= room_px; });
    return found == std::end(sizes) ? 1 : *found;
}

/// How far a corner moves at the most [m]; 0 where one of the places is not known.
double moved(const BlockPlace& a, const BlockPlace& b, const ShownBlock& block)
{
    const double turned = (b.theta_rad - a.theta_rad) * std::hypot(block.half_width_m, block.half_height_m);
    const double most = std::max({std::abs(b.x_m - a.x_m), std::abs(b.y_m - a.y_m), std::abs(turned)});
    return std::isfinite(b.x_m + a.x_m + b.y_m + a.y_m + turned) ? most : 0;
}

/// The sample before the k-th of as many even times, and the share of the way to the next one.
std::pair<std::size_t, double> place_of(const std::vector<MotionSample>& samples, std::size_t k)
{
    const std::size_t n = samples.size();
    const double first = samples.front().time_s;
    const double spacing = (samples.back().time_s - first) / static_cast<double>(n - 1);
    const double time = first + static_cast<double>(k) * spacing;
    if (std::abs(samples[k].time_s - time) <= even * spacing)
        return {k, 0};
    const auto after = std::ranges::upper_bound(samples, time, {}, &MotionSample::time_s);
    const auto row = std::clamp<std::ptrdiff_t>(after - samples.begin() - 1, 0, static_cast<std::ptrdiff_t>(n) - 2);
    const MotionSample &a = samples[static_cast<std::size_t>(row)], &b = samples[static_cast<std::size_t>(row) + 1];
    return {static_cast<std::size_t>(row), std::clamp((time - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0)};
}

/// "the calibrated baseline".
std::string model_words(const std::string& model)
{
    return model == "baseline"     ? "the calibrated baseline"
           : model == "extended"   ? "the extended study"
           : model == "calibrated" ? "the calibrated study"
           : model == "start"      ? "the start study"
                                   : model;
}

} // namespace

MotionStage::MotionStage(const WindowMotions& motion) : motion_(motion), free_(motion.free_blocks())
{
    ground_m_ = std::numeric_limits<double>::infinity();
    for (const ShownBlock& block : motion.blocks)
        ground_m_ = std::min(ground_m_, block.rest_y_m - block.half_height_m);
    std::vector<PlacedBlock> placed;
    for (const ShownBlock& block : motion.blocks) {
        PlacedBlock& at = placed.emplace_back();
        at.width_m = 2 * block.half_width_m;
        at.height_m = 2 * block.half_height_m;
        at.axis_m = block.rest_x_m;
        at.y_m = block.rest_y_m - ground_m_;
    }
    scale_ = animation_stage(placed);

    for (std::size_t b = free_; b < motion.blocks.size(); ++b) {
        shown_.push_back(b);
        blocks_.push_back({"fixed block", "fixed"});
    }
    const std::vector<MotionTrack>& tracks = motion.windows.front().tracks;
    for (std::size_t i = 1; i <= tracks.size(); ++i) {
        const std::size_t track = i % tracks.size(); // the measured one is the last
        std::string name = model_words(tracks[track].model);
        if (name.starts_with("the "))
            name = name.substr(4);
        layers_.push_back({track, name, track == 0 ? "measured" : fmt::format("model{}", track), shown_.size()});
        for (std::size_t b = 0; b < free_; ++b) {
            shown_.push_back(b);
            blocks_.push_back({fmt::format("block {}", b), layers_.back().look});
        }
    }
    for (const std::size_t b : shown_)
        rest_px_.push_back({(motion.blocks[b].rest_x_m - scale_.middle_m) * scale_.px_m,
                            (motion.blocks[b].rest_y_m - ground_m_) * scale_.px_m});
    choose_sizes();
}

void MotionStage::choose_sizes()
{
    double from_rest = 0, widest = 0;
    std::vector<double> from_measured; // (windows)
    for (std::size_t b = 0; b < free_; ++b)
        widest = std::max(widest, 2 * motion_.blocks[b].half_width_m);
    for (const WindowMotion& window : motion_.windows) {
        double& apart = from_measured.emplace_back(0);
        for (const MotionTrack& track : window.tracks)
            for (std::size_t i = 0; i < track.places.size(); ++i) {
                const ShownBlock& block = motion_.blocks[i % free_];
                from_rest = std::max(from_rest, moved({block.rest_x_m, block.rest_y_m, 0}, track.places[i], block));
                apart = std::max(apart, moved(window.tracks.front().places[i], track.places[i], block));
            }
    }
    const double px_m = scale_.px_m;
    larger_ = size_within(from_rest * px_m, std::min(farthest_px, widest * px_m / 2));
    apart_ =
        std::max(larger_, std::min(size_within(from_measured.front() * px_m, std::min(apart_px, widest * px_m / 4)),
                                   size_within(*std::ranges::max_element(from_measured) * px_m, inside_px)));
}

std::size_t MotionStage::farthest(const WindowMotions& motion, const WindowMotion& window)
{
    const std::size_t free = motion.free_blocks();
    std::size_t sample = window.samples.size() - 1;
    double most = 0;
    for (std::size_t i = 0; i < window.tracks[1].places.size(); ++i)
        if (const double apart = moved(window.tracks[0].places[i], window.tracks[1].places[i], motion.blocks[i % free]);
            apart > most) {
            most = apart;
            sample = i / free;
        }
    return sample;
}

Trajectory MotionStage::trajectory(const WindowMotion& window) const
{
    const std::size_t n = window.samples.size();
    Trajectory t(planar_channels);
    t.role.assign(shown_.size(), BlockRole::drum);
    for (const std::size_t b : shown_) {
        t["half_width_m"].push_back(motion_.blocks[b].half_width_m);
        t["half_height_m"].push_back(motion_.blocks[b].half_height_m);
    }
    for (std::size_t k = 0; k < n; ++k) {
        const auto [row, share] = place_of(window.samples, k);
        const std::size_t next = share > 0 ? row + 1 : row; // at a sample its neighbour does not count, known or not
        const auto between = [share = share](double a, double b) { return a + share * (b - a); };
        t.time_s.push_back(between(window.samples[row].time_s, window.samples[next].time_s));
        t["base_x_m"].push_back(between(window.samples[row].base_x_m, window.samples[next].base_x_m));
        const auto add = [&](double x_m, double y_m, double theta_rad) {
            t["x_m"].push_back(x_m);
            t["y_m"].push_back(y_m - ground_m_);
            t["theta_rad"].push_back(theta_rad);
        };
        for (std::size_t b = free_; b < motion_.blocks.size(); ++b)
            add(motion_.blocks[b].rest_x_m, motion_.blocks[b].rest_y_m, 0);
        for (const MotionLayer& layer : layers_)
            for (std::size_t b = 0; b < free_; ++b) {
                const std::vector<BlockPlace>& places = window.tracks[layer.track].places;
                const BlockPlace &a = places[row * free_ + b], &c = places[next * free_ + b];
                add(between(a.x_m, c.x_m), between(a.y_m, c.y_m), between(a.theta_rad, c.theta_rad));
            }
    }
    return t;
}

std::array<double, 3> MotionStage::drawn(const Trajectory& t, std::size_t sample, std::size_t block) const
{
    const std::size_t measured_first = layers_.back().first;
    const auto larger = [&](std::size_t b) -> std::array<double, 3> {
        const Rectangle at = rectangle_of(t, sample, b);
        const auto [rest_x, rest_y] = rest_px_[b];
        return {rest_x + larger_ * ((at.x - scale_.middle_m) * scale_.px_m - rest_x),
                rest_y + larger_ * (at.y * scale_.px_m - rest_y), larger_ * at.turned_rad};
    };
    std::array<double, 3> place = larger(block);
    if (block < fixed() || block >= measured_first)
        return place;
    const std::size_t measured = measured_first + (block - fixed()) % free_;
    if (!rectangle_of(t, sample, measured).is_finite())
        return place;
    const std::array<double, 3> from = larger(measured);
    for (std::size_t c = 0; c < 3; ++c)
        place[c] = from[c] + apart_ / larger_ * (place[c] - from[c]);
    return place;
}

namespace {

constexpr double least_watched_s = 3; ///< that the longest window lasts on the screen
constexpr double quanta_a_px = 100;   ///< of what is drawn: the reader may enlarge it more

std::string excess_words(const MotionTrack& track)
{
    return track.excess ? fmt::format("{:.1f} (block {}, {})", *track.excess, track.block, track.coordinate)
                        : std::string("not known");
}

/// "worst of all".
std::string choice_words(const WindowMotion& window)
{
    return window.choice == WindowChoice::typical ? "typical: the median"
           : window.rank == 1                     ? "worst of all"
                                                  : "worst of its run";
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
            if (rectangle_of(t, k, b).is_finite())
                continue;
            const std::size_t first = k;
            while (k + 1 < n && !rectangle_of(t, k + 1, b).is_finite())
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
        const Rectangle block = rectangle_of(t, sample, b);
        if (!block.is_finite())
            continue;
        const auto [x, y, turn] = stage.drawn(t, sample, b);
        const double w = block.half_width * scale.px_m, h = block.half_height * scale.px_m;
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

/// Where the first model is farthest from what was measured, in the sizes with which the player (windows.js) begins.
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

} // namespace

void add_motion(Document& page, const WindowMotions& motion)
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

} // namespace stylobate
