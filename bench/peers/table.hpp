#pragma once
/// What was found, as a table for people (Markdown) and as JSON.

#include "bench/peers/scan.hpp"

#include <string>

namespace stylobate::peers {

/// Each engine's customary setting, and at each target its fastest one (of Stylobate all contact forms); then the
/// ratios.
std::string markdown(const std::vector<Result>& results, const std::string& processor);

/// All settings with all that was measured.
std::string json(const std::vector<Result>& results, const std::string& processor);

} // namespace stylobate::peers
