#include "studies/measured/diagnosis/campaigns/evidence_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace stylobate {

namespace {

/// A score as a statistic: forces that no law has make heavy tails. A campaign that does not show the cause has 0: that
/// a joint slides where it would not says something, too.
double tamed(double score)
{
    return std::isfinite(score) ? std::asinh(score) : 0;
}
// Of noise alone a score scatters by 1; where healthy campaigns hardly show it, that of a tamed one is taken as this.
constexpr double tamed_scatter = 0.5;

/// Causes whose scores are statistics beside those of whole runs: one of each mechanism, place and side. Their second
/// parameters and wear that goes on are left to the test of the scores.
std::vector<std::size_t> scores_among_statistics(const std::vector<Cause>& causes)
{
    std::map<std::tuple<std::string, std::string, std::optional<std::string>>, std::vector<std::size_t>> of;
    for (std::size_t c = 0; c < causes.size(); ++c)
        if (!causes[c].persists && !(causes[c].mechanism == "corner_loss" && !causes[c].side))
            of[{causes[c].mechanism, causes[c].place, causes[c].side}].push_back(c);
    std::vector<std::size_t> chosen;
    for (const auto& [key, variants] : of)
        chosen.push_back(variants[std::get<0>(key) == "stribeck" ? variants.size() / 2 : 0]);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

/// Forces of no known kind whose scores are statistics: those that labelled campaigns are simulated with
/// (`candidate_causes`), so that they are told from causes by what the balance of forces says.
bool among_statistics(const Structure& s)
{
    if (s.friction || s.block < 0)
        return false;
    return s.coordinate == "x" ? s.depends_on == "velocity" || s.depends_on == "position"
                               : s.coordinate == "theta" && s.depends_on == "angular velocity";
}

} // namespace

EvidenceRows::EvidenceRows(const std::vector<StatisticLabel>& statistics, const ScorePlan& scored)
    : joints_(over_motions(statistics)), law_(over_joints(statistics)), scores_(scores_among_statistics(scored.causes))
{
    labels = joints_.labels;
    least_scatter.assign(labels.size(), 0);
    for (const std::size_t c : scores_) {
        const Cause& cause = scored.causes[c];
        labels.push_back(
            {"score of " + cause.mechanism + (cause.side ? ", " + *cause.side : ""), cause.joint, cause.block, -1, 0});
    }
    for (std::size_t s = 0; s < scored.structures.size(); ++s) {
        const Structure& structure = scored.structures[s];
        if (!among_statistics(structure))
            continue;
        scores_.push_back(scored.causes.size() + s);
        labels.push_back({fmt::format("score of a force {} by {}", structure.coordinate, structure.depends_on), -1,
                          structure.block, -1, 0});
    }
    least_scatter.resize(labels.size(), tamed_scatter);
}

std::vector<double> EvidenceRows::statistics(const CampaignStatistics& campaign,
                                             const std::vector<double>& scores) const
{
    std::vector<double> row = means(joints_, campaign.values);
    for (const std::size_t c : scores_)
        row.push_back(tamed(scores[c]));
    return row;
}

CampaignTable EvidenceRows::table(const std::vector<const SimulatedCampaign*>& rows) const
{
    CampaignTable out;
    out.descriptors.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(law_.labels.size()));
    out.statistics.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(labels.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        out.descriptors.row(row) = vector_of(descriptors(rows[i]->numbers)).transpose();
        out.statistics.row(row) = vector_of(statistics(rows[i]->numbers, rows[i]->scores)).transpose();
    }
    return out;
}

} // namespace stylobate
