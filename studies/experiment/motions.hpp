#pragma once
/// The ground motions of a fragility study: read from their files or drawn from the seed, and measured.

#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

namespace stylobate {

/// @throws InputError naming the file where a record cannot be used, and where a study without records draws the same
///         motion again and again
MotionSet load_motions(const Study& study);

/// What results keep of them.
MotionTable motion_table(const MotionSet& set);

} // namespace stylobate
