#pragma once
/// What stands on the ground: columns of drums, and the epistyles that lie on them. Plain data, SI units; and where
/// each block of it stands at rest.
///
/// A structure is in the plane (x to the right, y up), where every block is a rectangle of the same depth, or in space
/// (z towards the viewer), where blocks have shapes of their own.

#include "ensemble/model/frustum.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// What a block is, for names, limit states and pictures.
enum class BlockRole : std::uint8_t {
    drum,     ///< of a column, a capital or a whole shaft included
    epistyle, ///< spans from column to column
    ground    ///< what a structure stands on, and what has fallen lies on
};

enum class StructureKind {
    column,   ///< one column: where it stands is all that its blocks can meet
    colonnade ///< columns with or without epistyles: any block may meet any other one
};

/// Values of a bed that differ from those of [contact].
struct BedSpec {
    std::optional<double> friction;                      ///< mu
    std::optional<double> normal_stiffness_n_m2;         ///< K_N
    std::optional<double> tangential_stiffness_n_m;      ///< K_T
    std::optional<double> restitution;                   ///< of the rigid form
    std::optional<double> normal_damping_ratio = {};     ///< of critical; of a layer in the joint
    std::optional<double> tangential_damping_ratio = {}; ///< the same along the face
    // in space
    std::optional<double> normal_stiffness_n_m3 = {};     ///< per area of the bed
    std::optional<double> tangential_stiffness_n_m3 = {}; ///< per area of the bed
    double inner_ratio = 0; ///< hollow bed: inner over outer size of its faces; 0: the whole face bears
    friend bool operator==(const BedSpec&, const BedSpec&) = default;
};

/// A block of a column: a drum, a capital or a whole shaft.
struct DrumSpec {
    double width_m = 0;  ///< full width B
    double height_m = 0; ///< full height H
    double mass_kg = 0;
    double offset_m = 0;  ///< of its centre from the axis of its column
    BedSpec bed = {};     ///< under it; without meaning where it and what it stands on are fixed
    bool capital = false; ///< the uppermost one of its column may be
    // in space
    Shape shape = Shape::round;
    double depth_m = 0;          ///< extent along z of the bottom face; of round and square ones the width
    double top_width_m = 0;      ///< width of the top face, whose depth is smaller in the same proportion
    double offset_z_m = 0;       ///< of its centre from the axis of its column, along z
    double echinus_height_m = 0; ///< of a capital: the part of its height that is the echinus, at its bottom; 0: none
    double echinus_width_m = 0;  ///< diameter of the echinus at its bottom
    friend bool operator==(const DrumSpec&, const DrumSpec&) = default;
};

struct ColumnSpec {
    double x_m = 0;              ///< its axis
    int fixed_blocks = 0;        ///< number of drums, the lowest ones, that are fixed to the shaking table
    std::vector<DrumSpec> drums; ///< from the bottom
    double z_m = 0;              ///< its axis, in space
    friend bool operator==(const ColumnSpec&, const ColumnSpec&) = default;
};

/// The axis along which an epistyle reaches, in space.
enum class Along : std::uint8_t { x, z };

/// Lies on every column from the first to the last one. In space: on these two, and on those between them whose tops
/// are under a part of it.
struct EpistyleSpec {
    int first_column = 0; ///< from 0, from the left
    int last_column = 0;
    double x_m = 0;      ///< its centre
    double length_m = 0; ///< along the colonnade
    double height_m = 0;
    double mass_kg = 0;
    BedSpec bed = {}; ///< each of its seats
    // in space
    Along along = Along::x;
    double width_m = 0; ///< horizontally across its length
    double z_m = 0;     ///< its centre
    friend bool operator==(const EpistyleSpec&, const EpistyleSpec&) = default;
};

struct StructureSpec {
    StructureKind kind = StructureKind::column;
    double depth_m = 0;                  ///< D, out of the plane, of every block
    double gravity_m_s2 = 9.81;          ///< the acceleration of gravity
    std::vector<ColumnSpec> columns;     ///< from the left
    std::vector<EpistyleSpec> epistyles; ///< from the left
    int dimensions = 2;                  ///< 2: in the plane; 3: in space, where columns and epistyles have any order
    bool spatial() const { return dimensions == 3; }
    friend bool operator==(const StructureSpec&, const StructureSpec&) = default;
};

/// A column of equal drums about x = 0.
/// @param blocks drums, with the fixed ones   @param fixed number of the lowest ones that are fixed to the table
StructureSpec equal_column(int blocks, int fixed, double width_m, double height_m, double depth_m, double mass_kg,
                           double gravity_m_s2 = 9.81);

/// A block in its place at rest, faces just touching.
struct PlacedBlock {
    /// "drum 3 of column 2", "capital of column 2", "epistyle 1", of a single column "drum 3": counted from 1, from the
    /// base and from the left. Indices in keys and tables count from 0.
    std::string name;
    BlockRole role = BlockRole::drum;
    int column = 0;     ///< of a drum, from the left; -1 for an epistyle
    double width_m = 0; ///< along x; of a frustum at its bottom
    double height_m = 0;
    double mass_kg = 0;
    double axis_m = 0;   ///< from which its offset counts: of its column, or the place of an epistyle
    double offset_m = 0; ///< of its centre from there
    double y_m = 0;      ///< centre, half way up, above the base
    bool fixed = false;
    // in space
    Shape shape = Shape::rectangle;
    double depth_m = 0;   ///< along z, at its bottom
    double top_ratio = 1; ///< of the top face over the bottom one, along x and z; of a capital of its abacus
    double echinus_part = 0, echinus_ratio = 0; ///< of a capital (`Frustum`)
    double axis_z_m = 0;                        ///< as `axis_m`, along z
    double offset_z_m = 0;                      ///< of its centre from there
    Along along = Along::x;                     ///< of an epistyle
    bool capital = false;

    double z_m() const { return axis_z_m + offset_z_m; } ///< centre
    /// Its body in space.
    Frustum frustum() const { return {shape, width_m, depth_m, height_m, top_ratio, echinus_part, echinus_ratio}; }
    /// The extent that a realization may draw (`Quantity::drum_width`): its width, of an epistyle its length.
    double drawn_width_m() const { return along == Along::z ? depth_m : width_m; }

    double x_m() const { return axis_m + offset_m; } ///< centre
    double left() const { return x_m() - width_m / 2; }
    double right() const { return x_m() + width_m / 2; }
    double bottom() const { return y_m - height_m / 2; }
    double top() const { return y_m + height_m / 2; }
};

struct PlacedBed {
    int lower = -1; ///< block; -1: the ground
    int upper = 0;  ///< block, a free one
    BedSpec bed = {};
};

struct Layout {
    std::vector<PlacedBlock> blocks; ///< column by column from the bottom, then the epistyles
    std::vector<PlacedBed> beds;     ///< column by column from the bottom, then the epistyles' seats from the left
};

/// Volume of a block [m3]: a rectangle's with the depth of the structure, or a frustum's.
double volume_m3(const StructureSpec& structure, const PlacedBlock& block);

/// Where the blocks of a structure stand and on what.
///
/// In space "above the bed" is above both faces seen from above, and "between the seats" is inside the convex outline
/// of all seats; a block narrower than the hole of the bed under it, and a capital smaller than the drum under it, are
/// refused too.
///
/// @throws InputError, naming the blocks and the distance, for a structure that cannot stand: blocks that overlap
///         (neighbours that just touch are fine), drums whose common centre of mass is not above the bed under them
///         (epistyles left out), an epistyle that one of its columns does not reach or reaches at another height, or
///         whose centre of mass is not between its outermost seats; for blocks without size or mass, for columns and
///         epistyles that are not listed from the left (in the plane), and for a column that is fixed as a whole
Layout lay_out(const StructureSpec& structure);

/// The block that stands next to one at its right: at the height of its middle, nearest to it; -1: none.
int right_neighbour(const Layout& layout, int block);

} // namespace stylobate
