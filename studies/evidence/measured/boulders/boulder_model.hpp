#pragma once
/// A boulder as a planar rigid rectangle on the shaking table: what a test does to it, by the engine.

#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/evidence/measured/boulders/boulder_data.hpp"
#include "studies/evidence/measured/parts/fall_table.hpp"

#include <array>
#include <string>
#include <vector>

namespace stylobate::measured {

/// The rectangle: its mass is the boulder's; its slenderness and height are effective ones.
struct BoulderModel {
    double slenderness = 0.2;           ///< width over height, tan alpha
    double height_m = 0.5;              ///< of the rectangle, twice that of its centre
    double normal_stiffness_n_m2 = 1e9; ///< K_N
    double damping_ratio = 0.1;         ///< of both dashpots
    bool ends = false;                  ///< whether the normal dashpot acts at the ends of the contact (face damping)
    double eccentricity_m = 0;          ///< of the centre of mass: the block falls more easily to one side
    double slenderness_spread = 0;      ///< of a study's ensemble: sigma of ln(width)

    /// Of the equal rigid block, p = sqrt(3 g / (4 R)) [rad/s].
    double rocking_rate_rad_s() const;
};

inline constexpr double boulder_mass_kg = 353.8;
inline constexpr double boulder_depth_m = 0.6;
inline constexpr double boulder_friction = 0.7;

/// The study of such a block, as `stylobate run` takes it; its record is to be given.
/// @param realizations 1 without a spread
Study boulder_study(const BoulderModel& model, std::uint64_t realizations = 1);

/// How the realizations of a study end in a test; none in one whose motion is too weak to move anything.
/// @throws InputError if all are invalid
Ends ensemble_ends(const Study& study, const Motion& motion, const RunOptions& run);

/// What the block keeps of its rocking speed at an impact: from free rocking, released at half of alpha, by the energy
/// of the highest point after the impact (still base; compliance of the bed included).
double restitution(const BoulderModel& model);

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

/// The most likely table, slendernesses, spread and slip.
/// @param use which of the tests are fitted on   @param spreads that are tried
BoulderFit best_fit(const std::vector<BoulderTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads);

} // namespace stylobate::measured
