#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/suggest.hpp"
#include "io/hazard/hazard_measure.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

namespace {

/// What a column after the first one is: the best estimate, or a fractile.
struct Column {
    std::string name;
    double fractile = 0; ///< 0: the best estimate
};

Column column_of(const std::string& file, const CsvLine& head, std::size_t field)
{
    const std::string name(head.fields[field]);
    if (name == "annual_frequency")
        return {name, 0};
    if (name == "low")
        return {name, 0.05};
    if (name == "high")
        return {name, 0.95};
    if (name.starts_with("fractile_"))
        if (const auto value = hazard_number(std::string_view(name).substr(9)); value && *value > 0 && *value < 1)
            return {name, *value};
    const std::string meant = nearest_word(name, {"annual_frequency", "low", "high"});
    throw InputError(file, head.number,
                     fmt::format("the column '{}' is not known.{}\n  After the intensity: annual_frequency, low and "
                                 "high (the fractiles 0.05 and 0.95), or fractile_0.16 and others between 0 and 1.",
                                 name.substr(0, 40), meant.empty() ? "" : fmt::format(" Did you mean {}?", meant)));
}

} // namespace

RawHazard csv_hazard(const std::string& file, std::string_view text)
{
    RawHazard raw;
    HazardModel& hazard = raw.hazard;
    hazard.source = file;
    HazardMeasure measure;
    std::string column; // of the intensity
    std::vector<Column> columns;
    for_each_csv_line(text, [&](const CsvLine& line) {
        if (measure.name.empty()) {
            measure = measure_of_column(line.fields[0]);
            if (measure.name.empty())
                throw InputError(file, line.number,
                                 fmt::format("the first column '{}' is no intensity measure with its unit.\n  Known: "
                                             "{}; then annual_frequency.",
                                             line.fields[0].substr(0, 40), known_hazard_measures()));
            column = line.fields[0];
            for (std::size_t f = 1; f < line.fields.size(); ++f)
                columns.push_back(column_of(file, line, f));
            if (columns.empty())
                throw InputError(file, line.number, "has no column after the intensity.\n  Give annual_frequency.");
            for (const Column& given : columns)
                if (given.fractile > 0)
                    hazard.fractiles.push_back({given.fractile, {}});
            return;
        }
        if (line.fields.size() != columns.size() + 1)
            throw InputError(file, line.number,
                             fmt::format("has {} fields, the header {}.", line.fields.size(), columns.size() + 1));
        const auto number = [&](std::size_t field, const std::string& name) {
            const double value = csv_number(file, line, field, name);
            if (std::isnan(value))
                throw InputError(file, line.number,
                                 fmt::format("{} is empty.\n  Leave out the whole line, or the column.", name));
            return value;
        };
        hazard.intensity.push_back(number(0, "intensity") * measure.per_unit);
        raw.names.push_back(fmt::format("{} = {}", column, line.fields[0]));
        raw.lines.push_back(line.number);
        for (std::size_t f = 0, fractile = 0; f < columns.size(); ++f) {
            const double value = number(f + 1, columns[f].name);
            (columns[f].fractile > 0 ? hazard.fractiles[fractile++].frequency : hazard.frequency).push_back(value);
        }
    });
    if (measure.name.empty())
        throw InputError(file, 0,
                         "is empty.\n  Give a header such as pga_g,annual_frequency and a line for each "
                         "intensity.");
    if (hazard.intensity.empty())
        throw InputError(file, 0, "has no line below its header.\n  Give a line for each intensity.");
    if (hazard.frequency.size() > hazard.intensity.size())
        throw InputError(file, 0, "has the column annual_frequency twice.");
    hazard.measure = measure.name;
    return raw;
}

} // namespace stylobate
