#pragma once
/// What the realizations of every model have in common: what shakes them, their step, and what was drawn. Plain data,
/// SI units.

#include "ensemble/model/motion.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace stylobate {

/// Changes of the horizontal motion of the base before it reaches the structure (`base_motion.hpp`). Every default
/// is neutral. With psi the phase of the motion, u = |z| sin psi (`distortion.hpp`), the distortion adds
/// second |z| sin 2 psi + second_quadrature |z| cos 2 psi, and the same of the third order.
struct BaseChange {
    double gain = 1;              ///< sensor_gain: true motion over the one that the study names
    double offset_s = 0;          ///< time_offset: at time t the base is where the named motion is at t + offset
    double second = 0;            ///< harmonic_distortion, as parts of the displacement
    double second_quadrature = 0; ///< the same, a quarter of a period apart
    double third = 0;
    double third_quadrature = 0;
    bool distorts() const { return second != 0 || second_quadrature != 0 || third != 0 || third_quadrature != 0; }
    friend bool operator==(const BaseChange&, const BaseChange&) = default;
};

/// What every model's realization has: its index, its shaking, its step and what was drawn.
struct RealizationHeader {
    std::uint64_t index = 0;
    BaseChange change;
    double frequency_hz = 0; ///< of the sine or pulse; of noise the ground's; of a record the predominant one
    double pga_m_s2 = 0;
    double phase_rad = 0;
    double pulse_gamma = 0; ///< oscillatory character of a velocity pulse
    /// The base motion that is this realization's own (noise, a distorted one, one of a set), else null.
    std::shared_ptr<const Motion> motion;
    double motion_scale = 1; ///< factor on its own motion
    /// Vertical base motion of its own, which starts with the shaking; else null.
    std::shared_ptr<const Motion> vertical;
    /// Rotation of the base as a function of time, counter-clockwise: what is a displacement in m there is an angle in
    /// rad here. It starts with the shaking; null: the base does not turn. In the plane alone.
    std::shared_ptr<const Motion> tilt;

    // In space (`motions_in_space`): what is above is the first component of the shaking, along `direction_rad`.
    double direction_rad = 0; ///< azimuth of the first component, from x towards z
    /// PGA of the first component over `pga_m_s2`, which is the pair's (`ExcitationSpec::pga_of_pair`).
    double first_share = 1;
    /// Samples of the second component, in the time and with the factor of the first one's; null: there is none, or
    /// it is in closed form.
    std::shared_ptr<const Motion> second;

    double gravity_m_s2 = 9.81;
    double step_s = 0;
    std::vector<double> inputs; ///< drawn values in the order of `input_names(study)`
};

/// Scales of a structure, which decide when a realization has ended. Each model computes them.
struct Scales {
    double p_rad_s = 0;      ///< sqrt(3 g / (4 R)), R half the diagonal of a whole column of the free drums
    double barrier_j = 0;    ///< least energy that overturns any part of a column, or an epistyle, about its edge
    double width_m = 0;      ///< mean width of the free drums
    double least_size_m = 0; ///< smallest half size of the free blocks
};

} // namespace stylobate
