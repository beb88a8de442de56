#pragma once
/// Which realization of a result is meant: by its index, or by where it stands and how it ended.

#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace stylobate {

/// What is asked for; what is empty is not said.
struct RealizationChoice {
    std::optional<long long> index;               ///< alone
    std::optional<double> frequency_hz, pga_m_s2; ///< of a surface: the nearest of its axis
    std::string motion;                           ///< of a fragility study: its name, or its number from 0
    std::optional<double> intensity;              ///< of a fragility study in stripes: the nearest level
    bool fallen = false;                          ///< one that collapsed
    bool stood = false;                           ///< a valid one that did not
    std::optional<long long> nth;                 ///< of those, in the order of their indices, from 1
};

struct ChosenRealization {
    std::uint64_t index = 0;
    std::string words; ///< "number 2 of the 143 that fell, of 256 at 3.02 Hz, 9.8 m/s2"; empty if the index was given
};

/// @param study of the results   @param results for the messages
/// @throws InputError if nothing is asked for, if it contradicts itself, lies outside an axis, or if there is no such
///         realization
ChosenRealization choose_realization(const ResultReader& reader, const Study& study, const std::string& results,
                                     const RealizationChoice& choice);

} // namespace stylobate
