#pragma once
/// How a bed carries a given force: its depth and rotation under it.

#include "ensemble/statics/extension.hpp"

namespace stylobate {

/// Depth at the middle of the contact, and rotation of the upper block relative to the lower one.
struct Bedding {
    double depth_m, rotation_rad;
};

/// The paper's bed: stiffness K per area on a contact of length L under the force N at the eccentricity e from its
/// middle, without tension (Winkler bed with uplift, own derivation). A block that cannot stand (e beyond L / 2) gets
/// no rotation: it falls from where it is.
Bedding bedding(double K, double L, double N, double e);

/// The same with the bed's contact form and exponent.
Bedding bedding(const BedLaw& law, double L, double N, double e);

} // namespace stylobate
