#include "ensemble/estimators/fragility/fragility_curve.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/model/input_error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <boost/math/distributions/fisher_f.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// The probability from a target that is a linear predictor.
Limits probabilities(Link link, Limits eta)
{
    return {std::isinf(eta.lower) ? 0 : link_at(link, eta.lower).below,
            std::isinf(eta.upper) ? 1 : link_at(link, eta.upper).below};
}

Limits exponentials(Limits limits)
{
    return {std::exp(limits.lower), std::exp(limits.upper)};
}

/// 1 / slope; a slope that may be zero or negative bounds no dispersion.
Limits inverses(Limits slope)
{
    return {slope.upper > 0 ? 1 / slope.upper : 0,
            slope.lower > 0 ? 1 / slope.lower : std::numeric_limits<double>::infinity()};
}

template <class Change>
CurveEstimate changed(const CurveEstimate& estimate, double value, Change&& change)
{
    return {value, change(estimate.records), change(estimate.profile_records), change(estimate.profile_runs),
            change(estimate.bootstrap)};
}

CurveEstimate same_everywhere(double value, Limits limits)
{
    return {value, limits, limits, limits, limits};
}

/// Bounds for any non-decreasing curve, from intensities at which nothing or everything reached the limit state, each
/// record counted once: the exact binomial limits of Clopper & Pearson, "The use of confidence or fiducial limits
/// illustrated in the case of the binomial", Biometrika 26 (1934) 404, extended by monotonicity (own derivation).
class BoundsWithoutCurve {
public:
    BoundsWithoutCurve(const FragilityData& data, double level)
    {
        const BinomialCounts counts = counts_of(data);
        std::vector<double> records(data.points(), 0.0);
        for (const FragilityRow& row : data.rows)
            records[row.point] += 1;
        for (std::size_t i = 0; i < data.points(); ++i) {
            const auto point = static_cast<Eigen::Index>(i);
            const double miss = std::pow((1 - level) / 2, 1 / records[i]);
            if (counts.reached[point] == 0)
                none_.push_back({data.intensity[i], 1 - miss});
            else if (counts.reached[point] == counts.trials[point])
                all_.push_back({data.intensity[i], miss});
        }
    }

    Limits probability(double intensity) const
    {
        Limits limits{0, 1};
        for (const auto& [at, bound] : none_)
            if (at >= intensity)
                limits.upper = std::min(limits.upper, bound);
        for (const auto& [at, bound] : all_)
            if (at <= intensity)
                limits.lower = std::max(limits.lower, bound);
        return limits;
    }

    /// Whether weaker shaking did more than stronger shaking, which no non-decreasing curve does.
    bool contradictory() const
    {
        for (const auto& [low, lower] : all_)
            for (const auto& [high, upper] : none_)
                if (low < high && lower > upper)
                    return true;
        return false;
    }

    Limits median() const
    {
        Limits limits{0, std::numeric_limits<double>::infinity()};
        for (const auto& [at, bound] : none_)
            if (bound < 0.5)
                limits.lower = std::max(limits.lower, at);
        for (const auto& [at, bound] : all_)
            if (bound > 0.5)
                limits.upper = std::min(limits.upper, at);
        return limits;
    }

    /// A curve of the given form is at least so steep between what reached nothing and what reached everything.
    Limits dispersion(Link link) const
    {
        Limits limits{0, std::numeric_limits<double>::infinity()};
        for (const auto& [low, upper] : none_)
            for (const auto& [high, lower] : all_)
                if (low < high && upper < lower)
                    limits.upper = std::min(
                        limits.upper, std::log(high / low) / (link_quantile(link, lower) - link_quantile(link, upper)));
        return limits;
    }

private:
    struct Bound {
        double intensity, probability;
    };
    std::vector<Bound> none_, all_;
};

void check(const FragilityData& data, const CurveOptions& options)
{
    if (!(options.level > 0.5 && options.level < 1))
        throw InputError(fmt::format("fragility: level = {} is outside (0.5, 1).", options.level));
    for (const auto& intensity : options.at)
        if (intensity.size() != data.measures ||
            std::any_of(intensity.begin(), intensity.end(), [](double im) { return !(im > 0); }))
            throw InputError(
                fmt::format("fragility: a probability is requested at an intensity that is not {} numbers above 0.",
                            data.measures));
    if (data.points() < data.measures + 1)
        throw InputError(fmt::format("fragility: {} different intensities are too few for {} coefficients.\n  Run "
                                     "more intensities.",
                                     data.points(), data.measures + 1));
}

/// "1 record", "8 records".
std::string counted(double count, const std::string& what)
{
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void no_curve(FragilityCurve& curve, const FragilityData& data, const CurveOptions& options)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    curve.coefficients.assign(1 + data.measures, same_everywhere(nan, {}));
    curve.median = curve.dispersion = same_everywhere(nan, {0, std::numeric_limits<double>::infinity()});
    for (const auto& intensity : options.at)
        curve.at.push_back({intensity, same_everywhere(nan, {0, 1})});
    if (data.measures == 1) {
        const BoundsWithoutCurve bounds(data, options.level);
        if (bounds.contradictory()) {
            curve.says.emplace_back("Weaker shaking reached the limit state where stronger shaking did not: there is "
                                    "no curve that rises, no median and no dispersion.");
            return;
        }
        curve.median = same_everywhere(nan, bounds.median());
        curve.dispersion = same_everywhere(nan, bounds.dispersion(options.link));
        for (CurvePoint& point : curve.at)
            point.probability = same_everywhere(nan, bounds.probability(point.intensity[0]));
    }
    const auto median = median_text(curve.median.records);
    const std::string where =
        median ? "The median lies " + *median + "." : "Only bounds of the probabilities can be given.";
    const std::string runs =
        counted(curve.trials, "run") + " of " + counted(static_cast<double>(curve.records), "record");
    if (curve.maximum == Maximum::none)
        curve.says.push_back(fmt::format(
            "None of {} reached the limit state: there is no curve. {} Increase the intensities.", runs, where));
    else if (curve.maximum == Maximum::all)
        curve.says.push_back(
            fmt::format("All {} reached the limit state: there is no curve. {} Reduce the intensities.", runs, where));
    else
        curve.says.push_back("The stripes separate: one intensity divides all runs that reached the limit state from "
                             "all that did not. The likelihood has no maximum, so there is no curve. " +
                             where + " Run more intensities between them.");
}

/// What a reader must know of a fitted curve: that it falls, that it has no intervals and why, that they may be too
/// short.
void remark(FragilityCurve& curve, bool falls, const Jackknife& without, const CurveEstimate& level)
{
    if (falls)
        curve.says.push_back("The share that reaches the limit state does not grow with the intensity: there is no "
                             "median and no dispersion.");
    if (curve.records >= least_records && without.coefficients.empty())
        curve.says.push_back("The curve depends on one record: without it, the likelihood is unbounded. There is no "
                             "interval; add records or intensities.");
    if (!without.coefficients.empty() && std::isinf(level.records.upper))
        curve.says.emplace_back("All records have the same outcomes: their scatter is not known, and there is no "
                                "interval. Are they the same motion?");
    if (curve.records < least_records)
        curve.says.push_back(fmt::format("{} {} too few for an interval (at least {}): this curve has none and must "
                                         "not be used alone.",
                                         counted(static_cast<double>(curve.records), "record"),
                                         curve.records == 1 ? "is" : "are", least_records));
    else if (curve.records < enough_records)
        curve.says.push_back(
            fmt::format("With {} records, fewer than {}, the coverage of the intervals may be below the nominal level.",
                        curve.records, enough_records));
}

} // namespace

std::optional<std::string> median_text(const Limits& median, double scale)
{
    const double lower = scale * median.lower, upper = scale * median.upper;
    if (lower > 0)
        return std::isfinite(upper) ? fmt::format("between {:.4g} and {:.4g}", lower, upper)
                                    : fmt::format("above {:.4g}", lower);
    return std::isfinite(upper) ? std::optional(fmt::format("below {:.4g}", upper)) : std::nullopt;
}

FragilityCurve fragility_curve(const FragilityData& data, const CurveOptions& options)
{
    check(data, options);
    FragilityCurve curve;
    curve.link = options.link;
    curve.level = options.level;
    curve.records = data.records;
    const FittedCurve fitted = fitted_curve(data, log_predictors(data), options.link);
    curve.trials = fitted.counts.trials.sum();
    curve.reached = fitted.counts.reached.sum();
    curve.maximum = fitted.fit.maximum;
    curve.log_likelihood = fitted.fit.log_likelihood;
    if (curve.maximum != Maximum::inside) {
        no_curve(curve, data, options);
        return curve;
    }

    const auto parameters = static_cast<Eigen::Index>(1 + data.measures);
    std::vector<CurveTarget> targets;
    for (Eigen::Index j = 0; j < parameters; ++j)
        targets.push_back(CurveTarget::sum(ParameterVector::Unit(parameters, j)));
    for (const auto& intensity : options.at) {
        ParameterVector at = ParameterVector::Ones(parameters);
        for (Eigen::Index j = 1; j < parameters; ++j)
            at[j] = std::log(intensity[static_cast<std::size_t>(j - 1)]);
        targets.push_back(CurveTarget::sum(at));
    }
    const bool falls = data.measures == 1 && fitted.fit.coefficients[1] <= 0;
    if (data.measures == 1 && !falls)
        targets.push_back(CurveTarget::log_median());

    const bool intervals = data.records >= least_records;
    std::vector<BootstrapLimits> resampled(targets.size());
    if (intervals && options.resamples > 0)
        resampled = bootstrap_limits(fitted, targets, options.level, options.resamples, options.seed);
    const Jackknife without = intervals ? jackknife(fitted) : Jackknife{};
    std::vector<CurveEstimate> estimates;
    for (std::size_t t = 0; t < targets.size(); ++t) {
        CurveEstimate estimate;
        estimate.value = targets[t].value(fitted.fit.coefficients);
        if (intervals)
            estimate = {estimate.value, jackknife_limits(fitted, without, targets[t], options.level),
                        record_limits(fitted, targets[t], options.level),
                        profile_limits(fitted, targets[t], options.level), resampled[t].studentized};
        estimates.push_back(estimate);
    }
    curve.coefficients.assign(estimates.begin(), estimates.begin() + parameters);
    for (std::size_t i = 0; i < options.at.size(); ++i) {
        const CurveEstimate& eta = estimates[static_cast<std::size_t>(parameters) + i];
        curve.at.push_back({options.at[i], changed(eta, link_at(options.link, eta.value).below, [&](Limits limits) {
                                return probabilities(options.link, limits);
                            })});
    }
    if (data.measures == 1 && !falls) {
        curve.median = changed(estimates.back(), std::exp(estimates.back().value), exponentials);
        curve.dispersion = changed(estimates[1], 1 / estimates[1].value, inverses);
        if (std::isfinite(estimates[1].records.lower) && !(estimates[1].records.lower > 0)) {
            curve.median = same_everywhere(curve.median.value, {0, std::numeric_limits<double>::infinity()});
            curve.says.emplace_back("The share that reaches the limit state does not grow significantly with the "
                                    "intensity: the median has no interval.");
        }
    } else {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        curve.median = curve.dispersion = same_everywhere(nan, {0, std::numeric_limits<double>::infinity()});
        if (falls)
            for (CurvePoint& point : curve.at)
                point.probability = same_everywhere(nan, {0, 1});
    }

    remark(curve, falls, without, estimates.front());
    return curve;
}

namespace {

/// (points x terms) powers beyond the first of each predictor, orthonormal for the trials to all terms before.
Eigen::MatrixXd bending_terms(const FittedCurve& curve)
{
    const Eigen::Index points = curve.predictors.rows(), parameters = curve.predictors.cols();
    Eigen::MatrixXd all = curve.predictors;
    const auto append = [&](const Eigen::VectorXd& column) {
        all.conservativeResize(Eigen::NoChange, all.cols() + 1);
        all.col(all.cols() - 1) = column;
    };
    if (parameters == 2) {
        // from the middle of the data, so that powers stay apart
        const Eigen::ArrayXd x = curve.predictors.col(1).array();
        const Eigen::ArrayXd centred = (x - (x * curve.counts.trials.array()).sum() / curve.counts.trials.sum());
        const Eigen::ArrayXd u = centred / centred.abs().maxCoeff();
        for (Eigen::Index power = 2; power <= std::min<Eigen::Index>(4, points - 1); ++power)
            append(u.pow(static_cast<double>(power)).matrix());
    } else
        for (Eigen::Index j = 1; j < parameters; ++j)
            append(curve.predictors.col(j).array().square().matrix());
    const Eigen::VectorXd root = curve.counts.trials.cwiseSqrt();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * all);
    const Eigen::MatrixXd thin = qr.householderQ() * Eigen::MatrixXd::Identity(points, std::min(points, all.cols()));
    Eigen::MatrixXd terms = root.cwiseInverse().asDiagonal() * thin.rightCols(thin.cols() - parameters);
    return terms;
}

} // namespace

LackOfFit lack_of_fit(const FittedCurve& curve, double significance)
{
    LackOfFit found;
    const auto records = static_cast<Eigen::Index>(curve.data.records);
    const char* const form = curve.link == Link::probit && curve.predictors.cols() == 2 ? "lognormal curve"
                             : curve.link == Link::probit                               ? "probit surface"
                                                                                        : "logistic form";
    if (curve.fit.maximum != Maximum::inside || curve.predictors.rows() <= curve.predictors.cols()) {
        found.says = fmt::format(
            "The fit of the {} cannot be tested: there is no curve, or no more intensities than coefficients.", form);
        return found;
    }
    const Eigen::MatrixXd bends = bending_terms(curve);
    const Eigen::Index terms = bends.cols();
    if (records < terms + 5) {
        found.says = fmt::format("The fit of the {} cannot be tested with {} records.", form, records);
        return found;
    }
    // efficient scores: the scores of the additional terms, orthogonal to the fitted coefficients
    const Eigen::VectorXd eta = curve.predictors * curve.fit.coefficients;
    Eigen::VectorXd rate(eta.size()), weight(eta.size());
    Eigen::VectorXd below(eta.size());
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
        const LinkValue at = link_at(curve.link, std::clamp(eta[i], -36.0, 36.0));
        below[i] = at.below;
        rate[i] = at.density / (at.below * at.above);
        weight[i] = curve.counts.trials[i] * at.density * rate[i];
    }
    const Eigen::MatrixXd weighted = weight.asDiagonal() * curve.predictors;
    const Eigen::MatrixXd fitted_part =
        (curve.predictors.transpose() * weighted).ldlt().solve(weighted.transpose() * bends);
    const Eigen::MatrixXd efficient = bends - curve.predictors * fitted_part;
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(records, terms);
    for (Eigen::Index g = 0; g < records; ++g)
        for (const FragilityRow& row : curve.data.of_record(static_cast<std::size_t>(g)))
            scores.row(g) += (row.reached - row.trials * below[row.point]) * rate[row.point] * efficient.row(row.point);

    const double n = static_cast<double>(records), q = static_cast<double>(terms);
    const Eigen::VectorXd mean = scores.colwise().mean();
    const Eigen::MatrixXd centred = scores.rowwise() - mean.transpose();
    const Eigen::LDLT<Eigen::MatrixXd> spread(centred.transpose() * centred / (n - 1));
    if (!(spread.rcond() > 1e-13)) {
        found.says = fmt::format("The fit of the {} cannot be tested: too few records have runs where it bends.", form);
        return found;
    }
    found.terms = static_cast<int>(terms);
    found.statistic = (n - q) / (q * (n - 1)) * n * mean.dot(spread.solve(mean));
    found.p_value = cdf(complement(boost::math::fisher_f_distribution<double>(q, n - q), found.statistic));
    if (found.p_value >= significance) {
        found.says =
            fmt::format("No lack of fit of the {} was found (p = {:.3f}, {} records).", form, found.p_value, records);
        return found;
    }
    // where the shares deviate most from the curve, in standard errors of independent runs
    Eigen::Index worst = 0;
    double most = -1;
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
        const double expected = curve.counts.trials[i] * below[i];
        const double away = std::abs(curve.counts.reached[i] - expected) / std::sqrt(expected * (1 - below[i]) + 1e-12);
        if (away > most) {
            most = away;
            worst = i;
        }
    }
    std::string at;
    for (std::size_t j = 0; j < curve.data.measures; ++j)
        at += fmt::format("{}{:.4g}", j > 0 ? ", " : "",
                          curve.data.intensity[static_cast<std::size_t>(worst) * curve.data.measures + j]);
    found.says = fmt::format("The {} does not fit (p = {:.2g}, {} records): at intensity {} the share that reached the "
                             "limit state is {:.3f}, the fit gives {:.3f}. Use the shares by stripe.",
                             form, found.p_value, records, at, curve.counts.reached[worst] / curve.counts.trials[worst],
                             below[worst]);
    return found;
}

} // namespace stylobate
