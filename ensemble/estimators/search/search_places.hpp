#pragma once
/// Places of the unit cube at which a search begins, and those that it looks at.

#include <cstddef>
#include <vector>

namespace stylobate {

/// A place in the unit cube.
using SearchPlace = std::vector<double>;

/// The first points: the middle and both ends of one number, else a low-discrepancy sequence (Roberts' generalised
/// golden ratio).
std::vector<SearchPlace> first_places(std::size_t dimensions);
/// All places that are looked at: 201, 41 x 41 or 17 x 17 x 17.
std::vector<SearchPlace> candidate_places(std::size_t dimensions);

} // namespace stylobate
