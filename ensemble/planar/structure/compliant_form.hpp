#pragma once
/// What contacts that yield make of a realization with rigid ones, once its blocks meet otherwise than at beds.

#include "ensemble/planar/structure/realization.hpp"

namespace stylobate {

/// A rigid realization with its structure and motion, but with contacts by area, as stiff as rigid blocks ask for and
/// nearly plastic: the load of the bed that carries most sinks in by 1e-4 of the smallest half size of a free block,
/// the tangential stiffness is half the normal one of the face, both damping ratios are 0.5 (a flat impact keeps 0.16
/// of its velocity), and dashpots are in proportion to the length of the contact. The step is a part of the rigid one,
/// 1 / n with n even, and at most the usual part of the safe bound.
///
/// @pre contacts are rigid, and there is a step
Realization compliant_form(const Realization& rigid);

} // namespace stylobate
