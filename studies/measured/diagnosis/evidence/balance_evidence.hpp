#pragma once
/// Evidence of the balance of forces of a campaign for each cause and for forces of unknown kind: as scores
/// (`BalanceFit::score`), which measured and simulated campaigns have alike, and as fits.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/balance_fit.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Of which the scores of a specimen are: causes first, then structures.
struct ScorePlan {
    std::vector<Cause> causes;
    std::vector<Structure> structures;
    std::size_t size() const { return causes.size() + structures.size(); }
};
ScorePlan score_plan(const Specimen& specimen, const CampaignScales& scales);

/// @param base_m (runs)(nt) as in `law_samples`
/// @return refers to the campaign's specimen; nothing where no joint slid or rocked long enough
std::optional<BalanceFit> fit_balance(const Campaign& campaign, const CampaignScales& scales,
                                      const std::vector<std::vector<double>>& base_m);

/// @return (plan) NaN where the samples do not show it, and everywhere where there is no fit
std::vector<double> balance_scores(const std::optional<BalanceFit>& fit, const ScorePlan& plan);

/// The forces of a campaign.
struct BalanceEvidence {
    std::optional<BalanceFit> fit; ///< nothing where no joint slid or rocked long enough
    /// One for each mechanism and place, best first; possible ones, of sizes that a damaged specimen may have.
    std::vector<CauseFit> causes;
    /// The best fit of a size that no specimen may have: a drag that drives, a turning point outside its corner.
    std::optional<CauseFit> impossible;
    std::vector<StructureFit> structures; ///< most telling first
    std::string why_not;                  ///< where there is no fit
};

/// @param base_m (runs)(nt) the base displacement to be used; empty: not known
/// @param given causes that are taken as given: what is fitted is fitted beside them
BalanceEvidence balance_evidence(const Campaign& campaign, const CampaignScales& scales,
                                 const std::vector<std::vector<double>>& base_m, const std::vector<Cause>& given = {});

/// Whether a specimen may have it: a possible fit, and no centre of mass farther aside than in any simulated campaign.
bool of_possible_size(const CauseFit& fit, const Specimen& specimen);

/// The best of each mechanism and place (over sides and second parameters), possible ones alone, best first.
std::vector<CauseFit> best_of_each(std::vector<CauseFit> fits);

/// Whether a gain is not that of one run alone: without the best run this part of it is left.
bool not_by_one_run(double gain, const std::vector<double>& gain_by_run, double part);

} // namespace stylobate
