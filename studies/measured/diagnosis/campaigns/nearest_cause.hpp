#pragma once
/// Which cause gives campaigns like the measured one where no healthy law does.
///
/// Distances are root mean squares of numbers in units of their scatter (`LawLikeness`). With n numbers that are
/// independent and an unknown common scale of what a model lacks, the log likelihood of a hypothesis whose nearest
/// campaigns are at a distance d is -n ln d: so two hypotheses are n ln(d1 / d2) apart.

#include "studies/measured/diagnosis/campaigns/ensemble_verdict.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

/// The fixed numbers of the rule.
struct NearnessRule {
    double far = 0.02;    ///< p-value of the distance of healthy campaigns below which none of them is like it
    double nearer = 0.8;  ///< the cause's distance over that of healthy campaigns, at the most
    double rivals = 1.15; ///< distance of a rival over that of the cause, at the most
    double likely = 0.1;  ///< p-value of the likelihood's largest gain, at the most
    double hardly = 0.95; ///< what comes no nearer than this part of the healthy distance has come no nearer
};

struct NearnessEvidence {
    std::vector<double> distance; ///< (candidates) of the nearest campaigns of each; infinite where there are none
    double healthy = 0;           ///< distance of the nearest healthy campaigns
    std::vector<double> nulls;    ///< distance of healthy campaigns that are like the measured one, from the others
    double numbers = 0;           ///< that are independent
    std::vector<int> mechanism;   ///< (candidates)
    double gain_p_value = 1;      ///< of the likelihood's largest gain
};

struct NearestCause {
    int best = -1;        ///< the candidate; -1: there is none
    double healthy_p = 1; ///< of the distance of healthy campaigns among those of nulls
    double gain = 0;      ///< of the best candidate over healthy campaigns [nats]
    /// No healthy law gives the measured campaign, the candidate is much nearer, and the likelihood shows something,
    /// too.
    bool named = false;
    double probability = 0;     ///< of its mechanism among those of all candidates, each as likely before
    std::vector<int> set;       ///< other mechanisms about as near, the nearest first
    double set_probability = 0; ///< that it is the best candidate's mechanism or one of the first `rivals` of the set
};

/// @param rivals as `EnsembleRule::rivals`
NearestCause nearest_cause(const NearnessEvidence& evidence, std::size_t rivals, const NearnessRule& rule = {});

/// Puts the nearest cause into the place of the likelihood's. Of few independent numbers, distances tell mechanisms
/// apart badly; so where the likelihood's best cause is of the same mechanism, the surer of the two says how probable
/// it is, and what is like it.
/// @param mechanism (candidates)   @pre both have a best candidate
void name_nearest(const NearestCause& nearest, const std::vector<int>& mechanism, EnsembleVerdict& verdict);

/// Whether campaigns of a mechanism have come nearer to the measured one than healthy ones.
bool nearer_than_healthy(const NearnessEvidence& evidence, int mechanism, const NearnessRule& rule = {});

/// How many numbers are independent, from the squared distances of pairs of campaigns that differ by chance alone: the
/// logarithm of a mean of n squares of normal numbers has the variance 2 / n, about. From 4 to 40.
double independent_numbers(const std::vector<double>& squares);

} // namespace stylobate
