#pragma once
/// What the statistics of a campaign show of its joints and blocks, by campaigns that are simulated for it.
///
/// Whether the balance of forces needs a cause or a force of unknown kind: its largest score over all causes of the
/// list, or over all forces of no known kind, against the same of healthy campaigns.
///
/// Variants (a cause at a place; a force on a block, in a direction, in proportion to position, velocity and so on) are
/// not equally noisy, and a law that the balance of forces does not have moves some of them more than others. Each
/// score is therefore counted in units of what it is in healthy campaigns, so that the noisiest one does not set the
/// bar for all.

#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"
#include "studies/measured/diagnosis/campaigns/ensemble_verdict.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

#include <Eigen/Core>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Scores of the variants: NaN where a campaign does not show one.
struct ForceEvidence {
    Eigen::MatrixXd nulls;        ///< (n x variants)
    std::vector<double> likeness; ///< (n) weight of each for the measured campaign, at most 1; empty: 1
    Eigen::VectorXd campaign;     ///< (variants)
};

/// The largest score, in units of healthy campaigns.
struct ForceTest {
    int variant = -1; ///< -1: none is shown
    double score = 0;
    double p_value = 1;
    std::vector<double> nulls;    ///< largest score of each healthy campaign
    std::vector<double> likeness; ///< (nulls) as of the evidence
    std::vector<double> unit;     ///< (variants) what a score is counted in
};

/// A score as nats: a unit is the 90 % quantile of healthy campaigns, 1.64 standard deviations of normal ones.
double nats_of_score(double score);

ForceTest force_test(const ForceEvidence& evidence);

/// One number that carries a verdict, of the measured campaign and of simulated ones.
struct CarryingNumber {
    std::string text; ///< what it is
    double measured = 0;
    std::vector<double> nulls;                       ///< of healthy campaigns; without those that do not have it
    std::size_t hidden = 0;                          ///< so many do not
    std::vector<std::pair<double, double>> labelled; ///< size and number of the campaigns with the cause

    void add_healthy(double value)
    {
        if (std::isfinite(value))
            nulls.push_back(value);
        else
            ++hidden;
    }
    void add_labelled(double size, double value)
    {
        if (std::isfinite(value))
            labelled.emplace_back(size, value);
    }
};

struct EnsembleDiagnosis {
    std::vector<CandidateCause> causes;
    std::vector<std::string> mechanisms; ///< names by the numbers of the verdicts' mechanisms
    std::vector<StatisticLabel> statistics;
    CampaignStatistics measured;
    std::vector<double> scores;           ///< (scored) of the measured campaign; NaN: not shown
    std::vector<StatisticLabel> evidence; ///< what the verdict by statistics sees
    ScorePlan scored;                     ///< of which the scores are
    CampaignEnsemble ensemble;
    double law_p_value = 1; ///< of the measured law in the family
    // default where the observer stopped it
    EnsembleVerdict by_statistics;
    ForceTest listed, forces; ///< of the scores of the causes, and of those of forces of no known kind

    /// Share of labelled campaigns of a mechanism, with z of at least this, that are named rightly: what these data can
    /// show. Nothing: no campaign has it.
    std::optional<double> power(int mechanism, double least_z) const;
    CarryingNumber carrying; ///< what of the statistics speaks most for their best cause

    /// Number of a cause's mechanism.
    int mechanism_of(const Cause& cause) const;
};

/// @param campaign with its base corrected for what the direct tests found
/// @param study    contacts about which healthy laws are drawn
/// @param known    causes that act in every simulated campaign
/// @param base_m   (runs)(nt) as in `balance_evidence`
EnsembleDiagnosis ensemble_diagnosis(const Campaign& campaign, const Study& study, const CampaignScales& scales,
                                     const std::vector<SizedCause>& known,
                                     const std::vector<std::vector<double>>& base_m, const EnsemblePlan& plan,
                                     const std::optional<std::filesystem::path>& cache, const RunOptions& options,
                                     const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                     Observer& observer);

} // namespace stylobate
