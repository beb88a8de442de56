/// What the balance of forces names by itself.
///
/// It needs no contact law: where the law of a specimen is none of the family, it says as much as where it is one,
/// while the statistics move. So it is a test of its own beside theirs. Of what it does not see (damping, adhesion, a
/// joint that never slides by itself) it says nothing.

#include "studies/measured/diagnosis/decision.hpp"

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
bool shown(const CauseFit& fit, const ScorePlan& scored, const ForceTest& listed, const DecisionRule& rule)
{
    const auto at = std::find(scored.causes.begin(), scored.causes.end(), fit.cause);
    return at != scored.causes.end() &&
           in_units(fit.gain, listed.unit[static_cast<std::size_t>(at - scored.causes.begin())]) >= rule.shown;
}

/// Those that the samples show, but for the first cause itself.
std::vector<Cause> seen_beside(const Cause& first, std::vector<Cause> causes, const BalanceFit& fit)
{
    std::erase_if(causes, [&](const Cause& cause) {
        return (cause.mechanism == first.mechanism && cause.place == first.place) || std::isnan(fit.score(cause));
    });
    return causes;
}

/// What a cause of another kind gains at the most, beside those given.
double best_further(const BalanceEvidence& balance, const std::vector<Cause>& given)
{
    double best = 0;
    for (const CauseFit& listed : balance.causes) {
        const auto same = [&](const Cause& cause) { return cause.mechanism == listed.cause.mechanism; };
        if (std::any_of(given.begin(), given.end(), same))
            continue; // the same force, placed elsewhere
        const CauseFit fit = balance.fit->fit(listed.cause, given);
        if (of_possible_size(fit, balance.fit->specimen()))
            best = std::max(best, fit.gain);
    }
    return best;
}

/// The first force that stands out from those of healthy campaigns, and not by one run alone.
/// @param least gain that it must have
std::optional<StructureFit> beyond_healthy(const std::vector<StructureFit>& fits, double least, const ScorePlan& scored,
                                           const ForceTest& unlisted, const DecisionRule& rule)
{
    for (const StructureFit& fit : fits) {
        if (fit.gain < least)
            break;
        const auto at = std::find_if(scored.structures.begin(), scored.structures.end(),
                                     [&](const Structure& s) { return s.text == fit.structure.text; });
        const double score =
            in_units(fit.gain, unlisted.unit[static_cast<std::size_t>(at - scored.structures.begin())]);
        if (conformal_p_value(unlisted.nulls, score, unlisted.likeness) <= EnsembleRule{}.force &&
            not_by_one_run(fit.gain, fit.gain_by_run, rule.without_best))
            return fit;
    }
    return std::nullopt;
}

/// Whether what explains the forces best is of a size that no specimen has: causes that explain less are no rivals.
bool none_of_the_list(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble, const DecisionRule& rule)
{
    if (!balance.impossible)
        return false;
    const double most = balance.causes.empty() ? 0 : balance.causes.front().gain;
    const CauseFit& best = *balance.impossible;
    return best.gain >= rule.clear && best.gain > most + EnsembleRule{}.apart &&
           shown(best, ensemble.scored, ensemble.listed, rule);
}

/// The force of no known kind that explains most, if not by one run alone.
std::optional<StructureFit> in_place_of_all(const std::vector<StructureFit>& structures, const DecisionRule& rule)
{
    const auto found = std::find_if(structures.begin(), structures.end(), [&](const StructureFit& fit) {
        return not_by_one_run(fit.gain, fit.gain_by_run, rule.without_best);
    });
    return found != structures.end() && found->gain >= rule.clear ? std::optional(*found) : std::nullopt;
}

} // namespace

NamedByForces named_by_forces(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
                              const std::vector<Cause>& by_statistics, const DecisionRule& rule)
{
    const ScorePlan& scored = ensemble.scored;
    NamedByForces out;
    out.p_value = ensemble.listed.p_value;
    if (out.p_value > EnsembleRule{}.named)
        return out;
    if (none_of_the_list(balance, ensemble, rule)) {
        out.unknown = in_place_of_all(balance.structures, rule);
        return out;
    }
    for (const CauseFit& fit : balance.causes) { // best first
        const auto same = [&](const CauseFit& other) { return other.cause.mechanism == fit.cause.mechanism; };
        const double least = out.causes.empty() ? rule.clear : out.causes.front().gain - EnsembleRule{}.apart;
        if (fit.gain < least)
            break;
        if (std::none_of(out.causes.begin(), out.causes.end(), same) && matters(fit) &&
            is_candidate(fit.cause, ensemble.causes) && shown(fit, scored, ensemble.listed, rule))
            out.causes.push_back(fit);
    }
    if (balance.fit && !out.causes.empty()) {
        const Cause& first = out.causes.front().cause;
        out.given_too = seen_beside(first, by_statistics, *balance.fit);
        std::vector<Cause> given{first};
        given.insert(given.end(), out.given_too.begin(), out.given_too.end());
        const double least = std::max(rule.clear, best_further(balance, given) + rule.structure_better);
        out.unknown = beyond_healthy(balance.fit->describe(given), least, scored, ensemble.forces, rule);
    }
    return out;
}

} // namespace stylobate
