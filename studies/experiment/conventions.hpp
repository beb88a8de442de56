#pragma once
/// The choices of a study that no measurement has fixed and that change its probabilities by more than their intervals:
/// contact form, K_N, place of the dashpots, start and length of the shaking. docs/sensitivity.md measures what each of
/// them changes.

#include "ensemble/model/study.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// "contact by area, K_N 1e+08 N/m² (drawn: lognormal, sigma_ln 0.7), dashpots at the centroid, ...; harmonic of 10
/// cycles in all, smooth start over 2 cycles, ...". One line, for every summary that has a probability.
std::string conventions_text(const Study& study);

/// The conventions of the study whose text a file has; nullopt where this version cannot read it.
std::optional<std::string> conventions_text_of(const std::string& study_toml);

} // namespace stylobate
