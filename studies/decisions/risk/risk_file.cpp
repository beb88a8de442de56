#include "studies/decisions/risk/risk_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/hdf5.hpp"
#include "io/hazard/hazard_parts.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/table_hdf5.hpp"

#include <fmt/format.h>

#include <utility>

namespace stylobate {

namespace {

constexpr char format_name[] = "stylobate-risk";
constexpr std::uint64_t format_version = 1;

/// The columns of a number with all its limits.
void add_numbers(Table& table, const std::string& name, const std::vector<RiskNumber>& numbers)
{
    const auto column = [&](const std::string& ending, auto&& of) {
        std::vector<double> values;
        for (const RiskNumber& n : numbers)
            values.push_back(of(n));
        table.add(name + ending, std::move(values), {numbers.size()}, "1/year");
    };
    column("", [](const RiskNumber& n) { return n.value; });
    column("_lower", [](const RiskNumber& n) { return n.total.lower; });
    column("_upper", [](const RiskNumber& n) { return n.total.upper; });
    column("_fragility_lower", [](const RiskNumber& n) { return n.fragility.lower; });
    column("_fragility_upper", [](const RiskNumber& n) { return n.fragility.upper; });
    column("_hazard_lower", [](const RiskNumber& n) { return n.hazard.lower; });
    column("_hazard_upper", [](const RiskNumber& n) { return n.hazard.upper; });
    std::vector<double> parts;
    for (const RiskNumber& n : numbers)
        parts.push_back(n.fragility_part);
    table.add(name + "_fragility_part", std::move(parts));
}

std::vector<RiskNumber> numbers_of(const Table& table, const std::string& name, const Table::Shape& shape)
{
    const auto column = [&](const char* ending) -> const std::vector<double>& {
        return table.numbers(name + ending, shape);
    };
    const auto &value = column(""), &lower = column("_lower"), &upper = column("_upper"),
               &fragility_lower = column("_fragility_lower"), &fragility_upper = column("_fragility_upper"),
               &hazard_lower = column("_hazard_lower"), &hazard_upper = column("_hazard_upper"),
               &part = column("_fragility_part");
    std::vector<RiskNumber> numbers;
    for (std::size_t i = 0; i < value.size(); ++i)
        numbers.push_back({value[i],
                           {lower[i], upper[i]},
                           {fragility_lower[i], fragility_upper[i]},
                           {hazard_lower[i], hazard_upper[i]},
                           part[i]});
    return numbers;
}

// ---- /hazard --------------------------------------------------------------------------------------------------------

Table hazard_table(const HazardModel& hazard)
{
    Table table("hazard");
    table.set("source", hazard.source);
    table.set("site", hazard.site);
    table.set("measure", hazard.measure);
    table.set("unbounded", std::uint64_t{hazard.unbounded});
    table.add("intensity_" + hazard.measure, hazard.intensity);
    table.add("annual_frequency", hazard.frequency, {hazard.frequency.size()}, "1/year");
    for (const HazardFractile& f : hazard.fractiles)
        table.add(fmt::format("fractile_{}", f.probability), f.frequency, {f.frequency.size()}, "1/year");
    return table;
}

HazardModel hazard_of(const Table& table)
{
    HazardModel hazard;
    hazard.source = table.text("source");
    hazard.site = table.text("site");
    hazard.measure = table.text("measure");
    hazard.unbounded = table.count("unbounded") != 0;
    const std::string intensity = "intensity_" + hazard.measure;
    const Table::Shape shape = table.shape(intensity);
    if (shape.size() != 1 || shape[0] < 2)
        table.refuse("its hazard is no list");
    hazard.intensity = table.numbers(intensity, shape);
    hazard.frequency = table.numbers("annual_frequency", shape);
    for (const Table::Column& column : table.columns())
        if (column.name.starts_with("fractile_")) {
            const auto probability = hazard_number(std::string_view(column.name).substr(9));
            if (!probability || !(*probability > 0 && *probability < 1))
                table.refuse("a fractile of its hazard has no probability");
            hazard.fractiles.push_back({*probability, table.numbers(column.name, shape)});
        }
    return checked_hazard({std::move(hazard), {}, {}});
}

// ---- /states, /disaggregation, /fragility ---------------------------------------------------------------------------

Table states_table(const Risk& risk)
{
    std::vector<std::string> states, meanings, forms, notes;
    std::vector<std::int32_t> chosen, determined;
    std::vector<RiskNumber> frequency;
    std::vector<double> below, above, beyond, lowest, highest, unseen;
    for (const StateRisk& s : risk.states) {
        states.push_back(s.state);
        meanings.push_back(s.meaning);
        forms.emplace_back(to_string(s.form));
        notes.push_back(s.note);
        chosen.push_back(s.chosen);
        determined.push_back(s.determined);
        frequency.push_back(s.estimate.frequency);
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
    const std::vector<RiskNumber> frequency = numbers_of(states, "annual_frequency", shape);
    const auto &below = states.numbers("share_below", shape), &above = states.numbers("share_above", shape),
               &beyond = states.numbers("share_beyond_hazard", shape),
               &lowest = states.numbers("lowest_annual_frequency", shape),
               &highest = states.numbers("highest_annual_frequency", shape),
               &unseen = states.numbers("unseen_annual_frequency", shape);
    std::vector<StateRisk> found;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const FragilityForm form =
            forms[i] == to_string(FragilityForm::shares) ? FragilityForm::shares : FragilityForm::lognormal;
        found.push_back({names[i],
                         meanings[i],
                         form,
                         chosen[i] != 0,
                         determined[i] != 0,
                         notes[i],
                         FrequencyEstimate{
                             form, frequency[i], {}, below[i], above[i], beyond[i], {lowest[i], highest[i]}, unseen[i]},
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
    const std::vector<RiskNumber> numbers = numbers_of(parts, "annual_frequency", all);
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

std::vector<Table> tables_of(const Risk& risk)
{
    std::vector<Table> tables{hazard_table(risk.hazard), states_table(risk), parts_table(risk),
                              fragility_points_table(risk)};
    if (risk.sequences)
        tables.push_back(sequences_table(*risk.sequences));
    return tables;
}

} // namespace

void write_risk(const Risk& risk, const std::filesystem::path& file)
{
    try {
        hdf5::Handle made = hdf5::create_file(file, 0);
        hdf5::write_text(made.id(), "format", format_name);
        hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, format_version);
        hdf5::write_text(made.id(), "code_version", risk.code_version);
        hdf5::write_text(made.id(), "title", risk.title);
        hdf5::write_text(made.id(), "fragility_file", risk.fragility_file);
        hdf5::write_text(made.id(), "study_toml", risk.study_text);
        hdf5::write_real(made.id(), "level", risk.level);
        hdf5::write_real(made.id(), "fragility_level", risk.fragility_level);
        hdf5::write_real(made.id(), "most_outside", risk.most_outside);
        hdf5::write_array(made.id(), "years", risk.years, {risk.years.size()}, "year");
        hdf5::write_texts(made.id(), "notes", risk.says);
        for (const Table& table : tables_of(risk))
            write_table(made.id(), table);
        made.close();
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    }
}

Risk read_risk(const std::filesystem::path& file)
{
    try {
        const hdf5::Handle open = hdf5::open_file(file, false);
        const hid_t root = open.id();
        if (!hdf5::has_attribute(root, "format") || hdf5::read_any_text(root, "format") != format_name)
            throw InputError(file.string(), 0, "contains no risk estimate");
        if (const std::uint64_t version = hdf5::read_number(root, "format_version"); version != format_version)
            throw InputError(file.string(), 0,
                             fmt::format("is a risk estimate of format version {}; this program reads version {}. "
                                         "Compute it again.",
                                         version, format_version));
        Risk risk;
        risk.code_version = hdf5::read_text(root, "code_version");
        risk.title = hdf5::read_text(root, "title");
        risk.fragility_file = hdf5::read_text(root, "fragility_file");
        risk.study_text = hdf5::read_text(root, "study_toml");
        risk.level = hdf5::read_any_number(root, "level");
        risk.fragility_level = hdf5::read_any_number(root, "fragility_level");
        risk.most_outside = hdf5::read_any_number(root, "most_outside");
        risk.years = hdf5::read_doubles(root, "years", hdf5::dims_of(root, "years"));
        risk.says = hdf5::read_texts(root, "notes", hdf5::dims_of(root, "notes"));
        const auto table = [&](const char* name) { return read_table(root, name, file.string()); };
        risk.hazard = hazard_of(table("hazard"));
        risk.states = states_of(table("states"), table("disaggregation"), table("fragility"), risk.hazard.measure);
        if (risk.chosen().empty())
            throw hdf5::Error("it has no limit state");
        if (hdf5::exists(root, "sequences"))
            risk.sequences = sequences_of(table("sequences"));
        return risk;
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("is a damaged risk estimate: ") + error.what());
    }
}

std::vector<std::pair<std::string, std::string>> risk_csv(const Risk& risk)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const Table& table : tables_of(risk))
        if (!table.columns().empty())
            files.emplace_back(table.name() + ".csv", csv_text(table));
    return files;
}

} // namespace stylobate
