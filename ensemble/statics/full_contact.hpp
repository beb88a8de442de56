#pragma once
/// Stiffness and dashpots of a bed whose faces touch all along, for the linear vibrations of a structure.

#include "ensemble/model/realization.hpp"

#include <vector>

namespace stylobate {

/// Beds that stiffen with their load, and dashpots that do, are taken at this multiple of the load at rest.
inline constexpr double bound_load = 10;

/// A joint at full contact in the reference stack.
struct FullContact {
    double chord = 0;   ///< length of the contact [m]
    double x = 0;       ///< its centre [m]
    double k_n = 0;     ///< normal stiffness [N/m]
    double k_theta = 0; ///< rotational stiffness about the centre [N m]
    double k_t = 0;     ///< tangential stiffness [N/m]
    double c_n = 0;     ///< normal dashpots [N s/m]
    double c_theta = 0; ///< their moment about the centre per rate of rotation [N m s]
    double c_t = 0;     ///< tangential dashpot [N s/m]
};

FullContact full_contact(const std::vector<Block>& blocks, const Joint& joint);

/// The same with the realization's form and extensions, about a load of `times` that at rest.
FullContact extended_contact(const Realization& r, int bed, double times);

} // namespace stylobate
