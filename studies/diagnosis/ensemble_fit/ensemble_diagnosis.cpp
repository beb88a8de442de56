#include "studies/diagnosis/ensemble_fit/ensemble_diagnosis.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace stylobate {

namespace {

// Where the specimen states none.
constexpr double friction_unknown = 0.7;

Eigen::VectorXd vector_of(const std::vector<double>& values)
{
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Statistics of one kind and motion, of all joints or blocks: what a common law shifts alike.
std::vector<int> common_groups(const std::vector<StatisticLabel>& labels)
{
    std::map<std::tuple<std::string, int, int>, int> number;
    std::vector<int> groups;
    for (const StatisticLabel& label : labels)
        groups.push_back(
            number.try_emplace({label.name, label.motion, label.side}, static_cast<int>(number.size())).first->second);
    return groups;
}

/// Keeps the descriptors that the measured campaign and most others have; where one is missing it is the median.
void complete_descriptors(EnsembleEvidence& evidence)
{
    constexpr double least_share = 0.9;
    const Eigen::MatrixXd& nulls = evidence.nulls.descriptors;
    std::vector<Eigen::Index> kept;
    Eigen::VectorXd middle(nulls.cols());
    for (Eigen::Index k = 0; k < nulls.cols(); ++k) {
        std::vector<double> known;
        for (const double value : nulls.col(k))
            if (std::isfinite(value))
                known.push_back(value);
        if (std::isfinite(evidence.descriptors(k)) &&
            static_cast<double>(known.size()) >= least_share * static_cast<double>(nulls.rows())) {
            kept.push_back(k);
            middle(k) = upper_median(std::move(known));
        }
    }
    const auto complete = [&](Eigen::MatrixXd& table) {
        for (const Eigen::Index k : kept)
            for (double& value : table.col(k))
                value = std::isfinite(value) ? value : middle(k);
        table = table(Eigen::all, kept).eval();
    };
    complete(evidence.labelled.table.descriptors);
    complete(evidence.nulls.descriptors);
    complete(evidence.law_descriptors);
    evidence.descriptors = evidence.descriptors(kept).eval();
}

} // namespace

int EnsembleDiagnosis::mechanism_of(std::size_t cause) const
{
    const auto at = std::find(mechanisms.begin(), mechanisms.end(), causes[cause].cause.mechanism);
    return static_cast<int>(at - mechanisms.begin());
}

JointPaths joint_paths(const Campaign& campaign, const TrackScales& scales,
                       const std::vector<std::vector<double>>& base_m)
{
    const std::size_t joints = campaign.specimen.joints.size();
    JointPaths paths{std::vector<double>(joints, 0), std::vector<double>(joints, 0)};
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        const Track track(campaign.specimen, campaign.runs[r], scales, base_m[r]);
        for (std::size_t j = 0; j < joints; ++j) {
            const int lower = campaign.specimen.joints[j].first, upper = campaign.specimen.joints[j].second;
            double slip = 0, turn = 0;
            for (std::size_t i = 1; i < track.samples(); ++i) {
                if (!track.usable(i, 1))
                    continue;
                const auto relative = [&](Component c) {
                    const double below = lower >= 0 ? track.now(1, c, lower, i) : c == in_x ? track.base(1, i) : 0;
                    return track.now(1, c, upper, i) - below;
                };
                const double dt = track.time_s(i) - track.time_s(i - 1);
                if (std::fabs(relative(in_x)) > scales.slip_m_s)
                    slip += std::fabs(relative(in_x)) * dt;
                turn += std::fabs(relative(in_theta)) * dt;
            }
            paths.slip_m[j] += slip / static_cast<double>(campaign.runs.size());
            paths.rotation_rad[j] += turn / static_cast<double>(campaign.runs.size());
        }
    }
    return paths;
}

EnsembleDiagnosis ensemble_diagnosis(const Campaign& campaign, const Study& study, const TrackScales& scales,
                                     const std::vector<std::vector<double>>& base_m, const EnsemblePlan& plan,
                                     const std::filesystem::path& cache, const RunOptions& options,
                                     const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                     Observer& observer)
{
    EnsembleDiagnosis out;
    const double friction = campaign.specimen.friction_nominal.value_or(friction_unknown);
    out.causes = candidate_causes(campaign.specimen, scales, joint_paths(campaign, scales, base_m), friction);
    for (const CandidateCause& cause : out.causes)
        if (std::find(out.mechanisms.begin(), out.mechanisms.end(), cause.cause.mechanism) == out.mechanisms.end())
            out.mechanisms.push_back(cause.cause.mechanism);
    out.statistics = statistic_labels(campaign);
    out.descriptors = descriptor_labels(campaign);
    out.measured = statistics_of(campaign, scales, base_m);
    out.ensemble = simulate_ensemble(campaign, study, out.causes, plan, out.measured.descriptors, cache, options,
                                     progress, observer);
    if (!out.ensemble.complete)
        return out;
    EnsembleEvidence evidence;
    evidence.nulls = out.ensemble.nulls(plan);
    evidence.labelled = out.ensemble.labelled();
    for (std::size_t c = 0; c < out.causes.size(); ++c)
        evidence.mechanism.push_back(out.mechanism_of(c));
    // a part is the neighbourhood of one law: what is left out is a law that the fit has not seen
    for (const SimulatedCampaign& row : out.ensemble.campaigns)
        if (row.number >= plan.scouts)
            (row.cause < 0 ? evidence.null_fold : evidence.labelled_fold)
                .push_back(static_cast<int>(plan.parent(row.number)));
    evidence.common = common_groups(out.statistics);
    evidence.descriptors = vector_of(out.measured.descriptors);
    evidence.statistics = vector_of(out.measured.values);
    evidence.law_descriptors = out.ensemble.scouts(plan).descriptors;
    complete_descriptors(evidence);
    out.verdict = ensemble_verdict(evidence);
    return out;
}

} // namespace stylobate
