/// Iran's strong-motion files (BHRC), volume 1: components one below the other, uncorrected, evenly sampled, in g/10.
///
/// A component: "* VOL1DS FILE: ..." and 12 more lines of text, 7 lines of integers and 7 of reals (both cut after
/// column 70), the ninth real being the sampling rate, then the values, 10E13.6, and a line "/&".

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t text_lines = 13, integer_lines = 7, real_lines = 7;
constexpr int width = 13, per_line = 10;
constexpr std::string_view component_top = "* vol1ds file:";

bool is_component_top(std::string_view line)
{
    return lower_case(squeezed(line)).starts_with(component_top);
}

bool recognise(const RecordText& text)
{
    return is_component_top(text.lines.front());
}

/// "140" for T of "Azimuth L 50    T 140"; the component's letter where it has no azimuth.
std::string orientation_of(std::string_view place, const std::string& component)
{
    const std::string letter = component.substr(0, 1);
    const std::string words = squeezed(place);
    const std::size_t azimuth = lower_case(words).find("azimuth");
    const std::string angle = azimuth == std::string::npos
                                  ? ""
                                  : word_after(std::string_view(words).substr(azimuth), " " + lower_case(letter) + " ");
    return is_number(angle) ? angle : letter;
}

/// @param[in,out] line the component's first line; afterwards the one below its end
Record read_component(const RecordText& text, std::size_t& line, const std::optional<std::string>& given)
{
    const std::size_t top = line;
    if (!is_component_top(text.lines[top]))
        text.refuse(top, fmt::format("\"{}\" stands where the next component should begin, with \"* VOL1DS FILE:\".",
                                     trimmed(text.lines[top]).substr(0, 40)));
    Record record;
    record.component = word_after(text.lines[header_line(text, top, text_lines, "comp ")], "comp ");
    const std::size_t place = header_line(text, top, text_lines, "station");
    record.station = trimmed(text.lines[place].substr(0, lower_case(text.lines[place]).find("station")));
    record.orientation = orientation_of(text.lines[place], record.component);
    record.title = squeezed(text.lines[header_line(text, top, text_lines, "origin time")]) + ", " +
                   squeezed(text.lines[header_line(text, top, text_lines, "epicenter")]);
    const std::size_t units = header_line(text, top, text_lines, "units are");
    record.unit = unit_of_file(text, units, word_after(text.lines[units], " and "), given);

    const std::size_t points = header_line(text, top, text_lines, "no. of points");
    const std::size_t count = sample_count(text, points, word_after(text.lines[points], "no. of points"));
    const double duration_s = number(text, points, word_after(text.lines[points], "duration"));
    const std::size_t reals = top + text_lines + integer_lines, first_value = reals + real_lines;
    if (reals + 1 >= text.lines.size())
        text.refuse(top, "the file ends inside its header: it is truncated.");
    const double rate = number(text, reals + 1, trimmed(text.lines[reals + 1].substr(0, width)));
    record.dt_s = 1 / rate;
    check_dt(text, reals + 1, record.dt_s);
    if (std::fabs(static_cast<double>(count) * record.dt_s - duration_s) > 2 * record.dt_s)
        text.refuse(
            points,
            fmt::format("{} samples at the {} per second of line {} last {} s, but the stated duration is {} s.", count,
                        rate, reals + 2, static_cast<double>(count) * record.dt_s, duration_s));

    record.acceleration_m_s2 = fixed_width_numbers(text, first_value, count, width, per_line);
    line = first_value + lines_of_values(count, per_line);
    if (line >= text.lines.size() || !trimmed(text.lines[line]).starts_with("/&"))
        text.refuse(std::min(line, text.lines.size() - 1),
                    "a line \"/&\" should end the component: the file is truncated, or the count in its header is "
                    "wrong. Obtain the complete file.");
    ++line;
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    return one_after_another(text, given, read_component);
}

} // namespace

const RecordParser bhrc_parser = {"bhrc", recognise, parse};

} // namespace stylobate
