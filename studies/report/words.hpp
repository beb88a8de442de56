#pragma once
/// Rates, shares, durations and lists in words.

#include <string>
#include <vector>

namespace stylobate {

/// A rate with two digits at least: "1874", "3.2", "0.42".
std::string rate_text(double rate);

/// "61.4 %"; "–" where a share is not known.
std::string percent_text(double share);

/// "a", "a and b", "a, b and c".
std::string list_words(const std::vector<std::string>& list);

/// "41 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);
/// A duration with two digits at least: "0.42 s", "3.2 s", "41 s".
std::string seconds_text(double seconds);

} // namespace stylobate
