#pragma once
/// What an intervention changes of how often a limit state is reached: two structures under the same motions.
///
/// The frequency of each is that by the shares of the stripes (`share_frequency`). It is linear in the shares, so the
/// change is the mean over motions of each one's own change d_g. A motion is drawn with all its realizations of both
/// structures: that keeps the pairs, and what both have in common cancels.
///
///   weights   W_g / (W_1 + ... + W_m), W independent and exponential (Rubin, "The Bayesian bootstrap", Annals of
///             Statistics 9 (1981) 130), the same for both structures and for every quantity of a draw
///   spread    the distance of a draw from the estimate is multiplied by t / z sqrt((m + 1) / (m - 1)), so that its
///             variance is that of Student's interval. t has (sum |d_g|)^2 / sum d_g^2 - 1 degrees of freedom: motions
///             under which nothing changes do not show the scatter (own choice, as in `share_frequency`)
///   few       where fewer than `least_records` motions count so, there is no scatter to rely on. A further motion is
///             drawn under which the state is reached in one structure alone, at every stripe from the first one with
///             damage on: in the variant for the upper limits, in the base for the lower ones (`stripe_shares.hpp`).
///             The spread is then not multiplied
///   hazard    each draw of `total` has its own curve of the hazard, the quantile of a uniform number; both structures
///             have the same one. Those of `fragility` have the best estimate
///
///   form      where the stripes of a structure separate (`FrequencyEstimate::separated`), the distances of its limits
///             by the fragility from its value are joined with those of the draws, at the root of the sum of their
///             squares
///
/// Limits are quantiles of the draws. What the runs do not exclude at intensities without damage is in no limit
/// (`FrequencyEstimate::unseen` of both).

#include "ensemble/estimators/risk/frequency_estimate.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Realizations that both structures have valid, by motion and stripe, and how many of them reached the limit state.
struct PairedStripes {
    std::vector<double> intensity;             ///< (stripes) ascending, > 0
    std::vector<double> trials, base, variant; ///< (motions x stripes)
};

/// A change with its limits: of the motions with the best estimate of the hazard, and of motions and hazard.
struct ChangeNumber {
    double value = 0;
    Limits fragility, total;
};

template <class F>
void visit_fields(std::type_identity<ChangeNumber>, F&& f)
{
    f("value", &ChangeNumber::value);
    f("lower", within(&ChangeNumber::total, &Limits::lower));
    f("upper", within(&ChangeNumber::total, &Limits::upper));
    f("fragility_lower", within(&ChangeNumber::fragility, &Limits::lower));
    f("fragility_upper", within(&ChangeNumber::fragility, &Limits::upper));
}

struct ChangeOptions {
    double level = 0.9;
    std::vector<double> years = {50, 100};
    std::size_t draws = 2000;
    std::uint64_t seed = 1; ///< stream `bootstrap`
};

struct FrequencyChange {
    FrequencyEstimate base, variant;       ///< by shares
    ChangeNumber frequency;                ///< variant - base [1/year]
    ChangeNumber ratio;                    ///< variant / base; NaN where the base has no frequency
    std::vector<ChangeNumber> probability; ///< (years) of at least one event: variant - base
    bool few = false;                      ///< whether too few motions show a change to rely on their scatter
};

/// Motions and stripes without a pair are left out. @pre a pair at two stripes at least
FrequencyChange frequency_change(const PairedStripes& pairs, const HazardModel& hazard, const ChangeOptions& options);

} // namespace stylobate
