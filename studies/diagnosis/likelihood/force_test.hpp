#pragma once
/// Whether a force of no known kind acts: the largest score of the balance of forces over all such forces, against the
/// same of healthy campaigns.
///
/// Forces (on a block, in a direction, in proportion to position, velocity and so on) are not equally noisy, and a law
/// that the balance of forces does not have moves some of them more than others. Each score is therefore counted in
/// units of what it is in healthy campaigns, so that the noisiest one does not set the bar for all.

#include <Eigen/Core>

#include <vector>

namespace stylobate {

/// Scores of the forces (variants): NaN where a campaign does not show one.
struct ForceEvidence {
    Eigen::MatrixXd nulls;        ///< (n x variants)
    std::vector<double> likeness; ///< (n) how much each tells of the measured campaign, at most 1; empty: 1
    Eigen::VectorXd campaign;     ///< (variants)
};

/// The largest score, in units of healthy campaigns.
struct ForceTest {
    int variant = -1; ///< -1: none is shown
    double score = 0;
    double p_value = 1;
    std::vector<double> nulls; ///< the same of each healthy campaign
};

/// A score as nats: a unit is the 90 % quantile of healthy campaigns, 1.64 standard deviations of normal ones.
double nats_of_score(double score);

ForceTest force_test(const ForceEvidence& evidence);

} // namespace stylobate
