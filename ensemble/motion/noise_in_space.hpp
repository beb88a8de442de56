#pragma once
/// Synthetic earthquakes of two horizontal components and a vertical one.
///
/// All have the spectrum and the envelope of `SyntheticNoise`. With e1 and e2 independent samples of unit noise,
///
///   first = e1        second = ratio (r e1 + sqrt(1 - r2) e2)
///
/// so that r is the correlation of both, and `ratio` that of their standard deviations at every time. The first one is
/// that of a study in the plane with the same seed. The vertical component is independent of both.

#include "ensemble/model/study.hpp"
#include "ensemble/motion/synthetic_noise.hpp"
#include "ensemble/numerics/random.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Both horizontal components, not yet scaled.
struct HorizontalNoise {
    std::vector<double> first;
    std::vector<double> second; ///< as many samples; none of an excitation without second component

    /// The largest acceleration, by what it is of two components.
    double peak(OfPair definition) const;
};

/// @param first, second streams of the white noise of both
HorizontalNoise horizontal_noise(const SyntheticNoise& noise, const ExcitationSpec& excitation, std::uint64_t seed,
                                 std::uint64_t index, Stream first, Stream second);

/// `SyntheticNoise::mean_peak` of `HorizontalNoise::peak`, by `excitation.pga_of_pair`.
double mean_peak(const SyntheticNoise& noise, const ExcitationSpec& excitation, std::uint64_t seed);

} // namespace stylobate
