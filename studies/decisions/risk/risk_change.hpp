#pragma once
/// What interventions change of how often a monument reaches each limit state: a comparison of fragility studies over a
/// hazard.

#include "ensemble/estimators/risk/frequency_change.hpp"
#include "ensemble/estimators/risk/hazard.hpp"
#include "studies/decisions/risk/risk.hpp"

#include <string>
#include <vector>

namespace stylobate {

struct Comparison;

/// One limit state of one variant. Frequencies are by the shares of the stripes, in both structures.
struct StateChange {
    std::string state, meaning;
    bool damage = true;     ///< whether more of it is worse
    bool determined = true; ///< otherwise too much comes from outside of the intensities of the study or the hazard
    std::string note;       ///< why it is not determined, and what else must be known
    FrequencyChange change; ///< of a file that was read: without the parts of base and variant
    std::vector<double> base_share, variant_share; ///< (stripes)

    /// "lower", "higher", "undecided" or "not determined", by the limits of the change of the frequency.
    const char* verdict() const;
};

struct VariantChange {
    std::string name, results;
    std::vector<StateChange> states;

    /// The collapse where it is there, else the last limit state.
    const StateChange& principal() const;
};

struct RiskChange {
    std::string comparison_file, title, base_name, code_version;
    HazardModel hazard;
    double level = 0.9, most_outside = 0.25;
    std::vector<double> years, intensity; ///< intensities of the stripes
    std::uint64_t motions = 0;
    std::vector<VariantChange> variants;
    std::vector<std::string> says;
};

/// @throws InputError if the comparison is not of fragility studies with two stripes or more, has no pairs of motions
///         (files of earlier versions), lacks the limit state that is asked for, or determines no change at all
RiskChange risk_change_of(const Comparison& comparison, const std::string& file, const HazardModel& hazard,
                          const RiskOptions& options);

/// Refuses what has no risk, before a hazard is read. @throws InputError
void check_has_risk(const Comparison& comparison, const std::string& file);

} // namespace stylobate
