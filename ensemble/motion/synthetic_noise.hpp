#pragma once
/// Synthetic earthquakes: noise with the spectrum of a ground and an envelope.
///
/// White noise is multiplied by an envelope, then filtered twice:
///
///   x'' + 2 z_g w_g x' + w_g2 x = -e(t) w(t)      the ground over the rock: a_g = -(2 z_g w_g x' + w_g2 x)
///   y'' + 2 z_f w_f y' + w_f2 y = a_g             no drift below w_f: the base's acceleration is y'', and y its place
///
/// so that for e = 1 the power of y'' is S0 |H_g|2 |H_f|2 with
///
///   |H_g|2 = (w_g4 + 4 z_g2 w_g2 w2) / ((w_g2 - w2)2 + 4 z_g2 w_g2 w2)
///   |H_f|2 = w4 / ((w_f2 - w2)2 + 4 z_f2 w_f2 w2)
///
/// First filter: Kanai, "Semi-empirical formula for the seismic characteristics of the ground", Bulletin of the
/// Earthquake Research Institute 35 (1957) 309, and Tajimi, "A statistical method of determining the maximum response
/// of a building structure during an earthquake", Proceedings of the Second World Conference on Earthquake Engineering
/// (1960). Second filter: Clough & Penzien, "Dynamics of Structures", 2nd edition (1993).
///
/// The envelope is that of Jennings, Housner & Tsai, "Simulated earthquake motions" (1968): (t / rise)2, then 1 for the
/// strong phase, then exp(-(t - t2) / decay); it is cut after five times the decay, at 0.7 %. The remaining
/// displacement, velocity and acceleration are removed with a polynomial (`RestPolynomial`): the motion ends at rest,
/// and where it began.
///
/// The noise is normal, one number a sample, linear between samples; both filters are stepped exactly for that (Nigam &
/// Jennings, "Calculation of response spectra from strong-motion earthquake records", Bulletin of the Seismological
/// Society of America 59 (1969) 909). With 100 samples or more in a cycle of the ground filter (and 200 a second at
/// least) the spectrum is that of the formulas times sinc4(pi f d): 1.6 % less at five times the ground's frequency.
/// The bits are the same on every machine.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/noise_duration.hpp"
#include "ensemble/numerics/random.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stylobate {

/// Number of motions whose mean peak is taken.
inline constexpr std::uint64_t motions_for_mean_peak = 128;

class SyntheticNoise {
public:
    SyntheticNoise(const ExcitationSpec& excitation, double ground_frequency_hz);

    double dt_s() const { return dt_s_; }
    double duration_s() const { return duration_s_; }
    double envelope(double time_s) const;

    /// The acceleration for white noise of unit variance a sample, at rest at both ends.
    std::vector<double> acceleration(std::uint64_t seed, std::uint64_t index, Stream stream) const;

    /// Mean of the largest |acceleration| of `acceleration`, over 128 motions that no realization uses (a stream of
    /// their own): known to about 1 %, and the same number in every run of a study.
    double mean_peak(std::uint64_t seed) const;

    /// The motion of a realization, ready to drive it. @param scale multiplies the acceleration
    Motion motion(std::uint64_t seed, std::uint64_t index, double scale) const;
    /// Scaled so that its own peak is `pga_m_s2`.
    Motion motion_of_peak(std::uint64_t seed, std::uint64_t index, double pga_m_s2) const;
    /// The motion of samples that this noise has, times `scale`.
    Motion motion_from(std::vector<double> acceleration, double scale) const;

private:
    double frequency_hz_, damping_ratio_, low_cut_hz_, low_cut_damping_ratio_;
    double rise_s_, strong_s_, decay_s_;
    double duration_s_, dt_s_;
    std::size_t samples_;
};

} // namespace stylobate
