#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/quantiles.hpp"
#include "io/hazard/hazard_measure.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace stylobate {

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
    HazardMeasure measure = measure_of_column(values["measure"]);
    if (measure.name.empty())
        measure = measure_without_unit(values["measure"]);
    if (measure.name.empty())
        refuse(fmt::format("measure = '{}' is none of {}.", values["measure"], known_hazard_measures()));
    RawHazard raw;
    HazardModel& hazard = raw.hazard;
    hazard.source = given;
    hazard.measure = measure.name;
    hazard.unbounded = true;
    hazard.intensity = {measure.per_unit, 10 * measure.per_unit};
    hazard.frequency = {k0, k0 * std::pow(10, -k)};
    if (values.contains("sigma_ln"))
        for (const double probability : {0.05, 0.95}) {
            const double factor = std::exp(normal_quantile(probability) * number("sigma_ln", 1e-6, 5));
            hazard.fractiles.push_back({probability, {k0 * factor, k0 * factor * std::pow(10, -k)}});
        }
    return raw;
}

} // namespace stylobate
