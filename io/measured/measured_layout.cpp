#include "io/measured/measured_layout.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

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
constexpr UnitName forces[] = {{"n", 1}, {"N", 1}, {"kn", 1000}, {"kN", 1000}, {"mn", 1e-3}, {"mN", 1e-3}};
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
    case Dimension::force:
        return find(forces, spelling);
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
    case Dimension::force:
        return "N, kN, mN";
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
    return dimension == Dimension::length ? 200 : dimension == Dimension::force ? 1e7 : 1000;
}

const std::array<SeriesName, 9>& series_names()
{
    using Run = MeasuredRun;
    constexpr auto length = Dimension::length;
    static const std::array<SeriesName, 9> names{{
        {"base/acceleration_m_s2", "base_acceleration", "m/s^2", "_m_s2", Dimension::acceleration, false,
         [](Run& r) -> Series& { return r.base_acceleration_m_s2; }},
        {"base/displacement_m", "base_displacement", "m", "_m", length, false,
         [](Run& r) -> Series& { return r.base_displacement_m; }},
        {"base/x_m", "table_x", "m", "_m", length, false, [](Run& r) -> Series& { return r.table.x_m; }},
        {"base/y_m", "table_y", "m", "_m", length, false, [](Run& r) -> Series& { return r.table.y_m; }},
        {"base/theta_rad", "table_theta", "rad", "_rad", Dimension::angle, false,
         [](Run& r) -> Series& { return r.table.theta_rad; }},
        {"base/tilt_rad", "base_tilt", "rad", "_rad", Dimension::angle, false,
         [](Run& r) -> Series& { return r.base_tilt_rad; }, 2},
        {"blocks/x_m", "x", "m", "_m", length, true, [](Run& r) -> Series& { return r.blocks.x_m; }},
        {"blocks/y_m", "y", "m", "_m", length, true, [](Run& r) -> Series& { return r.blocks.y_m; }},
        {"blocks/theta_rad", "theta", "rad", "_rad", Dimension::angle, true,
         [](Run& r) -> Series& { return r.blocks.theta_rad; }},
    }};
    return names;
}

const std::array<SpecimenList, 9>& specimen_lists()
{
    static const std::array<SpecimenList, 9> lists{{
        {"half_width_m", Dimension::length, &Specimen::half_width_m},
        {"half_height_m", Dimension::length, &Specimen::half_height_m},
        {"depth_m", Dimension::length, &Specimen::depth_m},
        {"mass_kg", Dimension::mass, &Specimen::mass_kg},
        {"rest_x_m", Dimension::length, &Specimen::rest_x_m},
        {"rest_y_m", Dimension::length, &Specimen::rest_y_m},
        {"centre_of_mass_m", Dimension::length, &Specimen::centre_of_mass_m, false, true},
        {"bearing_left_m", Dimension::length, &Specimen::bearing_left_m, true, true},
        {"bearing_right_m", Dimension::length, &Specimen::bearing_right_m, true, true},
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

const std::array<LaboratoryNumber, 5>& laboratory_numbers()
{
    static const std::array<LaboratoryNumber, 5> numbers{{
        {"stroke_m", &Laboratory::stroke_m, 20},
        {"speed_m_s", &Laboratory::speed_m_s, 100},
        {"acceleration_m_s2", &Laboratory::acceleration_m_s2, 1000},
        {"tilt_rad", &Laboratory::tilt_rad, std::numbers::pi / 2},
        {"force_n", &Laboratory::force_n, 1e7},
    }};
    return numbers;
}

std::string cost_key(RunKind kind)
{
    return std::string("cost_") + to_string(kind);
}

const std::array<DummyNumber, 5>& dummy_numbers()
{
    static const std::array<DummyNumber, 5> numbers{{
        {"mass_kg", &Dummy::mass_kg, true},
        {"half_width_m", &Dummy::half_width_m, true},
        {"half_height_m", &Dummy::half_height_m, true},
        {"x_m", &Dummy::x_m, false},
        {"y_m", &Dummy::y_m, false},
    }};
    return numbers;
}

const std::array<GaugeNumber, 4>& gauge_numbers()
{
    static const std::array<GaugeNumber, 4> numbers{{
        {"height_m", &ForceGauge::height_m, true, 0, 40},
        {"gain_sd", &ForceGauge::gain_sd, false, 0, 1},
        {"speed_m_s", &ForceGauge::speed_m_s, false, -10, 10},
        {"stiffness_n_m", &ForceGauge::stiffness_n_m, false, 0, 1e12},
    }};
    return numbers;
}

const char* end_word(const ForceGauge& gauge)
{
    return gauge.to_laboratory ? "laboratory" : "table";
}

bool end_in_laboratory(const Campaign& campaign, const std::string& what, const std::optional<std::string>& word,
                       RunKind kind)
{
    if (!word)
        return kind != RunKind::push;
    if (*word != "laboratory" && *word != "table")
        throw InputError(campaign.source, 0,
                         fmt::format("{} = \"{}\" is no place for the end of a rod.\n  Write \"laboratory\" if it is "
                                     "fixed beside the table, \"table\" if it moves with the table.",
                                     what, *word));
    return *word == "laboratory";
}

std::optional<RunKind> run_kind(std::string_view word)
{
    for (const RunKind kind : run_kinds)
        if (word == to_string(kind))
            return kind;
    return std::nullopt;
}

std::optional<RunKind> known_run_kind(Campaign& campaign, const std::string& run,
                                      const std::optional<std::string>& word)
{
    const std::optional<RunKind> kind = word ? run_kind(*word) : RunKind::shake;
    if (kind)
        return kind;
    std::vector<std::string> words;
    for (const RunKind known : run_kinds)
        words.emplace_back(to_string(known));
    const auto meant = nearest_word(*word, words);
    campaign.findings.push_back(
        {Severity::warning, fmt::format("run {}, kind", run),
         fmt::format("its kind \"{}\" is not known: the run is left out. {}. The kind of motion is in motion.", *word,
                     meant ? "Did you mean \"" + *meant + "\"?"
                           : fmt::format("Kinds are {}", fmt::join(words, ", ")))});
    return std::nullopt;
}

void report_old_kind(Campaign& campaign, const MeasuredRun& run)
{
    if (const auto kind = run_kind(run.kind.value_or("")); kind && *kind != RunKind::shake)
        campaign.findings.push_back(
            {Severity::warning, fmt::format("run {}, kind", run.name),
             fmt::format("in format_version 1 \"{}\" is a kind of motion, and the run is a shake run. A test of a "
                         "joint needs format_version = 2.",
                         *run.kind)});
}

void keep_tests_apart(Campaign& campaign)
{
    const std::size_t blocks = block_count(campaign);
    for (MeasuredRun& run : std::exchange(campaign.runs, {})) {
        std::string why;
        const auto also = [&](bool holds, const char* word) {
            if (holds)
                why += (why.empty() ? "" : ", ") + std::string(word);
        };
        also(!run.present.empty() && std::set(run.present.begin(), run.present.end()).size() < blocks,
             "blocks removed");
        also(!run.clamped.empty(), "joints clamped");
        also(!run.taped.empty(), "blocks taped");
        also(!run.dummies.empty(), "dummies");
        also(run.released_s.has_value(), "held by hands");
        also(!run.base_tilt_rad.empty(), "the table tilted");
        also(!run.forces.empty(), "a force");
        if (run.test == RunKind::shake && !why.empty())
            campaign.findings.push_back({Severity::warning, fmt::format("run {}, kind", run.name),
                                         fmt::format("the specimen is not whole, free and level ({}): it is not used "
                                                     "as a shake run.",
                                                     why)});
        (run.test == RunKind::shake && why.empty() ? campaign.runs : campaign.tests).push_back(std::move(run));
    }
}

std::string test_words(const MeasuredRun& run)
{
    return fmt::format("a test ({}){}", to_string(run.test), run.joint ? fmt::format(" on joint {}", *run.joint) : "");
}

std::size_t block_count(const Campaign& campaign)
{
    for (const SpecimenList& list : specimen_lists())
        if (!list.per_joint && !(campaign.specimen.*list.member).empty())
            return (campaign.specimen.*list.member).size();
    for (const MeasuredRun* run : every_run(campaign))
        for (const SeriesName& name : series_names())
            if (name.per_block && !run->time_s.empty() && !name.in(*run).empty())
                return name.in(*run).values.size() / run->time_s.size();
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
        const std::size_t wanted = list.per_joint ? campaign.specimen.joints.size() : blocks;
        const char* each = list.per_joint ? "joint" : "block";
        if (n != 0 && n != wanted)
            refuse(fmt::format("specimen/{} has {} values where the specimen has {} {}s.\n  One value for each {}.",
                               list.name, n, wanted, each, each));
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
    for (MeasuredRun* each : every_run(campaign)) {
        MeasuredRun& run = *each;
        std::size_t count = run.time_s.size();
        if (count == 0) {
            const char* counted = "";
            for (const ForceGauge& gauge : run.forces)
                if (count == 0 && !gauge.value_n.empty()) {
                    count = gauge.value_n.values.size();
                    counted = gauge.name.c_str();
                }
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
        for (const ForceGauge& gauge : run.forces)
            if (const std::size_t n = gauge.value_n.values.size(); n != 0 && n != count)
                refuse(fmt::format("run {}: force/{}/value_n has {} values where there are {} times.\n  One value for "
                                   "each time.",
                                   run.name, gauge.name, n, count));
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
        check_measured();
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

    /// What was measured at rest lies within the block.
    void check_measured() const
    {
        const std::size_t n = specimen_.half_width_m.size();
        const auto within = [&](const char* name, const std::vector<double>& values, const char* of, std::size_t i,
                                double low, double high) {
            if (i < values.size() && (values[i] < low || values[i] > high))
                refuse(fmt::format("specimen/{}: {:g} of {} {} is outside [{:g}, {:g}] m, which the block's width "
                                   "gives.\n  Units are SI. Did you mean {:.4g}?",
                                   name, values[i], of, i, low, high, values[i] / 1000));
        };
        for (std::size_t i = 0; i < n; ++i)
            within("centre_of_mass_m", specimen_.centre_of_mass_m, "block", i, -specimen_.half_width_m[i],
                   specimen_.half_width_m[i]);
        for (std::size_t j = 0; j < specimen_.joints.size() && n > 0; ++j) {
            const double width = 2 * specimen_.half_width_m[static_cast<std::size_t>(specimen_.joints[j].second)];
            within("bearing_left_m", specimen_.bearing_left_m, "joint", j, -0.1 * width, width);
            within("bearing_right_m", specimen_.bearing_right_m, "joint", j, -0.1 * width, width);
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
