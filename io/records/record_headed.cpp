/// Lines "NAME : value" (or "=") that state the number of values and their interval, then the values. National networks
/// and data bases write such files, each with names of its own:
///
///   NUMBER OF DATA          : 200                   Number of Data     : 200
///   SAMPLING INTERVAL (sec) : 0.01                  Time Increment (s) : 0.005
///   RAW PGA VALUES (gal)    : (N-S) 60.0 (E-W) ...  PGA (m/s/s)        : 1.2871778E+00
///        N-S          E-W          U-D              Accelaration time series in m/s/s
///       0.000000     0.000000     0.000000           0.0000000E+00 3.0859871E-04 ...
///   (Turkey's NSMN)                                 (the European data base, files "cor")
///
/// The values are those of one component, several to a line; or rows with a column for each component, with or without
/// the time in the first one. The line above the rows names the columns. A unit that stands beside the peak only is
/// taken if the samples have about that peak.

#include "io/files/csv_fields.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t longest_header = 80;

bool has_one_of(std::string_view text, std::initializer_list<std::string_view> phrases)
{
    return std::any_of(phrases.begin(), phrases.end(),
                       [&](std::string_view phrase) { return text.find(phrase) != std::string_view::npos; });
}

/// A line "Time Increment (s) : 0.005".
struct Entry {
    std::size_t line = 0;
    std::string name;   ///< in lower case, without what stands in brackets
    std::string inside; ///< the brackets
    std::string value;  ///< behind the colon
};

std::string_view without_marks(std::string_view line)
{
    line = trimmed(line);
    return trimmed(line.substr(std::min(line.find_first_not_of("#%*! \t"), line.size())));
}

std::optional<Entry> entry_of(const RecordText& text, std::size_t i)
{
    const std::string line = squeezed(without_marks(text.lines[i]));
    const std::size_t mark = line.find_first_of(":=");
    if (mark == std::string::npos || mark == 0)
        return {};
    Entry entry{i, lower_case(trimmed(std::string_view(line).substr(0, mark))), {}, {}};
    entry.value = trimmed(std::string_view(line).substr(mark + 1));
    const std::size_t open = entry.name.find_first_of("(["), close = entry.name.find_first_of(")]");
    if (open != std::string::npos && close != std::string::npos && close > open) {
        entry.inside = entry.name.substr(open + 1, close - open - 1);
        entry.name = std::string(trimmed(entry.name.substr(0, open) + entry.name.substr(close + 1)));
    }
    std::replace(entry.name.begin(), entry.name.end(), '_', ' ');
    return entry;
}

bool is_count(const Entry& entry)
{
    const std::string& name = entry.name;
    if (has_one_of(name, {"channel", "component", "canal", "line", "header"}))
        return false; // what is counted there is not samples
    const bool counts = has_one_of(name, {"number of", "no. of", "no of", "num. of", "num of", "nr. of", "numero de",
                                          "# of", "total"}) &&
                        has_one_of(name, {"data", "point", "sample", "value", "datos", "muestras", "puntos"});
    return counts || name == "npts" || name == "ndata" || name == "npoints" || name == "nsamples" ||
           name == "samples" || name == "data points";
}

bool is_interval(const Entry& entry)
{
    return has_one_of(entry.name,
                      {"sampling interval", "sample interval", "time increment", "time step", "time interval",
                       "sampling period", "sampling time", "intervalo de muestreo", "delta t"}) ||
           entry.name == "dt" || (entry.name == "delta" && entry.inside != "km");
}

bool is_rate(const Entry& entry)
{
    return has_one_of(entry.name, {"sampling rate", "sample rate", "samplerate", "sampling freq", "sampling hz",
                                   "frecuencia de muestreo", "tasa de muestreo", "samples per second"});
}

bool is_unit(const Entry& entry)
{
    if (has_one_of(entry.name, {"time", "velocity", "displacement"}))
        return false;
    const bool known = canonical_unit(parts_of(entry.value, true).front()).has_value();
    return entry.name == "unit" || entry.name == "units" ||
           (known && has_one_of(entry.name, {"unit", "unidad", "einheit"}));
}

bool is_peak(const Entry& entry)
{
    return !has_one_of(entry.name, {"time"}) &&
           has_one_of(entry.name, {"pga", "peak ground acc", "peak acc", "max acc", "maximum acc", "max. acc"});
}

struct Header {
    std::optional<Entry> count, interval, unit, peak;
    std::string station, orientation;
    std::size_t end = 0; ///< the first row of values
};

Header header_of(const RecordText& text)
{
    Header header;
    std::size_t& i = header.end;
    for (; i < std::min(text.lines.size(), longest_header); ++i) {
        if (is_row(text.lines[i]))
            break;
        const std::optional<Entry> entry = entry_of(text, i);
        if (!entry)
            continue;
        const auto take = [&](std::optional<Entry>& place, bool fits) {
            if (fits && !place && !entry->value.empty())
                place = entry;
        };
        take(header.count, is_count(*entry) && is_number(parts_of(entry->value, true).front()));
        take(header.interval,
             (is_interval(*entry) || is_rate(*entry)) && is_number(parts_of(entry->value, true).front()));
        take(header.unit, is_unit(*entry));
        take(header.peak, is_peak(*entry));
        if (header.station.empty() && entry->name.starts_with("station"))
            header.station = entry->value;
        if (header.orientation.empty() &&
            has_one_of(entry->name, {"orientation", "component", "direction", "azimuth", "componente"}))
            header.orientation = entry->value;
    }
    return header;
}

bool recognise(const RecordText& text)
{
    const Header header = header_of(text);
    return header.count && header.interval;
}

double interval_s(const RecordText& text, const Entry& entry)
{
    const auto words = parts_of(entry.value, true);
    const double value = number(text, entry.line, words.front());
    const std::string unit = plain_unit(words.size() > 1 ? std::string(words[1]) : entry.inside);
    const double dt_s = is_rate(entry) ? 1 / value : unit == "ms" ? value / 1000 : value;
    check_dt(text, entry.line, dt_s);
    return dt_s;
}

/// Refuses a file whose header names another series than the acceleration.
void refuse_other_series(const RecordText& text, const Header& header)
{
    for (std::size_t i = 0; i < header.end; ++i)
        if (has_one_of(lower_case(squeezed(text.lines[i])),
                       {"time series", "time history", "data type", "series in", "quantity"}))
            refuse_other_quantity(text, i);
}

/// The unit of the values.
struct Unit {
    std::string name; ///< canonical
    bool of_peak_only = false;
};

Unit unit_of(const RecordText& text, const Header& header, const std::optional<std::string>& given)
{
    if (header.unit) {
        const std::string spelled(parts_of(header.unit->value, true).front());
        return {unit_of_file(text, header.unit->line, spelled, given), false};
    }
    for (std::size_t i = 0; i < header.end; ++i)
        if (const auto unit = unit_in_line(text.lines[i]); unit && (!header.peak || header.peak->line != i))
            return {unit_of_file(text, i, *unit, given), false};
    if (header.peak && canonical_unit(header.peak->inside))
        return {unit_of_file(text, header.peak->line, header.peak->inside, given), !given};
    if (!given)
        text.refuse(fmt::format("does not contain the unit of its acceleration. {}", unit_remedy));
    return {*given, false};
}

/// The peak of a component: the one that stands behind its name, "(N-S) 60.0", or the only one.
std::optional<double> peak_of(const Header& header, const std::string& component)
{
    if (!header.peak)
        return {};
    const std::string& value = header.peak->value;
    const std::size_t at = component.empty() ? std::string::npos : lower_case(value).find(lower_case(component));
    const std::string_view rest =
        at == std::string::npos ? std::string_view(value) : std::string_view(value).substr(at + component.size());
    std::string_view token = trimmed(rest.substr(std::min(rest.find_first_not_of(")]:= "), rest.size())));
    token = token.substr(0, token.find_first_of(" ,;("));
    double peak = 0;
    return decimal_number(token, peak).ec == std::errc() ? std::optional(peak) : std::nullopt;
}

/// A direction, a quantity or a letter.
bool is_name(const std::string& word)
{
    return word.size() == 1 || direction_of_name(word) != Direction::unknown ||
           meaning_of_column(word).of_words != ColumnMeaning::Quantity::unnamed;
}

/// The names above the rows, one for each column; empty if there are none.
std::vector<std::string> names_above(const RecordText& text, const Header& header, std::size_t columns)
{
    for (std::size_t i = header.end; i-- > 0;) {
        if (trimmed(text.lines[i]).empty() || is_end_mark(text.lines[i]))
            continue;
        const std::optional<Entry> entry = entry_of(text, i);
        std::vector<std::string> names;
        for (const std::string_view part : parts_of(entry ? entry->value : without_marks(text.lines[i]), true))
            names.emplace_back(part);
        const bool fit = names.size() == columns && std::all_of(names.begin(), names.end(), is_name);
        return fit ? names : std::vector<std::string>();
    }
    return {};
}

/// Rows of `columns` numbers, `count` of them.
std::vector<std::vector<double>> read_rows(const RecordText& text, std::size_t first, std::size_t count,
                                           std::size_t columns, std::size_t& below)
{
    std::vector<std::vector<double>> series(columns);
    std::size_t last = first;
    for (below = first; series[0].size() < count; ++below) {
        if (below >= text.lines.size())
            text.refuse(first, fmt::format("{} rows should follow, but the file ends after {}: it is truncated, or its "
                                           "header is wrong. Obtain the complete file.",
                                           count, series[0].size()));
        if (trimmed(text.lines[below]).empty())
            continue;
        add_row(text, below, series);
        last = below;
    }
    refuse_cut_number(text, first, last, true);
    return series;
}

/// Whether the first of several columns is the time.
bool begins_with_time(const std::vector<std::vector<double>>& series, const std::vector<std::string>& names,
                      double dt_s)
{
    if (series.size() < 2)
        return false;
    if (!names.empty() && meaning_of_column(names.front()).of_words == ColumnMeaning::Quantity::time)
        return true;
    const std::vector<double>& first = series.front();
    const double span = dt_s * static_cast<double>(first.size() - 1);
    return names.empty() && std::fabs(first.back() - first.front() - span) < dt_s;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    const Header header = header_of(text);
    refuse_other_series(text, header);
    const std::size_t count = sample_count(text, header.count->line, parts_of(header.count->value, true).front());
    const double dt_s = interval_s(text, *header.interval);
    const Unit unit = unit_of(text, header, given);
    if (header.end >= std::min(text.lines.size(), longest_header))
        text.refuse(text.lines.size() - 1, "no row of numbers follows the header: the file is truncated.");

    const std::size_t columns = parts_of(text.lines[header.end], true).size();
    std::size_t numbers = 0, rows = 0;
    for (std::size_t i = header.end; i < text.lines.size(); ++i)
        if (is_row(text.lines[i])) {
            ++rows;
            numbers += parts_of(text.lines[i], true).size();
        }
    // one component with several values to a line, or a column for each component
    std::vector<std::string> names = names_above(text, header, columns);
    const bool one = columns == 1 || (numbers == count && rows < count) || (names.empty() && numbers < count * columns);
    if (one)
        names.clear();
    std::vector<std::vector<double>> series;
    std::size_t below = 0;
    if (one)
        series.push_back(read_numbers(text, header.end, count, &below));
    else
        series = read_rows(text, header.end, count, columns, below);
    refuse_more(text, below);

    std::vector<Record> records;
    for (std::size_t c = !one && begins_with_time(series, names, dt_s) ? 1 : 0; c < series.size(); ++c) {
        const ColumnMeaning meaning = names.empty() ? ColumnMeaning() : meaning_of_column(names[c]);
        if (meaning.plain && meaning.of_words != ColumnMeaning::Quantity::acceleration)
            continue;
        Record record;
        record.orientation = !names.empty() ? names[c] : series.size() == 1 ? header.orientation : "";
        record.component = !record.orientation.empty() ? record.orientation
                           : series.size() == 1        ? "acceleration"
                                                       : fmt::format("column {}", c + 1);
        record.station = header.station;
        record.title = squeezed(without_marks(text.lines[0]));
        record.unit = unit.name;
        record.dt_s = dt_s;
        record.column = c + 1;
        record.acceleration_m_s2 = std::move(series[c]);
        double largest = 0; // in m/s2
        for (const double a : record.acceleration_m_s2)
            largest = std::max(largest, std::fabs(a) * unit_m_s2(record.unit));
        const auto peak_unit = header.peak ? canonical_unit(header.peak->inside) : std::nullopt;
        if (const auto peak = peak_of(header, names.empty() ? "" : names[c]); peak && peak_unit)
            record.header_pga_m_s2 = stated_peak_m_s2(*peak, *peak_unit);
        constexpr double alike = 3;
        if (unit.of_peak_only && record.header_pga_m_s2 &&
            !(largest < alike * *record.header_pga_m_s2 && largest > *record.header_pga_m_s2 / alike))
            text.refuse(
                header.peak->line,
                fmt::format("the unit stands beside the peak only, and the samples of \"{}\" reach {:.4g} m/s2 in "
                            "that unit where the header has {:.4g} m/s2. {}",
                            record.component, largest, *record.header_pga_m_s2, unit_remedy));
        records.push_back(std::move(record));
    }
    if (records.empty())
        text.refuse(header.end, "no column is an acceleration. Give the file with the acceleration.");
    return records;
}

} // namespace

const RecordParser headed_parser = {"headed", recognise, parse};

} // namespace stylobate
