/// COSMOS strong-motion format, version 1.2, volumes 1 (uncorrected) and 2 (corrected): channels one below the other.
///
/// A channel, by "COSMOS Strong Motion Data Format", version 1.20 of 2001, and its tables:
///   text       "Corrected acceleration    (Format v01.20 with 13 text lines)", line 5 has the station's code
///              ("Code:AK-BMR"), line 9 the channel, line 13 the values that mean "unknown"
///   integers   100 Integer-header values follow on  10 lines, Format= (10I8)
///              1 is the volume, 2 the quantity (1 acceleration, 2 velocity, 3 displacement), 3 the unit, 54 the
///              azimuth: 1 to 360, or a code above 360 (400 up, 401 down, ...)
///   reals      100 Real-header values follow on  20 lines, Format= (5F15.6)
///              62 is the sampling interval of the values [ms] (34 is that of the recorder [s], which may be another),
///              63 their duration [s], 64 their peak
///   comments   6 Comment line(s) follow, each starting with a "|":     a blank before the bar occurs
///   values     42000 acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(1E15.6)
///   End-of-data for ChanBNZ acceleration             or, as in the format's own sample, "/& ... End of data ..."
///
/// Units of acceleration (table 2): 2 g, 4 cm/s2, 10 gal; others are refused by name, among them 50, the counts of
/// volume 0. Channels of velocity and displacement, and such blocks below an acceleration, are read for their shape
/// and left out; a file that has nothing else is refused.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t longest_text = 60; // lines above the integers
constexpr std::size_t station_line = 4, channel_line = 8;

bool is_channel_top(std::string_view line)
{
    const std::string lower = lower_case(squeezed(line));
    return lower.find("(format v") != std::string::npos && lower.find("text lines)") != std::string::npos;
}

bool recognise(const RecordText& text)
{
    return is_channel_top(text.lines.front());
}

/// @throws InputError if line `i` does not exist
std::string_view line_at(const RecordText& text, std::size_t i)
{
    if (i >= text.lines.size())
        text.refuse(text.lines.size() - 1,
                    "the file ends inside a channel: it is truncated. Obtain the complete file.");
    return text.lines[i];
}

/// The numbers below a line like "100 Real-header values follow on  20 lines, Format= (5F15.6)".
/// @param[in,out] line that line; afterwards the one below the numbers
std::vector<double> header_numbers(const RecordText& text, std::size_t& line, std::string_view phrase,
                                   std::size_t at_least)
{
    const std::string_view above = line_at(text, line);
    if (lower_case(squeezed(above)).find(phrase) == std::string::npos)
        text.refuse(line, fmt::format("a line like \"100 {} follow ...\" should stand here.", phrase));
    const std::size_t count = sample_count(text, line, parts_of(above, false).front());
    if (count < at_least)
        text.refuse(line, fmt::format("the header has {} numbers; at least {} are needed.", count, at_least));
    const auto [per_line, width] = fortran_format(text, line, word_after(above, "format"));
    auto numbers = fixed_width_numbers(text, line + 1, count, width, per_line);
    line += 1 + lines_of_values(count, per_line);
    return numbers;
}

/// The headers of a channel.
struct Header {
    std::size_t top = 0, integer_line = 0, real_line = 0;
    std::vector<double> integers, reals;
    double unknown = -999;           ///< what stands for a value that is not known
    std::optional<std::string> code; ///< "BNZ" of the comment "|<SCNL>BMR.BNZ.AK.--"; nullopt if there is none
};

/// @param[in,out] line the channel's first line; afterwards the one above its first values
Header read_header(const RecordText& text, std::size_t& line)
{
    Header header;
    header.top = line;
    const std::size_t end = std::min(text.lines.size(), line + longest_text);
    line = find_line(text, line, end, "integer-header values follow");
    if (line == end)
        text.refuse(header.top, "the channel has no line like \"100 Integer-header values follow on  10 lines, Format= "
                                "(10I8)\": it is truncated, or damaged.");
    if (line < header.top + channel_line + 1)
        text.refuse(line, "the text of the channel's header is shorter than its 13 lines.");
    if (const auto words = parts_of(text.lines[line - 1], true); is_number(words.back()))
        header.unknown = number(text, line - 1, words.back());
    header.integer_line = line;
    header.integers = header_numbers(text, line, "integer-header values", 54);
    header.real_line = line;
    header.reals = header_numbers(text, line, "real-header values", 64);

    const std::string_view comments = line_at(text, line);
    if (lower_case(comments).find("comment line") == std::string::npos)
        text.refuse(line, "a line like \"1 Comment line(s) follow, each starting with a |\" should stand here.");
    const double stated = number(text, line, parts_of(comments, false).front());
    const std::size_t first = line + 1;
    for (++line; trimmed(line_at(text, line)).starts_with('|'); ++line)
        if (const std::string scnl = word_after(text.lines[line], "<scnl>"); !scnl.empty()) {
            const std::size_t dot = std::min(scnl.find('.'), scnl.size());
            std::string code = scnl.substr(std::min(dot + 1, scnl.size()));
            code.resize(std::min(code.find('.'), code.size()));
            header.code = code.empty() ? std::nullopt : std::optional(code);
        }
    if (static_cast<double>(line - first) != stated)
        text.refuse(first - 1, fmt::format("{} comment lines are announced and {} follow.", stated, line - first));
    return header;
}

/// The line above a block of values.
struct Block {
    std::size_t count = 0;
    bool acceleration = false;
    std::string quantity;            ///< as it is spelled
    double seconds = 0;              ///< a whole number, cut or rounded
    std::string unit;                ///< as it is spelled
    std::optional<std::string> code; ///< "04" of "cm/sec2(04)"; nullopt if it has none
    FortranFormat format;
};

bool is_block(std::string_view line)
{
    const std::string lower = lower_case(squeezed(line));
    return lower.find(" pts, ") != std::string::npos && lower.find("format") != std::string::npos;
}

Block read_block(const RecordText& text, std::size_t i)
{
    const std::string words = squeezed(line_at(text, i));
    const std::string lower = lower_case(words);
    if (!is_block(words))
        text.refuse(i, "a line like \"42000 acceleration pts, approx 210 secs, units=cm/sec2(04),Format=(1E15.6)\" "
                       "should stand here: the channel holds no such values (spectra?), or is damaged.");
    Block block;
    const std::size_t first = words.find(' ') + 1;
    block.count = sample_count(text, i, std::string_view(words).substr(0, first - 1));
    block.quantity = words.substr(first, lower.find(" pts, ") - first);
    block.acceleration = lower_case(block.quantity).find("accel") != std::string::npos;
    block.seconds = number(text, i, word_after(words, "approx"));
    block.unit = word_after(words, "units");
    if (const std::size_t bracket = lower.find('(', std::min(lower.find("units"), lower.size()));
        bracket < lower.find("format"))
        block.code = words.substr(bracket + 1, std::min(words.find(')', bracket), words.size()) - bracket - 1);
    block.unit.resize(std::min(block.unit.find('('), block.unit.size()));
    while (block.unit.ends_with('.'))
        block.unit.pop_back();
    block.format = fortran_format(text, i, word_after(words, "format"));
    return block;
}

/// The unit by its code in the integer header, with which the spelling and the code above the values must agree.
std::string unit_of(const RecordText& text, std::size_t i, const Header& header, const Block& block,
                    const std::optional<std::string>& given)
{
    const double code = header.integers[2];
    if (header.integers[1] != 1)
        text.refuse(
            header.integer_line + 1,
            fmt::format(
                "integer 2 gives the quantity code {}, but line {} gives an acceleration (1). One of them is wrong.",
                header.integers[1], i + 1));
    if (block.code && number(text, i, *block.code) != code)
        text.refuse(i, fmt::format("the unit's code is {} here and {} in line {}. One of them is wrong.", *block.code,
                                   code, header.integer_line + 2));
    const char* unit = code == 2 ? "g" : code == 4 || code == 10 ? "cm/s2" : nullptr;
    if (code == 50)
        text.refuse(i, "the values are counts of the recorder (unit 50). Give the uncorrected or corrected "
                       "acceleration (volume 1 or 2).");
    if (!unit)
        text.refuse(header.integer_line + 1,
                    fmt::format("the unit of acceleration has code {} (\"{}\"); known are 2 (g), 4 (cm/s2) and 10 "
                                "(gal).",
                                code, block.unit));
    if (canonical_unit(block.unit) != unit)
        text.refuse(i, fmt::format("the unit is \"{}\" here, and has code {} ({}) in line {}. One of them is wrong.",
                                   block.unit, code, unit, header.integer_line + 2));
    return unit_of_file(text, i, unit, given);
}

/// "360", "Up"; the channel's code where the header does not know its direction.
std::string orientation_of(const Header& header)
{
    const double azimuth = header.integers[53];
    if (azimuth >= 1 && azimuth <= 360)
        return fmt::format("{}", azimuth);
    struct Named {
        double code;
        const char* name;
    };
    for (const Named& direction : {Named{400, "Up"},
                                   {401, "Down"},
                                   {402, "Vertical"},
                                   {500, "Radial"},
                                   {501, "Transverse"},
                                   {600, "Longitudinal"},
                                   {601, "Tangential"}})
        if (azimuth == direction.code)
            return direction.name;
    return header.code.value_or("");
}

/// "chan 1" of "Sta Chan   1: 90 deg (Rcrdr Chan  1)"; the channel's code where it has no number.
std::string component_of(const RecordText& text, const Header& header)
{
    const std::string_view line = text.lines[header.top + channel_line];
    std::string channel = word_after(line, "sta chan");
    if (channel.empty())
        channel = word_after(line, "sta cha"); // in the format's own sample
    channel.resize(std::min(channel.find(':'), channel.size()));
    if (is_number(channel))
        return "chan " + channel;
    return header.code.value_or("acceleration");
}

Record acceleration_of(const RecordText& text, std::size_t i, const Header& header, const Block& block,
                       const std::optional<std::string>& given, std::vector<double> values)
{
    Record record;
    record.unit = unit_of(text, i, header, block, given);
    record.station = word_after(text.lines[header.top + station_line], "code:");
    record.title = squeezed(text.lines[header.top + 1]);
    record.orientation = orientation_of(header);
    record.component = component_of(text, header);

    const double step_ms = header.reals[61], duration_s = header.reals[62], peak = header.reals[63];
    if (step_ms == header.unknown)
        text.refuse(header.real_line, "the header does not contain the sampling interval (real 62).");
    record.dt_s = step_ms / 1000;
    check_dt(text, header.real_line, record.dt_s);
    const double lasts = static_cast<double>(block.count) * record.dt_s;
    // n or n - 1 steps; the seconds of the line above the values are whole
    if (duration_s != header.unknown && std::fabs(lasts - duration_s) > 2 * record.dt_s)
        text.refuse(header.real_line, fmt::format("{} samples every {} s last {} s, but real 63 gives {} s.",
                                                  block.count, record.dt_s, lasts, duration_s));
    if (std::fabs(lasts - block.seconds) > 1 + 2 * record.dt_s)
        text.refuse(i, fmt::format("{} samples every {} s (real 62) last {} s, but this line gives {} s.", block.count,
                                   record.dt_s, lasts, block.seconds));
    if (peak != header.unknown)
        record.header_pga_m_s2 = stated_peak_m_s2(peak, record.unit);
    const auto per_line = static_cast<std::size_t>(block.format.per_line);
    for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k] == header.unknown)
            text.refuse(i + 1 + k / per_line, fmt::format("value {} is {}, the header's code for \"unknown\".",
                                                          k % per_line + 1, header.unknown));
    record.acceleration_m_s2 = std::move(values);
    return record;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    std::vector<Record> records;
    std::string others;
    for (std::size_t line = 0; line < text.lines.size();) {
        if (trimmed(text.lines[line]).empty() || (!records.empty() && is_end_mark(text.lines[line]))) {
            ++line;
            continue;
        }
        if (!is_channel_top(text.lines[line]))
            text.refuse(line, fmt::format("\"{}\" stands where the next channel should begin, with a line like "
                                          "\"Corrected acceleration (Format v01.20 with 13 text lines)\".",
                                          trimmed(text.lines[line]).substr(0, 40)));
        const Header header = read_header(text, line);
        do {
            const Block block = read_block(text, line);
            const auto [per_line, width] = block.format;
            auto values = fixed_width_numbers(text, line + 1, block.count, width, per_line);
            if (block.acceleration)
                records.push_back(acceleration_of(text, line, header, block, given, std::move(values)));
            else
                others += (others.empty() ? "" : ", ") + block.quantity;
            line += 1 + lines_of_values(block.count, per_line);
        } while (is_block(line_at(text, line)));
        if (const std::string end = lower_case(squeezed(text.lines[line]));
            !end.starts_with("end-of-data") && !end.starts_with("/&"))
            text.refuse(line, "a line that begins with \"End-of-data\" should end the channel: the file is damaged, or "
                              "a count in its headers is wrong.");
        ++line;
    }
    if (records.empty())
        text.refuse(fmt::format("contains \"{}\" and no acceleration. Give the file with the acceleration.", others));
    return records;
}

} // namespace

const RecordParser cosmos_parser = {"cosmos", recognise, parse};

} // namespace stylobate
