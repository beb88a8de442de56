#pragma once
/// The verdict by the statistics of a campaign: direct tests of base and sensors first, then the cause of joints and
/// blocks whose simulated campaigns are most like the measured one.
///
///   1  What a direct test of base or sensors finds is named, as in `decision.hpp`.
///   2  The largest gain over all candidates is one statistic. Its p-value is its rank among healthy campaigns that
///   were
///      left out of the fit. At 0.015 or less the candidate is named.
///   3  Its probability is calibrated on labelled campaigns that were left out. Below one half nothing is named: the
///      cause is called possible.
///   4  What the best cause leaves is compared with healthy and labelled campaigns: beyond 99 % of both the verdict is
///      'unexplained'.

#include "studies/diagnosis/decision/decision.hpp"
#include "studies/diagnosis/ensemble_fit/ensemble_diagnosis.hpp"

namespace stylobate {

/// A cause that is less probable is not named.
inline constexpr double least_probability = 0.5;

Decided decide(const DirectResult& direct, const EnsembleDiagnosis& ensemble);

} // namespace stylobate
