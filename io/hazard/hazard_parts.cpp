#include "io/hazard/hazard_parts.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "io/files/csv_fields.hpp"
#include "io/tables/fragility_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace stylobate {

namespace {

std::string point_name(const RawHazard& raw, std::size_t point)
{
    return raw.names.empty() ? fmt::format("intensity {:.6g}", raw.hazard.intensity[point]) : raw.names[point];
}

[[noreturn]] void refuse(const RawHazard& raw, std::size_t point, const std::string& text)
{
    throw InputError(raw.hazard.source, point < raw.lines.size() ? raw.lines[point] : 0, text);
}

std::string intensities(std::size_t count)
{
    return count == 1 ? "1 intensity" : fmt::format("{} intensities", count);
}

/// Points at the ends where a curve is 0 or infinite do not determine a frequency.
void drop_ends(RawHazard& raw)
{
    HazardModel& hazard = raw.hazard;
    std::vector<std::vector<double>*> curves = {&hazard.frequency};
    for (HazardFractile& f : hazard.fractiles)
        curves.push_back(&f.frequency);
    const auto all = [&](std::size_t i, auto&& holds) {
        return std::all_of(curves.begin(), curves.end(), [&](const auto* curve) { return holds((*curve)[i]); });
    };
    std::size_t begin = 0, end = hazard.intensity.size();
    while (begin < end && !all(begin, [](double f) { return std::isfinite(f); }))
        ++begin;
    while (end > begin && !all(end - 1, [](double f) { return f != 0; }))
        --end;
    const auto cut = [&](auto& values) {
        if (values.empty())
            return;
        values.erase(values.begin() + static_cast<std::ptrdiff_t>(end), values.end());
        values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(begin));
    };
    if (begin > 0)
        hazard.says.push_back(fmt::format("Left out at the lower end of the hazard: {} with a probability of "
                                          "exceedance of 1, which has no finite frequency.",
                                          intensities(begin)));
    if (end < hazard.intensity.size())
        hazard.says.push_back(fmt::format("Left out at the upper end of the hazard: {} with a frequency of 0{}.",
                                          intensities(hazard.intensity.size() - end),
                                          curves.size() > 1 ? ", of the best estimate or of a fractile" : ""));
    for (auto* curve : curves)
        cut(*curve);
    cut(hazard.intensity);
    cut(raw.lines);
    cut(raw.names);
}

std::string increase_text(const std::string& name, const RawHazard& raw, const std::vector<double>& curve,
                          std::size_t point)
{
    return fmt::format("{} = {:.6g} at {} is above {:.6g} at the weaker one before it: a hazard curve decreases.\n  "
                       "Give frequencies of exceedance, in the order of the intensities.",
                       name, curve[point], point_name(raw, point), curve[point - 1]);
}

void check_intensities(const RawHazard& raw)
{
    constexpr double closest = 1e-6; // between two points: the slope is a difference of logarithms over another one
    const std::vector<double>& x = raw.hazard.intensity;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0) || (i > 0 && !(x[i] > x[i - 1])))
            refuse(raw, i,
                   fmt::format("{} is not above {}: intensities ascend from above 0.\n  Sort the lines by their "
                               "intensity, each once.",
                               point_name(raw, i), i == 0 ? "0" : point_name(raw, i - 1) + " before it"));
        if (!std::isfinite(x[i]))
            refuse(raw, i,
                   fmt::format("{} is not finite in SI units.\n  Give the intensity in its unit.", point_name(raw, i)));
        if (i > 0 && !(x[i] - x[i - 1] >= closest * x[i]))
            refuse(raw, i,
                   fmt::format("{} is within a millionth of {} before it: no slope follows from both.\n  Leave one of "
                               "them out.",
                               point_name(raw, i), point_name(raw, i - 1)));
    }
}

void check_curve(const RawHazard& raw, const std::vector<double>& curve, const std::string& name)
{
    constexpr double least = 1e-150; // quotients of frequencies are finite
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (!(curve[i] > 0) || !std::isfinite(curve[i]))
            refuse(raw, i,
                   fmt::format("{} = {} at {} is not above 0 and finite.\n  Give the annual frequency of exceedance.",
                               name, curve[i], point_name(raw, i)));
        if (!(curve[i] >= least && curve[i] <= 1 / least))
            refuse(raw, i,
                   fmt::format("{} = {} at {} is outside [{:g}, {:g}].\n  Leave the intensity out.", name, curve[i],
                               point_name(raw, i), least, 1 / least));
        if (i > 0 && curve[i] > curve[i - 1])
            refuse(raw, i, increase_text(name, raw, curve, i));
    }
    const std::size_t n = curve.size();
    if (!(curve[n - 1] < curve[n - 2]))
        refuse(raw, n - 1,
               fmt::format("{} = {:.6g} at {} is that of the intensity before it: the hazard does not decrease, so it "
                           "cannot be continued.\n  Leave the last intensity out, or give more digits.",
                           name, curve[n - 1], point_name(raw, n - 1)));
}

} // namespace

std::string HazardSite::name() const
{
    return fmt::format("{:g},{:g}", lon, lat);
}

std::size_t chosen_site(const std::string& file, const std::vector<HazardSite>& sites,
                        const std::optional<std::string>& given)
{
    if (sites.empty())
        throw InputError(file, 0, "contains no hazard curve of a site.");
    const auto list = [&] {
        std::string names;
        for (std::size_t i = 0; i < std::min<std::size_t>(sites.size(), 5); ++i)
            names += fmt::format("{}{} ({})", i ? ", " : "", i, sites[i].name());
        return names + (sites.size() > 5 ? ", ..." : "");
    };
    if (!given) {
        if (sites.size() > 1)
            throw InputError(file, 0,
                             fmt::format("has hazard curves of {} sites: {}.\n  Choose one by --site (of a study: "
                                         "survival.hazard.site): LON,LAT or its number.",
                                         sites.size(), list()));
        return 0;
    }
    const std::size_t comma = given->find(',');
    const auto first = hazard_number(std::string_view(*given).substr(0, comma));
    if (comma == std::string::npos) {
        if (first && *first >= 0 && *first == std::floor(*first) && *first < static_cast<double>(sites.size()))
            return static_cast<std::size_t>(*first);
        throw InputError(fmt::format("--site {}: {} has {} sites, from 0 to {}: {}.\n  Give such a number, or LON,LAT.",
                                     *given, file, sites.size(), sites.size() - 1, list()));
    }
    const auto second = hazard_number(std::string_view(*given).substr(comma + 1));
    if (!first || !second)
        throw InputError(fmt::format("--site {}: is neither LON,LAT in degrees nor a number from 0.", *given));
    constexpr double tolerance_deg = 0.001;
    const auto distance = [&](const HazardSite& s) { return std::hypot(s.lon - *first, s.lat - *second); };
    const auto nearest = std::min_element(sites.begin(), sites.end(), [&](const HazardSite& a, const HazardSite& b) {
        return distance(a) < distance(b);
    });
    if (!(distance(*nearest) <= tolerance_deg))
        throw InputError(fmt::format("--site {}: {} has no site within {} degrees; the nearest is {}.\n  Give that "
                                     "one, or compute the hazard of the site.",
                                     *given, file, tolerance_deg, nearest->name()));
    return static_cast<std::size_t>(nearest - sites.begin());
}

void check_decrease(const RawHazard& raw)
{
    const auto check = [&](const std::vector<double>& curve) {
        for (std::size_t i = 1; i < curve.size(); ++i)
            if (curve[i] > curve[i - 1])
                refuse(raw, i, increase_text("annual frequency", raw, curve, i));
    };
    check(raw.hazard.frequency);
    for (const HazardFractile& f : raw.hazard.fractiles)
        check(f.frequency);
}

double annual_frequency(const std::string& file, long line, const std::string& what, double poe, double years)
{
    if (!(poe >= 0 && poe <= 1))
        throw InputError(file, line, fmt::format("{} = {} is no probability in [0, 1].", what, poe));
    return poe == 1 ? std::numeric_limits<double>::infinity() : -std::log1p(-poe) / years;
}

std::optional<double> hazard_number(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '+'))
        text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ')
        text.remove_suffix(1);
    double value = 0;
    if (decimal_number(text, value).ec != std::errc() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

HazardModel checked_hazard(RawHazard raw)
{
    HazardModel& hazard = raw.hazard;
    auto& fractiles = hazard.fractiles;
    std::sort(fractiles.begin(), fractiles.end(),
              [](const HazardFractile& a, const HazardFractile& b) { return a.probability < b.probability; });
    for (std::size_t i = 1; i < fractiles.size(); ++i)
        if (fractiles[i].probability == fractiles[i - 1].probability)
            throw InputError(hazard.source, 0,
                             fmt::format("the fractile {:g} is given twice.", fractiles[i].probability));
    if (hazard.frequency.empty()) {
        const auto median = std::find_if(fractiles.begin(), fractiles.end(),
                                         [](const HazardFractile& f) { return f.probability == 0.5; });
        if (median == fractiles.end())
            throw InputError(hazard.source, 0,
                             "has no best estimate.\n  Give the mean hazard, or the fractile 0.5, beside the others.");
        hazard.frequency = median->frequency;
        hazard.says.emplace_back("The best estimate is the fractile 0.5, for want of a mean.");
    }
    if (fractiles.size() == 1 && fractiles[0].probability == 0.5)
        fractiles.clear();
    if (fractiles.size() == 1)
        throw InputError(hazard.source, 0,
                         fmt::format("has one fractile ({:g}) alone, which bounds one side.\n  Give one on the other "
                                     "side too, or none.",
                                     fractiles[0].probability));
    check_intensities(raw);
    drop_ends(raw);
    if (hazard.intensity.size() < 2)
        throw InputError(hazard.source, 0,
                         fmt::format("has {} with a finite frequency above 0; a hazard curve needs two.\n  Give more "
                                     "of them.",
                                     intensities(hazard.intensity.size())));
    check_curve(raw, hazard.frequency, "annual frequency");
    for (std::size_t f = 0; f < fractiles.size(); ++f) {
        check_curve(raw, fractiles[f].frequency, fmt::format("fractile {:g}", fractiles[f].probability));
        if (f == 0)
            continue;
        for (std::size_t i = 0; i < hazard.intensity.size(); ++i)
            if (fractiles[f].frequency[i] < fractiles[f - 1].frequency[i])
                refuse(raw, i,
                       fmt::format("fractile {:g} = {:.6g} at {} is below fractile {:g} = {:.6g}.\n  Name each column "
                                   "by its fractile.",
                                   fractiles[f].probability, fractiles[f].frequency[i], point_name(raw, i),
                                   fractiles[f - 1].probability, fractiles[f - 1].frequency[i]));
    }
    return std::move(raw.hazard);
}

namespace {

struct Unit {
    const char* name; ///< the ending of a measure's name
    double si;        ///< one of it in SI units
};
constexpr double standard_gravity = 9.80665; // m/s2
constexpr Unit accelerations[] = {{"m_s2", 1}, {"cm_s2", 0.01}, {"g", standard_gravity}};
constexpr Unit velocities[] = {{"m_s", 1}, {"cm_s", 0.01}};
constexpr Unit lengths[] = {{"m", 1}, {"cm", 0.01}};
constexpr Unit si_velocity[] = {{"m_s", 1}};
constexpr Unit cumulative[] = {{"m_s", 1}, {"cm_s", 0.01}, {"g_s", standard_gravity}};

struct Family {
    const char* name;
    IntensityMeasure measure;
    std::span<const Unit> units;
    const char* openquake;
};
constexpr Family families[] = {{"pga", IntensityMeasure::pga, accelerations, "PGA"},
                               {"pgv", IntensityMeasure::pgv, velocities, "PGV"},
                               {"pgd", IntensityMeasure::pgd, lengths, "PGD"},
                               {"arias", IntensityMeasure::arias, si_velocity, "IA"},
                               {"cav", IntensityMeasure::cav, cumulative, "CAV"}};

std::optional<double> period_of(std::string_view text)
{
    double period = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, period);
    if (error != std::errc() || rest != end || !(period > 0) || !std::isfinite(period))
        return std::nullopt;
    return period;
}

} // namespace

std::optional<HazardMeasure> measure_of_column(std::string_view name)
{
    for (const Family& family : families)
        for (const Unit& unit : family.units)
            if (name == std::string(family.name) + "_" + unit.name)
                return HazardMeasure{measure_name(family.measure, 0), unit.si};
    if (name.starts_with("sa_"))
        for (const Unit& unit : accelerations)
            if (const std::string ending = std::string("s_") + unit.name; name.ends_with(ending))
                if (const auto period = period_of(name.substr(3, name.size() - 3 - ending.size())))
                    return HazardMeasure{measure_name(IntensityMeasure::sa, *period), unit.si};
    return std::nullopt;
}

std::optional<HazardMeasure> measure_without_unit(std::string_view name)
{
    for (const Family& family : families)
        if (name == family.name)
            return HazardMeasure{measure_name(family.measure, 0), 1};
    if (name.starts_with("sa_") && name.ends_with("s"))
        if (const auto period = period_of(name.substr(3, name.size() - 4)))
            return HazardMeasure{measure_name(IntensityMeasure::sa, *period), 1};
    return std::nullopt;
}

std::optional<HazardMeasure> measure_of_openquake(const std::string& imt)
{
    for (const Family& family : families)
        if (imt == family.openquake)
            return HazardMeasure{measure_name(family.measure, 0), 1 / per_si_unit(imt)};
    if (imt.starts_with("SA(") && imt.ends_with(")"))
        if (const auto period = period_of(std::string_view(imt).substr(3, imt.size() - 4)))
            return HazardMeasure{measure_name(IntensityMeasure::sa, *period), 1 / per_si_unit(imt)};
    return std::nullopt;
}

std::string known_hazard_measures()
{
    std::string known;
    for (const Family& family : families)
        for (const Unit& unit : family.units)
            known += std::string(family.name) + "_" + unit.name + ", ";
    for (const Unit& unit : accelerations)
        known += std::string("sa_1s_") + unit.name + (&unit == &accelerations[2] ? "" : ", ");
    return known;
}

} // namespace stylobate
