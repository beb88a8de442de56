#pragma once
/// A measured specimen as a structure that can be simulated, and which of its blocks and joints are which.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/structure.hpp"

#include <vector>

namespace stylobate {

struct SpecimenStructure {
    StructureSpec structure;
    std::vector<int> block; ///< (n_block) of each measured block its place in `lay_out(structure).blocks`
    std::vector<int> bed;   ///< (n_joint) of each measured joint its place in `lay_out(structure).beds`
    double origin_x_m = 0;  ///< measured x at rest = x of the layout + this
    double origin_y_m = 0;  ///< measured y at rest = y of the layout + this
};

/// Columns are what stands one on the other from the base, a block on two or more columns is an epistyle. A base block
/// becomes a fixed drum under each column, unless it reaches under all of several columns: then it is the ground.
/// Contact values are those of the study: nominal friction is not put in.
///
/// @throws InputError, naming blocks and joints, where sizes, masses or joints are absent, where blocks have several
///         depths, and for what columns and epistyles cannot be (two drums on one, a drum on an epistyle, a block
///         that stands on nothing); and what `lay_out` refuses
SpecimenStructure build_specimen(const Specimen& specimen);

/// Only the structure.
StructureSpec structure_of(const Specimen& specimen);

} // namespace stylobate
