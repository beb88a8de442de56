#include "io/measured/measured_layout.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    const auto canonical = canonical_unit(spelling);
    return canonical ? std::optional(unit_m_s2(*canonical)) : std::nullopt;
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

// Whether a specimen can be: sizes, densities, and what touches what.

namespace {

class SpecimenChecks {
public:
    explicit SpecimenChecks(const Campaign& campaign) : campaign_(campaign), specimen_(campaign.specimen) {}

    void check_sizes() const
    {
        constexpr double largest_m = 20, smallest_m = 1e-4;
        check_list("half_width_m", specimen_.half_width_m, smallest_m, largest_m, "m");
        check_list("half_height_m", specimen_.half_height_m, smallest_m, largest_m, "m");
        check_list("depth_m", specimen_.depth_m, smallest_m, 2 * largest_m, "m");
        check_list("mass_kg", specimen_.mass_kg, 1e-5, 1e7, "kg");
        const auto within = [&](const char* name, double value, double low, double high) {
            if (!(value >= low && value <= high))
                refuse(fmt::format("specimen: {} = {:g} is outside [{:g}, {:g}].", name, value, low, high));
        };
        within("gravity_m_s2", specimen_.gravity_m_s2, 0.1, 100);
        within("friction_nominal", specimen_.friction_nominal.value_or(0.5), 0, 5);
        within("mass_tolerance", specimen_.mass_tolerance, 0, 1);
        within("width_tolerance", specimen_.width_tolerance, 0, 1);
        within("placement_tolerance_m", specimen_.placement_tolerance_m, 0, largest_m);
        within("base_block_half_width_m", specimen_.base_block_half_width_m.value_or(1), smallest_m, 10 * largest_m);
        within("base_block_top_m", specimen_.base_block_top_m, 0, largest_m);
        for (const auto* list : {&specimen_.rest_x_m, &specimen_.rest_y_m})
            for (std::size_t i = 0; i < list->size(); ++i)
                if (!(std::abs((*list)[i]) <= 200))
                    refuse(fmt::format("specimen/{}: {:g} m of block {} is beyond 200 m.\n  Units are SI. Did you mean "
                                       "{:.4g}?",
                                       list == &specimen_.rest_x_m ? "rest_x_m" : "rest_y_m", (*list)[i], i,
                                       (*list)[i] / 1000));
        const std::size_t n = specimen_.half_width_m.size();
        if (n == 0 || specimen_.half_height_m.empty() || specimen_.depth_m.empty() || specimen_.mass_kg.empty())
            return;
        for (std::size_t i = 0; i < n; ++i) {
            const double volume = 4 * specimen_.half_width_m[i] * specimen_.half_height_m[i] * specimen_.depth_m[i];
            const double density = specimen_.mass_kg[i] / volume;
            constexpr double lightest = 300, heaviest = 25000;
            if (density >= lightest && density <= heaviest)
                continue;
            // the usual slips, and what the density would be without them
            const struct {
                double factor;
                const char* slip;
            } slips[] = {{1e-3, "a mass in grams"},
                         {1e3, "a mass in tonnes"},
                         {8, "half sizes that are full sizes"},
                         {0.125, "full sizes that are half sizes"},
                         {4, "half width and half height that are full ones"},
                         {0.25, "width and height that are half ones"}};
            std::string guess;
            for (const auto& [factor, slip] : slips)
                if (guess.empty() && density * factor > 1500 && density * factor < 4000)
                    guess = fmt::format(" Did you mean another unit or measure: {}? That would be {:.0f} kg/m3.", slip,
                                        density * factor);
            refuse(fmt::format("specimen: block {} would have a density of {:.4g} kg/m3, outside [{:g}, {:g}]: {:g} kg "
                               "in {:g} x {:g} x {:g} m.\n  Sizes in the file are half widths and half heights, and "
                               "the whole depth.{}",
                               i, density, lightest, heaviest, specimen_.mass_kg[i], 2 * specimen_.half_width_m[i],
                               2 * specimen_.half_height_m[i], specimen_.depth_m[i], guess));
        }
    }

    void check_geometry() const
    {
        const std::size_t n = specimen_.half_width_m.size();
        const auto& joints = specimen_.joints;
        if (!joints.empty())
            for (std::size_t i = 0; i < block_count(campaign_); ++i)
                if (std::none_of(joints.begin(), joints.end(), [&](const auto& joint) {
                        return joint.first == static_cast<int>(i) || joint.second == static_cast<int>(i);
                    }))
                    refuse(
                        fmt::format("specimen/joints: block {} has no joint.\n  Every block stands on another one or "
                                    "on the base (-1).",
                                    i));
        if (n == 0 || specimen_.half_height_m.empty() || specimen_.rest_x_m.empty() || specimen_.rest_y_m.empty())
            return;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const auto upper = static_cast<std::size_t>(joints[j].second);
            const double near = 0.02 * specimen_.half_height_m[upper];
            const bool on_base = joints[j].first < 0;
            const auto lower = static_cast<std::size_t>(std::max(joints[j].first, 0));
            const double floor =
                on_base ? specimen_.base_block_half_width_m ? specimen_.base_block_top_m : 0 : edge(lower, 1);
            const double gap = edge(upper, 0) - floor;
            const std::string pair =
                on_base ? fmt::format("block {} and the base", upper) : fmt::format("blocks {} and {}", lower, upper);
            if (std::abs(gap) > near)
                refuse(
                    fmt::format("specimen: joint {}: {} do not touch at rest: the upper one's lower face is {} {} the "
                                "lower one's upper face.\n  Correct rest_y_m, half_height_m or the joint.",
                                j, pair, length_words(std::abs(gap)), gap > 0 ? "above" : "below"));
            const double shared =
                on_base ? 1 : std::min(edge(lower, 3), edge(upper, 3)) - std::max(edge(lower, 2), edge(upper, 2));
            if (shared <= 0)
                refuse(fmt::format("specimen: joint {}: {} are beside each other, {} apart.\n  Correct rest_x_m, "
                                   "half_width_m or the joint.",
                                   j, pair, length_words(-shared)));
        }
        for (std::size_t b = 1; b < n; ++b)
            for (std::size_t a = 0; a < b; ++a) {
                const double wide = std::min(edge(a, 3), edge(b, 3)) - std::max(edge(a, 2), edge(b, 2));
                const double high = std::min(edge(a, 1), edge(b, 1)) - std::max(edge(a, 0), edge(b, 0));
                if (wide > 0.02 * specimen_.half_width_m[b] && high > 0.02 * specimen_.half_height_m[b])
                    refuse(
                        fmt::format("specimen: blocks {} and {} overlap at rest by {}.\n  Correct rest_x_m, rest_y_m "
                                    "or their sizes.",
                                    a, b, length_words(std::min(wide, high))));
            }
    }

private:
    [[noreturn]] void refuse(const std::string& text) const { throw InputError(campaign_.source, 0, text); }

    /// Positive, finite, and of a size that stones have.
    void check_list(const char* name, const std::vector<double>& values, double low, double high,
                    const char* unit) const
    {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] > low && values[i] <= high)
                continue;
            std::string guess;
            for (const double factor : {0.001, 0.01, 1000.0})
                if (guess.empty() && values[i] * factor > 100 * low && values[i] * factor <= high / 10)
                    guess = fmt::format(" Did you mean {:.4g}?", values[i] * factor);
            refuse(fmt::format("specimen/{}: {:g} of block {} is outside ({:g}, {:g}] {}.\n  Units are SI.{}", name,
                               values[i], i, low, high, unit, guess));
        }
    }

    /// Bottom, top, left and right of a block at rest.
    double edge(std::size_t block, int side) const
    {
        const std::vector<double>& middle = side < 2 ? specimen_.rest_y_m : specimen_.rest_x_m;
        const std::vector<double>& half = side < 2 ? specimen_.half_height_m : specimen_.half_width_m;
        return middle[block] + (side % 2 == 0 ? -half[block] : half[block]);
    }

    const Campaign& campaign_;
    const Specimen& specimen_;
};

} // namespace

void check_specimen(const Campaign& campaign)
{
    const SpecimenChecks checks(campaign);
    checks.check_sizes();
    checks.check_geometry();
}

} // namespace stylobate
