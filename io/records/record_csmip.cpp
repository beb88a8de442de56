/// California's strong-motion files (CSMIP, formerly CDMG), volumes 1 and 2: channels one below the other.
///
///   V1, uncorrected:  UNCORRECTED ACCELEROGRAM DATA ...   text, 100 integers, 50 reals, the seventh of them the peak
///                     13200 Accelerogram points at 200 pts/sec in units of g .   Format: (8f9.6)
///   V2, corrected:    CORRECTED ACCELEROGRAM ...          text, 100 integers, 100 reals
///                     3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)
///                     and the same for VELOC and DISPL, which are checked and left out
///
/// Each channel ends with a line that begins with "/&", and has a count of its own. The text of a channel holds, in
/// either case of letters, "STATION NO." above the station's name, and "CHAN 1: 90 DEG" above the event's name.
/// Volume 3 (spectra) is refused.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace stylobate {

namespace {

constexpr std::size_t longest_header = 80;     // lines above a channel's first values
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
    FortranFormat format = {8, 10};
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
    else if (lower_case(line).find("accelerogram points") != std::string::npos)
        text.refuse(i, "the format of the values is missing; it should read like \"Format: (8f9.6)\".");
    return block;
}

std::vector<double> read_values(const RecordText& text, std::size_t& line, const Block& block)
{
    const auto [per_line, width] = block.format;
    std::vector<double> values = fixed_width_numbers(text, line + 1, block.count, width, per_line);
    line += 1 + lines_of_values(block.count, per_line);
    return values;
}

/// The line above the accelerations of the channel that begins at `top`.
std::size_t acceleration_line(const RecordText& text, std::size_t top)
{
    const std::size_t end = std::min(text.lines.size(), top + longest_header);
    for (const char* phrase : {"points of accel data", "accelerogram points at"})
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
    const std::string canonical = canonical_unit(unit);
    if (canonical.empty() || !is_number(peak))
        return {};
    return stated_peak_m_s2(number(text, line < data ? line : data - real_header_lines, peak), canonical);
}

/// One channel.
/// @param[in,out] line its first line; afterwards the one below its end
Record read_channel(const RecordText& text, std::size_t& line, const std::string& given)
{
    const std::size_t top = line;
    if (!is_channel_top(text.lines[top]))
        text.refuse(top, fmt::format("\"{}\" stands where the next channel should begin: the count above is wrong, or "
                                     "the file is damaged.",
                                     trimmed(text.lines[top]).substr(0, 40)));
    const std::size_t data = acceleration_line(text, top);
    const Block block = read_block(text, data);
    const std::size_t stated = find_line(text, top, data, "no. of points");
    if (stated < data && sample_count(text, stated, word_after(text.lines[stated], "no. of points")) != block.count)
        text.refuse(data, fmt::format("{} values follow, but line {} states: {}. One of them is wrong.", block.count,
                                      stated + 1, squeezed(text.lines[stated])));
    Record record;
    record.file = text.file;
    record.format = csmip_parser.format;
    record.unit = unit_of_file(text, data, block.unit, given);
    record.dt_s = block.dt_s;
    record.header_pga_m_s2 = header_peak(text, top, data, block);
    const std::size_t chan = chan_line(text, top, data);
    if (chan == data)
        text.refuse(top, "the channel has no line like \"CHAN 1: 90 DEG\".");
    const std::string channel = squeezed(text.lines[chan]);
    record.component = lower_case(channel.substr(0, channel.find(':')));
    record.orientation = word_after(channel, ":");
    record.title = squeezed(text.lines[chan + 1]);
    if (const std::size_t station = find_line(text, top, data, "station no."); station + 1 < data)
        record.station = trimmed(text.lines[station + 1].substr(0, text.lines[station + 1].find("  ")));

    line = data;
    record.acceleration_m_s2 = read_values(text, line, block);
    for (double& a : record.acceleration_m_s2)
        a *= unit_m_s2(record.unit);
    // velocity and displacement are read for their shape only
    const auto follows = [&](std::string_view phrase) {
        return line < text.lines.size() && lower_case(squeezed(text.lines[line])).find(phrase) != std::string::npos;
    };
    while (follows("points of veloc") || follows("points of displ")) {
        Block other = read_block(text, line);
        read_values(text, line, other);
    }
    if (!follows("/&"))
        text.refuse(std::min(line, text.lines.size() - 1),
                    "a line that begins with \"/&\" should end the channel: the file is truncated, or a count in its "
                    "headers is wrong. Obtain the complete file.");
    ++line;
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::string& given)
{
    return one_after_another(text, given, read_channel);
}

} // namespace

const RecordParser csmip_parser = {"csmip", recognise, parse};

} // namespace stylobate
