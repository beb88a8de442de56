/// University of Southern California, volume 1: pairs of time and value as they were digitised from film, unevenly
/// sampled, in g/10.
///
/// A component: "FILE 0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:" and 12 more lines of text (numbers beyond
/// column 72 belong to the tape), 7 lines of integers, 7 of reals, then time and value in turn, 1X,10F7.3.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t text_lines = 13, integer_lines = 7, real_lines = 7, text_columns = 72;
constexpr int width = 7, per_line = 10;

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

/// @param[in,out] line the component's first line; afterwards the one below its last values
Record read_component(const RecordText& text, std::size_t& line, const std::optional<std::string>& given)
{
    const std::size_t top = line;
    if (!is_component_top(text.lines[top]))
        text.refuse(top, fmt::format("\"{}\" follows after all values that the header counts: the count is wrong, or "
                                     "the file is damaged.",
                                     trimmed(text.lines[top]).substr(0, 40)));
    Record record;
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
    line = first_value + lines_of_values(2 * count, per_line);
    const double last_s = fill_from_pairs(text, first_value, per_line, pairs, record);
    if (!(std::fabs(last_s - duration_s) < 0.02))
        text.refuse(points, fmt::format("the stated duration is {} s, but the last time is {} s.", duration_s, last_s));
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    return one_after_another(text, given, read_component);
}

} // namespace

const RecordParser usc_parser = {"usc-volume-1", recognise, parse};

} // namespace stylobate
