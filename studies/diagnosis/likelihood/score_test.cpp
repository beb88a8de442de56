#include "studies/diagnosis/likelihood/score_test.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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
    Units(const ScoreEvidence& evidence, int left_out) : variants_(evidence.variants)
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
        const int sign = variants_.sign[variant];
        return !std::isfinite(value) ? 0 : sign == 0 ? std::fabs(value) : std::max(0.0, sign * value);
    }

    /// @param wanted says of a mechanism's number whether it counts
    template <class Wanted>
    LargestScore largest(const Eigen::VectorXd& scores, Wanted&& wanted) const
    {
        LargestScore out;
        for (std::size_t v = 0; v < unit_.size(); ++v)
            if (wanted(variants_.mechanism[v]))
                if (const double s = score(scores, v); s > out.score) {
                    out.score = s;
                    out.variant = static_cast<int>(v);
                }
        return out;
    }

private:
    const ScoreVariants& variants_;
    std::vector<double> unit_;
};

bool is_cause(int mechanism)
{
    return mechanism >= 0;
}

bool is_unknown(int mechanism)
{
    return mechanism < 0;
}

/// The best of the mechanisms whose scores are within some nats of the largest: the one that has most support beside.
LargestScore supported(const Units& units, const Eigen::VectorXd& scores, const Eigen::VectorXd& support, double apart)
{
    const LargestScore largest = units.largest(scores, is_cause);
    LargestScore best = largest;
    double most = -HUGE_VAL;
    for (Eigen::Index m = 0; m < support.size(); ++m) {
        const LargestScore of = units.largest(scores, [&](int mechanism) { return mechanism == m; });
        if (of.variant < 0 || nats_of_score(largest.score) - nats_of_score(of.score) > apart)
            continue;
        const double all = nats_of_score(of.score) + support(m);
        if (all > most) {
            most = all;
            best = of;
        }
    }
    return best;
}

/// How far the best mechanism is before the next one.
double lead(const Units& units, const Eigen::VectorXd& scores, double best, int mechanism)
{
    const double next = units.largest(scores, [&](int m) { return m >= 0 && m != mechanism; }).score;
    return nats_of_score(best) - nats_of_score(next);
}

} // namespace

double nats_of_score(double score)
{
    return 0.5 * std::pow(unit_sd * score, 2);
}

ScoreVerdict score_test(const ScoreEvidence& evidence, const EnsembleRule& rule)
{
    ScoreVerdict out;
    out.labelled_right.assign(evidence.labelled_mechanism.size(), false);
    out.likeness = evidence.likeness;
    const Units units(evidence, -1);
    for (std::size_t v = 0; v < evidence.variants.mechanism.size(); ++v)
        out.scores.push_back(units.score(evidence.campaign, v));
    const double largest = units.largest(evidence.campaign, is_cause).score;
    out.cause = supported(units, evidence.campaign, evidence.support, rule.apart);
    out.unknown = units.largest(evidence.campaign, is_unknown);
    std::vector<Units> without;
    for (int part = 0; part < score_parts; ++part)
        without.emplace_back(evidence, part);
    for (Eigen::Index i = 0; i < evidence.nulls.rows(); ++i) {
        const Units& others = without[static_cast<std::size_t>(i % score_parts)];
        const Eigen::VectorXd scores = evidence.nulls.row(i);
        out.cause.nulls.push_back(others.largest(scores, is_cause).score);
        out.unknown.nulls.push_back(others.largest(scores, is_unknown).score);
    }
    const auto chance = [&](const LargestScore& largest, double score) {
        return conformal_p_value(largest.nulls, evidence.likeness, score);
    };
    out.cause.p_value = chance(out.cause, largest);
    out.unknown.p_value = chance(out.unknown, out.unknown.score);
    if (out.cause.variant < 0)
        return out;
    const int mechanism = evidence.variants.mechanism[static_cast<std::size_t>(out.cause.variant)];
    out.named = out.cause.p_value <= rule.named;

    std::vector<CalibratedProbability::Case> cases;
    std::map<int, std::map<int, double>> taken_for; // true mechanism: named one
    std::map<int, double> named_of;                 // true mechanism
    for (Eigen::Index i = 0; i < evidence.labelled.rows(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Eigen::VectorXd scores = evidence.labelled.row(i);
        const LargestScore most = units.largest(scores, is_cause);
        if (most.variant < 0 || chance(out.cause, most.score) > rule.named)
            continue;
        const Eigen::VectorXd support =
            evidence.support.size() > 0 ? Eigen::VectorXd(evidence.labelled_support.row(i)) : Eigen::VectorXd();
        const LargestScore best = supported(units, scores, support, rule.apart);
        const int said = evidence.variants.mechanism[static_cast<std::size_t>(best.variant)];
        const bool is_right = said == evidence.labelled_mechanism[k];
        out.labelled_right[k] = is_right;
        cases.push_back({lead(units, scores, best.score, said), is_right});
        taken_for[evidence.labelled_mechanism[k]][said] += 1;
        named_of[evidence.labelled_mechanism[k]] += 1;
    }
    out.probability = CalibratedProbability(cases)(lead(units, evidence.campaign, out.cause.score, mechanism));

    std::set<int> rivals;
    for (std::size_t v = 0; v < out.scores.size(); ++v) {
        const int other = evidence.variants.mechanism[v];
        if (other < 0 || other == mechanism)
            continue;
        const double behind = nats_of_score(out.cause.score) - nats_of_score(out.scores[v]);
        const bool confused = named_of[other] > 0 && taken_for[other][mechanism] > rule.confused * named_of[other];
        if (behind < rule.apart || (confused && behind < 3 * rule.apart))
            rivals.insert(other);
    }
    out.set.assign(rivals.begin(), rivals.end());
    return out;
}

} // namespace stylobate
