#pragma once
/// What a sensitivity study found, as plain data: /sensitivity of a results file.

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

/// Values with their intervals, row by row; NaN, all three, where the data do not determine one.
struct IntervalArray {
    std::vector<double> value, lower, upper;

    void add(double v, double low, double high)
    {
        value.push_back(v);
        lower.push_back(low);
        upper.push_back(high);
    }
};

struct SensitivityTable {
    /// What is told of every factor: "first", "total", or "mu_star".
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

} // namespace stylobate
