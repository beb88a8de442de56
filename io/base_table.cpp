#include "io/base_table.hpp"

#include "io/ground_motion.hpp"
#include "io/record_parser.hpp"
#include "io/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

constexpr const char* time_name = "time_s";
constexpr const char* acceleration_name = "acceleration_m_s2";
constexpr const char* displacement_name = "displacement_m";

/// The column of a name; null if there is none.
const std::vector<double>* column(const ColumnTable& table, const std::string& name)
{
    const auto at = std::find(table.names.begin(), table.names.end(), name);
    return at == table.names.end() ? nullptr : &table.columns[static_cast<std::size_t>(at - table.names.begin())];
}

/// A name that is nearly one of those that are read is a slip.
void check_names(const RecordText& text, const ColumnTable& table)
{
    const std::vector<std::string> known = {time_name, acceleration_name, displacement_name};
    for (const std::string& name : table.names) {
        const std::string meant = meant_key(name, known);
        if (!meant.empty() && meant != name && column(table, meant) == nullptr)
            text.refuse(
                fmt::format("has a column \"{}\". Did you mean {}? The unit is part of the name.", name, meant));
    }
    const char* todo = "Give a line of names above the rows: time_s first, then acceleration_m_s2 or displacement_m.";
    if (table.names.front() != time_name)
        text.refuse(fmt::format("begins with the column \"{}\", not with time_s. {}", table.names.front(), todo));
    if (column(table, acceleration_name) == nullptr && column(table, displacement_name) == nullptr)
        text.refuse(fmt::format("has no motion: its columns are {}. {}", fmt::join(table.names, ", "), todo));
}

} // namespace

Motion read_base_table(const std::filesystem::path& file)
{
    const std::string content = content_of(file, "a table of the base motion");
    const RecordText text = lines_of(file.string(), content);
    const ColumnTable table = read_columns(text);
    check_names(text, table);
    const std::vector<double>* acceleration = column(table, acceleration_name);
    const std::vector<double>& driving = acceleration ? *acceleration : *column(table, displacement_name);
    const char* name = acceleration ? acceleration_name : displacement_name;
    if (driving.size() < fewest_samples)
        text.refuse(
            fmt::format("has {} samples; it takes at least {} to shake a structure.", driving.size(), fewest_samples));
    const auto [least, most] = std::minmax_element(driving.begin(), driving.end());
    if (acceleration ? *least == 0 && *most == 0 : *least == *most)
        text.refuse(fmt::format("its {} is {} at all times: nothing shakes.", name, *least));

    Motion motion = motion_of(acceleration ? driving : acceleration_through(driving, table.dt_s), table.dt_s);
    motion.predominant_frequency_hz = predominant_frequency(motion.acceleration_m_s2, motion.dt_s);
    motion.source = fmt::format("{}, {}", file.string(), name);
    if (motion.pga_m_s2 > largest_pga_m_s2)
        text.refuse(fmt::format(
            "its {} has a peak acceleration of {:.4g} m/s2, more than {}: {}.", name, motion.pga_m_s2, largest_pga_m_s2,
            acceleration ? "its unit is wrong" : "its unit is wrong, or its samples have too few digits"));
    return motion;
}

} // namespace stylobate
