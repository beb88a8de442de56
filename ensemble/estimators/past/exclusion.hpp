#pragma once
/// The intensity that what is known of a structure excludes.
///
/// The likelihood over the intensity is that of one frequency, or of all of them in one of two ways: its mean with a
/// density that is flat in the logarithm of the frequency (an integrated likelihood: this density is a prior, which
/// ends with the axis), or its largest value over the frequencies (the profile likelihood, without a prior; Berger,
/// Liseo & Wolpert, "Integrated likelihood methods for eliminating nuisance parameters", Statistical Science 14 (1999)
/// 1, compare the two). An intensity is excluded where the likelihood is below a part of its largest value
/// (`ratio_thresholds.hpp`). The posterior of a prior over the intensity has a quantile besides; it always exists, but
/// where the likelihood has not fallen by the end of the axis it is a property of the prior and of the axis: nothing is
/// then excluded.
///
/// What holds for the frequencies of the axis holds for all frequencies only where the likelihood falls towards both
/// ends of the axis; else shaking of a frequency beyond it may explain the state as well, by another intensity.
///
/// A state that shaking has left excludes weaker shaking too, by the likelihood in the same way.

#include "ensemble/estimators/past/intensity_integral.hpp"
#include "ensemble/estimators/past/ratio_thresholds.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

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
