#include "studies/decisions/risk/risk.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_parts.hpp"
#include "io/store/result_seal.hpp"
#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

std::vector<const StateRisk*> Risk::chosen() const
{
    std::vector<const StateRisk*> found;
    for (const StateRisk& s : states)
        if (s.chosen)
            found.push_back(&s);
    return found;
}

const StateRisk& Risk::principal() const
{
    const auto all = chosen();
    const auto collapse = std::ranges::find(all, "collapse", &StateRisk::state);
    return collapse == all.end() ? *all.back() : **collapse;
}

const char* StateChange::verdict() const
{
    return !determined                        ? "not determined"
           : change.frequency.total.upper < 0 ? "lower"
           : change.frequency.total.lower > 0 ? "higher"
                                              : "undecided";
}

const StateChange& VariantChange::principal() const
{
    const auto collapse = std::ranges::find(states, "collapse", &StateChange::state);
    return collapse == states.end() ? states.back() : *collapse;
}

namespace {

constexpr SealedFormat format{"stylobate-risk", "risk estimate", 3, 3, "compute it again"};
constexpr SealedFormat change_format{"stylobate-risk-change", "risk estimate of a comparison", 1, 1,
                                     "compute it again"};

// ---- what both have in common ---------------------------------------------------------------------------------------

/// "intensity_pgv_m_s"
std::string measure_column(const HazardModel& hazard)
{
    return "intensity_" + hazard.measure;
}

Table hazard_table(const HazardModel& hazard)
{
    Table table("hazard");
    table.set("source", hazard.source);
    table.set("site", hazard.site.value_or(""));
    table.set("measure", hazard.measure);
    table.set("unbounded", std::uint64_t{hazard.unbounded});
    table.add(measure_column(hazard), hazard.intensity);
    table.add("annual_frequency", hazard.frequency, {hazard.frequency.size()}, "1/year");
    for (const HazardFractile& f : hazard.fractiles)
        table.add(fmt::format("fractile_{}", f.probability), f.frequency, {f.frequency.size()}, "1/year");
    return table;
}

HazardModel hazard_of(const Table& table)
{
    HazardModel hazard;
    hazard.source = table.text("source");
    if (const std::string site = table.text("site"); !site.empty())
        hazard.site = site;
    hazard.measure = table.text("measure");
    hazard.unbounded = table.count("unbounded") != 0;
    const Table::Shape& shape = table.list_shape(measure_column(hazard));
    if (shape[0] < 2)
        table.refuse("its hazard is no list");
    hazard.intensity = table.numbers(measure_column(hazard), shape);
    hazard.frequency = table.numbers("annual_frequency", shape);
    for (const Table::Column& column : table.columns())
        if (column.name.starts_with("fractile_")) {
            const auto probability = hazard_number(std::string_view(column.name).substr(9));
            if (!probability || !(*probability > 0 && *probability < 1))
                table.refuse("a fractile of its hazard has no probability");
            hazard.fractiles.push_back({*probability, table.numbers(column.name, shape)});
        }
    try {
        return checked_hazard({std::move(hazard), {}, {}});
    } catch (const InputError& error) { // it names what the hazard was read from, not this file
        table.refuse(fmt::format("its hazard is none: {}", error.what()));
    }
}

/// The record of an estimate, and its hazard. @throws InputError if a level or the years have no meaning
template <class Estimate>
Estimate estimate_of(const std::vector<Table>& tables, const char* name, const std::string& file)
{
    const Table& table = table_named(tables, name, file);
    Estimate estimate;
    read_record(table, estimate);
    const auto is_level = [](double level) { return level > 0 && level < 1; };
    bool levels = is_level(estimate.level);
    if constexpr (requires { estimate.fragility_level; })
        levels = levels && is_level(estimate.fragility_level);
    if (!levels)
        table.refuse("a level of its intervals is not between 0 and 1");
    if (estimate.years.empty() ||
        !std::ranges::all_of(estimate.years, [](double y) { return y > 0 && std::isfinite(y); }))
        table.refuse("its years are not above 0 and finite");
    estimate.hazard = hazard_of(table_named(tables, "hazard", file));
    return estimate;
}

/// A file for each table that has columns.
std::vector<std::pair<std::string, std::string>> csv_of(const std::vector<Table>& tables)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const Table& table : tables)
        if (!table.columns().empty())
            files.emplace_back(table.name() + ".csv", csv_text(table));
    return files;
}

// ---- of one structure -----------------------------------------------------------------------------------------------

constexpr auto parts_of = [](auto& state) -> auto&
{
    return state.estimate.parts;
};

/// All but what is general.
std::vector<Table> number_tables(const Risk& risk)
{
    Table states("states"), points = entries_table("fragility", risk.states, &StateRisk::fragility);
    add_rows(states, risk.states);
    points.rename("intensity", measure_column(risk.hazard));
    std::vector<Table> tables{hazard_table(risk.hazard), std::move(states),
                              entries_table("disaggregation", risk.states, parts_of), std::move(points)};
    if (risk.sequences)
        add_record(tables.emplace_back("sequences"), *risk.sequences);
    return tables;
}

// ---- of a comparison ------------------------------------------------------------------------------------------------

/// A row for each limit state of each variant.
Table changes_table(const RiskChange& change)
{
    std::vector<std::int32_t> variant;
    std::vector<std::string> names;
    for (std::size_t v = 0; v < change.variants.size(); ++v) {
        variant.insert(variant.end(), change.variants[v].states.size(), static_cast<std::int32_t>(v));
        names.insert(names.end(), change.variants[v].states.size(), change.variants[v].name);
    }
    Table table("changes");
    table.add("variant", std::move(variant));
    table.add("variant_name", std::move(names));
    add_rows(table, pointers_to(change.variants, &VariantChange::states));
    return table;
}

/// Begins a table of all years or stripes of each row of `changes`: the row, and the year or intensity.
Table table_over(const char* name, const RiskChange& change, const std::string& column,
                 const std::vector<double>& values, const std::string& unit)
{
    std::vector<std::int32_t> rows;
    std::vector<double> all;
    const std::size_t states = pointers_to(change.variants, &VariantChange::states).size();
    for (std::size_t row = 0; row < states; ++row) {
        rows.insert(rows.end(), values.size(), static_cast<std::int32_t>(row));
        all.insert(all.end(), values.begin(), values.end());
    }
    Table table(name);
    const Table::Shape shape{rows.size()};
    table.add("row", std::move(rows));
    table.add(column, std::move(all), shape, unit);
    return table;
}

/// All but what is general.
std::vector<Table> number_tables(const RiskChange& change)
{
    Table years = table_over("over_years", change, "years", change.years, "year");
    Table shares = table_over("shares", change, measure_column(change.hazard), change.intensity, "");
    const auto states = pointers_to(change.variants, &VariantChange::states);
    std::vector<const ChangeNumber*> probability;
    std::vector<double> base, variant;
    for (const StateChange* s : states) {
        for (const ChangeNumber& number : s->change.probability)
            probability.push_back(&number);
        base.insert(base.end(), s->base_share.begin(), s->base_share.end());
        variant.insert(variant.end(), s->variant_share.begin(), s->variant_share.end());
    }
    add_rows(years, probability, "probability_change");
    shares.add("base_share", std::move(base));
    shares.add("variant_share", std::move(variant));
    return {hazard_table(change.hazard), changes_table(change), std::move(years), std::move(shares)};
}

void read_states(const Table& changes, const Table& over_years, const Table& shares, RiskChange& change)
{
    std::vector<StateChange> states = rows_of<StateChange>(changes, "state");
    const std::size_t n = states.size(), years = change.years.size(), stripes = change.intensity.size();
    std::vector<ChangeNumber> probability(n * years);
    read_rows(over_years, pointers_to(probability), "probability_change");
    const auto& variant = changes.integers("variant", {n});
    const auto &base = shares.numbers("base_share", {n * stripes}),
               &other = shares.numbers("variant_share", {n * stripes});
    const auto part = [](const auto& values, std::size_t row, std::size_t width) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * width);
        return std::vector(begin, begin + static_cast<std::ptrdiff_t>(width));
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (variant[i] < 0 || static_cast<std::size_t>(variant[i]) >= change.variants.size())
            changes.refuse("a row is of no variant");
        states[i].change.probability = part(probability, i, years);
        states[i].base_share = part(base, i, stripes);
        states[i].variant_share = part(other, i, stripes);
        change.variants[static_cast<std::size_t>(variant[i])].states.push_back(std::move(states[i]));
    }
    for (const VariantChange& v : change.variants)
        if (v.states.empty())
            changes.refuse("a variant has no limit state");
}

} // namespace

std::vector<Table> tables_of(const Risk& risk)
{
    std::vector<Table> tables = number_tables(risk);
    add_record(tables.emplace_back("risk"), risk);
    return tables;
}

std::vector<Table> tables_of(const RiskChange& change)
{
    std::vector<Table> tables = number_tables(change);
    Table& table = tables.emplace_back("risk_change");
    add_record(table, change);
    add_rows(table, change.variants);
    return tables;
}

Risk risk_from(const std::vector<Table>& tables, const std::string& file)
{
    Risk risk = estimate_of<Risk>(tables, "risk", file);
    const Table &states = table_named(tables, "states", file), &parts = table_named(tables, "disaggregation", file);
    risk.states = rows_of<StateRisk>(states, "state");
    for (StateRisk& s : risk.states)
        s.estimate.form = s.form;
    if (risk.chosen().empty())
        states.refuse("it has no limit state");
    read_entries(parts, risk.states, parts_of);
    for (const StateRisk& s : risk.states)
        if (s.estimate.parts.size() < 3)
            parts.refuse("a limit state has no parts");
    Table points = table_named(tables, "fragility", file);
    points.rename(measure_column(risk.hazard), "intensity");
    read_entries(points, risk.states, &StateRisk::fragility);
    if (const Table* sequences = find_table(tables, "sequences"))
        read_record(*sequences, risk.sequences.emplace());
    return risk;
}

RiskChange risk_change_from(const std::vector<Table>& tables, const std::string& file)
{
    RiskChange change = estimate_of<RiskChange>(tables, "risk_change", file);
    const Table& general = table_named(tables, "risk_change", file);
    if (change.intensity.size() < 2)
        general.refuse("it has fewer than two intensities");
    change.variants = rows_of<VariantChange>(general, "variants");
    if (change.variants.empty())
        general.refuse("it has no variant");
    read_states(table_named(tables, "changes", file), table_named(tables, "over_years", file),
                table_named(tables, "shares", file), change);
    return change;
}

void write_risk(const Risk& risk, const std::filesystem::path& file)
{
    write_sealed_file(file, format, risk.code_version, Table(format.kind, tables_of(risk)));
}

void write_risk(const RiskChange& change, const std::filesystem::path& file)
{
    write_sealed_file(file, change_format, change.code_version, Table(change_format.kind, tables_of(change)));
}

Risk read_risk(const std::filesystem::path& file)
{
    return risk_from(read_sealed_file(file, format).content.tables(), file.string());
}

RiskChange read_risk_change(const std::filesystem::path& file)
{
    return risk_change_from(read_sealed_file(file, change_format).content.tables(), file.string());
}

std::vector<std::pair<std::string, std::string>> risk_csv(const Risk& risk)
{
    return csv_of(number_tables(risk));
}

std::vector<std::pair<std::string, std::string>> risk_csv(const RiskChange& change)
{
    return csv_of(number_tables(change));
}

} // namespace stylobate
