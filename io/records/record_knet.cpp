/// Japan's files (NIED), K-NET and KiK-net, one component: 17 lines of header, names in columns 1 to 18, then counts of
/// the recorder. Lines that are read:
///
///   Station Code      MYG002
///   Sampling Freq(Hz) 100Hz
///   Duration Time(s)  108
///   Dir.              N-S                  or a channel of KiK-net: 1 NS1, 2 EW1, 3 UD1 below, 4 NS2, 5 EW2, 6 UD2 at
///                                          the surface
///   Scale Factor      3920(gal)/6182761    gal in one count
///   Max. Acc. (gal)   48.060               also "Max Acc."
///
/// The counts have an offset, often larger than the motion itself. NIED's description of the format has the maximum
/// "subtracted the average of whole data", and so is the acceleration here: (count - mean of all counts) x scale. The
/// header does not count the values: there are rate x duration of them.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace stylobate {

namespace {

constexpr std::size_t header_lines = 17, value_column = 18;

/// The line of the header that begins with `name` (lower case).
std::optional<std::size_t> line_of(const RecordText& text, std::string_view name)
{
    for (std::size_t i = 0; i < std::min(header_lines, text.lines.size()); ++i)
        if (lower_case(text.lines[i]).starts_with(name))
            return i;
    return {};
}

bool recognise(const RecordText& text)
{
    return lower_case(text.lines.front()).starts_with("origin time ") && line_of(text, "scale factor");
}

std::string value_of(const RecordText& text, std::size_t i)
{
    return squeezed(text.lines[i].substr(std::min(value_column, text.lines[i].size())));
}

/// @throws InputError if the line is missing or has no value
std::size_t needed(const RecordText& text, std::string_view name)
{
    const std::optional<std::size_t> i = line_of(text, name);
    if (!i)
        text.refuse(fmt::format("has no line \"{}\" in its header of {} lines.", name, header_lines));
    if (value_of(text, *i).empty())
        text.refuse(*i, "a value is missing from column 19 on.");
    return *i;
}

/// The gal in one count, of "3920(gal)/6182761".
double scale_gal(const RecordText& text, std::size_t i)
{
    const std::string factor = lower_case(value_of(text, i));
    constexpr std::string_view middle = "(gal)/";
    const std::size_t at = factor.find(middle);
    if (at == std::string::npos)
        text.refuse(i, fmt::format("the scale factor \"{}\" should read like \"3920(gal)/6182761\".", factor));
    const double full_scale = number(text, i, std::string_view(factor).substr(0, at));
    const double counts = number(text, i, std::string_view(factor).substr(at + middle.size()));
    if (!(full_scale > 0 && counts > 0))
        text.refuse(i, fmt::format("the scale factor \"{}\" must be positive above and below.", factor));
    return full_scale / counts;
}

/// Name of the component ("N-S", "EW2") and its direction ("N-S", "E-W", "U-D").
std::pair<std::string, std::string> direction_of(const std::string& value)
{
    if (value.size() != 1 || value[0] < '1' || value[0] > '6')
        return {value, value};
    const int channel = value[0] - '1';
    const char* pairs[] = {"NS", "EW", "UD"};
    const char* axes[] = {"N-S", "E-W", "U-D"};
    return {fmt::format("{}{}", pairs[channel % 3], channel / 3 + 1), axes[channel % 3]};
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    Record record;
    const std::size_t scale = needed(text, "scale factor");
    const double gal = scale_gal(text, scale);
    record.unit = unit_of_file(text, scale, "gal", given);
    record.station = value_of(text, needed(text, "station code"));
    std::tie(record.component, record.orientation) = direction_of(value_of(text, needed(text, "dir.")));
    record.title = fmt::format("{}, M {}", value_of(text, 0), value_of(text, needed(text, "mag.")));
    for (const char* name : {"max. acc. (gal)", "max acc. (gal)"})
        if (const std::optional<std::size_t> i = line_of(text, name))
            record.header_pga_m_s2 = stated_peak_m_s2(number(text, *i, value_of(text, *i)), "cm/s2");

    const std::size_t frequency = needed(text, "sampling freq(hz)");
    std::string rate = lower_case(value_of(text, frequency));
    if (rate.ends_with("hz"))
        rate.resize(rate.size() - 2);
    const double rate_hz = number(text, frequency, rate);
    record.dt_s = 1 / rate_hz;
    check_dt(text, frequency, record.dt_s);
    const std::size_t duration = needed(text, "duration time(s)");
    const double duration_s = number(text, duration, value_of(text, duration));
    const double values = std::round(rate_hz * duration_s);
    if (!(values >= 2 && values < 1e9)) // a file of the largest size has less than 1e8
        text.refuse(duration, fmt::format("a duration of {} s at {} Hz is {} samples.", duration_s, rate_hz, values));

    std::size_t below = 0;
    record.acceleration_m_s2 = read_numbers(text, header_lines, static_cast<std::size_t>(values), &below);
    refuse_more(text, below);
    const double mean = std::accumulate(record.acceleration_m_s2.begin(), record.acceleration_m_s2.end(), 0.0) / values;
    record.note = fmt::format("without the mean of its counts, {:.6g} cm/s2, as the header's peak is", mean * gal);
    for (double& a : record.acceleration_m_s2)
        a = (a - mean) * gal;
    return {record};
}

} // namespace

const RecordParser knet_parser = {"knet", recognise, parse};

} // namespace stylobate
