#include "ensemble/estimators/fragility/dispersion_shares.hpp"

#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/interval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace stylobate {
namespace {

using Differences = std::array<double, dispersion_levels>;

/// Mean and mean square of a group, its children with equal weights.
struct Moments {
    double mean = 0, square = 0;
};

/// Children that differ at one level: the sums over their pairs.
struct Siblings {
    double count = 0, mean = 0, square = 0, mean_squared = 0;

    void add(const Moments& child)
    {
        count += 1;
        mean += child.mean;
        square += child.square;
        mean_squared += child.mean * child.mean;
    }
    Moments moments() const { return {mean / count, square / count}; }
    /// Half the mean squared difference of runs from different children.
    double half_difference() const { return square / count - (mean * mean - mean_squared) / (count * (count - 1)); }
};

/// One record at one stripe: its moments, and the weighted differences within it.
struct RecordPart {
    Moments moments;
    Differences sum{}, weight{}; ///< the record's own level is left 0
};

/// Runs of one record and stripe, sorted by imperfection and contact.
RecordPart part_of(std::span<const NestedRun> runs)
{
    RecordPart part;
    const auto note = [&](DispersionLevel level, const Siblings& siblings) {
        if (siblings.count > 1) {
            part.sum[static_cast<std::size_t>(level)] += (siblings.count - 1) * siblings.half_difference();
            part.weight[static_cast<std::size_t>(level)] += siblings.count - 1;
        }
    };
    Siblings structures;
    for (std::size_t i = 0; i < runs.size();) {
        const std::uint32_t structure = runs[i].imperfection;
        Siblings contacts;
        while (i < runs.size() && runs[i].imperfection == structure) {
            const std::uint32_t contact = runs[i].contact;
            Siblings twins;
            for (; i < runs.size() && runs[i].imperfection == structure && runs[i].contact == contact; ++i)
                twins.add({runs[i].response, runs[i].response * runs[i].response});
            note(DispersionLevel::chaos, twins);
            contacts.add(twins.moments());
        }
        note(DispersionLevel::contact, contacts);
        structures.add(contacts.moments());
    }
    note(DispersionLevel::imperfection, structures);
    part.moments = structures.moments();
    return part;
}

/// The parts of all records, and their sums, with or without one of them.
class Parts {
public:
    explicit Parts(std::span<const NestedRun> given)
    {
        std::vector<NestedRun> runs(given.begin(), given.end());
        const auto place = [](const NestedRun& run) {
            return std::tuple(run.record, run.stripe, run.imperfection, run.contact);
        };
        // equal places keep their order, so that the sums do too
        std::stable_sort(runs.begin(), runs.end(),
                         [&](const NestedRun& a, const NestedRun& b) { return place(a) < place(b); });
        for (std::size_t i = 0; i < runs.size();) {
            std::size_t end = i;
            while (end < runs.size() && runs[end].record == runs[i].record && runs[end].stripe == runs[i].stripe)
                ++end;
            if (i == 0 || runs[i].record != runs[i - 1].record)
                records_.emplace_back();
            const RecordPart part = part_of(std::span(runs).subspan(i, end - i));
            records_.back().emplace_back(runs[i].stripe, part);
            stripes_[runs[i].stripe].add(part.moments);
            add(part, 1, sum_, weight_);
            i = end;
        }
    }

    std::size_t records() const { return records_.size(); }

    /// D of each level over all records but one (none: records()); NaN where there are no pairs.
    Differences differences(std::size_t without) const
    {
        Differences sum = sum_, weight = weight_;
        std::map<std::uint32_t, Siblings> stripes = stripes_;
        if (without < records_.size())
            for (const auto& [stripe, part] : records_[without]) {
                add(part, -1, sum, weight);
                Siblings& others = stripes[stripe];
                others.count -= 1;
                others.mean -= part.moments.mean;
                others.square -= part.moments.square;
                others.mean_squared -= part.moments.mean * part.moments.mean;
            }
        for (const auto& [stripe, siblings] : stripes)
            if (siblings.count > 1) {
                sum[0] += (siblings.count - 1) * siblings.half_difference();
                weight[0] += siblings.count - 1;
            }
        Differences found;
        for (std::size_t l = 0; l < dispersion_levels; ++l)
            found[l] = weight[l] > 0.5 ? sum[l] / weight[l] : std::numeric_limits<double>::quiet_NaN();
        return found;
    }

private:
    static void add(const RecordPart& part, double sign, Differences& sum, Differences& weight)
    {
        for (std::size_t l = 0; l < dispersion_levels; ++l) {
            sum[l] += sign * part.sum[l];
            weight[l] += sign * part.weight[l];
        }
    }

    std::vector<std::vector<std::pair<std::uint32_t, RecordPart>>> records_;
    std::map<std::uint32_t, Siblings> stripes_;
    Differences sum_{}, weight_{};
};

/// The variance of each level and, last, the total.
using Components = std::array<double, dispersion_levels + 1>;

/// A level without pairs is counted to the known one above it.
Components components(Differences differences, const std::array<bool, dispersion_levels>& known)
{
    Components found{};
    double below = 0;
    for (std::size_t l = dispersion_levels; l-- > 0;)
        if (known[l]) {
            found[l] = differences[l] - below;
            below = differences[l];
        }
    found[dispersion_levels] = differences[0];
    return found;
}

/// Fieller's set for a ratio: s with (a - s b)^2 <= t^2 Var(a - s b); unbounded where b may be 0.
Limits fieller(double a, double b, double aa, double ab, double bb, double t)
{
    const double t2 = t * t;
    const double square = b * b - t2 * bb, linear = a * b - t2 * ab, constant = a * a - t2 * aa;
    const double root = linear * linear - square * constant;
    if (!(square > 0) || !(root >= 0))
        return {};
    return {(linear - std::sqrt(root)) / square, (linear + std::sqrt(root)) / square};
}

/// The part of a set of shares that is possible: between 0 and 1. A set keeps its coverage when what cannot be true is
/// cut from it. It contains the estimate. Unbounded where the whole range is in it, or nothing of it: the share is not
/// determined.
Limits within(const Limits& set, double estimate)
{
    const bool none_differ = set.lower == 0 && set.upper == 0;
    if (!none_differ && (set.upper <= 0 || set.lower >= 1))
        return {};
    const Limits cut{std::min(std::clamp(set.lower, 0.0, 1.0), estimate),
                     std::max(std::clamp(set.upper, 0.0, 1.0), estimate)};
    return cut.lower <= 0 && cut.upper >= 1 ? Limits{} : cut;
}

/// The variances that are nearest to the estimates and none of which is negative: of half differences that do not
/// increase from a level to the next one below, the least over the levels above of the largest mean of a row of levels
/// (Ayer & others 1955, as in stripe_shares.cpp).
Components possible(const Differences& differences, const std::array<bool, dispersion_levels>& known)
{
    std::vector<std::size_t> levels;
    for (std::size_t l = 0; l < dispersion_levels; ++l)
        if (known[l])
            levels.push_back(l);
    Differences nearest{};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        double& least = nearest[levels[i]] = std::numeric_limits<double>::infinity();
        for (std::size_t from = 0; from <= i; ++from) {
            double sum = 0, most = 0;
            for (std::size_t to = from; to < levels.size(); ++to) {
                sum += std::max(differences[levels[to]], 0.0);
                if (to >= i)
                    most = std::max(most, sum / static_cast<double>(to - from + 1));
            }
            least = std::min(least, most);
        }
    }
    return components(nearest, known);
}

} // namespace

const char* to_string(DispersionLevel level)
{
    static const char* const names[dispersion_levels] = {"record", "imperfection", "contact", "chaos"};
    return names[static_cast<std::size_t>(level)];
}

DispersionShares dispersion_shares(std::span<const NestedRun> runs, double level)
{
    if (!(level > 0.5 && level < 1))
        throw InputError(fmt::format("dispersion: level = {} is outside (0.5, 1).", level));
    for (const NestedRun& run : runs)
        if (!std::isfinite(run.response))
            throw InputError(fmt::format("dispersion: a response of record {} is not finite.\n  Omit runs without a "
                                         "response, or count the limit states reached.",
                                         run.record));
    const Parts parts(runs);
    const std::size_t records = parts.records();
    const Differences differences = parts.differences(records);
    if (records < 2 || std::isnan(differences[0]))
        throw InputError("dispersion: no two records were run at the same stripe.\n  The record's share needs several "
                         "records.");
    std::array<bool, dispersion_levels> known{};
    for (std::size_t l = 0; l < dispersion_levels; ++l)
        known[l] = !std::isnan(differences[l]);

    DispersionShares shares;
    shares.records = records;
    const Components all = components(differences, known), nearest = possible(differences, known);
    shares.total = all[dispersion_levels];
    const bool any = nearest[dispersion_levels] > 0;

    // the jackknife's pseudo-values give covariances with the total
    const double n = static_cast<double>(records);
    std::vector<Components> pseudo(records);
    bool each = records >= least_records;
    for (std::size_t g = 0; g < records && each; ++g) {
        const Differences without = parts.differences(g);
        for (std::size_t l = 0; l < dispersion_levels; ++l)
            each = each && !(known[l] && std::isnan(without[l]));
        const Components rest = components(without, known);
        for (std::size_t c = 0; c < rest.size(); ++c)
            pseudo[g][c] = n * all[c] - (n - 1) * rest[c];
    }
    const auto covariance = [&](std::size_t a, std::size_t b) {
        double mean_a = 0, mean_b = 0, sum = 0;
        for (const Components& value : pseudo) {
            mean_a += value[a] / n;
            mean_b += value[b] / n;
        }
        for (const Components& value : pseudo)
            sum += (value[a] - mean_a) * (value[b] - mean_b);
        return sum / (n * (n - 1));
    };
    const double t = student_quantile((1 + level) / 2, n - 1);
    const double total_variance = each ? covariance(dispersion_levels, dispersion_levels) : 0;
    if (each)
        shares.total_limits = {shares.total - t * std::sqrt(total_variance),
                               shares.total + t * std::sqrt(total_variance)};
    for (std::size_t l = 0; l < dispersion_levels; ++l) {
        DispersionShare& share = shares.levels[l];
        share.known = known[l];
        share.variance = all[l];
        share.share = any ? nearest[l] / nearest[dispersion_levels] : std::nan("");
        if (!known[l]) {
            shares.says.push_back(fmt::format("No two runs differ only in {}: its share is part of the level above.",
                                              to_string(static_cast<DispersionLevel>(l))));
            continue;
        }
        if (!each)
            continue;
        const double own = covariance(l, l), with_total = covariance(l, dispersion_levels);
        share.variance_limits = {share.variance - t * std::sqrt(own), share.variance + t * std::sqrt(own)};
        if (any)
            share.share_limits = within(fieller(all[l], shares.total, own, with_total, total_variance, t), share.share);
    }
    if (!each)
        shares.says.push_back(fmt::format("{} records, or too few of them with runs at every level, are too few for "
                                          "intervals (at least {}).",
                                          records, least_records));
    if (!any)
        shares.says.push_back("All runs have the same response: there is no dispersion to divide.");
    return shares;
}

} // namespace stylobate
