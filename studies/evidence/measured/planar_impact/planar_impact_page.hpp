#pragma once
/// The page of planar impacts: its text and its pictures.

#include "studies/evidence/measured/planar_impact/planar_impact_study.hpp"

#include <filesystem>
#include <string>

namespace stylobate::measured::impact {

/// Markdown. @param made_by line with the version and machine of the computation
std::string page_text(const ImpactStudy& study, const std::string& made_by);

/// planar_impact_{errors,place,sliding}.png.
/// @throws InputError as `run_gnuplot`
void draw(const ImpactStudy& study, const std::filesystem::path& folder);

} // namespace stylobate::measured::impact
