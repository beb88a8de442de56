#include "studies/diagnosis/statistics/summaries.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

/// @param reduce label -> what is left of it
template <class Reduce>
Summary summary_of(const std::vector<StatisticLabel>& statistics, Reduce&& reduce)
{
    Summary out;
    for (std::size_t i = 0; i < statistics.size(); ++i) {
        const StatisticLabel label = reduce(statistics[i]);
        const auto at = std::find(out.labels.begin(), out.labels.end(), label);
        const auto place = static_cast<std::size_t>(at - out.labels.begin());
        if (at == out.labels.end()) {
            out.labels.push_back(label);
            out.groups.emplace_back();
        }
        out.groups[place].push_back(i);
    }
    return out;
}

template <class Value>
std::vector<double> of_groups(const Summary& summary, const std::vector<double>& values, Value&& value)
{
    std::vector<double> out;
    for (const std::vector<std::size_t>& group : summary.groups) {
        std::vector<double> known;
        for (const std::size_t i : group)
            if (std::isfinite(values[i]))
                known.push_back(values[i]);
        out.push_back(known.empty() ? std::numeric_limits<double>::quiet_NaN() : value(std::move(known)));
    }
    return out;
}

} // namespace

Summary over_motions(const std::vector<StatisticLabel>& statistics)
{
    return summary_of(statistics, [](StatisticLabel label) {
        label.motion = -1;
        return label;
    });
}

Summary over_joints(const std::vector<StatisticLabel>& statistics)
{
    return summary_of(statistics, [](StatisticLabel label) {
        label.joint = label.block = -1;
        return label;
    });
}

std::vector<double> means(const Summary& summary, const std::vector<double>& values)
{
    return of_groups(summary, values, [](const std::vector<double>& known) {
        double sum = 0;
        for (const double value : known)
            sum += value;
        return sum / static_cast<double>(known.size());
    });
}

std::vector<double> medians(const Summary& summary, const std::vector<double>& values)
{
    return of_groups(summary, values, [](std::vector<double> known) { return upper_median(std::move(known)); });
}

} // namespace stylobate
