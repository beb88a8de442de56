/// USGS SMC, one component: a fixed header, then values in cm/s2 that may touch.
///
///   11 lines of text: the kind of data, the event (line 4), "station = ..., component= 360" (line 6)
///    6 lines, 8I10:   integer 1 means "not known", 13 and 14 are the angles of the sensor from the vertical and from
///                     north, 16 the number of comment lines, 17 the number of values
///   10 lines, 5E15.7: real 1 means "not known", 2 is the sampling rate, 30 and 32 are the largest and least value
///      comment lines: each begins with "|"
///      values:        8E10.4, " 1.5057E+0-2.2223E+0"
///
/// The kinds: 1 uncorrected and 2 corrected acceleration; 3 velocity, 4 displacement and 5, 6 spectra are refused.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t text_lines = 11, integer_lines = 6, real_lines = 10;

std::string kind_of(const RecordText& text)
{
    return lower_case(squeezed(text.lines.front()));
}

bool recognise(const RecordText& text)
{
    const std::string kind = kind_of(text);
    for (const char* known : {"1 uncorrected accelerogram", "2 corrected accelerogram", "3 velocity", "4 displacement",
                              "5 response spectra", "6 fourier"})
        if (kind.starts_with(known))
            return true;
    return false;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    if (kind_of(text).find("accelerogram") == std::string::npos)
        text.refuse(0, fmt::format("the file holds \"{}\" and not an acceleration. Give the file that begins with \"2 "
                                   "CORRECTED ACCELEROGRAM\".",
                                   squeezed(text.lines.front())));
    constexpr std::size_t first_real = text_lines + integer_lines, first_comment = first_real + real_lines;
    const auto integers = fixed_width_numbers(text, text_lines, 48, 10, 8);
    const auto reals = fixed_width_numbers(text, first_real, 50, 15, 5);
    // what a header number counts is in the text as it stands, "6001" and never "6001.0"
    const auto counted = [&](std::size_t which) {
        return trimmed(text.lines[text_lines + which / 8].substr(which % 8 * 10, 10));
    };
    const double comments = integers[15];
    if (!(comments >= 0 && comments < static_cast<double>(text.lines.size())) || comments != std::floor(comments))
        text.refuse(text_lines + 1,
                    fmt::format("the number of comment lines, {}, is impossible for this file.", counted(15)));
    const std::size_t first_value = first_comment + static_cast<std::size_t>(comments);
    for (std::size_t i = first_comment; i < std::min(first_value, text.lines.size()); ++i)
        if (!text.lines[i].starts_with('|'))
            text.refuse(
                i, fmt::format("one of the {} comment lines should stand here and begin with \"|\".", counted(15)));

    Record record;
    record.unit = unit_of_file(text, 0, "cm/s2", given);
    record.title = squeezed(text.lines[3]);
    const std::string_view place = text.lines[5];
    const std::string lower = lower_case(place);
    const std::size_t station = lower.find("station =");
    const std::size_t component = std::min(lower.find("component="), lower.size());
    if (station < component)
        record.station = squeezed(place.substr(station + 9, component - station - 9));
    record.orientation = word_after(place, "component=");
    record.component = record.orientation.empty() ? "acceleration" : record.orientation;

    if (integers[12] == 0 || integers[12] == 180)
        record.direction = Direction::vertical;

    const double unknown = reals[0];
    constexpr std::size_t rate_line = first_real;
    if (reals[1] == unknown || !(reals[1] > 0))
        text.refuse(rate_line, fmt::format("the sampling rate is {}: unknown in the header.", reals[1]));
    record.dt_s = 1 / reals[1];
    check_dt(text, rate_line, record.dt_s);
    for (const std::size_t which : {29u, 31u})
        if (const auto peak = stated_peak_m_s2(reals[which], record.unit); peak && reals[which] != unknown)
            record.header_pga_m_s2 = std::max(record.header_pga_m_s2.value_or(0), *peak);

    const std::size_t count = sample_count(text, text_lines + 2, counted(16));
    record.acceleration_m_s2 = fixed_width_numbers(text, first_value, count, 10, 8);
    refuse_more(text, first_value + (count + 7) / 8);
    return {record};
}

} // namespace

const RecordParser smc_parser = {"usgs-smc", recognise, parse};

} // namespace stylobate
