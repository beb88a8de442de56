#pragma once
/// How wide a text is, so that none lies on another.

#include <string_view>

namespace stylobate {

/// The width of a text in DejaVu Sans, in heights of its type: 0.6 for "5". It is exact for ASCII, and for the other
/// characters of our texts within 5 %. Kerning is left out. A text in Helvetica is narrower.
double text_width(std::string_view text);

} // namespace stylobate
