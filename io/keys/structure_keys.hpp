#pragma once
/// The keys of [structure]: of drums, capitals, columns and epistyles.

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"

namespace stylobate {

namespace structure_keys {

inline constexpr std::uint64_t most_blocks = 200; ///< in all: every two of them may meet
inline constexpr std::uint64_t most_columns = 50;

// of a drum, a capital or an epistyle

inline const NumberKey width("width_m", &DrumSpec::width_m, length_range,
                             "width of the block; of a round one its diameter, in space at its bottom",
                             {.absent = "drum_width_m; of a capital needed", .example = "1.0"});
inline const NumberKey height("height_m", &DrumSpec::height_m, length_range, "height of the block",
                              {.absent = "drum_height_m; of a capital needed", .example = "0.8"});
inline const NumberKey mass("mass_kg", &DrumSpec::mass_kg, mass_range, "mass of the block; excludes density_kg_m3",
                            {.absent = "from the density"});
inline const NumberKey density("density_kg_m3", density_range, "density of the stone; marble has about 2700",
                               {.absent = "that of the column or of all blocks", .example = "2700"});
inline const Range offset_range{-length_range.high, length_range.high, false, length_range.hint, length_range.slips};
inline const NumberKey offset("offset_m", &DrumSpec::offset_m, offset_range,
                              "distance of the block's centre from the axis of its column, to the right; no more "
                              "than its width");
inline const NumberKey offset_z("offset_z_m", &DrumSpec::offset_z_m, offset_range, "the same along z",
                                {.models = in_space()});
inline const NumberKey own_depth("depth_m", &DrumSpec::depth_m, length_range,
                                 "extent along z, of shape = \"rectangle\"; at its bottom",
                                 {.absent = "drum_depth_m; of other shapes the width", .models = in_space()});
inline const NumberKey own_top_width("top_width_m", &DrumSpec::top_width_m, length_range,
                                     "width of its top face: the block is a frustum of a cone or pyramid",
                                     {.absent = "its width", .models = in_space()});
inline const WordKey<Shape> own_shape("shape", &DrumSpec::shape, shape_names, "outline seen from above",
                                      {.absent = "that of the column", .models = in_space()});
inline const WordKey<Shape> capital_shape("shape", Shape::square, shape_names,
                                          "outline seen from above: an abacus is square", {.models = in_space()});
inline const NumberKey
    echinus_height("echinus_height_m", &DrumSpec::echinus_height_m, length_range,
                   "height of the echinus, a part of the capital's height: a frustum of a cone below "
                   "the abacus, whose sides its upper circle touches",
                   {.absent = "no echinus: the abacus lies on the drum", .models = in_space()});
inline const NumberKey echinus_width("echinus_width_m", &DrumSpec::echinus_width_m, length_range,
                                     "diameter of the echinus at its bottom",
                                     {.absent = "the top width of the drum below", .models = in_space()});
inline const NumberKey own_inner_ratio("bed_inner_ratio", &BedSpec::inner_ratio, inner_ratio_range,
                                       "hollow bed under the block: inner over outer size of its faces",
                                       {.absent = "that of the column; of a capital 0", .models = in_space()});
inline const NumberKey bed_friction("friction", &BedSpec::friction, friction_range,
                                    "coefficient of friction of the bed under the block",
                                    {.absent = "contact.friction"});
inline const NumberKey bed_normal_stiffness("normal_stiffness_n_m2", &BedSpec::normal_stiffness_n_m2,
                                            normal_stiffness_range, "K_N of the bed under the block",
                                            {.absent = "contact.normal_stiffness_n_m2", .models = in_plane()});
inline const NumberKey bed_tangential_stiffness("tangential_stiffness_n_m", &BedSpec::tangential_stiffness_n_m,
                                                tangential_stiffness_range, "K_T of the bed under the block",
                                                {.absent = "contact.tangential_stiffness_n_m", .models = in_plane()});
inline const NumberKey bed_area_stiffness("normal_stiffness_n_m3", &BedSpec::normal_stiffness_n_m3, bed_stiffness_range,
                                          "stiffness per area of the bed under the block",
                                          {.absent = "contact.normal_stiffness_n_m3", .models = in_space()});
inline const NumberKey
    bed_area_tangential_stiffness("tangential_stiffness_n_m3", &BedSpec::tangential_stiffness_n_m3, bed_stiffness_range,
                                  "tangential stiffness per area of the bed under the block",
                                  {.absent = "contact.tangential_stiffness_n_m3", .models = in_space()});
inline const NumberKey bed_restitution("restitution", &BedSpec::restitution, restitution_range,
                                       "restitution of the bed under the block, of rigid contacts",
                                       {.absent = "contact.restitution", .models = in_plane()});
inline const NumberKey bed_normal_damping(
    "normal_damping_ratio", &BedSpec::normal_damping_ratio, damping_ratio_range,
    "normal dashpot of the bed under the block as a fraction of the critical damping, of a layer in it",
    {.absent = "contact.normal_damping_ratio"});
inline const NumberKey bed_tangential_damping("tangential_damping_ratio", &BedSpec::tangential_damping_ratio,
                                              damping_ratio_range, "tangential dashpot of that bed",
                                              {.absent = "contact.tangential_damping_ratio"});
inline const WholeKey count("count", 1, {1, most_blocks, "Equal drums, one on the other."}, "number of equal drums");

// of a column, and of all columns

inline const WholeKey
    blocks("blocks",
           {1, most_blocks, "Drums of the column, including the fixed ones; or give drums = [ { ... }, ... ]."},
           "number of equal drums, including the fixed ones", {.absent = "the drums of `drums`", .example = "6"});
inline const WholeKey fixed_blocks("fixed_blocks", &ColumnSpec::fixed_blocks,
                                   {0, most_blocks - 1, "At least one of the drums must be free."},
                                   "number of the lowest blocks that are fixed to the shaking table");
inline const TableKey drums("drums", "the drums one by one from the bottom, instead of `blocks`",
                            {&width, &height, &own_shape, &own_depth, &own_top_width, &mass, &density, &offset,
                             &offset_z, &bed_friction, &bed_normal_stiffness, &bed_tangential_stiffness,
                             &bed_area_stiffness, &bed_area_tangential_stiffness, &own_inner_ratio, &bed_restitution,
                             &bed_normal_damping, &bed_tangential_damping, &count},
                            {.absent = "equal drums"}, KeyType::tables);
inline const NumberKey drum_width("drum_width_m", &DrumSpec::width_m, length_range,
                                  "width of the drums, of round ones the diameter; with top_width_m of the lowest",
                                  {.absent = "each of `drums` has its own", .example = "1.0"});
inline const NumberKey drum_height("drum_height_m", &DrumSpec::height_m, length_range, "height of the drums",
                                   {.absent = "each of `drums` has its own", .example = "0.8"});
inline const NumberKey top_width("top_width_m", length_range,
                                 "width of the highest drum, in space of the top of the column: the drums taper "
                                 "linearly; needs density_kg_m3",
                                 {.absent = "no taper"});
inline const WordKey<Shape> shape("shape", Shape::round, shape_names, "outline of the drums seen from above",
                                  {.models = in_space()});
inline const NumberKey drum_depth("drum_depth_m", length_range,
                                  "extent of the drums along z, of shape = \"rectangle\"; with top_width_m it shrinks "
                                  "in the same proportion",
                                  {.absent = "needed for \"rectangle\", not used otherwise", .models = in_space()});
inline const NumberKey inner_ratio("bed_inner_ratio", 0.0, inner_ratio_range,
                                   "hollow beds between drums (anathyrosis): inner over outer size of their faces; 0: "
                                   "the whole face bears",
                                   {.models = in_space()});
inline const NumberKey depth("depth_m", &StructureSpec::depth_m, length_range, "depth of all blocks, out of the plane",
                             {.needed = true, .example = "1.0", .models = in_plane()});
inline const NumberKey drum_mass("drum_mass_kg", &DrumSpec::mass_kg, mass_range,
                                 "mass of each drum; excludes density_kg_m3", {.absent = "from density_kg_m3"});
inline const NumberKey density_of_all("density_kg_m3", density_range,
                                      "density of all blocks that have no mass and no density of their own",
                                      {.absent = "masses are given", .example = "2700"});
inline const TableKey capital("capital", "an additional block on top of the column",
                              {&width,
                               &height,
                               &capital_shape,
                               &own_depth,
                               &own_top_width,
                               &echinus_height,
                               &echinus_width,
                               &mass,
                               &density,
                               &offset,
                               &offset_z,
                               &bed_friction,
                               &bed_normal_stiffness,
                               &bed_tangential_stiffness,
                               &bed_area_stiffness,
                               &bed_area_tangential_stiffness,
                               &own_inner_ratio,
                               &bed_restitution,
                               &bed_normal_damping,
                               &bed_tangential_damping},
                              {.absent = "no capital"});
inline const NumberKey gravity("gravity_m_s2", &StructureSpec::gravity_m_s2, gravity_range, "acceleration of gravity");

// of a colonnade

inline const KeyFacts of_colonnade{.used = {where("structure.kind", structure_kind_names, {StructureKind::colonnade})}};
inline KeyFacts colonnade_facts(const char* absent, std::optional<std::string> example = {})
{
    return {.absent = absent,
            .used = {where("structure.kind", structure_kind_names, {StructureKind::colonnade})},
            .example = std::move(example)};
}

inline const WholeKey columns("columns", {2, most_columns, "Or give column_list = [ { x_m = ... }, ... ]."},
                              "number of equal columns, about x = 0",
                              colonnade_facts("the columns of column_list", "2"));
inline const NumberKey column_spacing("column_spacing_m", spacing_range, "distance between the axes of columns",
                                      colonnade_facts("each of column_list has its place", "3.0"));
inline const NumberKey x("x_m", &ColumnSpec::x_m, position_range, "place of the column's axis",
                         {.needed = true, .example = "0.0"});
inline const NumberKey z("z_m", &ColumnSpec::z_m, position_range, "the same along z", {.models = in_space()});
inline const TableKey
    column_list("column_list",
                "the columns one by one from the left, in space in any order; values that are omitted "
                "are those of all columns",
                {&x, &z, &blocks, &fixed_blocks, &drums, &shape, &drum_width, &drum_depth, &drum_height, &drum_mass,
                 &density_of_all, &top_width, &inner_ratio, &capital},
                colonnade_facts("equal columns"), KeyType::tables);
inline const WholeKey first_column("first_column", &EpistyleSpec::first_column,
                                   {0, most_columns - 1, "Columns are counted from 0, from the left."},
                                   "the leftmost column on which the piece lies, counted from 0", {.needed = true});
inline const WholeKey last_column("last_column", &EpistyleSpec::last_column,
                                  {0, most_columns - 1, "Columns are counted from 0, from the left."},
                                  "the rightmost column on which the piece lies", {.needed = true});
inline const NumberKey epistyle_x("x_m", &EpistyleSpec::x_m, position_range, "place of its centre",
                                  {.absent = "between its columns"});
inline const NumberKey epistyle_z("z_m", &EpistyleSpec::z_m, position_range, "place of its centre along z",
                                  {.absent = "between its columns", .models = in_space()});
inline const WordKey<Along> along("along", &EpistyleSpec::along, along_names, "the axis along which it reaches",
                                  {.absent = "x, or z where its columns are further apart along z",
                                   .models = in_space()});
inline const NumberKey own_epistyle_width("width_m", &EpistyleSpec::width_m, length_range,
                                          "width of the piece, across its length",
                                          {.absent = "epistyle_width_m", .models = in_space()});
inline const WholeKey abreast("abreast", 1,
                              {1, 8, "Equal pieces that lie side by side, as an architrave of two beams."},
                              "so many equal pieces lie side by side across the length, each of this width and mass; "
                              "together they are centred",
                              {.models = in_space()});
inline const NumberKey length("length_m", &EpistyleSpec::length_m, length_range, "length along the colonnade",
                              {.absent = "epistyle_length_m"});
inline const NumberKey own_epistyle_height("height_m", &EpistyleSpec::height_m, length_range, "height of the piece",
                                           {.absent = "epistyle_height_m"});
inline const NumberKey seat_friction("friction", &BedSpec::friction, friction_range,
                                     "coefficient of friction of its seats", {.absent = "contact.friction"});
inline const TableKey epistyles("epistyles", "the epistyles one by one from the left; [] for none",
                                {&first_column, &last_column, &epistyle_x, &epistyle_z, &along, &abreast, &length,
                                 &own_epistyle_width, &own_epistyle_height, &mass, &density, &seat_friction,
                                 &bed_normal_stiffness, &bed_tangential_stiffness, &bed_area_stiffness,
                                 &bed_area_tangential_stiffness, &bed_restitution, &bed_normal_damping,
                                 &bed_tangential_damping},
                                colonnade_facts("equal pieces over all columns"), KeyType::tables);
inline const WholeKey epistyle_bays("epistyle_bays", 1, {1, most_columns - 1, "Bays that one piece spans, or \"all\"."},
                                    "number of bays that each piece spans",
                                    {.used = of_colonnade.used, .words = {"all"}});
inline const NumberKey
    epistyle_length("epistyle_length_m", length_range, "length of each piece, centred on its bays",
                    colonnade_facts("the pieces meet over the axes of the columns and end flush with the outer faces"));
inline const NumberKey epistyle_height("epistyle_height_m", length_range, "height of the epistyles",
                                       colonnade_facts("the pieces are in `epistyles`", "0.8"));
inline const NumberKey epistyle_width(
    "epistyle_width_m", length_range, "width of the epistyles, across their length",
    {.absent = "each of `epistyles` has its own", .used = of_colonnade.used, .example = "1.0", .models = in_space()});
inline const WholeKey epistyle_abreast("epistyle_abreast", 1, {1, 8, abreast.hint},
                                       "so many equal pieces lie side by side over each bay, each of epistyle_width_m",
                                       {.used = of_colonnade.used, .models = in_space()});
inline const NumberKey epistyle_mass("epistyle_mass_kg", mass_range, "mass of each piece",
                                     colonnade_facts("from the density"));
inline const NumberKey epistyle_density("epistyle_density_kg_m3", density_range, "density of the epistyles",
                                        colonnade_facts("density_kg_m3"));

inline const WordKey<StructureKind> kind("kind", &StructureSpec::kind, structure_kind_names,
                                         "one column, or a colonnade: columns with or without epistyles");
inline const WholeKey dimensions("dimensions", &StructureSpec::dimensions,
                                 {2, 3, "2: in the plane, blocks are rectangles; 3: in space."},
                                 "2: a structure in the plane; 3: in space, with round or square drums");
inline const TableKey
    table("structure", "the columns and epistyles",
          {&dimensions,      &kind,          &blocks,          &fixed_blocks,    &drums,          &shape,
           &drum_width,      &drum_depth,    &drum_height,     &top_width,       &depth,          &drum_mass,
           &density_of_all,  &inner_ratio,   &capital,         &gravity,         &columns,        &column_spacing,
           &column_list,     &epistyles,     &epistyle_bays,   &epistyle_length, &epistyle_width, &epistyle_abreast,
           &epistyle_height, &epistyle_mass, &epistyle_density});

} // namespace structure_keys

} // namespace stylobate
