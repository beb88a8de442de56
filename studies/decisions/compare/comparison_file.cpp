#include "studies/decisions/compare/comparison_file.hpp"

#include "io/sealed/table_file.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace stylobate {

namespace {

constexpr SealedFormat format{"stylobate-comparison", "comparison", 2, 1, "compare again"};
constexpr char variant_table[] = "variant_"; ///< and its number

Table general_table(const Comparison& c)
{
    Table table("comparison");
    table.set("study_kind", c.kind);
    table.set("title", c.title);
    table.set("base", c.base_name);
    table.set("base_results", c.base_results);
    table.set("base_study_toml", c.base_toml);
    table.set("level", c.level);
    table.set("false_names", c.rate);
    table.set("adjustment", c.adjustment);
    table.set("measure", c.measure);
    table.set("motions", c.motions);
    table.set("adaptive_budget", c.adaptive_budget);
    table.set("adaptive_margin", c.adaptive_margin);
    table.set("adaptive_rounds", c.adaptive_rounds);
    table.set("code_version", c.code_version);
    std::vector<std::string> names;
    for (const VariantComparison& variant : c.variants)
        names.push_back(variant.name);
    table.add("variants", names);
    if (!c.frequency_hz.empty()) {
        table.add("frequency_hz", c.frequency_hz, {c.frequency_hz.size()}, "Hz");
        table.add("pga_m_s2", c.pga_m_s2, {c.pga_m_s2.size()}, "m/s2");
    }
    if (!c.intensity.empty())
        table.add("intensity", c.intensity);
    return table;
}

/// The numbers of one place, in the order in which they lie in the file: whole ones, then the others.
template <class Place, class Whole, class Real>
void visit_place(Place& place, const Whole& whole, const Real& real)
{
    whole("both", place.counts.both);
    whole("base_only", place.counts.base_only);
    whole("variant_only", place.counts.variant_only);
    whole("neither", place.counts.neither);
    real("base_probability", place.base.probability);
    real("base_probability_lower", place.base.lower);
    real("base_probability_upper", place.base.upper);
    real("variant_probability", place.variant.probability);
    real("variant_probability_lower", place.variant.lower);
    real("variant_probability_upper", place.variant.upper);
    real("difference", place.difference);
    real("difference_lower", place.lower);
    real("difference_upper", place.upper);
    real("unpaired_realizations", place.unpaired);
    real("p", place.p);
    real("p_adjusted", place.p_adjusted);
}

template <class T>
using Columns = std::vector<std::pair<std::string, std::vector<T>>>;

template <class T>
std::vector<T>& column_of(Columns<T>& columns, const char* name)
{
    for (auto& [known, values] : columns)
        if (known == name)
            return values;
    return columns.emplace_back(name, std::vector<T>{}).second;
}

/// Each number of the places is a column of (limit states x cells), or of (limit states) with "overall_" before it.
void add_places(Table& table, const std::vector<const PlaceComparison*>& places, const Table::Shape& shape,
                const std::string& before)
{
    Columns<std::uint64_t> wholes;
    Columns<double> reals;
    for (const PlaceComparison* place : places)
        visit_place(
            *place, [&](const char* name, std::uint64_t value) { column_of(wholes, name).push_back(value); },
            [&](const char* name, double value) { column_of(reals, name).push_back(value); });
    for (auto& [name, values] : wholes)
        table.add(before + name, std::move(values), shape);
    for (auto& [name, values] : reals)
        table.add(before + name, std::move(values), shape);
}

void read_places(const Table& table, const std::vector<PlaceComparison*>& places, const Table::Shape& shape,
                 const std::string& before)
{
    for (std::size_t i = 0; i < places.size(); ++i) {
        PlaceComparison& place = *places[i];
        visit_place(
            place, [&](const char* name, std::uint64_t& value) { value = table.counts(before + name, shape)[i]; },
            [&](const char* name, double& value) { value = table.numbers(before + name, shape)[i]; });
        place.base.trials = place.variant.trials = place.counts.pairs();
        place.base.count = place.counts.base();
        place.variant.count = place.counts.variant();
    }
}

/// Pairs of each motion at each stripe, from which the change of a frequency is computed: (limit states x stripes x
/// motions). Files of version 1 are without them.
constexpr std::pair<const char*, std::uint64_t PairedCounts::*> motion_counts[] = {
    {"motion_both", &PairedCounts::both},
    {"motion_base_only", &PairedCounts::base_only},
    {"motion_variant_only", &PairedCounts::variant_only},
    {"motion_neither", &PairedCounts::neither}};

void add_motions(Table& table, const std::vector<LimitComparison>& limits, std::size_t cells)
{
    const std::size_t motions = limits.front().by_motion.size() / cells;
    if (motions == 0)
        return;
    for (const auto& [name, member] : motion_counts) {
        std::vector<std::uint64_t> values;
        for (const LimitComparison& limit : limits)
            for (const PairedCounts& counts : limit.by_motion)
                values.push_back(counts.*member);
        table.add(name, std::move(values), {limits.size(), cells, motions});
    }
}

void read_motions(const Table& table, std::vector<LimitComparison>& limits, std::size_t cells)
{
    if (!table.has(motion_counts[0].first))
        return;
    const Table::Shape shape = table.shape(motion_counts[0].first);
    if (shape.size() != 3 || shape[0] != limits.size() || shape[1] != cells || shape[2] == 0)
        table.refuse("its pairs of motions have another shape");
    const std::size_t each = shape[1] * shape[2];
    for (LimitComparison& limit : limits)
        limit.by_motion.resize(each);
    for (const auto& [name, member] : motion_counts) {
        const std::vector<std::uint64_t>& values = table.counts(name, shape);
        for (std::size_t i = 0; i < values.size(); ++i)
            limits[i / each].by_motion[i % each].*member = values[i];
    }
}

void add_dependences(Table& table, const std::vector<InputDependence>& depends)
{
    std::vector<std::string> inputs;
    std::vector<double> z, p, adjusted, between, difference, lower, upper;
    for (const InputDependence& input : depends) {
        inputs.push_back(input.input);
        z.push_back(input.found.z);
        p.push_back(input.found.p);
        adjusted.push_back(input.p_adjusted);
        between.insert(between.end(), input.found.between.begin(), input.found.between.end());
        for (const PairedDifference& third : input.found.thirds) {
            difference.push_back(third.value);
            lower.push_back(third.lower);
            upper.push_back(third.upper);
        }
    }
    const std::size_t n = inputs.size();
    table.add("depends_on", std::move(inputs));
    table.add("depends_z", std::move(z), {n});
    table.add("depends_p", std::move(p), {n});
    table.add("depends_p_adjusted", std::move(adjusted), {n});
    table.add("depends_between", std::move(between), {n, 2});
    table.add("depends_difference", std::move(difference), {n, 3});
    table.add("depends_difference_lower", std::move(lower), {n, 3});
    table.add("depends_difference_upper", std::move(upper), {n, 3});
}

std::vector<InputDependence> dependences_of(const Table& table)
{
    const std::vector<std::string>& inputs = table.texts("depends_on");
    const std::size_t n = inputs.size();
    const std::vector<double>&z = table.numbers("depends_z", {n}), &p = table.numbers("depends_p", {n}),
          &adjusted = table.numbers("depends_p_adjusted", {n}), &between = table.numbers("depends_between", {n, 2}),
          &difference = table.numbers("depends_difference", {n, 3}),
          &lower = table.numbers("depends_difference_lower", {n, 3}),
          &upper = table.numbers("depends_difference_upper", {n, 3});
    std::vector<InputDependence> all;
    for (std::size_t i = 0; i < n; ++i) {
        InputDependence& input = all.emplace_back(InputDependence{inputs[i], {z[i], p[i], {}, {}}, adjusted[i]});
        input.found.between = {between[2 * i], between[2 * i + 1]};
        for (std::size_t third = 0; third < 3; ++third)
            input.found.thirds[third] = {difference[3 * i + third], lower[3 * i + third], upper[3 * i + third]};
    }
    return all;
}

Table table_of(const VariantComparison& v, std::size_t number, std::size_t cells)
{
    Table table(variant_table + std::to_string(number));
    table.set("name", v.name);
    table.set("results", v.results);
    table.set("study_toml", v.study_toml);
    table.set("pairs", v.pairs);
    table.set("invalid_base", v.invalid_base);
    table.set("invalid_variant", v.invalid_variant);
    table.set("dropped_pairs", v.dropped);
    std::vector<std::string> names, describe, inputs;
    std::vector<std::int32_t> damage, draws;
    std::vector<std::uint64_t> numbers;
    std::vector<const PlaceComparison*> places, overall;
    for (const LimitComparison& limit : v.limits) {
        names.push_back(limit.name);
        describe.push_back(limit.describe);
        damage.push_back(limit.damage);
        for (const PlaceComparison& place : limit.cells)
            places.push_back(&place);
        overall.push_back(&limit.overall);
    }
    for (const CommonInput& input : v.inputs) {
        inputs.push_back(input.name);
        draws.push_back(static_cast<std::int32_t>(input.draws));
        numbers.push_back(input.numbers);
    }
    const std::size_t limits = v.limits.size();
    table.add("limit_states", names);
    table.add("descriptions", describe);
    table.add("damage", damage);
    add_places(table, places, {limits, cells}, "");
    add_places(table, overall, {limits}, "overall_");
    if (limits > 0)
        add_motions(table, v.limits, cells);
    table.add("inputs", inputs);
    table.add("input_draws", draws);
    table.add("input_numbers", numbers);
    table.add("notes", v.notes);
    add_dependences(table, v.depends);
    return table;
}

VariantComparison variant_of(const Table& table, std::size_t cells)
{
    VariantComparison v;
    v.name = table.text("name");
    v.results = table.text("results");
    v.study_toml = table.text("study_toml");
    v.pairs = table.count("pairs");
    v.invalid_base = table.count("invalid_base");
    v.invalid_variant = table.count("invalid_variant");
    v.dropped = table.count("dropped_pairs");
    const std::vector<std::string>&names = table.texts("limit_states"), &describe = table.texts("descriptions");
    const std::vector<std::int32_t>& damage = table.integers("damage", {names.size()});
    if (describe.size() != names.size())
        table.refuse("its limit states have no descriptions");
    if (names.empty())
        table.refuse("it has no limit state");
    table.counts("both", {names.size(), cells}); // as many places as there are numbers
    for (std::size_t i = 0; i < names.size(); ++i)
        v.limits.push_back({names[i], describe[i], damage[i] != 0, std::vector<PlaceComparison>(cells), {}, {}});
    std::vector<PlaceComparison*> places, overall;
    for (LimitComparison& limit : v.limits) {
        for (PlaceComparison& place : limit.cells)
            places.push_back(&place);
        overall.push_back(&limit.overall);
    }
    read_places(table, places, {names.size(), cells}, "");
    read_places(table, overall, {names.size()}, "overall_");
    read_motions(table, v.limits, cells);
    const std::vector<std::string>& inputs = table.texts("inputs");
    const std::vector<std::int32_t>& draws = table.integers("input_draws", {inputs.size()});
    const std::vector<std::uint64_t>& numbers = table.counts("input_numbers", {inputs.size()});
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (draws[i] < 0 || draws[i] > static_cast<std::int32_t>(CommonDraws::variant_only))
            table.refuse("an input is common in no known way");
        v.inputs.push_back({inputs[i], static_cast<CommonDraws>(draws[i]), numbers[i]});
    }
    v.notes = table.texts("notes");
    v.depends = dependences_of(table);
    return v;
}

} // namespace

std::vector<Table> tables_of(const Comparison& comparison)
{
    std::vector<Table> tables = {general_table(comparison)};
    for (std::size_t i = 0; i < comparison.variants.size(); ++i)
        tables.push_back(table_of(comparison.variants[i], i, comparison.cells()));
    return tables;
}

Comparison comparison_from(const std::vector<Table>& tables, const std::string& file)
{
    const auto named = [&](const std::string& name) -> const Table& { return table_named(tables, name, file); };
    const Table& general = named("comparison");
    Comparison c;
    c.kind = general.text("study_kind");
    c.title = general.text("title");
    c.base_name = general.text("base");
    c.base_results = general.text("base_results");
    c.base_toml = general.text("base_study_toml");
    c.level = general.number("level");
    c.rate = general.number("false_names");
    c.adjustment = general.text("adjustment");
    c.measure = general.text("measure");
    c.motions = general.count("motions");
    c.adaptive_budget = general.count("adaptive_budget");
    c.adaptive_margin = general.number("adaptive_margin");
    c.adaptive_rounds = general.count("adaptive_rounds");
    c.code_version = general.text("code_version");
    const auto axis = [&](const char* name) {
        return general.has(name) && general.shape(name).size() == 1 ? general.numbers(name, general.shape(name))
                                                                    : std::vector<double>{};
    };
    c.frequency_hz = axis("frequency_hz");
    c.pga_m_s2 = axis("pga_m_s2");
    c.intensity = axis("intensity");
    if (c.frequency_hz.empty() != c.pga_m_s2.empty())
        general.refuse("one axis of its surface is missing");
    if (general.texts("variants").empty())
        general.refuse("it has no variant");
    for (std::size_t i = 0; i < general.texts("variants").size(); ++i)
        c.variants.push_back(variant_of(named(variant_table + std::to_string(i)), c.cells()));
    return c;
}

void write_comparison(const Comparison& comparison, const std::filesystem::path& file)
{
    write_table_file(file, format, comparison.code_version, tables_of(comparison));
}

Comparison read_comparison(const std::filesystem::path& file)
{
    return comparison_from(read_table_file(file, format), file.string());
}

} // namespace stylobate
