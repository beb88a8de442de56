#include "studies/diagnosis/decision/named_by_forces.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// Score of a gain, in units of healthy campaigns: near the baseline a gain is half the square of its score.
double in_units(double gain, double unit)
{
    return std::sqrt(2 * std::max(gain, 0.0)) / unit;
}

bool is_candidate(const Cause& cause, const std::vector<CandidateCause>& candidates)
{
    return std::any_of(candidates.begin(), candidates.end(), [&](const CandidateCause& c) {
        return c.cause.mechanism == cause.mechanism && c.cause.place == cause.place;
    });
}

/// Whether the score of this very cause is beyond those of healthy campaigns: another one may have made the test fail.
bool shown(const CauseFit& fit, const ScorePlan& scored, const ForceTest& listed, const ForceRule& rule)
{
    for (std::size_t c = 0; c < scored.causes.size(); ++c)
        if (const Cause& cause = scored.causes[c]; cause.label() == fit.cause.label() &&
                                                   cause.parameter == fit.cause.parameter &&
                                                   cause.fixed == fit.cause.fixed)
            return in_units(fit.gain, listed.unit[c]) >= rule.shown;
    return false;
}

/// The first force that stands out from those of healthy campaigns, and not by one run alone.
std::optional<StructureFit> beyond_healthy(const std::vector<StructureFit>& fits, const ScorePlan& scored,
                                           const ForceTest& unlisted, const ForceRule& rule)
{
    for (const StructureFit& fit : fits) {
        if (fit.gain < rule.clear)
            break;
        const auto at = std::find_if(scored.structures.begin(), scored.structures.end(),
                                     [&](const Structure& s) { return s.text == fit.structure.text; });
        const double score =
            in_units(fit.gain, unlisted.unit[static_cast<std::size_t>(at - scored.structures.begin())]);
        if (conformal_p_value(unlisted.nulls, unlisted.likeness, score) <= rule.beside &&
            not_by_one_run(fit.gain, fit.gain_by_run, rule.without_best))
            return fit;
    }
    return std::nullopt;
}

} // namespace

NamedByForces named_by_forces(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble, const ForceRule& rule)
{
    const ScorePlan& scored = ensemble.scored;
    NamedByForces out;
    out.p_value = ensemble.listed.p_value;
    if (out.p_value > rule.named)
        return out;
    double best = 0, sum = 0;
    for (const CauseFit& fit : balance.causes) { // best first
        const auto same = [&](const CauseFit& other) { return other.cause.mechanism == fit.cause.mechanism; };
        if (std::any_of(out.causes.begin(), out.causes.end(), same) || !matters(fit) ||
            !is_candidate(fit.cause, ensemble.causes) || !shown(fit, scored, ensemble.listed, rule))
            continue;
        if (out.causes.empty() && fit.gain < rule.clear)
            break;
        best = std::max(best, fit.gain);
        out.causes.push_back(fit);
        sum += std::exp(fit.gain - best);
    }
    for (const CauseFit& fit : out.causes)
        out.probability.push_back(rule.of_known_kind * std::exp(fit.gain - best) / sum);
    const auto far = std::find_if(out.causes.begin(), out.causes.end(),
                                  [&](const CauseFit& fit) { return fit.gain < best - rule.apart; });
    out.probability.resize(static_cast<std::size_t>(far - out.causes.begin()));
    out.causes.erase(far, out.causes.end());
    if (balance.fit && !out.causes.empty())
        out.beside = beyond_healthy(balance.fit->describe({out.causes.front().cause}), scored, ensemble.forces, rule);
    return out;
}

} // namespace stylobate
