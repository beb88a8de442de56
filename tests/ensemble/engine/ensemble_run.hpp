#pragma once
/// A study run by the executor, outcomes by index and as bits.

#include "ensemble/run/executor.hpp"
#include "tests/ensemble/engine/outcome_bits.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <vector>

namespace stylobate {

using Bits = std::vector<std::uint64_t>;

struct EnsembleRun {
    std::map<std::uint64_t, Bits> outcomes;
    std::map<State, int> states;
    Progress progress;
};

inline EnsembleRun run_all(const Study& study, const RunOptions& options, const Motions& motions = {})
{
    const Experiment experiment(study, motions);
    EnsembleRun result;
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const bool fresh = result.outcomes.emplace(realization.index, outcome_bits(outcome)).second;
        EXPECT_TRUE(fresh) << "realization " << realization.index << " came twice";
        ++result.states[outcome.state];
    };
    Observer observer;
    result.progress = run_ensemble(experiment, options, plan, observer);
    return result;
}

/// The outcomes of all realizations of a study, by their index.
inline std::vector<Outcome> outcomes_of(const Study& study, const RunOptions& options)
{
    std::vector<Outcome> outcomes(study.total());
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& r, const Outcome& o) { outcomes[r.index] = o; };
    Observer observer;
    run_ensemble(Experiment(study), options, plan, observer);
    return outcomes;
}

} // namespace stylobate
