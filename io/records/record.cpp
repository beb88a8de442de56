#include "io/records/record.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/study.hpp"
#include "io/files/csv_fields.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <system_error>

namespace stylobate {

namespace {

/// Asked in this order; headers of any agency, and the columns, which any table of numbers is, come last.
constexpr const RecordParser* parsers[] = {
    &csmip_parser, &cosmos_parser, &bhrc_parser,   &usc_parser, &smc_parser,     &geonet_parser, &esm_parser,
    &knet_parser,  &unam_parser,   &headed_parser, &at2_parser, &npts_dt_parser, &columns_parser};

constexpr const char* unit_choices = "\"m/s2\", \"cm/s2\" (or \"gal\"), \"mm/s2\", \"g\" or \"g/10\"";
constexpr const char* comma_remedy =
    "Replace the commas in the numbers by points, or export the file with decimal points.";
constexpr std::uintmax_t largest_file = 1u << 26; // 64 MiB, hours at 200 Hz: beyond it is no record

std::vector<Record> parse(std::string_view content, const std::string& file, const std::optional<std::string>& unit)
{
    const bool stated = unit && !unit->empty();
    const auto given = stated ? canonical_unit(*unit) : std::nullopt;
    if (stated && !given)
        throw InputError(file, 0, fmt::format("unit = \"{}\" is not known. It may be {}.", *unit, unit_choices));
    const RecordText text = lines_of(file, content);
    refuse_decimal_commas(text);
    std::string formats;
    for (const RecordParser* parser : parsers) {
        if (parser->recognise(text)) {
            std::vector<Record> records = parser->parse(text, given);
            for (Record& record : records) {
                record.file = file;
                record.format = parser->format;
                record.direction = direction_of(record);
                for (double& a : record.acceleration_m_s2)
                    a *= unit_m_s2(record.unit);
            }
            return records;
        }
        formats += fmt::format("{}{}", formats.empty() ? "" : ", ", parser->format);
    }
    text.refuse(fmt::format("has an unknown format ({}). Give a PEER .AT2 file, or a table with the time in s in its "
                            "first column, the acceleration in the others, and at most one line of names above.",
                            formats));
}

double pga_of(const Record& record)
{
    double pga = 0;
    for (const double a : record.acceleration_m_s2)
        pga = std::max(pga, std::fabs(a));
    return pga;
}

void check_pga(const Record& record)
{
    const double pga = pga_of(record);
    if (pga >= smallest_pga_m_s2 && pga <= largest_pga_m_s2)
        return;
    std::string hint;
    for (const char* other : {"m/s2", "cm/s2", "mm/s2", "g"}) {
        const double in_other = pga / unit_m_s2(record.unit) * unit_m_s2(other);
        if (other != record.unit && in_other >= 0.01 && in_other <= 20)
            hint += fmt::format("{} in {} it would be {:.4g} m/s2", hint.empty() ? "" : ",", other, in_other);
    }
    throw InputError(record.file, 0,
                     fmt::format("{}: the PGA is {:.6g} m/s2 (unit {}), outside [{}, {}] m/s2. {}\n  "
                                 "If the unit is right, give study.allow = [\"pga\"].",
                                 record.component, pga, record.unit, smallest_pga_m_s2, largest_pga_m_s2,
                                 hint.empty() ? "Check the unit and the file." : "Is the unit right?" + hint + "."));
}

/// The number N of "N" and of "column N".
std::optional<int> column_number(std::string_view name)
{
    if (name.starts_with("column "))
        name.remove_prefix(7);
    int column = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), column);
    if (error != std::errc() || end != name.data() + name.size())
        return {};
    return column;
}

/// @throws InputError if it is not among them
std::size_t place_of(const std::vector<Record>& records, const std::optional<std::string>& component)
{
    std::string names;
    for (const Record& record : records)
        names += fmt::format("{}\"{}\"{}", names.empty() ? "" : ", ", record.component,
                             record.orientation.empty() || record.orientation == record.component
                                 ? ""
                                 : " (" + record.orientation + ")");
    if (!component || component->empty()) {
        if (records.size() == 1)
            return 0;
        throw InputError(records.front().file, 0,
                         fmt::format("has {} components and none was selected. Give one as the component: {}.",
                                     records.size(), names));
    }
    const std::string wanted = lower_case(trimmed(*component));
    for (std::size_t i = 0; i < records.size(); ++i)
        if (lower_case(records[i].component) == wanted)
            return i;
    const auto so_oriented = [&](const Record& record) { return lower_case(record.orientation) == wanted; };
    if (std::count_if(records.begin(), records.end(), so_oriented) == 1)
        return static_cast<std::size_t>(std::find_if(records.begin(), records.end(), so_oriented) - records.begin());
    if (const std::optional<int> column = column_number(wanted); column && *column > 0)
        for (std::size_t i = 0; i < records.size(); ++i)
            if (records[i].column == static_cast<std::size_t>(*column))
                return i;
    throw InputError(
        records.front().file, 0,
        fmt::format("component = \"{}\" is not in it. Available: {}{}.", *component, names,
                    records.front().column > 0 && records.front().note ? ", " + *records.front().note : ""));
}

} // namespace

std::string content_of(const std::filesystem::path& path, const std::string& what)
{
    const std::string file = path.string();
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        throw InputError(file, 0, fmt::format("no such file. Give the path of {}.", what));
    if (!std::filesystem::is_regular_file(status))
        throw InputError(file, 0, fmt::format("is not a file. Give the path of {}.", what));
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > largest_file)
        throw InputError(file, 0,
                         fmt::format("has {} bytes, more than the {} allowed for a record. Give the path of {}.", size,
                                     largest_file, what));
    std::ifstream in(path, std::ios::binary);
    std::string content(error ? 0 : static_cast<std::size_t>(size), '\0');
    if (!in || error || !in.read(content.data(), static_cast<std::streamsize>(content.size())))
        throw InputError(file, 0, "cannot be read. Check its permissions.");
    return content;
}

RecordText lines_of(const std::string& file, std::string_view content)
{
    RecordText text{file, {}, true};
    if (const auto reason = unreadable_encoding(content))
        text.refuse(*reason);
    if (content.starts_with("\xEF\xBB\xBF")) // UTF-8 mark
        content.remove_prefix(3);
    while (content.ends_with('\x1a')) // end of file of old systems
        content.remove_suffix(1);
    while (!content.empty()) {
        const std::size_t end = content.find_first_of("\r\n");
        const std::string_view line = content.substr(0, end);
        text.lines.push_back(line);
        for (const char c : line)
            if (const auto byte = static_cast<unsigned char>(c);
                (byte < 0x20 && c != '\t' && c != '\f') || byte == 0x7f)
                text.refuse(text.lines.size() - 1,
                            fmt::format("byte 0x{:02x} in what should be text: the file is binary or damaged.", byte));
        text.ended = end != std::string_view::npos;
        if (!text.ended)
            break;
        // CR CR LF is one end of line, CR alone too; without a LF after them, each of several CR ends a line
        std::size_t next = content.find_first_not_of('\r', end);
        if (next != std::string_view::npos && content[next] == '\n')
            ++next;
        else
            next = end + 1;
        content.remove_prefix(next);
    }
    const bool blank =
        std::all_of(text.lines.begin(), text.lines.end(), [](std::string_view line) { return trimmed(line).empty(); });
    if (blank)
        text.refuse("is empty.");
    return text;
}

void refuse_decimal_commas(const RecordText& text)
{
    std::size_t with_commas = 0, with_points = 0, first = 0;
    double before = -std::numeric_limits<double>::infinity();
    std::string_view example;
    for (std::size_t i = 0; i < text.lines.size(); ++i) {
        const std::string_view line = trimmed(text.lines[i]);
        if (line.find_first_of(",.") == std::string_view::npos ||
            line.find_first_not_of("0123456789+-.,;eEdD \t") != std::string_view::npos)
            continue;
        if (line.find(',') == std::string_view::npos) {
            ++with_points;
            continue;
        }
        std::size_t tokens = 0;
        std::string_view comma;
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t begin = std::min(line.find_first_not_of(" \t;", at), line.size());
            at = std::min(line.find_first_of(" \t;", begin), line.size());
            const std::string_view token = line.substr(begin, at - begin);
            tokens += token.empty() ? 0 : 1;
            if (comma.empty() && has_decimal_comma(token))
                comma = token;
        }
        double whole = 0;
        decimal_number(comma.substr(0, comma.find(',')), whole);
        const bool time = whole > before; // "5,12" and "10,13" are a growing time and a whole number
        before = whole;
        const bool decimal = !comma.empty() && (tokens > 1 || (!time && line.find('.') == std::string_view::npos));
        if (decimal && with_commas++ == 0) {
            first = i;
            example = comma;
        }
        with_points += decimal ? 0 : 1;
    }
    if (with_commas > 1 && with_commas > with_points)
        text.refuse(first, fmt::format("\"{}\": the numbers have decimal commas. {}", example, comma_remedy));
}

void RecordText::refuse(std::size_t i, const std::string& what) const
{
    throw InputError(file, static_cast<long>(i) + 1, what);
}

void RecordText::refuse(const std::string& what) const
{
    throw InputError(file, 0, what);
}

double unit_m_s2(std::string_view unit)
{
    if (unit == "g")
        return 9.80665;
    if (unit == "g/10")
        return 0.980665;
    if (unit == "m/s2")
        return 1;
    if (unit == "cm/s2")
        return 0.01;
    assert(unit == "mm/s2" && "the unit has its canonical name");
    return 0.001;
}

std::string plain_unit(std::string_view spelling)
{
    std::string unit = lower_case(trimmed(spelling));
    const auto replace = [&](std::string_view what, std::string_view by) {
        for (std::size_t at = unit.find(what); at != std::string::npos; at = unit.find(what, at + by.size()))
            unit.replace(at, what.size(), by);
    };
    replace("\xc2\xb2", "2"); // superscript, in UTF-8 and in Latin-1
    replace("\xb2", "2");
    replace("\xe2\x81\xbb", "-");
    replace("\xc2\xb9", "1");
    replace("sec", "s");
    for (const std::string_view mark : {" ", "^", "*", "\xc2\xb7", "{", "}"})
        replace(mark, "");
    while (unit.ends_with('.'))
        unit.pop_back();
    return unit;
}

std::optional<std::string> canonical_unit(std::string_view spelling)
{
    const std::string unit = plain_unit(spelling);
    if (unit == "g" || unit == "g's")
        return "g";
    if (unit == "g/10")
        return "g/10";
    if (unit == "gal" || unit == "gals")
        return "cm/s2";
    for (const char* length : {"m", "cm", "mm"})
        for (const char* per : {"/s2", "/s/s", "/(s2)", "s-2", ".s-2", "/ss"})
            if (unit == std::string(length) + per)
                return std::string(length) + "/s2";
    return std::nullopt;
}

std::string unit_of_file(const RecordText& text, std::size_t i, std::string_view spelling,
                         const std::optional<std::string>& given)
{
    const auto unit = canonical_unit(spelling);
    if (!unit)
        text.refuse(
            i, fmt::format("the unit \"{}\" is not one of acceleration: g, g/10, m/s2, cm/s2, gal, mm/s2.", spelling));
    if (given && given != unit)
        text.refuse(i,
                    fmt::format("the unit in the file is {}, but the unit given is {}. Omit the unit, or correct it.",
                                *unit, *given));
    return *unit;
}

bool is_end_mark(std::string_view line)
{
    const std::string lower = lower_case(squeezed(line));
    if (lower.find_first_not_of("*-=/&#+. ") == std::string::npos)
        return lower.size() > 1;
    const auto parts = parts_of(lower, false);
    if (std::any_of(parts.begin(), parts.end(), is_number))
        return lower.starts_with("/&") || lower.starts_with("end of ");
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz";
    const std::size_t word = std::min(lower.find_first_of(letters), lower.size());
    const std::string first = lower.substr(word, std::min(lower.find_first_not_of(letters, word), lower.size()) - word);
    return first == "end" || first == "eof" || first == "fin" || first == "endofdata";
}

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\f");
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t\f") - first + 1);
}

std::string lower_case(std::string_view text)
{
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string squeezed(std::string_view line)
{
    std::string words;
    for (const std::string_view word : parts_of(line, false))
        words += (words.empty() ? "" : " ") + std::string(word);
    return words;
}

std::vector<std::string_view> parts_of(std::string_view line, bool commas)
{
    constexpr std::string_view blanks = " \t\f";
    const std::string_view separators = commas ? " \t\f,;" : blanks;
    std::vector<std::string_view> parts;
    bool separated = true; // by a comma, or by the start of the line
    for (line = trimmed(line); !line.empty();) {
        const std::size_t end = std::min(line.find_first_of(separators), line.size());
        if (end > 0) {
            parts.push_back(line.substr(0, end));
            separated = false;
        } else if (blanks.find(line.front()) == std::string_view::npos) {
            if (separated)
                parts.emplace_back();
            separated = true;
        }
        line.remove_prefix(std::max<std::size_t>(end, 1));
    }
    if (separated) // a comma at the end of the line, or a blank line
        parts.emplace_back();
    return parts;
}

bool is_number(std::string_view token)
{
    double value = 0;
    return decimal_number(token, value).ec == std::errc();
}

bool is_row(std::string_view line)
{
    const auto parts = parts_of(line, true);
    return std::all_of(parts.begin(), parts.end(), is_number);
}

double number(const RecordText& text, std::size_t i, std::string_view token)
{
    double value = 0;
    const std::errc error = decimal_number(token, value).ec;
    if (token.empty())
        text.refuse(i, "a number is missing between two separators.");
    if (error == std::errc::result_out_of_range)
        text.refuse(i, fmt::format("\"{}\" is out of the range of numbers.", token.substr(0, 40)));
    if (error != std::errc() && has_decimal_comma(token))
        text.refuse(i, fmt::format("\"{}\" has a decimal comma. {}", token.substr(0, 40), comma_remedy));
    if (error != std::errc())
        text.refuse(i, fmt::format("\"{}\" is not a number: the file is damaged, or has text where its values should "
                                   "be.",
                                   token.substr(0, 40)));
    if (!std::isfinite(value))
        text.refuse(i, fmt::format("\"{}\" is not finite. A record must have a value at each time.", token));
    return value;
}

void add_row(const RecordText& text, std::size_t i, std::vector<std::vector<double>>& columns)
{
    const auto parts = parts_of(text.lines[i], true);
    if (parts.size() != columns.size())
        text.refuse(i, fmt::format("the row has {} columns and those above have {}: the file is damaged or truncated.",
                                   parts.size(), columns.size()));
    for (std::size_t c = 0; c < parts.size(); ++c)
        columns[c].push_back(number(text, i, parts[c]));
}

void refuse_other_quantity(const RecordText& text, std::size_t i)
{
    for (const std::string& word : words_of(text.lines[i]))
        if (is_one_of(word, {"velocity", "displacement", "spectrum", "spectra"}))
            text.refuse(i, fmt::format("the file holds a {} and not an acceleration. Give the file with the "
                                       "acceleration.",
                                       word));
}

namespace {

/// How a number is written: its decimals and its exponent's length tell a whole number from a cut one.
struct Spelling {
    std::size_t decimals = 0;
    std::size_t exponent = 0; ///< characters from the E on
    std::size_t column = 0;   ///< where it ends in its line
};

Spelling spelling_of(std::string_view line, std::string_view token)
{
    const std::size_t e = std::min(token.find_first_of("eEdD"), token.size());
    const std::size_t point = std::min(token.find('.'), e);
    return {e - point, token.size() - e, static_cast<std::size_t>(token.data() + token.size() - line.data())};
}

} // namespace

void refuse_cut_number(const RecordText& text, std::size_t first, std::size_t last, bool commas)
{
    if (text.ended || last + 1 != text.lines.size() || first >= last)
        return;
    const auto last_parts = parts_of(text.lines[last], commas);
    const std::size_t place = last_parts.size() - 1;
    const Spelling cut = spelling_of(text.lines[last], last_parts[place]);
    std::optional<Spelling> above;
    bool aligned = true, alike = true;
    for (std::size_t i = first; i < last && (aligned || alike); ++i) {
        const auto parts = parts_of(text.lines[i], commas);
        if (parts.size() <= place)
            continue;
        const Spelling s = spelling_of(text.lines[i], parts[place]);
        if (!above)
            above = s;
        aligned = aligned && s.column == above->column;
        alike = alike && s.decimals == above->decimals && s.exponent == above->exponent;
    }
    if (!above)
        return;
    if ((aligned && cut.column != above->column) ||
        (alike && (cut.decimals != above->decimals || cut.exponent != above->exponent)))
        text.refuse(last, fmt::format("the file ends inside its last number, \"{}\", which is shorter than those "
                                      "above it. Obtain the complete file.",
                                      last_parts[place]));
}

void check_dt(const RecordText& text, std::size_t i, double dt_s)
{
    if (!(dt_s >= shortest_dt_s && dt_s <= longest_dt_s))
        text.refuse(i, fmt::format("the sampling interval is {} s, outside [{}, {}] s. Times are in seconds.", dt_s,
                                   shortest_dt_s, longest_dt_s));
}

PgaRange pga_range(const Study& study)
{
    return study.allows("pga") ? PgaRange::any : PgaRange::usual;
}

std::vector<Record> read_records(std::string_view content, const std::string& file,
                                 const std::optional<std::string>& unit, PgaRange pga)
{
    std::vector<Record> records = parse(content, file, unit);
    if (pga == PgaRange::usual)
        for (const Record& record : records)
            check_pga(record);
    return records;
}

std::vector<Record> read_records(const std::filesystem::path& file, const std::optional<std::string>& unit,
                                 PgaRange pga)
{
    return read_records(content_of(file, "a ground-motion record"), file.string(), unit, pga);
}

Record read_record(const std::filesystem::path& file, const std::optional<std::string>& component,
                   const std::optional<std::string>& unit, PgaRange pga)
{
    std::vector<Record> records = parse(content_of(file, "a ground-motion record"), file.string(), unit);
    Record record = std::move(records[place_of(records, component)]);
    if (pga == PgaRange::usual)
        check_pga(record);
    return record;
}

std::optional<std::string> record_format(const std::filesystem::path& file)
{
    try {
        const std::string content = content_of(file, "a ground-motion record");
        const RecordText text = lines_of(file.string(), content);
        for (const RecordParser* parser : parsers)
            if (parser->recognise(text))
                return std::string(parser->format);
    } catch (const InputError&) { // no text, or too much of it: no record
    }
    return std::nullopt;
}

} // namespace stylobate
