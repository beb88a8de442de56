#pragma once
/// A base motion in closed form that the host evaluates: pulses and sines, scaled to a PGA.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/synthetic_pulse.hpp"
#include "ensemble/motion/synthetic_sine.hpp"

#include <span>
#include <variant>

namespace stylobate {

/// Starts at rest at t = 0 and is at rest from `duration_s()` on.
class SyntheticMotion {
public:
    /// @pre `covers(excitation.kind)`
    SyntheticMotion(const ExcitationSpec& excitation, const RealizationHeader& realization);

    static bool covers(ExcitationKind kind);
    /// That of the motion of a realization, without making it [s].
    static double duration_s(const ExcitationSpec& excitation, const RealizationHeader& realization);

    double duration_s() const { return duration_s_; }
    /// Frequency of its fastest component [Hz].
    double fastest_hz() const;
    double displacement_m(double time_s) const;
    /// Displacements at the times (first + i) step_s.
    void sample(double first, double step_s, std::span<double> displacements_m) const;
    double acceleration_m_s2(double time_s) const;

private:
    using Shape = std::variant<RickerWavelet, VelocityPulse, TaperedSine, SineSweep>;
    static Shape shape_of(const ExcitationSpec& excitation, const RealizationHeader& realization);

    Shape shape_;
    double scale_ = 1;
    double duration_s_ = 0;
    double end_m_ = 0; ///< displacement from then on
};

/// Along samples so dense that the error of the spline through them is 2e-6 of its fastest part. The caller sets its
/// predominant frequency.
Motion sampled(const SyntheticMotion& motion);

/// Largest length of the vector of two accelerations, as exact as `peak_acceleration`.
double peak_at_once(const SyntheticMotion& first, const SyntheticMotion& second);

/// Largest |acceleration| of a shape of unit amplitude, to 1e-12 of it: sampled 32 times a cycle of its fastest
/// component, and refined around every peak close to the largest one by golden-section search (Kiefer, "Sequential
/// minimax search for a maximum", Proceedings of the American Mathematical Society 4 (1953) 502).
template <class Shape>
double peak_acceleration(const Shape& shape);

} // namespace stylobate
