#pragma once
/// The band-pass filter of a record.

#include "ensemble/model/motion.hpp"

#include <vector>

namespace stylobate {

/// Amplitude of what passes at a frequency: a high-pass and a low-pass of Butterworth, each of order 4,
///
///   gain = 1 / sqrt(1 + (low / f)^8) / sqrt(1 + (f / high)^8)
///
/// so -3 dB at each corner (where they lie apart), and 24 dB an octave outside.
double band_pass_gain(double frequency_hz, const BandPass& corners);

/// Filters samples in the frequency domain, without a change of phase (acausal): each component is multiplied with
/// its gain. The samples are set between zeros of 1.5 x order / low on either side, in which the filter rings out
/// (the length that Converse and Brady, BAP, 1992, give for both sides together), so that no end reaches the other.
/// What rings beyond the samples is cut off.
void band_pass(std::vector<double>& samples, double dt_s, const BandPass& corners);

} // namespace stylobate
