#include "studies/measured/diagnosis/campaigns/ensemble_verdict.hpp"

#include "ensemble/numerics/in_parallel.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>

namespace stylobate {

namespace {

/// Fewer labelled campaigns than these do not show a shift.
constexpr Eigen::Index least_labelled = 3;
Eigen::Index largest(const std::vector<CauseLikelihood>& causes)
{
    const auto at =
        std::max_element(causes.begin(), causes.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; });
    return at - causes.begin();
}

CampaignTable rows_of(const CampaignTable& table, const std::vector<Eigen::Index>& rows)
{
    return {table.descriptors(rows, Eigen::all), table.statistics(rows, Eigen::all)};
}

/// A fit without one fold of the healthy and of the labelled campaigns; fold -1: with all.
class Fit {
public:
    Fit(const EnsembleEvidence& evidence, const std::vector<bool>& wanted, bool contrasts, int left_out)
        : mechanism_(evidence.mechanism)
    {
        std::vector<Eigen::Index> nulls;
        std::vector<double> weights;
        for (Eigen::Index i = 0; i < evidence.nulls.statistics.rows(); ++i)
            if (evidence.null_fold[static_cast<std::size_t>(i)] != left_out) {
                nulls.push_back(i);
                weights.push_back(evidence.likeness.empty() ? 1 : evidence.likeness[static_cast<std::size_t>(i)]);
            }
        law_ = std::make_unique<LawAdjustment>(
            rows_of(evidence.nulls, nulls),
            Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size())), wanted,
            evidence.least_scatter);

        std::map<int, std::vector<Eigen::Index>> of_cause;
        for (std::size_t i = 0; i < evidence.labelled.cause.size(); ++i)
            if (evidence.labelled_fold[i] != left_out)
                of_cause[evidence.labelled.cause[i]].push_back(static_cast<Eigen::Index>(i));
        for (const auto& [cause, rows] : of_cause) {
            if (static_cast<Eigen::Index>(rows.size()) < least_labelled)
                continue;
            Eigen::MatrixXd residuals(static_cast<Eigen::Index>(rows.size()),
                                      static_cast<Eigen::Index>(law_->used().size()));
            Eigen::VectorXd sizes(residuals.rows());
            for (Eigen::Index k = 0; k < residuals.rows(); ++k) {
                const Eigen::Index row = rows[static_cast<std::size_t>(k)];
                residuals.row(k) = residual(evidence.labelled.table, row).transpose();
                sizes(k) = evidence.labelled.size[static_cast<std::size_t>(row)];
            }
            models_.emplace_back(residuals, sizes);
            causes_.push_back(cause);
        }
        likelihood_ = std::make_unique<SyntheticLikelihood>(
            *law_, models_, contrasts ? common_patterns(evidence.common) : Eigen::MatrixXd());
    }

    Eigen::VectorXd residual(const CampaignTable& table, Eigen::Index row) const
    {
        return residual(table.descriptors.row(row), table.statistics.row(row));
    }
    Eigen::VectorXd residual(const Eigen::VectorXd& descriptors, const Eigen::VectorXd& statistics) const
    {
        return law_->decorrelated(law_->residual(descriptors, statistics));
    }
    const LawAdjustment& law() const { return *law_; }
    const SyntheticLikelihood& likelihood() const { return *likelihood_; }
    const std::vector<ShiftModel>& models() const { return models_; }
    const std::vector<int>& causes() const { return causes_; } ///< candidate of each model
    int mechanism(Eigen::Index model) const
    {
        return mechanism_[static_cast<std::size_t>(causes_[static_cast<std::size_t>(model)])];
    }

    /// Mechanisms by their largest gain, the best first; none of gain 0.
    std::vector<std::pair<double, int>> ranking(const std::vector<CauseLikelihood>& found) const
    {
        std::map<int, double> most;
        for (Eigen::Index m = 0; m < static_cast<Eigen::Index>(found.size()); ++m) {
            double& gain = most.try_emplace(mechanism(m), 0).first->second;
            gain = std::max(gain, found[static_cast<std::size_t>(m)].gain);
        }
        std::vector<std::pair<double, int>> order;
        for (const auto& [mechanism, gain] : most)
            if (gain > 0)
                order.emplace_back(gain, mechanism);
        std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        return order;
    }
    /// How far these mechanisms are before all others together [nats].
    double lead(const std::vector<CauseLikelihood>& found, const std::set<int>& of) const
    {
        constexpr double most = 300;
        double sum = 0, others = 1; // none of them
        for (Eigen::Index m = 0; m < static_cast<Eigen::Index>(found.size()); ++m)
            (of.contains(mechanism(m)) ? sum : others) +=
                std::exp(std::min(found[static_cast<std::size_t>(m)].gain, most));
        return std::log(sum) - std::log(others);
    }
    /// The best mechanism and those that are hardly behind it.
    std::set<int> nearest(const std::vector<CauseLikelihood>& found, const EnsembleRule& rule) const
    {
        const auto order = ranking(found);
        std::set<int> out;
        for (const auto& [gain, mechanism] : order)
            if (out.size() <= static_cast<std::size_t>(rule.rivals) && gain > order.front().first - rule.apart)
                out.insert(mechanism);
        return out;
    }

private:
    /// Of each group of statistics that a law shifts alike, the direction in which all of them move together.
    Eigen::MatrixXd common_patterns(const std::vector<int>& group) const
    {
        std::map<int, std::vector<Eigen::Index>> members;
        for (std::size_t k = 0; k < law_->used().size(); ++k)
            if (const int g = group[static_cast<std::size_t>(law_->used()[k])]; g >= 0)
                members[g].push_back(static_cast<Eigen::Index>(k));
        Eigen::MatrixXd patterns = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(members.size()),
                                                         static_cast<Eigen::Index>(law_->used().size()));
        Eigen::Index row = 0;
        for (const auto& [g, columns] : members) {
            for (const Eigen::Index column : columns)
                patterns(row, column) = 1 / std::sqrt(static_cast<double>(columns.size()));
            ++row;
        }
        return patterns;
    }

    std::vector<int> mechanism_;
    std::unique_ptr<LawAdjustment> law_;
    std::vector<ShiftModel> models_;
    std::vector<int> causes_;
    std::unique_ptr<SyntheticLikelihood> likelihood_;
};

/// What the campaigns that were left out of a fit were taken for.
struct LeftOut {
    std::vector<double> null_gains, null_weights;
    std::vector<CalibratedProbability::Case> named; ///< labelled ones: lead, and whether right
    std::vector<CalibratedProbability::Case>
        near;                ///< lead of the best and its nearest rivals together, and whether right
    std::vector<bool> right; ///< (labelled) named, with the right mechanism
    std::map<std::pair<int, int>, double> taken; ///< (true mechanism, named mechanism)
    std::map<int, double> labelled_of;           ///< mechanism: in all
};

void look_at_nulls(const EnsembleEvidence& evidence, const Fit& fit, int fold, LeftOut& out)
{
    for (Eigen::Index i = 0; i < evidence.nulls.statistics.rows(); ++i) {
        if (evidence.null_fold[static_cast<std::size_t>(i)] != fold)
            continue;
        const auto found = fit.likelihood().of(fit.residual(evidence.nulls, i));
        out.null_gains.push_back(found[static_cast<std::size_t>(largest(found))].gain);
        out.null_weights.push_back(evidence.likeness.empty() ? 1 : evidence.likeness[static_cast<std::size_t>(i)]);
    }
}

/// @param is_named largest gain -> whether its cause is named
void look_at_labelled(const EnsembleEvidence& evidence, const EnsembleRule& rule, const Fit& fit, int fold,
                      LeftOut& out, const std::function<bool(double)>& is_named)
{
    const LabelledCampaigns& labelled = evidence.labelled;
    for (std::size_t i = 0; i < labelled.cause.size(); ++i) {
        if (evidence.labelled_fold[i] != fold)
            continue;
        const Eigen::VectorXd residual = fit.residual(labelled.table, static_cast<Eigen::Index>(i));
        const auto found = fit.likelihood().of(residual);
        const Eigen::Index best = largest(found);
        const CauseLikelihood& cause = found[static_cast<std::size_t>(best)];
        const int truth = evidence.mechanism[static_cast<std::size_t>(labelled.cause[i])];
        const bool named = is_named(cause.gain);
        const bool right = fit.mechanism(best) == truth;
        out.right[i] = named && right;
        if (!named)
            continue;
        out.named.push_back({fit.lead(found, {fit.mechanism(best)}), right});
        const std::set<int> near = fit.nearest(found, rule);
        out.near.push_back({fit.lead(found, near), near.contains(truth)});
        out.taken[{truth, fit.mechanism(best)}] += 1;
        out.labelled_of[truth] += 1;
    }
}

std::vector<bool> finite(const Eigen::VectorXd& values)
{
    std::vector<bool> out;
    for (const double value : values)
        out.push_back(std::isfinite(value));
    return out;
}

} // namespace

EnsembleVerdict ensemble_verdict(const EnsembleEvidence& evidence, const EnsembleRule& rule)
{
    EnsembleVerdict out;
    out.causes.resize(evidence.mechanism.size());
    out.labelled_right.assign(evidence.labelled.cause.size(), false);
    out.contrasts = evidence.law_p_value < rule.outside;
    const std::vector<bool> wanted = finite(evidence.statistics);
    const Fit fit(evidence, wanted, out.contrasts, -1);
    out.used = fit.law().used();
    out.residual = fit.residual(evidence.descriptors, evidence.statistics);
    if (fit.models().empty())
        return out;
    const auto found = fit.likelihood().of(out.residual);
    for (std::size_t m = 0; m < found.size(); ++m)
        out.causes[static_cast<std::size_t>(fit.causes()[m])] = found[m];
    const Eigen::Index best = largest(found);
    const CauseLikelihood& cause = found[static_cast<std::size_t>(best)];
    out.best = fit.causes()[static_cast<std::size_t>(best)];
    out.shift = fit.models()[static_cast<std::size_t>(best)].mean(cause.size);

    const int count = 1 + *std::max_element(evidence.null_fold.begin(), evidence.null_fold.end());
    std::vector<std::unique_ptr<Fit>> folds;
    LeftOut left_out;
    left_out.right.assign(evidence.labelled.cause.size(), false);
    folds.resize(static_cast<std::size_t>(count));
    in_parallel(0, count, [&](int fold) {
        folds[static_cast<std::size_t>(fold)] = std::make_unique<Fit>(evidence, wanted, out.contrasts, fold);
    });
    for (int fold = 0; fold < count; ++fold)
        look_at_nulls(evidence, *folds[static_cast<std::size_t>(fold)], fold, left_out);
    const auto chance = [&](double gain) {
        return conformal_p_value(left_out.null_gains, gain, left_out.null_weights);
    };
    const auto is_named = [&](double gain) { return chance(gain) <= rule.named; };
    for (int fold = 0; fold < count; ++fold)
        look_at_labelled(evidence, rule, *folds[static_cast<std::size_t>(fold)], fold, left_out, is_named);

    out.null_gains = left_out.null_gains;
    out.null_weights = left_out.null_weights;
    out.p_value = chance(cause.gain);
    out.named = is_named(cause.gain);
    out.probability = CalibratedProbability(left_out.named)(fit.lead(found, {fit.mechanism(best)}));
    out.set_probability =
        std::max(out.probability, CalibratedProbability(left_out.near)(fit.lead(found, fit.nearest(found, rule))));
    out.labelled_right = left_out.right;

    const int mechanism = fit.mechanism(best);
    for (const auto& [gain, other] : fit.ranking(found)) {
        if (other == mechanism)
            continue;
        const auto taken = left_out.taken.find({other, mechanism});
        const bool confused = taken != left_out.taken.end() &&
                              taken->second > rule.confused * left_out.labelled_of.at(other) &&
                              gain > cause.gain - 3 * rule.apart;
        if (gain > cause.gain - rule.apart || confused)
            out.set.push_back(other);
    }

    return out;
}

} // namespace stylobate
