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

/// The first comma that is not between quotation marks; the first of all where a mark has no second.
std::size_t next_comma(std::string_view text)
{
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"')
            quoted = !quoted;
        if (text[i] == ',' && !quoted)
            return i;
    }
    return quoted ? text.find(',') : std::string_view::npos;
}

} // namespace

std::string csv_content(const std::filesystem::path& path, std::uint64_t largest)
{
    const FileHandle file = FileHandle::open(path, false);
    const std::uint64_t size = file.size();
    if (size > largest)
        throw InputError(path.string(), 0,
                         fmt::format("has {} bytes, more than {}.\n  Is it the right file?", size, largest));
    std::string text(size, '\0');
    file.read(0, std::as_writable_bytes(std::span(text)));
    return text;
}

void for_each_csv_line(std::string_view text, const std::function<void(const CsvLine&)>& take)
{
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3); // a byte order mark
    for (long number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (trimmed(rest).empty() || trimmed(rest).front() == '#')
            continue;
        CsvLine line{number, {}};
        for (std::size_t comma = 0; comma != std::string_view::npos;
             rest.remove_prefix(std::min(comma + 1, rest.size()))) {
            comma = next_comma(rest);
            line.fields.push_back(trimmed(rest.substr(0, comma)));
            if (comma == std::string_view::npos)
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
    const std::string_view digits = text.front() == '+' ? text.substr(1) : text;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || std::isinf(value))
        throw InputError(
            file, line.number,
            fmt::format("{} = \"{}\" is not a number.\n  Leave the field empty where nothing was measured.", column,
                        text.substr(0, 40)));
    return value;
}

} // namespace stylobate
