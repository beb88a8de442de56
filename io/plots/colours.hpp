#pragma once
/// Colours of figures: told apart by the colour-blind, and in grey.

#include <array>
#include <cstddef>
#include <string>

namespace stylobate {

/// viridis (van der Walt and Smith, 2015): even steps look even, to the colour-blind too, and in grey.
inline constexpr std::array<const char*, 11> viridis{"#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c",
                                                     "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"};

/// The colour at a value in [0, 1], "#rrggbb"; beyond, that of the nearest end.
std::string viridis_colour(double value);

/// A colour between two, "#rrggbb". @param part of the way from the first to the second, in [0, 1]
std::string mixed_colour(const char* first, const char* second, double part);

/// Colours of series, after Okabe and Ito (2008), the darker ones first. Pages have the same ones as --s0 to --s6.
inline constexpr std::array<const char*, 7> series_colours{"#1f5673", "#d55e00", "#009e73", "#7b4b94",
                                                           "#b8860b", "#56b4e9", "#4d4d4d"};

} // namespace stylobate
