#pragma once
/// What the numerics of a study change in its collapse probability: measured on the study itself, by a part of its
/// realizations that are run twice, the second time with finer numerics.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace stylobate {

/// A part of a study that is run to its end, for what became of each realization.
struct PartRun {
    std::vector<std::uint64_t> indices;         ///< ascending
    std::vector<std::optional<bool>> collapsed; ///< (indices) none: invalid
    double step_s = 0;                          ///< sum over the realizations
    double seconds = 0;                         ///< that it took
};

/// So many realizations, spread evenly over all of the study.
std::vector<std::uint64_t> spread_evenly(std::uint64_t count, std::uint64_t total);

/// @pre its kind draws realizations by their index alone: single, surface without adaptive, fragility, survival
/// @return incomplete if the observer asks to stop
PartRun run_part(const Experiment& experiment, const RunOptions& options, std::vector<std::uint64_t> indices,
                 Observer& observer);

/// Collapses of the same realizations in two runs.
struct PairedCollapses {
    std::uint64_t realizations = 0; ///< valid in both
    std::uint64_t first = 0, second = 0;
    std::uint64_t differ = 0; ///< collapsed in one of the two alone
    double difference = 0;    ///< of the collapse probability: first less second
    double sd = 0;            ///< its standard error, by the pairs of which one collapsed alone
};

/// Of the realizations that both have run. @pre the indices of `second` are among those of `first`
PairedCollapses paired_collapses(const PartRun& first, const PartRun& second);

struct NumericsCheck {
    std::uint64_t realizations = 0;        ///< valid in both
    std::uint64_t collapsed = 0;           ///< with the study's numerics,
    std::uint64_t finer = 0;               ///< and with the finer ones
    double difference = 0;                 ///< of the collapse probability: the study's less that of the finer numerics
    double sd = 0;                         ///< its standard error, by the pairs of which one collapsed alone
    double step_s = 0;                     ///< mean over the realizations
    double seconds = 0, finer_seconds = 0; ///< that the two took
};

/// The study with shorter steps: of rigid contacts a quarter, since the difference from half of them was a third of the
/// error where that was largest (`docs/rigid_limit.md`), else half. What `run.accuracy` has chosen beside the steps
/// counts as numerics too, and is undone: double precision, the bound of the blocks, ten times the stiffness.
Study finer(Study study);

/// All is 0 if the observer asks to stop.
/// @param plain part of the study, which is run again
NumericsCheck check_numerics(const Experiment& experiment, const RunOptions& options, const PartRun& plain,
                             Observer& observer);
/// @param pilot number of realizations, spread evenly over the study's   @pre as `run_part`
NumericsCheck check_numerics(const Experiment& experiment, const RunOptions& options, std::uint64_t pilot,
                             Observer& observer);

} // namespace stylobate
