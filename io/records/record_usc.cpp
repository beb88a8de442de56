/// University of Southern California, volume 1: pairs of time and value as they were digitised from film, unevenly
/// sampled, in g/10.
///
/// A component: "FILE 0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:" and 12 more lines of text (numbers beyond
/// column 72 belong to the tape), 7 lines of integers, 7 of reals, then time and value in turn, 1X,10F7.3.
///
/// The grid. The times are printed in whole milliseconds. The record is given on the widest even grid that has every
/// one of them on it: their greatest common divisor, 1 ms where they are as uneven as film. Values between are linear.
/// So each sample stays at its time with its value, the PGA is that of the file to the last bit, and nothing is
/// smoothed, which a grid as wide as the mean spacing would do to a peak between two of its points.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

constexpr std::size_t text_lines = 13, integer_lines = 7, real_lines = 7, text_columns = 72;
constexpr int width = 7, per_line = 10;
constexpr double time_unit_s = 0.001;

bool is_component_top(std::string_view line)
{
    return lower_case(squeezed(line)).find("of uncorrected accelerogram data of volume i") != std::string::npos;
}

bool recognise(const RecordText& text)
{
    return is_component_top(text.lines.front());
}

std::string_view text_of(std::string_view line)
{
    return line.substr(0, text_columns);
}

/// Where each sample was taken, in whole milliseconds, growing.
std::vector<long> times_of(const RecordText& text, std::size_t first_value, const std::vector<double>& pairs)
{
    std::vector<long> times_ms;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
        const std::size_t line = first_value + i / per_line;
        const double ms = std::round(pairs[i] / time_unit_s);
        // seven columns with three decimals hold no more
        if (!(std::fabs(ms * time_unit_s - pairs[i]) < 1e-6) || !(ms >= 0 && ms < 1e6))
            text.refuse(line,
                        fmt::format("the time {} s is not a whole number of milliseconds below 1000 s.", pairs[i]));
        const long time = static_cast<long>(ms);
        if (!times_ms.empty() && time <= times_ms.back())
            text.refuse(
                line, fmt::format("the time {} s follows {} s: times must increase. A value is missing or duplicated.",
                                  pairs[i], pairs[i - 2]));
        if (!times_ms.empty() && static_cast<double>(time - times_ms.back()) * time_unit_s > longest_dt_s)
            text.refuse(line, fmt::format("the time goes from {} s to {} s, more than {} s: values are missing.",
                                          pairs[i - 2], pairs[i], longest_dt_s));
        times_ms.push_back(time);
    }
    return times_ms;
}

/// @param[in,out] line the component's first line; afterwards the one below its last values
Record read_component(const RecordText& text, std::size_t& line, const std::string& given)
{
    const std::size_t top = line;
    if (!is_component_top(text.lines[top]))
        text.refuse(top, fmt::format("\"{}\" follows after all values that the header counts: the count is wrong, or "
                                     "the file is damaged.",
                                     trimmed(text.lines[top]).substr(0, 40)));
    Record record;
    record.file = text.file;
    record.format = usc_parser.format;
    record.orientation = word_after(text_of(text.lines[header_line(text, top, text_lines, "comp ")]), "comp ");
    record.component = record.orientation;
    const std::size_t station = header_line(text, top, text_lines, "station");
    if (station + 1 < text.lines.size())
        record.station = squeezed(text_of(text.lines[station + 1]));
    const std::size_t epicentre = header_line(text, top, text_lines, "epicenter");
    if (epicentre > top + 1)
        record.title = squeezed(text_of(text.lines[epicentre - 1]));
    const std::size_t units = header_line(text, top, text_lines, "units are");
    record.unit = unit_of_file(text, units, word_after(text_of(text.lines[units]), " and "), given);
    const std::size_t points = header_line(text, top, text_lines, "no. of points");
    const std::size_t count = sample_count(text, points, word_after(text.lines[points], "no. of points"));
    const double duration_s = number(text, points, word_after(text_of(text.lines[points]), "duration"));

    const std::size_t first_value = top + text_lines + integer_lines + real_lines;
    if (count > text.lines.size() * per_line)
        text.refuse(points, fmt::format("the header announces {} samples, more than the size of the file allows: it is "
                                        "truncated, or its header is wrong.",
                                        count));
    const auto pairs = fixed_width_numbers(text, first_value, 2 * count, width, per_line, 1);
    line = first_value + (2 * count + per_line - 1) / per_line;
    const std::vector<long> times_ms = times_of(text, first_value, pairs);
    const double last_s = static_cast<double>(times_ms.back()) * time_unit_s;
    if (!(std::fabs(last_s - duration_s) < 0.02))
        text.refuse(points, fmt::format("the stated duration is {} s, but the last time is {} s.", duration_s, last_s));

    long step_ms = 0, longest_ms = 0;
    for (std::size_t i = 1; i < count; ++i) {
        step_ms = std::gcd(step_ms, times_ms[i] - times_ms[i - 1]);
        longest_ms = std::max(longest_ms, times_ms[i] - times_ms[i - 1]);
    }
    record.dt_s = static_cast<double>(step_ms) * time_unit_s;
    if (longest_ms > step_ms)
        record.note =
            fmt::format("{} uneven samples, up to {} ms apart, on an even grid of {} ms that has all of their "
                        "times; straight lines between, the PGA is that of the samples",
                        count, longest_ms, step_ms);
    const double factor = unit_m_s2(record.unit);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const long steps = (times_ms[i + 1] - times_ms[i]) / step_ms;
        const double from = pairs[2 * i + 1], rise = pairs[2 * i + 3] - from;
        for (long k = 0; k < steps; ++k)
            record.acceleration_m_s2.push_back(factor *
                                               (from + rise * static_cast<double>(k) / static_cast<double>(steps)));
    }
    record.acceleration_m_s2.push_back(factor * pairs.back());
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::string& given)
{
    std::vector<Record> records;
    for (std::size_t line = 0; line < text.lines.size();) {
        const std::string_view content = trimmed(text.lines[line]);
        if (content.empty() || (content.starts_with("/&") && !records.empty()))
            ++line;
        else
            records.push_back(read_component(text, line, given));
    }
    return records;
}

} // namespace

const RecordParser usc_parser = {"usc-volume-1", recognise, parse};

} // namespace stylobate
