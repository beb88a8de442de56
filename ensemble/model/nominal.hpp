#pragma once
/// The values that the perturbed quantities of a study have without perturbation.

#include "ensemble/model/structure.hpp"
#include "ensemble/model/study.hpp"

#include <vector>

namespace stylobate {

/// Nominal values of a quantity: one for each bed or each block of the layout, in its order, or one in all for what
/// belongs to the whole structure. In the quantity's unit; an epistyle's drum_width is its length, its drum_offset is
/// counted from its place as it is designed.
std::vector<double> nominal_values(const Study& study, const Layout& layout, Quantity quantity);

/// Of each bed of the layout, in its order.
std::vector<double> nominal_restitution(const Study& study, const Layout& layout);

/// `tail_after_shaking` (base_motion.hpp) of the structure as it is given, nothing drawn [s].
double nominal_tail_s(const StructureSpec& structure);
/// So many times `tail_after_shaking` is the pause between earthquakes by default.
inline constexpr double pause_tails = 10;
/// The pause between two shakings of a sequence [s]. @pre the study has a set of motions
double shaking_pause_s(const Study& study);
/// So many times longer a realization may be simulated until it lies still (`Tail::rest`).
inline constexpr double rest_tails = 20;

} // namespace stylobate
