#pragma once
/// On what do the errors of a law depend? Regressions of residuals on covariates, each against its null.

#include "studies/evidence/measured/planar_impact/planar_impact_model.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace stylobate::measured::impact {

/// What a law leaves of each impact, at the lowest point.
struct Residuals {
    std::vector<double> restitution; ///< (v_n measured - predicted) over the closing speed
    std::vector<double> friction;    ///< P_t / P_n, measured - predicted
    std::vector<double> lever;       ///< line of action from the lowest point [m]; no law enters
};

/// @param turn added to the table's orientation [rad]
Residuals residuals(const Body& body, const std::vector<Impact>& impacts, const std::vector<Velocity>& predicted,
                    double turn);

/// A candidate's columns (n_impact x few): a cubic of one covariate, or a harmonic.
struct Candidate {
    std::string name;
    Eigen::MatrixXd columns;
};
std::vector<Candidate> candidates(const Body& body, const std::vector<Impact>& impacts);

struct Dependence {
    double share = 0;   ///< of the variance of the residual, after what is `given`, that the candidate explains
    double null_99 = 0; ///< what shuffled residuals give in 1 of 100 shufflings
    double p = 1;       ///< of the null: (1 + shufflings that explain as much) / (1 + shufflings)
};

/// Least squares; the null shuffles what is left of the residual after `given` (Freedman and Lane 1983).
/// @param given columns that are taken out of both first (n x any, 0 columns: none); a constant always is
Dependence dependence(const std::vector<double>& residual, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& given,
                      int shufflings, std::uint64_t seed);

/// Correlation of neighbours in the order of the impacts.
double neighbour_correlation(const std::vector<double>& values);

/// Kernel ridge regression (Gaussian, `length` standard deviations of each column) from one set of impacts to another.
/// @param from, to columns (n x d);  @param values (n x 3);  @param weight of each row of `from`
Eigen::MatrixXd smooth_prediction(const Eigen::MatrixXd& from, const Eigen::MatrixXd& values,
                                  const Eigen::VectorXd& weight, const Eigen::MatrixXd& to, double length,
                                  double ridge);

double quantile(std::vector<double> values, double part);

/// A relative gain of the median error, 1 - after / before, with the 95 % interval of resampled impacts.
struct Gain {
    double value = 0;
    double low = 0;
    double high = 0;
};
Gain gain(const std::vector<double>& before, const std::vector<double>& after, std::uint64_t seed);

} // namespace stylobate::measured::impact
