#pragma once
/// Fits the planar block to the outcomes of tests: by likelihood, from tables of simulated falls.

#include "studies/evidence/measured/boulders/boulder_model.hpp"
#include "studies/evidence/measured/parts/fall_table.hpp"

#include <array>
#include <vector>

namespace stylobate::measured {

/// One choice of all but the slenderness, and what it does to every test.
struct BoulderTable {
    BoulderModel variant; ///< its slenderness and spread are of no meaning
    FallTable falls;
};

/// Simulates every test with every slenderness; on several threads.
BoulderTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run);

/// A fitted model of both boulders: they share all but the slenderness.
struct BoulderFit {
    std::array<BoulderModel, boulders> model;
    double slip = 0.05;        ///< share of tests that end as they like: P = slip / 2 + (1 - slip) share
    double log_likelihood = 0; ///< of the tests that were fitted on [nat]
};

/// The most likely slendernesses, spread and slip for one table.
/// @param use which of the tests are fitted on   @param spreads that are tried
BoulderFit fit(const BoulderTable& table, const std::vector<BoulderTest>& tests, const std::vector<bool>& use,
               const std::vector<double>& spreads);

/// Most likely of several tables.
BoulderFit best_fit(const std::vector<BoulderTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads);

} // namespace stylobate::measured
