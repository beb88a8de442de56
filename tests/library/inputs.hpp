#pragma once
/// The studies that are ready to run.

#include <string>

namespace stylobate {

inline const std::string inputs = STYLOBATE_SOURCE_DIR "/studies/inputs/";

} // namespace stylobate
