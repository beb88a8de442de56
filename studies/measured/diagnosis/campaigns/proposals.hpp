#pragma once
/// Which campaigns are simulated: each a pure function of (seed, number, the rows before its round), so that a
/// diagnosis can be interrupted and shared among processes. Healthy laws come nearer to the measured campaign round by
/// round, as if it were healthy.

#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"
#include "studies/measured/diagnosis/campaigns/evidence_rows.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace stylobate {

/// A campaign that is to be simulated.
struct Proposal {
    int cause = -1; ///< index among the candidates; -1: healthy
    double z = 0;
    HealthyLaw law;
};

class Proposals {
public:
    /// All arguments are to stay as long as this.
    Proposals(const EnsemblePlan& plan, const std::vector<CandidateCause>& causes,
              const std::vector<StatisticLabel>& labels, const SimulatedCampaign& shown);

    /// First campaign behind the round that campaign `number` is in; `number` itself where there is no such campaign.
    std::uint64_t end_of_round(std::uint64_t number) const;
    /// @param rows all campaigns of the rounds before
    Proposal of(std::uint64_t number, const std::vector<SimulatedCampaign>& rows);
    /// (rows) of healthy laws from the measured one, by the numbers of the joints
    std::vector<double> law_distances(const std::vector<SimulatedCampaign>& rows) const;

private:
    std::vector<HealthyLaw> likest(std::uint64_t round, const std::vector<SimulatedCampaign>& rows);

    const EnsemblePlan& plan_;
    const std::vector<CandidateCause>& causes_;
    const std::vector<StatisticLabel>& labels_;
    const SimulatedCampaign& shown_;
    std::vector<std::vector<HealthyLaw>> parents_; ///< [round - 1] of healthy laws
};

} // namespace stylobate
