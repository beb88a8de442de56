#pragma once
/// The motion of the table in a measured run: one consistent history from all sensors that saw it.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/motion.hpp"

#include <vector>

namespace stylobate {

/// How well a sensor goes with the motion.
struct SensorFit {
    int samples = 0;      ///< 0: not there
    double noise_sd = 0;  ///< taken for it: as declared, else from its high-order differences
    double misfit_sd = 0; ///< root mean square of measured minus smoothed, its constant offset taken out
    double offset = 0;    ///< constant, measured minus true: bias of the accelerometer, zero of the cameras
    double offset_sd = 0; ///< one standard deviation; 0 where no offset was looked for
};

struct MeasuredMotion {
    Motion motion;                            ///< its first sample is at the first time of the run's clock
    std::vector<double> displacement_sd_m;    ///< (n) one standard deviation
    std::vector<double> acceleration_sd_m_s2; ///< (n)
    SensorFit accelerometer;                  ///< m/s2
    SensorFit displacement;                   ///< m
    SensorFit cameras;                        ///< m, their view of the table
    bool assumed_at_rest = false;             ///< only the acceleration is there: rest at the start, and at a quiet end
};

/// The most likely motion, given the acceleration with a constant bias, the displacement, and the table as the cameras
/// see it with a constant zero of theirs, whichever are there. Between samples the acceleration is linear, as `Motion`
/// has it, so that its exact double integral is the displacement. The jerk is white, or a random walk: the likelier of
/// the two, with the likeliest intensity. Kalman's filter and the smoother of Rauch, Tung and Striebel in the form of
/// Bryson and Frazier, which inverts no matrix (de Jong 1989). The samples are equally spaced in time even where those
/// of the run are not; what is missing (NaN, a gap of the clock) is bridged. The run need not begin at rest:
/// velocity and displacement then begin with other values than 0. A command is used like a sensor.
///
/// @throws InputError if nothing of the base was measured, if the clock does not grow, or if there are fewer than 8
///         samples
MeasuredMotion smoothed_base_motion(const MeasuredRun& run);

/// Only the motion.
Motion base_motion_of(const MeasuredRun& run);

} // namespace stylobate
