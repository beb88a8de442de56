#pragma once
/// The order in which blocks fall, counted from the rows of a result.

#include "io/plots/plot_order.hpp"
#include "io/store/result_store.hpp"
#include "studies/experiment/motions.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace stylobate {

/// Which blocks fell, in which order and when, for its picture.
/// @param names of the blocks, as many as each row has fall times
FallOrder fall_order(const std::vector<std::string>& names, const std::vector<ResultRow>& rows,
                     const MotionGroups& motions = {});

} // namespace stylobate
