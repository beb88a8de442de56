#pragma once
/// A surface with twins: its realizations, their twins, and the pairs that are followed.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/followed_twin.hpp"
#include "io/store/result_store.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <functional>
#include <vector>

namespace stylobate {

struct TwinsRun {
    Progress progress;
    bool complete = false;
    std::vector<FollowedTwin> followed; ///< once it is complete
};

/// Runs what is left, kind by kind: each bundle has one contact form and one precision. Pairs are followed at the end,
/// and again if that was interrupted.
///
/// @param writer says what is there; @param sink takes the new rows
TwinsRun run_twins(const LoadedStudy& loaded, const RunOptions& options, const ResultWriter& writer,
                   const std::function<void(const ResultRow&)>& sink, Observer& observer);

} // namespace stylobate
