#pragma once
/// From a record to a base motion: baseline, integration, intensity measures.

#include "ensemble/model/motion.hpp"
#include "io/records/record.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

/// A record with fewer samples drives nothing.
inline constexpr std::size_t fewest_samples = 10;

struct IntensityMeasures {
    double pga_m_s2 = 0;
    double pgv_m_s = 0;
    double pgd_m = 0;
    double arias_m_s = 0; ///< pi / (2 g) times the integral of a2, g = 9.80665 m/s2
    double d5_95_s = 0;   ///< from 5 to 95 % of it
    double cav_m_s = 0;   ///< cumulative absolute velocity: integral of |a|
    double pgv_per_pga_s = 0;
    double predominant_frequency_hz = 0; ///< peak of the Fourier amplitude smoothed with a Konno-Ohmachi window, b = 40
    double mean_frequency_hz = 0;        ///< inverse of the mean period of Rathje et al. (2004), 0.25 to 20 Hz
};

/// What a ground motion is to a rigid block of half width b and half height h that rocks: R = sqrt(b2 + h2),
/// tan alpha = b / h, p = sqrt(3 g / (4 R)).
struct RockingMeasures {
    double tan_alpha = 0;
    double p_rad_s = 0;
    double pga_over_g_tan_alpha = 0;   ///< PGA / (g tan alpha): above 1 the block uplifts
    double p_pgv_over_g_tan_alpha = 0; ///< p PGV / (g tan alpha)
    double omega_p_over_p = 0;         ///< 2 pi predominant frequency / p
};

/// @pre all > 0
RockingMeasures rocking_measures(const IntensityMeasures& measures, double b_m, double h_m, double g_m_s2 = 9.81);

/// Drives a structure with the record: corrects the baseline where asked, integrates consistently.
///
/// The correction, on the samples a_i of a record of duration T:
///   1. the mean is removed, so that the taper draws the ends to the zero line;
///   2. both ends are tapered by w = 10 x3 - 15 x4 + 6 x5 over 2 % of T, at most 0.5 s and at least two samples:
///      the acceleration starts and ends at zero;
///   3. w q(t) is subtracted, q a polynomial of degree 3. Two of its four coefficients go into bringing velocity and
///      displacement to zero at the end; the other two make the mean square of the velocity least. That takes out the
///      trend of the velocity (a parabola and its like, from an instrument's drifting zero) with as little change to
///      the acceleration as it needs. The PGA moves by less than 0.2 % where the record's zero line is right; where it
///      is off (a mean of some per cent of the PGA), it moves by about as much as the line was off.
///
/// Where the study asks for it (`excitation.band_pass_hz`), a band-pass filter comes between 2 and 3
/// (`band_pass`: Butterworth of order 4, in the frequency domain, acausal, with padding), and the ends are
/// tapered once more, since it rings into them. Without it, what a record has of long-period noise above the order of
/// the polynomial stays. A permanent displacement of the ground is taken out with the drift, from which it cannot be
/// distinguished.
///
/// Velocity and displacement follow exactly from an acceleration that is linear between its samples.
/// The predominant frequency is that of the record as it stands, with or without the correction.
///
/// A record that was cut while the ground still moved cannot be distinguished from one with a wrong zero line: it is
/// brought to rest all the same, and its PGA may move by some per cent (`Motion::baseline` has the amount). An
/// example is an 18 s record of Spitak 1988 that begins and ends with 5 % of its PGA: the PGA grows by 3.5 %, one half
/// of it the mean, the other the polynomial. A band-pass from 0.05 Hz leaves 1.6 %. Such records want the filter.
///
/// @param filter part of the correction. @pre absent where there is none
/// @throws InputError if the record is too short or all zero (constant, where the baseline is corrected), or its
///         sampling is too coarse for the filter's high corner
Motion make_motion(const Record& record, bool correct_baseline, const std::optional<BandPass>& filter = {});

/// Acceleration measures of the record as it stands; velocity and displacement after the baseline correction.
/// @throws InputError as `make_motion`
IntensityMeasures intensity_measures(const Record& record);
/// All of the motion as it drives a structure.
IntensityMeasures intensity_measures(const Motion& motion);

/// Of two horizontal components of one recording with equal spacing, by a definition: PGA, PGV, PGD, Arias intensity
/// and CAV. Of their vector at once the Arias intensity is the sum of both, the CAV the integral of its length by the
/// trapezium rule. The others (duration, frequencies) are those of the first component; PGV / PGA is of both.
IntensityMeasures intensity_of_pair(const Motion& first, const Motion& second, OfPair definition);

/// Peak of the Fourier amplitude, smoothed with a Konno-Ohmachi window (b = 40), of the samples less their mean.
/// Looked for from two cycles in the record up to the Nyquist frequency, in steps of 0.25 %.
/// @return 0 if the samples are all equal
/// @pre dt_s > 0
double predominant_frequency(const std::vector<double>& acceleration_m_s2, double dt_s);

/// Pseudo-acceleration spectrum at the given periods [m/s2]: w2 times the largest displacement of the oscillator that
/// starts at rest, by the exact solution for an acceleration that is linear between samples, looked at 50 times a
/// period and 4 times a sample at least, until half a period after the record. Period 0: the PGA.
/// @pre periods >= 0, damping ratio in [0, 1)
std::vector<double> spectral_acceleration(const Record& record, const std::vector<double>& periods_s,
                                          double damping_ratio = 0.05);
std::vector<double> spectral_acceleration(const std::vector<double>& acceleration_m_s2, double dt_s,
                                          const std::vector<double>& periods_s, double damping_ratio = 0.05);

/// Pseudo-acceleration of two components by a definition; at once it is w2 times the largest length of the vector of
/// both displacements: RotD100 of Boore, "Orientation-independent, nongeometric-mean measures of seismic intensity from
/// two horizontal components of motion", Bulletin of the Seismological Society of America 100 (2010) 1830.
/// @pre equal spacing; period > 0
double spectral_acceleration_of_pair(const Motion& first, const Motion& second, double period_s, OfPair definition,
                                     double damping_ratio = 0.05);

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
