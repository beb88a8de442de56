#pragma once
/// The page of a result.

#include "kernels/isa.hpp"
#include "studies/kinds/law_band.hpp"
#include "studies/report/document.hpp"
#include "studies/results/kept_animations.hpp"
#include "studies/results/results.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The study and its results: summary, probabilities, pictures, order of falls, motions, energy, and how to do
/// it again; and the data by which its script shows values under the pointer and realizations in motion. Where the
/// pictures cannot be drawn the page contains a message.
/// @param isa for realizations whose trajectories the file does not hold
/// @param title of the page; nullopt: by the study or the file
/// @param animations of `keep_animations`
/// @param laws over contact laws; none: the page states which command measures it
/// @param web address of the page that computes a study in the browser (docs/browser.md), to which the page links;
/// nullopt: none
/// @param warnings receives a line for each picture that could not be drawn
/// @throws InputError if the run is not complete
Document result_page(const Results& results, Isa isa, const std::optional<std::string>& title,
                     const KeptAnimations& animations, const std::optional<LawBand>& laws,
                     const std::optional<std::string>& web, std::vector<std::string>& warnings);

} // namespace stylobate
