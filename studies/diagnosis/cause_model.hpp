#pragma once
/// Causes put into the model: what the diagnosis names is what the kernel runs.

#include "ensemble/realization.hpp"
#include "ensemble/specimen.hpp"
#include "ensemble/study.hpp"
#include "studies/diagnosis/balance_fit.hpp"

#include <vector>

namespace stylobate {

/// A cause with its size.
struct SizedCause {
    Cause cause;
    double size = 0;
};

/// Writes a cause of a joint or a block into a realization of the specimen; causes of the base are left alone (they
/// change its motion before it comes here), but for the pitch.
void apply_cause(const SizedCause& cause, const SpecimenStructure& built, Realization& realization);

/// Adds a cause to a study's [mechanisms], as `apply_cause` and the correction of the base do to a realization.
void add_mechanism(const SizedCause& cause, const SpecimenStructure& built, Study& study);

} // namespace stylobate
