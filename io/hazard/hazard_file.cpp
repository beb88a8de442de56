#include "io/hazard/hazard_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/hazard/hazard_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace stylobate {

namespace {

constexpr std::uint64_t most_bytes = 1 << 28;

/// A curve of a file, or a power law.
RawHazard read_one(const std::string& given, const std::string& site)
{
    std::error_code ignored;
    if (given.find('=') != std::string::npos && !std::filesystem::exists(given, ignored)) {
        if (!site.empty())
            throw InputError(fmt::format("--site {}: a power law is of one site; omit it.", site));
        return power_law_hazard(given);
    }
    const std::string text = csv_content(given, most_bytes);
    const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first != std::string::npos && text[first] == '<')
        return nrml_hazard(given, text, site);
    if (is_openquake_hazard(text))
        return openquake_hazard(given, text, site);
    if (!site.empty())
        throw InputError(fmt::format("--site {}: {} is a table of one site; omit it.", site, given));
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
        refuse(fmt::format("is of the site {}, not of {} as", from.site, to.site));
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

HazardModel read_hazard(const std::vector<std::string>& given, const std::string& measure, const std::string& site)
{
    if (given.empty())
        throw InputError("--hazard is missing.\n  Give a file with a hazard curve, or k0=1e-4,k=2.5,measure=pga_g.");
    RawHazard raw = read_one(given.front(), site);
    if (given.size() > 1)
        check_decrease(raw);
    for (std::size_t i = 1; i < given.size(); ++i) {
        RawHazard more = read_one(given[i], site);
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

} // namespace stylobate
