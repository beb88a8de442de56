#pragma once
/// A value that is typed, and the value of an axis that it means.

#include <string>
#include <vector>

namespace stylobate {

/// The value of an axis that is nearest on the axis' scale.
/// @param option "--pga"   @param results for the message
/// @throws InputError if the value lies outside the axis by more than the digits that people leave out
std::size_t nearest_on_axis(const std::vector<double>& axis, double wanted, const char* option, const std::string& unit,
                            const std::string& results);

} // namespace stylobate
