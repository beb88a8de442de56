#pragma once
/// The past shaking of a site, from the results of several of its structures.

#include "io/tables/table.hpp"
#include "studies/kinds/survival/combined_past.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// @param picture of the likelihoods; none: it is not drawn   @param force replace a picture that is there
/// @throws InputError if a file is not of a survival study, is given twice, or as `combined_past`
CombinedPast past_of_files(const std::vector<std::string>& files,
                           const std::optional<std::filesystem::path>& picture = {}, bool force = false);

/// Draws the likelihoods. @throws InputError for another ending than .png, .svg and .pdf
void draw_past(const CombinedPast& past, const std::filesystem::path& picture);

/// "exclusion": the intensities excluded by each structure and by all together; "likelihood": over frequency and
/// intensity, of each and of all.
std::vector<Table> tables_of(const CombinedPast& past);

} // namespace stylobate
