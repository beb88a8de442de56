#pragma once
/// A round that several processes run: its places are dealt out, and rank 0 takes all rows.

#include "ensemble/run/executor.hpp"
#include "io/store/result_store.hpp"

#include <functional>

namespace stylobate {

using TakeRow = std::function<void(const ResultRow&)>;

struct SharedRun {
    Progress progress;
    bool complete = false;
};

/// As `run_ensemble`, by all ranks of `options`, which call it together.
/// @param plan   of the round; `done` counts on rank 0, `sink` is not used
/// @param header of the results, for the bytes of a row
/// @param heard  whether all ranks are given the rows, because the next round depends on them; else rank 0 alone is
/// @param take   takes a row; called from one thread at a time. Rank 0 gets each as it comes, the others at the end
/// @return whether no rank has been asked to stop, the same on all ranks; and on rank 0 the counts of all of them
/// @throws what `run_ensemble` and `take` throw; std::runtime_error if the ranks have not the same round before them
SharedRun run_on_ranks(const Experiment& experiment, const RunOptions& options, RunPlan plan,
                       const ResultHeader& header, bool heard, const TakeRow& take, Observer& observer);

/// Gives all ranks the rows that rank 0 has. Collective.
/// @param each calls its argument with every row; of rank 0
/// @param take takes them, on the others
void share_rows(Ranks& ranks, const ResultHeader& header, const std::function<void(const TakeRow&)>& each,
                const TakeRow& take);

} // namespace stylobate
