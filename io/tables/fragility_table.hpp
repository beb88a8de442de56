#pragma once
/// What a fragility study found, as plain data: /fragility of a results file.

#include "io/tables/table.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

struct FragilityTable {
    std::string measure;                ///< of the intensities, its unit in its name: "pgv_m_s"
    std::vector<std::int32_t> motion;   ///< (rows) number of each realization's motion in /motions
    std::vector<double> intensity;      ///< (rows)
    std::vector<std::string> states;    ///< names of the limit states
    std::vector<std::string> meanings;  ///< of each, when it is reached
    std::vector<std::uint64_t> trials;  ///< (states) valid realizations
    std::vector<std::uint64_t> reached; ///< (states) of them
    IntervalArray median, dispersion;   ///< (states) of the lognormal curve; NaN where there is none
    std::vector<double> grid;           ///< (points) intensities of the curves
    IntervalArray curve;                ///< (states x points) probability; NaN without a curve, limits as far as known
    std::vector<double> stripe;         ///< (stripes) intensities; empty of a cloud
    IntervalArray share;                ///< (states x stripes) share that reached the state

    bool empty() const { return motion.empty(); }
};

/// /fragility.
Table to_table(const FragilityTable& fragility);
/// From /fragility as it was read; empty if there is none. @throws InputError if it is not as it was written
FragilityTable fragility_table(const Table& table);

} // namespace stylobate
