#pragma once
/// What the blocks of a study's structure are called in results and pictures.

#include "ensemble/model/study.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Of the blocks but the ground, in layout order.
std::vector<std::string> block_names(const Study& study);
/// Of the beds, in the order of `lay_out`: "drum 2 on drum 1".
std::vector<std::string> bed_names(const Study& study);

} // namespace stylobate
