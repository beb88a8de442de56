#include "io/hazard/hazard_measure.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "io/tables/fragility_measure.hpp"

#include <charconv>
#include <cmath>
#include <optional>

namespace stylobate {

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

HazardMeasure measure_of_column(std::string_view name)
{
    for (const Family& family : families)
        for (const Unit& unit : family.units)
            if (name == std::string(family.name) + "_" + unit.name)
                return {measure_name(family.measure, 0), unit.si};
    if (name.starts_with("sa_"))
        for (const Unit& unit : accelerations)
            if (const std::string ending = std::string("s_") + unit.name; name.ends_with(ending))
                if (const auto period = period_of(name.substr(3, name.size() - 3 - ending.size())))
                    return {measure_name(IntensityMeasure::sa, *period), unit.si};
    return {};
}

HazardMeasure measure_without_unit(std::string_view name)
{
    for (const Family& family : families)
        if (name == family.name)
            return {measure_name(family.measure, 0), 1};
    if (name.starts_with("sa_") && name.ends_with("s"))
        if (const auto period = period_of(name.substr(3, name.size() - 4)))
            return {measure_name(IntensityMeasure::sa, *period), 1};
    return {};
}

HazardMeasure measure_of_openquake(const std::string& imt)
{
    for (const Family& family : families)
        if (imt == family.openquake)
            return {measure_name(family.measure, 0), 1 / per_si_unit(imt)};
    if (imt.starts_with("SA(") && imt.ends_with(")"))
        if (const auto period = period_of(std::string_view(imt).substr(3, imt.size() - 4)))
            return {measure_name(IntensityMeasure::sa, *period), 1 / per_si_unit(imt)};
    return {};
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
