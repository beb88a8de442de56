#include "ensemble/estimators/fragility/record_bootstrap.hpp"

#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

/// The quantile of the resamples; definition 6 keeps the nominal weight of the tails.
double of_resamples(const std::vector<double>& sorted, double p)
{
    return sorted_quantile(sorted, p, QuantileDefinition::weibull);
}

/// The limits of one target from the resamples.
struct Resampled {
    std::vector<double> value, studentized;
    std::size_t without_maximum = 0;
};

BootstrapLimits limits_of(Resampled& resampled, const FittedCurve& curve, const CurveTarget& target, double level)
{
    const boost::math::normal_distribution<double> normal;
    const double tail = (1 - level) / 2, z = quantile(complement(normal, tail));
    const double value = target.value(curve.fit.coefficients);
    const ParameterVector gradient = target.gradient(curve.fit.coefficients);
    BootstrapLimits limits;
    limits.without_maximum = resampled.without_maximum;
    std::sort(resampled.value.begin(), resampled.value.end());
    std::sort(resampled.studentized.begin(), resampled.studentized.end());
    limits.percentile = {of_resamples(resampled.value, tail), of_resamples(resampled.value, 1 - tail)};

    const double error = std::sqrt(gradient.dot(curve.covariance * gradient));
    limits.studentized = {value - error * of_resamples(resampled.studentized, 1 - tail),
                          value - error * of_resamples(resampled.studentized, tail)};

    const Eigen::VectorXd influence = record_influence(curve.link, curve.predictors, curve.data, curve.fit) * gradient;
    const double acceleration = influence.array().cube().sum() / (6 * std::pow(influence.squaredNorm(), 1.5));
    const double n = static_cast<double>(resampled.value.size());
    const auto below = std::lower_bound(resampled.value.begin(), resampled.value.end(), value);
    const double share = (static_cast<double>(below - resampled.value.begin()) + 0.5) / (n + 1);
    const double bias = quantile(normal, share);
    const auto corrected = [&](double quantile_z) {
        const double moved = bias + quantile_z;
        return of_resamples(resampled.value, cdf(normal, bias + moved / (1 - acceleration * moved)));
    };
    limits.accelerated = {corrected(-z), corrected(z)};
    return limits;
}

} // namespace

std::vector<BootstrapLimits> bootstrap_limits(const FittedCurve& curve, std::span<const CurveTarget> targets,
                                              double level, std::size_t resamples, std::uint64_t seed)
{
    if (curve.fit.maximum != Maximum::inside)
        return std::vector<BootstrapLimits>(targets.size());
    const std::size_t records = curve.data.records;
    std::vector<Resampled> resampled(targets.size());
    Eigen::VectorXd weight(static_cast<Eigen::Index>(records));
    for (std::size_t i = 0; i < resamples; ++i) {
        weight.setZero();
        for (std::size_t draw = 0; draw < records; ++draw)
            weight[static_cast<Eigen::Index>(uniform01(seed, i, Stream::bootstrap, draw) *
                                             static_cast<double>(records))] += 1;
        const BinomialCounts counts = counts_of(curve.data, weight);
        const BinomialFit fit = fit_binomial(curve.link, curve.predictors, counts, {}, curve.fit.coefficients);
        const bool inside = fit.maximum == Maximum::inside;
        const ParameterMatrix covariance =
            inside ? record_covariance(curve.link, curve.predictors, curve.data, fit, weight) : ParameterMatrix();
        for (std::size_t t = 0; t < targets.size(); ++t) {
            if (!inside) {
                // its side is unknown, and it must not make the interval narrower: one on each side
                const double far = resampled[t].without_maximum++ % 2 == 0 ? std::numeric_limits<double>::infinity()
                                                                           : -std::numeric_limits<double>::infinity();
                resampled[t].value.push_back(far);
                resampled[t].studentized.push_back(far);
                continue;
            }
            const double value = targets[t].value(fit.coefficients);
            const ParameterVector gradient = targets[t].gradient(fit.coefficients);
            const double error = std::sqrt(gradient.dot(covariance * gradient));
            const double wanted = targets[t].value(curve.fit.coefficients);
            resampled[t].value.push_back(value);
            resampled[t].studentized.push_back((value - wanted) / error);
        }
    }
    std::vector<BootstrapLimits> limits;
    for (std::size_t t = 0; t < targets.size(); ++t)
        limits.push_back(limits_of(resampled[t], curve, targets[t], level));
    return limits;
}

} // namespace stylobate
