#include "studies/results/structure_sketch.hpp"

#include "ensemble/planar/fastening.hpp"
#include "ensemble/spatial/placed_solid.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/sheet.hpp"
#include "io/plots/solid_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

constexpr double most_wide = 330, most_high = 220; ///< of an elevation [px]
constexpr double beside = 14, slab = 10;           ///< room at the sides, the ground [px]

const char* fill_of(const PlacedBlock& block)
{
    return block.fixed ? "var(--fixed)" : block.role == BlockRole::epistyle ? "var(--lintel)" : "var(--stone)";
}

/// How a mark is drawn.
enum class MarkLook { pin, pair, band, seam, line, outline };

MarkLook look_of(const MechanismRule& rule)
{
    switch (rule.mechanism) {
    case Mechanism::dowel:
        return MarkLook::pin;
    case Mechanism::pull_out:
        return MarkLook::pair;
    case Mechanism::bearing:
        return MarkLook::band;
    case Mechanism::tendon:
    case Mechanism::clamp:
    case Mechanism::rod:
        return MarkLook::line;
    default:
        return rule.place == MechanismPlace::joint ? MarkLook::seam : MarkLook::outline;
    }
}

/// What is marked in one colour.
struct Mark {
    std::string words; ///< "dowel: all 9 joints"
    MarkLook look = MarkLook::seam;
    std::vector<std::size_t> places; ///< beds or blocks of the layout
    std::vector<Fastening> lines;    ///< what is drawn as such
};

/// "all 9 joints", "3 of 9 joints", "joint 0"
std::string places_words(const std::vector<std::size_t>& places, std::size_t all, const char* noun)
{
    if (places.size() == all)
        return all == 1 ? fmt::format("the {}", noun) : fmt::format("all {}", counted(all, noun));
    if (places.size() == 1)
        return fmt::format("{} {}", noun, places.front());
    return fmt::format("{} of {}", places.size(), counted(all, noun));
}

std::string spoken_name(std::string name)
{
    std::ranges::replace(name, '_', ' ');
    return name;
}

std::vector<Mark> mechanism_marks(const Study& study, const Layout& layout, const Study* base)
{
    std::vector<Mark> marks;
    for (const MechanismRule& rule : mechanism_rules()) {
        if (rule.place == MechanismPlace::base)
            continue;
        const bool joints = rule.place == MechanismPlace::joint;
        std::size_t all = joints ? layout.beds.size() : layout.blocks.size();
        if (!joints)
            all -= static_cast<std::size_t>(std::ranges::count_if(layout.blocks, &PlacedBlock::fixed));
        Mark mark{{}, look_of(rule), {}, {}};
        std::vector<MechanismSpec> shown;
        for (const MechanismSpec& spec : study.mechanisms) {
            const bool old = base && std::ranges::find(base->mechanisms, spec) != base->mechanisms.end();
            if (spec.mechanism != rule.mechanism || old || !acts(spec, study.contact.friction))
                continue;
            for (const int place : spec.places.empty() ? usual_places(rule, layout) : spec.places)
                mark.places.push_back(static_cast<std::size_t>(place));
            shown.push_back(spec);
        }
        mark.lines = fastenings(shown, study.contact.friction, layout);
        std::ranges::sort(mark.places);
        mark.places.erase(std::unique(mark.places.begin(), mark.places.end()), mark.places.end());
        if (mark.places.empty())
            continue;
        mark.words =
            fmt::format("{} ({})", spoken_name(rule.name), places_words(mark.places, all, joints ? "joint" : "block"));
        marks.push_back(std::move(mark));
    }
    return marks;
}

bool same_stone(const PlacedBlock& a, const PlacedBlock& b)
{
    return a.width_m == b.width_m && a.height_m == b.height_m && a.depth_m == b.depth_m && a.mass_kg == b.mass_kg &&
           a.top_ratio == b.top_ratio && a.fixed == b.fixed;
}

bool same_contact(const ContactSpec& a, const ContactSpec& b)
{
    const auto fields = [](const ContactSpec& c) {
        return std::tie(c.form, c.normal_stiffness_n_m2, c.tangential_stiffness_n_m, c.normal_stiffness_n_m3,
                        c.tangential_stiffness_n_m3, c.normal_damping_ratio, c.tangential_damping_ratio,
                        c.normal_damping_n_s_m, c.tangential_damping_n_s_m, c.damping, c.damping_per, c.friction,
                        c.restitution, c.restitution_law);
    };
    return fields(a) == fields(b);
}

std::vector<Mark> marks_of(const Study& study, const Layout& layout, const Study* base)
{
    std::vector<Mark> marks = mechanism_marks(study, layout, base);
    const Layout old = base ? lay_out(base->structure) : Layout{};
    Mark beds{"bed of its own values", MarkLook::seam, {}, {}}, stones{"other size or mass", MarkLook::outline, {}, {}};
    for (std::size_t i = 0; i < layout.beds.size(); ++i) {
        const BedSpec& bed = layout.beds[i].bed;
        if (base && i < old.beds.size() ? !(bed == old.beds[i].bed) : !(bed == BedSpec{}))
            beds.places.push_back(i);
    }
    if (base && layout.blocks.size() == old.blocks.size())
        for (std::size_t i = 0; i < layout.blocks.size(); ++i)
            if (!same_stone(layout.blocks[i], old.blocks[i]))
                stones.places.push_back(i);
    if (base && !same_contact(study.contact, base->contact)) {
        beds = {"other contact", MarkLook::seam, {}, {}};
        for (std::size_t i = 0; i < layout.beds.size(); ++i)
            beds.places.push_back(i);
    }
    for (Mark* mark : {&stones, &beds})
        if (!mark->places.empty()) {
            mark->words +=
                fmt::format(" ({})", mark == &beds ? places_words(mark->places, layout.beds.size(), "joint")
                                                   : places_words(mark->places, layout.blocks.size(), "block"));
            marks.push_back(std::move(*mark));
        }
    return marks;
}

/// One view of the structure: metres on a sheet.
class Elevation {
public:
    Elevation(double left_m, double right_m, double bottom_m, double top_m, double per_metre)
        : left_m_(left_m), top_m_(top_m), scale_(per_metre),
          sheet_({static_cast<int>(std::lround((right_m - left_m) * per_metre + 2 * beside)),
                  static_cast<int>(std::lround((top_m - bottom_m) * per_metre + slab + 4))})
    {
    }

    double x(double metres) const { return beside + (metres - left_m_) * scale_; }
    double y(double metres) const { return 4 + (top_m_ - metres) * scale_; }
    double scale() const { return scale_; }
    double width() const { return sheet_.size().width; }

    void ground() { sheet_.rectangle(0, y(0), sheet_.size().width, y(0) + slab, "var(--ground)"); }
    void rectangle(double left, double right, double bottom, double top, const char* fill)
    {
        sheet_.rectangle(x(left), y(top), x(right), y(bottom), fill, edge, 1, 1);
    }
    /// @param fill "": an edge alone
    void polygon(const std::vector<ViewPoint>& points, std::string_view fill)
    {
        std::vector<std::array<double, 2>> at;
        for (const ViewPoint& point : points)
            at.push_back({x(point.x), y(point.y)});
        sheet_.polygon(at, fill, edge, 1);
    }
    void stroke(double x1, double y1, double x2, double y2, double width, const std::string& colour)
    {
        sheet_.line(x1, y1, x2, y2, colour, width);
    }
    void outline(double left, double right, double bottom, double top, const std::string& colour)
    {
        const double x0 = x(left) + 2, y0 = y(top) + 2;
        sheet_.rectangle(x0, y0, std::max(x0 + 1, x(right) - 2), std::max(y0 + 1, y(bottom) - 2), "", colour, 1, 3);
    }

    std::string svg(const char* of, const char* below) const
    {
        return fmt::format("<div class=\"sketch\"><svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
                           "width=\"{0}\" role=\"img\" aria-label=\"the structure at rest{2}\">\n{3}</svg>{4}</div>",
                           sheet_.size().width, sheet_.size().height, of, sheet_.elements(), below);
    }

private:
    static constexpr char edge[] = "var(--edge)";
    double left_m_, top_m_, scale_;
    DrawingSheet sheet_;
};

void draw_mark(Elevation& view, const Layout& layout, const Mark& mark, const std::string& colour)
{
    std::vector<Rectangle> at_rest;
    for (const PlacedBlock& block : layout.blocks)
        at_rest.push_back({block.x_m(), block.y_m, 0, block.width_m / 2, block.height_m / 2});
    for (const Fastening& one : mark.lines)
        if (const auto line = line_of(one, at_rest, at_rest[*one.at.block], 0, 0))
            view.stroke(view.x(line->from.x), view.y(line->from.y), std::clamp(view.x(line->to.x), 0.0, view.width()),
                        view.y(line->to.y), 3, colour);
    if (mark.look == MarkLook::line)
        return;
    for (const std::size_t place : mark.places) {
        if (place >= (mark.look == MarkLook::outline ? layout.blocks.size() : layout.beds.size()))
            continue;
        if (mark.look == MarkLook::outline) {
            const PlacedBlock& block = layout.blocks[place];
            view.outline(block.left(), block.right(), block.bottom(), block.top(), colour);
            continue;
        }
        const PlacedBed& bed = layout.beds[place];
        const PlacedBlock& upper = layout.blocks[static_cast<std::size_t>(bed.upper)];
        double left = upper.left(), right = upper.right(), length = upper.height_m;
        if (bed.lower >= 0) {
            const PlacedBlock& lower = layout.blocks[static_cast<std::size_t>(bed.lower)];
            left = std::max(left, lower.left());
            right = std::min(right, lower.right());
            length = std::min(length, lower.height_m);
        }
        const double y = view.y(upper.bottom()), middle = view.x((left + right) / 2);
        const double half = std::clamp(0.3 * length * view.scale(), 4.0, 12.0);
        const double apart = (right - left) * view.scale() / 5;
        if (mark.look == MarkLook::pin)
            view.stroke(middle, y - half, middle, y + half, 4, colour);
        else if (mark.look == MarkLook::pair)
            for (const double at : {middle - apart, middle + apart})
                view.stroke(at, y - half, at, y + half, 2.5, colour);
        else
            view.stroke(view.x(left), y, view.x(right), y, mark.look == MarkLook::band ? 7 : 3.5, colour);
    }
}

struct Extent {
    double from = std::numeric_limits<double>::infinity(), to = -std::numeric_limits<double>::infinity();
    void add(double a, double b)
    {
        from = std::min(from, a);
        to = std::max(to, b);
    }
    double length() const { return to - from; }
};

void draw_view(Elevation& drawing, const Layout& layout, const std::vector<PlacedSolid>& solids, const SolidView& view)
{
    for (const SeenSolid& seen : painted(solids, view)) {
        drawing.polygon(seen.outline, fill_of(layout.blocks[seen.body]));
        for (const SeenFace& face : seen.faces)
            if (!face.smooth)
                drawing.polygon(face.points, "");
    }
}

/// Whether the side shows something else than the front.
bool differs_from_the_side(const Layout& layout)
{
    return std::ranges::any_of(layout.blocks, [&](const PlacedBlock& block) {
        return block.role == BlockRole::epistyle || block.axis_m != layout.blocks.front().axis_m ||
               block.axis_z_m != layout.blocks.front().axis_z_m || block.width_m != block.depth_m ||
               block.offset_m != block.offset_z_m;
    });
}

std::string views_in_space(const Layout& layout, const std::vector<Mark>& marks)
{
    std::vector<PlacedSolid> solids;
    Extent x, y, z;
    y.add(0, 0);
    for (const PlacedBlock& block : layout.blocks) {
        solids.push_back(solid_of(block));
        const std::vector<PlacedSolid> alone{solids.back()};
        const std::vector<SeenSolid> front = painted(alone, SolidView::front());
        for (const ViewPoint& p : front.front().outline) {
            x.add(p.x, p.x);
            y.add(p.y, p.y);
        }
        const std::vector<SeenSolid> side = painted(alone, SolidView::side());
        for (const ViewPoint& p : side.front().outline)
            z.add(p.x, p.x);
    }
    const double scale = std::min(most_wide / std::max(x.length(), z.length()), most_high / y.length());
    Elevation front(x.from, x.to, 0, y.to, scale);
    front.ground();
    draw_view(front, layout, solids, SolidView::front());
    for (std::size_t i = 0; i < marks.size(); ++i)
        draw_mark(front, layout, marks[i], fmt::format("var(--s{})", i % 6 + 1));
    std::string all = front.svg(", from the front", "<div class=\"note\">from the front</div>");
    if (differs_from_the_side(layout)) {
        Elevation side(z.from, z.to, 0, y.to, scale);
        side.ground();
        draw_view(side, layout, solids, SolidView::side());
        all += side.svg(", from the side", "<div class=\"note\">from the side</div>");
    }
    // seen from above z points downwards, and from the side to the left
    const double plan_scale = std::min(most_wide / x.length(), most_high / z.length());
    const double finer = std::min(plan_scale, 2 * scale);
    Elevation plan(x.from, x.to, z.from, z.to, finer);
    draw_view(plan, layout, solids, SolidView::above());
    return all + plan.svg(", from above", "<div class=\"note\">from above</div>");
}

std::string view_in_plane(const Layout& layout, const std::vector<Mark>& marks)
{
    Extent x, y;
    y.add(0, 0);
    for (const PlacedBlock& block : layout.blocks) {
        x.add(block.left(), block.right());
        y.add(block.bottom(), block.top());
    }
    Elevation front(x.from, x.to, 0, y.to, std::min(most_wide / x.length(), most_high / y.to));
    front.ground();
    for (const PlacedBlock& block : layout.blocks)
        front.rectangle(block.left(), block.right(), block.bottom(), block.top(), fill_of(block));
    for (std::size_t i = 0; i < marks.size(); ++i)
        draw_mark(front, layout, marks[i], fmt::format("var(--s{})", i % 6 + 1));
    return front.svg("", "");
}

} // namespace

Html structure_sketch(const Study& study, const Study* base)
{
    const Layout layout = lay_out(study.structure);
    const std::vector<Mark> marks = marks_of(study, layout, base);
    std::string html = "<div class=\"sketches\">" +
                       (study.structure.spatial() ? views_in_space(layout, marks) : view_in_plane(layout, marks)) +
                       "</div>";
    if (marks.empty())
        return Html::ready(html);
    html += "<div class=\"marks-list\">";
    for (std::size_t i = 0; i < marks.size(); ++i)
        html += fmt::format("<span><span class=\"swatch\" style=\"background:var(--s{})\"></span>{}</span> ", i % 6 + 1,
                            html_escaped(marks[i].words));
    return Html::ready(html + "</div>");
}

std::string sketch_caption(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    std::string text = "The structure at rest, to scale";
    if (study.structure.spatial())
        text += differs_from_the_side(layout) ? ", from the front, from the side and from above"
                                              : ", from the front and from above";
    return text + (std::ranges::any_of(layout.blocks, &PlacedBlock::fixed) ? "; fixed blocks are darker." : ".");
}

} // namespace stylobate
