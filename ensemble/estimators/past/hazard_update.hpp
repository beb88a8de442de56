#pragma once
/// Update of the rates of a hazard curve by the observation "it has stood for T years".
///
/// Events come as a Poisson process with the rates of the curve, times an unknown factor c that is the same for all
/// intensities; each finds the structure as it was built, and fells it with the probability P(a). Collapse then has the
/// annual rate
///
///   lambda = c L,   L = integral of P(a) (-dH / d ln a) d ln a
///
/// and the structure stands after T years with the probability exp(-c L T). With a lognormal prior of c, median 1, the
/// posterior follows by quadrature (4001 points of ln c over 8 standard deviations to either side). Testing hazard
/// models by what has stood: Anderson & Brune, "Methodology for using precarious rocks in Nevada to test seismic hazard
/// models", Bulletin of the Seismological Society of America 89 (1999) 456; updating their rates: Rood, Stafford &
/// Rood, "San Andreas fault earthquake hazard model validation using probabilistic analysis of precariously balanced
/// rocks and Bayesian updating", Seismological Research Letters 95 (2024) 1776.
///
/// Of N structures that were built alike at the site n stand. Each earthquake meets all of them. m given ones of them
/// all stand after T years with the probability exp(-c L_m T), L_m with the probability 1 - E[p^m] that an earthquake
/// fells one of the m, p the probability to stand under a given motion; so exactly n of N stand with
///
///   C(N, n) sum over j of (-1)^j C(N - n, j) exp(-c L_(n + j) T)
///
/// by inclusion and exclusion. A structure that is asked because it stands is of this kind; exp(-c L T) holds for one
/// that was chosen before its fate was known (N = n = 1).
///
/// P is linear in the logarithm of the intensity between values of the axis, and beyond its end as at its end. Below
/// its begin P is taken as 0: where P is not 0 there, L is too small.

#include "ensemble/estimators/past/past_posterior.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace stylobate {

/// Of the points of a hazard curve.
struct IntensityRange {
    double from = 0, to = 0;
};

/// Structures that were built alike.
struct AlikeStructures {
    std::uint64_t built = 1, standing = 1;
    /// (cells of one event x built) The probability that 1, 2, ... of them all stand, over that of one.
    std::vector<double> all_stand = {};
};

struct HazardUpdate {
    PastEstimate collapse_rate;              ///< L, per year: of factor 1
    PastEstimate stands;                     ///< exp(-L T)
    PastEstimate beyond;                     ///< part of L that comes from beyond the end of the axis
    PastEstimate beyond_hazard;              ///< part of L from outside of the hazard's points; 0: it has no range
    PastEstimate at_begin;                   ///< P at the begin of the axis
    PastEstimate factor_median;              ///< posterior of c
    PastEstimate factor_lower, factor_upper; ///< ends of its credible interval, equal tails
    double prior_lower = 0, prior_upper = 0; ///< of the prior
    /// The posterior of c given how many of the alike structures stand; of one structure the same as above.
    PastEstimate alike_median, alike_lower, alike_upper;
};

/// The posterior quantile p of the factor. @param sigma_ln > 0
/// @param likelihood of a factor c
double factor_quantile(const std::function<double(double c)>& likelihood, double sigma_ln, double p);
/// Of one structure. @param exposure L T
double factor_quantile(double exposure, double sigma_ln, double p);
/// The probability that exactly n of N stand, up to C(N, n). @param exposure (N) L_m T of m = 1 to N
double alike_likelihood(std::span<const double> exposure, std::uint64_t standing, double c);

/// @param collapse probability of collapse in the cells of one event, the others are not used
/// @param points outside of which the curve is continued; none: a power law at all intensities
HazardUpdate hazard_update(const PastLikelihood& collapse, const HazardCurve& rates, double years, double sigma_ln,
                           double level, const std::optional<IntensityRange>& points = {},
                           const AlikeStructures& alike = {});

} // namespace stylobate
