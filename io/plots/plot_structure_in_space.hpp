#pragma once
/// The drawing of a structure in space: plan and elevations.

#include "ensemble/model/study.hpp"
#include "io/plots/sheet.hpp"

#include <string>

namespace stylobate {

/// The structure as the study describes it, to one scale (1800 pixels wide, as high as it needs): the elevation
/// from the front, that from the side (z to the left) beside it, the plan below (z downwards). With dimension lines: on
/// the left the heights of the blocks of the first column (equal neighbours together) and the whole height; below the
/// elevations the distances of the axes, of one column the size of its foot, and the whole length. Feet are dashed in
/// the plan where something hides them. Below, a list of the blocks: sizes, masses, and what of their beds differs from
/// [contact]; such beds are red.
///
/// @param title of the picture
/// @throws InputError as `structure_sheet`
DrawingSheet structure_sheet_in_space(const Study& study, const std::string& title);

} // namespace stylobate
