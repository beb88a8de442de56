#pragma once
/// From a record to a base motion: baseline, integration, intensity measures.

#include "ensemble/motion.hpp"
#include "io/record.hpp"

#include <vector>

namespace stylobate {

struct IntensityMeasures {
    double pga_m_s2 = 0;
    double pgv_m_s = 0;
    double pgd_m = 0;
    double arias_m_s = 0;
    double d5_95_s = 0;
    double predominant_frequency_hz = 0; ///< peak of the Fourier amplitude smoothed with a Konno-Ohmachi window, b = 40
    double mean_frequency_hz = 0;        ///< inverse of the mean period of Rathje et al.
};

/// Drives a structure with the record: corrects the baseline where asked, integrates consistently.
/// @throws InputError if the record is too short or all zero
Motion make_motion(const Record& record, bool correct_baseline);

/// Acceleration measures of the record as it stands; velocity and displacement after the baseline correction.
IntensityMeasures intensity_measures(const Record& record);

/// 5 % pseudo-acceleration spectrum at the given periods [m/s2].
std::vector<double> spectral_acceleration(const Record& record, const std::vector<double>& periods_s,
                                          double damping_ratio = 0.05);

} // namespace stylobate
