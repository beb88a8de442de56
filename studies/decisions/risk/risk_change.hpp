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

struct RiskChange : RiskFacts {
    std::string comparison_file, base_name;
    std::vector<double> intensity; ///< of the stripes
    std::uint64_t motions = 0;
    std::vector<VariantChange> variants;
};

/// @throws InputError if the comparison is not of fragility studies with two stripes or more, has no pairs of motions
///         (files of earlier versions), lacks the limit state that is asked for, or determines no change at all
RiskChange risk_change_of(const Comparison& comparison, const std::string& file, const HazardModel& hazard,
                          const RiskOptions& options);

/// Refuses what has no risk, before a hazard is read. @throws InputError
void check_has_risk(const Comparison& comparison, const std::string& file);

// ---- fields, in the file, in JSON and in tables ---------------------------------------------------------------------

template <class F>
void visit_fields(std::type_identity<StateChange>, F&& f)
{
    f("state", &StateChange::state);
    f("meaning", &StateChange::meaning);
    f("damage", &StateChange::damage);
    f("determined", &StateChange::determined);
    f("verdict", [](const StateChange& s) { return s.verdict(); });
    f(
        "base_annual_frequency", [](auto& s) -> auto& { return s.change.base.frequency; }, per_year);
    f(
        "variant_annual_frequency", [](auto& s) -> auto& { return s.change.variant.frequency; }, per_year);
    f(
        "change", [](auto& s) -> auto& { return s.change.frequency; }, per_year);
    f(
        "ratio", [](auto& s) -> auto& { return s.change.ratio; });
    f(
        "base_unseen_annual_frequency", [](auto& s) -> auto& { return s.change.base.unseen; }, per_year);
    f(
        "variant_unseen_annual_frequency", [](auto& s) -> auto& { return s.change.variant.unseen; }, per_year);
    f("note", &StateChange::note);
}

template <class F>
void visit_fields(std::type_identity<VariantChange>, F&& f)
{
    f("variants", &VariantChange::name);
    f("variant_results", &VariantChange::results);
}

template <class F>
void visit_fields(std::type_identity<RiskChange>, F&& f)
{
    visit_fields(std::type_identity<RiskFacts>(), f);
    f("comparison_file", &RiskChange::comparison_file);
    f("base", &RiskChange::base_name);
    f("motions", &RiskChange::motions);
    f("intensity", &RiskChange::intensity);
}

} // namespace stylobate
