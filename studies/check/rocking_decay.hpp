#pragma once
/// How fast a structure stops rocking, by the contact law of its study and by rigid contacts.

#include "ensemble/model/study.hpp"
#include "ensemble/planar/structure/step_bound.hpp"

#include <optional>

namespace stylobate {

/// The first column of a study as it is given, nothing drawn and nothing on it, released from half of its slenderness
/// angle on the beds of the study.
struct RockingDecay {
    double slenderness_rad = 0; ///< atan(B / H) of the free part of the column
    double law = 0;             ///< largest lean to the other side after the first impact, over the slenderness
    /// This lean with rigid contacts without rebound; none: the study cannot be run so.
    std::optional<double> rigid;
    double housner = 0; ///< of a rigid monolith: cos(a - x) = cos a + e2 (cos(a / 2) - cos a), e = 1 - 1.5 sin2 a

    /// Part of the energy of the release that the first impact takes, of the energy of a rigid monolith at a lean.
    double lost(double lean) const;
};

/// Nothing where the study's contacts are rigid, where the column falls or does not lean to the other side, and where
/// this would take more than 2e7 steps of a block.
/// @throws InputError as `lay_out`
std::optional<RockingDecay> rocking_decay(const Study& study);

/// How a structure moves without shaking: the nominal one, without mechanisms. Nothing of a structure in space.
struct FreeMotion {
    std::optional<FirstMode> mode; ///< of compliant contacts, with the damping of the study
    std::optional<RockingDecay> decay;
};
FreeMotion free_motion(const Study& study);

} // namespace stylobate
