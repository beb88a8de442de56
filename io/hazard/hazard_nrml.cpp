#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_measure.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <sstream>

namespace stylobate {

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

    RawHazard read(const std::string& site)
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
        const HazardMeasure measure = measure_of_openquake(imt);
        if (measure.name.empty())
            refuse(curves, fmt::format("IMT = '{}' is none of PGA, SA, PGV, PGD, IA, CAV.", imt));
        const auto years = hazard_number(attribute(curves, "investigationTime"));
        if (!years || !(*years > 0))
            refuse(curves, fmt::format("investigationTime = '{}' is not a number of years above 0.",
                                       attribute(curves, "investigationTime")));
        RawHazard raw;
        raw.hazard.source = file_;
        raw.hazard.measure = measure.name;
        const pugi::xml_node imls = child_named(curves, "IMLs");
        if (!imls)
            refuse(curves, "has no <IMLs>.");
        for (const double iml : numbers(imls)) {
            raw.hazard.intensity.push_back(iml * measure.per_unit);
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

RawHazard nrml_hazard(const std::string& file, const std::string& text, const std::string& site)
{
    return NrmlHazard(file, text).read(site);
}

} // namespace stylobate
