#pragma once
/// Regression of counts on predictors through a link, by maximum likelihood (McCullagh & Nelder, "Generalized Linear
/// Models", 2nd edition (1989), chapter 4; separated data: Albert & Anderson, "On the existence of maximum likelihood
/// estimates in logistic regression models", Biometrika 71 (1984) 1).

#include "ensemble/estimators/fragility/fragility_data.hpp"

#include <Eigen/Core>

namespace stylobate {

inline constexpr int most_coefficients = 16; ///< of one regression; so that its matrices need no memory of their own
using ParameterVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_coefficients, 1>;
using ParameterMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_coefficients, most_coefficients>;

/// Trials and successes at points with given predictors.
struct BinomialCounts {
    Eigen::VectorXd trials;  ///< (points)
    Eigen::VectorXd reached; ///< (points)
};

/// @param weight (records) how often each record counts, as in a resample; once each where empty
BinomialCounts counts_of(const FragilityData& data, const Eigen::VectorXd& weight = {});

/// (points x (1 + measures)): 1, and the logarithms of the intensities.
Eigen::MatrixXd log_predictors(const FragilityData& data);

struct BinomialFit {
    Maximum maximum = Maximum::inside;
    ParameterVector coefficients; ///< (parameters); where separated, a direction along which the likelihood grows
    ParameterMatrix information;  ///< observed, (parameters x parameters); only where the maximum is inside
    double log_likelihood = 0;    ///< without the binomial coefficients; its supremum where there is no maximum
};

/// Newton's method with step halving; both likelihoods are concave (Pratt, "Concavity of the log likelihood", Journal
/// of the American Statistical Association 76 (1981) 103).
///
/// @param predictors (points x parameters) of full column rank over the points that have trials
/// @param offset     (points) added to the linear predictor; none where empty
/// @param start      (parameters) initial value; zero where empty
/// @throws InputError if the predictors are not independent
BinomialFit fit_binomial(Link link, const Eigen::MatrixXd& predictors, const BinomialCounts& counts,
                         const Eigen::VectorXd& offset = {}, const ParameterVector& start = {});

/// Covariance of the coefficients for any dependence between the runs of one record: the jackknife over records with
/// one Newton step each, (G - 1)/G sum_g d_g d_g', d_g = (I - I_g)^-1 s_g, with I the information, s the score. This is
/// the estimator CR3 (Bell & McCaffrey, "Bias reduction in standard errors for linear regression with multi-stage
/// samples", Survey Methodology 28 (2002) 169). It is conservative with few records, as the Student quantile used with
/// it assumes.
///
/// @param weight as in `counts_of`
/// @return (parameters x parameters); not finite where the maximum depends on one record alone
ParameterMatrix record_covariance(Link link, const Eigen::MatrixXd& predictors, const FragilityData& data,
                                  const BinomialFit& fit, const Eigen::VectorXd& weight = {});

/// The influence of each record on the coefficients, the d_g above: the fit less what one Newton step without the
/// record makes of it. (records x parameters)
Eigen::MatrixXd record_influence(Link link, const Eigen::MatrixXd& predictors, const FragilityData& data,
                                 const BinomialFit& fit, const Eigen::VectorXd& weight = {});

} // namespace stylobate
