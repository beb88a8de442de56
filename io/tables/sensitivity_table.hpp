#pragma once
/// What a sensitivity study found, as plain data: /sensitivity of a results file.

#include "io/tables/table.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

struct SensitivityTable {
    /// The indices reported for every factor: "first", "total", or "mu_star".
    struct Index {
        std::string name;
        IntervalArray of; ///< (outcomes x factors)
    };

    std::string method;                ///< the word of the study file
    std::string interval;              ///< name of the intervals and their level: "bootstrap 0.95"
    std::vector<std::string> outcomes; ///< "collapse", ...
    std::vector<std::string> units;    ///< of each outcome
    std::vector<std::string> meanings; ///< of each outcome, how it was counted
    std::vector<std::string> factors;  ///< and last `rest_name` where something else is drawn
    std::vector<std::uint64_t> acts;   ///< (factors) 1 if it ever changed any number of an outcome, else 0
    std::uint64_t rows = 0;            ///< of the design, that were used
    std::uint64_t invalid_rows = 0;    ///< left out: a realization in them is invalid
    std::uint64_t inner = 1;
    IntervalArray mean;      ///< (outcomes)
    IntervalArray explained; ///< (outcomes) share of the variance of the outcome that the factors explain; or empty
    std::vector<Index> indices;

    bool empty() const { return outcomes.empty(); }
    const Index* find(const std::string& name) const
    {
        for (const Index& index : indices)
            if (index.name == name)
                return &index;
        return nullptr;
    }
};

inline constexpr char rest_name[] = "the rest";

/// /sensitivity. @throws std::invalid_argument if its arrays do not fit its names
Table to_table(const SensitivityTable& sensitivity);
/// From /sensitivity as it was read; empty if there is none. @throws InputError if it is not as it was written
SensitivityTable sensitivity_table(const Table& table);
/// A line for each outcome, index and factor, with value, lower and upper; "mean" and "explained" have no factor.
Table listed(const SensitivityTable& sensitivity);

} // namespace stylobate
