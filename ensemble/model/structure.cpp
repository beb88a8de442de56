#include "ensemble/model/structure.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/layout_in_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

constexpr double rounding = layout_rounding;

struct Interval {
    double from = 0;
    double to = 0;
    double length() const { return to - from; }
    bool contains(double x) const { return from < x && x < to; }
};

/// Where two faces, one upon the other, meet.
Interval common(const PlacedBlock& a, const PlacedBlock& b)
{
    return {std::max(a.left(), b.left()), std::min(a.right(), b.right())};
}

std::string distance(double metres)
{
    return distance_words(metres);
}

const PlacedBlock& at(const Layout& layout, int block)
{
    return layout.blocks[static_cast<std::size_t>(block)];
}

void check_size(const PlacedBlock& block, bool spatial)
{
    const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
    if (spatial && (!positive(block.depth_m) || !positive(block.top_ratio) || !std::isfinite(block.z_m())))
        throw InputError(
            fmt::format("structure: {} is {:g} m deep, its top has {:g} times the width of its bottom, and "
                        "it stands at z = {:g} m. Sizes must be above 0.",
                        block.name, block.depth_m, block.top_ratio, block.z_m()));
    if (!positive(block.width_m) || !positive(block.height_m) || !positive(block.mass_kg) ||
        !std::isfinite(block.x_m()))
        throw InputError(fmt::format("structure: {} is {:g} m wide, {:g} m high, has {:g} kg and stands at x = {:g} m. "
                                     "Sizes and masses must be above 0.",
                                     block.name, block.width_m, block.height_m, block.mass_kg, block.x_m()));
}

/// Puts the drums of a column one upon the other.
/// @param of_column behind the name of a block where there are several columns
/// @return index of the topmost one
int place_column(const ColumnSpec& column, int number, const std::string& of_column, bool spatial, Layout& layout)
{
    const int drums = static_cast<int>(column.drums.size());
    if (drums == 0)
        throw InputError(fmt::format("structure: column {} has no drum.", number + 1));
    if (column.fixed_blocks < 0 || column.fixed_blocks >= drums)
        throw InputError(fmt::format("structure: {} of the {} drums of column {} are fixed. At least one must be free.",
                                     column.fixed_blocks, drums, number + 1));
    double top = 0;
    for (int i = 0; i < drums; ++i) {
        const DrumSpec& drum = column.drums[static_cast<std::size_t>(i)];
        PlacedBlock block;
        block.name = (drum.capital ? std::string("capital") : fmt::format("drum {}", i + 1)) + of_column;
        block.column = number;
        block.width_m = drum.width_m;
        block.height_m = drum.height_m;
        block.mass_kg = drum.mass_kg;
        block.axis_m = column.x_m;
        block.offset_m = drum.offset_m;
        if (spatial) {
            block.shape = drum.shape;
            block.depth_m = drum.depth_m;
            block.top_ratio = drum.top_width_m / drum.width_m;
            block.axis_z_m = column.z_m;
            block.offset_z_m = drum.offset_z_m;
            block.capital = drum.capital;
            block.echinus_part = drum.echinus_height_m / drum.height_m;
            block.echinus_ratio = drum.echinus_width_m / drum.width_m;
        }
        block.y_m = top + drum.height_m / 2;
        block.fixed = i < column.fixed_blocks;
        check_size(block, spatial);
        const int index = static_cast<int>(layout.blocks.size());
        if (!block.fixed)
            layout.beds.push_back({i > 0 ? index - 1 : -1, index, drum.bed});
        layout.blocks.push_back(std::move(block));
        top += drum.height_m;
    }
    return static_cast<int>(layout.blocks.size()) - 1;
}

/// Nothing may fall before the shaking: what stands on each bed of a column has its centre of mass above the bed. On
/// the ground that is so if it is on the lowest drum, whose own centre is above its face.
/// @param first, last the column's blocks
void check_column(const Layout& layout, int first, int last)
{
    double mass = 0;
    double moment = 0;
    for (int i = last; i > first && !at(layout, i).fixed; --i) {
        const PlacedBlock& upper = at(layout, i);
        mass += upper.mass_kg;
        moment += upper.mass_kg * upper.x_m();
        const PlacedBlock& lower = at(layout, i - 1);
        const Interval bed = common(lower, upper);
        if (bed.length() <= rounding * upper.width_m)
            throw InputError(fmt::format("structure: {} is beside {}, not on it: they are {} apart. Lower the offset.",
                                         upper.name, lower.name, distance(-bed.length())));
        const double centre = moment / mass;
        if (!bed.contains(centre))
            throw InputError(
                fmt::format("structure: the blocks on {} are not stable at rest: their centre of mass, at x = "
                            "{:.6g} m, is {} outside the bed between {} and {}, from {:.6g} to {:.6g} m. "
                            "Lower the offsets.",
                            lower.name, centre, distance(std::max(bed.from - centre, centre - bed.to)), lower.name,
                            upper.name, bed.from, bed.to));
    }
}

/// Lays an epistyle on its columns. @param tops index of the topmost block of each column
void place_epistyle(const EpistyleSpec& epistyle, int number, const std::vector<int>& tops, Layout& layout)
{
    const int columns = static_cast<int>(tops.size());
    PlacedBlock block;
    block.name = fmt::format("epistyle {}", number + 1);
    if (epistyle.first_column < 0 || epistyle.last_column < epistyle.first_column || epistyle.last_column >= columns)
        throw InputError(fmt::format("structure: {} lies on the columns from {} to {}, but the columns are 1 to {}, "
                                     "counted from the left.",
                                     block.name, epistyle.first_column + 1, epistyle.last_column + 1, columns));
    const auto top_of = [&](int column) -> const PlacedBlock& {
        return at(layout, tops[static_cast<std::size_t>(column)]);
    };
    int highest = epistyle.first_column;
    for (int c = epistyle.first_column; c <= epistyle.last_column; ++c)
        if (top_of(c).top() > top_of(highest).top())
            highest = c;
    const double level = top_of(highest).top();

    block.role = BlockRole::epistyle;
    block.column = -1;
    block.width_m = epistyle.length_m;
    block.height_m = epistyle.height_m;
    block.mass_kg = epistyle.mass_kg;
    block.axis_m = epistyle.x_m;
    block.y_m = level + epistyle.height_m / 2;
    check_size(block, false);

    const int index = static_cast<int>(layout.blocks.size());
    Interval seats;
    for (int c = epistyle.first_column; c <= epistyle.last_column; ++c) {
        const PlacedBlock& support = top_of(c);
        if (level - support.top() > rounding * level)
            throw InputError(fmt::format("structure: {} has no seat on column {}: the column's top, at {:.6g} m, is {} "
                                         "below that of column {}. The columns of one epistyle must be equally high.",
                                         block.name, c + 1, support.top(), distance(level - support.top()),
                                         highest + 1));
        const Interval seat = common(support, block);
        if (seat.length() <= rounding * support.width_m)
            throw InputError(fmt::format(
                "structure: {} has no seat on column {}: it reaches from x = {:.6g} to {:.6g} "
                "m and the column's top from {:.6g} to {:.6g} m, {} apart. Lengthen it, move it, or omit the column.",
                block.name, c + 1, block.left(), block.right(), support.left(), support.right(),
                distance(std::max(-seat.length(), 0.0))));
        seats.from = c == epistyle.first_column ? seat.from : std::min(seats.from, seat.from);
        seats.to = c == epistyle.first_column ? seat.to : std::max(seats.to, seat.to);
        layout.beds.push_back({tops[static_cast<std::size_t>(c)], index, epistyle.bed});
    }
    if (!seats.contains(block.x_m()))
        throw InputError(
            fmt::format("structure: {} is not stable at rest: its centre of mass, at x = {:.6g} m, is {} outside its "
                        "seats, which reach from {:.6g} to {:.6g} m. Move it.",
                        block.name, block.x_m(), distance(std::max(seats.from - block.x_m(), block.x_m() - seats.to)),
                        seats.from, seats.to));
    layout.blocks.push_back(std::move(block));
}

/// No two blocks in one place; neighbours that just touch are fine.
void check_overlaps(const std::vector<PlacedBlock>& blocks)
{
    for (std::size_t j = 1; j < blocks.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
            const PlacedBlock& a = blocks[i];
            const PlacedBlock& b = blocks[j];
            const double wide = common(a, b).length();
            const double high = std::min(a.top(), b.top()) - std::max(a.bottom(), b.bottom());
            if (wide > rounding * (a.width_m + b.width_m) && high > rounding * std::max(a.top(), b.top()))
                throw InputError(fmt::format("structure: {} and {} overlap by {} at rest. Move them apart.", a.name,
                                             b.name, distance(std::min(wide, high))));
        }
}

} // namespace

std::string distance_words(double metres)
{
    return std::abs(metres) < 1 ? fmt::format("{:.4g} mm", 1000 * metres) : fmt::format("{:.4g} m", metres);
}

double volume_m3(const StructureSpec& structure, const PlacedBlock& block)
{
    return structure.spatial() ? block.frustum().volume_m3() : block.width_m * block.height_m * structure.depth_m;
}

StructureSpec equal_column(int blocks, int fixed, double width_m, double height_m, double depth_m, double mass_kg,
                           double gravity_m_s2)
{
    StructureSpec structure;
    structure.depth_m = depth_m;
    structure.gravity_m_s2 = gravity_m_s2;
    structure.columns.resize(1);
    structure.columns[0].fixed_blocks = fixed;
    structure.columns[0].drums.assign(static_cast<std::size_t>(blocks),
                                      {.width_m = width_m, .height_m = height_m, .mass_kg = mass_kg});
    return structure;
}

Layout lay_out(const StructureSpec& structure)
{
    if (structure.columns.empty())
        throw InputError("structure: there is no column.");
    if (structure.kind == StructureKind::column && (structure.columns.size() > 1 || structure.columns[0].x_m != 0 ||
                                                    structure.columns[0].z_m != 0 || !structure.epistyles.empty()))
        throw InputError("structure: a column stands alone, at x = 0, without an epistyle. For several columns, give "
                         "kind = \"colonnade\".");

    const bool spatial = structure.spatial();
    Layout layout;
    std::vector<int> tops;
    for (std::size_t c = 0; c < structure.columns.size(); ++c) {
        if (!spatial && c > 0 && !(structure.columns[c].x_m > structure.columns[c - 1].x_m))
            throw InputError(fmt::format("structure: column {} stands at x = {:g} m, not to the right of column {} at "
                                         "{:g} m. List the columns from the left.",
                                         c + 1, structure.columns[c].x_m, c, structure.columns[c - 1].x_m));
        const int first = static_cast<int>(layout.blocks.size());
        const std::string of_column = structure.columns.size() > 1 ? fmt::format(" of column {}", c + 1) : "";
        tops.push_back(place_column(structure.columns[c], static_cast<int>(c), of_column, spatial, layout));
        if (!spatial)
            check_column(layout, first, tops.back());
    }
    if (spatial) {
        check_columns_in_space(layout, tops);
        place_epistyles_in_space(structure, tops, layout);
        check_overlaps_in_space(layout.blocks);
        return layout;
    }
    for (std::size_t e = 0; e < structure.epistyles.size(); ++e) {
        if (e > 0 && !(structure.epistyles[e].x_m > structure.epistyles[e - 1].x_m))
            throw InputError(fmt::format("structure: epistyle {} lies at x = {:g} m, not to the right of epistyle {} "
                                         "at {:g} m. List the epistyles from the left.",
                                         e + 1, structure.epistyles[e].x_m, e, structure.epistyles[e - 1].x_m));
        place_epistyle(structure.epistyles[e], static_cast<int>(e), tops, layout);
    }
    check_overlaps(layout.blocks);
    return layout;
}

int right_neighbour(const Layout& layout, int block)
{
    const PlacedBlock& left = layout.blocks[static_cast<std::size_t>(block)];
    const double near = left.right() - 1e-9 * left.width_m; // faces that touch, to rounding
    int found = -1;
    for (std::size_t i = 0; i < layout.blocks.size(); ++i) {
        const PlacedBlock& other = layout.blocks[i];
        if (other.left() < near || !(other.bottom() < left.y_m && left.y_m < other.top()))
            continue;
        if (found < 0 || other.left() < layout.blocks[static_cast<std::size_t>(found)].left())
            found = static_cast<int>(i);
    }
    return found;
}

} // namespace stylobate
