#pragma once
/// The motion of the table in a measured run: one consistent history from all sensors that saw it.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/motion.hpp"
#include "io/records/record.hpp"

#include <filesystem>
#include <optional>
#include <string>
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

// The base motion of `excitation.kind = "table"`: samples as they stand, nothing corrected.

/// Reads a file of columns with one line of names above: time_s, and acceleration_m_s2 or displacement_m; other columns
/// are left alone. The unit is part of the name and may be another (time_ms, acceleration_g, displacement_mm). Blanks,
/// tabs, commas or semicolons between them; lines that begin with # are comments. Times are uniform.
///
/// The motion begins at rest with the first sample. An acceleration is linear between its samples; where there is none,
/// it is that of the cubic spline through the displacements, counted from the first one. Where there are both, or where
/// a run of a measured campaign is named, it is the motion that goes best with all (`measured_motion.hpp`).
///
/// Accelerations up to 1000 m/s2 are taken from a column of them (a base that is hit), up to 50 m/s2 from the others.
///
/// @param pga `any`: of any acceleration
/// @param run of a measured campaign (an HDF5 file, a folder, its TOML file); nullopt: the file is one of columns
/// @throws InputError if it cannot be read, lacks the columns or the run, has times that are not uniform, too few
///         samples, does not move, or is faster than that
Motion read_base_table(const std::filesystem::path& file, const std::optional<std::string>& run = {},
                       PgaRange pga = PgaRange::usual);

} // namespace stylobate
