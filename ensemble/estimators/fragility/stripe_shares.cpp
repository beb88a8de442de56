#include "ensemble/estimators/fragility/stripe_shares.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/record_share.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

/// Pooled adjacent violators: neighbours that decrease are given their common share (Ayer, Brunk, Ewing, Reid &
/// Silverman, "An empirical distribution function for sampling with incomplete information", Annals of Mathematical
/// Statistics 26 (1955) 641).
void make_monotone(std::vector<StripeShare>& stripes)
{
    struct Pool {
        double reached, trials;
        std::size_t stripes;
    };
    std::vector<Pool> pools;
    for (const StripeShare& stripe : stripes) {
        pools.push_back({stripe.reached, stripe.trials, 1});
        while (pools.size() > 1) {
            const Pool last = pools.back();
            Pool& before = pools[pools.size() - 2];
            if (before.reached * last.trials <= last.reached * before.trials)
                break;
            before = {before.reached + last.reached, before.trials + last.trials, before.stripes + last.stripes};
            pools.pop_back();
        }
    }
    std::size_t i = 0;
    for (const Pool& pool : pools)
        for (std::size_t k = 0; k < pool.stripes; ++k)
            stripes[i++].monotone = pool.reached / pool.trials;
}

} // namespace

StripeShares stripe_shares(const FragilityData& data, double level, std::uint64_t seed)
{
    if (data.measures != 1)
        throw InputError(fmt::format("fragility: shares by stripe need one intensity measure, not {}.", data.measures));
    const std::size_t stripes = data.points(), records = data.records;
    StripeShares found;
    found.level = level;
    found.stripes.resize(stripes);
    std::vector<std::vector<RecordCount>> counts(stripes);
    for (const FragilityRow& row : data.rows) {
        StripeShare& stripe = found.stripes[row.point];
        counts[row.point].push_back({row.trials, row.reached});
        stripe.records += 1;
        stripe.trials += row.trials;
        stripe.reached += row.reached;
    }
    // the influence of each record on each share
    Eigen::MatrixXd pull =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(records), static_cast<Eigen::Index>(stripes));
    for (std::size_t j = 0; j < stripes; ++j) {
        found.stripes[j].intensity = data.intensity[j];
        found.stripes[j].share = found.stripes[j].reached / found.stripes[j].trials;
    }
    for (const FragilityRow& row : data.rows)
        pull(row.record, row.point) =
            (row.reached - found.stripes[row.point].share * row.trials) / found.stripes[row.point].trials;
    for (std::size_t j = 0; j < stripes; ++j) {
        StripeShare& stripe = found.stripes[j];
        stripe.limits = record_share_limits(counts[j], level);
        stripe.band = record_share_limits(counts[j], 1 - (1 - level) / static_cast<double>(stripes));
    }
    for (std::size_t j = 1; j < stripes; ++j)
        found.stripes[j].band.lower = std::max(found.stripes[j].band.lower, found.stripes[j - 1].band.lower);
    for (std::size_t j = stripes; j-- > 1;)
        found.stripes[j - 1].band.upper = std::min(found.stripes[j - 1].band.upper, found.stripes[j].band.upper);
    make_monotone(found.stripes);

    // the largest decrease between two stripes, and its null distribution
    struct Fall {
        std::size_t from, to;
        double size;
        Eigen::VectorXd by_record; ///< in standard errors
    };
    std::vector<Fall> falls;
    for (std::size_t i = 0; i < stripes; ++i)
        for (std::size_t j = i + 1; j < stripes; ++j) {
            const Eigen::VectorXd by_record =
                pull.col(static_cast<Eigen::Index>(i)) - pull.col(static_cast<Eigen::Index>(j));
            const double error =
                std::sqrt(static_cast<double>(records) / std::max(1.0, static_cast<double>(records) - 1)) *
                by_record.norm();
            if (error > 1e-12)
                falls.push_back({i, j, (found.stripes[i].share - found.stripes[j].share) / error, by_record / error});
        }
    found.says = "The shares do not fall significantly with the intensity.";
    if (falls.empty())
        return found;
    const Fall largest =
        *std::max_element(falls.begin(), falls.end(), [](const Fall& a, const Fall& b) { return a.size < b.size; });
    constexpr std::uint64_t flips = 1999;
    int as_large = 1;
    Eigen::VectorXd sign(static_cast<Eigen::Index>(records));
    for (std::uint64_t flip = 0; flip < flips; ++flip) {
        for (Eigen::Index g = 0; g < sign.size(); ++g)
            sign[g] = random_bits(seed, flip, Stream::bootstrap, static_cast<std::uint64_t>(g)) >> 63 ? 1 : -1;
        as_large += std::any_of(falls.begin(), falls.end(),
                                [&](const Fall& fall) { return sign.dot(fall.by_record) >= largest.size; })
                        ? 1
                        : 0;
    }
    found.p_monotone = as_large / (flips + 1.0);
    if (found.p_monotone < 1 - level) {
        const StripeShare &from = found.stripes[largest.from], &to = found.stripes[largest.to];
        found.says =
            fmt::format("Stronger shaking was less damaging: from intensity {:.4g} to {:.4g} the share that "
                        "reached the limit state falls from {:.3f} [{:.3f}, {:.3f}] to {:.3f} [{:.3f}, {:.3f}] "
                        "(p = {:.2g}). A monotonic curve does not describe it.",
                        from.intensity, to.intensity, from.share, from.limits.lower, from.limits.upper, to.share,
                        to.limits.lower, to.limits.upper, found.p_monotone);
    }
    return found;
}

} // namespace stylobate
