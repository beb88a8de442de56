#pragma once
/// What is measured, as tables and as a picture.

#include "studies/verification/picture.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::work {

struct Report {
    std::string text;                         ///< Markdown
    std::vector<verification::Series> curves; ///< error of the quarter period over cost
};

/// @param realizations of each ensemble
Report measure(std::uint64_t realizations);

void draw(const Report& report, const std::filesystem::path& png);

} // namespace stylobate::work
