#pragma once
/// Several events in succession as one motion: what the first has displaced the next one finds so.
///
/// All events of a realization have its frequency and its PGA. Noise is drawn anew for each; any other motion is the
/// same again. Between the end of one and the begin of the next the ground is at rest, or moves on at the velocity that
/// the first has left it, for a pause in which the structure comes to rest (own choice of a history: a past of n
/// equally strong events).

#include "ensemble/model/motion.hpp"

#include <span>

namespace stylobate {

/// The accelerations one after the other, with `pause_s` of rest after each but the last; all samples have the spacing
/// of the first motion.
/// @pre at least one motion; all have the same spacing
Motion repeated_motion(std::span<const Motion> events, double pause_s);

} // namespace stylobate
