#pragma once
/// Many realizations: every core steps bundles, and a lane whose realization has ended takes the next one.

#include "ensemble/device.hpp"
#include "ensemble/observer.hpp"
#include "ensemble/outcome.hpp"
#include "ensemble/sampler.hpp"
#include "ensemble/study.hpp"
#include "kernels/isa.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace stylobate {

struct RunOptions {
    Isa isa = Isa::scalar;
    int threads = 1;
    /// Where to step instead of on the processor: each has a thread of its own that serves it, with the help of
    /// `threads` threads where realizations begin and end.
    std::vector<std::shared_ptr<Device>> devices{};
    int slots = 0; ///< of each of them; 0: as many as it likes
};

/// What is left to do, and where results go.
struct RunPlan {
    std::uint64_t total = 0;                     ///< realizations 0 .. total - 1, or as many as `indices`
    std::span<const std::uint64_t> indices = {}; ///< those to run, in this order; empty: 0 .. total - 1
    /// True for a realization that has been done before. Called from one thread at a time, in index order; empty: none.
    std::function<bool(std::uint64_t index)> done;
    /// A realization by its index; called from several threads at once. Empty: the sampler's.
    std::function<Realization(std::uint64_t index)> realize;
    /// Takes the results. Called from one thread at a time, in any order of the indices.
    std::function<void(const Realization&, const Outcome&)> sink;
    Progress before; ///< counts of what has been done before
};

/// Runs the realizations of a study.
///
/// The next index comes from one shared counter, so lanes and threads stay busy to the end; a realization's outcome
/// depends on its index alone (see `LaneSet`), so the same results come out, bit by bit, whatever the instruction set
/// and the number of threads, and on devices too (`docs/gpu.md` says what that rests on).
///
/// @param record the base motion of a study of kind "record", else null
/// @return the counts at the end; `done < total` if the observer asked to stop
/// @throws what `Sampler::realization` or the sink throws, after all threads have stopped
Progress run_ensemble(const Study& study, const Sampler& sampler, const Motion* record, const RunOptions& options,
                      const RunPlan& plan, Observer& observer);

} // namespace stylobate
