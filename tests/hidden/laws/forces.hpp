#pragma once
/// What both laws share beside the geometry: how much friction a bed has, and the forces that are no contacts.

#include "tests/hidden/laws/bed_ends.hpp"

namespace stylobate::hidden {

/// Coefficient of friction of a bed.
/// @param sliding velocity of the upper body against the lower one, to the right [m/s]
double friction_of(const Model& model, int bed, const BedState& state, double position, double sliding);

/// Shear that adhesion holds at each of the two ends [N].
double adhesion_of(const Model& model, int bed, const BedState& state, double width);

/// Force of the dowel on the upper body, to the right [N]; it acts in the middle of the bed.
double dowel_force(const Model& model, int bed, const BedState& state, double position);

struct Load {
    double fx = 0, fy = 0, moment = 0;
};

/// Weight and what else acts on a body from without.
/// @param time since the shaking began [s]
Load load_on(const Model& model, int body, const BodyState& state, const BaseState& base, double time);

/// The bed after a step: path, heat, wear, and the dowel that has yielded.
/// @param sliding velocity [m/s] at which it slips, 0 if it does not
/// @param shear   force along the bed [N]
/// @param turning relative rotation's velocity [rad/s]
void remember(const Model& model, int bed, BedState& state, double position, double sliding, double shear,
              double turning);

/// The mass that swings inside a body, after a step.
/// @param ax acceleration of the body, horizontal
void slosh(const Model& model, int body, BodyState& state, double ax);

} // namespace stylobate::hidden
