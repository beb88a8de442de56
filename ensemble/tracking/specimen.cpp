#include "ensemble/tracking/specimen.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace stylobate {
namespace {

constexpr int none = -2; ///< neither a block nor the base (-1)

std::size_t index(int i)
{
    return static_cast<std::size_t>(i);
}

/// What stands on what.
struct Tree {
    std::vector<std::vector<int>> below;   ///< of each block, -1 being the base
    std::vector<std::vector<int>> above;   ///< of each block
    std::vector<std::vector<int>> columns; ///< blocks from the bottom, columns from the left
    std::vector<int> column_of;            ///< of each block; none: an epistyle
    std::vector<int> epistyles;            ///< from the left
};

[[noreturn]] void refuse(const std::string& text)
{
    throw InputError("specimen: " + text);
}

void check_complete(const Specimen& specimen)
{
    const std::size_t n = specimen.half_width_m.size();
    const auto need = [&](const std::vector<double>& values, const char* name) {
        if (values.empty() || values.size() != n)
            refuse(fmt::format(
                "{} is absent, or does not have one value for each of the {} blocks.\n  Simulations need it.", name,
                n));
        for (std::size_t i = 0; i < n; ++i)
            if (!std::isfinite(values[i]))
                refuse(fmt::format("{} of block {} is not a number.", name, i));
    };
    need(specimen.half_width_m, "half_width_m");
    need(specimen.half_height_m, "half_height_m");
    need(specimen.depth_m, "depth_m");
    need(specimen.mass_kg, "mass_kg");
    if (!specimen.rest_x_m.empty())
        need(specimen.rest_x_m, "rest_x_m");
    if (!specimen.rest_y_m.empty())
        need(specimen.rest_y_m, "rest_y_m");
    if (specimen.joints.empty())
        refuse("there are no joints.\n  A joint gives the lower block (-1: the base) and the upper block.");
    for (std::size_t i = 1; i < n; ++i)
        if (std::abs(specimen.depth_m[i] - specimen.depth_m[0]) > 1e-6 * specimen.depth_m[0])
            refuse(fmt::format("block 0 is {:g} m deep and block {} {:g} m.\n  Simulations are plane: all blocks have "
                               "one depth.",
                               specimen.depth_m[0], i, specimen.depth_m[i]));
}

double rest_x(const Specimen& specimen, int block)
{
    return specimen.rest_x_m.empty() ? 0 : specimen.rest_x_m[index(block)];
}

Tree tree_of(const Specimen& specimen)
{
    const int blocks = specimen.blocks();
    Tree tree;
    tree.below.resize(index(blocks));
    tree.above.resize(index(blocks));
    tree.column_of.assign(index(blocks), none);
    for (std::size_t j = 0; j < specimen.joints.size(); ++j) {
        const auto [lower, upper] = specimen.joints[j];
        if (lower < -1 || upper < 0 || lower >= blocks || upper >= blocks || lower == upper)
            refuse(
                fmt::format("joint {} is between {} and {}, but the blocks are 0 to {}.", j, lower, upper, blocks - 1));
        tree.below[index(upper)].push_back(lower);
        if (lower >= 0)
            tree.above[index(lower)].push_back(upper);
    }
    const auto is_epistyle = [&](int block) { return tree.below[index(block)].size() > 1; };
    const auto by_x = [&](int a, int b) { return rest_x(specimen, a) < rest_x(specimen, b); };
    for (int block = 0; block < blocks; ++block) {
        const std::vector<int>& below = tree.below[index(block)];
        if (below.empty())
            refuse(fmt::format("block {} stands on nothing: no joint has it as its upper block.", block));
        for (const int lower : below)
            if (lower >= 0 && is_epistyle(lower))
                refuse(fmt::format("block {} stands on block {}, an epistyle.\n  Simulations have columns with one "
                                   "layer of epistyles.",
                                   block, lower));
        if (is_epistyle(block) && std::find(below.begin(), below.end(), -1) != below.end())
            refuse(fmt::format("block {} stands on the base and on another block.\n  An epistyle lies on columns.",
                               block));
        if (is_epistyle(block))
            tree.epistyles.push_back(block);
    }
    for (int block = 0; block < blocks; ++block)
        if (tree.below[index(block)] == std::vector<int>{-1})
            tree.columns.push_back({block});
    std::sort(tree.columns.begin(), tree.columns.end(),
              [&](const auto& a, const auto& b) { return by_x(a.front(), b.front()); });
    std::sort(tree.epistyles.begin(), tree.epistyles.end(), by_x);
    for (std::size_t c = 0; c < tree.columns.size(); ++c)
        for (std::vector<int>& column = tree.columns[c];;) {
            tree.column_of[index(column.back())] = static_cast<int>(c);
            int next = none;
            for (const int upper : tree.above[index(column.back())]) {
                if (is_epistyle(upper))
                    continue;
                if (next != none)
                    refuse(fmt::format("blocks {} and {} both stand on block {}.\n  A drum carries one drum, or "
                                       "epistyles.",
                                       next, upper, column.back()));
                next = upper;
            }
            if (next == none)
                break;
            column.push_back(next);
        }
    for (int block = 0; block < blocks; ++block)
        if (!is_epistyle(block) && tree.column_of[index(block)] == none)
            refuse(fmt::format("block {} is not joined to the base: follow the joints down from it.", block));
    return tree;
}

/// The columns on which an epistyle lies, checked to be its neighbours' tops.
EpistyleSpec epistyle_of(const Specimen& specimen, const Tree& tree, int block, double origin_x)
{
    EpistyleSpec epistyle;
    std::vector<int> columns;
    for (const int lower : tree.below[index(block)]) {
        const int column = tree.column_of[index(lower)];
        if (tree.columns[index(column)].back() != lower)
            refuse(fmt::format("block {} lies on block {}, which is not the top of its column: block {} stands on it "
                               "too.",
                               block, lower, tree.columns[index(column)].back()));
        columns.push_back(column);
    }
    std::sort(columns.begin(), columns.end());
    for (std::size_t i = 1; i < columns.size(); ++i)
        if (columns[i] != columns[i - 1] + 1)
            refuse(fmt::format("block {} lies on the columns of blocks {} and {}, but not on what stands between them.",
                               block, tree.columns[index(columns[i - 1])].front(),
                               tree.columns[index(columns[i])].front()));
    epistyle.first_column = columns.front();
    epistyle.last_column = columns.back();
    epistyle.x_m = rest_x(specimen, block) - origin_x;
    epistyle.length_m = 2 * specimen.half_width_m[index(block)];
    epistyle.height_m = 2 * specimen.half_height_m[index(block)];
    epistyle.mass_kg = specimen.mass_kg[index(block)];
    return epistyle;
}

/// True if one base block, about x = 0, reaches under every column of several.
bool is_ground(const Specimen& specimen, const Tree& tree)
{
    if (tree.columns.size() < 2)
        return false;
    return std::all_of(tree.columns.begin(), tree.columns.end(), [&](const std::vector<int>& column) {
        const int foot = column.front();
        return std::abs(rest_x(specimen, foot)) + specimen.half_width_m[index(foot)] <=
               *specimen.base_block_half_width_m;
    });
}

} // namespace

SpecimenStructure build_specimen(const Specimen& specimen)
{
    check_complete(specimen);
    const Tree tree = tree_of(specimen);
    SpecimenStructure built;
    StructureSpec& structure = built.structure;
    structure.depth_m = specimen.depth_m[0];
    structure.gravity_m_s2 = specimen.gravity_m_s2;
    const bool alone = tree.columns.size() == 1 && tree.epistyles.empty();
    structure.kind = alone ? StructureKind::column : StructureKind::colonnade;
    if (tree.columns.size() > 1 && specimen.rest_x_m.empty())
        refuse("rest_x_m is absent.\n  It gives the positions of the columns.");
    built.origin_x_m = alone ? rest_x(specimen, tree.columns[0][0]) : 0;
    const bool raised = specimen.base_block_half_width_m.has_value() && specimen.base_block_top_m > 0;
    const bool fixed = raised && !is_ground(specimen, tree);
    built.origin_y_m = raised && !fixed ? specimen.base_block_top_m : 0;
    built.block.assign(index(specimen.blocks()), 0);

    int placed = 0;
    for (const std::vector<int>& blocks : tree.columns) {
        ColumnSpec column;
        const std::size_t foot = index(blocks.front());
        column.x_m = rest_x(specimen, blocks.front()) - built.origin_x_m;
        if (fixed) {
            DrumSpec base;
            base.width_m = 2 * *specimen.base_block_half_width_m;
            base.height_m = specimen.base_block_top_m;
            // it never moves: any mass would do, that of the drum's stone is natural
            base.mass_kg = specimen.mass_kg[foot] * base.width_m * base.height_m /
                           (4 * specimen.half_width_m[foot] * specimen.half_height_m[foot]);
            column.drums.push_back(base);
            column.fixed_blocks = 1;
            ++placed;
        }
        for (const int block : blocks) {
            DrumSpec drum;
            drum.width_m = 2 * specimen.half_width_m[index(block)];
            drum.height_m = 2 * specimen.half_height_m[index(block)];
            drum.mass_kg = specimen.mass_kg[index(block)];
            drum.offset_m = rest_x(specimen, block) - rest_x(specimen, blocks.front());
            column.drums.push_back(drum);
            built.block[index(block)] = placed++;
        }
        structure.columns.push_back(std::move(column));
    }
    for (const int block : tree.epistyles) {
        structure.epistyles.push_back(epistyle_of(specimen, tree, block, built.origin_x_m));
        built.block[index(block)] = placed++;
    }

    const Layout layout = lay_out(structure);
    for (const auto& [lower, upper] : specimen.joints) {
        const int top = built.block[index(upper)];
        // under a fixed drum's neighbour there is that drum
        const int bottom = lower >= 0 ? built.block[index(lower)] : fixed ? top - 1 : -1;
        const auto bed = std::find_if(layout.beds.begin(), layout.beds.end(),
                                      [&](const PlacedBed& b) { return b.lower == bottom && b.upper == top; });
        if (bed == layout.beds.end())
            refuse(fmt::format("the joint between blocks {} and {} is no bed of the structure.", lower, upper));
        built.bed.push_back(static_cast<int>(bed - layout.beds.begin()));
    }
    return built;
}

StructureSpec structure_of(const Specimen& specimen)
{
    return build_specimen(specimen).structure;
}

} // namespace stylobate
