#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/campaigns/conformal.hpp"
#include "studies/measured/diagnosis/campaigns/evidence_rows.hpp"
#include "studies/measured/diagnosis/campaigns/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace stylobate {

namespace {

// The unit of a score is this quantile of its size in healthy campaigns,
constexpr double unit_quantile = 0.9;
// together with a score that noise alone gives. Healthy campaigns that do not show a variant count with 0: that a joint
// slides where it would not is what a low friction shows.
constexpr double least_unit = 0.7;
constexpr int score_parts = 6;

// Of a normal score, in standard deviations: what a unit is.
constexpr double unit_sd = 1.6449;

double weighted_quantile(std::vector<std::pair<double, double>> weighted, double part)
{
    std::sort(weighted.begin(), weighted.end());
    double all = 0;
    for (const auto& [value, weight] : weighted)
        all += weight;
    double below = 0;
    for (const auto& [value, weight] : weighted) {
        below += weight;
        if (below >= part * all)
            return value;
    }
    return weighted.back().first;
}

class Units {
public:
    /// @param left_out every `score_parts`-th campaign from here is left out; -1: none is
    Units(const ForceEvidence& evidence, int left_out)
    {
        for (Eigen::Index v = 0; v < evidence.nulls.cols(); ++v) {
            std::vector<std::pair<double, double>> sizes;
            for (Eigen::Index i = 0; i < evidence.nulls.rows(); ++i) {
                if (left_out >= 0 && i % score_parts == left_out)
                    continue;
                const double weight = evidence.likeness.empty() ? 1 : evidence.likeness[static_cast<std::size_t>(i)];
                const double size = std::fabs(evidence.nulls(i, v));
                sizes.emplace_back(std::isfinite(size) ? size : 0, weight);
            }
            unit_.push_back(std::hypot(weighted_quantile(std::move(sizes), unit_quantile), least_unit));
        }
    }

    double score(const Eigen::VectorXd& scores, std::size_t variant) const
    {
        const double value = scores(static_cast<Eigen::Index>(variant)) / unit_[variant];
        return std::isfinite(value) ? std::fabs(value) : 0;
    }

    ForceTest largest(const Eigen::VectorXd& scores) const
    {
        ForceTest out;
        for (std::size_t v = 0; v < unit_.size(); ++v)
            if (const double s = score(scores, v); s > out.score) {
                out.score = s;
                out.variant = static_cast<int>(v);
            }
        return out;
    }

    const std::vector<double>& each() const { return unit_; }

private:
    std::vector<double> unit_;
};

} // namespace

double nats_of_score(double score)
{
    return 0.5 * std::pow(unit_sd * score, 2);
}

ForceTest force_test(const ForceEvidence& evidence)
{
    const Units all(evidence, -1);
    ForceTest out = all.largest(evidence.campaign);
    out.unit = all.each();
    out.likeness = evidence.likeness;
    std::vector<Units> without;
    for (int part = 0; part < score_parts; ++part)
        without.emplace_back(evidence, part);
    for (Eigen::Index i = 0; i < evidence.nulls.rows(); ++i)
        out.nulls.push_back(without[static_cast<std::size_t>(i % score_parts)].largest(evidence.nulls.row(i)).score);
    out.p_value = conformal_p_value(out.nulls, out.score, evidence.likeness);
    return out;
}

namespace {

/// Statistics of one kind, of all joints or blocks: what a common law shifts alike.
std::vector<int> common_groups(const std::vector<StatisticLabel>& labels)
{
    std::map<std::pair<std::string, int>, int> number;
    std::vector<int> groups;
    for (const StatisticLabel& label : labels)
        groups.push_back(number.try_emplace({label.name, label.side}, static_cast<int>(number.size())).first->second);
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
    evidence.descriptors = evidence.descriptors(kept).eval();
}

/// Weight of a healthy campaign for the measured one: the nearer half of them count in full.
std::vector<double> weights_of(const std::vector<double>& distance)
{
    const double middle = upper_median(distance);
    std::vector<double> out;
    for (const double d : distance)
        out.push_back(d > middle ? std::pow(middle / d, 2) : 1);
    return out;
}

/// Test of the scores of `count` causes or forces, from `first` on.
ForceTest score_test(const std::vector<const SimulatedCampaign*>& nulls, const std::vector<double>& likeness,
                     const std::vector<double>& measured, std::size_t first, std::size_t count)
{
    const auto part = [&](const std::vector<double>& scores) -> Eigen::VectorXd {
        return vector_of(scores).segment(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    };
    ForceEvidence evidence;
    evidence.nulls.resize(static_cast<Eigen::Index>(nulls.size()), static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < nulls.size(); ++i)
        evidence.nulls.row(static_cast<Eigen::Index>(i)) = part(nulls[i]->scores).transpose();
    evidence.likeness = likeness;
    evidence.campaign = part(measured);
    return force_test(evidence);
}

/// Where the shift of the best cause and what is measured agree most.
Eigen::Index carrying_column(const EnsembleVerdict& verdict)
{
    Eigen::Index most = 0;
    verdict.shift.cwiseProduct(verdict.residual).maxCoeff(&most);
    return verdict.used[static_cast<std::size_t>(most)];
}

void find_carrying_number(const EnsembleEvidence& evidence, EnsembleDiagnosis& out)
{
    const EnsembleVerdict& verdict = out.by_statistics;
    if (verdict.best < 0)
        return;
    const Eigen::Index column = carrying_column(verdict);
    const Cause& best = out.causes[static_cast<std::size_t>(verdict.best)].cause;
    out.carrying.measured = evidence.statistics(column);
    for (const double value : evidence.nulls.statistics.col(column))
        out.carrying.add_healthy(value);
    for (std::size_t i = 0; i < evidence.labelled.cause.size(); ++i) {
        const CandidateCause& candidate = out.causes[static_cast<std::size_t>(evidence.labelled.cause[i])];
        const Cause& c = candidate.cause;
        if (c.mechanism == best.mechanism && c.place == best.place && c.side == best.side &&
            c.persists == best.persists)
            out.carrying.add_labelled(candidate.size_of(evidence.labelled.size[i]),
                                      evidence.labelled.table.statistics(static_cast<Eigen::Index>(i), column));
    }
    const StatisticLabel& label = out.evidence[static_cast<std::size_t>(column)];
    out.carrying.text = label.name + (label.block >= 0   ? fmt::format(" of block {}", label.block)
                                      : label.joint >= 0 ? fmt::format(" of joint {}", label.joint)
                                                         : "");
}

// Of the numbers of a law: a cause moves some of them.
constexpr double law_kept = 0.75;

/// Of the measured law, among those of the healthy campaigns.
double law_p_value(const EnsembleDiagnosis& diagnosis, const EnsemblePlan& plan)
{
    const std::vector<StatisticLabel>& labels = diagnosis.statistics;
    const std::vector<SimulatedCampaign>& rows = diagnosis.ensemble.campaigns;
    std::vector<std::vector<double>> nulls;
    for (std::uint64_t i = plan.scouts(); i < plan.healthy(); ++i)
        nulls.push_back(law_numbers(labels, rows[i].numbers));
    const NumbersOf of_law = [&](const SimulatedCampaign& row) { return law_numbers(labels, row.numbers); };
    return isolation_p_value(likeness_of(plan, rows, of_law, law_kept), nulls, law_numbers(labels, diagnosis.measured));
}

/// All but the simulated campaigns and the verdicts.
EnsembleDiagnosis what_is_measured(const Campaign& campaign, const Study& study, const CampaignScales& scales,
                                   const std::vector<std::vector<double>>& base_m)
{
    EnsembleDiagnosis out;
    const double friction = nominal_friction(campaign.specimen);
    out.causes = candidate_causes(campaign.specimen, scales, joint_paths(campaign, scales, base_m), friction,
                                  study.contact.normal_stiffness_n_m2);
    for (const CandidateCause& cause : out.causes)
        if (std::find(out.mechanisms.begin(), out.mechanisms.end(), cause.cause.mechanism) == out.mechanisms.end())
            out.mechanisms.push_back(cause.cause.mechanism);
    out.statistics = statistic_labels(campaign);
    out.measured = statistics_of(campaign, scales, base_m);
    out.scored = score_plan(campaign.specimen, scales);
    out.scores = balance_scores(fit_balance(campaign, scales, base_m), out.scored);
    return out;
}

/// The verdicts, from the simulated campaigns.
void judge(const EnsemblePlan& plan, EnsembleDiagnosis& out)
{
    std::vector<const SimulatedCampaign*> nulls, labelled;
    std::vector<double> distance;
    EnsembleEvidence evidence;
    for (std::size_t i = 0; i < out.ensemble.campaigns.size(); ++i) {
        const SimulatedCampaign& row = out.ensemble.campaigns[i];
        if (row.number < plan.scouts())
            continue;
        // a part is the neighbourhood of one law: what is left out is a law that the fit has not seen
        const auto fold = static_cast<int>(plan.parent(row.number));
        if (row.cause < 0) {
            nulls.push_back(&row);
            distance.push_back(out.ensemble.distance[i]);
            evidence.null_fold.push_back(fold);
        } else {
            labelled.push_back(&row);
            evidence.labelled_fold.push_back(fold);
            evidence.labelled.cause.push_back(row.cause);
            evidence.labelled.size.push_back(row.z);
        }
    }
    for (const CandidateCause& cause : out.causes)
        evidence.mechanism.push_back(out.mechanism_of(cause.cause));
    const EvidenceRows rows(out.statistics, out.scored);
    out.evidence = rows.labels;
    evidence.nulls = rows.table(nulls);
    evidence.likeness = weights_of(distance);
    evidence.labelled.table = rows.table(labelled);
    evidence.common = common_groups(rows.labels);
    evidence.least_scatter = rows.least_scatter;
    evidence.descriptors = vector_of(rows.descriptors(out.measured));
    evidence.statistics = vector_of(rows.statistics(out.measured, out.scores));
    out.law_p_value = evidence.law_p_value = law_p_value(out, plan);
    complete_descriptors(evidence);
    out.by_statistics = ensemble_verdict(evidence);

    const std::size_t causes = out.scored.causes.size(), structures = out.scored.structures.size();
    out.listed = score_test(nulls, evidence.likeness, out.scores, 0, causes);
    out.forces = score_test(nulls, evidence.likeness, out.scores, causes, structures);
    find_carrying_number(evidence, out);
}

} // namespace

int EnsembleDiagnosis::mechanism_of(const Cause& cause) const
{
    const auto at = std::find(mechanisms.begin(), mechanisms.end(), cause.mechanism);
    return static_cast<int>(at - mechanisms.begin());
}

std::optional<double> EnsembleDiagnosis::power(int mechanism, double least_z) const
{
    double right = 0, all = 0;
    std::size_t i = 0;
    for (const SimulatedCampaign& row : ensemble.campaigns) {
        if (row.cause < 0)
            continue;
        if (mechanism_of(causes[static_cast<std::size_t>(row.cause)].cause) == mechanism &&
            std::fabs(row.z) >= least_z) {
            all += 1;
            right += by_statistics.labelled_right[i] ? 1 : 0;
        }
        ++i;
    }
    return all > 0 ? std::optional(right / all) : std::nullopt;
}

EnsembleDiagnosis ensemble_diagnosis(const Campaign& campaign, const Study& study, const CampaignScales& scales,
                                     const std::vector<SizedCause>& known,
                                     const std::vector<std::vector<double>>& base_m, const EnsemblePlan& plan,
                                     const std::optional<std::filesystem::path>& cache, const RunOptions& options,
                                     const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                     Observer& observer)
{
    EnsembleDiagnosis out = what_is_measured(campaign, study, scales, base_m);
    out.ensemble =
        simulate_ensemble(campaign, study, out.causes, known, plan, {.numbers = out.measured, .scores = out.scores},
                          cache, options, progress, observer);
    if (out.ensemble.complete)
        judge(plan, out);
    return out;
}

} // namespace stylobate
