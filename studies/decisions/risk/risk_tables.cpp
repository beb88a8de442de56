#include "studies/decisions/risk/risk_tables.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace stylobate {

namespace {

/// Every number of it, by the ending of its column: written and read by one list.
template <class Number, class Each>
void for_each_number(Each&& each)
{
    each(
        "", [](auto& n) -> auto& { return n.value; });
    each(
        "_lower", [](auto& n) -> auto& { return n.total.lower; });
    each(
        "_upper", [](auto& n) -> auto& { return n.total.upper; });
    each(
        "_fragility_lower", [](auto& n) -> auto& { return n.fragility.lower; });
    each(
        "_fragility_upper", [](auto& n) -> auto& { return n.fragility.upper; });
    if constexpr (std::is_same_v<Number, RiskNumber>) {
        each(
            "_hazard_lower", [](auto& n) -> auto& { return n.hazard.lower; });
        each(
            "_hazard_upper", [](auto& n) -> auto& { return n.hazard.upper; });
        each(
            "_fragility_part", [](auto& n) -> auto& { return n.fragility_part; });
    }
}

} // namespace

template <class Number>
void add_numbers(Table& table, const std::string& name, const std::vector<Number>& numbers, const std::string& unit)
{
    for_each_number<Number>([&](const std::string& ending, auto&& of) {
        std::vector<double> values;
        for (const Number& n : numbers)
            values.push_back(of(n));
        table.add(name + ending, std::move(values), {numbers.size()}, ending == "_fragility_part" ? "" : unit);
    });
}
template void add_numbers(Table&, const std::string&, const std::vector<RiskNumber>&, const std::string&);
template void add_numbers(Table&, const std::string&, const std::vector<ChangeNumber>&, const std::string&);

template <class Number>
std::vector<Number> numbers_of(const Table& table, const std::string& name, const Table::Shape& shape)
{
    std::vector<Number> numbers;
    for_each_number<Number>([&](const std::string& ending, auto&& of) {
        const std::vector<double>& values = table.numbers(name + ending, shape);
        numbers.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            of(numbers[i]) = values[i];
    });
    return numbers;
}
template std::vector<RiskNumber> numbers_of(const Table&, const std::string&, const Table::Shape&);
template std::vector<ChangeNumber> numbers_of(const Table&, const std::string&, const Table::Shape&);

double level_of(const Table& table, const char* name)
{
    const double level = table.number(name);
    if (!(level > 0 && level < 1))
        table.refuse("a level of its intervals is not between 0 and 1");
    return level;
}

std::vector<double> years_of(const Table& table)
{
    const std::vector<double>& years = table.numbers("years", table.shape("years"));
    if (years.empty() || !std::ranges::all_of(years, [](double y) { return y > 0 && std::isfinite(y); }))
        table.refuse("its years are not above 0 and finite");
    return years;
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
