#pragma once
/// From evidence to a verdict. The rule stands here, was fixed before it was assessed, and is explained in
/// `docs/diagnosis.md`:
///
///   1  What a direct test of base or sensors finds is named: its thresholds are its rule.
///   2  Of what balance and windows see, a cause is considered if its gain could not be had by chance: more than in any
///      campaign with nothing hidden, by `clear` nats more than their 95 % quantile, with a probability by chance below
///      `chance`, and not by one run alone; and if it is large enough to matter.
///   3  The most surprising one is named; others whose surprise is within `apart` nats of it are in the set with it.
///      If all of these together are less probable than not, they are possible, and none is named.
///   4  Beside it the rest is judged again, once: a second cause.
///   5  If forces of no known kind explain much more than what is named, or if something is left that nothing explains
///      and that chance does not give, the verdict is 'unexplained'.

#include "studies/diagnosis/decision/evidence.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Less probable causes, alone or as a set, are not named.
inline constexpr double least_probability = 0.5;

struct DecisionRule {
    double clear = 3;            ///< nats beyond the 95 % quantile of chance
    double chance = 4e-3;        ///< a dozen mechanisms are judged: together 5 % at the most
    double without_best = 0.4;   ///< part of the gain that must be left without the best run
    double apart = 3;            ///< nats
    double structure_clear = 12; ///< nats beyond the 95 % quantile of chance, for 'unexplained'
    double structure_better = 8; ///< nats by which no mechanism may fall short of it
    double sure = 3;             ///< nats of surprise at which a cause has even odds against 'none', less 1
};

/// A cause as it was judged.
struct JudgedCause {
    CauseFit fit;
    Channel channel = Channel::balance;
    double chance95 = 0;
    double chance = 1;   ///< probability of such a gain by chance
    double surprise = 0; ///< gain minus chance95, or minus the logarithm of its p-value, whichever is smaller [nats]
    double probability = 0;
    bool considered = false; ///< rule 2
    std::string why_not;
    std::vector<double> gain_by_form; ///< windows: under each of the contact forms that judge
};

/// The decisions on all candidates of balance and windows, the most significant first.
std::vector<JudgedCause> judge(const BalanceEvidence& balance, const std::vector<CauseFit>& windows,
                               const std::vector<std::vector<double>>& windows_by_form, const ChanceGains& chance,
                               const DecisionRule& rule);

struct Decided {
    Verdict verdict = Verdict::none;
    std::vector<JudgedCause> named;  ///< most probable first, direct findings included
    std::vector<JudgedCause> in_set; ///< that these data do not distinguish from a named one
    std::vector<JudgedCause> judged; ///< all of the first round
    std::optional<StructureFit> unexplained;
    double unexplained_chance = 1;
    double structure95 = 0; ///< 95 % quantile of the gain of a force of no known kind by chance [nats]
};

/// What the direct tests of base and sensors found is named (rule 1).
std::vector<JudgedCause> named_directly(const DirectResult& direct);

/// @param again judges what is left beside given causes (a second round)
Decided decide(const DirectResult& direct, const BalanceEvidence& balance, std::vector<JudgedCause> judged,
               const ChanceGains& chance, const DecisionRule& rule,
               const std::function<std::vector<JudgedCause>(const JudgedCause& given)>& again);

} // namespace stylobate
