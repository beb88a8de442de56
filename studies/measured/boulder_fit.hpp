#pragma once
/// Fits the planar block to the outcomes of tests: by likelihood, from a table of simulated falls.

#include "studies/measured/boulder_model.hpp"

#include <array>
#include <vector>

namespace stylobate::measured {

/// Slendernesses that are tried: in equal ratios.
std::vector<double> slenderness_grid();

/// One choice of all but the slenderness, and what it does to every test.
struct FallTable {
    BoulderModel variant;                 ///< its slenderness is of no meaning
    std::vector<double> slenderness;      ///< (slendernesses)
    std::vector<std::vector<char>> falls; ///< (tests x slendernesses)

    /// Share that falls of blocks whose slenderness is spread lognormally.
    /// @param median index into `slenderness`   @param spread sigma of the logarithm; 0: that one alone
    double share(std::size_t test, std::size_t median, double spread) const;
};

/// Simulates every test with every slenderness; on several threads.
FallTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run);

/// A fitted model of both boulders: they share all but the slenderness.
struct BoulderFit {
    std::array<BoulderModel, boulders> model;
    double slip = 0.05;        ///< share of tests that end as they like: P = slip / 2 + (1 - slip) share
    double log_likelihood = 0; ///< of the tests that were fitted on [nat]
    double probability(double share) const { return slip / 2 + (1 - slip) * share; }
};

/// The most likely slendernesses, spread and slip for one table.
/// @param use which of the tests are fitted on   @param spreads that are tried
BoulderFit fit(const FallTable& table, const std::vector<BoulderTest>& tests, const std::vector<bool>& use,
               const std::vector<double>& spreads);

/// Most likely of several tables.
BoulderFit best_fit(const std::vector<FallTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads);

} // namespace stylobate::measured
