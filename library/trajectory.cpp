#include "library/trajectory.hpp"

#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/placed_solid.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/plot_strip.hpp"
#include "io/plots/solid_sheet.hpp"
#include "library/inside.hpp"
#include "library/result.hpp"
#include "studies/experiment/trajectory.hpp"
#include "stylobate/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace stylobate::api {

namespace {

[[noreturn]] void refuse_rare()
{
    throw InputError(
        "study.kind = \"rare\": a realization of a chain depends on all previous ones; it cannot be run alone");
}

/// Every channel has a public list: one that is missing does not compile.
constexpr bool has_all_lists(std::span<const inner::TrajectoryChannel> channels)
{
    for (const inner::TrajectoryChannel& channel : channels)
        list_of(channel.name);
    return true;
}
static_assert(has_all_lists(inner::planar_channels) && has_all_lists(inner::spatial_channels));

Trajectory followed(const inner::LoadedStudy& loaded, std::uint64_t index, const std::function<bool()>& go_on = {})
{
    const inner::Study& study = loaded.study();
    if (study.design().chained())
        refuse_rare();
    if (index >= study.total())
        throw InputError(fmt::format("realization {}: the study has realizations 0 to {}", index, study.total() - 1));
    inner::TracedRealization f = inner::trace(loaded.experiment(), index, inner::best_isa(), go_on);
    Trajectory t;
    t.outcome = outcome_of(inner::result_row(study, f.realization, f.outcome));
    t.dimensions = study.structure.dimensions;
    visit_channels(t, [&](const inner::TrajectoryChannel& channel, std::vector<double>& list) {
        list = std::move(f.trajectory[channel.name]);
    });
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        t.fixed.push_back(f.realization.spatial() ? f.realization.space.solids[i].fixed
                                                  : f.realization.blocks[i].fixed);
        t.epistyle.push_back(f.trajectory.role[i] == inner::BlockRole::epistyle);
    }
    t.column = std::move(f.trajectory.column);
    t.name = std::move(f.trajectory.name);
    return t;
}

/// The engine's trajectory.
/// @throws InputError if the arrays do not fit each other
inner::Trajectory drawn_from(const Trajectory& t)
{
    inner::Trajectory drawn(inner::trajectory_channels(t.dimensions));
    drawn.index = t.outcome.index;
    visit_channels(t, [&](const inner::TrajectoryChannel& channel, const std::vector<double>& list) {
        drawn[channel.name] = list;
    });
    for (const bool epistyle : t.epistyle)
        drawn.role.push_back(epistyle ? inner::BlockRole::epistyle : inner::BlockRole::drum);
    drawn.column = t.column;
    drawn.name = t.name;
    if (t.time_s.empty() || t.blocks() == 0 || !inner::lists_fit(drawn) || t.fixed.size() != t.blocks())
        throw InputError("a trajectory with arrays of inconsistent sizes");
    return drawn;
}

/// Polygons, with the window that shows them; lengths in metres to the right and upwards.
class SvgScene {
public:
    /// Widens the window. @param by in all directions
    void show(double x, double y, double by = 0)
    {
        left_ = std::min(left_, x - by);
        right_ = std::max(right_, x + by);
        low_ = std::min(low_, y - by);
        high_ = std::max(high_, y + by);
    }
    /// @param points all shown   @param fill "": none
    void polygon(std::vector<inner::ViewPoint> points, std::string fill, std::string line, double line_width = 1)
    {
        for (const inner::ViewPoint& p : points)
            show(p.x, p.y);
        polygons_.push_back({std::move(points), std::move(fill), std::move(line), line_width});
    }

    /// @param level a line across at the height 0
    std::string text(std::uint64_t realization, double time_s, bool level) const
    {
        const double margin = 0.05 * std::max(right_ - left_, high_ - low_);
        const double scale = 600 / (std::max(right_ - left_, high_ - low_) + 2 * margin); // pixels per metre
        const double width = (right_ - left_ + 2 * margin) * scale, height = (high_ - low_ + 2 * margin) * scale;
        const auto px = [&](double metres) { return (metres - left_ + margin) * scale; };
        const auto py = [&](double metres) { return (high_ + margin - metres) * scale; };
        std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                                      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<title>realization {2}, {3:.3f} s</title>\n"
                                      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                                      width, height + 24, realization, time_s);
        if (level)
            svg += fmt::format("<line x1=\"0\" y1=\"{0:.2f}\" x2=\"{1:.0f}\" y2=\"{0:.2f}\" stroke=\"#555\"/>\n", py(0),
                               width);
        for (const inner::ShadedPolygon& polygon : polygons_) {
            std::string points;
            for (const inner::ViewPoint& p : polygon.points)
                points += fmt::format("{:.2f},{:.2f} ", px(p.x), py(p.y));
            points.pop_back();
            svg += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\"{}/>\n", points,
                               polygon.fill.empty() ? "none" : polygon.fill, polygon.line,
                               polygon.line_width == 1 ? "" : fmt::format(" stroke-width=\"{}\"", polygon.line_width));
        }
        return svg + fmt::format("<text x=\"6\" y=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"14\">{:.3f} s"
                                 "</text>\n</svg>\n",
                                 height + 16, time_s);
    }

    const std::vector<inner::ShadedPolygon>& polygons() const { return polygons_; }

private:
    double left_ = 0, right_ = 0, low_ = 0, high_ = 0;
    std::vector<inner::ShadedPolygon> polygons_;
};

/// The structure as it stood is shown too, as far as it reaches.
SvgScene scene_in_plane(const Trajectory& t, const inner::Trajectory& drawn, std::size_t sample)
{
    SvgScene scene;
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        const inner::Rectangle block = rectangle_of(drawn, sample, i);
        scene.show(block.x, block.y, block.reach());
        scene.show(t.rest_x_m[i], t.rest_y_m[i], block.reach());
        std::vector<inner::ViewPoint> corners;
        for (const auto& [x, y] : block.corners())
            corners.push_back({x, y});
        scene.polygon(std::move(corners), t.fixed[i] ? "#a89878" : t.epistyle[i] ? "#9db4cc" : "#e6dcc3", "#333");
    }
    return scene;
}

/// Obliquely from above, on the ground about the feet.
/// @throws InputError if a place or a size is not one
SvgScene scene_in_space(const Trajectory& t, const inner::Trajectory& drawn, std::size_t sample)
{
    const inner::SolidView view = inner::SolidView::oblique();
    SvgScene scene;
    std::vector<inner::DrawnSolid> solids;
    double left = 0, right = 0, back = 0, front = 0;
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        const inner::PlacedSolid solid = solid_of(drawn, sample, i);
        const inner::SolidShape& shape = solid.shape;
        if (!solid.is_finite() ||
            !(std::min({shape.half_height, shape.bottom.x, shape.bottom.z, shape.top.x, shape.top.z}) > 0))
            throw InputError(fmt::format("block {} at {:.3f} s has a place that is not finite, or a size that is not "
                                         "positive",
                                         i, t.time_s[sample]));
        solids.push_back({solid, t.fixed[i]      ? inner::SolidLook::fixed
                                 : t.epistyle[i] ? inner::SolidLook::lintel
                                                 : inner::SolidLook::stone});
        const double beside = t.epistyle[i] ? 1 : 2; // about the feet there is room
        left = std::min(left, t.rest_x_m[i] - beside * shape.bottom.x);
        right = std::max(right, t.rest_x_m[i] + beside * shape.bottom.x);
        back = std::min(back, t.rest_z_m[i] - beside * shape.bottom.z);
        front = std::max(front, t.rest_z_m[i] + beside * shape.bottom.z);
        const inner::PlacedSolid stood = {shape, {t.rest_x_m[i], t.rest_y_m[i], t.rest_z_m[i]}};
        for (const inner::SpacePoint& corner : stood.corners())
            scene.show(view.place(corner).x, view.place(corner).y);
    }
    scene.polygon({view.place({left, 0, front}), view.place({right, 0, front}), view.place({right, 0, back}),
                   view.place({left, 0, back})},
                  "#d9dde1", "#9aa1a8");
    for (inner::ShadedPolygon& polygon : shaded_solids(solids, view))
        scene.polygon(std::move(polygon.points), polygon.fill, polygon.line, polygon.line_width);
    return scene;
}

} // namespace

std::size_t Trajectory::sample_at(double at_s) const
{
    if (time_s.empty())
        throw std::out_of_range("a trajectory without samples");
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), at_s);
    return after == time_s.begin() ? 0 : static_cast<std::size_t>(after - time_s.begin()) - 1;
}

Trajectory replay(const Experiment& experiment, std::uint64_t index)
{
    return translated([&] { return followed(Inside::of(experiment).loaded, index); });
}

Trajectory replay(const Result& result, std::uint64_t index, const std::vector<std::string>& settings,
                  const std::function<bool()>& go_on)
{
    return translated([&] {
        const auto& of = Inside::of(result);
        if (of.study.design().chained()) // before its motions are read
            refuse_rare();
        try {
            return followed(inner::LoadedStudy::from_results(of.study, of.header, of.name, settings), index, go_on);
        } catch (const inner::TraceStopped&) {
            throw Stopped(fmt::format("realization {} was stopped", index));
        }
    });
}

std::vector<std::vector<inner::ShadedPolygon>> seen_in_space(const Trajectory& t,
                                                             const std::vector<std::size_t>& samples)
{
    const inner::Trajectory drawn = drawn_from(t);
    std::vector<std::vector<inner::ShadedPolygon>> seen;
    for (const std::size_t sample : samples) {
        if (sample >= t.time_s.size() || !inner::is_spatial(drawn))
            throw std::out_of_range("a trajectory in the plane, or one without this sample");
        seen.push_back(scene_in_space(t, drawn, sample).polygons());
    }
    return seen;
}

std::string svg(const Trajectory& t, double time_s)
{
    const inner::Trajectory drawn = drawn_from(t);
    const std::size_t sample = t.sample_at(time_s);
    const bool plane = !inner::is_spatial(drawn);
    const SvgScene scene = plane ? scene_in_plane(t, drawn, sample) : scene_in_space(t, drawn, sample);
    return scene.text(t.outcome.index, t.time_s[sample], plane);
}

void write_svg(const Trajectory& t, double time_s, const std::filesystem::path& file)
{
    const std::string drawing = svg(t, time_s);
    translated([&] { inner::write_whole(file, drawing); });
}

void write_strip(const Trajectory& t, const std::filesystem::path& png, const std::optional<std::string>& title)
{
    const inner::Trajectory drawn = drawn_from(t);
    translated([&] {
        inner::plot_strip(drawn, t.outcome.fall_time_s, title.value_or(fmt::format("realization {}", t.outcome.index)),
                          png);
    });
}

} // namespace stylobate::api
