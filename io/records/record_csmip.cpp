/// California's strong-motion files (CSMIP, formerly CDMG), volumes 1 and 2: channels one below the other.
///
///   V1, uncorrected:  UNCORRECTED ACCELEROGRAM DATA ...   text, 100 integers, 50 reals, the seventh of them the peak
///                     13200 Accelerogram points at 200 pts/sec in units of g .   Format: (8f9.6)
///   V2, corrected:    CORRECTED ACCELEROGRAM ...          text, 100 integers, 100 reals
///                     3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)
///                     and the same for VELOC and DISPL, which are checked and left out
///
/// Where no format is stated, it is that of the first line of values. Digitised records of other agencies in this
/// layout (Chile's RENADIC) have pairs of time and value instead, with "UNITS OF UNCOR ACCEL ARE SEC AND G/10" in the
/// text and no line above the values.
///
/// Each channel ends with a line that begins with "/&", and has a count of its own. The text of a channel holds, in
/// either case of letters, "STATION NO." above the station's name, and "CHAN 1: 90 DEG" above the event's name.
/// Volume 3 (spectra) is refused.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace stylobate {

namespace {

constexpr std::size_t longest_header = 80; // lines above a channel's first values
constexpr std::size_t longest_text = 20;   // of them, words
constexpr const char* block_phrases[] = {"points of accel data", "accelerogram points at"};
constexpr std::size_t real_header_lines = 7;   // of V1: 50 numbers, 8F10
constexpr std::size_t peak_in_real_header = 6; // its column there, counted from 0

bool is_channel_top(std::string_view line)
{
    const std::string lower = lower_case(squeezed(line));
    return lower.starts_with("corrected accelerogram ") || lower.starts_with("uncorrected accelerogram data");
}

/// The line "CHAN 1: 90 DEG" among the first of a channel; `last` if there is none.
std::size_t chan_line(const RecordText& text, std::size_t first, std::size_t last)
{
    last = std::min(last, text.lines.size());
    for (std::size_t i = first; i < last; ++i) {
        const std::string lower = lower_case(squeezed(text.lines[i]));
        if (lower.starts_with("chan ") && lower.find(':') != std::string::npos)
            return i;
    }
    return last;
}

bool recognise(const RecordText& text)
{
    const std::size_t end = std::min<std::size_t>(text.lines.size(), 12);
    return is_channel_top(text.lines.front()) && chan_line(text, 0, end) < end;
}

/// The line above a block of values: how many, how far apart, in what unit and what Fortran format.
struct Block {
    std::size_t count = 0;
    double dt_s = 0;
    std::string unit; ///< as it is spelled
    FortranFormat format;
};

Block read_block(const RecordText& text, std::size_t i)
{
    const std::string_view line = text.lines[i];
    Block block;
    block.count = sample_count(text, i, parts_of(line, false).front());
    const std::string step = word_after(line, " at ");
    const double at = number(text, i, step);
    block.dt_s = lower_case(line).find("pts/sec") != std::string::npos ? 1 / at : at;
    check_dt(text, i, block.dt_s);
    for (const char* key : {"units of ", "units:", "sec, in "})
        if (block.unit.empty())
            block.unit = word_after(line, key);
    while (block.unit.ends_with(')') || block.unit.ends_with('.'))
        block.unit.pop_back();
    const bool says_format = lower_case(squeezed(line)).find("format:") != std::string::npos;
    if (says_format)
        block.format = fortran_format(text, i, word_after(line, "format"));
    else
        block.format = layout_of(i + 1 < text.lines.size() ? text.lines[i + 1] : "").value_or(FortranFormat{8, 10});
    return block;
}

std::vector<double> read_values(const RecordText& text, std::size_t& line, const Block& block)
{
    const auto [per_line, width] = block.format;
    std::vector<double> values = fixed_width_numbers(text, line + 1, block.count, width, per_line);
    line += 1 + lines_of_values(block.count, per_line);
    return values;
}

/// The line of the text that says that the values are pairs of time and acceleration; `last` if there is none.
std::size_t pairs_line(const RecordText& text, std::size_t top, std::size_t last)
{
    return find_line(text, top, last, " are sec and ");
}

/// Whether no line like "3251 POINTS OF ACCEL DATA" stands where a channel's first values begin.
bool is_without_blocks(const RecordText& text, std::size_t top)
{
    const std::size_t end = std::min(text.lines.size(), top + longest_header);
    return std::all_of(std::begin(block_phrases), std::end(block_phrases),
                       [&](const char* phrase) { return find_line(text, top, end, phrase) == end; });
}

/// The line above the accelerations of the channel that begins at `top`.
std::size_t acceleration_line(const RecordText& text, std::size_t top)
{
    const std::size_t end = std::min(text.lines.size(), top + longest_header);
    for (const char* phrase : block_phrases)
        if (const std::size_t i = find_line(text, top, end, phrase); i < end)
            return i;
    for (const char* other : {"points of veloc", "points of displ"})
        if (const std::size_t i = find_line(text, top, end, other); i < end)
            text.refuse(i, fmt::format("the channel's first values are \"{}\": it is not an acceleration.",
                                       squeezed(text.lines[i]).substr(0, 40)));
    text.refuse(top, "the channel has no line like \"3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC.\" or "
                     "\"13200 Accelerogram points at 200 pts/sec\" above its values: it is truncated, or of spectra, "
                     "or unevenly sampled.");
}

/// The peak of the real-number header (V1, in the unit of the values) or of the text (V2).
std::optional<double> header_peak(const RecordText& text, std::size_t top, std::size_t data, const Block& block)
{
    const std::size_t line = find_line(text, top, data, "peak acceleration");
    std::string peak, unit = block.unit;
    if (line < data) {
        peak = word_after(text.lines[line], "peak acceleration");
        unit = word_after(text.lines[line], lower_case(peak) + " ");
    } else if (data >= top + real_header_lines && text.lines[data - real_header_lines].size() >= 10) {
        const std::string_view reals = text.lines[data - real_header_lines];
        peak = trimmed(reals.substr(std::min(peak_in_real_header * 10, reals.size()), 10));
    }
    const auto canonical = canonical_unit(unit);
    if (!canonical || !is_number(peak))
        return {};
    return stated_peak_m_s2(number(text, line < data ? line : data - real_header_lines, peak), *canonical);
}

/// Below the text of a channel of pairs: 100 integers, 50 reals, the pairs.
/// @param units the line that says so
/// @param[in,out] line the channel's first line; afterwards the one below its values
void read_pairs(const RecordText& text, std::size_t units, std::size_t& line, const std::optional<std::string>& given,
                Record& record)
{
    constexpr std::size_t integer_lines = 7;
    const std::size_t points = header_line(text, line, units - line, "no. of points");
    const std::size_t count = sample_count(text, points, word_after(text.lines[points], "no. of points"));
    record.unit = unit_of_file(text, units, word_after(text.lines[units], " sec and "), given);
    std::size_t numbers = units + 1;
    while (numbers < text.lines.size() && !is_row(text.lines[numbers]))
        ++numbers;
    std::size_t first_value = numbers + integer_lines + real_header_lines;
    if (first_value >= text.lines.size())
        text.refuse(line, "the file ends inside its header: it is truncated.");
    const std::size_t end = find_line(text, first_value, text.lines.size(), "/&");
    std::optional<FortranFormat> layout; // of a full line
    for (std::size_t i = first_value; i < end; ++i)
        if (const auto of_line = layout_of(text.lines[i]); of_line && (!layout || of_line->per_line > layout->per_line))
            layout = of_line;
    if (!layout || layout->per_line % 2 != 0 || count > text.lines.size() * static_cast<std::size_t>(layout->per_line))
        text.refuse(first_value,
                    fmt::format("{} pairs of time and value should begin here, in columns of one width.", count));
    // some files have lines of pairs of another record above their own: the time begins again below them
    const std::size_t lines = lines_of_values(2 * count, layout->per_line);
    if (end > first_value + lines) {
        const auto time = [&](std::size_t i) { return number(text, i, parts_of(text.lines[i], false).front()); };
        if (time(end - lines) > time(first_value))
            text.refuse(points,
                        fmt::format("the header counts {} pairs, and more lines than these follow: the count is "
                                    "wrong, or the file is damaged.",
                                    count));
        record.note = fmt::format("without {} lines of other values above the {} pairs that the header counts",
                                  end - lines - first_value, count);
        first_value = end - lines;
    }
    const auto pairs = fixed_width_numbers(text, first_value, 2 * count, layout->width, layout->per_line);
    const double last_s = fill_from_pairs(text, first_value, layout->per_line, pairs, record);
    const std::string length = word_after(text.lines[points], "record length");
    if (is_number(length) && std::fabs(last_s - number(text, points, length)) > 2 * record.dt_s + 0.02)
        text.refuse(points,
                    fmt::format("the stated record length is {} s, but the last time is {} s.", length, last_s));
    if (const std::string peak = word_after(text.lines[units], "max"); is_number(peak))
        if (const auto unit = canonical_unit(word_after(text.lines[units], lower_case(peak) + " ")))
            record.header_pga_m_s2 = stated_peak_m_s2(number(text, units, peak), *unit);
    line = first_value + lines;
}

/// What the text of a channel says of its place.
/// @param end line below the text
void read_names(const RecordText& text, std::size_t top, std::size_t end, Record& record)
{
    const std::size_t chan = chan_line(text, top, end);
    if (chan == end)
        text.refuse(top, "the channel has no line like \"CHAN 1: 90 DEG\".");
    const std::string channel = squeezed(text.lines[chan]);
    record.component = lower_case(channel.substr(0, channel.find(':')));
    record.orientation = word_after(channel, ":");
    record.title = squeezed(text.lines[chan + 1]);
    if (const std::size_t station = find_line(text, top, end, "station no."); station + 1 < end)
        record.station = trimmed(text.lines[station + 1].substr(0, text.lines[station + 1].find("  ")));
}

/// The values of a channel that stand in evenly spaced blocks, acceleration first.
/// @param[in,out] line the channel's first line; afterwards the one below its values
void read_blocks(const RecordText& text, std::size_t data, std::size_t& line, const std::optional<std::string>& given,
                 Record& record)
{
    const Block block = read_block(text, data);
    const std::size_t stated = find_line(text, line, data, "no. of points");
    if (stated < data && sample_count(text, stated, word_after(text.lines[stated], "no. of points")) != block.count)
        text.refuse(data, fmt::format("{} values follow, but line {} states: {}. One of them is wrong.", block.count,
                                      stated + 1, squeezed(text.lines[stated])));
    record.unit = unit_of_file(text, data, block.unit, given);
    record.dt_s = block.dt_s;
    record.header_pga_m_s2 = header_peak(text, line, data, block);
    line = data;
    record.acceleration_m_s2 = read_values(text, line, block);
    // velocity and displacement are read for their shape only
    while (line < text.lines.size()) {
        const std::string above = lower_case(squeezed(text.lines[line]));
        if (above.find("points of veloc") == std::string::npos && above.find("points of displ") == std::string::npos)
            break;
        read_values(text, line, read_block(text, line));
    }
}

/// One channel.
/// @param[in,out] line its first line; afterwards the one below its end
Record read_channel(const RecordText& text, std::size_t& line, const std::optional<std::string>& given)
{
    const std::size_t top = line;
    if (!is_channel_top(text.lines[top]))
        text.refuse(top, fmt::format("\"{}\" stands where the next channel should begin: the count above is wrong, or "
                                     "the file is damaged.",
                                     trimmed(text.lines[top]).substr(0, 40)));
    Record record;
    const std::size_t end = std::min(text.lines.size(), top + longest_text);
    if (const std::size_t pairs = pairs_line(text, top, end); pairs < end && is_without_blocks(text, top)) {
        read_names(text, top, pairs, record);
        read_pairs(text, pairs, line, given, record);
    } else {
        const std::size_t data = acceleration_line(text, top);
        read_names(text, top, data, record);
        read_blocks(text, data, line, given, record);
    }
    if (line >= text.lines.size() || !trimmed(text.lines[line]).starts_with("/&"))
        text.refuse(std::min(line, text.lines.size() - 1),
                    "a line that begins with \"/&\" should end the channel: the file is truncated, or a count in its "
                    "headers is wrong. Obtain the complete file.");
    ++line;
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    return one_after_another(text, given, read_channel);
}

} // namespace

const RecordParser csmip_parser = {"csmip", recognise, parse};

} // namespace stylobate
