#pragma once
/// Causes put into the model: what the diagnosis names is what the kernel runs.

#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"
#include "studies/measured/diagnosis/evidence/balance_fit.hpp"

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

/// Wear that goes on from run to run begins where earlier runs have left it; other causes are left alone.
/// @param before paths of the joints in the runs before this one
/// @pre `apply_cause` has put the cause into the realization
void carry_wear(const SizedCause& cause, const SpecimenStructure& built, const JointPath& before,
                Realization& realization);

/// Adds a cause to a study's [mechanisms], as `apply_cause` and the correction of the base do to a realization.
/// @pre the cause has one size: no harmonic distortion, and no vertical motion that does not follow the horizontal one
void add_mechanism(const SizedCause& cause, const SpecimenStructure& built, Study& study);

/// Adds the overtones of the base to a study's [mechanisms]. Those of a polynomial are the ones that it makes of a
/// sine: z2 = (1 - cos 2 psi) / 2 and z3 - 3 z / 4 = -sin(3 psi) / 4 of z = sin psi.
/// @param gain of the base beside them: the distortion is that of the file's motion, the mechanism's that of the true
/// one
void add_distortion(const TableDistortion& distortion, double gain, Study& study);

} // namespace stylobate
