#include "io/measured/measured_layout.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate {
namespace {

struct UnitName {
    std::string_view spelling;
    double si;
};

constexpr UnitName times[] = {{"s", 1}, {"sec", 1}, {"second", 1}, {"seconds", 1}, {"ms", 1e-3}, {"us", 1e-6}};
constexpr UnitName lengths[] = {
    {"m", 1},     {"metre", 1}, {"meter", 1}, {"metres", 1}, {"meters", 1},
    {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"µm", 1e-6},
};
constexpr UnitName angles[] = {{"rad", 1},
                               {"radian", 1},
                               {"radians", 1},
                               {"mrad", 1e-3},
                               {"deg", std::numbers::pi / 180},
                               {"degree", std::numbers::pi / 180},
                               {"degrees", std::numbers::pi / 180}};
constexpr UnitName masses[] = {{"kg", 1}, {"g", 1e-3}, {"t", 1000}};

template <std::size_t n>
std::optional<double> find(const UnitName (&units)[n], std::string_view spelling)
{
    for (const UnitName& unit : units)
        if (unit.spelling == spelling)
            return unit.si;
    return std::nullopt;
}

} // namespace

std::optional<double> unit_in_si(std::string_view spelling, Dimension dimension)
{
    switch (dimension) {
    case Dimension::time:
        return find(times, spelling);
    case Dimension::length:
        return find(lengths, spelling);
    case Dimension::angle:
        return find(angles, spelling);
    case Dimension::mass:
        return find(masses, spelling);
    case Dimension::acceleration:
        break;
    }
    if (spelling == "m_s2" || spelling == "cm_s2" || spelling == "mm_s2")
        return spelling.front() == 'c' ? 0.01 : spelling.starts_with("mm") ? 0.001 : 1;
    const std::string canonical = canonical_unit(spelling);
    return canonical.empty() ? std::nullopt : std::optional(unit_m_s2(canonical));
}

const char* known_units(Dimension dimension)
{
    switch (dimension) {
    case Dimension::time:
        return "s, ms, us";
    case Dimension::length:
        return "m, cm, mm, um";
    case Dimension::angle:
        return "rad, mrad, deg";
    case Dimension::mass:
        return "kg, g, t";
    case Dimension::acceleration:
        break;
    }
    return "m/s2, cm/s2, mm/s2, g";
}

std::string length_words(double metres)
{
    return std::abs(metres) < 1 ? fmt::format("{:.3g} mm", 1000 * metres) : fmt::format("{:.3g} m", metres);
}

double largest_of_series(Dimension dimension)
{
    return dimension == Dimension::length ? 200 : 1000;
}

const std::array<SeriesName, 8>& series_names()
{
    using Run = MeasuredRun;
    constexpr auto length = Dimension::length;
    static const std::array<SeriesName, 8> names{{
        {"base/acceleration_m_s2", "base_acceleration", "m/s^2", "_m_s2", Dimension::acceleration, false,
         [](Run& r) -> Series& { return r.base_acceleration_m_s2; }},
        {"base/displacement_m", "base_displacement", "m", "_m", length, false,
         [](Run& r) -> Series& { return r.base_displacement_m; }},
        {"base/x_m", "table_x", "m", "_m", length, false, [](Run& r) -> Series& { return r.table.x_m; }},
        {"base/y_m", "table_y", "m", "_m", length, false, [](Run& r) -> Series& { return r.table.y_m; }},
        {"base/theta_rad", "table_theta", "rad", "_rad", Dimension::angle, false,
         [](Run& r) -> Series& { return r.table.theta_rad; }},
        {"blocks/x_m", "x", "m", "_m", length, true, [](Run& r) -> Series& { return r.blocks.x_m; }},
        {"blocks/y_m", "y", "m", "_m", length, true, [](Run& r) -> Series& { return r.blocks.y_m; }},
        {"blocks/theta_rad", "theta", "rad", "_rad", Dimension::angle, true,
         [](Run& r) -> Series& { return r.blocks.theta_rad; }},
    }};
    return names;
}

const std::array<SpecimenList, 6>& specimen_lists()
{
    static const std::array<SpecimenList, 6> lists{{
        {"half_width_m", Dimension::length, &Specimen::half_width_m},
        {"half_height_m", Dimension::length, &Specimen::half_height_m},
        {"depth_m", Dimension::length, &Specimen::depth_m},
        {"mass_kg", Dimension::mass, &Specimen::mass_kg},
        {"rest_x_m", Dimension::length, &Specimen::rest_x_m},
        {"rest_y_m", Dimension::length, &Specimen::rest_y_m},
    }};
    return lists;
}

const std::array<SpecimenNumber, 4>& specimen_numbers()
{
    static const std::array<SpecimenNumber, 4> numbers{{
        {"mass_tolerance", &Specimen::mass_tolerance},
        {"width_tolerance", &Specimen::width_tolerance},
        {"placement_tolerance_m", &Specimen::placement_tolerance_m},
        {"base_block_top_m", &Specimen::base_block_top_m},
    }};
    return numbers;
}

std::size_t block_count(const Campaign& campaign)
{
    for (const SpecimenList& list : specimen_lists())
        if (!(campaign.specimen.*list.member).empty())
            return (campaign.specimen.*list.member).size();
    for (const MeasuredRun& run : campaign.runs)
        for (const SeriesName& name : series_names())
            if (name.per_block && !run.time_s.empty() && !name.in(run).empty())
                return name.in(run).values.size() / run.time_s.size();
    return 0;
}

int whole_number(const Campaign& campaign, const std::string& what, double value)
{
    if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::floor(value))
        throw InputError(campaign.source, 0,
                         fmt::format("{} = {} is not a whole number.\n  Write one within +-2147483647.", what, value));
    return static_cast<int>(value);
}

BaseSource base_source(const Campaign& campaign, const std::string& what, const std::string& text)
{
    for (const BaseSource source : {BaseSource::table_sensor, BaseSource::command})
        if (text == to_string(source))
            return source;
    throw InputError(campaign.source, 0,
                     fmt::format("{} = \"{}\" is not a known source of a base motion.\n  Write \"table sensor\" if it "
                                 "was measured on the table, \"command\" if it is the command to the table.",
                                 what, text));
}

const char* to_string(BaseSource source)
{
    return source == BaseSource::command ? "command" : "table sensor";
}

void check_shapes(Campaign& campaign)
{
    const auto refuse = [&](const std::string& text) { throw InputError(campaign.source, 0, text); };
    constexpr std::size_t most_blocks = 10000;
    const std::size_t blocks = block_count(campaign);
    if (blocks > most_blocks)
        refuse(fmt::format("has {} blocks, more than {}.\n  Are times and blocks exchanged?", blocks, most_blocks));
    for (const SpecimenList& list : specimen_lists()) {
        const std::size_t n = (campaign.specimen.*list.member).size();
        if (n != 0 && n != blocks)
            refuse(fmt::format("specimen/{} has {} values where the specimen has {} blocks.\n  One value for each "
                               "block.",
                               list.name, n, blocks));
    }
    const std::vector<std::pair<int, int>>& joints = campaign.specimen.joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const auto [lower, upper] = joints[j];
        if (lower < -1 || upper < 0 || std::max(lower, upper) >= static_cast<int>(blocks) || lower == upper)
            refuse(fmt::format("specimen/joints: joint {} is between {} and {}, but the blocks are 0 to {}.\n  The "
                               "lower block (-1: the base), then the upper one.",
                               j, lower, upper, static_cast<int>(blocks) - 1));
        for (std::size_t i = 0; i < j; ++i)
            if (joints[i] == joints[j])
                refuse(fmt::format("specimen/joints: joints {} and {} are the same.\n  Remove one.", i, j));
    }
    for (MeasuredRun& run : campaign.runs) {
        std::size_t count = run.time_s.size();
        if (count == 0) {
            const char* counted = "";
            for (const SeriesName& name : series_names())
                if (count == 0 && !name.in(run).empty()) {
                    count = name.in(run).values.size() / (name.per_block ? std::max<std::size_t>(blocks, 1) : 1);
                    counted = name.path;
                }
            if (count > 0 && !(run.rate_hz > 0))
                refuse(fmt::format(
                    "run {}: there is neither time_s nor rate_hz, so the times of {} are unknown.\n  Add one of them.",
                    run.name, counted));
            for (std::size_t i = 0; i < count; ++i)
                run.time_s.push_back(static_cast<double>(i) / run.rate_hz);
            if (count > 0)
                campaign.findings.push_back(
                    {Severity::note, fmt::format("run {}, time_s", run.name),
                     fmt::format("there is no clock: times from 0 at {:g} Hz are assumed.", run.rate_hz)});
        }
        for (const SeriesName& name : series_names()) {
            const std::size_t n = name.in(run).values.size();
            const std::size_t wanted = count * (name.per_block ? blocks : 1);
            if (n != 0 && n != wanted)
                refuse(fmt::format("run {}: {} has {} values where {} times{} make {}.\n  One row for each time.",
                                   run.name, name.path, n, count,
                                   name.per_block ? fmt::format(" and {} blocks", blocks) : std::string(), wanted));
        }
    }
}

} // namespace stylobate
