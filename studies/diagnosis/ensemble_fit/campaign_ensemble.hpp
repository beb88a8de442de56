#pragma once
/// Simulated campaigns as numbers: healthy ones, and labelled ones in which one cause acts. Kept in a file row by row,
/// so that an interrupted diagnosis continues, and the same bits for any number of threads.

#include "studies/diagnosis/ensemble_fit/candidate_causes.hpp"
#include "studies/diagnosis/ensemble_fit/virtual_campaign.hpp"
#include "studies/diagnosis/likelihood/ensemble_verdict.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

namespace stylobate {

/// A campaign that was simulated and measured as the real one was.
struct SimulatedCampaign {
    std::uint64_t number = 0;
    int cause = -1; ///< index among the candidates; -1: healthy
    double z = 0;
    std::vector<double> descriptors, statistics;
};

/// Which campaigns are simulated: each a pure function of (seed, number).
struct EnsemblePlan {
    std::uint64_t seed = 1;
    std::uint64_t nulls = 300;
    std::uint64_t of_each_cause = 9; ///< at sizes spread evenly over the range of z
    LawFamily family;

    std::uint64_t total(std::size_t causes) const { return nulls + causes * of_each_cause; }
    /// Cause and size of a campaign: the nulls come first.
    std::pair<int, double> label(const std::vector<CandidateCause>& causes, std::uint64_t number) const;
};

struct CampaignEnsemble {
    std::vector<SimulatedCampaign> campaigns; ///< in the order of their numbers
    std::uint64_t simulations = 0, block_steps = 0, cached = 0;
    bool complete = false; ///< false: the observer stopped it

    CampaignTable nulls() const;
    LabelledCampaigns labelled() const;
};

/// @param cache    file that keeps the rows; empty: none
/// @param progress is told (campaigns done, campaigns in all)
CampaignEnsemble simulate_ensemble(const Campaign& measured, const Study& study,
                                   const std::vector<CandidateCause>& causes, const EnsemblePlan& plan,
                                   const std::filesystem::path& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer);

} // namespace stylobate
