#pragma once
/// What is not known of a hazard, as one curve for each probability.

#include "ensemble/estimators/risk/hazard.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"

namespace stylobate {

/// The best estimate.
HazardCurve best_curve(const HazardModel& hazard);

/// The curve below which the true one lies with a probability. Between fractiles the logarithm of the frequency is
/// linear in the normal quantile of the probability, and so beyond the first and the last one (two fractiles are then a
/// lognormal distribution). The curve of a fractile is taken as a whole: a hazard that is high at one intensity is high
/// at all of them, which makes the interval the widest that the fractiles allow.
/// @pre two fractiles at least
HazardCurve quantile_curve(const HazardModel& hazard, double probability);

/// The mean of the curves over their probabilities, at each intensity: between two fractiles, and beyond the outer
/// ones, ln frequency is a + b z in the normal quantile z, of which the mean over z1 to z2 is
///
///   exp(a + b2 / 2) (Phi(z2 - b) - Phi(z1 - b)),
///
/// so that of two fractiles it is the mean exp(a + b2 / 2) of a lognormal distribution. A frequency by the fragility is
/// linear in the hazard, so that by this curve it is the mean over the hazard.
/// @pre two fractiles at least
HazardCurve mean_curve(const HazardModel& hazard);

/// A frequency at three curves of the hazard, over its value at the best estimate: the limits of a central interval
/// and the median.
struct HazardSpread {
    double low = 1, middle = 1, high = 1;
};

} // namespace stylobate
