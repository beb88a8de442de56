#pragma once
/// Results of a fragility study: curves of all its limit states with their intervals, tests of their form, and
/// where the scatter comes from.

#include "ensemble/estimators/fragility/dispersion_shares.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/measure_ranking.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/kind_tables.hpp"
#include "studies/kinds/fragility/damage.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct StateFragility {
    DamageState state;
    FragilityCurve curve; ///< lognormal in the study's measure, at `Fragility::grid`
    LackOfFit fit;
    std::optional<StripeShares> stripes; ///< of a study by stripes
    std::optional<DispersionShares> shares;
    FragilityData data;       ///< that all of these are of, in the study's measure
    std::uint64_t moving = 0; ///< valid realizations of which it is not known: they stand, and still moved at the end
    /// Structures under a motion that reached the state at some intensity, and not at a stronger one, of all that ever
    /// did.
    std::uint64_t resurrected = 0, reached_ever = 0;
};

/// What the damage that is carried along does, beside structures that are as new in every shaking.
struct SequenceShare {
    int shaking = 0;   ///< counted from 1
    double fallen = 0; ///< share that has fallen by its end, mean of the stripes
    double fresh = 0;  ///< 1 - (1 - p)^k, p the share of the first shaking, stripe by stripe
    Limits beyond;     ///< of fallen - fresh, by the motions
};

struct Fragility {
    std::string measure; ///< "pgv_m_s"
    FragilityMethod method = FragilityMethod::stripes;
    std::size_t motions = 0, structures = 0; ///< structures under each motion
    std::size_t different = 0;               ///< ground motions, equal ones counted once
    std::uint64_t valid = 0, invalid = 0;
    std::vector<std::int32_t> motion; ///< (rows) of each realization
    std::vector<double> intensity;    ///< (rows) by the measure
    std::vector<double> grid;         ///< intensities at which curves are given
    std::vector<StateFragility> states;
    std::vector<RankedMeasure> measures; ///< of the collapse, the most efficient first
    std::vector<SequenceShare> sequence; ///< of a study of sequences, by stripes
    std::vector<std::string> says;       ///< what a reader must know of the whole
};

/// What is needed of a row.
struct FragilityOutcome {
    std::uint64_t index = 0, cell = 0;
    double pga_m_s2 = 0;
    Outcome outcome;
};

/// @param study, header of the results, for the motions and the design   @param rows of all realizations, in any order
Fragility fragility_of(const Study& study, const ResultHeader& header, std::vector<FragilityOutcome> rows);

/// What the file keeps of it.
FragilityTable stored(const Fragility& fragility);

/// The measure of its curves, "pgv_m_s"; of a cloud the PGA.
std::string measure_of(const MotionSetSpec& spec);
/// So many structures under each motion, each with its own imperfections and contacts.
Study with_structures(Study study, std::uint64_t structures);

/// "peak ground velocity [m/s]" of "pgv_m_s".
std::string describe_measure(const std::string& name);
/// "PGV" of "pgv_m_s", "Sa(1 s)" of "sa_1s_m_s2"; and "m/s".
std::string short_measure(const std::string& name);
std::string measure_unit(const std::string& name);

} // namespace stylobate
