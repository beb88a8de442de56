/// New Zealand's files (GeoNet, GNS Science), volumes 1 (V1A) and 2 (V2A): three components one below the other.
///
/// A component, by GeoNet's page "Strong Motion File Formats":
///   16 lines of text      "Site WTMC" (line 2), "Component N28W" (13), "Acceleration: peak -9733.1 mm/s/s" (14)
///    4 lines, 10I8        integers 34, 35 and 36 count the values of acceleration, velocity and displacement
///    6 lines, 10F8.0      real 24 is their duration [s], 26 their sampling interval [s]; 25 is that of the instrument
///   accelerations in mm/s2, velocities in mm/s, displacements in mm, each 10F8.1 or so and on a line of its own
///
/// The uncorrected V1A has no velocities and displacements; those of V2A are read for their shape and left out.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace stylobate {

namespace {

constexpr std::size_t text_lines = 16, integer_lines = 4, real_lines = 6;
constexpr std::size_t site_line = 1, name_line = 2, date_line = 7, readings_line = 10, component_line = 12;
constexpr std::size_t peak_line = 13;
constexpr int width = 8, per_line = 10;

bool is_component_top(std::string_view line)
{
    const std::string lower = lower_case(squeezed(line));
    return lower.starts_with("corrected accelerogram ") || lower.starts_with("uncorrected accelerogram ");
}

bool recognise(const RecordText& text)
{
    return text.lines.size() > site_line && is_component_top(text.lines.front()) &&
           lower_case(squeezed(text.lines[site_line])).starts_with("site ");
}

/// The unit that the header spells; that of the format's definition where it spells none.
std::string unit_of(const RecordText& text, std::size_t top, const std::optional<std::string>& given)
{
    constexpr std::string_view defined = "mm/s2";
    const std::size_t peak = top + peak_line;
    const std::string value = word_after(text.lines[peak], "peak ");
    const std::string spelled = is_number(value) ? word_after(text.lines[peak], value + " ") : std::string();
    if (!spelled.empty() && canonical_unit(spelled) != defined)
        text.refuse(peak, fmt::format("the unit of the acceleration is \"{}\"; the format has {}.", spelled, defined));
    // film readings before their scale was applied
    const std::size_t readings = top + readings_line;
    const std::string scale = word_after(text.lines[readings], "readings in units of ");
    if (!scale.empty() && (number(text, readings, scale) != 1 ||
                           canonical_unit(word_after(text.lines[readings], scale + " ")) != defined))
        text.refuse(readings, fmt::format("the values are in units other than 1.00 mm/s/s (\"{}\"): they are not "
                                          "accelerations. Give the corrected file (V2A).",
                                          squeezed(text.lines[readings])));
    return unit_of_file(text, peak, defined, given);
}

/// Integer `which` of the header, counted from 1 as the format's definition does, as it stands in the file.
std::string_view integer_at(const RecordText& text, std::size_t top, std::size_t which)
{
    const std::string_view line = text.lines[top + text_lines + (which - 1) / per_line];
    return trimmed(line.substr((which - 1) % per_line * width, width));
}

/// @param[in,out] line the component's first line; afterwards the one below its end
Record read_component(const RecordText& text, std::size_t& line, const std::optional<std::string>& given)
{
    const std::size_t top = line;
    if (!is_component_top(text.lines[top]))
        text.refuse(top, fmt::format("\"{}\" stands where the next component should begin, with \"Corrected "
                                     "accelerogram\": the counts above are wrong, or the file is damaged.",
                                     trimmed(text.lines[top]).substr(0, 40)));
    const std::size_t first_integer = top + text_lines, first_real = first_integer + integer_lines;
    fixed_width_numbers(text, first_integer, integer_lines * per_line, width, per_line);
    const auto reals = fixed_width_numbers(text, first_real, real_lines * per_line, width, per_line);
    Record record;
    record.unit = unit_of(text, top, given);
    record.station = word_after(text.lines[top + site_line], "site ");
    record.title = squeezed(text.lines[top + name_line]) + ", " + squeezed(text.lines[top + date_line]);
    record.orientation = word_after(text.lines[top + component_line], "component ");
    if (record.orientation.empty())
        text.refuse(top + component_line, "the component's direction should stand here, as in \"Component N28W\".");
    record.component = record.orientation;
    if (const std::string peak = word_after(text.lines[top + peak_line], "peak "); is_number(peak))
        record.header_pga_m_s2 = stated_peak_m_s2(number(text, top + peak_line, peak), record.unit);

    const std::size_t count = sample_count(text, first_integer + 3, integer_at(text, top, 34));
    const double duration_s = reals[23];
    record.dt_s = reals[25];
    check_dt(text, first_real + 2, record.dt_s);
    const double n = static_cast<double>(count);
    if (std::fabs((n - 1) * record.dt_s - duration_s) > 2 * record.dt_s + 0.01) // n or n - 1 steps, in two decimals
        text.refuse(first_real + 2, fmt::format("{} samples every {} s last {:.2f} s, but the stated duration is {} s.",
                                                count, record.dt_s, n * record.dt_s, duration_s));

    line = first_real + real_lines;
    for (const std::size_t which : {34u, 35u, 36u}) {
        const bool none = integer_at(text, top, which) == "0";
        const std::size_t values = none ? 0 : sample_count(text, first_integer + 3, integer_at(text, top, which));
        auto series = fixed_width_numbers(text, line, values, width, per_line);
        line += lines_of_values(values, per_line);
        if (which == 34)
            record.acceleration_m_s2 = std::move(series);
    }
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    std::vector<Record> records = one_after_another(text, given, read_component);
    // two horizontal ones may be given one direction by mistake: no name stands for both
    std::map<std::string, int> named;
    for (Record& record : records)
        if (const int nth = ++named[record.orientation]; nth > 1)
            record.component += fmt::format(" ({})", nth);
    return records;
}

} // namespace

const RecordParser geonet_parser = {"geonet", recognise, parse};

} // namespace stylobate
