#pragma once
/// The verdict by simulated campaigns: direct tests of base and sensors first, then two tests of joints and blocks,
/// each against healthy campaigns whose laws are like the measured one.
///
///   1  What a direct test of base or sensors finds is named, as in `decision.hpp`. If it is something that the
///      simulations cannot contain, joints and blocks are not judged.
///   2  The largest score of the balance of forces over all causes is one statistic, the largest gain of the campaign's
///      statistics over all labelled causes another. The p-value of each is its rank among the healthy campaigns. A
///      cause is named at 0.0075 or less; where the two tests name different causes the more probable one is named, and
///      the other is in the set with it.
///   3  Its probability is calibrated on labelled campaigns. Below one half nothing is named: the cause is called
///      possible.
///   4  A force of no known kind whose score is far beyond healthy campaigns' and all causes', and not by one run
///      alone, makes the verdict 'unexplained'; so does what the best cause leaves of the statistics, beyond 99 % of
///      healthy and of labelled campaigns.

#include "studies/diagnosis/decision/decision.hpp"
#include "studies/diagnosis/ensemble_fit/ensemble_diagnosis.hpp"

#include <string>

namespace stylobate {

Decided decide(const DirectResult& direct, const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
               const DecisionRule& rule);

/// What both tests found, named or not, in one line each.
std::vector<std::string> tests_in_words(const EnsembleDiagnosis& ensemble);

} // namespace stylobate
