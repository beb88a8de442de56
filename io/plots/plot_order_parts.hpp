#pragma once
/// What the two forms of the picture of falls share: a table beside the curves, or a drawing of the structure above
/// them.

#include "io/plots/plot_order.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Of more blocks than this a table and its colours are not read any more: they are drawn in their places.
inline constexpr std::size_t most_listed = 12;

double fallen_share(const FallOrder& order, std::uint64_t count);

/// Colour of an early (0) to a late (1) fall: dark ones fall first. The lightest end of the map is too faint on white.
std::string order_colour(double part);

/// The block's curve as data, $blockN: from 0 to the end of the axis, one step for each fall.
std::string order_curve(const FallOrder& order, std::size_t block, double end_s);

/// The structure at rest, its blocks in the colour of the median time of their fall and with the share that fell, above
/// the curves in the same colours.
/// @param shown the blocks that fell
/// @pre order.places has one for each block
void plot_order_drawn(const FallOrder& order, const std::vector<std::size_t>& shown, double end_s,
                      const std::string& title, const std::string& note, const std::filesystem::path& file);

} // namespace stylobate
