#include "studies/decisions/risk/risk_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/sealed/table_file.hpp"
#include "io/tables/csv.hpp"
#include "studies/decisions/risk/risk_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

constexpr SealedFormat format{"stylobate-risk", "risk estimate", 3, 3, "compute it again"};

Table general_table(const Risk& risk)
{
    Table table("risk");
    table.set("title", risk.title);
    table.set("fragility_file", risk.fragility_file);
    table.set("study_toml", risk.study_text);
    table.set("level", risk.level);
    table.set("fragility_level", risk.fragility_level);
    table.set("most_outside", risk.most_outside);
    table.set("code_version", risk.code_version);
    table.add("years", risk.years, {risk.years.size()}, "year");
    table.add("notes", risk.says);
    return table;
}

Risk general_of(const Table& table)
{
    Risk risk;
    risk.title = table.text("title");
    risk.fragility_file = table.text("fragility_file");
    risk.study_text = table.text("study_toml");
    risk.level = level_of(table, "level");
    risk.fragility_level = level_of(table, "fragility_level");
    risk.most_outside = table.number("most_outside");
    risk.code_version = table.text("code_version");
    risk.years = years_of(table);
    risk.says = table.texts("notes");
    return risk;
}

// ---- /states, /disaggregation, /fragility ---------------------------------------------------------------------------

Table states_table(const Risk& risk)
{
    std::vector<std::string> states, meanings, forms, notes;
    std::vector<std::int32_t> chosen, determined;
    std::vector<RiskNumber> frequency;
    std::vector<double> by_mean, below, above, beyond, lowest, highest, unseen;
    for (const StateRisk& s : risk.states) {
        states.push_back(s.state);
        meanings.push_back(s.meaning);
        forms.emplace_back(to_string(s.form));
        notes.push_back(s.note);
        chosen.push_back(s.chosen);
        determined.push_back(s.determined);
        frequency.push_back(s.estimate.frequency);
        by_mean.push_back(s.estimate.by_mean_hazard);
        below.push_back(s.estimate.below);
        above.push_back(s.estimate.above);
        beyond.push_back(s.estimate.beyond_hazard);
        lowest.push_back(s.estimate.bounds.lower);
        highest.push_back(s.estimate.bounds.upper);
        unseen.push_back(s.estimate.unseen);
    }
    const Table::Shape shape{states.size()};
    Table table("states");
    table.add("state", std::move(states));
    table.add("meaning", std::move(meanings));
    table.add("form", std::move(forms));
    table.add("chosen", std::move(chosen), shape);
    table.add("determined", std::move(determined), shape);
    add_numbers(table, "annual_frequency", frequency);
    table.add("mean_hazard_annual_frequency", std::move(by_mean), shape, "1/year");
    table.add("share_below", std::move(below));
    table.add("share_above", std::move(above));
    table.add("share_beyond_hazard", std::move(beyond));
    table.add("lowest_annual_frequency", std::move(lowest), shape, "1/year");
    table.add("highest_annual_frequency", std::move(highest), shape, "1/year");
    table.add("unseen_annual_frequency", std::move(unseen), shape, "1/year");
    table.add("note", std::move(notes));
    return table;
}

Table parts_table(const Risk& risk)
{
    std::vector<std::int32_t> row;
    std::vector<double> from, to;
    std::vector<RiskNumber> frequency;
    for (std::size_t i = 0; i < risk.states.size(); ++i)
        for (const FrequencyPart& part : risk.states[i].estimate.parts) {
            row.push_back(static_cast<std::int32_t>(i));
            from.push_back(part.from);
            to.push_back(part.to);
            frequency.push_back(part.frequency);
        }
    Table table("disaggregation");
    table.add("row", row, {row.size()});
    table.add("from", std::move(from));
    table.add("to", std::move(to));
    add_numbers(table, "annual_frequency", frequency);
    return table;
}

Table fragility_points_table(const Risk& risk)
{
    std::vector<std::int32_t> row;
    std::vector<double> intensity;
    IntervalArray probability;
    for (std::size_t i = 0; i < risk.states.size(); ++i)
        for (const FragilityPoint& point : risk.states[i].fragility) {
            row.push_back(static_cast<std::int32_t>(i));
            intensity.push_back(point.intensity);
            probability.add(point.probability, point.lower, point.upper);
        }
    Table table("fragility");
    table.add("row", row, {row.size()});
    table.add("intensity_" + risk.hazard.measure, std::move(intensity));
    table.add("probability", probability, {row.size()});
    return table;
}

std::vector<StateRisk> states_of(const Table& states, const Table& parts, const Table& points,
                                 const std::string& measure)
{
    const Table::Shape shape = states.shape("state");
    const std::vector<std::string>&names = states.texts("state"), &meanings = states.texts("meaning"),
          &forms = states.texts("form"), &notes = states.texts("note");
    if (meanings.size() != names.size() || forms.size() != names.size() || notes.size() != names.size())
        states.refuse("its lists of states differ in length");
    const auto &chosen = states.integers("chosen", shape), &determined = states.integers("determined", shape);
    const std::vector<RiskNumber> frequency = numbers_of<RiskNumber>(states, "annual_frequency", shape);
    const auto &by_mean = states.numbers("mean_hazard_annual_frequency", shape),
               &below = states.numbers("share_below", shape), &above = states.numbers("share_above", shape),
               &beyond = states.numbers("share_beyond_hazard", shape),
               &lowest = states.numbers("lowest_annual_frequency", shape),
               &highest = states.numbers("highest_annual_frequency", shape),
               &unseen = states.numbers("unseen_annual_frequency", shape);
    std::vector<StateRisk> found;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const FragilityForm form =
            forms[i] == to_string(FragilityForm::shares) ? FragilityForm::shares : FragilityForm::lognormal;
        if (forms[i] != to_string(form))
            states.refuse("a limit state has a fragility of no known form");
        found.push_back(
            {names[i],
             meanings[i],
             form,
             chosen[i] != 0,
             determined[i] != 0,
             notes[i],
             FrequencyEstimate{
                 form, frequency[i], by_mean[i], {}, below[i], above[i], beyond[i], {lowest[i], highest[i]}, unseen[i]},
             {}});
    }
    const auto state = [&](const Table& table, std::int32_t row) -> StateRisk& {
        if (row < 0 || static_cast<std::size_t>(row) >= found.size())
            table.refuse("a row is of no state");
        return found[static_cast<std::size_t>(row)];
    };
    const Table::Shape all = parts.shape("row");
    const auto& rows = parts.integers("row", all);
    const auto &from = parts.numbers("from", all), &to = parts.numbers("to", all);
    const std::vector<RiskNumber> numbers = numbers_of<RiskNumber>(parts, "annual_frequency", all);
    for (std::size_t i = 0; i < rows.size(); ++i)
        state(parts, rows[i]).estimate.parts.push_back({from[i], to[i], numbers[i]});
    for (const StateRisk& s : found)
        if (s.estimate.parts.size() < 3)
            parts.refuse("a limit state has no parts");
    const Table::Shape each = points.shape("row");
    const auto& of = points.integers("row", each);
    const auto& intensity = points.numbers("intensity_" + measure, each);
    const IntervalArray probability = points.intervals("probability", each);
    for (std::size_t i = 0; i < of.size(); ++i)
        state(points, of[i])
            .fragility.push_back({intensity[i], probability.value[i], probability.lower[i], probability.upper[i]});
    return found;
}

// ---- /sequences -----------------------------------------------------------------------------------------------------

/// Every number of it, by its name: written and read by one list.
template <class Sequence, class Count, class Real>
void sequence_fields(Sequence& s, Count&& count, Real&& real)
{
    count("histories", s.histories);
    count("events", s.events);
    count("most_events", s.most_events);
    count("histories_with_two_events", s.with_two);
    count("fallen_carried", s.carried);
    count("fallen_fresh", s.fresh);
    count("fallen_both", s.both);
    count("invalid", s.invalid);
    count("runs", s.runs);
    count("steps", s.steps);
    count("checked", s.checked);
    count("then_fell", s.then_fell);
    count("then_stood", s.then_stood);
    real("years", s.years);
    real("level", s.level);
    real("threshold", s.threshold);
    real("events_1_year", s.events_a_year);
    real("checked_threshold", s.checked_threshold);
    real("closed_form", s.closed_form);
    const auto limits = [&](const std::string& name, auto& l) {
        real(name + "_lower", l.lower);
        real(name + "_upper", l.upper);
    };
    limits("closed_form", s.closed_form_limits);
    const auto number = [&](const std::string& name, auto& n) {
        real(name, n.value);
        limits(name, n.limits);
    };
    number("carried_share", s.carried_share);
    number("fresh_share", s.fresh_share);
    number("difference", s.difference);
    number("check_difference", s.check_difference);
    number("ratio", s.ratio);
}

Table sequences_table(const SequenceRisk& s)
{
    Table table("sequences");
    table.set("threshold_says", s.threshold_says);
    sequence_fields(
        s, [&](const std::string& name, std::uint64_t value) { table.set(name, value); },
        [&](const std::string& name, double value) { table.set(name, value); });
    return table;
}

SequenceRisk sequences_of(const Table& table)
{
    SequenceRisk s;
    s.threshold_says = table.text("threshold_says");
    sequence_fields(
        s, [&](const std::string& name, std::uint64_t& value) { value = table.count(name); },
        [&](const std::string& name, double& value) { value = table.number(name); });
    return s;
}

/// All but what is general.
std::vector<Table> number_tables(const Risk& risk)
{
    std::vector<Table> tables{hazard_table(risk.hazard), states_table(risk), parts_table(risk),
                              fragility_points_table(risk)};
    if (risk.sequences)
        tables.push_back(sequences_table(*risk.sequences));
    return tables;
}

} // namespace

std::vector<Table> tables_of(const Risk& risk)
{
    std::vector<Table> tables = number_tables(risk);
    tables.push_back(general_table(risk));
    return tables;
}

Risk risk_from(const std::vector<Table>& tables, const std::string& file)
{
    const auto named = [&](const char* name) -> const Table& { return table_named(tables, name, file); };
    Risk risk = general_of(named("risk"));
    risk.hazard = hazard_of(named("hazard"));
    risk.states = states_of(named("states"), named("disaggregation"), named("fragility"), risk.hazard.measure);
    if (risk.chosen().empty())
        named("states").refuse("it has no limit state");
    if (std::ranges::find(tables, "sequences", &Table::name) != tables.end())
        risk.sequences = sequences_of(named("sequences"));
    return risk;
}

void write_risk(const Risk& risk, const std::filesystem::path& file)
{
    write_table_file(file, format, risk.code_version, tables_of(risk));
}

Risk read_risk(const std::filesystem::path& file)
{
    return risk_from(read_table_file(file, format), file.string());
}

std::vector<std::pair<std::string, std::string>> risk_csv(const Risk& risk)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const Table& table : number_tables(risk))
        if (!table.columns().empty())
            files.emplace_back(table.name() + ".csv", csv_text(table));
    return files;
}

} // namespace stylobate
