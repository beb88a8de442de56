/// Records that are pairs of time and value, as they were digitised from film.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

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
        record.note +=
            (record.note.empty() ? "" : "; ") +
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
