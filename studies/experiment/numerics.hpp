#pragma once
/// What the numerics of a study change in its collapse probability: measured on the study itself, by a part of its
/// realizations that are run twice, the second time with finer numerics.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/observer.hpp"

#include <cstdint>

namespace stylobate {

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
/// @param pilot number of realizations, spread evenly over the study's
/// @pre its kind draws realizations by their index alone: single, surface without adaptive, fragility
NumericsCheck check_numerics(const Experiment& experiment, const RunOptions& options, std::uint64_t pilot,
                             Observer& observer);

} // namespace stylobate
