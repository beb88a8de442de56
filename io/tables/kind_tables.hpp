#pragma once
/// What studies of fragility, of rare events and of sensitivity found, as plain data: /fragility, /rare and
/// /sensitivity of a results file.

#include "io/tables/table.hpp"

#include <cstddef>
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

/// As /fragility.
Table to_table(const FragilityTable& fragility);
/// From /fragility as it was read; empty if there is none. @throws InputError if it is not as it was written
FragilityTable fragility_table(const Table& table);

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

/// As /rare.
Table to_table(const RareTable& rare);
/// From /rare as it was read; empty if there is none. @throws InputError if it is not as it was written
RareTable rare_table(const Table& table);

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

/// As /sensitivity. @throws std::invalid_argument if its arrays do not fit its names
Table to_table(const SensitivityTable& sensitivity);
/// From /sensitivity as it was read; empty if there is none. @throws InputError if it is not as it was written
SensitivityTable sensitivity_table(const Table& table);
/// A line for each outcome, index and factor, with value, lower and upper; "mean" and "explained" have no factor.
Table listed(const SensitivityTable& sensitivity);

} // namespace stylobate
