#pragma once
/// From evidence to a verdict. The rule is explained in `docs/diagnosis.md`. Four tests, each of one number against
/// what chance gives; what passes its test is named:
///
///   direct      What a test of base or sensors finds is named: its thresholds are its rule. If it is something that
///               simulated campaigns cannot contain, the other tests are not made.
///   statistics  The largest gain of the campaign's statistics over all simulated causes, ranked among healthy
///               simulated campaigns (`EnsembleRule::named`). Its probability is calibrated on simulated campaigns with
///               a known cause; others that explain nearly as much are in the set with it. Where neither the cause nor
///               the set is right with a probability of one half, it is called possible. More friction of a joint is
///               named only where the balance of forces sees it, too.
///   forces      The largest score of the balance of forces over all causes, ranked likewise (`named_by_forces.cpp`).
///               The cause must explain the forces by `DecisionRule::clear`; the statistics choose between causes that
///               explain them about as well. Other contact laws move this test little.
///   no cause    What acts and is no cause of the list makes the verdict 'unexplained': a simulated tie of a block to
///               the base, where it would be named; a force of no known kind beside all that forces and statistics
///               name, which no cause of another kind explains; one where a cause of a size that no specimen may have
///               explains the forces clearly better than each of a possible size; one whose score is far beyond healthy
///               campaigns', that explains much more of the balance of forces than any cause, and not by one run alone.
///
/// Where statistics and forces name the same mechanism, place and size are those of the forces. Where they name two,
/// that of the statistics is named and both are in the set.

#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// By which of three ways a cause is found.
enum class Channel {
    direct,    ///< base and sensors, while the lowest block rides on the table; blocks at rest
    forces,    ///< the balance of forces, compared with that of simulated campaigns
    statistics ///< statistics of the whole campaign, compared with simulated campaigns
};

/// Less probable causes are not named.
inline constexpr double least_probability = 0.5;

/// Of the balance of forces; p-values and what is in a set are those of `EnsembleRule`.
struct DecisionRule {
    double clear = 8;           ///< nats by which a cause, or a force beside it, explains the forces better
    double shown = 1.5;         ///< score of a cause that forces name, in units of healthy campaigns
    double of_known_kind = 0.8; ///< probability that what forces name is in the list of causes at all
    double without_best = 0.4;  ///< part of the gain of a force of no known kind that must be left without the best run
    double structure_clear = 6; ///< nats beyond the 95 % quantile of healthy campaigns, for 'unexplained'
    double structure_better = 8; ///< nats by which it must explain more of the balance of forces than every cause
};

/// A cause as it was judged.
struct JudgedCause {
    CauseFit fit;
    Channel channel = Channel::statistics;
    double chance95 = 0;
    double chance = 1;                 ///< probability of such a gain where nothing is hidden
    std::optional<double> probability; ///< nothing: not computed
    bool considered = false;           ///< named, or in a set with what is named
    /// Named by the statistics and by the balance of forces: the p-value of the latter. `fit` has its place and size,
    /// and the gain of the statistics.
    std::optional<double> forces_too;
    std::optional<std::string>
        why_not; ///< why the best candidate is not named; nullopt: it is named, or another is better
};

struct Decided {
    Verdict verdict = Verdict::none;
    std::vector<JudgedCause> named;  ///< most probable first, direct findings included
    std::vector<JudgedCause> in_set; ///< that these data do not distinguish from a named one
    std::vector<JudgedCause> judged; ///< all
    std::optional<StructureFit> unexplained;
    std::optional<CauseFit> beside; ///< the cause beside which it is left; nothing: it stands by itself
    std::vector<Cause> beside_too;  ///< and those that the statistics name
    bool by_tie =
        false; ///< a simulated force on a block is the likeliest: `in_set` has what the data do not distinguish from it
    double unexplained_chance = 1;
    double structure95 = 0; ///< 95 % quantile of the gain of a force of no known kind in healthy campaigns [nats]
};

/// Whether a direct test found what simulated campaigns cannot contain (a vertical motion of a frequency of its own):
/// joints and blocks cannot be judged beside it.
bool beyond_simulation(const DirectResult& direct);

/// @param ensemble null: no campaigns were simulated, and only direct tests name a cause
Decided decide(const DirectResult& direct, const BalanceEvidence& balance, const EnsembleDiagnosis* ensemble,
               const DecisionRule& rule);

/// What the tests found, named or not, in one line each.
std::vector<std::string> tests_in_words(const EnsembleDiagnosis& ensemble);

struct NamedByForces {
    /// The best one, and the best of each other mechanism that explains about as much; empty: none is named.
    std::vector<CauseFit> causes;
    double p_value = 1; ///< of such scores in healthy campaigns
    /// A force of no known kind: beside the best one and what the statistics name, or, where forces name none, in the
    /// place of all.
    std::optional<StructureFit> unknown;
    std::vector<Cause> given_too; ///< what the statistics name of other forces: `unknown` is beside it, too
};

/// @param ensemble its candidates (a cause is named at places where they are), and the tests of the scores
/// @param by_statistics causes that the statistics name: their forces are of a known kind, too
NamedByForces named_by_forces(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
                              const std::vector<Cause>& by_statistics = {}, const DecisionRule& rule = {});

} // namespace stylobate
