#pragma once
/// Runs a study of any kind: its rounds, from what is there to the end.

#include "studies/kinds/kind.hpp"
#include "studies/results/run_store.hpp"

namespace stylobate {

/// Draws realizations once, so that one that cannot be run (a fixed step above its bound, drums drawn off each other)
/// is refused before anything is written. It costs less than a hundredth of running them.
/// @throws InputError naming the realization
/// @param shard the part that is going to be run
void check_realizations(const Sampler& sampler, const Kind& kind, const Shard& shard = {});
/// The same until the observer asks to stop. @return whether all were drawn
bool check_realizations(const Sampler& sampler, const Kind& kind, Observer& observer, const Shard& shard = {});

struct RunEnd {
    Progress progress;
    bool complete = false; ///< of a shard: it is; else the user has asked to stop
};

/// Asks the kind for rounds, runs what is not in the store, and gives every new row to both. Afterwards a complete run
/// wants `Kind::conclude` and `RunStore::finish`, another one and a shard `RunStore::flush`.
/// @pre the kind has been given what the store has, and if it is a shard, it has no `why_no_shards`
/// @throws what `run_ensemble` and the store throw
RunEnd run_study(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options,
                 Observer& observer, const Shard& shard = {});

} // namespace stylobate
