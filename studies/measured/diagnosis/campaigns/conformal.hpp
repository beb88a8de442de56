#pragma once
/// Probabilities by rank, without a model of tails: conformal p-values, and probabilities calibrated on cases with
/// known answers.

#include <cstddef>
#include <vector>

namespace stylobate {

/// Probability, where nothing is hidden, of a score at least as large: (1 + nulls at least as large) / (1 + nulls).
/// Uniform, or smaller than uniform probabilities never, whatever the distribution of the scores (Vovk, Gammerman and
/// Shafer, "Algorithmic Learning in a Random World", 2005).
/// Campaigns may have weights (Tibshirani, Barber, Candes and Ramdas, "Conformal prediction under covariate shift",
/// Advances in Neural Information Processing Systems 32 (2019)); the one whose score this is weighs 1.
/// @param nulls scores of campaigns that were not used in the fit
/// @param weights (nulls) of each, at most 1; empty: 1
double conformal_p_value(const std::vector<double>& nulls, double score, const std::vector<double>& weights = {});

/// A probability as a non-decreasing function of a score, from cases of which it is known whether the claim was right:
/// isotonic regression (pool adjacent violators).
class CalibratedProbability {
public:
    struct Case {
        double score = 0;
        bool right = false;
        double weight = 1;
    };
    explicit CalibratedProbability(std::vector<Case> cases);

    /// Of the block in which the score lies; linear between the middles of blocks. One half without cases.
    double operator()(double score) const;

private:
    struct Block {
        double score = 0; ///< weighted mean of its cases
        double right = 0; ///< weighted share, with half a case of either kind added
        double weight = 0;
    };
    std::vector<Block> blocks_;
};

} // namespace stylobate
