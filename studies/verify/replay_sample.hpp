#pragma once
/// Which realizations of a results file are run again.

#include "io/store/result_store.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// A number that orders indices by chance: the same for the same seed, whatever else is chosen from.
std::uint64_t sample_key(std::uint64_t seed, std::uint64_t index);

/// At most `most` realizations whose rows are in the file, ascending, spread evenly over the cells.
std::vector<std::uint64_t> replay_sample(const ResultReader& reader, std::uint64_t most, std::uint64_t seed);

} // namespace stylobate
