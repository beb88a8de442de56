#include "ensemble/estimators/fragility/stripe_shares.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/random.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

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

/// The decrease between two stripes.
struct Fall {
    std::size_t from, to;
    double size;               ///< in standard errors
    Eigen::VectorXd by_record; ///< in standard errors
};

/// (records x stripes) the influence of each record on each share.
Eigen::MatrixXd influence(const FragilityData& data, const std::vector<StripeShare>& stripes)
{
    Eigen::MatrixXd pull =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(data.records), static_cast<Eigen::Index>(stripes.size()));
    for (const FragilityRow& row : data.rows)
        pull(row.record, row.point) = (row.reached - stripes[row.point].share * row.trials) / stripes[row.point].trials;
    return pull;
}

/// Of every stripe to every stronger one, where the records make it uncertain.
std::vector<Fall> falls_of(const FragilityData& data, const std::vector<StripeShare>& stripes)
{
    const Eigen::MatrixXd pull = influence(data, stripes);
    const std::size_t records = data.records;
    std::vector<Fall> falls;
    for (std::size_t i = 0; i < stripes.size(); ++i)
        for (std::size_t j = i + 1; j < stripes.size(); ++j) {
            const Eigen::VectorXd by_record =
                pull.col(static_cast<Eigen::Index>(i)) - pull.col(static_cast<Eigen::Index>(j));
            const double error =
                std::sqrt(static_cast<double>(records) / std::max(1.0, static_cast<double>(records) - 1)) *
                by_record.norm();
            if (error > 1e-12)
                falls.push_back({i, j, (stripes[i].share - stripes[j].share) / error, by_record / error});
        }
    return falls;
}

/// The share of random signs of the records under which some decrease is as large as the largest one seen.
double p_of_largest(const std::vector<Fall>& falls, const Fall& largest, std::uint64_t seed)
{
    constexpr std::uint64_t flips = 1999;
    int as_large = 1;
    Eigen::VectorXd sign(largest.by_record.size());
    for (std::uint64_t flip = 0; flip < flips; ++flip) {
        for (Eigen::Index g = 0; g < sign.size(); ++g)
            sign[g] = random_bits(seed, flip, Stream::bootstrap, static_cast<std::uint64_t>(g)) >> 63 ? 1 : -1;
        as_large += std::any_of(falls.begin(), falls.end(),
                                [&](const Fall& fall) { return sign.dot(fall.by_record) >= largest.size; })
                        ? 1
                        : 0;
    }
    return as_large / (flips + 1.0);
}

/// Limits of each share, and the band that holds all of them.
void set_limits(const std::vector<std::vector<RecordCount>>& counts, double level, std::vector<StripeShare>& stripes)
{
    for (std::size_t j = 0; j < stripes.size(); ++j) {
        stripes[j].limits = record_share_limits(counts[j], level);
        stripes[j].band = record_share_limits(counts[j], 1 - (1 - level) / static_cast<double>(stripes.size()));
    }
    // below the first damage a probability is no greater than that of stronger shaking; above the last survival it is
    // no smaller than that of weaker shaking
    for (std::size_t j = stripes.size(); j-- > 1;)
        if (stripes[j - 1].monotone == 0)
            stripes[j - 1].limits.upper = std::min(stripes[j - 1].limits.upper, stripes[j].limits.upper);
    for (std::size_t j = 1; j < stripes.size(); ++j)
        if (stripes[j].monotone == 1)
            stripes[j].limits.lower = std::max(stripes[j].limits.lower, stripes[j - 1].limits.lower);
    for (std::size_t j = 1; j < stripes.size(); ++j)
        stripes[j].band.lower = std::max(stripes[j].band.lower, stripes[j - 1].band.lower);
    for (std::size_t j = stripes.size(); j-- > 1;)
        stripes[j - 1].band.upper = std::min(stripes[j - 1].band.upper, stripes[j].band.upper);
}

} // namespace

StripeShares stripe_shares(const FragilityData& data, double level, std::uint64_t seed)
{
    if (data.measures != 1)
        throw InputError(fmt::format("fragility: shares by stripe need one intensity measure, not {}.", data.measures));
    StripeShares found;
    found.level = level;
    found.stripes.resize(data.points());
    std::vector<std::vector<RecordCount>> counts(data.points());
    for (const FragilityRow& row : data.rows) {
        StripeShare& stripe = found.stripes[row.point];
        counts[row.point].push_back({row.trials, row.reached});
        stripe.records += 1;
        stripe.trials += row.trials;
        stripe.reached += row.reached;
    }
    for (std::size_t j = 0; j < found.stripes.size(); ++j) {
        found.stripes[j].intensity = data.intensity[j];
        found.stripes[j].share = found.stripes[j].reached / found.stripes[j].trials;
    }
    make_monotone(found.stripes);
    set_limits(counts, level, found.stripes);

    found.says = "The shares do not fall significantly with the intensity.";
    const std::vector<Fall> falls = falls_of(data, found.stripes);
    if (falls.empty())
        return found;
    const Fall& largest =
        *std::max_element(falls.begin(), falls.end(), [](const Fall& a, const Fall& b) { return a.size < b.size; });
    found.p_monotone = p_of_largest(falls, largest, seed);
    if (found.p_monotone < 1 - level) {
        const StripeShare &from = found.stripes[largest.from], &to = found.stripes[largest.to];
        found.says =
            fmt::format("Stronger shaking was less damaging: from intensity {:.4g} to {:.4g} the share that "
                        "reached the limit state falls from {:.3f} ({:.3f} to {:.3f}) to {:.3f} ({:.3f} to {:.3f}), "
                        "p = {:.2g}. A monotonic curve does not describe it.",
                        from.intensity, to.intensity, from.share, from.limits.lower, from.limits.upper, to.share,
                        to.limits.lower, to.limits.upper, found.p_monotone);
    }
    return found;
}

namespace {

/// A weighted sum of independent exponential numbers, a_1 E_1 + a_2 E_2 + ...
class ExponentialSum {
public:
    void add(double factor, double times)
    {
        terms_.push_back({factor, times});
        greatest_ = std::max(greatest_, factor);
    }

    /// P(sum > 0), the inverse Laplace integral of M(s) / s with M(s) = product of 1 / (1 - a s). The path passes
    /// through the saddle point, where the integrand neither oscillates nor cancels; with t = scale sinh(x) it decays
    /// exponentially, so that the trapezoidal rule (Trefethen & Weideman, "The exponentially convergent trapezoidal
    /// rule", SIAM Review 56 (2014) 385) errs by less than 1e-7 with up to 400 records. Own derivation.
    double above_zero() const
    {
        if (!(greatest_ > 0))
            return 0;
        const double saddle = saddle_point();
        const auto log_integrand = [&](std::complex<double> s) {
            std::complex<double> sum = -std::log(s);
            for (const Term& term : terms_)
                sum -= term.times * std::log(1.0 - term.factor * s);
            return sum;
        };
        const double peak = log_integrand(saddle).real(), scale = 1 / std::sqrt(curvature(saddle));
        constexpr double step = 0.1;
        double sum = scale / 2; // at x = 0
        for (int i = 1; i < 1000; ++i) {
            const double x = step * i;
            const std::complex<double> term =
                std::exp(log_integrand({saddle, scale * std::sinh(x)}) - peak) * (scale * std::cosh(x));
            sum += term.real();
            if (std::abs(term) < 1e-11 * sum)
                break;
        }
        return sum * step * std::exp(peak) / std::numbers::pi;
    }

private:
    struct Term {
        double factor, times;
    };

    /// Where -log M(s) s is stationary between 0 and the nearest pole on its right.
    double saddle_point() const
    {
        double low = 0, high = 1 / greatest_;
        for (int i = 0; i < 20; ++i) { // near it is good enough
            const double s = (low + high) / 2;
            double slope = -1 / s;
            for (const Term& term : terms_)
                slope += term.times * term.factor / (1 - term.factor * s);
            (slope > 0 ? high : low) = s;
        }
        return (low + high) / 2;
    }

    double curvature(double s) const
    {
        double sum = 1 / (s * s);
        for (const Term& term : terms_)
            sum += term.times * std::pow(term.factor / (1 - term.factor * s), 2);
        return sum;
    }

    std::vector<Term> terms_;
    double greatest_ = 0;
};

/// Equal records once, with their number.
using Counted = std::map<std::pair<double, double>, double>;

double upper_limit(const Counted& records, double level)
{
    double trials = 0, reached = 0, number = 0;
    for (const auto& [record, times] : records) {
        trials += times * record.first;
        reached += times * record.second;
        number += times;
    }
    if (!(reached < trials * (1 - 1e-9))) // all of them, with the rounding of sums of weights
        return 1;
    const double tail = (1 - level) / 2;
    const auto above = [&](double share) {
        ExponentialSum sum;
        sum.add(trials / number * (1 - share), 1);
        for (const auto& [record, times] : records)
            sum.add(record.second - share * record.first, times);
        return sum.above_zero() - tail;
    };
    // at the share itself the probability of a sum above 0 is far from the tail of any level
    std::uintmax_t most = 100;
    const auto [low, high] = boost::math::tools::toms748_solve(above, reached / trials * (1 - 1e-12) + 1e-12, 1 - 1e-12,
                                                               boost::math::tools::eps_tolerance<double>(32), most);
    return (low + high) / 2;
}

} // namespace

Limits record_share_limits(std::span<const RecordCount> records, double level)
{
    Counted reached, missed;
    for (const RecordCount& record : records)
        if (record.trials > 0) {
            reached[{record.trials, record.reached}] += 1;
            missed[{record.trials, record.trials - record.reached}] += 1;
        }
    if (reached.empty())
        return {0, 1};
    return {1 - upper_limit(missed, level), upper_limit(reached, level)};
}

} // namespace stylobate
