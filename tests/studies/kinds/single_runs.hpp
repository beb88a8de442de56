#pragma once
/// Outcomes of a study from single runs, for counts by another way.

#include "ensemble/experiment.hpp"
#include "ensemble/run/executor.hpp"

#include <cstdint>
#include <map>

namespace stylobate {

/// Of each realization by its index, whether it collapsed.
inline std::map<std::uint64_t, bool> collapsed_of(const Experiment& experiment, Isa isa = Isa::scalar)
{
    std::map<std::uint64_t, bool> all;
    RunPlan plan;
    plan.total = experiment.study().total();
    plan.sink = [&](const Realization& r, const Outcome& o) { all[r.index] = o.state == State::collapsed; };
    Observer quiet;
    run_ensemble(experiment, {isa, 1}, plan, quiet);
    return all;
}

inline std::map<std::uint64_t, bool> collapsed_of(const Study& study)
{
    return collapsed_of(Experiment(study));
}

} // namespace stylobate
