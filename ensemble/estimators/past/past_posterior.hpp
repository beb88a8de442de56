#pragma once
/// Which past explains a state best: the posterior over the number of events, their frequency and their intensity.
///
/// Prior: equal for each number of events; flat in the logarithm of the frequency; over the intensity the given
/// density. Between values of the axes the likelihood is linear in their logarithms.

#include "ensemble/estimators/past/agreeing_states.hpp"
#include "ensemble/estimators/past/past_likelihood.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace stylobate {

// Integrals over the intensity of a likelihood that is known on an axis, times a prior density.
//
// Between the values of the axis the likelihood is linear in the logarithm of the intensity; every piece is cut into
// 64 parts, over which the trapezoidal rule is taken. The prior has no mass beyond the axis.

/// Density over the logarithm of the intensity, up to a factor.
using PriorDensity = std::function<double(double intensity)>;

class IntensityIntegral {
public:
    /// @pre two intensities at least, ascending and > 0
    IntensityIntegral(const std::vector<double>& intensity, const PriorDensity& prior);

    /// The integral of prior x likelihood over ln(intensity). @param likelihood (ni)
    double total(std::span<const double> likelihood) const;
    /// The intensity below which a part p of it lies; NaN where the integral is 0.
    double quantile(std::span<const double> likelihood, double p) const;
    /// What each value of the axis contributes to `total`, over the likelihood there: sums to the prior's integral.
    const std::vector<double>& weights() const { return weights_; }

private:
    std::vector<double> log_intensity_; ///< (ni)
    std::vector<double> prior_;         ///< (parts + 1), piece by piece
    std::vector<double> weights_;
};

/// The intensity above which the likelihood stays below a threshold, both linear in the logarithm between values of the
/// axis; infinite where it does not at the axis' end, the first intensity where it is below everywhere.
/// @param threshold (ni)
double likelihood_limit(const std::vector<double>& intensity, std::span<const double> likelihood,
                        std::span<const double> threshold);

/// Of each frequency, for a density that is flat in its logarithm; sum 1.
std::vector<double> frequency_weights(const std::vector<double>& frequency_hz);

/// The mean over the frequencies, weighted. @param cells of one number of events (nf x ni)
std::vector<double> over_frequencies(std::span<const double> cells, std::span<const double> weights);
/// The largest value over the frequencies. @param cells as above
std::vector<double> largest_over_frequencies(std::span<const double> cells, std::size_t intensities);

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

// A test of the posterior on monuments whose past is known.
//
// Each is a realization that stands, drawn with the prior's probability of its cell, and measured with errors that are
// uniform within the tolerances. Its past is then inferred from all other realizations. The posterior probability of
// what lies below the true value, u, is uniform between 0 and 1 where the method is right (Talts, Betancourt, Simpson,
// Vehtari & Gelman, "Validating Bayesian inference algorithms with simulation-based calibration" (2018)); a credible
// interval of level p with equal tails contains the true value where (1 - p) / 2 <= u <= (1 + p) / 2. Of a value with
// a share of the posterior of its own, which the true one has on an axis, u is drawn within that share.

struct MonumentTest {
    std::vector<double> intensity, frequency, events; ///< u of each monument that could be judged
    std::size_t not_judged = 0;                       ///< no other realization agrees with it

    /// How many intervals of this level contain the true value.
    static std::size_t inside(const std::vector<double>& u, double level);
};

/// @param trials (cells) valid realizations   @param prior (cells) probability
/// @pre at least one value is measured
MonumentTest test_monuments(const PastAxes& axes, const std::vector<double>& trials, const StandingStates& standing,
                            const AgreeingStates& agreeing, const MeasuredState& measured,
                            std::span<const double> prior, std::size_t monuments, std::uint64_t seed);

} // namespace stylobate
