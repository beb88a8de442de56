/// A line of text or none, a line with the number of values and their interval, then the values, any number to a line.
/// Programs of structural engineering write such files (eqsig: a name, "200 0.0050", one value to a line). The unit is
/// never guessed: it is given with the file, or stands in the text.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

constexpr std::size_t longest_top = 4; // lines of text above

/// "200 0.0050" or "0.0050, 200".
struct Size {
    std::size_t line = 0, count = 0;
    double dt_s = 0;
};

bool is_whole(std::string_view token)
{
    return !token.empty() && token.size() < 9 && token.find_first_not_of("0123456789") == std::string_view::npos;
}

std::optional<Size> size_of(const RecordText& text)
{
    for (std::size_t i = 0; i + 1 < text.lines.size() && i <= longest_top; ++i) {
        const auto parts = parts_of(text.lines[i], true);
        if (!is_row(text.lines[i]) || (i == 0 && parts.size() == 1))
            continue; // text, or a number that is the name
        if (parts.size() != 2 || is_whole(parts[0]) == is_whole(parts[1]))
            return {};
        const std::size_t place = is_whole(parts[0]) ? 0 : 1;
        const Size size{i, static_cast<std::size_t>(std::stoul(std::string(parts[place]))),
                        number(text, i, parts[1 - place])};
        // the rows below are not of two columns, as those of a table of time and acceleration are
        const bool table = parts_of(text.lines[i + 1], true).size() == 2;
        const bool fits = size.count >= 10 && size.dt_s >= shortest_dt_s && size.dt_s <= longest_dt_s && !table;
        return fits ? std::optional(size) : std::nullopt;
    }
    return {};
}

bool recognise(const RecordText& text)
{
    return size_of(text).has_value();
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    const Size size = *size_of(text);
    Record record;
    record.component = "acceleration";
    record.dt_s = size.dt_s;
    std::optional<std::string> unit = given;
    for (std::size_t i = 0; i < size.line; ++i) {
        if (record.title.empty())
            record.title = squeezed(text.lines[i]);
        refuse_other_quantity(text, i);
        if (const auto stated = unit_in_line(text.lines[i]))
            unit = unit_of_file(text, i, *stated, given);
    }
    if (!unit)
        text.refuse(fmt::format("does not contain the unit of its acceleration. {}", unit_remedy));
    record.unit = *unit;
    std::size_t below = 0;
    record.acceleration_m_s2 = read_numbers(text, size.line + 1, size.count, &below);
    refuse_more(text, below);
    return {record};
}

} // namespace

const RecordParser npts_dt_parser = {"npts-dt", recognise, parse};

} // namespace stylobate
