#pragma once
/// What healthy campaigns give at the law descriptors of one campaign: the expected statistics, and their joint
/// scatter.
///
/// Statistics depend on the healthy contact law, which is not known; the law descriptors of a campaign show it. Among
/// campaigns whose laws are like the measured one the expected statistics are a linear function of the descriptors, and
/// the likest weigh most (local linear regression: Cleveland, "Robust locally weighted regression and smoothing
/// scatterplots", Journal of the American Statistical Association 74 (1979); regression adjustment: Beaumont, Zhang and
/// Balding, "Approximate Bayesian computation in population genetics", Genetics 162 (2002)). The correlation of the
/// residuals is shrunk towards none (Schaefer and Strimmer, "A shrinkage approach to large-scale covariance matrix
/// estimation", Statistical Applications in Genetics and Molecular Biology 4 (2005)), and their tails are Student's.
///
/// What causes do is learnt, and counted, in residuals without this correlation (`decorrelated`). In the residuals
/// themselves the errors of a shift that few campaigns show lie mostly where healthy campaigns hardly scatter, and
/// there they count most.

#include <Eigen/Core>

#include <vector>

namespace stylobate {

/// Campaigns as numbers, a row each.
struct CampaignTable {
    Eigen::MatrixXd descriptors; ///< (n x q) finite
    Eigen::MatrixXd statistics;  ///< (n x p) NaN where a campaign does not have it
};

class LawAdjustment {
public:
    /// @param nulls   healthy campaigns, at least 20 and more than twice the descriptors
    /// @param weights (n) weight of each for the measured campaign, at most 1
    /// @param wanted  (p) whether a statistic is to be used: those that the measured campaign has
    /// @param least_scatter (p) of each statistic, in its unit: what noise gives where the nulls hardly show it; empty:
    /// 0
    LawAdjustment(const CampaignTable& nulls, const Eigen::VectorXd& weights, const std::vector<bool>& wanted,
                  const std::vector<double>& least_scatter = {});

    /// Columns of the statistics that are used: wanted, and finite in most of the nulls.
    const std::vector<Eigen::Index>& used() const { return used_; }

    /// (used) each statistic less what is expected at the descriptors, over its scatter; 0 where it is missing. Farther
    /// than `farthest` it is cut off.
    Eigen::VectorXd residual(const Eigen::VectorXd& descriptors, const Eigen::VectorXd& statistics) const;
    static constexpr double farthest = 8;

    /// (used) residuals without correlation, of unit variance; each is as near as can be to that of its own statistic
    /// (Kessy, Lewin and Strimmer, "Optimal whitening and decorrelation", The American Statistician 72 (2018): the
    /// symmetric root).
    Eigen::VectorXd decorrelated(const Eigen::VectorXd& residual) const { return whitening_ * residual; }

    /// (used x used) correlation of the residuals of nulls.
    const Eigen::MatrixXd& correlation() const { return correlation_; }
    /// Degrees of freedom of Student's tails, and the factor on the correlation, both found by leaving parts out.
    double freedom() const { return freedom_; }
    double scale() const { return scale_; }

private:
    void regress(const CampaignTable& nulls, const Eigen::VectorXd& weights, const std::vector<double>& least_scatter);
    void find_tails(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& weights);
    Eigen::VectorXd standardized(const Eigen::VectorXd& descriptors) const;

    std::vector<Eigen::Index> used_;
    Eigen::VectorXd middle_, spread_; ///< (q) of the descriptors
    Eigen::MatrixXd coefficients_;    ///< (1 + q x used)
    Eigen::VectorXd scatter_;         ///< (used)
    Eigen::MatrixXd correlation_;
    Eigen::MatrixXd whitening_; ///< (used x used) symmetric
    double freedom_ = 0, scale_ = 1;
};

/// The sample correlation of rows with weights, shrunk towards the identity by as much as its own noise requires.
/// @param residuals (n x p) of mean near 0 and scatter near 1   @param weights (n)
Eigen::MatrixXd shrunk_correlation(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& weights);

/// log of the multivariate Student density, but for what does not depend on the distance.
/// @param distance2 Mahalanobis   @param p dimensions
double student_kernel(double distance2, double p, double freedom);

} // namespace stylobate
