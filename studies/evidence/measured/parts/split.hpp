#pragma once
/// Which tests a model may be fitted on: whole ground motions, by a rule that is fixed before anything is looked at.

#include <string>
#include <vector>

namespace stylobate::measured {

/// The distinct groups are put in the order of their names; the first, third, fifth and so on are for fitting, the
/// others are held out. Tests of one group never part.
/// @param group of each test, such as its ground motion   @return (tests) true: for fitting
std::vector<bool> fitting_half(const std::vector<std::string>& group);

} // namespace stylobate::measured
