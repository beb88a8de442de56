#pragma once
/// The intensity that what is known of a structure excludes.
///
/// The likelihood over the intensity is that of one frequency, or of all of them in one of two ways: its mean with a
/// density that is flat in the logarithm of the frequency (an integrated likelihood: this density is a prior, which
/// ends with the axis), or its largest value over the frequencies (the profile likelihood, without a prior; Berger,
/// Liseo & Wolpert, "Integrated likelihood methods for eliminating nuisance parameters", Statistical Science 14 (1999)
/// 1, compare the two). An intensity is excluded where the likelihood is below a part of its largest value
/// (`RatioThresholds`). The posterior of a prior over the intensity has a quantile besides; it always exists, but
/// where the likelihood has not fallen by the end of the axis it is a property of the prior and of the axis: nothing is
/// then excluded.
///
/// What holds for the frequencies of the axis holds for all frequencies only where the likelihood falls towards both
/// ends of the axis; else shaking of a frequency beyond it may explain the state as well, by another intensity.
///
/// A state that shaking has left excludes weaker shaking too, by the likelihood in the same way.

#include "ensemble/estimators/past/agreeing_states.hpp"
#include "ensemble/estimators/past/past_likelihood.hpp"
#include "ensemble/estimators/past/past_posterior.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stylobate {

// Below which part of the largest likelihood a PGA is excluded.
//
// Wilks' part exp(-q / 2), q the quantile of chi-square with one degree of freedom, holds for many observations of one
// past. A monument is one observation, and strong shaking that is true is then excluded too often. The parts are
// therefore calibrated (Neyman, "Outline of a theory of statistical estimation based on the classical theory of
// probability", Philosophical Transactions of the Royal Society A 236 (1937) 333; by simulation: Feldman & Cousins,
// "Unified approach to the classical statistical analysis of small signals", Physical Review D 57 (1998) 3873): at
// each PGA of the axis monuments are simulated whose shaking had it, and their likelihood there, over its largest
// value, is below the part of that PGA for as few of them as the level leaves. It is never above
// Wilks' (own choice: calibration makes exclusions safer, not bolder). A monument is a realization that stands, with
// the prior of its frequency, and measured with errors that are uniform within the tolerances; all other realizations
// judge it. So the coverage is that among structures that stand.
//
// Of a structure of which only its standing is known the likelihood is the probability of standing itself. Where that
// is below 1 - level the shaking is excluded: among all structures under it, standing or not, as few are excluded
// wrongly. Nothing is calibrated.

/// Of a likelihood over the intensity.
struct ExclusionRule {
    std::vector<double> part; ///< (ni) of the largest likelihood, below which an intensity is excluded
    bool absolute = false;    ///< the parts are likelihoods
    bool calibrated = false;  ///< some of them are

    /// (ni) The likelihoods below which it is.
    std::vector<double> thresholds(std::span<const double> likelihood) const;
};

/// Wilks' part at every intensity.
ExclusionRule asymptotic_rule(std::size_t intensities, double level);

/// Of monuments by which nothing was calibrated.
struct ExclusionCoverage {
    std::size_t monuments = 0;  ///< that were judged
    std::size_t excluded = 0;   ///< whose true intensity is excluded
    std::size_t asymptotic = 0; ///< by Wilks' part it would be
};

struct RatioThresholds {
    ExclusionRule mean;                      ///< of the mean over the frequencies
    ExclusionRule profile;                   ///< of the largest value over the frequencies
    std::vector<ExclusionRule> by_frequency; ///< (nf) of one frequency, which is known
    std::vector<ExclusionCoverage> coverage; ///< (ni) of `mean`
};

/// Wilks' parts throughout.
RatioThresholds asymptotic_thresholds(const PastAxes& axes, double level);
/// Those of a structure of which it is known that it stands.
RatioThresholds standing_thresholds(const PastAxes& axes, double level);

/// An intensity at which fewer structures stand is not calibrated: it takes the smallest part of the others.
inline constexpr std::size_t fewest_standing = 30;

/// @param trials (cells) valid realizations
/// @param standing of the realizations of all numbers of events   @param events which of them are calibrated
/// @param monuments at each intensity, and as many again for the coverage; fewer than 1 / (1 - level): nothing is
///                  calibrated
/// @pre at least one value is measured
RatioThresholds ratio_thresholds(const PastAxes& axes, const std::vector<double>& trials,
                                 const StandingStates& standing, const AgreeingStates& agreeing,
                                 const MeasuredState& measured, std::size_t events, std::size_t monuments, double level,
                                 std::uint64_t seed);

struct Exclusion {
    std::vector<PastEstimate> likelihood; ///< (ni) over the intensity
    ExclusionRule rule;                   ///< of the ratio of likelihoods
    PastEstimate top_ratio;               ///< of the likelihood at the end of the axis to the largest one
    PastEstimate by_likelihood;           ///< infinite: not by the end of the axis
    PastEstimate
        weaker; ///< below this one it is less too: shaking that cannot have left the state; 0: none on the axis
    PastEstimate by_profile;                     ///< as `by_likelihood`, of the profile likelihood
    PastEstimate by_posterior;                   ///< meaningful where something is excluded
    double by_prior = 0;                         ///< what the prior alone puts there
    std::size_t drawn = 0, drawn_with_limit = 0; ///< draws, and those in which the likelihood has fallen
    /// The largest likelihood of the lowest and of the highest frequency over that of all; of one frequency 0.
    PastEstimate lowest_frequency, highest_frequency;
    double open_from = 1; ///< from this ratio on an end is open

    bool excludes() const { return drawn_with_limit > 0 && by_likelihood.value < 1e300; }
    /// Whether it does so in as good as all of the draws.
    bool surely() const { return by_likelihood.upper < 1e300; }
    bool open_below() const { return lowest_frequency.value >= open_from; }
    bool open_above() const { return highest_frequency.value >= open_from; }
};

/// @param events of the past, from 1   @param frequency a single one; none: over all
Exclusion exclusion(const PastLikelihood& likelihood, std::size_t events, const PriorDensity& prior, double level,
                    const RatioThresholds& thresholds, std::optional<std::size_t> frequency = {});

} // namespace stylobate
