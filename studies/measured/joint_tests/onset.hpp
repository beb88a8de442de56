#pragma once
/// When a body on a board begins to move: a quantity that is constant up to a time, and follows a known motion from
/// then on, fitted to its samples by least squares.

#include "studies/measured/joint_tests/joint_run.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace stylobate {

/// The quantity against what it was before, positive in the direction in which it will move.
struct OnsetData {
    std::span<const double> values; ///< samples at equal intervals; NaN: not measured
    double step_s = 0;
    double sd = 0;          ///< of their noise
    std::size_t window = 0; ///< samples of which a mean must be clear of the noise
    std::size_t before = 0; ///< samples before that which are fitted too
};

/// A run on a board that is tilted.
struct BoardRun {
    JointRun seen;
    int side = 0;             ///< to which the body moves: -1 left, 1 right
    std::vector<double> tilt; ///< (nt) positive where it falls to that side [rad]
    double tilt_sd = 0;       ///< noise of a sample

    /// What moves to that side, with windows of 0.05 and 0.4 s times the root of the body's size.
    /// @param sd of the values' noise
    OnsetData data_of(std::span<const double> values, double sd) const;
};
/// Nothing where the run has no such joint or no tilt for each sample, or the body was not seen.
std::optional<BoardRun> board_run(const Specimen& specimen, const MeasuredRun& run);

/// First sample after which the mean of a window is farther from 0 than 6 of its standard deviations, and stays so for
/// the next window; nothing: it never moves, or more than half of the samples before are gaps.
std::optional<std::size_t> first_motion(const OnsetData& data);

/// The motion after an onset at `start` [samples, may be between them]: `fixed` and a column whose coefficient is
/// found.
struct OnsetMotion {
    double fixed = 0, column = 0;
};

struct OnsetFit {
    double start = 0;          ///< [samples]
    double start_sd = 0;       ///< [samples]
    double coefficient = 0;    ///< of the column; 0: there is none
    double coefficient_sd = 0; ///< at this start
    double per_start = 0;      ///< change of the coefficient with the start [1/sample]
    double scatter = 0;        ///< root mean square residual over the noise
};

/// @param motion (start, sample) -> motion, for samples after the start
/// @param has_column whether the coefficient is to be found
/// @param moved first sample of motion (`first_motion`);  @param most value up to which samples are used
/// @return nothing where there are fewer than 15 samples of motion, the value stays below `most` for more than three
///         times `before` (a body that is held or creeps), or the best start lies at an end of those tried
std::optional<OnsetFit> fit_onset(const OnsetData& data, std::size_t moved, double most, bool has_column,
                                  const std::function<OnsetMotion(double, std::size_t)>& motion);

/// Tilt of a board at a time between two samples, by a line.
struct TiltAt {
    double tilt = 0, sd = 0, rate = 0; ///< rate: per sample
};

/// @param at [samples];  @param reach samples on either side;  @param noise standard deviation of a sample
/// @return nothing where fewer than 10 of them were measured
std::optional<TiltAt> tilt_at(std::span<const double> tilt, double at, std::size_t reach, double noise);

} // namespace stylobate
