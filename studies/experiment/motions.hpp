#pragma once
/// The set of ground motions of a study: read from their files or drawn from the seed, and measured.

#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

/// @throws InputError naming the file where a record cannot be used, and where a study without records draws the same
///         motion again and again
MotionSet load_motions(const Study& study);

/// What results keep of them.
MotionTable motion_table(const MotionSet& set);

/// The motions of a set by ground motion. Runs under equal motions are not independent, and count as runs
/// under one.
struct MotionGroups {
    std::size_t cells = 0;               ///< of one motion: its stripes; 0: the study has no motions
    std::size_t groups = 0;              ///< different ground motions
    std::vector<std::size_t> group = {}; ///< (motions) the ground motion of each, numbered in their order

    std::size_t of_cell(std::size_t cell) const { return group.at(cell / cells); }
};

/// Motions are the same where all of their measures are, over powers of the PGA: neither a factor nor a unit nor the
/// name of its file makes a motion another one. A motion and its mirror image count as the same.
/// @param motions of the study's results; empty: all are different
MotionGroups motion_groups(const Study& study, const MotionTable& motions);

} // namespace stylobate
