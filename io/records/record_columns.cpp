/// Plain columns: one row per sample, the first column the time in s, each other one a component of the acceleration.
///
/// Blanks, tabs, commas or semicolons between the columns. Above the rows there may be comment lines (# or %), blank
/// lines, one line of names and one of units; a comment that begins with the time is a line of names too. The
/// times are uniform; the first may be anything (0, dt, ...). A file of one column is an acceleration and says its
/// sampling interval in a comment: "# dt = 0.01". The unit is never guessed: it is given with the file, or stands in
/// the names ("acc [g]", "acc_cm_s2") or in a comment ("# unit: cm/s2").
///
/// Columns that their names or units make a velocity, a displacement or another quantity are left out, and named in
/// the note; so are columns without a quantity and a direction beside one that is named as an acceleration.

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
    std::optional<std::size_t> names, units;
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

std::string_view unquoted(std::string_view name)
{
    name = trimmed(name);
    if (name.size() >= 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front())
        name = name.substr(1, name.size() - 2);
    return trimmed(name);
}

/// The names in a line: between commas, semicolons or tabs they may contain blanks; else a unit in brackets belongs to
/// the name before it, "Time (s) Acc (m/s2)".
std::vector<std::string> split_names(std::string_view line)
{
    std::vector<std::string> names;
    line = trimmed(line);
    const std::size_t separator = line.find_first_of(",;\t");
    if (separator != std::string_view::npos) {
        const char mark = line[separator];
        for (std::size_t end = 0; end != std::string_view::npos; line.remove_prefix(std::min(end + 1, line.size()))) {
            end = line.find(mark);
            names.emplace_back(unquoted(line.substr(0, end)));
            if (end == std::string_view::npos)
                break;
        }
        return names;
    }
    bool open = false; // a bracket
    for (const std::string_view part : parts_of(line, false)) {
        if (!names.empty() && (open || part.front() == '(' || part.front() == '['))
            names.back() += " " + std::string(part);
        else
            names.emplace_back(unquoted(part));
        const std::size_t bracket = names.back().find_last_of("()[]");
        open = bracket != std::string::npos && (names.back()[bracket] == '(' || names.back()[bracket] == '[');
    }
    return names;
}

/// "s, g, m/s", "[s] [cm/s2]": nothing but units.
bool is_line_of_units(std::string_view line)
{
    const std::vector<std::string> units = split_names(line);
    return std::all_of(units.begin(), units.end(), [](const std::string& unit) {
        const std::string name = unit.starts_with('[') || unit.starts_with('(') ? unit : "[" + unit + "]";
        return meaning_of_column(name).of_unit != ColumnMeaning::Quantity::unnamed;
    });
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
        } else if (top.names && !top.units && is_line_of_names(line) && is_line_of_units(line)) {
            top.units = i;
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

/// Fills in the names: those of the line above the rows where it has one for each column and no two are equal; else
/// "column N".
void name_columns(const RecordText& text, const Top& top, ColumnTable& table)
{
    const std::size_t columns = table.columns.size();
    for (std::size_t c = 0; c < columns; ++c)
        table.names.push_back(fmt::format("column {}", c + 1));
    if (top.names) {
        table.heading_line = top.names;
        const std::string_view line = trimmed(text.lines[*top.names]);
        table.headings = columns == 1 ? std::vector<std::string>{std::string(unquoted(line))} : split_names(line);
        const auto units = top.units ? split_names(text.lines[*top.units]) : std::vector<std::string>();
        for (std::size_t c = 0; c < table.headings.size() && units.size() == table.headings.size(); ++c)
            table.headings[c] +=
                units[c].starts_with('[') || units[c].starts_with('(') ? " " + units[c] : " [" + units[c] + "]";
    } else if (columns > 1) {
        // a comment that begins with the time: "# t, a", "#DataSequence: Time U(+); N(+); E(+)"
        for (std::size_t i = top.first_row; i-- > 0 && table.headings.empty();) {
            std::string_view line = trimmed(text.lines[i]);
            if (!is_comment(line))
                continue;
            line = trimmed(line.substr(std::min(line.find_first_not_of("#%"), line.size())));
            line = trimmed(line.substr(std::min(line.find(": ") + 1, line.size())));
            std::vector<std::string> names = split_names(line);
            if (names.size() + 1 == columns && names.front().find(' ') != std::string::npos) {
                const std::string front = names.front(); // "Time U(+)"
                names.front() = front.substr(0, front.find(' '));
                names.insert(names.begin() + 1, front.substr(front.find(' ') + 1));
            }
            if (names.size() == columns && meaning_of_column(names.front()).of_words == ColumnMeaning::Quantity::time) {
                table.heading_line = i;
                table.headings = names;
            }
        }
    }
    if (table.headings.size() != columns) {
        table.headings.clear();
        return;
    }
    std::set<std::string> different;
    for (const std::string& name : table.headings)
        different.insert(lower_case(name));
    if (columns > 1 && different.size() == columns && !different.contains(""))
        table.names = table.headings;
}

/// Seconds in the unit of the first column.
/// @throws InputError if its name is not one of a time
double time_unit_s(const RecordText& text, const ColumnTable& table)
{
    using Quantity = ColumnMeaning::Quantity;
    if (table.headings.empty())
        return 1;
    const ColumnMeaning meaning = meaning_of_column(table.headings.front());
    const auto no_time = [](Quantity quantity) { return quantity != Quantity::unnamed && quantity != Quantity::time; };
    if (no_time(meaning.of_unit) || (meaning.plain && no_time(meaning.of_words)))
        text.refuse(*table.heading_line, fmt::format("the first column is \"{}\". It must be the time, in seconds.",
                                                     table.headings.front()));
    const std::string unit = plain_unit(meaning.unit.value_or(""));
    return unit == "ms" ? 1e-3 : unit == "us" ? 1e-6 : unit == "min" ? 60 : 1;
}

ColumnTable read_rows(const RecordText& text, std::size_t first_row)
{
    ColumnTable table;
    std::size_t end = text.lines.size();
    if (first_row >= end)
        text.refuse("has no row of numbers.");
    while (end > first_row + 1 && (trimmed(text.lines[end - 1]).empty() || is_end_mark(text.lines[end - 1])))
        --end;
    table.columns.resize(parts_of(text.lines[first_row], true).size());
    for (std::size_t i = first_row; i < end; ++i) {
        if (trimmed(text.lines[i]).empty())
            text.refuse(i, "an empty line between the rows: a sample is missing.");
        add_row(text, i, table.columns);
        table.line.push_back(i);
    }
    if (table.line.size() < 2)
        text.refuse(first_row, "the file has one row only. A record needs two at least.");
    refuse_cut_number(text, first_row, end - 1, true);
    return table;
}

/// What a column holds, and its unit.
struct Use {
    ColumnMeaning::Quantity quantity = ColumnMeaning::Quantity::acceleration;
    std::optional<std::string> unit; ///< as its name spells it; nullopt if it has none
};

/// What the names make of the columns, the time not included.
std::vector<Use> uses_of(const RecordText& text, const ColumnTable& table)
{
    using Quantity = ColumnMeaning::Quantity;
    const std::size_t first = table.columns.size() == 1 ? 0 : 1;
    std::vector<Use> uses(table.columns.size());
    if (table.headings.empty())
        return uses;
    std::vector<ColumnMeaning> meanings;
    for (const std::string& name : table.headings)
        meanings.push_back(meaning_of_column(name));
    const auto joined = [&](std::size_t c) {
        std::string letters;
        for (const std::string& word : words_of(table.headings[c]))
            letters += word;
        return letters;
    };
    bool directions = false, accelerations = false; // beside others
    for (std::size_t c = first; c < uses.size(); ++c) {
        const bool named = meanings[c].of_words == Quantity::acceleration && meanings[c].plain;
        accelerations = accelerations || named || meanings[c].of_unit == Quantity::acceleration;
        const std::string letters = joined(c);
        directions = directions || (direction_of_name(letters) == Direction::horizontal && letters != "t1");
    }
    for (std::size_t c = first; c < uses.size(); ++c) {
        ColumnMeaning& meaning = meanings[c];
        const std::string letters = joined(c);
        const bool direction = direction_of_name(letters) != Direction::unknown;
        // letters that are directions: T beside L and V, U-D, V and U beside horizontal ones
        if (!meaning.plain && direction && (letters.size() > 2 || letters == "ud" || letters == "t" || directions))
            meaning.of_words = Quantity::unnamed;
        uses[c] = {meaning.of_words, meaning.unit};
        const bool contradicts = meaning.of_words != Quantity::unnamed && meaning.of_unit != Quantity::unnamed &&
                                 meaning.of_words != meaning.of_unit;
        if (contradicts && (meaning.of_unit == Quantity::acceleration || meaning.of_words == Quantity::acceleration))
            text.refuse(
                *table.heading_line,
                fmt::format("the column \"{}\" is {} by its name and {} by its unit. Correct the name, or convert the "
                            "values. Units of acceleration are g, g/10, m/s2, cm/s2, gal and mm/s2.",
                            table.headings[c], to_string(meaning.of_words), to_string(meaning.of_unit)));
        if (meaning.of_words == Quantity::unnamed)
            uses[c].quantity = meaning.of_unit;
        if (uses[c].quantity == Quantity::unnamed && (direction || !accelerations))
            uses[c].quantity = Quantity::acceleration;
    }
    return uses;
}

/// A unit that the lines above the rows state, outside the names of columns.
struct StatedUnit {
    std::size_t line = 0;
    std::string unit; ///< as it is spelled
};

std::optional<StatedUnit> stated_unit(const RecordText& text, const ColumnTable& table)
{
    for (std::size_t i = 0; i < table.line.front(); ++i) {
        const bool names = table.heading_line == i && !table.headings.empty() && table.columns.size() > 1;
        if (const auto unit = names ? std::nullopt : unit_in_line(text.lines[i]))
            return StatedUnit{i, *unit};
    }
    return std::nullopt;
}

/// Refuses names that do not fit the columns, where they name other quantities than accelerations.
void refuse_names_that_do_not_fit(const RecordText& text, const ColumnTable& table)
{
    if (!table.heading_line || !table.headings.empty())
        return;
    for (const std::string& word : words_of(text.lines[*table.heading_line]))
        for (const char* other : {"vel", "disp"})
            if (word.starts_with(other))
                text.refuse(
                    *table.heading_line,
                    fmt::format("the line names a {}, but has not one name for each of the {} columns. Give one "
                                "name for each column, with commas between them.",
                                other == std::string_view("vel") ? "velocity" : "displacement", table.columns.size()));
}

/// Refuses a table without a unit, without a time, or without both.
void refuse_missing(const RecordText& text, const ColumnTable& table, bool no_unit)
{
    const bool no_time = table.columns.size() == 1 && !table.stated_dt_s;
    const std::string time =
        "a single column contains no time. Put the time in s into a first column, or a line \"# dt "
        "= 0.01\" above the values.";
    const std::string unit = fmt::format("plain columns do not contain the unit of the acceleration. {}", unit_remedy);
    if (no_unit && no_time)
        text.refuse(fmt::format("{} Besides, {}", unit, time));
    if (no_unit)
        text.refuse(unit);
    if (no_time)
        text.refuse(table.line.front(), time);
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    using Quantity = ColumnMeaning::Quantity;
    const ColumnTable table = read_columns(text);
    const std::size_t columns = table.columns.size();
    refuse_names_that_do_not_fit(text, table);
    const std::vector<Use> uses = uses_of(text, table);
    const std::optional<StatedUnit> stated = stated_unit(text, table);
    const std::size_t first = columns == 1 ? 0 : 1;
    std::string left_out;
    bool no_unit = false, any = false;
    for (std::size_t c = first; c < columns; ++c) {
        any = any || uses[c].quantity == Quantity::acceleration;
        if (uses[c].quantity != Quantity::acceleration)
            left_out += fmt::format("{}\"{}\" ({})", left_out.empty() ? "" : ", ", table.headings[c],
                                    to_string(uses[c].quantity));
        else
            no_unit = no_unit || (!given && !uses[c].unit && !stated);
    }
    if (!any)
        text.refuse(*table.heading_line, fmt::format("no column is an acceleration: {}. Give the file with the "
                                                     "acceleration.",
                                                     left_out));
    refuse_missing(text, table, no_unit);
    std::vector<Record> records;
    for (std::size_t c = first; c < columns; ++c) {
        if (uses[c].quantity != Quantity::acceleration)
            continue;
        Record record;
        record.component = table.names[c];
        record.column = c + 1;
        record.title = table.title;
        record.unit = uses[c].unit ? unit_of_file(text, *table.heading_line, *uses[c].unit, given)
                      : stated     ? unit_of_file(text, stated->line, stated->unit, given)
                                   : *given;
        if (!left_out.empty())
            record.note = fmt::format("without the columns {}", left_out);
        record.dt_s = columns == 1 ? *table.stated_dt_s : table.dt_s;
        record.acceleration_m_s2 = table.columns[c];
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
    name_columns(text, top, table);
    if (table.columns.size() > 1) {
        const double unit_s = time_unit_s(text, table);
        for (double& time : table.columns.front())
            time *= unit_s;
        table.dt_s = uniform_dt(text, table.columns.front(), table.line);
        if (table.stated_dt_s && std::fabs(*table.stated_dt_s - table.dt_s) > 0.01 * table.dt_s)
            text.refuse(top.first_row,
                        fmt::format("the comment has dt = {} s and the first column {} s. Correct one of them.",
                                    *table.stated_dt_s, table.dt_s));
    }
    if (top.first_comment) {
        const std::string_view line = trimmed(text.lines[*top.first_comment]);
        table.title = trimmed(line.substr(std::min(line.find_first_not_of("#% "), line.size())));
    }
    return table;
}

const RecordParser columns_parser = {"columns", recognise, parse};

} // namespace stylobate
