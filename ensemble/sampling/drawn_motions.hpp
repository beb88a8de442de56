#pragma once
/// The motions that a study with a set of motions generates itself: drawn from its seed, and sequences of shakings.

#include "ensemble/model/motion_set.hpp"

#include <span>
#include <vector>

namespace stylobate {

/// Shakings in succession with pauses between them, each as strong as the first in the study's measure (for a cloud:
/// unscaled). Motion i of the result begins with shaking i of the set; its measures are those of this shaking.
///
/// Synthetic motions are `shakings` times as many, and are used once each. Records are drawn again: those that follow
/// record i are others of the set, by random numbers of the study's seed, each of them once in a sequence.
///
/// The samples have the shortest spacing in a sequence; the acceleration is linear between a record's own samples.
/// @pre the set is measured; `MotionSetSpec::shakings` > 1
MotionSet in_sequence(const Study& study, const MotionSet& set);

/// A motion times a factor.
struct ScaledMotion {
    const Motion* motion = nullptr; ///< null: at rest
    double scale = 1;
    const Motion* timed_by = nullptr; ///< the first component, of another one, whose length and spacing it takes
    const Motion& timing() const { return timed_by != nullptr ? *timed_by : *motion; }
};

/// One after the other, with pauses of rest between them; sampled with the shortest of their spacings, the acceleration
/// linear between a motion's own samples. PGA and predominant frequency are left to the caller.
struct Succession {
    Motion motion;
    std::vector<double> ends_s; ///< (shakings) when each is over
};
Succession in_succession(std::span<const ScaledMotion> shakings, double pause_s);

/// The motions that a study with a synthetic excitation draws from its seed: the excitation with its perturbations, and
/// noise, one after the other; each with a PGA of `excitation.pga_m_s2`. Not measured yet.
/// @throws std::invalid_argument if the study is not of that kind
MotionSet drawn_motions(const Study& study);

} // namespace stylobate
