#pragma once
/// Functions of a fitted curve: a number that its coefficients determine, with its intervals.

#include "ensemble/estimators/fragility/binomial_regression.hpp"
#include "ensemble/estimators/fragility/fragility_data.hpp"

#include <span>
#include <vector>

namespace stylobate {

/// A function of the coefficients whose level sets are planes, value(b) = v where c(v) . b = d(v).
class CurveTarget {
public:
    /// ln of the median intensity of a curve of one measure, -b0 / b1.
    static CurveTarget log_median() { return {Kind::log_median, {}}; }
    /// A weighted sum of the coefficients: the linear predictor at `weights` = (1, ln intensities), or one of them.
    static CurveTarget sum(const ParameterVector& weights) { return {Kind::sum, weights}; }
    /// The slope b1; the dispersion is its inverse.
    static CurveTarget slope() { return sum((ParameterVector(2) << 0, 1).finished()); }

    double value(const ParameterVector& coefficients) const;
    ParameterVector gradient(const ParameterVector& coefficients) const;

    struct Plane {
        ParameterVector normal; ///< c
        double distance = 0;    ///< d
    };
    Plane plane(double value) const;

private:
    enum class Kind : std::uint8_t { log_median, sum };
    CurveTarget(Kind kind, ParameterVector weights) : kind_(kind), weights_(std::move(weights)) {}
    Kind kind_;
    ParameterVector weights_;
};

/// Data, their fit, and what every interval of the fit needs.
struct FittedCurve {
    Link link = Link::probit;
    FragilityData data;
    Eigen::MatrixXd predictors; ///< (points x parameters)
    BinomialCounts counts;
    BinomialFit fit;
    ParameterMatrix covariance; ///< of the coefficients, from the records; only where the maximum is inside
};
FittedCurve fitted_curve(FragilityData data, Eigen::MatrixXd predictors, Link link);

/// The variance of a target, from the records, and the degrees of freedom of that variance (own choice, of the form of
/// Satterthwaite, "An approximate distribution of estimates of variance components", Biometrics Bulletin 2 (1946) 110).
struct RecordSpread {
    double variance = 0;
    double freedom = 0;   ///< (sum a_g)^2 / sum a_g^2 - 1 with each record's share a_g of the information on the target
    double inflation = 1; ///< of the variance relative to that of independent runs
};
RecordSpread record_spread(const FittedCurve& curve, const CurveTarget& target);

/// Values whose profile likelihood lies less than half the chi-square quantile below the maximum (Venzon & Moolgavkar,
/// "A method for computing profile-likelihood-based confidence intervals", Applied Statistics 37 (1988) 87): right
/// where all runs are independent. Unbounded, as the others, where the likelihood has no maximum.
Limits profile_limits(const FittedCurve& curve, const CurveTarget& target, double level);

/// Limits as of `profile_limits`, with the likelihood ratio divided by the inflation of the target's variance by the
/// records and compared with the square of Student's quantile (Chandler & Bate, "Inference for clustered data using the
/// independence loglikelihood", Biometrika 94 (2007) 167, vertical adjustment; CR3 variance): right where only the
/// records are independent.
Limits record_limits(const FittedCurve& curve, const CurveTarget& target, double level);

/// Twice the difference of the maximum log likelihood and that of the best coefficients with that value of the target.
double profile_deviance(const FittedCurve& curve, const CurveTarget& target, double value);

/// The fits without each record in turn.
struct Jackknife {
    std::vector<ParameterVector> coefficients; ///< (records) empty where the maximum is not inside for all of them
};
Jackknife jackknife(const FittedCurve& curve);

/// The jackknife over records (Efron & Tibshirani, "An Introduction to the Bootstrap" (1993), chapter 11): G value - (G
/// - 1) mean of the values without each, which removes the bias that a steep curve has with few records, -+ Student's
/// quantile x the standard error of the values without each.
/// @return unbounded where the curve depends on one record, and where the records do not differ
Limits jackknife_limits(const FittedCurve& curve, const Jackknife& without, const CurveTarget& target, double level);

/// value -+ Student's quantile x standard error from the records, CR3.
Limits wald_limits(const FittedCurve& curve, const CurveTarget& target, double level);

/// Limits from curves fitted to records resampled with replacement (Efron & Tibshirani 1993, chapters 12 to 14).
struct BootstrapLimits {
    Limits percentile;
    Limits accelerated;              ///< bias-corrected and accelerated (BCa; Efron, JASA 82 (1987) 171)
    Limits studentized;              ///< from the quantiles of (value - estimate) / standard error (bootstrap-t)
    std::size_t without_maximum = 0; ///< resamples without a maximum; they count as infinite
};

/// @param resamples number of them; resample i draws with stream `bootstrap`, index i, elements 0 to records - 1
/// @return one for each target; unbounded where the fit itself has no maximum
std::vector<BootstrapLimits> bootstrap_limits(const FittedCurve& curve, std::span<const CurveTarget> targets,
                                              double level, std::size_t resamples, std::uint64_t seed);

} // namespace stylobate
