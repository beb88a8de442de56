#include "io/measured/measured_columns.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace stylobate {
namespace {

/// The word of [columns] for a column that is not read.
constexpr const char* not_read = "ignore";

Dimension dimension_of(const MeasuredColumn& column)
{
    return column.series ? column.series->dimension : !column.gauge.empty() ? Dimension::force : Dimension::time;
}

std::optional<double> unit_of_any_case(std::string_view spelled, Dimension dimension)
{
    const auto si = unit_in_si(spelled, dimension);
    return si ? si : unit_in_si(lower_case(spelled), dimension);
}

/// The unit in a name of another program: "Marker3 X [mm]", "force (N)", "time_ms"; empty: none.
std::string_view unit_in_header(std::string_view name, Dimension dimension)
{
    constexpr std::array all = {Dimension::time,         Dimension::length, Dimension::angle,
                                Dimension::acceleration, Dimension::mass,   Dimension::force};
    for (const char* brackets : {"[]", "()"})
        if (const std::size_t open = name.rfind(brackets[0]), close = name.rfind(brackets[1]);
            open != std::string_view::npos && close != std::string_view::npos && close > open) {
            const std::string_view inside = name.substr(open + 1, close - open - 1);
            if (std::ranges::any_of(all, [&](Dimension d) { return unit_of_any_case(inside, d).has_value(); }))
                return inside;
        }
    for (std::size_t line = name.find_first_of("_ "); line != std::string_view::npos;
         line = name.find_first_of("_ ", line + 1))
        if (unit_in_si(name.substr(line + 1), dimension))
            return name.substr(line + 1);
    return {};
}

std::optional<MeasuredColumn> with_unit(MeasuredColumn column, std::string_view unit)
{
    const auto si = unit_in_si(unit, dimension_of(column));
    if (!si)
        return std::nullopt;
    column.factor = *si;
    column.unit = unit;
    return column;
}

} // namespace

std::optional<MeasuredColumn> column_of(std::string_view spelled, int version)
{
    const std::string lower = lower_case(spelled);
    const std::string_view name = lower;
    if (name.starts_with("time_"))
        return with_unit({}, name.substr(5));
    if (constexpr std::string_view force = "force_"; version >= 2 && name.starts_with(force)) {
        const std::size_t line = name.rfind('_');
        if (line <= force.size())
            return std::nullopt;
        MeasuredColumn column;
        column.gauge = name.substr(force.size(), line - force.size());
        return with_unit(column, name.substr(line + 1));
    }
    for (const SeriesName& series : series_names()) {
        if (series.since > version || !name.starts_with(series.column))
            continue;
        std::string_view rest = name.substr(std::string_view(series.column).size());
        MeasuredColumn column;
        column.series = &series;
        if (series.per_block) {
            constexpr std::size_t most_digits = 5;
            const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
            if (digits == 0 || digits > most_digits)
                continue;
            std::from_chars(rest.data(), rest.data() + digits, column.block);
            rest.remove_prefix(digits);
        }
        if (!rest.starts_with('_'))
            continue;
        if (auto found = with_unit(column, rest.substr(1)))
            return found;
    }
    return std::nullopt;
}

ColumnMap::ColumnMap(const TomlValue* columns, const KeyReader& table, int version) : version_(version)
{
    for (const TomlValue& value : columns ? columns->entries : std::vector<TomlValue>()) {
        const std::string& name = value.key;
        const std::string spelled = table.text(name);
        if (spelled == not_read) {
            entries_.push_back({name, {.left = true}});
            continue;
        }
        const auto column = column_of(spelled, version);
        if (!column)
            table.refuse(name, "is no name of a column", remedy(spelled, {}));
        const Dimension dimension = dimension_of(*column);
        const std::string_view unit = unit_in_header(name, dimension);
        if (!unit.empty() && unit_of_any_case(unit, dimension) != column->factor)
            table.refuse(name, fmt::format("has the unit {}, but the column is named in {}", column->unit, unit),
                         "Write the unit in which its values are.");
        entries_.push_back({name, *column});
    }
}

MeasuredColumn ColumnMap::find(std::string_view name, const std::string& file, long line,
                               const std::vector<ForceGauge>& gauges)
{
    std::optional<MeasuredColumn> column;
    if (const auto entry = std::ranges::find(entries_, name, &Entry::name); entry != entries_.end()) {
        entry->used = true;
        column = entry->column;
    } else {
        column = column_of(name, version_);
    }
    if (!column)
        throw InputError(file, line,
                         fmt::format("the column \"{}\" is not known, or its unit is not.\n  {}", name.substr(0, 60),
                                     remedy(name, gauges)));
    if (!column->gauge.empty() &&
        std::ranges::none_of(gauges, [&](const ForceGauge& gauge) { return lower_case(gauge.name) == column->gauge; }))
        throw InputError(file, line,
                         fmt::format("the column \"{}\" is of a gauge \"{}\" that the run does not have.\n  Add a "
                                     "[[run.force]] with that name, block and height_m.",
                                     name.substr(0, 60), column->gauge));
    return *column;
}

std::vector<std::string> ColumnMap::unused() const
{
    std::vector<std::string> names;
    for (const Entry& entry : entries_)
        if (!entry.used)
            names.push_back(entry.name);
    return names;
}

/// What to do about a column that is not known. The unit of the file is kept: with another one its values would be
/// others by a factor.
std::string ColumnMap::remedy(std::string_view name, const std::vector<ForceGauge>& gauges) const
{
    if (!entries_.empty()) {
        std::vector<std::string> mapped;
        for (const Entry& entry : entries_)
            mapped.push_back(entry.name);
        if (const auto meant = nearest_word(name, mapped))
            return fmt::format("Did you mean \"{}\", as [columns] has it?", *meant);
    }
    std::vector<std::string> known = {"time_s"};
    for (const SeriesName& series : series_names())
        if (series.since <= version_)
            known.push_back(fmt::format("{}{}{}", series.column, series.per_block ? "0" : "", series.suffix));
    for (const ForceGauge& gauge : gauges)
        known.push_back(fmt::format("force_{}_n", lower_case(gauge.name)));
    const std::string lower = lower_case(name);
    std::vector<std::string> in_its_unit;
    for (const std::string& column : known)
        for (std::size_t line = lower.find('_'); line != std::string::npos; line = lower.find('_', line + 1))
            if (std::string same_unit = std::string(without_unit(column)) + lower.substr(line);
                column_of(same_unit, version_))
                in_its_unit.push_back(std::move(same_unit));
    if (const auto meant = meant_key(lower, in_its_unit))
        return fmt::format("Did you mean {}? The unit is part of the name.", *meant);
    const auto meant = meant_key(lower, known);
    const char* map =
        version_ < 2
            ? ""
            : " Names of another program are given in [columns] of campaign.toml, \"ignore\" leaves a column out.";
    if (!meant)
        return fmt::format("Columns are {}. The unit is part of the name.{}", fmt::join(known, ", "), map);
    const std::optional<MeasuredColumn> column = column_of(*meant, version_);
    return fmt::format(
        "Did you mean {}? The unit is part of the name, and the values must be in it: known units are {}.", *meant,
        known_units(column ? dimension_of(*column) : Dimension::time));
}

} // namespace stylobate
