#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stylobate {

namespace {

/// The value of KEY=VALUE or KEY='VALUE' in OpenQuake's comment; nullopt if it is not there.
std::optional<std::string> of_comment(std::string_view comment, std::string_view key)
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
    return std::nullopt;
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

RawHazard openquake_hazard(const std::string& file, std::string_view text, const std::optional<std::string>& site)
{
    const std::string_view comment = first_line(text);
    const std::string imt = of_comment(comment, "imt").value_or(""), kind = of_comment(comment, "kind").value_or("");
    const auto years = hazard_number(of_comment(comment, "investigation_time").value_or(""));
    if (!years || !(*years > 0))
        throw InputError(file, 1,
                         "the comment has no investigation_time above 0, which the probabilities are of.\n  "
                         "Take the file as OpenQuake exports it.");
    const auto measure = measure_of_openquake(imt);
    if (!measure)
        throw InputError(file, 1, fmt::format("imt = '{}' is none of PGA, SA(period), PGV, PGD, IA, CAV.", imt));

    RawHazard raw;
    HazardModel& hazard = raw.hazard;
    hazard.source = file;
    hazard.measure = measure->name;
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
                    hazard.intensity.push_back(*iml * measure->per_unit);
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

namespace {

/// Without the prefix of its name space.
std::string_view local_name(pugi::xml_node node)
{
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_named(pugi::xml_node parent, std::string_view name)
{
    for (const pugi::xml_node child : parent.children())
        if (local_name(child) == name)
            return child;
    return {};
}

class NrmlHazard {
public:
    NrmlHazard(const std::string& file, const std::string& text) : file_(file), text_(text)
    {
        const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
        if (!result)
            throw InputError(file_, line(result.offset), fmt::format("no XML: {}.", result.description()));
    }

    RawHazard read(const std::optional<std::string>& site)
    {
        const pugi::xml_node root = document_.document_element();
        const pugi::xml_node curves = local_name(root) == "nrml" ? child_named(root, "hazardCurves") : pugi::xml_node();
        if (!curves)
            refuse(root,
                   fmt::format("<{}> contains no <hazardCurves>.\n  Take the hazard curves that OpenQuake exports "
                               "as NRML.",
                               root.name()));
        std::string imt = attribute(curves, "IMT");
        if (imt == "SA")
            imt = "SA(" + attribute(curves, "saPeriod") + ")";
        const auto measure = measure_of_openquake(imt);
        if (!measure)
            refuse(curves, fmt::format("IMT = '{}' is none of PGA, SA, PGV, PGD, IA, CAV.", imt));
        const auto years = hazard_number(attribute(curves, "investigationTime"));
        if (!years || !(*years > 0))
            refuse(curves, fmt::format("investigationTime = '{}' is not a number of years above 0.",
                                       attribute(curves, "investigationTime")));
        RawHazard raw;
        raw.hazard.source = file_;
        raw.hazard.measure = measure->name;
        const pugi::xml_node imls = child_named(curves, "IMLs");
        if (!imls)
            refuse(curves, "has no <IMLs>.");
        for (const double iml : numbers(imls)) {
            raw.hazard.intensity.push_back(iml * measure->per_unit);
            raw.names.push_back(fmt::format("IML {:g}", iml));
        }
        std::vector<pugi::xml_node> nodes;
        std::vector<HazardSite> sites;
        for (const pugi::xml_node curve : curves.children())
            if (local_name(curve) == "hazardCurve") {
                nodes.push_back(curve);
                sites.push_back(place(curve));
            }
        const std::size_t chosen = chosen_site(file_, sites, site);
        raw.hazard.site = sites[chosen].name();
        std::vector<double> frequency = frequencies(nodes[chosen], raw, *years);
        const std::string statistics = curves.attribute("statistics").value();
        if (statistics == "quantile") {
            const auto probability = hazard_number(attribute(curves, "quantileValue"));
            if (!probability || !(*probability > 0 && *probability < 1))
                refuse(curves,
                       fmt::format("quantileValue = '{}' is not between 0 and 1.", attribute(curves, "quantileValue")));
            raw.hazard.fractiles.push_back({*probability, std::move(frequency)});
        } else {
            raw.hazard.frequency = std::move(frequency);
        }
        return raw;
    }

private:
    std::vector<double> frequencies(pugi::xml_node curve, RawHazard& raw, double years) const
    {
        const pugi::xml_node poes = child_named(curve, "poEs");
        if (!poes)
            refuse(curve, "has no <poEs>.");
        const std::vector<double> values = numbers(poes);
        if (values.size() != raw.hazard.intensity.size())
            refuse(poes,
                   fmt::format("has {} probabilities at {} intensities.", values.size(), raw.hazard.intensity.size()));
        const long at = line(poes.offset_debug());
        raw.lines.assign(values.size(), at);
        std::vector<double> frequency;
        for (std::size_t i = 0; i < values.size(); ++i)
            frequency.push_back(annual_frequency(file_, at, "poE at " + raw.names[i], values[i], years));
        return frequency;
    }

    HazardSite place(pugi::xml_node curve) const
    {
        const pugi::xml_node position = child_named(child_named(curve, "Point"), "pos");
        if (!position)
            refuse(curve, "has no <gml:Point> with <gml:pos>.");
        const std::vector<double> values = numbers(position);
        if (values.size() < 2)
            refuse(position, "is no longitude and latitude.");
        return {values[0], values[1]};
    }

    long line(std::ptrdiff_t offset) const
    {
        const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
        return 1 + std::count(text_.begin(), text_.begin() + end, '\n');
    }
    [[noreturn]] void refuse(pugi::xml_node node, const std::string& text) const
    {
        throw InputError(file_, line(node.offset_debug()), text);
    }
    std::string attribute(pugi::xml_node node, const char* name) const
    {
        if (!node.attribute(name))
            refuse(node, fmt::format("<{}> has no attribute '{}'.", node.name(), name));
        return node.attribute(name).value();
    }
    std::vector<double> numbers(pugi::xml_node node) const
    {
        std::vector<double> values;
        std::istringstream words(node.text().get());
        for (std::string word; words >> word;) {
            const auto value = hazard_number(word);
            if (!value)
                refuse(node, fmt::format("'{}' in <{}> is not a number.", word.substr(0, 40), node.name()));
            values.push_back(*value);
        }
        return values;
    }

    const std::string& file_;
    const std::string& text_;
    pugi::xml_document document_;
};

} // namespace

RawHazard nrml_hazard(const std::string& file, const std::string& text, const std::optional<std::string>& site)
{
    return NrmlHazard(file, text).read(site);
}

} // namespace stylobate
