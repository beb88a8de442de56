#pragma once
/// From simulated campaigns to what a measured one shows: which cause, with which probability, or none, or something
/// that no cause describes.
///
/// Everything that is claimed is checked on campaigns that were left out of the fit: the null distribution of the
/// largest gain over all candidates on healthy ones, the probability that the name is right and the confusions on
/// labelled ones.

#include "studies/measured/diagnosis/campaigns/conformal.hpp"
#include "studies/measured/diagnosis/campaigns/synthetic_likelihood.hpp"

#include <vector>

namespace stylobate {

/// The fixed numbers of the rule.
struct EnsembleRule {
    double named = 0.015;  ///< largest p-value at which a cause is named
    double force = 0.0075; ///< largest p-value at which a force of no known kind is named
    double outside = 0.01; ///< p-value of the law below which it is outside the family
    double apart = 3;      ///< nats within which rivals are in the set with the best
    int rivals = 2;        ///< most of them that are named with the best: more would be no answer
    double confused = 0.2; ///< share of a rival's left-out campaigns that are called by the best's name
};

struct LabelledCampaigns {
    CampaignTable table;      ///< (n)
    std::vector<int> cause;   ///< (n) index of the candidate
    std::vector<double> size; ///< (n) z
};

struct EnsembleEvidence {
    CampaignTable nulls;
    std::vector<double> likeness; ///< (nulls) weight of each for the measured campaign, at most 1; empty: 1
    LabelledCampaigns labelled;
    double law_p_value = 1;     ///< of the measured law in the family
    std::vector<int> mechanism; ///< (causes) candidates of one mechanism at several places have one number
    /// (p) statistics that a common law shifts alike, as the same one of all joints, have one number; -1: by itself
    std::vector<int> common;
    std::vector<double> least_scatter; ///< (p) as of `LawAdjustment`; empty: 0
    /// (nulls), (labelled) part that is left out together, from 0. Parts of one kind of law each make every check one
    /// on a law that the fit has not seen. Each part holds some nulls.
    std::vector<int> null_fold, labelled_fold;
    Eigen::VectorXd descriptors, statistics; ///< of the measured campaign
};

struct EnsembleVerdict {
    std::vector<CauseLikelihood> causes; ///< (candidates)
    int best = -1;                       ///< the candidate of the largest gain; -1: none can be judged
    double p_value = 1;                  ///< of that gain where nothing is hidden
    bool named = false;
    double probability = 0;     ///< that the mechanism named is right
    std::vector<int> set;       ///< mechanisms that these data do not distinguish from the best, the likeliest first
    double set_probability = 0; ///< that the best or one of the first `EnsembleRule::rivals` of the set is right
    bool contrasts = false;     ///< the law is outside the family: only contrasts between joints were used
    Eigen::VectorXd residual;   ///< (used) of the measured campaign, decorrelated
    Eigen::VectorXd shift;      ///< (used) what the best cause makes of it
    std::vector<Eigen::Index> used;               ///< columns of the statistics
    std::vector<double> null_gains, null_weights; ///< largest gains of healthy campaigns, each left out
    std::vector<bool> labelled_right;             ///< (labelled) named with the right mechanism, left out
};

EnsembleVerdict ensemble_verdict(const EnsembleEvidence& evidence, const EnsembleRule& rule = {});

} // namespace stylobate
