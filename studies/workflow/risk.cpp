#include "studies/workflow/risk.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/hazard/hazard_file.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/risk/risk_text.hpp"
#include "studies/decisions/risk/sequences.hpp"
#include "studies/kinds/fragility/fragility_kind.hpp"
#include "studies/results/results.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

RiskOptions checked(const RiskRequest& request)
{
    RiskOptions options;
    if (!request.years.empty())
        options.years = request.years;
    for (const double years : options.years)
        if (!(years > 0 && years <= 1e6))
            throw InputError(fmt::format("--years {}: is outside (0, 1e6].\n  Give years such as 50,100.", years));
    if (!(request.level > 0.5 && request.level < 1))
        throw InputError(fmt::format("--level {}: is outside (0.5, 1).\n  Give a level such as 0.9.", request.level));
    if (!(request.most_outside >= 0 && request.most_outside <= 1))
        throw InputError(fmt::format("--most-outside {}: is no share in [0, 1].", request.most_outside));
    options.level = request.level;
    options.most_outside = request.most_outside;
    options.state = request.state;
    return options;
}

RiskChange change_of(const RiskRequest& request, const RiskOptions& asked)
{
    if (request.sequences > 0) // they are run again, and a comparison has counts alone
        throw InputError(
            fmt::format("--sequences: {} is a comparison; histories are of one study.\n  Give its results: "
                        "stylobate risk RESULTS.h5 --hazard HAZARD --sequences {}",
                        request.file, request.sequences));
    check_no_settings(request.settings, request.file);
    const Comparison comparison = read_comparison(request.file);
    check_has_risk(comparison, request.file);
    const HazardModel hazard = read_hazard(request.hazard, comparison.measure, request.site);
    if (request.output)
        AtomicFile::check(*request.output);
    RiskChange change = risk_change_of(comparison, request.file, hazard, asked);
    change.comparison_file = std::filesystem::path(request.file).filename().string();
    change.code_version = code_version();
    return change;
}

/// @throws InputError if the results are not complete ones of a fragility study
void check_fragility(const Results& results)
{
    if (!dynamic_cast<const FragilityKind*>(&results.kind()))
        throw InputError(results.file(), 0,
                         fmt::format("is the result of a study of kind '{}'; a risk is of a fragility study.\n  "
                                     "stylobate new fragility: writes one to begin with",
                                     results.header().kind));
    check_complete(results.reader(), results.file());
}

std::optional<Risk> risk_of_study(const RiskRequest& request, const RiskOptions& asked, const Machine& machine,
                                  WorkObserver& observer)
{
    const RunOptions run = machine.run_options();
    const Results results(request.file, request.settings);
    check_fragility(results);
    const HazardModel hazard = read_hazard(request.hazard, measure_of(*results.study().design().motions), request.site);
    if (request.sequences > 0)
        check_sequences(results);
    if (request.output)
        AtomicFile::check(*request.output);
    const auto& kind = dynamic_cast<const FragilityKind&>(results.concluded());
    Risk risk;
    try {
        risk = risk_of(kind.fragility(), hazard, asked);
    } catch (const InputError& error) {
        const std::string what = error.what();
        throw InputError(what.starts_with("--") ? what : request.file + ": " + what);
    }
    risk.fragility_file = std::filesystem::path(request.file).filename().string();
    risk.title = results.title();
    risk.study_text = results.study().text;
    risk.code_version = code_version();
    if (request.sequences == 0)
        return risk;
    observer.begin();
    risk.sequences = simulate_sequences(results, risk,
                                        {.histories = request.sequences,
                                         .years = asked.years.back(),
                                         .level = asked.level,
                                         .threshold = request.threshold,
                                         .pause_s = request.pause_s,
                                         .seed = request.seed},
                                        run, observer);
    return risk.sequences ? std::optional(std::move(risk)) : std::nullopt;
}

template <class Number>
void add_number(Table& table, const std::string& name, const std::vector<Number>& numbers, const std::string& unit)
{
    IntervalArray array;
    for (const Number& number : numbers)
        array.add(number.value, number.total.lower, number.total.upper);
    table.add(name, std::move(array.value), {numbers.size()}, unit);
    table.add(name + "_lower", std::move(array.lower), {numbers.size()}, unit);
    table.add(name + "_upper", std::move(array.upper), {numbers.size()}, unit);
}

/// Annual frequencies, and probabilities over each of the years.
void add_frequencies(Table& table, const std::string& name, const std::vector<RiskNumber>& frequencies,
                     const std::vector<double>& years)
{
    add_number(table, name + "annual_frequency", frequencies, "1/year");
    for (const double each : years) {
        std::vector<RiskNumber> probabilities;
        for (const RiskNumber& frequency : frequencies)
            probabilities.push_back(probability_over(frequency, each));
        add_number(table, fmt::format("{}probability_{:g}_years", name, each), probabilities, "");
    }
}

Table rows_of(const Risk& risk)
{
    std::vector<std::string> states, meanings, notes;
    std::vector<std::int32_t> determined;
    std::vector<RiskNumber> frequencies;
    for (const StateRisk* state : risk.chosen()) {
        states.push_back(state->state);
        meanings.push_back(state->meaning);
        determined.push_back(state->determined);
        frequencies.push_back(state->estimate.frequency);
        notes.push_back(state->note);
    }
    Table table("risk");
    table.add("limit_state", std::move(states));
    table.add("meaning", std::move(meanings));
    table.add("determined", std::move(determined), {frequencies.size()});
    add_frequencies(table, "", frequencies, risk.years);
    table.add("note", std::move(notes));
    return table;
}

Table rows_of(const RiskChange& change)
{
    std::vector<std::string> variants, states, meanings, verdicts, notes;
    std::vector<RiskNumber> base, variant;
    std::vector<ChangeNumber> frequency, ratio;
    std::vector<std::vector<ChangeNumber>> probability(change.years.size());
    for (const VariantChange& each : change.variants)
        for (const StateChange& state : each.states) {
            variants.push_back(each.name);
            states.push_back(state.state);
            meanings.push_back(state.meaning);
            verdicts.emplace_back(state.verdict());
            base.push_back(state.change.base.frequency);
            variant.push_back(state.change.variant.frequency);
            frequency.push_back(state.change.frequency);
            ratio.push_back(state.change.ratio);
            for (std::size_t i = 0; i < change.years.size(); ++i)
                probability[i].push_back(state.change.probability[i]);
            notes.push_back(state.note);
        }
    Table table("risk");
    table.add("variant", std::move(variants));
    table.add("limit_state", std::move(states));
    table.add("meaning", std::move(meanings));
    table.add("verdict", std::move(verdicts));
    add_frequencies(table, "base_", base, change.years);
    add_frequencies(table, "variant_", variant, change.years);
    add_number(table, "annual_frequency_change", frequency, "1/year");
    add_number(table, "annual_frequency_ratio", ratio, "");
    for (std::size_t i = 0; i < change.years.size(); ++i)
        add_number(table, fmt::format("probability_{:g}_years_change", change.years[i]), probability[i], "");
    table.add("note", std::move(notes));
    return table;
}

} // namespace

std::optional<AnyRisk> estimate_risk(const RiskRequest& request, const Machine& machine, WorkObserver& observer)
{
    check_kind(request.file, "risk");
    if (request.output) {
        check_output(request.file, *request.output, request.force);
        for (const std::string& hazard : request.hazard)
            check_not_input(hazard, *request.output);
    }
    const RiskOptions asked = checked(request);
    std::optional<AnyRisk> found;
    if (recognise(request.file).kind == FileKind::comparison)
        found = change_of(request, asked);
    else if (std::optional<Risk> risk = risk_of_study(request, asked, machine, observer))
        found = std::move(*risk);
    if (found && request.output)
        write_risk(*found, *request.output);
    return found;
}

AnyRisk read_any_risk(const std::filesystem::path& file)
{
    if (recognise(file).detail == risk_of_comparison)
        return read_risk_change(file);
    return read_risk(file);
}

void write_risk(const AnyRisk& risk, const std::filesystem::path& file)
{
    std::visit([&](const auto& one) { write_risk(one, file); }, risk);
}

std::vector<Table> tables_of(const AnyRisk& risk)
{
    return std::visit([](const auto& one) { return tables_of(one); }, risk);
}

std::vector<std::pair<std::string, std::string>> risk_csv(const AnyRisk& risk)
{
    return std::visit([](const auto& one) { return risk_csv(one); }, risk);
}

std::string risk_text(const AnyRisk& risk)
{
    return std::visit([](const auto& one) { return risk_text(one); }, risk);
}

Json risk_json(const AnyRisk& risk)
{
    return std::visit([](const auto& one) { return risk_json(one); }, risk);
}

Document risk_page(const AnyRisk& risk, const std::string& file, const std::optional<std::string>& title)
{
    return std::visit([&](const auto& one) { return risk_page(one, file, title); }, risk);
}

void plot_risk(const AnyRisk& risk, const std::optional<std::string>& state, const std::optional<std::string>& title,
               const std::filesystem::path& picture)
{
    std::visit([&](const auto& one) { plot_risk(one, state, title, picture); }, risk);
}

Table risk_rows(const AnyRisk& risk)
{
    return std::visit([](const auto& one) { return rows_of(one); }, risk);
}

} // namespace stylobate
