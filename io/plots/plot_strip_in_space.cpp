#include "io/plots/plot_strip_in_space.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/figure_panel.hpp"
#include "io/plots/solid_sheet.hpp"
#include "io/plots/strip_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace stylobate {
namespace {

constexpr double strip_width = 1800, edge_left = 60, edge_right = 60, strip_top = 205, plan_gap = 14;
constexpr double one_row = 700, most_strip = 1300, label_room = 46, most_view = 520, caption_room = 50,
                 panel_room = 190;
constexpr double view_cell = (strip_width - edge_left - edge_right) / 3;
constexpr char top_colour[] = "#0072b2", base_colour[] = "#d55e00", fall_colour[] = "#c0271b";

/// Samples before the first that is not finite.
/// @throws InputError as `plot_strip`
std::size_t whole_samples(const Trajectory& t)
{
    check_trajectory(t, {});
    const auto whole = [&](std::size_t k) {
        bool finite = std::isfinite(t.time_s[k] + t["base_x_m"][k] + t["base_y_m"][k] + t["base_z_m"][k]);
        for (std::size_t i = 0; finite && i < t.blocks(); ++i)
            finite = solid_of(t, k, i).is_finite();
        return finite;
    };
    std::size_t good = 0;
    while (good < t.time_s.size() && whole(good))
        ++good;
    check_some_sample(t, good);
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        const SolidShape shape = shape_of(t, i);
        const std::array sizes{shape.half_height, shape.bottom.x, shape.bottom.z, shape.top.x, shape.top.z};
        if (!std::ranges::all_of(sizes, [](double size) { return size > 0 && std::isfinite(size); }))
            throw InputError(
                fmt::format("block {} of realization {} has a size that is not positive: the trajectory is "
                            "damaged.\n  Replay the realization into a new file.",
                            i, t.index));
    }
    return good;
}

/// How far the blocks are at a sample from where they are at another, in all.
double way_between(const Trajectory& t, std::size_t sample, std::size_t from)
{
    double sum = 0;
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        const PlacedSolid a = solid_of(t, sample, i), b = solid_of(t, from, i);
        sum += std::hypot(a.middle[0] - b.middle[0], a.middle[1] - b.middle[1], a.middle[2] - b.middle[2]);
        double chord = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const double other = b.attitude.quaternion()[c];
            chord += a.attitude.quaternion()[c] * other;
        }
        sum += 2 * std::acos(std::min(1.0, std::fabs(chord))) * a.shape.half_height;
    }
    return sum;
}

/// What a part of the drawing needs, in metres of its view.
struct ViewBox {
    double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;
    void add(const ViewPoint& p)
    {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    double width() const { return right - left; }
    double height() const { return high - low; }
};

/// A realization, and how it is drawn.
class StripInSpace {
public:
    StripInSpace(const Trajectory& t, const std::vector<double>& falls, std::size_t snapshots)
        : t_(t), falls_(falls), samples_(whole_samples(t)), chosen_(snapshot_samples_in_space(t, snapshots)),
          last_(samples_ - 1)
    {
        for (std::size_t i = 0; i < t.blocks(); ++i) {
            if (t.role[i] == BlockRole::ground)
                continue;
            drawn_.push_back(i);
            bool moves = false;
            for (std::size_t k = 1; k < samples_ && !moves; ++k)
                moves = way_between_of(i, k) > 0;
            moves_.push_back(moves);
            if (moves || t.blocks() == 1)
                top_ = i;
            const PlacedSolid first = solid_of(t, 0, i);
            reach_ = std::max(reach_, std::max(first.shape.bottom.x, first.shape.bottom.z));
            for (const SpacePoint& corner : first.corners()) {
                ground_[0] = std::min(ground_[0], corner[0]);
                ground_[1] = std::max(ground_[1], corner[0]);
                ground_[2] = std::min(ground_[2], corner[2]);
                ground_[3] = std::max(ground_[3], corner[2]);
            }
        }
        if (drawn_.empty())
            throw InputError(fmt::format("the trajectory of realization {} has no block above its base.\n"
                                         "  Replay the realization into a new file.",
                                         t.index));
        if (std::ranges::none_of(moves_, [](bool moves) { return moves; })) {
            moves_.assign(moves_.size(), true); // where nothing moves, fixed blocks cannot be told from free ones
            top_ = drawn_.back();
        }
        ground_ = {ground_[0] - reach_, ground_[1] + reach_, ground_[2] - reach_, ground_[3] + reach_};
    }

    void write(const std::string& title, const std::filesystem::path& png)
    {
        const double views_top = strip_top + place_snapshots() + 60;
        const double panels_top = views_top + place_views() + 70;
        DrawingSheet sheet(
            PictureSize{static_cast<int>(strip_width), static_cast<int>(panels_top + 2 * (panel_room + 50) + 60)});
        draw_snapshots(sheet);
        draw_views(sheet, views_top);
        draw_panel(sheet, "x", panels_top, false);
        draw_panel(sheet, "z", panels_top + panel_room + 50, true);
        sheet.write(title, words(), png);
    }

private:
    double way_between_of(std::size_t block, std::size_t sample) const
    {
        const PlacedSolid a = solid_of(t_, sample, block), b = solid_of(t_, 0, block);
        double sum = 0;
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::fabs(a.middle[c] - b.middle[c]);
        for (std::size_t c = 0; c < 4; ++c)
            sum += std::fabs(a.attitude.quaternion()[c] - b.attitude.quaternion()[c]);
        return sum;
    }

    std::vector<DrawnSolid> solids(std::size_t sample) const
    {
        std::vector<DrawnSolid> all;
        for (std::size_t d = 0; d < drawn_.size(); ++d) {
            const std::size_t i = drawn_[d];
            const SolidLook look = !moves_[d]                          ? SolidLook::fixed
                                   : t_.role[i] == BlockRole::epistyle ? SolidLook::lintel
                                                                       : SolidLook::stone;
            all.push_back({solid_of(t_, sample, i), look, has_fallen(falls_, i, t_.time_s[sample])});
        }
        return all;
    }

    ViewBox box_of(std::size_t sample, const SolidView& view) const
    {
        ViewBox box;
        for (const std::size_t i : drawn_)
            for (const SpacePoint& corner : solid_of(t_, sample, i).corners())
                box.add(view.place(corner));
        for (const double x : {ground_[0], ground_[1]})
            for (const double z : {ground_[2], ground_[3]})
                box.add(view.place({x, 0, z}));
        return box;
    }

    /// In as many rows as let them be large. @returns the height of the strip [pixels]
    double place_snapshots()
    {
        for (const std::size_t sample : chosen_)
            for (const auto& [box, view] : {std::pair{&strip_, SolidView::oblique()}, {&plan_, SolidView::above()}}) {
                const ViewBox seen = box_of(sample, view);
                box->add({seen.left, seen.low});
                box->add({seen.right, seen.high});
            }
        for (std::size_t k = 0; k <= chosen_.back(); ++k)
            plan_.add(SolidView::above().place(solid_of(t_, k, top_).middle));
        const double room = strip_width - edge_left - edge_right;
        const double high = strip_.height() + plan_.height();
        for (const auto& [box, view] : {std::pair{strip_, SolidView::oblique()}, {plan_, SolidView::above()}}) {
            left_of_middle_ = std::max(left_of_middle_, ground_middle(view) - box.left);
            right_of_middle_ = std::max(right_of_middle_, box.right - ground_middle(view));
        }
        const double wide = 1.06 * (left_of_middle_ + right_of_middle_);
        double best = 0;
        for (std::size_t rows = 1; rows <= chosen_.size(); ++rows) {
            const std::size_t in_row = (chosen_.size() + rows - 1) / rows;
            const double each = (rows == 1 ? one_row : most_strip / static_cast<double>(rows)) - label_room - plan_gap;
            const double scale = std::min(room / static_cast<double>(in_row) / wide, each / high);
            if (scale > 1.15 * best) { // more rows only where they are much larger
                best = scale;
                in_row_ = in_row;
            }
        }
        per_metre_ = best;
        const std::size_t rows = (chosen_.size() + in_row_ - 1) / in_row_;
        return static_cast<double>(rows) * row_height();
    }

    /// Of the ground, to the right in a view [m].
    double ground_middle(const SolidView& view) const
    {
        return view.place({(ground_[0] + ground_[1]) / 2, 0, (ground_[2] + ground_[3]) / 2}).x;
    }

    double row_height() const { return (strip_.height() + plan_.height()) * per_metre_ + label_room + plan_gap; }

    /// Each obliquely, its time below it, and the plan with the orbit so far.
    void draw_snapshots(DrawingSheet& sheet) const
    {
        const SolidView view = SolidView::oblique();
        const double cell = (strip_width - edge_left - edge_right) / static_cast<double>(in_row_);
        const double span = t_.time_s[chosen_.back()] - t_.time_s[chosen_.front()];
        const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(span, 1e-9)))), 0, 6);
        for (std::size_t n = 0; n < chosen_.size(); ++n) {
            const double middle = edge_left + cell * (static_cast<double>(n % in_row_) + 0.5) +
                                  (left_of_middle_ - right_of_middle_) / 2 * per_metre_; // of the ground
            const double top = strip_top + static_cast<double>(n / in_row_) * row_height();
            const double bottom = top + strip_.height() * per_metre_;
            const SheetPlace place = {middle - ground_middle(view) * per_metre_, bottom + strip_.low * per_metre_,
                                      per_metre_};
            draw_ground(sheet, ground_[0], ground_[1], ground_[2], ground_[3], view, place);
            draw_solids(sheet, solids(chosen_[n]), view, place);
            sheet.text(fmt::format("{:.{}f} s", t_.time_s[chosen_[n]], decimals), middle, bottom + 22,
                       std::min(25.0, cell / 7));
            draw_plan_at(sheet, chosen_[n],
                         {middle - ground_middle(SolidView::above()) * per_metre_,
                          bottom + label_room + plan_.high * per_metre_, per_metre_});
        }
        draw_axes(sheet, view, edge_left, strip_top - 14);
    }

    /// The plan at a sample, with the orbit of the top up to it.
    void draw_plan_at(DrawingSheet& sheet, std::size_t sample, const SheetPlace& place) const
    {
        const SolidView view = SolidView::above();
        draw_ground(sheet, ground_[0], ground_[1], ground_[2], ground_[3], view, place);
        draw_solids(sheet, solids(sample), view, place);
        std::vector<std::array<double, 2>> orbit;
        for (const std::size_t k : thinned(sample, 300))
            orbit.push_back(place.of(view.place(solid_of(t_, k, top_).middle)));
        sheet.path(orbit, top_colour, 2.4);
    }

    /// Displacement of the top from its place as built [m].
    double moved(std::size_t sample, std::size_t along) const
    {
        const double rest = t_[along == 0 ? "rest_x_m" : "rest_z_m"][top_];
        return solid_of(t_, sample, top_).middle[along] - rest;
    }

    struct View {
        SolidView view;
        const char* name;
        ViewBox box = {};
    };
    bool is_plan(const View& each) const { return &each == &views_.back(); }

    /// To one scale. @returns their height [pixels]
    double place_views()
    {
        double tallest = 0;
        view_scale_ = std::numeric_limits<double>::infinity();
        for (View& each : views_) {
            each.box = box_of(last_, each.view);
            for (std::size_t k = 0; is_plan(each) && k < samples_; ++k)
                each.box.add(each.view.place(solid_of(t_, k, top_).middle));
            view_scale_ = std::min({view_scale_, (view_cell - 140) / each.box.width(),
                                    most_view / each.box.height()}); // 140: for the axes
            tallest = std::max(tallest, each.box.height());
        }
        views_high_ = std::max(tallest * view_scale_, 120.0);
        return caption_room + views_high_;
    }

    /// Both elevations and the plan at the end.
    void draw_views(DrawingSheet& sheet, double top) const
    {
        const double first = top + caption_room, scale = view_scale_;
        for (std::size_t n = 0; n < views_.size(); ++n) {
            const auto& [view, name, box] = views_[n];
            const bool plan = is_plan(views_[n]);
            const double left = edge_left + view_cell * static_cast<double>(n), middle = left + view_cell / 2;
            const double origin = plan ? first + views_high_ / 2 + (box.low + box.high) / 2 * scale
                                       : first + views_high_ + box.low * scale;
            const std::string caption =
                fmt::format("{}, {:.4g} s{}", name, t_.time_s[last_], plan ? ", with the orbit of the top" : "");
            const SheetPlace place = {middle - (box.left + box.right) / 2 * scale, origin, scale};
            sheet.text(caption, middle, top, DrawingSheet::fitting(caption, view_cell - 30, 22.6));
            if (plan) {
                draw_plan_at(sheet, last_, place);
            } else {
                draw_ground(sheet, ground_[0], ground_[1], ground_[2], ground_[3], view, place);
                draw_solids(sheet, solids(last_), view, place);
            }
            draw_axes(sheet, view, left + (view.azimuth_rad > 0 ? 45 : 5), first + 10); // z is to the left
        }
    }

    /// Samples up to one that a curve is drawn through: more than `most` of the whole could not be told apart.
    std::vector<std::size_t> thinned(std::size_t last, std::size_t most) const
    {
        std::vector<std::size_t> kept;
        const std::size_t stride = samples_ / most + 1;
        for (std::size_t k = 0; k <= last; k += stride)
            kept.push_back(k);
        if (kept.back() != last)
            kept.push_back(last);
        return kept;
    }

    void draw_panel(DrawingSheet& sheet, const std::string& along, double top, bool with_times) const
    {
        const std::vector<double>& base = t_["base_" + along + "_m"];
        const std::size_t axis = along == "x" ? 0 : 2;
        double least = 0, most = 0;
        for (std::size_t k = 0; k < samples_; ++k) {
            least = std::min({least, base[k], moved(k, axis)});
            most = std::max({most, base[k], moved(k, axis)});
        }
        const Unit unit = unit_for(std::max(-least, most));
        const double room = 0.06 * (most > least ? most - least : 1 / unit.per_metre);
        Figure figure;
        figure.x_label = "time [s]";
        figure.x_range = {t_.time_s.front(), std::max(t_.time_s[last_], t_.time_s.front() + 1e-9)};
        figure.y_range = {(least - room) * unit.per_metre, (most + room) * unit.per_metre};
        const auto add = [&](SeriesKind kind, const std::vector<std::size_t>& samples, bool of_top) {
            FigureSeries series{"", kind, {}, {}, {}, {}};
            series.colour = of_top ? top_colour : base_colour;
            for (const std::size_t k : samples) {
                series.x.push_back(t_.time_s[k]);
                series.y.push_back((of_top ? moved(k, axis) : base[k]) * unit.per_metre);
            }
            figure.series.push_back(std::move(series));
        };
        for (const bool of_top : {false, true}) {
            add(SeriesKind::line, thinned(last_, 1000), of_top);
            add(SeriesKind::points, chosen_, of_top);
        }
        for (const double fall : falls_)
            if (fall >= t_.time_s.front() && fall <= t_.time_s[last_]) {
                figure.series.push_back(
                    {"", SeriesKind::line, {fall, fall}, {(*figure.y_range)[0], (*figure.y_range)[1]}, {}, {}});
                figure.series.back().colour = fall_colour;
                figure.series.back().weight = 0.5;
            }
        FigurePanel panel(figure, picture_look);
        panel.draw(sheet, {190, top, strip_width - 40, top + panel_room}, with_times);
        sheet.text(fmt::format("along {} [{}]", along, unit.name), 46, top + panel_room / 2, 22.6, TextAt::center,
                   "#000000", true);
    }

    std::string words() const
    {
        std::string text = fmt::format("{} · frame of the base · blue: centre of {}, from upright · orange: base",
                                       counted(drawn_.size(), "block"), t_.name[top_]);
        std::vector<std::size_t> first; // one, or several in the same step
        for (std::size_t i = 0; i < falls_.size(); ++i) {
            if (!has_fallen(falls_, i, t_.time_s[last_]) || (!first.empty() && falls_[i] > falls_[first[0]]))
                continue;
            if (!first.empty() && falls_[i] < falls_[first[0]])
                first.clear();
            first.push_back(i);
        }
        if (!first.empty())
            text += fmt::format(" · red: fallen, first {} at {:.2f} s",
                                first.size() > 1 ? "several together" : t_.name[first[0]], falls_[first[0]]);
        if (samples_ < t_.time_s.size())
            text += fmt::format(" · not finite after {:.4g} s", t_.time_s[last_]);
        return text;
    }

    const Trajectory& t_;
    const std::vector<double>& falls_;
    const std::size_t samples_;
    const std::vector<std::size_t> chosen_;
    const std::size_t last_;
    std::vector<std::size_t> drawn_; ///< all but the ground
    std::vector<bool> moves_;        ///< of these
    std::size_t top_ = 0;
    double reach_ = 0; ///< of the widest block [m]: the ground is drawn so much wider
    std::array<double, 4> ground_{1e300, -1e300, 1e300, -1e300}; ///< along x, along z [m]
    ViewBox strip_, plan_;                                       ///< of all snapshots, obliquely and from above
    double left_of_middle_ = 0, right_of_middle_ = 0; ///< room that a snapshot needs beside its ground's middle [m]
    double per_metre_ = 1;                            ///< of the strip
    std::array<View, 3> views_{
        {{SolidView::front(), "from the front"}, {SolidView::side(), "from the side"}, {SolidView::above(), "plan"}}};
    double view_scale_ = 1, views_high_ = 0; ///< pixels per metre; pixels
    std::size_t in_row_ = 1;
};

} // namespace

std::vector<std::size_t> snapshot_samples_in_space(const Trajectory& trajectory, std::size_t snapshots)
{
    return choose_samples(whole_samples(trajectory), snapshots,
                          [&](std::size_t sample, std::size_t from) { return way_between(trajectory, sample, from); });
}

void plot_strip_in_space(const Trajectory& trajectory, const std::vector<double>& fall_time_s, const std::string& title,
                         const std::filesystem::path& png, std::size_t snapshots)
{
    StripInSpace(trajectory, fall_time_s, snapshots).write(title, png);
}

} // namespace stylobate
