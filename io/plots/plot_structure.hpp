#pragma once
/// The drawing of a structure: to scale, with its dimensions.

#include "ensemble/model/study.hpp"
#include "io/plots/sheet.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Draws the structure as the study describes it, nothing drawn at random (1800 pixels wide, as high as it needs):
/// blocks on the ground, fixed ones darker, epistyles blue. With dimension lines: on the left the heights of the blocks
/// of the first column (equal neighbours together) and the whole height, below the ground the widths of the columns at
/// their feet and the gaps between them, the distances of their axes and the whole length, above the lengths of the
/// epistyles, and the width of a column's top where it differs from that of its foot. On the right names, sizes and
/// masses of the blocks, if all columns are alike; else each block has its name or size in itself where there is room.
/// Beds that differ from [contact] are drawn red, with what differs. Lengths are in mm below 1 m, else in m.
///
/// @param title of the picture
/// @throws InputError as `lay_out`, or if the picture cannot be written
void plot_structure(const Study& study, const std::string& title, const std::filesystem::path& file);

/// What `plot_structure` draws, with its heading. @throws InputError as `lay_out`
DrawingSheet structure_sheet(const Study& study, const std::string& title);

} // namespace stylobate
