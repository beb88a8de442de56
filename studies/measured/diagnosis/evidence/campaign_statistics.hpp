#pragma once
/// A campaign as at most 200 numbers, and what its healthy contact law does to all joints as a dozen more.
///
/// Rocking is chaotic, path integrals are not: repeats of one motion differ by a few per cent in the slip path of a
/// joint. So a campaign is described by sums over whole runs, and not by histories. The statistics are of single joints
/// and blocks; contrasts between them are left to those who compare campaigns.
///
/// Of each joint and motion (mean over the repeats of a motion):
///
///   slip_path          ln of the slip path over the half width
///   rotation_path      ln of the path of the relative rotation, over the slenderness
///   half_ratio         ln of the slip path of the second half of the run over that of the first
///   rotation_rms       ln of the root mean square of the relative rotation, over the slenderness
///   net_slip           signed slip from the beginning to the end, over the half width
///   closure_speed      ln of the rotation speed after a closure over that before it
///   range_over_path    range of the slip over its path
///   open_time          part of the time, by side
///   turning_offset     how far inside the corner the joint turns, over the half width, by side
///   friction           sum of -T ds over sum of N |ds| of all slips ds; also friction_slow, _medium, _fast by slip
///   speed
///                      (columns alone). Most slip happens in impacts, so that this is the joint's friction in part
///                      only
/// of each joint        order_slope: change of ln slip path with the number of runs before, within motions
/// of each joint, and so of the block on it: drag_score, eccentricity_score of all that the joint carries, from the
///                      balance of moments about its corners (columns alone)
///
/// Where these are more than 200, sums over the runs of all motions take the place of those of single motions, from
/// the last kind of the list above to the first, as far as necessary. If even that is too much, the scores and then the
/// last kinds of the list above are left out. An epistyle that turns on one seat lifts off the others: its other seats
/// are open, and count as hopping. Paths and squares are corrected for the cameras' noise
/// (`joint_sums.hpp`).

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace stylobate {

inline constexpr std::size_t most_statistics = 200;

/// What one number is. -1: not of one joint, block or motion (`motion` is a `motion_id`).
struct StatisticLabel {
    std::string name;
    int joint = -1;
    int block = -1;
    int motion = -1;
    int side = 0; ///< -1: the block turns on its left corner, 1: on its right one, 0: both
    friend bool operator==(const StatisticLabel&, const StatisticLabel&) = default;
};

struct CampaignStatistics {
    std::vector<double> values;      ///< (labels) NaN where the data do not have it
    std::vector<double> descriptors; ///< (labels) likewise
};

/// They depend on the specimen and on which motions there are, so that campaigns of one plan have the same.
std::vector<StatisticLabel> statistic_labels(const Campaign& campaign);
std::vector<StatisticLabel> descriptor_labels(const Campaign& campaign);

/// @param base_m (runs)(nt) the base displacement to be used, as in `balance_evidence`; an inner one empty: not known
CampaignStatistics statistics_of(const Campaign& campaign, const CampaignScales& scales,
                                 const std::vector<std::vector<double>>& base_m);

// ---- A campaign's statistics with fewer numbers: means over motions, by joint; medians over joints, by kind.
//
// A cause acts at one joint or block: the median over the joints hardly moves with it, and shows the law that is
// common to all.

/// Which of the statistics make one number.
struct Summary {
    std::vector<StatisticLabel> labels;           ///< what is left of the labels
    std::vector<std::vector<std::size_t>> groups; ///< (labels) indices of the statistics
};

/// Each statistic of each joint, over the motions.
Summary over_motions(const std::vector<StatisticLabel>& statistics);
/// Each kind of statistic under each motion, over the joints.
Summary over_joints(const std::vector<StatisticLabel>& statistics);

/// Mean of each group over those that are there; NaN: none.
std::vector<double> means(const Summary& summary, const std::vector<double>& values);
/// Median likewise.
std::vector<double> medians(const Summary& summary, const std::vector<double>& values);

} // namespace stylobate
