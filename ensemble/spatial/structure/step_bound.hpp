#pragma once
/// The largest safe step of a structure in space.

#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"

namespace stylobate {

/// The largest step with which every body, held by its neighbours, is stable in the states of its beds that are listed
/// here [s]. The linear motion of body b is stable as long as
///
///   4 M_b - 2 dt sum f C_j - dt2 sum f K_j > 0        f = 2 for a neighbour that is free, 1 for a fixed one
///
/// over its joints j, since a joint stores at most f times what it would with the neighbour held
/// (kernels/spatial/THEORY.md, section 9). K_j and C_j are those of the pressed part of the face, and the tangential
/// spring acts in full at the centre of the pressure:
///
/// - all beds of a body have the same share of the face in contact: the depth in its middle over the largest one
///   against it is xi = -0.999, -0.9, -0.7, -0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1, 1.5 and 100;
/// - a rectangle is deepest in any of its corners. A disc is deepest at two opposite places of its rim, on the line
///   towards the centre of mass if that lies beside its axis, and at four where the body also has rectangles. All
///   combinations of the joints of a body are tried.
///
/// Of two discs the smaller one counts in full, also where the larger one does not cover it; of rectangles, and of a
/// disc that a rectangle does not cover, the rectangle common at rest. A hollow bed counts as its ring, whose bound is
/// never below that of its whole face (THEORY.md has the figures). A dowel is a spring k_d along the face beside the
/// tangential spring, a tie the spring k and the dashpots c and c_r of its own body: it holds the body to the base, and
/// no other body takes a share.
///
/// *Not proved:* that no state between those of the list has a smaller step. Unequal shares of two beds and other
/// angles between them were never worse for discs. What a seat gains when a beam slides onto it is not counted.
///
/// @throws InputError with `StepBasis::structure`: at full contact the step of the whole structure is no bound in
///                    space, as drums that roll on their rims are stiffer (0.530 against 0.928 / w1 for six drums)
double spatial_step_bound_s(const Realization& realization, StepBasis basis = StepBasis::block);

} // namespace stylobate
