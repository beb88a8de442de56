#pragma once
/// What a risk estimate comes to, for a reader who decides about a monument.

#include "studies/decisions/risk/risk.hpp"

#include <string>

namespace stylobate {

/// "In 100 years the limit state 'a block falls' is reached with a probability of 3.55 % (1.31 to 9.84; 90 % interval),
/// on average once in 2770 years. By the mean hazard, the mean over its fractiles, the probability is 4.02 %." Of the
/// principal limit state; where it is not determined, between which bounds.
std::string risk_answer(const Risk& risk);

/// Which intensities contribute, what makes the interval wide, and what would narrow it.
std::string risk_grounds(const Risk& risk);

} // namespace stylobate
