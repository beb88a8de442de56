#pragma once
/// One verdict from the scores of many possible causes: the largest of them all, against the same of healthy campaigns.
///
/// Variants (a mechanism at a place, on a side, with a second parameter) are not equally noisy, and a law that the
/// balance of forces does not have moves some of them more than others. Each score is therefore counted in units of
/// what it is in healthy campaigns, so that the noisiest variant does not set the bar for all. The largest of these
/// numbers is one statistic, and its p-value is its rank among those of the healthy campaigns.

#include "studies/diagnosis/likelihood/ensemble_verdict.hpp"

#include <Eigen/Core>

#include <vector>

namespace stylobate {

struct ScoreVariants {
    std::vector<int> mechanism; ///< (variants) number of the mechanism; -1: a force of no known kind
    std::vector<int> sign;      ///< (variants) which way a cause can act: 1, -1, or 0 either way
};

/// Scores: NaN where a campaign does not show a variant.
struct ScoreEvidence {
    ScoreVariants variants;
    Eigen::MatrixXd nulls;               ///< (n x variants)
    std::vector<double> likeness;        ///< (n) how much each tells of the measured campaign, at most 1; empty: 1
    Eigen::MatrixXd labelled;            ///< (m x variants)
    std::vector<int> labelled_mechanism; ///< (m)
    Eigen::VectorXd campaign;            ///< (variants)
    /// What else speaks for each mechanism, in nats: it decides between mechanisms whose scores are alike. Empty:
    /// nothing.
    Eigen::VectorXd support;          ///< (mechanisms)
    Eigen::MatrixXd labelled_support; ///< (m x mechanisms)
};

/// The largest score of one kind, in units of healthy campaigns.
struct LargestScore {
    int variant = -1; ///< -1: none is shown
    double score = 0;
    double p_value = 1;
    std::vector<double> nulls; ///< the same of each healthy campaign
};

struct ScoreVerdict {
    std::vector<double> scores; ///< (variants) in units of healthy campaigns; 0: not shown, or the wrong way
    LargestScore cause, unknown;
    std::vector<double> likeness; ///< of the healthy campaigns
    bool named = false;
    double probability = 0;           ///< that the mechanism named is right, if one of the list acts
    std::vector<int> set;             ///< mechanisms that the scores do not distinguish from the best
    std::vector<bool> labelled_right; ///< (labelled) named, with the right mechanism
};

/// A score as nats: a unit is the 90 % quantile of healthy campaigns, 1.64 standard deviations of normal ones.
double nats_of_score(double score);

ScoreVerdict score_test(const ScoreEvidence& evidence, const EnsembleRule& rule = {});

} // namespace stylobate
