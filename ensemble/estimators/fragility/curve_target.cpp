#include "ensemble/estimators/fragility/curve_target.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// (parameters x (parameters - 1)) an orthonormal basis of what is normal to a vector: columns of a reflection.
Eigen::MatrixXd null_space(const ParameterVector& normal)
{
    const Eigen::Index n = normal.size();
    ParameterVector v = normal.normalized();
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    // the reflection that takes v to the axis on which it is largest
    ParameterVector mirror = v;
    mirror[largest] += v[largest] < 0 ? -1 : 1;
    const ParameterMatrix reflection =
        ParameterMatrix::Identity(n, n) - 2 / mirror.squaredNorm() * mirror * mirror.transpose();
    Eigen::MatrixXd basis(n, n - 1);
    for (Eigen::Index j = 0, column = 0; j < n; ++j)
        if (j != largest)
            basis.col(column++) = reflection.col(j);
    return basis;
}

/// The profile likelihood of a target.
class Profile {
public:
    Profile(const FittedCurve& curve, const CurveTarget& target) : curve_(curve), target_(target) {}

    /// Where the deviance from the maximum passes `threshold`, on the side of `sign`; infinite where it never does.
    double limit(double from, double reach, double sign, double threshold)
    {
        const auto above = [&](double value) { return profile_deviance(curve_, target_, value) - threshold; };
        double inside = from, outside = from + sign * reach, at_inside = -threshold, at_outside = above(outside);
        for (int doubling = 0; at_outside < 0; ++doubling) {
            if (doubling == 20)
                return sign * infinity;
            inside = outside;
            at_inside = at_outside;
            outside = from + (outside - from) * 2;
            at_outside = above(outside);
        }
        // regula falsi on the root of the deviance, which is nearly linear, with the Illinois weights (Dowell &
        // Jarratt, "A modified regula falsi method for computing the root of an equation", BIT 11 (1971) 168)
        double weight_inside = std::sqrt(std::max(0.0, at_inside + threshold)) - std::sqrt(threshold);
        double weight_outside = std::sqrt(at_outside + threshold) - std::sqrt(threshold);
        int side = 0;
        for (int i = 0; i < 60 && std::abs(outside - inside) > 1e-9 * (1 + std::abs(inside)); ++i) {
            const double middle =
                (inside * weight_outside - outside * weight_inside) / (weight_outside - weight_inside);
            const double there = std::sqrt(std::max(0.0, above(middle) + threshold)) - std::sqrt(threshold);
            if (std::abs(there) < 1e-9)
                return middle;
            if (there < 0) {
                inside = middle;
                weight_inside = there;
                weight_outside = side == -1 ? weight_outside / 2 : weight_outside;
                side = -1;
            } else {
                outside = middle;
                weight_outside = there;
                weight_inside = side == 1 ? weight_inside / 2 : weight_inside;
                side = 1;
            }
        }
        return (inside + outside) / 2;
    }

private:
    const FittedCurve& curve_;
    const CurveTarget& target_;
};

/// Of both tails.
double student_reach(double freedom, double level)
{
    return student_quantile((1 + level) / 2, freedom);
}

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

double CurveTarget::value(const ParameterVector& coefficients) const
{
    return kind_ == Kind::log_median ? -coefficients[0] / coefficients[1] : weights_.dot(coefficients);
}

ParameterVector CurveTarget::gradient(const ParameterVector& coefficients) const
{
    if (kind_ == Kind::sum)
        return weights_;
    return (ParameterVector(2) << -1 / coefficients[1], coefficients[0] / (coefficients[1] * coefficients[1]))
        .finished();
}

CurveTarget::Plane CurveTarget::plane(double value) const
{
    if (kind_ == Kind::sum)
        return {weights_, value};
    return {(ParameterVector(2) << 1, value).finished(), 0};
}

double profile_deviance(const FittedCurve& curve, const CurveTarget& target, double value)
{
    const CurveTarget::Plane plane = target.plane(value);
    const ParameterVector on = plane.normal * (plane.distance / plane.normal.squaredNorm());
    const Eigen::MatrixXd columns = curve.predictors * null_space(plane.normal);
    const BinomialFit fit = fit_binomial(curve.link, columns, curve.counts, curve.predictors * on);
    return 2 * (curve.fit.log_likelihood - fit.log_likelihood);
}

namespace {

/// Where the profile deviance passes a threshold, on both sides.
Limits limits_at(const FittedCurve& curve, const CurveTarget& target, double threshold)
{
    if (curve.fit.maximum != Maximum::inside || !std::isfinite(threshold))
        return {};
    const ParameterVector gradient = target.gradient(curve.fit.coefficients);
    const double error = std::sqrt(gradient.dot(Eigen::LDLT<ParameterMatrix>(curve.fit.information).solve(gradient)));
    const double value = target.value(curve.fit.coefficients);
    Profile profile(curve, target);
    return {profile.limit(value, std::sqrt(threshold) * error, -1, threshold),
            profile.limit(value, std::sqrt(threshold) * error, 1, threshold)};
}

} // namespace

FittedCurve fitted_curve(FragilityData data, Eigen::MatrixXd predictors, Link link)
{
    FittedCurve curve{link, std::move(data), std::move(predictors), {}, {}, {}};
    curve.counts = counts_of(curve.data);
    curve.fit = fit_binomial(link, curve.predictors, curve.counts);
    if (curve.fit.maximum == Maximum::inside)
        curve.covariance = record_covariance(link, curve.predictors, curve.data, curve.fit);
    return curve;
}

RecordSpread record_spread(const FittedCurve& curve, const CurveTarget& target)
{
    assert(curve.fit.maximum == Maximum::inside);
    const ParameterVector gradient = target.gradient(curve.fit.coefficients);
    const ParameterVector pull = Eigen::LDLT<ParameterMatrix>(curve.fit.information).solve(gradient);
    const Eigen::VectorXd along = curve.predictors * pull, eta = curve.predictors * curve.fit.coefficients;
    double sum = 0, squares = 0;
    for (std::size_t g = 0; g < curve.data.records; ++g) {
        double share = 0;
        for (const FragilityRow& row : curve.data.of_record(g)) {
            const LinkValue at = link_at(curve.link, std::clamp(eta[row.point], -36.0, 36.0));
            share += row.trials * at.density * at.density / (at.below * at.above) * along[row.point] * along[row.point];
        }
        sum += share;
        squares += share * share;
    }
    RecordSpread spread;
    spread.variance = gradient.dot(curve.covariance * gradient);
    spread.freedom = std::max(1.0, sum * sum / squares - 1);
    spread.inflation = spread.variance / gradient.dot(pull);
    return spread;
}

Limits profile_limits(const FittedCurve& curve, const CurveTarget& target, double level)
{
    const double threshold = quantile(boost::math::chi_squared_distribution<double>(1), level);
    return limits_at(curve, target, threshold);
}

Limits record_limits(const FittedCurve& curve, const CurveTarget& target, double level)
{
    if (curve.fit.maximum != Maximum::inside)
        return {};
    const RecordSpread spread = record_spread(curve, target);
    const double threshold = spread.inflation * std::pow(student_reach(spread.freedom, level), 2);
    return limits_at(curve, target, threshold);
}

Jackknife jackknife(const FittedCurve& curve)
{
    Jackknife found;
    if (curve.fit.maximum != Maximum::inside)
        return found;
    BinomialCounts rest = curve.counts;
    for (std::size_t g = 0; g < curve.data.records; ++g) {
        for (const FragilityRow& row : curve.data.of_record(g)) {
            rest.trials[row.point] -= row.trials;
            rest.reached[row.point] -= row.reached;
        }
        const BinomialFit fit = fit_binomial(curve.link, curve.predictors, rest, {}, curve.fit.coefficients);
        if (fit.maximum != Maximum::inside)
            return {};
        found.coefficients.push_back(fit.coefficients);
        for (const FragilityRow& row : curve.data.of_record(g)) {
            rest.trials[row.point] = curve.counts.trials[row.point];
            rest.reached[row.point] = curve.counts.reached[row.point];
        }
    }
    return found;
}

Limits jackknife_limits(const FittedCurve& curve, const Jackknife& without, const CurveTarget& target, double level)
{
    if (without.coefficients.size() < 2)
        return {};
    const double n = static_cast<double>(without.coefficients.size());
    double mean = 0, square = 0;
    for (const ParameterVector& coefficients : without.coefficients)
        mean += target.value(coefficients) / n;
    for (const ParameterVector& coefficients : without.coefficients)
        square += std::pow(target.value(coefficients) - mean, 2);
    if (!(square > 1e-20 * mean * mean)) // equal records
        return {};
    const double value = target.value(curve.fit.coefficients), unbiased = n * value - (n - 1) * mean;
    const double reach = student_reach(record_spread(curve, target).freedom, level) * std::sqrt((n - 1) / n * square);
    // an estimate is never outside its own interval
    return {std::min(value, unbiased - reach), std::max(value, unbiased + reach)};
}

Limits wald_limits(const FittedCurve& curve, const CurveTarget& target, double level)
{
    if (curve.fit.maximum != Maximum::inside)
        return {};
    const RecordSpread spread = record_spread(curve, target);
    const double value = target.value(curve.fit.coefficients);
    const double reach = student_reach(spread.freedom, level) * std::sqrt(spread.variance);
    return {value - reach, value + reach};
}

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
