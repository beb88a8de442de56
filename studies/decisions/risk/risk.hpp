#pragma once
/// How often a monument reaches each limit state, and how likely that is over years: a fragility study over a hazard.

#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/risk/frequency_change.hpp"
#include "ensemble/estimators/risk/frequency_estimate.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/model/fields.hpp"
#include "io/tables/rows.hpp"
#include "io/tables/table.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// A share or a difference with its interval.
struct SequenceNumber {
    double value = 0;
    Limits limits;
};

struct SequenceRisk {
    double years = 0;
    double level = 0.9;
    std::uint64_t histories = 0;
    double threshold = 0; ///< weaker earthquakes are left out
    std::string threshold_says;
    double events_a_year = 0;                  ///< of the hazard above the threshold
    std::uint64_t events = 0, most_events = 0; ///< in all histories; in one
    std::uint64_t with_two = 0;                ///< histories with two earthquakes or more: the others cannot differ
    std::uint64_t carried = 0, fresh = 0, both = 0; ///< histories with a fall
    std::uint64_t invalid = 0;                      ///< histories that are left out of the counts
    std::uint64_t runs = 0, steps = 0;              ///< what it took
    SequenceNumber carried_share, fresh_share;
    SequenceNumber difference;  ///< of the shares, paired
    SequenceNumber ratio;       ///< carried over fresh, paired
    SequenceNumber closed_form; ///< 1 - exp(-lambda years) of the fragility, which meets each earthquake as new
    /// The threshold's check: so many histories once more with weaker earthquakes too, and how many of them fell then
    /// and had not before, or the reverse: a history that differs early may end otherwise by chance.
    std::uint64_t checked = 0, then_fell = 0, then_stood = 0;
    double checked_threshold = 0;
    SequenceNumber check_difference; ///< of the share that has fallen, with weaker earthquakes minus without, paired
};

template <class F>
void visit_fields(std::type_identity<SequenceNumber>, F&& f)
{
    f("value", &SequenceNumber::value);
    f("lower", within(&SequenceNumber::limits, &Limits::lower));
    f("upper", within(&SequenceNumber::limits, &Limits::upper));
}

template <class F>
void visit_fields(std::type_identity<SequenceRisk>, F&& f)
{
    f("years", &SequenceRisk::years);
    f("level", &SequenceRisk::level);
    f("histories", &SequenceRisk::histories);
    f("threshold", &SequenceRisk::threshold);
    f("threshold_says", &SequenceRisk::threshold_says);
    f("events_1_year", &SequenceRisk::events_a_year);
    f("events", &SequenceRisk::events);
    f("most_events", &SequenceRisk::most_events);
    f("histories_with_two_events", &SequenceRisk::with_two);
    f("fallen_carried", &SequenceRisk::carried);
    f("fallen_fresh", &SequenceRisk::fresh);
    f("fallen_both", &SequenceRisk::both);
    f("invalid", &SequenceRisk::invalid);
    f("runs", &SequenceRisk::runs);
    f("steps", &SequenceRisk::steps);
    f("carried_share", &SequenceRisk::carried_share);
    f("fresh_share", &SequenceRisk::fresh_share);
    f("difference", &SequenceRisk::difference);
    f("ratio", &SequenceRisk::ratio);
    f("closed_form", &SequenceRisk::closed_form);
    f("checked", &SequenceRisk::checked);
    f("checked_threshold", &SequenceRisk::checked_threshold);
    f("then_fell", &SequenceRisk::then_fell);
    f("then_stood", &SequenceRisk::then_stood);
    f("check_difference", &SequenceRisk::check_difference);
}

struct RiskOptions {
    std::vector<double> years = {50, 100};
    double level = 0.9;
    std::optional<std::string> state; ///< one limit state alone; nullopt: all
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

/// Why too much of a frequency comes from outside of the range of the runs, or of the hazard's points; nullopt
/// where it is determined.
std::optional<std::string> why_undetermined(const FrequencyEstimate& estimate, double most_outside);

/// @throws InputError for a limit state that is asked for and is not among these   @param of "the study"
void check_state(const std::optional<std::string>& state, const std::vector<std::string>& names, const std::string& of);

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
    f("annual_frequency", within(&StateRisk::estimate, &FrequencyEstimate::frequency), per_year);
    f("mean_hazard_annual_frequency", within(&StateRisk::estimate, &FrequencyEstimate::by_mean_hazard), per_year);
    f("share_below", within(&StateRisk::estimate, &FrequencyEstimate::below));
    f("share_above", within(&StateRisk::estimate, &FrequencyEstimate::above));
    f("share_beyond_hazard", within(&StateRisk::estimate, &FrequencyEstimate::beyond_hazard));
    f("lowest_annual_frequency", within(&StateRisk::estimate, &FrequencyEstimate::bounds, &Limits::lower), per_year);
    f("highest_annual_frequency", within(&StateRisk::estimate, &FrequencyEstimate::bounds, &Limits::upper), per_year);
    f("unseen_annual_frequency", within(&StateRisk::estimate, &FrequencyEstimate::unseen), per_year);
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
    f("base_annual_frequency", within(&StateChange::change, &FrequencyChange::base, &FrequencyEstimate::frequency),
      per_year);
    f("variant_annual_frequency",
      within(&StateChange::change, &FrequencyChange::variant, &FrequencyEstimate::frequency), per_year);
    f("change", within(&StateChange::change, &FrequencyChange::frequency), per_year);
    f("ratio", within(&StateChange::change, &FrequencyChange::ratio));
    f("base_unseen_annual_frequency", within(&StateChange::change, &FrequencyChange::base, &FrequencyEstimate::unseen),
      per_year);
    f("variant_unseen_annual_frequency",
      within(&StateChange::change, &FrequencyChange::variant, &FrequencyEstimate::unseen), per_year);
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

/// Writes a file whole or not at all; equal estimates give equal bytes. @throws InputError if it cannot be written
/// @{
void write_risk(const Risk& risk, const std::filesystem::path& file);
void write_risk(const RiskChange& change, const std::filesystem::path& file);
/// @}

/// @throws InputError if the file is none, of another format version, truncated or damaged
/// @{
Risk read_risk(const std::filesystem::path& file);
RiskChange read_risk_change(const std::filesystem::path& file);
/// @}

/// What a file has between its seal and its end.
/// @{
std::vector<Table> tables_of(const Risk& risk);
std::vector<Table> tables_of(const RiskChange& change);
/// @}
/// @param file for messages   @throws InputError "FILE: is damaged" where the tables are not those of such an estimate
/// @{
Risk risk_from(const std::vector<Table>& tables, const std::string& file);
RiskChange risk_change_from(const std::vector<Table>& tables, const std::string& file);
/// @}

/// The tables as comma-separated values: names of files and their texts.
/// @{
std::vector<std::pair<std::string, std::string>> risk_csv(const Risk& risk);
std::vector<std::pair<std::string, std::string>> risk_csv(const RiskChange& change);
/// @}

} // namespace stylobate
