#pragma once
/// Which realization of a result is meant: by its index, or by where it stands and how it ended.

#include "studies/results/results.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace stylobate {

/// The selection of a realization; empty members are not given.
struct RealizationChoice {
    std::optional<long long> index; ///< alone
    CellChoice cells;
    bool fallen = false;          ///< one that collapsed
    bool stood = false;           ///< a valid one that did not
    std::optional<long long> nth; ///< of those, in the order of their indices, from 1
};

struct ChosenRealization {
    std::uint64_t index = 0;
    std::string words; ///< "number 2 of the 143 that fell, of 256 at 3.02 Hz, 9.8 m/s2"; empty if the index was given
};

/// @throws InputError if nothing is selected, if the selection contradicts itself, lies outside an axis, or if there is
/// no such
///         realization
ChosenRealization choose_realization(const Results& results, const RealizationChoice& choice);

} // namespace stylobate
