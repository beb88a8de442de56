#include "ensemble/model/layout_in_space.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {
namespace {

const PlacedBlock& block_at(const Layout& layout, int block)
{
    return layout.blocks[static_cast<std::size_t>(block)];
}

PlanFace face_of(const PlacedBlock& block, double ratio)
{
    return {block.shape == Shape::round, block.x_m(), block.z_m(), ratio * block.width_m / 2,
            ratio * block.depth_m / 2};
}

/// Its outline at its widest.
PlanFace outline(const PlacedBlock& block)
{
    return face_of(block, std::max(block.top_ratio, 1.0));
}

std::string in_plan(double x_m, double z_m)
{
    return fmt::format("x = {:.6g} m, z = {:.6g} m", x_m, z_m);
}

/// What a bed needs of the two blocks that it joins.
void check_bed(const PlacedBlock& lower, const PlacedBlock& upper, const BedSpec& bed)
{
    const PlanFace below = top_face(lower), above = bottom_face(upper);
    if (const double gap = gap_m(below, above); gap >= -layout_rounding * upper.width_m)
        throw InputError(fmt::format("structure: {} is beside {}, not on it: they are {} apart. Lower the offset.",
                                     upper.name, lower.name, distance_words(std::max(gap, 0.0))));
    const double hole = bed.inner_ratio * 2 * std::min(below.half_x_m, below.half_z_m);
    if (const double width = 2 * std::min(above.half_x_m, above.half_z_m); width <= hole)
        throw InputError(fmt::format("structure: {} is {} wide, and the hole of the bed under it, in {}, is {} wide "
                                     "(bed_inner_ratio = {:g}). Lower bed_inner_ratio, or widen the drum.",
                                     upper.name, distance_words(width), lower.name, distance_words(hole),
                                     bed.inner_ratio));
    const auto covers = [&](const PlanFace& face) {
        return face.half_x_m >= below.half_x_m * (1 - layout_rounding) &&
               face.half_z_m >= below.half_z_m * (1 - layout_rounding);
    };
    const PlanFace abacus = face_of(upper, 1), &smaller = covers(abacus) ? above : abacus;
    if (upper.capital && !covers(smaller))
        throw InputError(
            fmt::format("structure: {} is {} x {} wide at its bottom, smaller than the top of {}, {} x {}. "
                        "An abacus covers the drum: widen the capital.",
                        upper.name, distance_words(2 * smaller.half_x_m), distance_words(2 * smaller.half_z_m),
                        lower.name, distance_words(2 * below.half_x_m), distance_words(2 * below.half_z_m)));
}

/// Whether a point is inside the convex outline of others: seen from it they leave no half plane empty.
bool is_among(double x, double z, const std::vector<PlanFace>& rectangles)
{
    std::vector<double> azimuths;
    for (const PlanFace& each : rectangles)
        for (const double along_x : {-1.0, 1.0})
            for (const double along_z : {-1.0, 1.0})
                azimuths.push_back(
                    std::atan2(each.z_m + along_z * each.half_z_m - z, each.x_m + along_x * each.half_x_m - x));
    std::sort(azimuths.begin(), azimuths.end());
    double widest = azimuths.front() + 2 * std::numbers::pi - azimuths.back();
    for (std::size_t i = 1; i < azimuths.size(); ++i)
        widest = std::max(widest, azimuths[i] - azimuths[i - 1]);
    return widest < std::numbers::pi * (1 - layout_rounding);
}

/// The columns on which an epistyle lies, in the order of their places along it.
/// @param block the epistyle   @param tops index of the topmost block of each column
std::vector<int> columns_under(const EpistyleSpec& epistyle, const PlacedBlock& block, const StructureSpec& structure,
                               const std::vector<int>& tops, const Layout& layout)
{
    const bool along_z = epistyle.along == Along::z;
    const auto along = [&](int c) {
        const ColumnSpec& column = structure.columns[static_cast<std::size_t>(c)];
        return along_z ? column.z_m : column.x_m;
    };
    const auto is_under = [&](int c) {
        const PlanFace top = top_face(block_at(layout, tops[static_cast<std::size_t>(c)]));
        return gap_m(top, bottom_face(block)) < -layout_rounding * epistyle.width_m;
    };
    const double from = std::min(along(epistyle.first_column), along(epistyle.last_column));
    const double to = std::max(along(epistyle.first_column), along(epistyle.last_column));
    std::vector<int> under;
    for (int c = 0; c < static_cast<int>(structure.columns.size()); ++c)
        if (c == epistyle.first_column || c == epistyle.last_column ||
            (along(c) > from && along(c) < to && is_under(c)))
            under.push_back(c);
    std::stable_sort(under.begin(), under.end(), [&](int a, int b) { return along(a) < along(b); });
    return under;
}

PlacedBlock placed(const EpistyleSpec& epistyle, const std::string& name)
{
    const bool along_z = epistyle.along == Along::z;
    PlacedBlock block;
    block.name = name;
    block.role = BlockRole::epistyle;
    block.column = -1;
    block.width_m = along_z ? epistyle.width_m : epistyle.length_m;
    block.depth_m = along_z ? epistyle.length_m : epistyle.width_m;
    block.height_m = epistyle.height_m;
    block.mass_kg = epistyle.mass_kg;
    block.axis_m = epistyle.x_m;
    block.axis_z_m = epistyle.z_m;
    block.along = epistyle.along;
    const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
    if (!positive(block.width_m) || !positive(block.depth_m) || !positive(block.height_m) || !positive(block.mass_kg))
        throw InputError(
            fmt::format("structure: {} has {:g} x {:g} x {:g} m and {:g} kg. Sizes and masses must be above "
                        "0.",
                        block.name, block.width_m, block.height_m, block.depth_m, block.mass_kg));
    return block;
}

void place_epistyle_in_space(const EpistyleSpec& epistyle, int number, const StructureSpec& structure,
                             const std::vector<int>& tops, Layout& layout)
{
    const int columns = static_cast<int>(tops.size());
    PlacedBlock block = placed(epistyle, fmt::format("epistyle {}", number + 1));
    if (epistyle.first_column < 0 || epistyle.first_column >= columns || epistyle.last_column < 0 ||
        epistyle.last_column >= columns)
        throw InputError(fmt::format("structure: {} lies on the columns from {} to {}, but the columns are 1 to {}.",
                                     block.name, epistyle.first_column + 1, epistyle.last_column + 1, columns));
    const std::vector<int> under = columns_under(epistyle, block, structure, tops, layout);
    const auto top_of = [&](int column) -> const PlacedBlock& {
        return block_at(layout, tops[static_cast<std::size_t>(column)]);
    };
    const int highest =
        *std::max_element(under.begin(), under.end(), [&](int a, int b) { return top_of(a).top() < top_of(b).top(); });
    const double level = top_of(highest).top();
    block.y_m = level + epistyle.height_m / 2;

    const int index = static_cast<int>(layout.blocks.size());
    std::vector<PlanFace> seats;
    for (const int c : under) {
        const PlacedBlock& support = top_of(c);
        if (level - support.top() > layout_rounding * level)
            throw InputError(fmt::format("structure: {} has no seat on column {}: the column's top, at {:.6g} m, is {} "
                                         "below that of column {}. The columns of one epistyle must be equally high.",
                                         block.name, c + 1, support.top(), distance_words(level - support.top()),
                                         highest + 1));
        if (const double gap = gap_m(top_face(support), bottom_face(block)); gap >= -layout_rounding * support.width_m)
            throw InputError(fmt::format(
                "structure: {} along {} has no seat on column {}: its bottom is about {}, the column's "
                "top about {}, and they are {} apart. Lengthen, move or turn it, or omit the column.",
                block.name, epistyle.along == Along::z ? "z" : "x", c + 1, in_plan(block.x_m(), block.z_m()),
                in_plan(support.x_m(), support.z_m()), distance_words(std::max(gap, 0.0))));
        seats.push_back(common_rectangle(top_face(support), bottom_face(block)));
        layout.beds.push_back({tops[static_cast<std::size_t>(c)], index, epistyle.bed});
    }
    if (!is_among(block.x_m(), block.z_m(), seats))
        throw InputError(fmt::format("structure: {} is not stable at rest: its centre of mass, at {}, is not between "
                                     "its seats. Move it.",
                                     block.name, in_plan(block.x_m(), block.z_m())));
    layout.blocks.push_back(std::move(block));
}

} // namespace

PlanFace bottom_face(const PlacedBlock& block)
{
    if (!(block.echinus_part > 0))
        return face_of(block, 1);
    const double radius = block.echinus_ratio * block.width_m / 2;
    return {true, block.x_m(), block.z_m(), radius, radius};
}

PlanFace top_face(const PlacedBlock& block)
{
    return face_of(block, block.top_ratio);
}

BedInPlan bed_in_plan(const Layout& layout, const PlacedBed& bed)
{
    const PlacedBlock& upper = block_at(layout, bed.upper);
    const PlanFace above = bottom_face(upper);
    const double bearing = 1 - bed.bed.inner_ratio * bed.bed.inner_ratio;
    if (bed.lower < 0)
        return {common_rectangle(above, above), bearing * above.area_m2()};
    const PlanFace below = top_face(block_at(layout, bed.lower));
    const double area =
        upper.role == BlockRole::epistyle ? common_area_m2(below, above) : std::min(below.area_m2(), above.area_m2());
    return {common_rectangle(below, above), bearing * area};
}

void check_columns_in_space(const Layout& layout, const std::vector<int>& tops)
{
    int first = 0;
    for (const int last : tops) {
        double mass = 0, moment_x = 0, moment_z = 0;
        for (int i = last; i > first && !block_at(layout, i).fixed; --i) {
            const PlacedBlock &upper = block_at(layout, i), &lower = block_at(layout, i - 1);
            mass += upper.mass_kg;
            moment_x += upper.mass_kg * upper.x_m();
            moment_z += upper.mass_kg * upper.z_m();
            const auto bed = std::find_if(layout.beds.begin(), layout.beds.end(),
                                          [i](const PlacedBed& each) { return each.upper == i; });
            check_bed(lower, upper, bed->bed);
            const double x = moment_x / mass, z = moment_z / mass;
            const double outside = std::max(outside_m(top_face(lower), x, z), outside_m(bottom_face(upper), x, z));
            if (outside >= 0)
                throw InputError(
                    fmt::format("structure: the blocks on {} are not stable at rest: their centre of mass, "
                                "at {}, is {} outside the bed between {} and {}. Lower the offsets.",
                                lower.name, in_plan(x, z), distance_words(outside), lower.name, upper.name));
        }
        first = last + 1;
    }
}

void place_epistyles_in_space(const StructureSpec& structure, const std::vector<int>& tops, Layout& layout)
{
    for (std::size_t e = 0; e < structure.epistyles.size(); ++e)
        place_epistyle_in_space(structure.epistyles[e], static_cast<int>(e), structure, tops, layout);
}

void check_overlaps_in_space(const std::vector<PlacedBlock>& blocks)
{
    for (std::size_t j = 1; j < blocks.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
            const PlacedBlock &a = blocks[i], &b = blocks[j];
            const double wide = -gap_m(outline(a), outline(b));
            const double high = std::min(a.top(), b.top()) - std::max(a.bottom(), b.bottom());
            if (wide > layout_rounding * (a.width_m + b.width_m) && high > layout_rounding * std::max(a.top(), b.top()))
                throw InputError(fmt::format("structure: {} and {} overlap by {} at rest. Move them apart.", a.name,
                                             b.name, distance_words(std::min(wide, high))));
        }
}

} // namespace stylobate
