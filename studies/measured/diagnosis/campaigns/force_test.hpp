#pragma once
/// Whether the balance of forces needs a cause or a force of unknown kind: its largest score over all causes of the
/// list, or over all forces of no known kind, against the same of healthy campaigns.
///
/// Variants (a cause at a place; a force on a block, in a direction, in proportion to position, velocity and so on) are
/// not equally noisy, and a law that the balance of forces does not have moves some of them more than others. Each
/// score is therefore counted in units of what it is in healthy campaigns, so that the noisiest one does not set the
/// bar for all.

#include <Eigen/Core>

#include <vector>

namespace stylobate {

/// Scores of the variants: NaN where a campaign does not show one.
struct ForceEvidence {
    Eigen::MatrixXd nulls;        ///< (n x variants)
    std::vector<double> likeness; ///< (n) weight of each for the measured campaign, at most 1; empty: 1
    Eigen::VectorXd campaign;     ///< (variants)
};

/// The largest score, in units of healthy campaigns.
struct ForceTest {
    int variant = -1; ///< -1: none is shown
    double score = 0;
    double p_value = 1;
    std::vector<double> nulls;    ///< the same of each healthy campaign
    std::vector<double> likeness; ///< (nulls) as of the evidence
    std::vector<double> unit;     ///< (variants) what a score is counted in
};

/// A score as nats: a unit is the 90 % quantile of healthy campaigns, 1.64 standard deviations of normal ones.
double nats_of_score(double score);

ForceTest force_test(const ForceEvidence& evidence);

} // namespace stylobate
