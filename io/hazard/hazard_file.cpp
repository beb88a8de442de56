#include "io/hazard/hazard_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/interval.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/suggest.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

namespace stylobate {

namespace {

constexpr std::uint64_t most_bytes = 1 << 28;

/// A curve of a file, or a power law.
RawHazard read_one(const std::string& given, const std::optional<std::string>& site)
{
    std::error_code ignored;
    if (given.find('=') != std::string::npos && !std::filesystem::exists(given, ignored)) {
        if (site)
            throw InputError(fmt::format("--site {}: a power law is of one site; omit it.", *site));
        return power_law_hazard(given);
    }
    const std::string text = csv_content(given, most_bytes);
    const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first != std::string::npos && text[first] == '<')
        return nrml_hazard(given, text, site);
    if (is_openquake_hazard(text))
        return openquake_hazard(given, text, site);
    if (site)
        throw InputError(fmt::format("--site {}: {} is a table of one site; omit it.", *site, given));
    return csv_hazard(given, text);
}

/// Fractiles, or the mean, of another file of the same site and measure.
void join(RawHazard& all, RawHazard more)
{
    HazardModel &to = all.hazard, &from = more.hazard;
    const auto refuse = [&](const std::string& text) {
        throw InputError(from.source, 0,
                         fmt::format("{} {}.\n  Several files are the mean and the fractiles of one "
                                     "hazard curve.",
                                     text, to.source));
    };
    if (to.unbounded || from.unbounded)
        refuse("is a power law or goes with one:");
    if (to.measure != from.measure)
        refuse(fmt::format("is of {}, not of {} as", from.measure, to.measure));
    if (to.site != from.site)
        refuse(fmt::format("is of the site {}, not of {} as", from.site.value_or(""), to.site.value_or("")));
    if (!std::equal(to.intensity.begin(), to.intensity.end(), from.intensity.begin(), from.intensity.end(),
                    [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(a); }))
        refuse("has other intensities than");
    if (!from.frequency.empty()) {
        if (!to.frequency.empty())
            refuse("has a mean, as");
        to.frequency = std::move(from.frequency);
    }
    for (HazardFractile& fractile : from.fractiles)
        to.fractiles.push_back(std::move(fractile));
    to.says.insert(to.says.end(), from.says.begin(), from.says.end());
}

} // namespace

HazardModel read_hazard(const std::vector<std::string>& given, const std::string& measure,
                        const std::optional<std::string>& site)
{
    if (given.empty())
        throw InputError("--hazard is missing.\n  Give a file with a hazard curve, or k0=1e-4,k=2.5,measure=pga_g.");
    const auto named = site && !site->empty() ? site : std::nullopt;
    RawHazard raw = read_one(given.front(), named);
    if (given.size() > 1)
        check_decrease(raw);
    for (std::size_t i = 1; i < given.size(); ++i) {
        RawHazard more = read_one(given[i], named);
        check_decrease(more);
        join(raw, std::move(more));
    }
    if (raw.hazard.measure != measure)
        throw InputError(fmt::format("{}: the hazard is of {}, the study of {}.\n  Give a hazard of that measure; a "
                                     "fragility study can be run by another one too (fragility.intensity.measure).",
                                     raw.hazard.source, raw.hazard.measure, measure));
    HazardModel hazard = checked_hazard(std::move(raw));
    hazard.source = fmt::format("{}", fmt::join(given, ", "));
    return hazard;
}

RawHazard power_law_hazard(const std::string& given)
{
    constexpr const char* form = "Give k0=1e-4,k=2.5,measure=pga_g and, if it is known, sigma_ln=0.5.";
    const auto refuse = [&](const std::string& text) -> void {
        throw InputError(fmt::format("--hazard {}: {}\n  {}", given, text, form));
    };
    std::map<std::string, std::string, std::less<>> values;
    for (std::size_t at = 0; at <= given.size();) {
        const std::size_t end = std::min(given.find(',', at), given.size());
        const std::string word = given.substr(at, end - at);
        const std::size_t sign = word.find('=');
        if (sign == std::string::npos)
            refuse(fmt::format("'{}' is no KEY=VALUE, and there is no file of this name.", word));
        const std::string key = word.substr(0, sign);
        if (key != "k0" && key != "k" && key != "measure" && key != "sigma_ln")
            refuse(fmt::format("'{}' is no part of a power law.", key));
        if (!values.emplace(key, word.substr(sign + 1)).second)
            refuse(fmt::format("{} is given twice.", key));
        at = end + 1;
    }
    const auto number = [&](const char* key, double least, double most) {
        const auto found = values.find(key);
        if (found == values.end())
            refuse(fmt::format("{} is missing.", key));
        const auto value = hazard_number(found->second);
        if (!value || !(*value >= least && *value <= most))
            refuse(fmt::format("{} = {} is outside [{}, {}].", key, found->second, least, most));
        return *value;
    };
    const double k0 = number("k0", 1e-100, 1e6), k = number("k", 0.01, 30);
    if (!values.contains("measure"))
        refuse("measure is missing.");
    std::optional<HazardMeasure> measure = measure_of_column(values["measure"]);
    if (!measure)
        measure = measure_without_unit(values["measure"]);
    if (!measure)
        refuse(fmt::format("measure = '{}' is none of {}.", values["measure"], known_hazard_measures()));
    RawHazard raw;
    HazardModel& hazard = raw.hazard;
    hazard.source = given;
    hazard.measure = measure->name;
    hazard.unbounded = true;
    hazard.intensity = {measure->per_unit, 10 * measure->per_unit};
    hazard.frequency = {k0, k0 * std::pow(10, -k)};
    if (values.contains("sigma_ln"))
        for (const double probability : {0.05, 0.95}) {
            const double factor = std::exp(normal_quantile(probability) * number("sigma_ln", 1e-6, 5));
            hazard.fractiles.push_back({probability, {k0 * factor, k0 * factor * std::pow(10, -k)}});
        }
    return raw;
}

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
    const auto meant = nearest_word(name, {"annual_frequency", "low", "high"});
    throw InputError(file, head.number,
                     fmt::format("the column '{}' is not known.{}\n  After the intensity: annual_frequency, low and "
                                 "high (the fractiles 0.05 and 0.95), or fractile_0.16 and others between 0 and 1.",
                                 name.substr(0, 40), meant ? fmt::format(" Did you mean {}?", *meant) : ""));
}

} // namespace

RawHazard csv_hazard(const std::string& file, std::string_view text)
{
    RawHazard raw;
    HazardModel& hazard = raw.hazard;
    hazard.source = file;
    std::optional<HazardMeasure> measure;
    std::string column; // of the intensity
    std::vector<Column> columns;
    for_each_csv_line(text, [&](const CsvLine& line) {
        if (!measure) {
            measure = measure_of_column(line.fields[0]);
            if (!measure)
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
        hazard.intensity.push_back(number(0, "intensity") * measure->per_unit);
        raw.names.push_back(fmt::format("{} = {}", column, line.fields[0]));
        raw.lines.push_back(line.number);
        for (std::size_t f = 0, fractile = 0; f < columns.size(); ++f) {
            const double value = number(f + 1, columns[f].name);
            (columns[f].fractile > 0 ? hazard.fractiles[fractile++].frequency : hazard.frequency).push_back(value);
        }
    });
    if (!measure)
        throw InputError(file, 0,
                         "is empty.\n  Give a header such as pga_g,annual_frequency and a line for each "
                         "intensity.");
    if (hazard.intensity.empty())
        throw InputError(file, 0, "has no line below its header.\n  Give a line for each intensity.");
    if (hazard.frequency.size() > hazard.intensity.size())
        throw InputError(file, 0, "has the column annual_frequency twice.");
    hazard.measure = measure->name;
    return raw;
}

} // namespace stylobate
