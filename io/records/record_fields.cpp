/// What the headers of agencies share, and how samples stand below them: in columns of a fixed width, between blanks,
/// or as pairs of time and value, as they were digitised from film.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <system_error>

namespace stylobate {

namespace {

[[noreturn]] void refuse_end(const RecordText& text, std::size_t first_line, std::size_t found, std::size_t count)
{
    text.refuse(std::min(first_line, text.lines.size() - 1),
                fmt::format("{} values should follow, but the file ends after {}: it is truncated, or its header is "
                            "wrong. Obtain the complete file.",
                            count, found));
}

constexpr double time_unit_s = 0.001;

/// Where each sample was taken, in whole milliseconds, growing.
std::vector<long> times_of(const RecordText& text, std::size_t first_value, int per_line,
                           const std::vector<double>& pairs)
{
    std::vector<long> times_ms;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
        const std::size_t line = first_value + i / static_cast<std::size_t>(per_line);
        const double ms = std::round(pairs[i] / time_unit_s);
        // seven columns with three decimals hold no more
        if (!(std::fabs(ms * time_unit_s - pairs[i]) < 1e-6) || !(ms >= 0 && ms < 1e6))
            text.refuse(line,
                        fmt::format("the time {} s is not a whole number of milliseconds below 1000 s.", pairs[i]));
        const long time = static_cast<long>(ms);
        if (!times_ms.empty() && time <= times_ms.back())
            text.refuse(
                line, fmt::format("the time {} s follows {} s: times must increase. A value is missing or duplicated.",
                                  pairs[i], pairs[i - 2]));
        if (!times_ms.empty() && static_cast<double>(time - times_ms.back()) * time_unit_s > longest_dt_s)
            text.refuse(line, fmt::format("the time goes from {} s to {} s, more than {} s: values are missing.",
                                          pairs[i - 2], pairs[i], longest_dt_s));
        times_ms.push_back(time);
    }
    return times_ms;
}

} // namespace

std::size_t find_line(const RecordText& text, std::size_t first, std::size_t last, std::string_view phrase)
{
    last = std::min(last, text.lines.size());
    for (std::size_t i = first; i < last; ++i)
        if (lower_case(squeezed(text.lines[i])).find(phrase) != std::string::npos)
            return i;
    return last;
}

std::size_t header_line(const RecordText& text, std::size_t top, std::size_t lines, std::string_view phrase)
{
    const std::size_t end = std::min(top + lines, text.lines.size());
    const std::size_t i = find_line(text, top, end, phrase);
    if (i == end)
        text.refuse(top, fmt::format("the component has no line with \"{}\" in its header: it is truncated or damaged.",
                                     phrase));
    return i;
}

std::string word_after(std::string_view line, std::string_view key)
{
    const std::string words = squeezed(line);
    std::size_t at = lower_case(words).find(key);
    if (at == std::string::npos)
        return {};
    at = words.find_first_not_of(" =:", at + key.size());
    return at == std::string::npos ? std::string() : words.substr(at, words.find_first_of(" ,;", at) - at);
}

std::size_t sample_count(const RecordText& text, std::size_t i, std::string_view token)
{
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), count);
    if (error != std::errc() || end != token.data() + token.size() || count < 2)
        text.refuse(i, fmt::format("the number of samples, \"{}\", must be a whole number of at least 2.", token));
    return count;
}

void refuse_more(const RecordText& text, std::size_t i)
{
    for (; i < text.lines.size(); ++i)
        if (!trimmed(text.lines[i]).empty() && !is_end_mark(text.lines[i]))
            text.refuse(i, fmt::format("\"{}\" follows after all values that the header counts: the count is wrong, or "
                                       "the file is damaged.",
                                       trimmed(text.lines[i]).substr(0, 40)));
}

std::optional<double> stated_peak_m_s2(double peak, std::string_view unit)
{
    const double size = std::fabs(peak) * unit_m_s2(unit);
    return size > 0 && std::isfinite(size) ? std::optional(size) : std::nullopt;
}

FortranFormat fortran_format(const RecordText& text, std::size_t i, std::string_view spelling)
{
    const std::string format = lower_case(spelling);
    constexpr std::string_view digits = "0123456789";
    const std::size_t first = format.starts_with('(') ? 1 : 0;
    const std::size_t kind = std::min(format.find_first_not_of(digits, first), format.size());
    const std::size_t end = std::min(format.find_first_not_of(digits, kind + 1), format.size());
    const auto whole = [&](std::size_t from, std::size_t to) {
        const bool fits = to > from && to - from <= 2;
        return fits ? std::stoi(format.substr(from, to - from)) : 0;
    };
    const bool known = kind < format.size() && std::string_view("fei").find(format[kind]) != std::string_view::npos;
    const FortranFormat layout = {kind == first ? 1 : whole(first, kind), known ? whole(kind + 1, end) : 0};
    if (layout.per_line == 0 || layout.width == 0)
        text.refuse(i, fmt::format("the format of the values, \"{}\", should read like \"(8f9.6)\".", spelling));
    return layout;
}

std::optional<FortranFormat> layout_of(std::string_view line)
{
    line = line.substr(0, line.find_last_not_of(" \t") + 1);
    const std::size_t first = line.find('.');
    if (first == std::string_view::npos)
        return {};
    FortranFormat layout{1, static_cast<int>(line.size())};
    std::size_t last = first;
    for (std::size_t point = line.find('.', first + 1); point != std::string_view::npos;
         point = line.find('.', point + 1)) {
        const int step = static_cast<int>(point - last);
        if (layout.per_line > 1 && step != layout.width)
            return {};
        layout.width = step;
        last = point;
        ++layout.per_line;
    }
    const bool whole = static_cast<std::size_t>(layout.per_line * layout.width) == line.size();
    return whole ? std::optional(layout) : std::nullopt;
}

std::size_t lines_of_values(std::size_t count, int per_line)
{
    const auto n = static_cast<std::size_t>(per_line);
    return (count + n - 1) / n;
}

std::vector<double> fixed_width_numbers(const RecordText& text, std::size_t first_line, std::size_t count, int width,
                                        int per_line, int indent)
{
    const auto w = static_cast<std::size_t>(width), skipped = static_cast<std::size_t>(indent);
    std::vector<double> values;
    for (std::size_t i = first_line; values.size() < count; ++i) {
        if (i >= text.lines.size())
            refuse_end(text, first_line, values.size(), count);
        const std::string_view line = text.lines[i].substr(std::min(skipped, text.lines[i].size()));
        const std::size_t fields = std::min(static_cast<std::size_t>(per_line), count - values.size());
        for (std::size_t k = 0; k < fields; ++k) {
            const std::string_view field = line.substr(std::min(k * w, line.size()), w);
            const std::string_view token = trimmed(field);
            // the last row of a cut file; elsewhere a short row has lost values
            const bool cut = i + 1 == text.lines.size() && !text.ended && field.size() < w;
            if (cut)
                refuse_end(text, first_line, values.size(), count);
            if (token.empty() || field.size() < w)
                text.refuse(i, fmt::format("value {} of the {} in this line is {}, in columns {} to {}: the line is "
                                           "damaged.",
                                           k + 1, fields, token.empty() ? "missing" : "cut", skipped + k * w + 1,
                                           skipped + (k + 1) * w));
            values.push_back(number(text, i, token));
        }
        if (const std::string_view rest = trimmed(line.substr(std::min(fields * w, line.size()))); !rest.empty())
            text.refuse(i, fmt::format("\"{}\" follows after the {} values of {} columns that this line should have: "
                                       "the count in the header is wrong, or the file is damaged.",
                                       rest.substr(0, 40), fields, width));
    }
    return values;
}

std::vector<double> read_numbers(const RecordText& text, std::size_t first_line, std::size_t count,
                                 std::size_t* next_line)
{
    std::vector<double> values;
    std::size_t i = first_line, last = first_line;
    for (; values.size() < count; ++i) {
        if (i >= text.lines.size())
            refuse_end(text, first_line, values.size(), count);
        if (trimmed(text.lines[i]).empty())
            continue;
        const auto parts = parts_of(text.lines[i], false);
        for (const std::string_view token : parts)
            values.push_back(number(text, i, token));
        last = i;
    }
    if (values.size() > count)
        text.refuse(i - 1, fmt::format("this line goes {} beyond the {} values that should stand from line {} on: the "
                                       "count in the header is wrong, or the file is damaged.",
                                       values.size() - count, count, first_line + 1));
    if (count > 0)
        refuse_cut_number(text, first_line, last, false);
    if (next_line)
        *next_line = i;
    return values;
}

std::vector<Record> one_after_another(const RecordText& text, const std::optional<std::string>& given,
                                      Record (*read)(const RecordText& text, std::size_t& line,
                                                     const std::optional<std::string>& given))
{
    std::vector<Record> records;
    for (std::size_t line = 0; line < text.lines.size();) {
        if (trimmed(text.lines[line]).empty() || (!records.empty() && is_end_mark(text.lines[line])))
            ++line;
        else
            records.push_back(read(text, line, given));
    }
    return records;
}

double fill_from_pairs(const RecordText& text, std::size_t first_value, int per_line, const std::vector<double>& pairs,
                       Record& record)
{
    const std::vector<long> times_ms = times_of(text, first_value, per_line, pairs);
    const std::size_t count = times_ms.size();
    long step_ms = 0, longest_ms = 0;
    for (std::size_t i = 1; i < count; ++i) {
        step_ms = std::gcd(step_ms, times_ms[i] - times_ms[i - 1]);
        longest_ms = std::max(longest_ms, times_ms[i] - times_ms[i - 1]);
    }
    record.dt_s = static_cast<double>(step_ms) * time_unit_s;
    if (longest_ms > step_ms)
        record.note =
            (record.note ? *record.note + "; " : "") +
            fmt::format("{} uneven samples, up to {} ms apart, on an even grid of {} ms that has all of their "
                        "times; straight lines between, the PGA is that of the samples",
                        count, longest_ms, step_ms);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const long steps = (times_ms[i + 1] - times_ms[i]) / step_ms;
        const double from = pairs[2 * i + 1], rise = pairs[2 * i + 3] - from;
        for (long k = 0; k < steps; ++k)
            record.acceleration_m_s2.push_back(from + rise * static_cast<double>(k) / static_cast<double>(steps));
    }
    record.acceleration_m_s2.push_back(pairs.back());
    return static_cast<double>(times_ms.back()) * time_unit_s;
}

} // namespace stylobate
