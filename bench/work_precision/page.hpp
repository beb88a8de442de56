#pragma once
/// What is measured, as tables and as a picture.

#include "bench/work_precision/measure.hpp"
#include "studies/evidence/picture/picture.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::work {

struct Report {
    std::string text;                                 ///< Markdown
    std::vector<verification::Series> quarter_period; ///< |error| over cost
    std::vector<verification::Series> overturning;    ///< |error| over cost
    std::vector<verification::Series> collapse;       ///< difference of the probability from a fine step over cost
};

/// Errors of the monolith against the rigid block, over K_N, step, form, damping and K_T; and of limits of K_N.
void monolith_tables(Report& report);

/// Probabilities of collapse over the step against a fine one, and what the step bound of the structure saves.
/// @param realizations of each ensemble
void collapse_tables(Report& report, std::uint64_t realizations);

void draw(const Report& report, const std::filesystem::path& png);

/// As it is called in tables.
const char* name(ContactForm form);
const char* name(DampingAt damping);

} // namespace stylobate::work
