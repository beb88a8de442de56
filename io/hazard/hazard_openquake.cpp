#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/hazard/hazard_measure.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

namespace {

/// The value of KEY=VALUE or KEY='VALUE' in OpenQuake's comment; empty: it is not there.
std::string of_comment(std::string_view comment, std::string_view key)
{
    for (std::size_t at = comment.find(key); at != std::string_view::npos; at = comment.find(key, at + 1)) {
        std::string_view rest = comment.substr(at + key.size());
        if ((at > 0 && (std::isalnum(static_cast<unsigned char>(comment[at - 1])) || comment[at - 1] == '_')) ||
            !rest.starts_with('='))
            continue;
        rest.remove_prefix(1);
        if (rest.starts_with('\'')) {
            rest.remove_prefix(1);
            return std::string(rest.substr(0, rest.find('\'')));
        }
        return std::string(rest.substr(0, rest.find_first_of(",\" \r")));
    }
    return {};
}

std::string_view first_line(std::string_view text)
{
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    return text.substr(0, text.find('\n'));
}

} // namespace

bool is_openquake_hazard(std::string_view text)
{
    const std::string_view line = first_line(text);
    return (line.starts_with('#') || line.starts_with("\"#")) && line.find("imt") != std::string_view::npos;
}

RawHazard openquake_hazard(const std::string& file, std::string_view text, const std::string& site)
{
    const std::string_view comment = first_line(text);
    const std::string imt = of_comment(comment, "imt"), kind = of_comment(comment, "kind");
    const auto years = hazard_number(of_comment(comment, "investigation_time"));
    if (!years || !(*years > 0))
        throw InputError(file, 1,
                         "the comment has no investigation_time above 0, which the probabilities are of.\n  "
                         "Take the file as OpenQuake exports it.");
    const HazardMeasure measure = measure_of_openquake(imt);
    if (measure.name.empty())
        throw InputError(file, 1, fmt::format("imt = '{}' is none of PGA, SA(period), PGV, PGD, IA, CAV.", imt));

    RawHazard raw;
    HazardModel& hazard = raw.hazard;
    hazard.source = file;
    hazard.measure = measure.name;
    std::size_t lon = ~std::size_t{0}, lat = lon;
    std::vector<std::size_t> fields;
    std::vector<HazardSite> sites;
    std::vector<std::vector<double>> poes;
    std::vector<long> lines;
    for_each_csv_line(text, [&](const CsvLine& line) {
        if (fields.empty()) {
            for (std::size_t f = 0; f < line.fields.size(); ++f) {
                const std::string_view name = line.fields[f];
                if (name == "lon")
                    lon = f;
                else if (name == "lat")
                    lat = f;
                else if (name.starts_with("poe-")) {
                    const auto iml = hazard_number(name.substr(4));
                    if (!iml)
                        throw InputError(file, line.number, fmt::format("the column '{}' has no intensity.", name));
                    fields.push_back(f);
                    raw.names.emplace_back(name);
                    hazard.intensity.push_back(*iml * measure.per_unit);
                }
            }
            if (fields.empty() || std::max(lon, lat) >= line.fields.size())
                throw InputError(file, line.number,
                                 "the header has no columns lon, lat and poe-INTENSITY.\n  Take the "
                                 "file as OpenQuake exports it.");
            return;
        }
        if (line.fields.size() <= std::max({lon, lat, fields.back()}))
            throw InputError(file, line.number, "has fewer fields than the header.");
        sites.push_back({csv_number(file, line, lon, "lon"), csv_number(file, line, lat, "lat")});
        lines.push_back(line.number);
        poes.emplace_back();
        for (std::size_t i = 0; i < fields.size(); ++i)
            poes.back().push_back(csv_number(file, line, fields[i], raw.names[i]));
    });
    const std::size_t chosen = chosen_site(file, sites, site);
    hazard.site = sites[chosen].name();
    raw.lines.assign(hazard.intensity.size(), lines[chosen]);
    std::vector<double> frequency;
    for (std::size_t i = 0; i < poes[chosen].size(); ++i)
        frequency.push_back(annual_frequency(file, lines[chosen], raw.names[i], poes[chosen][i], *years));
    if (kind.starts_with("quantile-")) {
        const auto probability = hazard_number(std::string_view(kind).substr(9));
        if (!probability || !(*probability > 0 && *probability < 1))
            throw InputError(file, 1, fmt::format("kind = '{}' is no quantile between 0 and 1.", kind));
        hazard.fractiles.push_back({*probability, std::move(frequency)});
    } else {
        hazard.frequency = std::move(frequency);
    }
    return raw;
}

} // namespace stylobate
