#pragma once
/// Where a structure rests under its own weight, or leans, before the shaking.

#include "ensemble/planar/structure/bed.hpp"

#include <optional>
#include <vector>

namespace stylobate {

/// Displacements relative to the reference stack, block by block, and the elastic part of the friction forces.
struct StaticState {
    std::vector<double> x_m;       ///< (blocks)
    std::vector<double> y_m;       ///< (blocks)
    std::vector<double> theta_rad; ///< (blocks)
    std::vector<double> spring_n;  ///< (joints) elastic part of F_T
};

/// A realization at rest, computed once for all that is asked of it; refers to the realization.
///
/// A single column is statically determinate: each bed presses by the weight above it, with the tilt that its
/// eccentricity gives a bed without tension, and the friction carries the slope of a tilted base. A colonnade is
/// not: there the equilibrium of the contact forces themselves is found (`settle`), friction counted from the reference
/// stack on. Starting from the reference stack instead would make the structure bounce.
///
/// The rigid form rests in the reference stack itself.
///
/// With mechanisms that act at rest a column's loads act at its blocks' centres of mass, in their tilted state of rest.
///
/// With `initial_tilt_rad` each column, from `initial_tilt_block` up, then turns as one rigid body about the lower
/// corner of that block, which sinks in until the bed carries what is above. Epistyles are carried along, level, on the
/// corners that have risen.
///
/// With `initial_lift_m` the same part, turned or not, is held so high above its bed: it falls from the start on.
///
/// @pre each free drum is the upper block of exactly one bed, and the beds of a column come from the bottom up
struct Statics {
    explicit Statics(const Realization& realization);
    /// Computed at the first call: the paper's single column rests without.
    const std::vector<BedAtRest>& beds() const;

    const Realization& realization;
    StaticState start;                      ///< in which the realization starts
    std::optional<StaticState> before_tilt; ///< the rest that the initial tilt or lift ended, where there is one

private:
    mutable std::vector<BedAtRest> beds_;
};

/// Where a realization starts, where nothing else is asked of its statics.
StaticState static_state(const Realization& realization);

} // namespace stylobate
