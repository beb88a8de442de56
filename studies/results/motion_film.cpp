#include "studies/results/motion_film.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/planar/fastening.hpp"
#include "ensemble/spatial/placed_solid.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/program.hpp"
#include "io/plots/solid_view.hpp"
#include "studies/report/animation.hpp"
#include "studies/report/frame.hpp"
#include "studies/report/left_out.hpp"
#include "studies/results/kept_animations.hpp"
#include "studies/results/result_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

constexpr Rgb paper{244, 246, 248}, stone{233, 226, 208}, lintel{195, 211, 224}, fixed_stone{169, 160, 140},
    fallen{227, 160, 143}, edge{90, 102, 114}, ground{181, 191, 201}, base_curve{31, 86, 115},
    base_curve_across{0, 158, 115}, cursor{213, 94, 0}, fall_mark{178, 58, 58}, fastened{29, 39, 48};

/// The frames of a realization one after the other.
class Film {
public:
    Film(const TracedMotion& motion, const Study& study, double rate_hz)
        : t_(motion.trajectory), falls_(motion.fall_time_s), layout_(lay_out(study.structure)),
          fastenings_(fastenings(study.mechanisms, study.contact.friction, layout_)),
          stage_(animations_for(study).stage), rate_hz_(rate_hz)
    {
        if (is_spatial(t_))
            base_.push_back({"base_z_m", base_curve_across});
        base_.push_back({"base_x_m", base_curve});
        for (const auto& [channel, colour] : base_)
            for (const double x : t_[channel])
                most_base_m_ = std::max(most_base_m_, std::abs(x));
    }

    int width() const { return even(stage_.width_px); }
    int height() const { return even(stage_.height_px + strip_px); }
    std::size_t frames() const { return static_cast<std::size_t>(std::floor(t_.time_s.back() * rate_hz_ + 1e-9)) + 1; }

    Frame frame(std::size_t number) const
    {
        Frame frame(width(), height(), paper);
        const double time = static_cast<double>(number) / rate_hz_;
        const auto found = std::upper_bound(t_.time_s.begin(), t_.time_s.end(), time);
        const std::size_t next = std::min(static_cast<std::size_t>(found - t_.time_s.begin()), t_.time_s.size() - 1);
        const std::size_t k = next == 0 ? 0 : next - 1;
        const double share =
            next == k ? 0 : std::clamp((time - t_.time_s[k]) / (t_.time_s[next] - t_.time_s[k]), 0.0, 1.0);
        const auto between = [&](double a, double b) { return a + share * (b - a); };
        if (is_spatial(t_)) {
            draw_scene(frame, k, next, share, time);
            draw_strip(frame, time);
            return frame;
        }
        std::vector<Rectangle> now;
        for (std::size_t b = 0; b < t_.blocks(); ++b) {
            Rectangle at = rectangle_of(t_, k, b);
            const Rectangle then = rectangle_of(t_, next, b);
            at.x = between(at.x, then.x);
            at.y = between(at.y, then.y);
            at.turned_rad = between(at.turned_rad, then.turned_rad);
            draw_block(frame, b, at, time);
            now.push_back(at);
        }
        const double base_m = between(t_["base_x_m"][k], t_["base_x_m"][next]);
        draw_ground(frame, base_m);
        draw_fastenings(frame, now, base_m, time);
        draw_strip(frame, time);
        return frame;
    }

private:
    static constexpr double strip_px = 70; ///< of the base's displacement below the drawing
    /// Codecs of films want it.
    static int even(double px) { return 2 * static_cast<int>(std::ceil(px / 2)); }

    Rgb colour_of(std::size_t b, double time) const
    {
        const bool has_fallen = falls_.at(b) >= 0 && falls_[b] <= time + 1e-9;
        return has_fallen                                      ? fallen
               : layout_.blocks[b].fixed                       ? fixed_stone
               : layout_.blocks[b].role == BlockRole::epistyle ? lintel
                                                               : stone;
    }

    void draw_block(Frame& frame, std::size_t b, const Rectangle& at, double time) const
    {
        if (!at.is_finite())
            return;
        const Rgb colour = colour_of(b, time);
        const auto corners = [&](double inset) {
            const double width = std::max(at.half_width * stage_.px_m - inset, 0.5);
            const double height = std::max(at.half_height * stage_.px_m - inset, 0.5);
            // the frame's y is from above: all that is upwards has the other sign
            const Rectangle drawn{stage_.width_px / 2 + (at.x - stage_.middle_m) * stage_.px_m,
                                  stage_.ground_px - at.y * stage_.px_m, -at.turned_rad, width, -height};
            std::vector<FramePoint> points;
            for (const auto& [x, y] : drawn.corners())
                points.push_back({x, y});
            return points;
        };
        frame.fill(corners(0), edge);
        frame.fill(corners(1.2), colour);
    }

    void draw_fastenings(Frame& frame, const std::vector<Rectangle>& now, double base_m, double time) const
    {
        const auto drawn = [&](const Rectangle::Corner& at) {
            return FramePoint{std::clamp(stage_.width_px / 2 + (at.x - stage_.middle_m) * stage_.px_m, -1e4, 1e4),
                              stage_.ground_px - at.y * stage_.px_m};
        };
        for (const Fastening& one : fastenings_)
            if (const auto line = line_of(one, now, rectangle_of(t_, 0, *one.at.block), time, base_m))
                frame.line(drawn(line->from), drawn(line->to), 3, fastened);
    }

    /// A structure in space as the page shows it at first.
    void draw_scene(Frame& frame, std::size_t k, std::size_t next, double share, double time) const
    {
        const SolidView view = SolidView::oblique();
        const auto placed = [&](const ViewPoint& p) { // from the pivot [px]
            return FramePoint{stage_.width_px / 2 + p.x, stage_.height_px / 2 - p.y};
        };
        const auto polygon = [&](const std::vector<ViewPoint>& points) {
            std::vector<FramePoint> corners;
            for (const ViewPoint& point : points)
                corners.push_back(placed(point));
            return corners;
        };
        draw_level_ground(frame, view, k, next, share);
        std::vector<PlacedSolid> solids;
        std::vector<std::size_t> blocks;
        for (std::size_t b = 0; b < t_.blocks(); ++b) {
            PlacedSolid at = solid_of(t_, k, b);
            const PlacedSolid then = solid_of(t_, next, b);
            if (!at.is_finite() || !then.is_finite())
                continue;
            at.attitude = at.attitude.between(then.attitude, share);
            const SpacePoint origin = {stage_.middle_m, stage_.pivot_px / stage_.px_m, stage_.middle_z_m};
            for (std::size_t c = 0; c < 3; ++c)
                at.middle[c] = (at.middle[c] + share * (then.middle[c] - at.middle[c]) - origin[c]) * stage_.px_m;
            at.shape = at.shape.scaled(stage_.px_m);
            solids.push_back(at);
            blocks.push_back(b);
        }
        for (const SeenSolid& solid : painted(solids, view)) {
            const Rgb colour = colour_of(blocks[solid.body], time);
            for (const SeenFace& face : solid.faces) {
                frame.fill(polygon(face.points), darker(colour, face.brightness));
                if (!face.smooth)
                    draw_outline(frame, polygon(face.points));
            }
            draw_outline(frame, polygon(solid.outline));
        }
    }

    static Rgb darker(const Rgb& colour, double brightness)
    {
        const auto part = [&](std::uint8_t value) {
            return static_cast<std::uint8_t>(std::lround(value * brightness));
        };
        return {part(colour.r), part(colour.g), part(colour.b)};
    }

    static void draw_outline(Frame& frame, const std::vector<FramePoint>& corners)
    {
        for (std::size_t i = 0; i < corners.size(); ++i)
            frame.line(corners[i], corners[(i + 1) % corners.size()], 1, edge);
    }

    /// The ground in space; its marks stand still in the laboratory.
    void draw_level_ground(Frame& frame, const SolidView& view, std::size_t k, std::size_t next, double share) const
    {
        const double reach = stage_.reach_px;
        const auto placed = [&](double x, double z) {
            const ViewPoint p = view.place({x, -stage_.pivot_px, z});
            return FramePoint{stage_.width_px / 2 + p.x, stage_.height_px / 2 - p.y};
        };
        frame.fill({placed(-reach, reach), placed(reach, reach), placed(reach, -reach), placed(-reach, -reach)},
                   ground);
        constexpr double spacing = 40;
        const auto marks = [&](const char* channel, const auto& draw) {
            const double base_m = t_[channel][k] + share * (t_[channel][next] - t_[channel][k]);
            const double shift = base_m * stage_.px_m;
            for (double at = std::ceil((shift - reach) / spacing) * spacing - shift; at <= reach; at += spacing)
                draw(at);
        };
        marks("base_x_m", [&](double x) { frame.line(placed(x, -reach), placed(x, reach), 0.8, paper); });
        marks("base_z_m", [&](double z) { frame.line(placed(-reach, z), placed(reach, z), 0.8, paper); });
    }

    /// Its marks stand still in the laboratory.
    void draw_ground(Frame& frame, double base_m) const
    {
        const double right = frame.width();
        frame.fill({{0, stage_.ground_px}, {right, stage_.ground_px}, {right, stage_.height_px}, {0, stage_.height_px}},
                   ground);
        constexpr double spacing = 40;
        const double shift = std::fmod(std::fmod(-base_m * stage_.px_m, spacing) + spacing, spacing);
        for (double x = shift; x < right; x += spacing)
            frame.line({x, stage_.ground_px}, {x, stage_.ground_px + 10}, 1.2, edge);
    }

    void draw_strip(Frame& frame, double time) const
    {
        const double right = frame.width() - 2, end = std::max(t_.time_s.back(), 1e-9);
        const double middle = stage_.height_px + 35, scale = most_base_m_ > 0 ? 26 / most_base_m_ : 0;
        const std::size_t stride = std::max<std::size_t>(1, t_.time_s.size() / 1280);
        for (const auto& [channel, colour] : base_) {
            const std::vector<double>& base = t_[channel];
            const auto place = [&](std::size_t k) {
                return FramePoint{1 + t_.time_s[k] / end * right, middle - base[k] * scale};
            };
            for (std::size_t k = stride; k < t_.time_s.size(); k += stride)
                frame.line(place(k - stride), place(k), 1.4, colour);
        }
        for (const double fall : falls_)
            if (fall >= 0 && fall <= end)
                frame.line({1 + fall / end * right, middle + 18}, {1 + fall / end * right, middle + 33}, 1.6,
                           fall_mark);
        const double at = 1 + std::min(time / end, 1.0) * right;
        frame.line({at, middle - 32}, {at, middle + 32}, 1.6, cursor);
    }

    const Trajectory& t_;
    const std::vector<double>& falls_;
    const Layout layout_;
    const std::vector<Fastening> fastenings_;
    const AnimationStage stage_;
    const double rate_hz_;
    std::vector<std::pair<const char*, Rgb>> base_; ///< channels of its displacement, and their colours
    double most_base_m_ = 0;
};

std::vector<std::string> ffmpeg_words(const Film& film, double rate_hz, const std::string& format)
{
    std::vector<std::string> words{"-nostdin", "-loglevel",
                                   "error",    "-y",
                                   "-f",       "rawvideo",
                                   "-pix_fmt", "rgb24",
                                   "-s",       fmt::format("{}x{}", film.width(), film.height()),
                                   "-r",       fmt::format("{}", rate_hz),
                                   "-i",       "pipe:0"};
    if (format == "gif") // a palette of the film's own colours
        words.insert(words.end(), {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none"});
    else
        words.insert(words.end(), {"-pix_fmt", "yuv420p"}); // what every player shows
    words.push_back("film." + format);
    return words;
}

bool write_film(const TracedMotion& motion, const Study& study, const fs::path& ffmpeg, const std::string& format,
                const fs::path& file, Observer& observer)
{
    AtomicFile target(file); // refuses before any work is done
    const TemporaryFolder folder;
    const double rate_hz = format == "gif" ? 25 : 50; // hundredths of a second are the unit of time of a GIF
    const Film film(motion, study, rate_hz);
    std::size_t next = 0;
    const int status =
        run_program(ffmpeg, ffmpeg_words(film, rate_hz, format), folder.path(), folder / "ffmpeg.log", [&] {
            return next < film.frames() && !observer.stop_requested() ? film.frame(next++).bytes() : std::string();
        });
    if (observer.stop_requested()) // a terminal interrupts ffmpeg too: its status is then meaningless
        return false;
    const std::string content = content_of(folder.path() / ("film." + format));
    if (status != 0 || content.empty()) {
        std::string said = content_of(folder / "ffmpeg.log").substr(0, 600);
        std::ranges::replace(said, '\n', ' ');
        throw InputError(fmt::format("ffmpeg could not write '{}' (exit status {}): {}\n  Check that '{}' is a working "
                                     "ffmpeg: apt install ffmpeg. --to html needs none.",
                                     file.string(), status, said.empty() ? "no message" : said, ffmpeg.string()));
    }
    target.write(content);
    target.commit();
    return true;
}

/// The page of the player alone.
std::string motion_page(const TracedMotion& motion, const Results& results, std::uint64_t index,
                        const std::optional<std::string>& title)
{
    KeptAnimations kept = animations_for(results.study());
    Animation animation = animation_of(motion.trajectory, kept.stage, animation_stride(results.study()));
    animation.state = motion.state;
    animation.frequency_hz = motion.frequency_hz;
    animation.pga_m_s2 = motion.pga_m_s2;
    animation.fall_time_s = motion.fall_time_s;
    animation.azimuth_rad = motion.azimuth_rad;
    if (results.reader().has(index))
        animation.motion = motion_words(results, results.reader().row(index)).value_or("");
    kept.list.push_back(std::move(animation));
    Document page(title.value_or(realization_title(results, index)),
                  fmt::format("Computed by stylobate {}.", results.header().code_version));
    page.data("animations", animations_json(kept, results.study()));
    page.player();
    add_left_out(page, results.study().structure.dimensions);
    return html_of(page);
}

} // namespace

bool is_motion_format(std::string_view format)
{
    return format == "html" || format == "gif" || format == "mp4" || format == "webm";
}

bool write_motion(const Results& results, Isa isa, std::uint64_t index, const std::optional<std::string>& title,
                  const std::string& format, const fs::path& file, Observer& observer)
{
    AtomicFile::check(file); // this and the search before the realization is run
    const bool page = format == "html";
    const fs::path ffmpeg =
        page ? fs::path() : find_tool("ffmpeg", "STYLOBATE_FFMPEG", "no film can be written", "ffmpeg");
    const TracedMotion motion = traced_motion(results, isa, index);
    if (observer.stop_requested())
        return false;
    if (page) {
        write_whole(file, motion_page(motion, results, index, title));
        return true;
    }
    if (motion.trajectory.time_s.back() > longest_film_s)
        throw InputError(
            fmt::format("realization {} of {} lasts {:.0f} s; a film has at most {:.0f} s.\n  --to html has "
                        "no such limit.",
                        index, results.file(), motion.trajectory.time_s.back(), longest_film_s));
    return write_film(motion, results.study(), ffmpeg, format, file, observer);
}

} // namespace stylobate
