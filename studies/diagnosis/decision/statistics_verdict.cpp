#include "studies/diagnosis/decision/statistics_verdict.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr double half_width90 = 1.6449; // of a normal interval of 90 %, in standard deviations
// A force of no known kind whose score is so many times that of the best cause speaks against the cause.
constexpr double unknown_vetoes = 1.5;
// Candidates of the test by scores that are listed.
constexpr std::size_t most_listed = 20;

double quantile95(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : sorted_quantile(values, 0.95, QuantileDefinition::linear);
}

/// A candidate as the statistics judge it.
JudgedCause judged(const EnsembleDiagnosis& ensemble, std::size_t candidate, const CauseLikelihood& found)
{
    const EnsembleVerdict& verdict = ensemble.by_statistics;
    const CandidateCause& cause = ensemble.causes[candidate];
    JudgedCause j;
    j.channel = Channel::statistics;
    j.fit.cause = cause.cause;
    j.fit.size = cause.size_of(found.size);
    j.fit.sd = std::fabs(cause.size_of(found.high) - cause.size_of(found.low)) / (2 * half_width90);
    j.fit.gain = std::max(found.gain, 0.0);
    j.chance95 = quantile95(verdict.null_gains);
    j.chance = conformal_p_value(verdict.null_gains, verdict.null_weights, found.gain);
    j.surprise = found.gain - j.chance95;
    return j;
}

/// A variant as its score judges it; its size is that of the balance of forces.
JudgedCause judged(const EnsembleDiagnosis& ensemble, std::size_t variant)
{
    const ScoreVerdict& verdict = ensemble.by_scores;
    JudgedCause j;
    j.channel = Channel::balance;
    j.fit = ensemble.fits[variant];
    j.fit.gain = nats_of_score(verdict.scores[variant]);
    j.fit.gain_by_run.clear(); // those of the fit are in nats of another kind
    j.chance95 = nats_of_score(quantile95(verdict.cause.nulls));
    j.chance = conformal_p_value(verdict.cause.nulls, verdict.likeness, verdict.scores[variant]);
    j.surprise = j.fit.gain - j.chance95;
    return j;
}

bool same_place(const JudgedCause& a, const JudgedCause& b)
{
    return a.fit.cause.mechanism == b.fit.cause.mechanism && a.fit.cause.place == b.fit.cause.place;
}

/// What of the residual stands out most beside the best cause, in words.
StructureFit left_over(const EnsembleDiagnosis& ensemble)
{
    const EnsembleVerdict& verdict = ensemble.by_statistics;
    const Eigen::VectorXd left = verdict.residual - verdict.shift;
    Eigen::Index most = 0;
    left.cwiseAbs().maxCoeff(&most);
    const StatisticLabel& label =
        ensemble.evidence[static_cast<std::size_t>(verdict.used[static_cast<std::size_t>(most)])];
    StructureFit fit;
    fit.structure.block = label.block >= 0 ? label.block : label.joint;
    const bool turns =
        label.name.find("rotation") != std::string::npos || label.name.find("open") != std::string::npos ||
        label.name.find("turning") != std::string::npos || label.name.find("closure") != std::string::npos;
    fit.structure.coordinate = turns ? "theta" : "x";
    fit.structure.depends_on = label.name;
    const std::string where = label.joint >= 0   ? fmt::format("joint {}", label.joint)
                              : label.block >= 0 ? fmt::format("block {}", label.block)
                                                 : std::string("the campaign");
    fit.structure.text = fmt::format("{} of {} is {:.1f} standard deviations from what the best cause gives",
                                     label.name, where, left(most));
    fit.gain = left.squaredNorm() / 2;
    return fit;
}

/// The force of no known kind that the scores ask for most, if nothing else explains it.
std::optional<StructureFit> unknown_force(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
                                          const DecisionRule& rule, double named_at)
{
    const ScoreVerdict& scores = ensemble.by_scores;
    if (scores.unknown.variant < 0 || scores.unknown.p_value > named_at)
        return std::nullopt;
    const double gain = nats_of_score(scores.unknown.score);
    if (gain <= nats_of_score(quantile95(scores.unknown.nulls)) + rule.structure_clear ||
        gain <= nats_of_score(scores.cause.score) + rule.structure_better)
        return std::nullopt;
    const Structure& wanted =
        ensemble.scored.structures[static_cast<std::size_t>(scores.unknown.variant) - ensemble.scored.causes.size()];
    for (const StructureFit& fit : balance.structures) {
        if (fit.structure.text != wanted.text || fit.gain_by_run.size() < 2)
            continue;
        const double most = *std::max_element(fit.gain_by_run.begin(), fit.gain_by_run.end());
        if (fit.gain - most > rule.without_best * fit.gain)
            return fit;
    }
    return std::nullopt;
}

/// Whether simulated campaigns lack what a direct test found.
bool beyond_simulation(const CauseFit& fit)
{
    return fit.cause.mechanism == "drum_offset" ||
           (fit.cause.mechanism == "vertical_motion" && fit.cause.parameter != "ratio");
}

/// What the named causes of joints and blocks leave of 1 goes to those in the set, by their gains. A cause that both
/// tests put there is there once.
void share_what_remains(Decided& out)
{
    std::vector<JudgedCause> once;
    for (const JudgedCause& j : out.in_set)
        if (std::none_of(once.begin(), once.end(), [&](const JudgedCause& other) { return same_place(other, j); }))
            once.push_back(j);
    out.in_set = std::move(once);
    double left = 1, sum = 0, most = 0;
    for (const JudgedCause& j : out.named)
        if (j.channel != Channel::direct)
            left = std::min(left, 1 - j.probability);
    for (const JudgedCause& j : out.in_set)
        most = std::max(most, j.fit.gain);
    for (const JudgedCause& j : out.in_set)
        sum += std::exp(j.fit.gain - most);
    for (JudgedCause& j : out.in_set)
        j.probability = left * std::exp(j.fit.gain - most) / sum;
}

/// By the statistics: all candidates, the likeliest first; the best and its rivals are considered if they may be named.
void judge_statistics(const EnsembleDiagnosis& ensemble, Decided& out, std::vector<JudgedCause>& found)
{
    const EnsembleVerdict& verdict = ensemble.by_statistics;
    const bool probable = verdict.named && verdict.probability >= least_probability;
    for (std::size_t c = 0; c < ensemble.causes.size(); ++c) {
        JudgedCause j = judged(ensemble, c, verdict.causes[c]);
        if (static_cast<int>(c) == verdict.best) {
            j.considered = probable && matters(j.fit);
            j.probability = verdict.named ? verdict.probability : 0;
            if (!verdict.named)
                j.why_not = fmt::format("the p-value of the gain is {:.2g}", verdict.p_value);
            else if (!probable)
                j.why_not = fmt::format("possible, with a probability of {:.2f}", verdict.probability);
            else if (!j.considered)
                j.why_not = "its size is within the scatter between specimens";
            if (j.considered)
                found.push_back(j);
        } else if (const auto& set = verdict.set;
                   probable && j.fit.gain > 0 &&
                   std::find(set.begin(), set.end(), ensemble.mechanism_of(j.fit.cause)) != set.end()) {
            j.considered = true;
            out.in_set.push_back(j);
        }
        out.judged.push_back(std::move(j));
    }
    if (!found.empty() && verdict.second >= 0) {
        JudgedCause second = judged(ensemble, static_cast<std::size_t>(verdict.second), verdict.second_likelihood);
        second.considered = true;
        second.chance = verdict.second_p_value;
        second.probability = std::min(verdict.probability, 1 - verdict.second_p_value);
        found.push_back(second);
    }
}

/// The same by the scores, one of each mechanism and place.
void judge_scores(const EnsembleDiagnosis& ensemble, Decided& out, std::vector<JudgedCause>& found)
{
    const ScoreVerdict& verdict = ensemble.by_scores;
    if (verdict.cause.variant < 0)
        return;
    std::vector<std::size_t> order;
    for (std::size_t v = 0; v < ensemble.scored.causes.size(); ++v)
        if (verdict.scores[v] > 0)
            order.push_back(v);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return verdict.scores[a] > verdict.scores[b]; });
    std::vector<JudgedCause> seen;
    const bool vetoed = verdict.unknown.score > unknown_vetoes * verdict.cause.score;
    for (const std::size_t v : order) {
        if (seen.size() == most_listed)
            break;
        JudgedCause j = judged(ensemble, v);
        if (std::any_of(seen.begin(), seen.end(), [&](const JudgedCause& other) { return same_place(other, j); }))
            continue;
        const bool best = static_cast<int>(v) == verdict.cause.variant;
        const bool probable = verdict.named && verdict.probability >= least_probability;
        if (best) {
            j.probability = verdict.named ? verdict.probability : 0;
            j.considered = probable && !vetoed;
            if (!verdict.named)
                j.why_not = fmt::format("the p-value of the score is {:.2g}", verdict.cause.p_value);
            else if (!probable)
                j.why_not = fmt::format("possible, with a probability of {:.2f}", verdict.probability);
            else if (vetoed)
                j.why_not = "a force of no known kind explains the motion better";
            if (j.considered)
                found.push_back(j);
        } else if (const auto& set = verdict.set;
                   probable && !vetoed &&
                   std::find(set.begin(), set.end(), ensemble.mechanism_of(j.fit.cause)) != set.end()) {
            j.considered = true;
            out.in_set.push_back(j);
        }
        seen.push_back(j);
    }
    // one row for each mechanism and place: the more surprising view of it
    for (JudgedCause& j : seen) {
        const auto other =
            std::find_if(out.judged.begin(), out.judged.end(), [&](const JudgedCause& o) { return same_place(o, j); });
        if (other == out.judged.end())
            out.judged.push_back(std::move(j));
        else if (j.chance < other->chance)
            *other = std::move(j);
    }
}

} // namespace

Decided decide(const DirectResult& direct, const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
               const DecisionRule& rule)
{
    Decided out;
    out.named = named_directly(direct);
    out.structure95 = nats_of_score(quantile95(ensemble.by_scores.unknown.nulls));
    std::vector<JudgedCause> found;
    judge_statistics(ensemble, out, found);
    judge_scores(ensemble, out, found);
    std::stable_sort(out.judged.begin(), out.judged.end(), [](const JudgedCause& a, const JudgedCause& b) {
        return a.considered != b.considered ? a.considered : a.chance < b.chance;
    });
    if (std::any_of(direct.found.begin(), direct.found.end(), beyond_simulation)) {
        found.clear();
        out.in_set.clear();
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const JudgedCause& a, const JudgedCause& b) { return a.probability > b.probability; });
    const JudgedCause* first = found.empty() ? nullptr : &found.front();
    for (const JudgedCause& j : found) {
        const bool again = std::any_of(out.named.begin(), out.named.end(), [&](const JudgedCause& other) {
            return other.fit.cause.mechanism == j.fit.cause.mechanism;
        });
        if (again)
            continue;
        // what the other test says first is a rival; what the same test says second is a second cause
        (&j == first || j.channel == first->channel ? out.named : out.in_set).push_back(j);
    }
    std::erase_if(out.in_set, [&](const JudgedCause& j) {
        return std::any_of(out.named.begin(), out.named.end(), [&](const JudgedCause& other) {
            return other.fit.cause.mechanism == j.fit.cause.mechanism;
        });
    });
    // where both tests say the same, the balance of forces knows the size best: it is not limited to those simulated
    for (JudgedCause& j : out.named)
        for (const JudgedCause& other : found)
            if (j.channel == Channel::statistics && other.channel == Channel::balance && same_place(j, other)) {
                const double probability = j.probability;
                j = other;
                j.probability = probability;
            }
    share_what_remains(out);
    std::erase_if(out.judged, [](const JudgedCause& j) { return !j.considered && j.fit.gain == 0; });
    const bool judged_by_simulation = std::none_of(direct.found.begin(), direct.found.end(), beyond_simulation);
    if (judged_by_simulation) {
        out.unexplained = unknown_force(balance, ensemble, rule, EnsembleRule{}.named);
        out.unexplained_chance = ensemble.by_scores.unknown.p_value;
        if (!out.unexplained && ensemble.by_statistics.unexplained) {
            out.unexplained = left_over(ensemble);
            out.unexplained_chance = ensemble.by_statistics.left_p_value;
        }
    }
    if (out.unexplained) {
        std::erase_if(out.named, [](const JudgedCause& j) { return j.channel != Channel::direct; });
        out.in_set.clear();
    }
    out.verdict = out.unexplained ? Verdict::unexplained : out.named.empty() ? Verdict::none : Verdict::named;
    std::stable_sort(out.named.begin(), out.named.end(),
                     [](const JudgedCause& a, const JudgedCause& b) { return a.probability > b.probability; });
    return out;
}

std::vector<std::string> tests_in_words(const EnsembleDiagnosis& ensemble)
{
    std::vector<std::string> lines;
    const ScoreVerdict& scores = ensemble.by_scores;
    if (scores.cause.variant >= 0)
        lines.push_back(fmt::format("scores of the balance of forces: {}, p = {:.2g}, probability {:.2f}",
                                    ensemble.scored.causes[static_cast<std::size_t>(scores.cause.variant)].label(),
                                    scores.cause.p_value, scores.probability));
    if (scores.unknown.variant >= 0)
        lines.push_back(fmt::format(
            "forces of no known kind: {}, p = {:.2g}, {:.1f} nats against {:.1f} of causes",
            ensemble.scored.structures[static_cast<std::size_t>(scores.unknown.variant) - ensemble.scored.causes.size()]
                .text,
            scores.unknown.p_value, nats_of_score(scores.unknown.score), nats_of_score(scores.cause.score)));
    const EnsembleVerdict& statistics = ensemble.by_statistics;
    if (statistics.best >= 0)
        lines.push_back(fmt::format("statistics of the campaign: {}, p = {:.2g}, probability {:.2f}; what is left has "
                                    "p = {:.2g}; law p = {:.2g}{}",
                                    ensemble.causes[static_cast<std::size_t>(statistics.best)].cause.label(),
                                    statistics.p_value, statistics.probability, statistics.left_p_value,
                                    ensemble.law_p_value, statistics.contrasts ? ", contrasts alone" : ""));
    return lines;
}

} // namespace stylobate
