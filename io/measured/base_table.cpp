#include "io/measured/base_table.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_layout.hpp"
#include "io/measured/measured_motion.hpp"
#include "io/motion/ground_motion.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace stylobate {

namespace {

constexpr const char* time_name = "time_s";
constexpr const char* acceleration_name = "acceleration_m_s2";
constexpr const char* displacement_name = "displacement_m";

/// Whether the first column is "time_s" or in another unit of time, which the reader of columns converts.
bool is_time(const ColumnTable& table)
{
    const std::string name = lower_case(table.names.front());
    return name == time_name || name == "time_ms" || name == "time_us";
}

/// A quantity that is read, and how its column begins.
struct Quantity {
    const char* stem;
    Dimension dimension;
};
constexpr Quantity acceleration_of_base = {"acceleration", Dimension::acceleration};
constexpr Quantity displacement_of_base = {"displacement", Dimension::length};

/// SI in the unit of a column "displacement_mm"; none if it is not of this quantity, or its unit is not known.
std::optional<double> unit_of(std::string_view name, const Quantity& quantity)
{
    const std::string lower = lower_case(name);
    const std::string stem = std::string(quantity.stem) + "_";
    return lower.starts_with(stem) ? unit_in_si(std::string_view(lower).substr(stem.size()), quantity.dimension)
                                   : std::nullopt;
}

/// The column of a quantity, in SI; empty if there is none.
std::vector<double> column(const RecordText& text, const ColumnTable& table, const Quantity& quantity)
{
    std::vector<double> values;
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
        const std::optional<double> unit = unit_of(table.names[c], quantity);
        if (!unit)
            continue;
        if (!values.empty())
            text.refuse(fmt::format("has two columns of the {}.", quantity.stem));
        values = table.columns[c];
        for (double& value : values)
            value *= *unit;
    }
    return values;
}

/// A name that is nearly one of those that are read is a slip.
void check_names(const RecordText& text, const ColumnTable& table)
{
    const std::vector<std::string> known = {time_name, acceleration_name, displacement_name};
    const auto is_read = [](const std::string& name) {
        return unit_of(name, acceleration_of_base) || unit_of(name, displacement_of_base);
    };
    for (const std::string& name : table.names) {
        const std::string meant = meant_key(lower_case(name), known);
        const bool there = std::any_of(table.names.begin(), table.names.end(),
                                       [&](const std::string& other) { return lower_case(other) == meant; });
        if (meant.empty() || is_read(name) || there || (meant == time_name && is_time(table)))
            continue;
        // with the unit of the file: with another one its values would be others by a factor
        for (std::size_t line = name.find('_'); line != std::string::npos; line = name.find('_', line + 1))
            if (const std::string same_unit = std::string(without_unit(meant)) + name.substr(line); is_read(same_unit))
                text.refuse(fmt::format("has a column \"{}\". Did you mean {}? The unit is part of the name.", name,
                                        same_unit));
        text.refuse(fmt::format("has a column \"{}\". Did you mean {}? The unit is part of the name: times are in {}, "
                                "accelerations in {}, displacements in {}.",
                                name, meant, known_units(Dimension::time), known_units(Dimension::acceleration),
                                known_units(Dimension::length)));
    }
    const char* todo = "Give a line of names above the rows: time_s first, then acceleration_m_s2 or displacement_m.";
    if (!is_time(table))
        text.refuse(fmt::format("begins with the column \"{}\", not with time_s. {}", table.names.front(), todo));
    if (std::none_of(table.names.begin(), table.names.end(), is_read))
        text.refuse(fmt::format("has no motion: its columns are {}. {}", fmt::join(table.names, ", "), todo));
}

void check_peak(const Motion& motion, const std::filesystem::path& file)
{
    if (!(motion.pga_m_s2 <= largest_pga_m_s2))
        throw InputError(
            file.string(), 0,
            fmt::format("the motion has a peak acceleration of {:.4g} m/s2, more than {}: a unit is "
                        "wrong, or displacements have too few digits.\n  If it is right: study.allow = [\"pga\"].",
                        motion.pga_m_s2, largest_pga_m_s2));
}

Motion of_campaign(const std::filesystem::path& file, const std::string& run)
{
    const Campaign campaign = read_campaign(file);
    std::vector<std::string> names;
    for (const MeasuredRun& measured : campaign.runs) {
        if (measured.name == run)
            return base_motion_of(measured);
        names.push_back(measured.name);
    }
    throw InputError(file.string(), 0, fmt::format("has no run \"{}\". It has: {}.", run, fmt::join(names, ", ")));
}

Motion of_columns(const std::filesystem::path& file, PgaRange pga)
{
    const std::string content = content_of(file, "a table of the base motion");
    const RecordText text = lines_of(file.string(), content);
    refuse_decimal_commas(text);
    const ColumnTable table = read_columns(text);
    check_names(text, table);
    const std::vector<double> accelerations = column(text, table, acceleration_of_base);
    const std::vector<double> displacements = column(text, table, displacement_of_base);
    const std::vector<double>* acceleration = accelerations.empty() ? nullptr : &accelerations;
    const std::vector<double>* displacement = displacements.empty() ? nullptr : &displacements;
    for (const auto& [values, name, dimension] : {std::tuple{acceleration, acceleration_name, Dimension::acceleration},
                                                  {displacement, displacement_name, Dimension::length}}) {
        if (values == nullptr)
            continue;
        if (values->size() < fewest_samples)
            text.refuse(fmt::format("has {} samples; at least {} are required.", values->size(), fewest_samples));
        const auto [least, most] = std::minmax_element(values->begin(), values->end());
        if (*least == *most && (values == displacement || *least == 0))
            text.refuse(fmt::format("its {} is {} at all times: there is no motion.", name, *least));
        const double reached = std::max(-*least, *most), largest = largest_of_series(dimension);
        if (reached > largest)
            text.refuse(fmt::format("its {} reaches {:.4g}, more than {}: a unit is wrong.", name, reached, largest));
    }
    if (acceleration && displacement) {
        MeasuredRun run;
        run.name = file.string();
        run.time_s = table.columns.front();
        run.base_acceleration_m_s2.values = *acceleration;
        run.base_displacement_m.values = *displacement;
        Motion motion = base_motion_of(run);
        if (pga == PgaRange::usual)
            check_peak(motion, file);
        return motion;
    }
    Motion motion =
        motion_of(acceleration ? *acceleration : acceleration_through(*displacement, table.dt_s), table.dt_s);
    if (!acceleration && pga == PgaRange::usual) // a base that is hit is faster than any ground
        check_peak(motion, file);
    return motion;
}

} // namespace

Motion read_base_table(const std::filesystem::path& file, const std::string& run, PgaRange pga)
{
    Motion motion = run.empty() ? of_columns(file, pga) : of_campaign(file, run);
    if (!run.empty() && pga == PgaRange::usual)
        check_peak(motion, file);
    if (!(motion.predominant_frequency_hz > 0))
        motion.predominant_frequency_hz = predominant_frequency(motion.acceleration_m_s2, motion.dt_s);
    motion.source = run.empty() ? file.string() : fmt::format("{}, run {}", file.string(), run);
    return motion;
}

} // namespace stylobate
