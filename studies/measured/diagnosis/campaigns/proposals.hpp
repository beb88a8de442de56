#pragma once
/// Which campaigns are simulated, and how near they come: each a pure function of (seed, number, the rows before its
/// round), so that a diagnosis can be interrupted and shared among processes.
///
/// Healthy laws come nearer to the measured campaign round by round as if it were healthy. A strong cause bends these
/// laws: they try to give what the cause does, and a campaign in which the cause acts beside such a law comes nowhere
/// near. So where no healthy law comes near, every cause has rounds of its own: laws and sizes are drawn near those of
/// its own nearest campaigns, and the nearest causes go on (a population Monte Carlo for each of several models:
/// Toni, Welch, Strelkowa, Ipsen and Stumpf, "Approximate Bayesian computation scheme for parameter inference and model
/// selection in dynamical systems", Journal of the Royal Society Interface 6 (2009)).

#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"
#include "studies/measured/diagnosis/campaigns/evidence_rows.hpp"
#include "studies/measured/diagnosis/campaigns/nearest_cause.hpp"

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
              const std::vector<StatisticLabel>& labels, const EvidenceRows& evidence, const SimulatedCampaign& shown);

    /// First campaign behind the round that campaign `number` is in; `number` itself where there is no such campaign.
    /// @param rows all campaigns of the rounds before
    std::uint64_t end_of_round(std::uint64_t number, const std::vector<SimulatedCampaign>& rows);
    /// @param rows all campaigns of the rounds before
    Proposal of(std::uint64_t number, const std::vector<SimulatedCampaign>& rows);
    /// (rows) of healthy laws from the measured one, by the numbers of the joints
    std::vector<double> law_distances(const std::vector<SimulatedCampaign>& rows) const;
    /// Puts into a whole ensemble how near its campaigns are to the measured one.
    void find_nearness(CampaignEnsemble& ensemble) const;

private:
    struct Near {
        std::vector<double> distance; ///< (rows) from the measured campaign, by all numbers (`EvidenceRows`)
        std::vector<double> nulls;    ///< distances of nulls from their nearest others: of the half nearest to it
        double numbers = 0;           ///< that are independent
    };
    Near near(const std::vector<SimulatedCampaign>& rows) const;
    std::vector<HealthyLaw> likest(std::uint64_t round, const std::vector<SimulatedCampaign>& rows);
    std::vector<Proposal> own_round(const OwnRound& round, std::uint64_t begin,
                                    const std::vector<SimulatedCampaign>& rows);

    const EnsemblePlan& plan_;
    const std::vector<CandidateCause>& causes_;
    const std::vector<StatisticLabel>& labels_;
    const EvidenceRows& evidence_;
    const SimulatedCampaign& shown_;
    std::vector<std::vector<HealthyLaw>> parents_; ///< [round - 1] of healthy laws
    std::vector<std::vector<Proposal>> own_;       ///< [own round] empty: it is not simulated
};

/// How near the campaigns of one cause come to the measured one.
struct Nearness {
    int cause = -1;                ///< index among the candidates; -1: healthy
    double distance = HUGE_VAL;    ///< mean of the nearest ones
    std::vector<std::size_t> rows; ///< these, the nearest first
};
/// So many of the nearest campaigns are counted: the nearest one alone is often so by chance.
inline constexpr std::size_t nearest_counted = 3;

/// @param distance (rows) from the measured campaign (`EvidenceRows::likeness`)
/// @param count    of the nearest campaigns of each that are counted
/// @returns healthy ones and those of each cause, the nearest first
std::vector<Nearness> nearness(const std::vector<SimulatedCampaign>& rows, const std::vector<double>& distance,
                               std::size_t causes, std::size_t count = nearest_counted);

} // namespace stylobate
