#pragma once
/// The motions that a fragility study makes itself: drawn from its seed, and sequences of shakings.

#include "ensemble/model/motion_set.hpp"

namespace stylobate {

/// Shakings one after the other with pauses between them, each as strong as the first by the study's measure (of a
/// cloud: as it stands). Motion i of the result begins with shaking i of the set, which its measures are of.
///
/// Synthetic motions are `shakings` times as many, and are used once each. Records are drawn again: those that follow
/// record i are others of the set, by random numbers of the study's seed, each of them once in a sequence.
///
/// The samples are those of the shortest spacing in a sequence; the acceleration is linear between a record's own.
/// @pre the set is measured; `fragility.shakings` > 1
MotionSet in_sequence(const Study& study, const MotionSet& set);

/// Motions of which the sequences of a study are made.
int motions_needed(const FragilitySpec& fragility);

/// The motions that a study with a synthetic excitation draws from its seed: what its perturbations make of the
/// excitation, and noise, one after the other; each with a PGA of `excitation.pga_m_s2`. Not measured yet.
/// @throws std::invalid_argument if the study is not of that kind
MotionSet drawn_motions(const Study& study);

} // namespace stylobate
