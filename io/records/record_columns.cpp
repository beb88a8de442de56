/// Plain columns: one row per sample, the first column the time in s, each other one a component of the acceleration.
///
/// Blanks, tabs, commas or semicolons between the columns. Above the rows there may be comment lines (# or %), blank
/// lines and one line of names. The times are uniform; the first may be anything (0, dt, ...). A file of one column is
/// an acceleration and says its sampling interval in a comment: "# dt = 0.01". The unit is never guessed: it is given
/// with the file.

#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace stylobate {

namespace {

/// How far from uniform the times may be, in sampling intervals: the rounding of printed times, never a missing row.
constexpr double time_tolerance = 0.1;

/// What stands above the rows.
struct Top {
    std::size_t first_row = 0; ///< the number of lines if there is none
    std::optional<std::size_t> names;
    std::optional<std::size_t> first_comment;
};

bool is_comment(std::string_view line)
{
    return line.starts_with('#') || line.starts_with('%');
}

/// Begins with a letter (or a quote or bracket), and is not a number such as "nan".
bool is_line_of_names(std::string_view line)
{
    const char c = lower_case(line.substr(0, 1)).front();
    const bool begins = (c >= 'a' && c <= 'z') || c == '"' || c == '\'' || c == '(' || c == '[';
    return begins && !is_number(parts_of(line, true).front());
}

Top top_of(const RecordText& text)
{
    Top top;
    for (std::size_t& i = top.first_row; i < text.lines.size(); ++i) {
        const std::string_view line = trimmed(text.lines[i]);
        if (line.empty())
            continue;
        if (is_comment(line)) {
            if (!top.first_comment)
                top.first_comment = i;
        } else if (!top.names && is_line_of_names(line)) {
            top.names = i;
        } else {
            break;
        }
    }
    return top;
}

bool recognise(const RecordText& text)
{
    const Top top = top_of(text);
    return top.first_row < text.lines.size() && is_number(parts_of(text.lines[top.first_row], true).front());
}

/// The sampling interval of a comment "# dt = 0.01", "# dt_s = 0.01" or "# dt = 0.01 s".
std::optional<double> stated_dt(const RecordText& text, std::size_t first_row)
{
    for (std::size_t i = 0; i < first_row; ++i) {
        std::string_view line = trimmed(text.lines[i]);
        if (!is_comment(line))
            continue;
        const std::string lower = lower_case(trimmed(line.substr(std::min(line.find_first_not_of("#%"), line.size()))));
        const std::size_t equals = lower.find_first_of("=:");
        if (equals == std::string::npos)
            continue;
        const std::string_view key = trimmed(std::string_view(lower).substr(0, equals));
        if (key != "dt" && key != "dt_s")
            continue;
        const auto value = parts_of(std::string_view(lower).substr(equals + 1), false);
        if (value.size() > 2 || (value.size() == 2 && value[1] != "s" && value[1] != "sec"))
            text.refuse(i, fmt::format("dt should be a number of seconds, as in \"# dt = 0.01\"; it is \"{}\".",
                                       trimmed(std::string_view(lower).substr(equals + 1))));
        const double dt = number(text, i, value[0]);
        check_dt(text, i, dt);
        return dt;
    }
    return {};
}

/// The sampling interval of the times; `line` says where each of them stands.
double uniform_dt(const RecordText& text, const std::vector<double>& time_s, const std::vector<std::size_t>& line)
{
    const std::size_t n = time_s.size();
    std::vector<double> steps(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i)
        steps[i] = time_s[i + 1] - time_s[i];
    const double median = upper_median(std::move(steps));
    const char* todo = "Times are in the first column, in seconds, and uniform.";
    if (!(median > 0))
        text.refuse(line.front(), fmt::format("the first column does not increase from row to row. {}", todo));
    for (std::size_t i = 0; i + 1 < n; ++i)
        if (std::fabs(time_s[i + 1] - time_s[i] - median) > time_tolerance * median)
            text.refuse(line[i + 1], fmt::format("the time goes from {} s to {} s where steps are {:.6g} s: a row is "
                                                 "missing, duplicated or damaged. {}",
                                                 time_s[i], time_s[i + 1], median, todo));
    const double dt = (time_s.back() - time_s.front()) / static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n; ++i)
        if (std::fabs(time_s[i] - time_s.front() - static_cast<double>(i) * dt) > time_tolerance * dt)
            text.refuse(line[i],
                        fmt::format("the time {} s is off the uniform {:.9g} s by {:.3g} steps. {}", time_s[i],
                                    time_s.front() + static_cast<double>(i) * dt,
                                    std::fabs(time_s[i] - time_s.front() - static_cast<double>(i) * dt) / dt, todo));
    check_dt(text, line.front(), dt);
    // what was meant before the times were rounded, 0.02 for 0.0199999999999: six digits, unless that moves the end
    const double meant = number(text, line.front(), fmt::format("{:.6g}", dt));
    return std::fabs(meant - dt) * static_cast<double>(n - 1) < 0.01 * dt ? meant : dt;
}

std::string_view unquoted(std::string_view name)
{
    name = trimmed(name);
    if (name.size() >= 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front())
        name = name.substr(1, name.size() - 2);
    return trimmed(name);
}

/// Names from the line above the rows, where it has one for each column and no two are equal; else "column N".
std::vector<std::string> names_of(const RecordText& text, const Top& top, std::size_t columns)
{
    std::vector<std::string> numbered, named;
    for (std::size_t c = 0; c < columns; ++c)
        numbered.push_back(fmt::format("column {}", c + 1));
    if (!top.names || columns == 1)
        return numbered;
    std::string_view line = trimmed(text.lines[*top.names]);
    const std::size_t separator = line.find_first_of(",;\t"); // names between these may contain blanks
    if (separator == std::string_view::npos) {
        for (const std::string_view part : parts_of(line, false))
            named.emplace_back(unquoted(part));
    } else {
        const char mark = line[separator];
        for (std::size_t end = 0; end != std::string_view::npos; line.remove_prefix(std::min(end + 1, line.size()))) {
            end = line.find(mark);
            named.emplace_back(unquoted(line.substr(0, end)));
            if (end == std::string_view::npos)
                break;
        }
    }
    std::set<std::string> different;
    for (const std::string& name : named)
        different.insert(lower_case(name));
    return named.size() == columns && different.size() == columns && !different.contains("") ? named : numbered;
}

ColumnTable read_rows(const RecordText& text, std::size_t first_row)
{
    ColumnTable table;
    std::size_t end = text.lines.size();
    if (first_row >= end)
        text.refuse("has no row of numbers.");
    while (trimmed(text.lines[end - 1]).empty())
        --end;
    table.columns.resize(parts_of(text.lines[first_row], true).size());
    for (std::size_t i = first_row; i < end; ++i) {
        if (trimmed(text.lines[i]).empty())
            text.refuse(i, "an empty line between the rows: a sample is missing.");
        const auto parts = parts_of(text.lines[i], true);
        if (parts.size() != table.columns.size())
            text.refuse(i, fmt::format("the row has {} columns and those above have {}: the file is damaged or "
                                       "truncated.",
                                       parts.size(), table.columns.size()));
        for (std::size_t c = 0; c < parts.size(); ++c)
            table.columns[c].push_back(number(text, i, parts[c]));
        table.line.push_back(i);
    }
    if (table.line.size() < 2)
        text.refuse(first_row, "the file has one row only. A record needs two at least.");
    refuse_cut_number(text, first_row, end - 1, true);
    return table;
}

std::vector<Record> parse(const RecordText& text, const std::string& unit)
{
    if (unit.empty())
        text.refuse("plain columns do not contain the unit of the acceleration. Give it (excitation.unit, or --unit): "
                    "\"m/s2\", \"cm/s2\", \"gal\", \"mm/s2\" or \"g\".");
    const ColumnTable table = read_columns(text);
    const std::size_t columns = table.columns.size();
    if (columns == 1 && !table.stated_dt_s)
        text.refuse(table.line.front(), "a single column contains no time. Put the time in s into a first column, or a "
                                        "line \"# dt = 0.01\" above the values.");
    std::vector<Record> records;
    for (std::size_t c = columns == 1 ? 0 : 1; c < columns; ++c) {
        Record record;
        record.file = text.file;
        record.format = columns_parser.format;
        record.component = table.names[c];
        record.title = table.title;
        record.unit = unit;
        record.dt_s = columns == 1 ? *table.stated_dt_s : table.dt_s;
        record.acceleration_m_s2 = table.columns[c];
        for (double& a : record.acceleration_m_s2)
            a *= unit_m_s2(unit);
        records.push_back(std::move(record));
    }
    return records;
}

} // namespace

ColumnTable read_columns(const RecordText& text)
{
    const Top top = top_of(text);
    ColumnTable table = read_rows(text, top.first_row);
    table.stated_dt_s = stated_dt(text, top.first_row);
    if (table.columns.size() > 1) {
        table.dt_s = uniform_dt(text, table.columns.front(), table.line);
        if (table.stated_dt_s && std::fabs(*table.stated_dt_s - table.dt_s) > 0.01 * table.dt_s)
            text.refuse(top.first_row,
                        fmt::format("the comment has dt = {} s and the first column {} s. Correct one of them.",
                                    *table.stated_dt_s, table.dt_s));
    }
    table.names = names_of(text, top, table.columns.size());
    if (top.first_comment) {
        const std::string_view line = trimmed(text.lines[*top.first_comment]);
        table.title = trimmed(line.substr(std::min(line.find_first_not_of("#% "), line.size())));
    }
    return table;
}

const RecordParser columns_parser = {"columns", recognise, parse};

} // namespace stylobate
