#pragma once
/// How often a monument reaches each limit state, and how likely that is over years: a fragility study over a hazard.

#include "ensemble/estimators/risk/frequency_estimate.hpp"
#include "ensemble/estimators/risk/hazard.hpp"
#include "studies/decisions/risk/sequence_risk.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct RiskOptions {
    std::vector<double> years = {50, 100};
    double level = 0.9;
    std::string state; ///< one limit state alone; empty: all
    /// A larger share of the frequency from outside of the range of the runs, or of the hazard's points, gives no
    /// estimate but bounds.
    double most_outside = 0.25;
};

/// The fragility that a frequency is of, for pictures.
struct FragilityPoint {
    double intensity = 0, probability = 0, lower = 0, upper = 1; ///< limits at the study's level
};

/// One limit state by one form of its fragility.
struct StateRisk {
    std::string state, meaning;
    FragilityForm form = FragilityForm::lognormal;
    bool chosen = true;     ///< the form that is reported of this state
    bool determined = true; ///< otherwise too much comes from outside: only the bounds hold
    std::string note;       ///< why it is chosen, or why it is not determined
    FrequencyEstimate estimate;
    std::vector<FragilityPoint> fragility;
};

struct Risk {
    std::string fragility_file, title, study_text, code_version;
    HazardModel hazard;
    double level = 0.9, fragility_level = 0.95, most_outside = 0.25;
    std::vector<double> years;
    std::vector<StateRisk> states; ///< of each state the chosen form first
    std::vector<std::string> says; ///< what a reader must know of the whole
    std::optional<SequenceRisk> sequences;

    /// The chosen forms, one for each limit state.
    std::vector<const StateRisk*> chosen() const;
    /// The collapse where it is there, else the last limit state.
    const StateRisk& principal() const;
};

/// Why too much of a frequency comes from outside of the range of the runs, or of the hazard's points; empty: it is
/// determined.
std::string why_undetermined(const FrequencyEstimate& estimate, double most_outside);

/// @throws InputError for a limit state that is asked for and is not among these   @param of "the study"
void check_state(const std::string& state, const std::vector<std::string>& names, const std::string& of);

/// What a reader must know of a hazard, in sentences.
std::vector<std::string> hazard_notes(const HazardModel& hazard);

/// Of each limit state both forms where the data bear them. The lognormal curve is chosen where it fits (lack of fit, p
/// of at least 0.05) or where there are no stripes, else the shares. The interval of a chosen curve contains that of
/// the shares.
/// @throws InputError for an unknown limit state, and where no limit state has an estimate
Risk risk_of(const Fragility& fragility, const HazardModel& hazard, const RiskOptions& options);

} // namespace stylobate
