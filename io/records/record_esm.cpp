/// ESM and ITACA (Europe, Italy), DYNA 1.x, one component: 64 lines "KEY: value", then one value to a line. Turkey's
/// AFAD writes the same. Keys that are read:
///
///   SAMPLING_INTERVAL_S: 0.005000      UNITS: cm/s^2               STATION_CODE: ARS1
///   NDATA: 19128                       PGA_CM/S^2: 0.300022        STREAM: HNE
///   DURATION_S: 95.640                 DATA_TYPE: ACCELERATION     EVENT_NAME, EVENT_DATE_YYYYMMDD, STATION_NAME
///
/// The values begin below the last key, USER5; headers of other lengths occur (43 lines in the first ITACA). Velocity,
/// displacement and spectra, told by DATA_TYPE, are refused.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t longest_header = 100;

/// The value of a line "KEY: value".
std::string_view value_of(std::string_view line)
{
    const std::size_t colon = line.find(':');
    return colon == std::string_view::npos ? std::string_view() : trimmed(line.substr(colon + 1));
}

/// The line of `key`, or the end of the header.
std::size_t line_of(const RecordText& text, std::size_t header, std::string_view key)
{
    for (std::size_t i = 0; i < header; ++i)
        if (const std::string_view line = trimmed(text.lines[i]);
            line.starts_with(key) && line.substr(key.size()).starts_with(':'))
            return i;
    return header;
}

/// @throws InputError if the key is missing or has no value
std::size_t needed(const RecordText& text, std::size_t header, std::string_view key)
{
    const std::size_t i = line_of(text, header, key);
    if (i == header)
        text.refuse(fmt::format("its header has no line \"{}:\".", key));
    if (value_of(text.lines[i]).empty())
        text.refuse(i, fmt::format("{} has no value.", key));
    return i;
}

/// As it stands in the file; empty if the key is missing or has no value.
std::string optional_value(const RecordText& text, std::size_t header, std::string_view key)
{
    const std::size_t i = line_of(text, header, key);
    return i == header ? std::string() : squeezed(value_of(text.lines[i]));
}

std::size_t header_lines(const RecordText& text)
{
    std::size_t i = 0;
    const auto is_key = [](std::string_view line) {
        const std::size_t colon = line.find(':');
        return colon != std::string_view::npos && colon > 0 && line.front() >= 'A' && line.front() <= 'Z';
    };
    while (i < std::min(text.lines.size(), longest_header) && is_key(trimmed(text.lines[i])))
        ++i;
    return i;
}

bool recognise(const RecordText& text)
{
    return trimmed(text.lines.front()).starts_with("EVENT_NAME:");
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    const std::size_t header = header_lines(text);
    const std::size_t type = needed(text, header, "DATA_TYPE");
    if (lower_case(value_of(text.lines[type])) != "acceleration")
        text.refuse(
            type, fmt::format(
                      "the file holds \"{}\" and not an acceleration. Give the file with the acceleration (.ACC.ASC).",
                      value_of(text.lines[type])));
    Record record;
    const std::size_t units = needed(text, header, "UNITS");
    record.unit = unit_of_file(text, units, value_of(text.lines[units]), given);
    record.station = optional_value(text, header, "STATION_CODE");
    record.orientation = optional_value(text, header, "STREAM");
    record.component = record.orientation.empty() ? "acceleration" : record.orientation;
    for (const char* key : {"EVENT_NAME", "EVENT_DATE_YYYYMMDD", "STATION_NAME"})
        if (const std::string value = optional_value(text, header, key); !value.empty())
            record.title += (record.title.empty() ? "" : ", ") + value;

    const std::size_t step = needed(text, header, "SAMPLING_INTERVAL_S");
    record.dt_s = number(text, step, value_of(text.lines[step]));
    check_dt(text, step, record.dt_s);
    const std::size_t size = needed(text, header, "NDATA");
    const std::size_t count = sample_count(text, size, value_of(text.lines[size]));
    const std::size_t duration = line_of(text, header, "DURATION_S");
    const double n = static_cast<double>(count);
    if (duration < header && !value_of(text.lines[duration]).empty()) {
        const double duration_s = number(text, duration, value_of(text.lines[duration]));
        if (std::fabs(n * record.dt_s - duration_s) > 2 * record.dt_s)
            text.refuse(duration, fmt::format("{} samples every {} s last {} s, but the stated duration is {} s.",
                                              count, record.dt_s, n * record.dt_s, duration_s));
    }
    const std::size_t peak = line_of(text, header, "PGA_CM/S^2");
    if (peak < header && !value_of(text.lines[peak]).empty())
        record.header_pga_m_s2 = stated_peak_m_s2(number(text, peak, value_of(text.lines[peak])), "cm/s2");

    std::size_t below = 0;
    record.acceleration_m_s2 = read_numbers(text, header, count, &below);
    refuse_more(text, below);
    return {record};
}

} // namespace

const RecordParser esm_parser = {"esm", recognise, parse};

} // namespace stylobate
