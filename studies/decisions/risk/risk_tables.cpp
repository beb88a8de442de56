#include "studies/decisions/risk/risk_tables.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

namespace stylobate {

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
    const Table::Shape& shape = table.shape(intensity);
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
    try {
        return checked_hazard({std::move(hazard), {}, {}});
    } catch (const InputError& error) { // it names what the hazard was read from, not this file
        table.refuse(fmt::format("its hazard is none: {}", error.what()));
    }
}

} // namespace stylobate
