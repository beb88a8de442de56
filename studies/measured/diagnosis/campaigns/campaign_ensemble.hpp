#pragma once
/// Simulated campaigns as numbers: healthy ones, and labelled ones in which one cause acts. Kept in a file row by row,
/// so that an interrupted diagnosis continues, and the same bits for any number of threads.
///
/// How unlike the healthy laws of two campaigns are, by what they do to all joints.

#include "studies/measured/diagnosis/campaigns/candidate_causes.hpp"
#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

/// Numbers of a campaign that show its law and hardly a cause: its descriptors, and the median over the joints of each
/// kind of statistic.
std::vector<double> law_numbers(const std::vector<StatisticLabel>& labels, const CampaignStatistics& campaign);

/// Its descriptors, and each kind of statistic of each joint, mean over the motions. A healthy law that makes a joint
/// behave as a cause would is no reason to name the cause: laws like the measured one are found by these numbers.
std::vector<double> joint_numbers(const std::vector<StatisticLabel>& labels, const CampaignStatistics& campaign);

/// Differences of the numbers of campaigns in units of their scatter among specimens of one law.
class LawLikeness {
public:
    /// @param pairs numbers of campaigns of one law each, whose specimens differ
    /// @param kept  part of the numbers that count, the nearest ones
    LawLikeness(const std::vector<std::pair<std::vector<double>, std::vector<double>>>& pairs, double kept);

    /// Root mean square over the numbers that `of` has, the largest ones left out: a cause moves some of them. What the
    /// other one does not have counts as far.
    double distance(const std::vector<double>& of, const std::vector<double>& other) const;

private:
    double kept_;
    std::vector<double> scatter_; ///< 0: not known, or none
};

/// Mean distance of a campaign from its nearest neighbours among others.
double isolation(const LawLikeness& likeness, const std::vector<double>& of,
                 const std::vector<std::vector<double>>& others, std::size_t neighbours);
/// (campaigns) of each among all others.
std::vector<double> isolations(const LawLikeness& likeness, const std::vector<std::vector<double>>& campaigns,
                               std::size_t neighbours);

/// Rank of a law among healthy ones by how far it is from its nearest neighbours: a law that the family does not have
/// is by itself. Conformal: uniform, or larger, where it is one of them.
double isolation_p_value(const LawLikeness& likeness, const std::vector<std::vector<double>>& nulls,
                         const std::vector<double>& law);

/// A campaign that was simulated and measured as the real one was.
struct SimulatedCampaign {
    std::uint64_t number = 0;
    int cause = -1; ///< index among the candidates; -1: healthy
    double z = 0;
    CampaignStatistics numbers;
    std::vector<double> scores; ///< (score_plan)
};

/// How many campaigns are simulated; `Proposals` chooses which.
///
/// Healthy laws come nearer to the measured one round by round: scouts of the whole family, then campaigns near the
/// laws that were the likest so far. The rounds' campaigns and those after them are the null distribution: what chance
/// gives under laws like the measured one.
struct EnsemblePlan {
    std::uint64_t seed = 1;
    std::uint64_t wide = 144;         ///< healthy ones of the whole family
    std::uint64_t pairs = 24;         ///< others with the laws of the first of these: the scatter within a law
    std::uint64_t rounds = 2;         ///< near the likest laws so far
    std::uint64_t of_each_round = 72; ///< healthy ones
    std::uint64_t parents = 12;       ///< so many of the likest laws are those near which is drawn
    std::uint64_t nulls = 192;        ///< healthy ones near the likest laws of all
    std::uint64_t of_each_cause = 12; ///< near these too, at sizes spread evenly over the range of z
    LawFamily family;

    /// With so many nulls, and of all others in proportion as many as the default plan has.
    static EnsemblePlan with(std::uint64_t nulls);

    std::uint64_t scouts() const { return wide + pairs; }
    std::uint64_t healthy() const { return scouts() + rounds * of_each_round + nulls; }
    std::uint64_t total(std::size_t causes) const { return healthy() + causes * of_each_cause; }
    /// Of a campaign: 0 scouts, then the rounds, then all others.
    std::uint64_t round(std::uint64_t number) const;
    /// First campaign of a round.
    std::uint64_t begin_of(std::uint64_t round) const;
    /// Whose law a campaign has been given: its number among the parents of its round.
    std::uint64_t parent(std::uint64_t number) const { return (number + number / parents) % parents; }
    /// Cause and size of a campaign: those of healthy ones come first.
    std::pair<int, double> label(const std::vector<CandidateCause>& causes, std::uint64_t number) const;
};

struct CampaignEnsemble {
    std::vector<SimulatedCampaign> campaigns; ///< in the order of their numbers
    std::vector<double> distance;             ///< (campaigns) of their laws from the measured one (`LawLikeness`)
    SimulationCount cost;
    std::uint64_t cached = 0; ///< campaigns that the file had
    bool complete = false;    ///< false: the observer stopped it
};

/// Numbers of a campaign.
using NumbersOf = std::function<std::vector<double>(const SimulatedCampaign&)>;
/// From the pairs of campaigns of one law; arguments as those of `LawLikeness`.
LawLikeness likeness_of(const EnsemblePlan& plan, const std::vector<SimulatedCampaign>& rows, const NumbersOf& numbers,
                        double kept);

/// @throws InputError if there is a file that keeps something else: it would be overwritten
void refuse_foreign_cache(const std::filesystem::path& cache);

/// @param known    causes that act in every campaign: what direct tests found and no correction takes away
/// @param shown    numbers and scores of the measured campaign
/// @param cache    file that keeps the rows; nullopt: none
/// @param progress called with (campaigns done, campaigns in all)
CampaignEnsemble simulate_ensemble(const Campaign& measured, const Study& study,
                                   const std::vector<CandidateCause>& causes, const std::vector<SizedCause>& known,
                                   const EnsemblePlan& plan, const SimulatedCampaign& shown,
                                   const std::optional<std::filesystem::path>& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer);

} // namespace stylobate
