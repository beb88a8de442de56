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
    std::uint64_t scouts = 144;      ///< healthy ones of the whole family: they show which laws are like the campaign's
    std::uint64_t parents = 12;      ///< so many of their laws, the likest ones, are the parents of all others'
    std::uint64_t nulls = 300;       ///< healthy ones near the parents
    std::uint64_t of_each_cause = 9; ///< at sizes spread evenly over the range of z
    LawFamily family;

    std::uint64_t total(std::size_t causes) const { return scouts + nulls + causes * of_each_cause; }
    /// Whose law a campaign has been given: its number among the parents.
    std::uint64_t parent(std::uint64_t number) const { return (number + number / parents) % parents; }
    /// Cause and size of a campaign: scouts come first, then the nulls.
    std::pair<int, double> label(const std::vector<CandidateCause>& causes, std::uint64_t number) const;
};

struct CampaignEnsemble {
    std::vector<SimulatedCampaign> campaigns; ///< in the order of their numbers
    std::uint64_t simulations = 0, block_steps = 0, cached = 0;
    bool complete = false; ///< false: the observer stopped it

    CampaignTable scouts(const EnsemblePlan& plan) const;
    CampaignTable nulls(const EnsemblePlan& plan) const;
    LabelledCampaigns labelled() const;

private:
    CampaignTable table_of(std::uint64_t first, std::uint64_t end) const;
};

/// @param shown    the law descriptors of the measured campaign
/// @param cache    file that keeps the rows; empty: none
/// @param progress is told (campaigns done, campaigns in all)
CampaignEnsemble simulate_ensemble(const Campaign& measured, const Study& study,
                                   const std::vector<CandidateCause>& causes, const EnsemblePlan& plan,
                                   const std::vector<double>& shown, const std::filesystem::path& cache,
                                   const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer);

} // namespace stylobate
