#pragma once
/// What the balance of forces names by itself.
///
/// It needs no contact law: where the law of a specimen is none of the family, it says as much as where it is one,
/// while the statistics move. So it is a test of its own beside theirs. Of what it does not see (damping, adhesion, a
/// joint that never slides by itself) it says nothing.

#include "studies/measured/diagnosis/decision.hpp"

#include <optional>
#include <vector>

namespace stylobate {

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
