#pragma once
/// A campaign's statistics with fewer numbers: means over motions, by joint; medians over joints, by kind.
///
/// A cause acts at one joint or block: the median over the joints hardly moves with it, and shows the law that is
/// common to all.

#include "studies/diagnosis/statistics/campaign_statistics.hpp"

#include <vector>

namespace stylobate {

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
