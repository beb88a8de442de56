#pragma once
/// The intensity that what is known of a structure excludes.
///
/// Two answers. By the likelihood alone: the intensity from which on the likelihood is less than
/// exp(-q / 2) of its largest value, q the quantile of chi-square with one degree of freedom (at 95 %: 0.1465; Wilks,
/// "The large-sample distribution of the likelihood ratio for testing composite hypotheses", Annals of Mathematical
/// Statistics 9 (1938) 60; Royall, "Statistical Evidence" (1997) for its reading as relative support). With a prior:
/// the intensity above which the posterior has a mass of 1 - level. The second one always exists, but where the
/// likelihood has not fallen by the end of the axis it is a property of the prior and of the axis: nothing is then
/// excluded.
///
/// A state that shaking has left excludes weaker shaking too, by the likelihood in the same way.
///
/// The likelihood over the intensity is that of one frequency, or the mean over all with a density that is flat in the
/// logarithm of the frequency.

#include "ensemble/estimators/past/intensity_integral.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

struct Exclusion {
    std::vector<PastEstimate> likelihood; ///< (ni) over the intensity
    double threshold = 0;                 ///< of the ratio of likelihoods
    PastEstimate top_ratio;               ///< of the likelihood at the end of the axis to the largest one
    PastEstimate by_likelihood;           ///< infinite: not by the end of the axis
    PastEstimate
        weaker; ///< below this one it is less too: shaking that cannot have left the state; 0: none on the axis
    PastEstimate by_posterior;                   ///< meaningful where something is excluded
    double by_prior = 0;                         ///< what the prior alone puts there
    std::size_t drawn = 0, drawn_with_limit = 0; ///< draws, and those in which the likelihood has fallen

    bool excludes() const { return drawn_with_limit > 0 && by_likelihood.value < 1e300; }
    /// Whether it does so in as good as all of the draws.
    bool surely() const { return by_likelihood.upper < 1e300; }
};

/// @param events of the past, from 1   @param frequency a single one; none: the mean over all
Exclusion exclusion(const PastLikelihood& likelihood, std::size_t events, const PriorDensity& prior, double level,
                    std::optional<std::size_t> frequency = {});

} // namespace stylobate
