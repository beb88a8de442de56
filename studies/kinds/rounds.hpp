#pragma once
/// What a kind of study requests from a run: realizations, round by round.

#include "ensemble/run/executor.hpp"

#include <cstdint>
#include <functional>
#include <span>

namespace stylobate {

/// Realizations that are stepped together.
struct Round {
    std::span<const std::uint64_t> indices = {}; ///< none: all realizations of the study
    /// Makes a realization from its index; called from several threads at once. Null: the sampler does.
    std::function<Realization(std::uint64_t index)> realize = {};
    const Study* as = nullptr; ///< the study that they are stepped as; null: the study itself
    bool fair = false;         ///< whether their share of collapses is that of the whole study
};

class Rounds {
public:
    Rounds(const Experiment& run, const RunOptions& how, Observer& told, const Shard& part)
        : experiment(run), options(how), observer(told), shard(part)
    {
    }
    virtual ~Rounds() = default;
    Rounds(const Rounds&) = delete;
    Rounds& operator=(const Rounds&) = delete;

    /// Runs those of the round, or of its shard, that have not been run before; the kind is given their rows, in any
    /// order, before this returns. (Rows of an earlier part of the run were given to it before the first round.)
    /// @returns false if the user has asked to stop
    virtual bool run(const Round& round) = 0;
    /// Runs all realizations of the study, and keeps the trajectories of the first ones. The rows come in the order
    /// of their indices.
    virtual bool trace(std::uint64_t kept_trajectories) = 0;

    const Experiment& experiment;
    const RunOptions& options;
    Observer& observer;
    const Shard shard; ///< the part of every round that is run; unless it is all, nothing follows on the rounds
    Progress progress; ///< of the run so far; a kind that is open-ended states what it expects
};

} // namespace stylobate
