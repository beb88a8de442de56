#pragma once
/// How often a monument reaches each limit state, and how likely that is over years: a fragility study over a hazard.

#include "ensemble/estimators/risk/frequency_estimate.hpp"
#include "ensemble/estimators/risk/hazard.hpp"
#include "io/tables/rows.hpp"
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

/// What the estimates of one structure and of a comparison have in common.
struct RiskFacts {
    std::string title, code_version;
    HazardModel hazard;
    double level = 0.9, most_outside = 0.25;
    std::vector<double> years;
    std::vector<std::string> says; ///< what a reader must know of the whole
};

struct Risk : RiskFacts {
    std::string fragility_file, study_text;
    double fragility_level = 0.95;
    std::vector<StateRisk> states; ///< of each state the chosen form first
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

/// Those of an estimate over this hazard, with what a reader must know of the hazard; without a title.
RiskFacts facts_of(const HazardModel& hazard, const RiskOptions& options);

/// Of each limit state both forms where the data bear them. The lognormal curve is chosen where it fits (lack of fit, p
/// of at least 0.05) or where there are no stripes, else the shares. The interval of a chosen curve contains that of
/// the shares.
/// @throws InputError for an unknown limit state, and where no limit state has an estimate
Risk risk_of(const Fragility& fragility, const HazardModel& hazard, const RiskOptions& options);

// ---- fields, in the file, in JSON and in tables ---------------------------------------------------------------------

template <>
struct FieldWords<FragilityForm> {
    static constexpr const char* words[] = {"lognormal", "shares"};
    static constexpr WordsAs as = WordsAs::texts;
};

inline constexpr FieldFacts per_year{.unit = "1/year"};

template <class F>
void visit_fields(std::type_identity<FragilityPoint>, F&& f)
{
    f("intensity", &FragilityPoint::intensity);
    f("probability", &FragilityPoint::probability);
    f("probability_lower", &FragilityPoint::lower);
    f("probability_upper", &FragilityPoint::upper);
}

template <class F>
void visit_fields(std::type_identity<FrequencyPart>, F&& f)
{
    f("from", &FrequencyPart::from);
    f("to", &FrequencyPart::to);
    f("annual_frequency", &FrequencyPart::frequency, per_year);
}

template <class F>
void visit_fields(std::type_identity<StateRisk>, F&& f)
{
    f("state", &StateRisk::state);
    f("meaning", &StateRisk::meaning);
    f("form", &StateRisk::form);
    f("chosen", &StateRisk::chosen);
    f("determined", &StateRisk::determined);
    f(
        "annual_frequency", [](auto& s) -> auto& { return s.estimate.frequency; }, per_year);
    f(
        "mean_hazard_annual_frequency", [](auto& s) -> auto& { return s.estimate.by_mean_hazard; }, per_year);
    f(
        "share_below", [](auto& s) -> auto& { return s.estimate.below; });
    f(
        "share_above", [](auto& s) -> auto& { return s.estimate.above; });
    f(
        "share_beyond_hazard", [](auto& s) -> auto& { return s.estimate.beyond_hazard; });
    f(
        "lowest_annual_frequency", [](auto& s) -> auto& { return s.estimate.bounds.lower; }, per_year);
    f(
        "highest_annual_frequency", [](auto& s) -> auto& { return s.estimate.bounds.upper; }, per_year);
    f(
        "unseen_annual_frequency", [](auto& s) -> auto& { return s.estimate.unseen; }, per_year);
    f("note", &StateRisk::note);
}

template <class F>
void visit_fields(std::type_identity<RiskFacts>, F&& f)
{
    f("title", &RiskFacts::title);
    f("code_version", &RiskFacts::code_version);
    f("level", &RiskFacts::level);
    f("most_outside", &RiskFacts::most_outside);
    f("years", &RiskFacts::years, {.unit = "year"});
    f("notes", &RiskFacts::says);
}

template <class F>
void visit_fields(std::type_identity<Risk>, F&& f)
{
    visit_fields(std::type_identity<RiskFacts>(), f);
    f("fragility_file", &Risk::fragility_file);
    f("study_toml", &Risk::study_text);
    f("fragility_level", &Risk::fragility_level);
}

} // namespace stylobate
