#include "studies/diagnosis/statistics/balance_scores.hpp"

#include <limits>

namespace stylobate {

ScorePlan score_plan(const Specimen& specimen, const TrackScales& scales)
{
    return {balance_causes(specimen, scales), balance_structures(specimen)};
}

std::optional<BalanceFit> fit_balance(const Campaign& campaign, const TrackScales& scales,
                                      const std::vector<std::vector<double>>& base_m)
{
    const double friction = nominal_friction(campaign.specimen);
    std::vector<LawSample> all;
    for (const std::vector<LawSample>& run : law_samples(campaign, scales, base_m, friction))
        all.insert(all.end(), run.begin(), run.end());
    if (all.empty())
        return std::nullopt;
    return BalanceFit(campaign.specimen, std::move(all), friction, static_cast<int>(campaign.runs.size()));
}

std::vector<double> balance_scores(const std::optional<BalanceFit>& fit, const ScorePlan& plan)
{
    if (!fit)
        return std::vector<double>(plan.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<double> scores;
    for (const Cause& cause : plan.causes)
        scores.push_back(fit->score(cause));
    for (const Structure& structure : plan.structures)
        scores.push_back(fit->score(structure));
    return scores;
}

} // namespace stylobate
