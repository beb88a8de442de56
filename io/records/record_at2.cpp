/// PEER .AT2: some header lines, the last of which gives NPTS and DT, then NPTS values, several to a line.
///
/// Spellings of that line that occur:
///   NPTS=  5372, DT=   .0100 SEC,          as downloaded
///   NPTS=   7500  DT=   .0200 SEC,
///   NPTS=  2000, DT= .02000 SEC            old PEER
///   NPTS=   5590  DT=   .0100 SEC,  -5 POLE @      .05000 HZ,   0 POLE @      .00000
///   4000    .0050    NPTS, DT              first NGA set
///   NPTS = 5372 , DT = .0100SEC            rewritten by programs; also with DT first, or ":" for "="
/// A header line says "IN UNITS OF G", or in words of its own "The units are (g)". Below the values there
/// may be a line that ends them, "*** End Data ***". The sister files of velocity and
/// displacement, .VT2 and .DT2, have the same header but for the words of that line, and are refused.

#include "io/files/csv_fields.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

namespace stylobate {

namespace {

constexpr std::size_t longest_header = 12; // lines in which NPTS is looked for

bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Where `word` (lower case) stands as a word of its own in a lower-case line; npos if nowhere.
std::size_t find_word(std::string_view line, std::string_view word)
{
    for (std::size_t i = line.find(word); i != std::string_view::npos; i = line.find(word, i + 1)) {
        const std::size_t end = i + word.size();
        if ((i == 0 || !is_letter(line[i - 1])) && (end == line.size() || !is_letter(line[end])))
            return i;
    }
    return std::string_view::npos;
}

/// The line with NPTS and DT; the number of lines looked at if there is none.
std::size_t size_line(const RecordText& text)
{
    const std::size_t end = std::min(text.lines.size(), longest_header);
    for (std::size_t i = 0; i < end; ++i) {
        const std::string line = lower_case(trimmed(text.lines[i]));
        const bool comment = line.starts_with('#') || line.starts_with('%'); // of plain columns
        if (!comment && find_word(line, "npts") != std::string_view::npos)
            return i;
    }
    return end;
}

bool recognise(const RecordText& text)
{
    const std::size_t end = std::min(text.lines.size(), longest_header);
    if (size_line(text) < end)
        return true;
    return std::any_of(text.lines.begin(), text.lines.begin() + static_cast<std::ptrdiff_t>(end),
                       [](std::string_view line) {
                           const std::string lower = lower_case(line);
                           return lower.find("strong motion database record") != std::string::npos ||
                                  (lower.find("acceleration time") != std::string::npos &&
                                   lower.find("in units of") != std::string::npos);
                       });
}

/// The number that follows "key =", "key:" or "key" in a line, up to a blank, a comma or its unit; empty if the line
/// has none.
std::string_view value_after(std::string_view line, std::string_view key)
{
    std::size_t i = find_word(line, key);
    if (i == std::string_view::npos)
        return {};
    i = line.find_first_not_of(" \t", i + key.size());
    if (i != std::string_view::npos && (line[i] == '=' || line[i] == ':'))
        i = line.find_first_not_of(" \t", i + 1);
    if (i == std::string_view::npos || line[i] == ',')
        return {};
    std::size_t end = line.find_first_of(" \t,;", i);
    if (end != std::string_view::npos && line[end] == ',' && has_decimal_comma(line.substr(i, end + 2 - i)))
        end = line.find_first_of(" \t,;", end + 1); // "0,0100": the number is refused where it is read
    std::string_view value = line.substr(i, end - i);
    for (const std::string_view unit : {"sec", "s"}) // ".0100SEC"
        if (value.size() > unit.size() && value.ends_with(unit) &&
            is_number(value.substr(0, value.size() - unit.size())))
            value.remove_suffix(unit.size());
    return value;
}

struct Size {
    std::uint64_t samples = 0;
    double dt_s = 0;
};

/// @param and_no_unit whether the unit is missing too: then one message names both
Size read_size(const RecordText& text, std::size_t i, bool and_no_unit)
{
    const std::string line = lower_case(text.lines[i]);
    std::string_view samples = value_after(line, "npts"), dt = value_after(line, "dt");
    const auto parts = parts_of(line, true);
    if (parts.size() == 4 && parts[2] == "npts" && parts[3] == "dt") {
        samples = parts[0];
        dt = parts[1];
    } else if (parts.size() == 4 && parts[2] == "dt" && parts[3] == "npts") {
        samples = parts[1];
        dt = parts[0];
    }
    Size size;
    const auto [end, error] = std::from_chars(samples.data(), samples.data() + samples.size(), size.samples);
    if (error != std::errc() || end != samples.data() + samples.size() || size.samples < 2)
        text.refuse(i, fmt::format("NPTS = {} must be a whole number of at least 2. The line should read like "
                                   "\"NPTS=  5372, DT=   .0100 SEC\".",
                                   samples.empty() ? "nothing" : samples));
    if (dt.empty())
        text.refuse(i, fmt::format("DT is missing{}. The line should read like \"NPTS=  5372, DT=   .0100 SEC\".{}",
                                   and_no_unit ? ", and so is the unit of the acceleration" : "",
                                   and_no_unit ? fmt::format(" {}", unit_remedy) : ""));
    size.dt_s = number(text, i, dt);
    check_dt(text, i, size.dt_s);
    return size;
}

/// The unit as the header spells it ("g", "cm/s/s"), in lower case; nullopt if it says none.
std::optional<std::string> stated_unit(std::string_view line)
{
    const std::string lower = lower_case(line);
    for (const char* phrase : {"units of", "units are", "units:", "units ="}) {
        const std::size_t at = lower.find(phrase);
        if (at == std::string::npos)
            continue;
        const std::string_view rest = trimmed(std::string_view(lower).substr(at + std::string_view(phrase).size()));
        const std::size_t first = std::min(rest.find_first_not_of("( "), rest.size());
        std::string_view word = rest.substr(first, rest.find_first_of(" \t,;)", first) - first);
        while (word.ends_with('.'))
            word.remove_suffix(1);
        return word.empty() ? std::nullopt : std::optional<std::string>(word);
    }
    return std::nullopt;
}

/// Refuses the series that is no acceleration, whatever its unit line says or lacks.
void refuse_other_series(const RecordText& text, std::size_t header_lines)
{
    for (std::size_t i = 0; i < header_lines; ++i) {
        const std::string line = lower_case(squeezed(text.lines[i]));
        for (const char* other : {"velocity", "displacement"})
            for (const char* series : {" time", " series", " history", " in units"})
                if (line.find(std::string(other) + series) != std::string::npos)
                    text.refuse(
                        i,
                        fmt::format(
                            "the file holds a {} and not an acceleration. Give the file with the acceleration (.AT2).",
                            other));
    }
}

std::string read_unit(const RecordText& text, std::size_t header_lines, const std::optional<std::string>& given)
{
    for (std::size_t i = 0; i < header_lines; ++i)
        if (const auto spelling = stated_unit(text.lines[i]))
            return unit_of_file(text, i, *spelling, given);
    if (!given)
        text.refuse(fmt::format("does not contain the unit of its acceleration. {}", unit_remedy));
    return *given;
}

/// Station and component are the last two parts of the title, as in
/// "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180". Without such a title they stay as they are.
void name_from_title(Record& record)
{
    const std::string_view title = record.title;
    const std::size_t comma = title.rfind(',');
    if (comma == std::string_view::npos)
        return;
    std::string_view name = title.substr(comma + 1);
    name = trimmed(name.substr(0, name.find('(')));
    if (name.empty() || name.size() > 12 || name.find(' ') != std::string_view::npos)
        return;
    record.component = record.orientation = name;
    const std::string_view rest = title.substr(0, comma);
    const std::size_t second = rest.rfind(',');
    if (second != std::string_view::npos)
        record.station = trimmed(rest.substr(second + 1));
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    const std::size_t header = size_line(text);
    if (header >= std::min(text.lines.size(), longest_header))
        text.refuse("looks like a PEER .AT2 file, but has no line like \"NPTS=  5372, DT=   .0100 SEC\" above its "
                    "values.");
    const auto first = text.lines.begin();
    const bool no_unit = !given && std::all_of(first, first + static_cast<std::ptrdiff_t>(header),
                                               [](std::string_view line) { return !stated_unit(line); });
    const Size size = read_size(text, header, no_unit);
    Record record;
    refuse_other_series(text, header);
    record.unit = read_unit(text, header, given);
    record.dt_s = size.dt_s;
    record.component = "acceleration";
    if (header >= 2) { // the first line names the data base, the second the event and the station
        record.title = trimmed(text.lines[1]);
        name_from_title(record);
    }

    std::size_t last = header;
    for (std::size_t i = header + 1; i < text.lines.size(); ++i) {
        if (trimmed(text.lines[i]).empty() || is_end_mark(text.lines[i]))
            continue;
        for (const std::string_view token : parts_of(text.lines[i], false))
            record.acceleration_m_s2.push_back(number(text, i, token));
        last = i;
    }
    if (record.acceleration_m_s2.size() != size.samples)
        text.refuse(header,
                    fmt::format("NPTS is {} and the file has {} values: it is {}. Obtain the complete file.",
                                size.samples, record.acceleration_m_s2.size(),
                                record.acceleration_m_s2.size() < size.samples ? "truncated or damaged" : "damaged"));
    refuse_cut_number(text, header + 1, last, false);
    return {record};
}

} // namespace

const RecordParser at2_parser = {"peer-at2", recognise, parse};

} // namespace stylobate
