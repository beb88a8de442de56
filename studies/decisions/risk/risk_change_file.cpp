#include "studies/decisions/risk/risk_change_file.hpp"

#include "io/sealed/table_file.hpp"
#include "io/tables/csv.hpp"
#include "studies/decisions/risk/risk_tables.hpp"

#include <fmt/format.h>

#include <utility>

namespace stylobate {

namespace {

constexpr SealedFormat change_format{"stylobate-risk-change", "risk estimate of a comparison", 1, 1,
                                     "compute it again"};

Table change_table(const RiskChange& change)
{
    Table table("risk_change");
    table.set("title", change.title);
    table.set("comparison_file", change.comparison_file);
    table.set("base", change.base_name);
    table.set("level", change.level);
    table.set("most_outside", change.most_outside);
    table.set("motions", change.motions);
    table.set("code_version", change.code_version);
    std::vector<std::string> names, results;
    for (const VariantChange& variant : change.variants) {
        names.push_back(variant.name);
        results.push_back(variant.results);
    }
    table.add("variants", std::move(names));
    table.add("variant_results", std::move(results));
    table.add("years", change.years, {change.years.size()}, "year");
    table.add("intensity", change.intensity);
    table.add("notes", change.says);
    return table;
}

/// A row for each limit state of each variant.
Table changes_table(const RiskChange& change)
{
    std::vector<std::int32_t> variant, damage, determined;
    std::vector<std::string> names, states, meanings, notes, verdicts;
    std::vector<RiskNumber> base, other;
    std::vector<double> base_unseen, variant_unseen;
    std::vector<ChangeNumber> frequency, ratio;
    for (std::size_t v = 0; v < change.variants.size(); ++v)
        for (const StateChange& s : change.variants[v].states) {
            variant.push_back(static_cast<std::int32_t>(v));
            names.push_back(change.variants[v].name);
            states.push_back(s.state);
            meanings.push_back(s.meaning);
            notes.push_back(s.note);
            verdicts.emplace_back(s.verdict());
            damage.push_back(s.damage);
            determined.push_back(s.determined);
            base.push_back(s.change.base.frequency);
            other.push_back(s.change.variant.frequency);
            base_unseen.push_back(s.change.base.unseen);
            variant_unseen.push_back(s.change.variant.unseen);
            frequency.push_back(s.change.frequency);
            ratio.push_back(s.change.ratio);
        }
    const std::size_t n = states.size();
    Table table("changes");
    table.add("variant", std::move(variant), {n});
    table.add("variant_name", std::move(names));
    table.add("state", std::move(states));
    table.add("meaning", std::move(meanings));
    table.add("damage", std::move(damage), {n});
    table.add("determined", std::move(determined), {n});
    table.add("verdict", std::move(verdicts));
    add_numbers(table, "base_annual_frequency", base);
    add_numbers(table, "variant_annual_frequency", other);
    add_numbers(table, "change", frequency);
    add_numbers(table, "ratio", ratio, "");
    table.add("base_unseen_annual_frequency", std::move(base_unseen), {n}, "1/year");
    table.add("variant_unseen_annual_frequency", std::move(variant_unseen), {n}, "1/year");
    table.add("note", std::move(notes));
    return table;
}

/// Rows of `changes`, each with all of its years or stripes.
std::vector<std::int32_t> rows_of(std::size_t rows, std::size_t each)
{
    std::vector<std::int32_t> all;
    for (std::size_t i = 0; i < rows * each; ++i)
        all.push_back(static_cast<std::int32_t>(i / each));
    return all;
}

Table years_table(const RiskChange& change)
{
    std::vector<double> years;
    std::vector<ChangeNumber> probability;
    std::size_t rows = 0;
    for (const VariantChange& variant : change.variants)
        for (const StateChange& s : variant.states) {
            ++rows;
            years.insert(years.end(), change.years.begin(), change.years.end());
            probability.insert(probability.end(), s.change.probability.begin(), s.change.probability.end());
        }
    Table table("over_years");
    const Table::Shape shape{years.size()};
    table.add("row", rows_of(rows, change.years.size()), shape);
    table.add("years", std::move(years), shape, "year");
    add_numbers(table, "probability_change", probability, "");
    return table;
}

Table shares_table(const RiskChange& change)
{
    std::vector<double> intensity, base, variant;
    std::size_t rows = 0;
    for (const VariantChange& v : change.variants)
        for (const StateChange& s : v.states) {
            ++rows;
            intensity.insert(intensity.end(), change.intensity.begin(), change.intensity.end());
            base.insert(base.end(), s.base_share.begin(), s.base_share.end());
            variant.insert(variant.end(), s.variant_share.begin(), s.variant_share.end());
        }
    Table table("shares");
    const Table::Shape shape{intensity.size()};
    table.add("row", rows_of(rows, change.intensity.size()), shape);
    table.add("intensity_" + change.hazard.measure, std::move(intensity), shape);
    table.add("base_share", std::move(base), shape);
    table.add("variant_share", std::move(variant), shape);
    return table;
}

void read_states(const Table& table, const Table& over_years, const Table& shares, RiskChange& change)
{
    const Table::Shape shape = table.shape("state");
    const std::vector<std::string>&names = table.texts("state"), &meanings = table.texts("meaning"),
          &notes = table.texts("note");
    if (meanings.size() != names.size() || notes.size() != names.size())
        table.refuse("its lists of states differ in length");
    const std::size_t n = names.size(), years = change.years.size(), stripes = change.intensity.size();
    const auto &variant = table.integers("variant", shape), &damage = table.integers("damage", shape),
               &determined = table.integers("determined", shape);
    const auto base = numbers_of<RiskNumber>(table, "base_annual_frequency", shape),
               other = numbers_of<RiskNumber>(table, "variant_annual_frequency", shape);
    const auto frequency = numbers_of<ChangeNumber>(table, "change", shape),
               ratio = numbers_of<ChangeNumber>(table, "ratio", shape),
               probability = numbers_of<ChangeNumber>(over_years, "probability_change", {n * years});
    const auto &base_unseen = table.numbers("base_unseen_annual_frequency", shape),
               &variant_unseen = table.numbers("variant_unseen_annual_frequency", shape),
               &base_share = shares.numbers("base_share", {n * stripes}),
               &variant_share = shares.numbers("variant_share", {n * stripes});
    const auto part = [](const auto& values, std::size_t row, std::size_t width) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * width);
        return std::vector(begin, begin + static_cast<std::ptrdiff_t>(width));
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (variant[i] < 0 || static_cast<std::size_t>(variant[i]) >= change.variants.size())
            table.refuse("a row is of no variant");
        StateChange state{names[i],
                          meanings[i],
                          damage[i] != 0,
                          determined[i] != 0,
                          notes[i],
                          {},
                          part(base_share, i, stripes),
                          part(variant_share, i, stripes)};
        state.change.base.frequency = base[i];
        state.change.base.unseen = base_unseen[i];
        state.change.variant.frequency = other[i];
        state.change.variant.unseen = variant_unseen[i];
        state.change.frequency = frequency[i];
        state.change.ratio = ratio[i];
        state.change.probability = part(probability, i, years);
        change.variants[static_cast<std::size_t>(variant[i])].states.push_back(std::move(state));
    }
    for (const VariantChange& v : change.variants)
        if (v.states.empty())
            table.refuse("a variant has no limit state");
}

} // namespace

std::vector<Table> tables_of(const RiskChange& change)
{
    return {change_table(change), hazard_table(change.hazard), changes_table(change), years_table(change),
            shares_table(change)};
}

RiskChange risk_change_from(const std::vector<Table>& tables, const std::string& file)
{
    const auto named = [&](const char* name) -> const Table& { return table_named(tables, name, file); };
    const Table& general = named("risk_change");
    RiskChange change;
    change.title = general.text("title");
    change.comparison_file = general.text("comparison_file");
    change.base_name = general.text("base");
    change.level = level_of(general, "level");
    change.most_outside = general.number("most_outside");
    change.motions = general.count("motions");
    change.code_version = general.text("code_version");
    change.says = general.texts("notes");
    change.years = years_of(general);
    change.intensity = general.numbers("intensity", general.shape("intensity"));
    if (change.intensity.size() < 2)
        general.refuse("it has fewer than two intensities");
    const std::vector<std::string>&names = general.texts("variants"), &results = general.texts("variant_results");
    if (names.empty() || results.size() != names.size())
        general.refuse("its variants are no list");
    for (std::size_t i = 0; i < names.size(); ++i)
        change.variants.push_back({names[i], results[i], {}});
    change.hazard = hazard_of(named("hazard"));
    read_states(named("changes"), named("over_years"), named("shares"), change);
    return change;
}

void write_risk_change(const RiskChange& change, const std::filesystem::path& file)
{
    write_table_file(file, change_format, change.code_version, tables_of(change));
}

RiskChange read_risk_change(const std::filesystem::path& file)
{
    return risk_change_from(read_table_file(file, change_format), file.string());
}

std::vector<std::pair<std::string, std::string>> risk_change_csv(const RiskChange& change)
{
    return {{"hazard.csv", csv_text(hazard_table(change.hazard))},
            {"changes.csv", csv_text(changes_table(change))},
            {"over_years.csv", csv_text(years_table(change))},
            {"shares.csv", csv_text(shares_table(change))}};
}

} // namespace stylobate
