#pragma once
/// Where the blocks of a structure in space stand: the part of `lay_out` that needs the plan.

#include "ensemble/model/plan_face.hpp"
#include "ensemble/model/structure.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Part of a size below which a distance is rounding: sums of lengths as people write them, never a gap or a step.
inline constexpr double layout_rounding = 1e-9;

/// "12 mm", "1.5 m": distances of a message.
std::string distance_words(double metres);

/// The faces of a placed block in plan.
PlanFace bottom_face(const PlacedBlock& block);
PlanFace top_face(const PlacedBlock& block);

/// The bed between two blocks, or a block and the ground, in plan.
struct BedInPlan {
    PlanFace common;    ///< rectangle that both faces have in common
    double area_m2 = 0; ///< that bears: of the smaller face of two drums, of a seat what both faces have in common; the
                        ///< hole of a hollow bed is not in it
};
BedInPlan bed_in_plan(const Layout& layout, const PlacedBed& bed);

/// What stands on each bed of a column rests on it.
/// @param tops index of the topmost block of each column
/// @throws InputError as `lay_out`
void check_columns_in_space(const Layout& layout, const std::vector<int>& tops);

/// Lays the epistyles on their columns.
/// @throws InputError as `lay_out`
void place_epistyles_in_space(const StructureSpec& structure, const std::vector<int>& tops, Layout& layout);

/// No two blocks in one place; neighbours that just touch are fine.
/// @throws InputError as `lay_out`
void check_overlaps_in_space(const std::vector<PlacedBlock>& blocks);

} // namespace stylobate
