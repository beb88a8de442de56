#pragma once
/// What a study of rare events found, as plain data: /rare of a results file.

#include "io/tables/table.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

struct RareTable {
    double probability = 0; ///< of collapse; NaN, all three, where no repeat came to one
    double lower = 0;
    double upper = 0;
    std::string interval;            ///< "repeats 0.95"
    std::uint64_t realizations = 0;  ///< in all, those of the pilot counted
    double plain_realizations = 0;   ///< that plain sampling would take for the same error; NaN if not known
    std::vector<double> repeats;     ///< (repeats) each one's probability
    std::size_t levels = 0;          ///< of the repeat that has most
    std::vector<double> threshold_m; ///< (repeats x levels) peak displacement of the top; NaN where there is no level.
                                     ///< The pilot's, and so the same in all repeats that come so far
    std::vector<double> share;       ///< (repeats x levels) above the next threshold, or collapsed
    std::vector<double> acceptance;  ///< (repeats x levels) of the chains' candidates
    std::vector<double> stuck;       ///< (repeats x levels) share of the chains that never moved

    bool empty() const { return repeats.empty(); }
};

/// /rare.
Table to_table(const RareTable& rare);
/// From /rare as it was read; empty if there is none. @throws InputError if it is not as it was written
RareTable rare_table(const Table& table);

} // namespace stylobate
