#pragma once
/// The likelihood of a campaign's statistics under each cause, by their simulated mean and covariance: synthetic
/// likelihood (Wood, "Statistical inference for noisy nonlinear ecological dynamic systems", Nature 466 (2010)), with
/// Student's tails.

#include "studies/diagnosis/likelihood/law_adjustment.hpp"
#include "studies/diagnosis/likelihood/shift_model.hpp"

#include <Eigen/Core>

#include <vector>

namespace stylobate {

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

    /// @param residual (used) of the campaign   @param given a shift that is known to be there; empty: none
    /// @returns one for each cause
    std::vector<CauseLikelihood> of(const Eigen::VectorXd& residual, const Eigen::VectorXd& given = {}) const;

    /// Squared Mahalanobis distance of the campaign.
    double distance2(const Eigen::VectorXd& residual) const;

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
