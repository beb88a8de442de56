#pragma once
/// Which past explains a state best: the posterior over the number of events, their frequency and their intensity.
///
/// Prior: equal for each number of events; flat in the logarithm of the frequency; over the intensity the given
/// density. Between values of the axes the likelihood is linear in their logarithms.

#include "ensemble/estimators/past/intensity_integral.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

struct PastPosterior {
    /// The mean likelihood under the prior. Of two studies of one structure and state that differ in their motions (two
    /// records) the ratio of their evidences is the odds that the state gives them (Kass & Raftery, "Bayes
    /// factors", Journal of the American Statistical Association 90 (1995) 773).
    PastEstimate evidence;
    std::vector<PastEstimate> events;    ///< (events) probability of 1, 2, ...
    std::vector<PastEstimate> frequency; ///< (nf) probability of each
    PastEstimate intensity_median;
    PastEstimate intensity_lower, intensity_upper; ///< ends of the credible interval, equal tails
    std::size_t best = 0;                          ///< cell with the largest posterior probability
    std::vector<double> cells;                     ///< (cells) posterior probability
    PastEstimate best_probability;                 ///< of the best cell
};

/// @pre some likelihood is above 0
PastPosterior past_posterior(const PastLikelihood& likelihood, const PriorDensity& prior, double level);

/// Prior probability of each cell. (cells)
std::vector<double> past_prior(const PastAxes& axes, const PriorDensity& prior);

} // namespace stylobate
