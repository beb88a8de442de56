#pragma once
/// The base motion of a record as plain data, ready to drive a structure.

#include <string>
#include <vector>

namespace stylobate {

/// Acceleration that is linear between equally spaced samples, with the velocity and displacement that follow from it
/// exactly (v += d (a0 + a1) / 2, u += v d + d2 (a0 / 3 + a1 / 6)); at rest before the first sample.
struct Motion {
    double dt_s = 0;                       ///< sample spacing d
    std::vector<double> acceleration_m_s2; ///< (n)
    std::vector<double> velocity_m_s;      ///< (n)
    std::vector<double> displacement_m;    ///< (n)
    double pga_m_s2 = 0;                   ///< largest |acceleration|
    double predominant_frequency_hz = 0;   ///< peak of the smoothed Fourier amplitude
    std::string source;                    ///< file and component, for messages and results

    bool empty() const { return acceleration_m_s2.empty(); }
    double duration_s() const { return empty() ? 0 : dt_s * static_cast<double>(acceleration_m_s2.size() - 1); }
};

} // namespace stylobate
