#pragma once
/// What the balance of forces names by itself.
///
/// It needs no contact law: where the law of a specimen is none of the family, it says as much as where it is one,
/// while the statistics move. So it is a test of its own beside theirs. Of what it does not see (damping, adhesion, a
/// joint that never slides by itself) it says nothing.

#include "studies/diagnosis/decision/evidence.hpp"
#include "studies/diagnosis/ensemble_fit/ensemble_diagnosis.hpp"

#include <optional>
#include <vector>

namespace stylobate {

/// The fixed numbers of the rule.
struct ForceRule {
    double named = 0.015;       ///< largest p-value of the score of all causes
    double clear = 8;           ///< nats that the cause that is named gains
    double shown = 1.5;         ///< its own score, in units of healthy campaigns
    double apart = 3;           ///< nats within which other mechanisms are in the set
    double beside = 0.0075;     ///< largest p-value of a force beside the cause
    double without_best = 0.4;  ///< part of such a force's gain that must be left without the best run
    double of_known_kind = 0.8; ///< probability that what is found so is in the list of causes at all
};

struct NamedByForces {
    /// The best one, and the best of each other mechanism that explains about as much; empty: none is named.
    std::vector<CauseFit> causes;
    std::vector<double> probability; ///< (causes)
    double p_value = 1;              ///< of such scores in healthy campaigns
    /// Beside the best one still a force of no known kind: it is none of the list.
    std::optional<StructureFit> beside;
};

/// @param ensemble its candidates (a cause is named at places where they are), and the tests of the scores
NamedByForces named_by_forces(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
                              const ForceRule& rule = {});

} // namespace stylobate
