#pragma once
/// A comparison as lines for a terminal, as JSON and as a table of all its places.

#include "io/tables/table.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/report/json.hpp"

#include <string>

namespace stylobate {

std::string comparison_text(const Comparison& comparison);
Json comparison_json(const Comparison& comparison);
/// A row for each variant, limit state and cell, and for all cells together.
Table comparison_rows(const Comparison& comparison);

/// "undecided: -0.7 to +4.0 percentage points", "better".
std::string verdict_text(const LimitComparison& limit, const PlaceComparison& place);
/// The interval of a difference: "-0.7 to +4.0 percentage points".
std::string points_text(const PlaceComparison& place);
/// "-0.043 [-0.060, -0.027]"
std::string difference_text(const PlaceComparison& place);
/// "1.20 (1.12 to 1.29; steps x 1.1)", "at least 3.1 (2.9 to 3.3; steps x 1.1)", "not in this range" where no intensity
/// separates the two.
std::string capacity_text(const CapacityRatio& ratio);

/// How many times as many realizations an unpaired comparison would need: "pairing saved a factor of 20".
std::string saving_text(const PlaceComparison& place);
/// "friction: same numbers; drum_offset: same quantiles".
std::string inputs_text(const VariantComparison& variant);
/// What names of cells mean: "Benjamini-Hochberg, false names at most 5 %".
std::string adjustment_text(const Comparison& comparison);
/// How draws and motions are common by construction, in a sentence.
std::string common_text(const Comparison& comparison);

} // namespace stylobate
