#pragma once
/// A study on the pages of `stylobate report`.

#include "ensemble/study.hpp"
#include "studies/html.hpp"

#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// What the study says in short: structure, contact, excitation, what is perturbed.
std::vector<std::pair<std::string, std::string>> study_facts(const Study& study);

/// The structure at rest, to scale (SVG); fixed blocks are darker.
Html structure_svg(const Study& study);

} // namespace stylobate
