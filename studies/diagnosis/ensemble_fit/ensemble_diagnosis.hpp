#pragma once
/// What the statistics of a campaign show of its joints and blocks, by campaigns that are simulated for it.

#include "studies/diagnosis/ensemble_fit/campaign_ensemble.hpp"
#include "studies/diagnosis/statistics/campaign_statistics.hpp"

namespace stylobate {

struct EnsembleDiagnosis {
    std::vector<CandidateCause> causes;
    std::vector<std::string> mechanisms; ///< names by the numbers of `EnsembleVerdict::set`
    std::vector<StatisticLabel> statistics, descriptors;
    CampaignStatistics measured;
    CampaignEnsemble ensemble;
    EnsembleVerdict verdict; ///< default where the observer stopped it

    /// Mechanism of a candidate, by its number.
    int mechanism_of(std::size_t cause) const;
};

/// @param campaign with its base corrected for what the direct tests found
/// @param study    contacts about which healthy laws are drawn
/// @param base_m   (runs)(nt) as in `balance_evidence`
EnsembleDiagnosis ensemble_diagnosis(const Campaign& campaign, const Study& study, const TrackScales& scales,
                                     const std::vector<std::vector<double>>& base_m, const EnsemblePlan& plan,
                                     const std::filesystem::path& cache, const RunOptions& options,
                                     const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                     Observer& observer);

/// Mean over the runs of the path of each joint, from the smoothed motion.
JointPaths joint_paths(const Campaign& campaign, const TrackScales& scales,
                       const std::vector<std::vector<double>>& base_m);

} // namespace stylobate
