#include "io/files/csv_fields.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

namespace stylobate {
namespace {

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r\"");
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

/// The first separator that is not between quotation marks; the first of all where a mark has no second.
std::size_t next_separator(std::string_view text, char separator)
{
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"')
            quoted = !quoted;
        if (text[i] == separator && !quoted)
            return i;
    }
    return quoted ? text.find(separator) : std::string_view::npos;
}

char separator_of(std::string_view line)
{
    for (const char separator : {',', ';', '\t'})
        if (next_separator(line, separator) != std::string_view::npos)
            return separator;
    return ',';
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// Digits, at least one of them or of those before.
std::size_t skip_digits(std::string_view text, std::size_t at)
{
    while (at < text.size() && is_digit(text[at]))
        ++at;
    return at;
}

/// "1.5-103", as Fortran writes an exponent of three digits: where its sign stands; npos if it is none.
std::size_t bare_exponent(std::string_view token)
{
    constexpr std::size_t digits = 4;
    if (token.size() <= digits || token.find('.') > token.size() - digits)
        return std::string_view::npos;
    const std::size_t sign = token.size() - digits;
    const bool signed_there = token[sign] == '+' || token[sign] == '-';
    return signed_there && is_digit(token[sign - 1]) && skip_digits(token, sign + 1) == token.size()
               ? sign
               : std::string_view::npos;
}

} // namespace

std::from_chars_result decimal_number(std::string_view token, double& value)
{
    if (token.size() > 1 && token.front() == '+' && token[1] != '-')
        token.remove_prefix(1);
    std::string respelled;
    const std::size_t exponent = token.find_first_of("dD");
    if (exponent != std::string_view::npos && exponent > 0 &&
        (is_digit(token[exponent - 1]) || token[exponent - 1] == '.')) {
        respelled = token;
        respelled[exponent] = 'e';
    } else if (const std::size_t sign = bare_exponent(token); sign != std::string_view::npos) {
        respelled = std::string(token).insert(sign, 1, 'e');
    }
    const std::string_view read = respelled.empty() ? token : respelled;
    const auto result = std::from_chars(read.data(), read.data() + read.size(), value);
    const char* end = token.data() + token.size();
    if (result.ec == std::errc() && result.ptr != read.data() + read.size())
        return {end, std::errc::invalid_argument};
    return {end, result.ec};
}

bool has_decimal_comma(std::string_view token)
{
    std::size_t at = !token.empty() && (token.front() == '-' || token.front() == '+') ? 1 : 0;
    const std::size_t comma = skip_digits(token, at);
    if (comma >= token.size() || token[comma] != ',')
        return false;
    at = skip_digits(token, comma + 1);
    if (at == comma + 1)
        return false;
    double exponent = 0;
    return at == token.size() || (std::string_view("eEdD").find(token[at]) != std::string_view::npos &&
                                  decimal_number(token.substr(at + 1), exponent).ec == std::errc());
}

std::optional<std::string> unreadable_encoding(std::string_view content)
{
    const auto zero = [&](std::size_t i) { return i < content.size() && content[i] == '\0'; };
    const auto letter = [&](std::size_t i) { return i < content.size() && content[i] > 0; };
    if (content.starts_with("\xff\xfe") || content.starts_with("\xfe\xff") ||
        (zero(0) && letter(1) && zero(2) && letter(3)) || (letter(0) && zero(1) && letter(2) && zero(3)))
        return "is text in UTF-16. Save it as UTF-8 (in a spreadsheet or editor: \"Save as\"), or convert it: iconv -f "
               "UTF-16 -t UTF-8 FILE > NEW.";
    if (content.starts_with("PK\x03\x04"))
        return "is a zip archive or a spreadsheet (.xlsx). Unpack it, or export the sheet as CSV.";
    if (content.starts_with("\x1f\x8b"))
        return "is compressed (gzip). Unpack it: gunzip FILE.";
    if (content.starts_with("MATLAB 5.0"))
        return "is a MATLAB file. Save its samples as text, a row for each time: time in s, acceleration.";
    constexpr std::size_t sequence = 6; // miniSEED: "000001D "
    if (content.size() > 8 && skip_digits(content, 0) == sequence &&
        std::string_view("DRQM").find(content[sequence]) != std::string_view::npos && content[sequence + 1] == ' ')
        return "is miniSEED, which has counts of a recorder. Convert it to acceleration with the response of its "
               "station (ObsPy: remove_response(output=\"ACC\")), and save it as text: time in s, acceleration.";
    return std::nullopt;
}

std::string csv_content(const std::filesystem::path& path, std::uint64_t largest)
{
    const FileHandle file = FileHandle::open(path, false);
    const std::uint64_t size = file.size();
    if (size > largest)
        throw InputError(path.string(), 0,
                         fmt::format("has {} bytes, more than {}.\n  Is it the right file?", size, largest));
    std::string text(size, '\0');
    file.read(0, std::as_writable_bytes(std::span(text)));
    if (const auto reason = unreadable_encoding(text))
        throw InputError(path.string(), 0, *reason);
    return text;
}

void for_each_csv_line(std::string_view text, const std::function<void(const CsvLine&)>& take)
{
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3); // a byte order mark
    char separator = '\0';
    for (long number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (trimmed(rest).empty() || trimmed(rest).front() == '#')
            continue;
        if (separator == '\0')
            separator = separator_of(rest);
        CsvLine line{number, {}};
        for (std::size_t end_of_field = 0; end_of_field != std::string_view::npos;
             rest.remove_prefix(std::min(end_of_field + 1, rest.size()))) {
            end_of_field = next_separator(rest, separator);
            line.fields.push_back(trimmed(rest.substr(0, end_of_field)));
            if (end_of_field == std::string_view::npos)
                break;
        }
        take(line);
    }
}

double csv_number(const std::string& file, const CsvLine& line, std::size_t field, std::string_view column)
{
    const std::string_view text = line.fields[field];
    if (text.empty())
        return std::numeric_limits<double>::quiet_NaN();
    double value = 0;
    if (has_decimal_comma(text))
        throw InputError(file, line.number,
                         fmt::format("{} = \"{}\" has a decimal comma.\n  Write numbers with a decimal point.", column,
                                     text.substr(0, 40)));
    if (decimal_number(text, value).ec != std::errc() || std::isinf(value))
        throw InputError(
            file, line.number,
            fmt::format("{} = \"{}\" is not a number.\n  Leave the field empty where nothing was measured.", column,
                        text.substr(0, 40)));
    return value;
}

} // namespace stylobate
