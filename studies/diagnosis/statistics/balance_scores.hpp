#pragma once
/// The balance of forces as one score for every cause and for every force of unknown kind
/// (`BalanceFit::score`): the same numbers of a measured campaign and of simulated ones.

#include "studies/diagnosis/laws/balance_fit.hpp"

#include <optional>
#include <vector>

namespace stylobate {

/// Of which the scores of a specimen are: causes first, then structures.
struct ScorePlan {
    std::vector<Cause> causes;
    std::vector<Structure> structures;
    std::size_t size() const { return causes.size() + structures.size(); }
};
ScorePlan score_plan(const Specimen& specimen, const TrackScales& scales);

/// @param base_m (runs)(nt) as in `law_samples`
/// @return refers to the campaign's specimen; nothing where no joint slid or rocked long enough
std::optional<BalanceFit> fit_balance(const Campaign& campaign, const TrackScales& scales,
                                      const std::vector<std::vector<double>>& base_m);

/// @return (plan) NaN where the samples do not show it, and everywhere where there is no fit
std::vector<double> balance_scores(const std::optional<BalanceFit>& fit, const ScorePlan& plan);

} // namespace stylobate
