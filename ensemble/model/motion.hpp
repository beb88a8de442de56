#pragma once
/// A sampled base motion (a record, a table of samples, noise) as plain data, ready to drive a structure.

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// What one number states of the strength of two horizontal components a1 and a2 (of accelerations, and of the
/// responses of an oscillator to them). P1 and P2 are their largest sizes.
enum class OfPair {
    first,          ///< P1
    larger,         ///< the larger one of P1 and P2
    geometric_mean, ///< sqrt(P1 P2)
    at_once         ///< the largest length of the vector (a1, a2)
};

/// Corners of a Butterworth filter of order 4 (io/records/ground_motion.hpp) [Hz].
struct BandPass {
    double low_hz = 0;
    double high_hz = 0;

    friend bool operator==(const BandPass&, const BandPass&) = default;
};

/// What the correction of a record's baseline has done. What is left at the end is that of a motion that starts at
/// rest with the record's first sample.
struct BaselineReport {
    double residual_velocity_before_m_s = 0; ///< at the end of the record as it stands
    double residual_displacement_before_m = 0;
    double residual_velocity_m_s = 0; ///< at the end of the corrected one
    double residual_displacement_m = 0;
    double pga_before_m_s2 = 0;
    double pga_m_s2 = 0;
    double pgv_m_s = 0; ///< of the corrected one
    double pgd_m = 0;
    double pga_change() const { return pga_m_s2 / pga_before_m_s2 - 1; }
};

/// Acceleration that is linear between equally spaced samples, with the velocity and displacement that follow from it
/// exactly (v += d (a0 + a1) / 2, u += v d + d2 (a0 / 3 + a1 / 6)); at rest before the first sample, or where it is
/// measured at the velocity that it has there.
struct Motion {
    double dt_s = 0;                       ///< sample spacing d
    std::vector<double> acceleration_m_s2; ///< (n)
    std::vector<double> velocity_m_s;      ///< (n)
    std::vector<double> displacement_m;    ///< (n)
    double pga_m_s2 = 0;                   ///< largest |acceleration|
    double predominant_frequency_hz = 0;   ///< peak of the smoothed Fourier amplitude
    bool corrected = false;                ///< whether the baseline was corrected
    std::optional<BandPass> band_pass;     ///< the filter that was part of it
    BaselineReport baseline;               ///< of a record, corrected or not
    std::string source;                    ///< file and component, for messages and results
    std::optional<bool> is_vertical = {};  ///< by the names in its file; nullopt: its direction is not stated

    bool empty() const { return acceleration_m_s2.empty(); }
    double duration_s() const { return empty() ? 0 : dt_s * static_cast<double>(acceleration_m_s2.size() - 1); }
};

/// Largest absolute value; 0 of none.
double peak(const std::vector<double>& values);

/// By a definition, of the largest sizes of both components and the largest length of their vector.
double size_of_pair(OfPair definition, double first, double second, double at_once);

/// Largest length of the vector of two quantities that are linear between their samples: it is at a sample.
/// @pre both have the same spacing; the shorter one is 0 after its end
double peak_at_once(const std::vector<double>& first, const std::vector<double>& second);

/// Velocity and displacement of an acceleration that is linear between its samples, from rest.
struct Integrated {
    std::vector<double> v, u; ///< (n)
};
Integrated integrate(const std::vector<double>& acceleration, double dt_s);

/// The acceleration at the samples of a motion that passes through all displacements and has linear acceleration
/// between them (a cubic spline): at rest before the first one, without acceleration at the last one. Of a sine its
/// error is at most 5 (w d)4 / 384 of the displacement.
/// @pre two displacements at least
std::vector<double> acceleration_through(const std::vector<double>& displacement_m, double dt_s);

/// The motion of an acceleration from rest. Its predominant frequency is left to the caller.
Motion motion_of(std::vector<double> acceleration_m_s2, double dt_s);

} // namespace stylobate
