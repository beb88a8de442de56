#pragma once
/// How long synthetic noise lasts: numbers that the generator and the reader of studies share.

namespace stylobate {

/// Decay times after which the envelope is cut.
inline constexpr double noise_decays = 5;
/// Noise of less than this has fewer than 20 samples, and the polynomial that brings it to rest leaves little of it.
inline constexpr double shortest_noise_s = 0.1;

} // namespace stylobate
