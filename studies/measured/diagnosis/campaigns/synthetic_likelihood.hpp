#pragma once
/// The likelihood of a campaign's statistics under each cause, by their simulated mean and covariance: synthetic
/// likelihood (Wood, "Statistical inference for noisy nonlinear ecological dynamic systems", Nature 466 (2010)), with
/// Student's tails.

#include "studies/measured/diagnosis/campaigns/law_adjustment.hpp"

#include <Eigen/Core>

#include <vector>

namespace stylobate {

// ---- How a cause of a given size shifts the statistics of a campaign, learnt from labelled campaigns: simulated ones
// in which the cause acts at a known place with a known size.
//
//   mean residual at size z = z a + z^2 b      z: 0 at the neutral size
//
// The coefficients of most statistics are noise. They are shrunk all alike, in parts, by the factor that minimizes
// Stein's unbiased estimate of the risk (Stein, "Estimation of the mean of a multivariate normal distribution", Annals
// of Statistics 9 (1981)): each pair (a, b) with chi-squared F is multiplied by max(0, 1 - kappa / F).

class ShiftModel {
public:
    /// @param residuals (n x p) of the labelled campaigns, of scatter 1 (`LawAdjustment::decorrelated`)
    /// @param sizes     (n) z, not all 0
    ShiftModel(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& sizes);

    /// (p) expected residual
    Eigen::VectorXd mean(double size) const;
    /// Variance of the expected residual of one statistic, the same for all: few campaigns show it.
    double variance(double size) const;
    /// Range of the sizes that were simulated; 0 is not in it unless sizes have both signs.
    double least() const { return least_; }
    double most() const { return most_; }
    /// Whether more than one size was simulated on one side: else the shift is a straight line.
    bool curved() const { return curved_; }

private:
    Eigen::MatrixXd coefficients_; ///< (1 or 2 x p)
    Eigen::MatrixXd covariance_;   ///< (1 or 2 square) of the coefficients of one statistic
    double least_ = 0, most_ = 0;
    double kept_ = 1; ///< mean factor of the shrinkage
    bool curved_ = false;
};

/// Evidence of one campaign for one cause.
struct CauseLikelihood {
    double gain = 0;          ///< log of the likelihood over that of no cause, averaged over the sizes [nats]
    double size = 0;          ///< z: mean of the posterior
    double low = 0, high = 0; ///< 90 % interval
};

class SyntheticLikelihood {
public:
    /// All residuals here are decorrelated ones (`LawAdjustment::decorrelated`).
    ///
    /// @param law    what healthy campaigns give at this campaign's descriptors
    /// @param causes what each cause does
    /// @param common (directions x used) patterns along which the residuals, not yet decorrelated, may lie with any
    ///        size: shifts that are common to all joints, of a campaign whose healthy law the family of laws does not
    ///        have; usually none
    SyntheticLikelihood(const LawAdjustment& law, const std::vector<ShiftModel>& causes,
                        const Eigen::MatrixXd& common = {});

    /// @param residual (used) of the campaign
    /// @returns one for each cause
    std::vector<CauseLikelihood> of(const Eigen::VectorXd& residual) const;

private:
    /// One size of one cause. Its covariance is that of healthy campaigns with more on the diagonal: both have the same
    /// principal axes, along which all is counted.
    struct Point {
        double size = 0;
        Eigen::VectorXd mean; ///< along the principal axes
        double variance = 0;  ///< more on the diagonal
        double log_determinant = 0;
    };
    /// @param along the principal axes
    double log_density(double variance, double log_determinant, const Eigen::VectorXd& along) const;

    double freedom_;
    Eigen::MatrixXd axes_;      ///< (used x used) columns: principal axes of the covariance
    Eigen::VectorXd variances_; ///< (used) along them
    double log_determinant_ = 0;
    std::vector<std::vector<Point>> points_; ///< [cause][size]
};

} // namespace stylobate
