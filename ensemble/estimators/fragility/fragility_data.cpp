#include "ensemble/estimators/fragility/fragility_data.hpp"

#include "ensemble/model/input_error.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace stylobate {

namespace {

void check(const FragilityRun& run, std::size_t number, std::size_t measures)
{
    const auto refuse = [&](const std::string& text) {
        throw InputError(fmt::format("fragility: run {} (record {}): {}", number, run.record, text));
    };
    if (run.intensity.size() != measures)
        refuse(fmt::format("has {} intensity measures, the first run has {}.\n  Give every run the same measures.",
                           run.intensity.size(), measures));
    for (const double value : run.intensity)
        if (!(value > 0 && std::isfinite(value)))
            refuse(fmt::format("intensity = {} is outside (0, infinity).\n  Curves are fitted to its logarithm: omit "
                               "runs without shaking.",
                               value));
    if (!(run.trials > 0 && run.reached >= 0 && run.reached <= run.trials))
        refuse(fmt::format("reached = {} is outside [0, {}], the number of its trials.", run.reached, run.trials));
}

} // namespace

FragilityData grouped(std::span<const FragilityRun> runs)
{
    if (runs.empty() || runs.front().intensity.empty())
        throw InputError("fragility: there are no runs with an intensity.\n  An estimate needs outcomes.");
    FragilityData data;
    data.measures = runs.front().intensity.size();
    std::map<std::vector<double>, std::uint32_t> points;
    std::map<std::uint32_t, std::uint32_t> records;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        check(runs[i], i, data.measures);
        points.emplace(runs[i].intensity, 0);
        records.emplace(runs[i].record, 0);
    }
    for (auto& [intensity, number] : points) {
        number = static_cast<std::uint32_t>(data.points());
        data.intensity.insert(data.intensity.end(), intensity.begin(), intensity.end());
    }
    for (auto& [name, number] : records)
        number = static_cast<std::uint32_t>(data.records++);

    std::map<std::pair<std::uint32_t, std::uint32_t>, FragilityRow> rows;
    for (const FragilityRun& run : runs) {
        const std::uint32_t record = records[run.record], point = points[run.intensity];
        FragilityRow& row = rows.try_emplace({record, point}, FragilityRow{record, point, 0, 0}).first->second;
        row.trials += run.trials;
        row.reached += run.reached;
    }
    data.first_row.assign(data.records + 1, 0);
    for (const auto& [key, row] : rows) {
        data.rows.push_back(row);
        data.first_row[row.record + 1] = data.rows.size();
    }
    return data;
}

FragilityData grouped(const std::vector<double>& intensity, const std::vector<double>& trials,
                      const std::vector<double>& reached)
{
    std::vector<FragilityRun> runs;
    for (std::size_t i = 0; i < trials.size(); ++i)
        if (trials[i] > 0)
            runs.push_back({static_cast<std::uint32_t>(i / intensity.size()),
                            {intensity[i % intensity.size()]},
                            reached[i],
                            trials[i]});
    return grouped(runs);
}

std::vector<std::vector<double>> record_shares(const FragilityData& data)
{
    std::vector<double> trials(data.points()), all(data.points());
    for (const FragilityRow& row : data.rows) {
        trials[row.point] += row.trials;
        all[row.point] += row.reached;
    }
    for (std::size_t j = 0; j < all.size(); ++j)
        all[j] /= trials[j];
    std::vector<std::vector<double>> shares(data.records, all);
    for (const FragilityRow& row : data.rows)
        shares[row.record][row.point] = row.reached / row.trials;
    return shares;
}

FragilityData with_measure(const FragilityData& data, std::size_t measure)
{
    std::vector<FragilityRun> runs;
    runs.reserve(data.rows.size());
    for (const FragilityRow& row : data.rows)
        runs.push_back({row.record, {data.intensity[row.point * data.measures + measure]}, row.reached, row.trials});
    return grouped(runs);
}

const char* to_string(Link link)
{
    return link == Link::probit ? "probit" : "logit";
}

LinkValue link_at(Link link, double eta)
{
    using std::numbers::inv_sqrtpi;
    using std::numbers::sqrt2;
    if (link == Link::probit) {
        const double density = inv_sqrtpi / sqrt2 * std::exp(-eta * eta / 2);
        return {std::erfc(-eta / sqrt2) / 2, std::erfc(eta / sqrt2) / 2, density, -eta * density};
    }
    // by the smaller exponential, so that neither tail overflows
    const double small = std::exp(-std::abs(eta));
    const double far = small / (1 + small), near = 1 / (1 + small);
    const double below = eta < 0 ? far : near, above = eta < 0 ? near : far;
    return {below, above, far * near, far * near * (above - below)};
}

double link_quantile(Link link, double probability)
{
    assert(probability > 0 && probability < 1);
    if (link == Link::probit)
        return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * probability);
    return std::log(probability / (1 - probability));
}

} // namespace stylobate
