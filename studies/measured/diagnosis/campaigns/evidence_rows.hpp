#pragma once
/// Campaigns as the verdicts see them: numbers of joints and blocks, and scores of causes and of forces.

#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"
#include "studies/measured/diagnosis/campaigns/law_adjustment.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

#include <Eigen/Core>

#include <vector>

namespace stylobate {

inline Eigen::VectorXd vector_of(const std::vector<double>& values)
{
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

class EvidenceRows {
public:
    EvidenceRows(const std::vector<StatisticLabel>& statistics, const ScorePlan& scored);

    /// (labels) of the joints, over the motions, and scores
    std::vector<double> statistics(const CampaignStatistics& campaign, const std::vector<double>& scores) const;
    std::vector<double> descriptors(const CampaignStatistics& campaign) const { return medians(law_, campaign.values); }
    CampaignTable table(const std::vector<const SimulatedCampaign*>& rows) const;

    std::vector<StatisticLabel> labels;
    std::vector<double> least_scatter; ///< (labels)

private:
    Summary joints_, law_;
    std::vector<std::size_t> scores_;
};

} // namespace stylobate
