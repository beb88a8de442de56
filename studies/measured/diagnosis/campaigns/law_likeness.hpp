#pragma once
/// How unlike the healthy laws of two campaigns are, by what they do to all joints.

#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

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
    /// @param least (numbers) scatter that each has at least; empty: 0
    LawLikeness(const std::vector<std::pair<std::vector<double>, std::vector<double>>>& pairs, double kept,
                const std::vector<double>& least = {});

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

} // namespace stylobate
