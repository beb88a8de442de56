#pragma once
/// Runs a study of any kind: its rounds, from what is there to the end.

#include "studies/kinds/kind.hpp"
#include "studies/results/run_store.hpp"

namespace stylobate {

/// Draws realizations once, so that one that cannot be run (a fixed step above its bound, drums drawn off each other)
/// is refused before anything is written. It costs less than a hundredth of running them.
/// @throws InputError naming the realization
void check_realizations(const Sampler& sampler, const Kind& kind);

struct StudyRun {
    Progress progress;
    bool complete = false; ///< else the user has asked to stop
};

/// Asks the kind for rounds, runs what is not in the store, and gives every new row to both. Afterwards a complete run
/// wants `Kind::conclude` and `RunStore::finish`, another one `RunStore::flush`.
/// @pre the kind has been given what the store has
/// @throws what `run_ensemble` and the store throw
StudyRun run_study(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options,
                   Observer& observer);

} // namespace stylobate
