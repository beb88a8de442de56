#pragma once
/// Whether two studies can be compared pair by pair, and what differs between them.

#include "io/store/result_store.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Refuses what makes pairs meaningless: another kind, seed, number of realizations, sampling, shaking, axes, motions,
/// gravity, or another definition of the outcomes.
/// @param base, variant headers of their results   @param base_name, variant_name for messages
/// @throws InputError naming the key and both values
void check_comparable(const ResultHeader& base, const std::string& base_name, const ResultHeader& variant,
                      const std::string& variant_name);

/// Refuses a study that no comparison can use: its realizations have no rows, or are chosen by its own outcomes.
/// @throws InputError
void check_can_be_compared(const ResultHeader& header, const std::string& name);

/// What differs and is not refused, and yet no intervention or no common draw, in sentences: numerics, and the number
/// of blocks.
std::vector<std::string> differences_to_know(const ResultHeader& base, const ResultHeader& variant);

} // namespace stylobate
