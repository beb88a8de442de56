#pragma once
/// What both laws share beside the geometry: how much friction a bed has, and the forces that are no contacts.

#include "tests/hidden/laws/bed_ends.hpp"

namespace stylobate::hidden {

/// Coefficient of friction of a bed.
/// @param sliding velocity of the upper body against the lower one, to the right [m/s]
double friction_of(const Model& model, int bed, const BedState& state, double position, double sliding);

/// Shear that adhesion holds at an end [N].
double adhesion_of(const Model& model, int bed, const BedState& state, int end, double width);

/// Tension that adhesion holds at an end [N]; an end that may open freely holds none.
double tension_of(const Model& model, int bed, const BedState& state, int end, double width);

/// Force of the dowel on the upper body, to the right [N]; it acts in the middle of the bed.
double dowel_force(const Model& model, int bed, const BedState& state, double position);

struct Load {
    double fx = 0, fy = 0, moment = 0;
};

/// Weight and what else acts on a body from without.
/// @param time since the shaking began [s]
Load load_on(const Model& model, int body, const BodyState& state, const BaseState& base, double time);

/// Where the point of a rod's body is, along the rod and from the origin of the rod's other end, and its velocity.
void rod_tip(const Rod& rod, const Model& model, const State& state, const BaseState& base, double& at,
             double& velocity);

/// Force that a rod applies to its body, to the right of the rod's other end [N].
double rod_force(const Model& model, const Rod& rod, const State& state, const BaseState& base, double time);

/// The same as a load on the body that moves with the rod's one.
Load rod_load(const Model& model, const Rod& rod, const State& state, const BaseState& base, double time);

/// Places and velocities of the bodies that are rigid with others or with the table.
void carry(const Model& model, const BaseState& base, State& state);

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
