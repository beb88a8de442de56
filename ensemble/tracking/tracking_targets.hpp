#pragma once
/// From what cameras saw to what the model is nudged towards and compared with.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/tracking/tracking.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

/// Coordinates of a block, in the order of all arrays here.
enum class BlockCoordinate { x, y, theta };
inline constexpr std::size_t coordinate_count = 3;

/// A run as the model sees it: time from the beginning of the base motion, displacements from where the blocks stood
/// before it, in the frame of the base. Blocks in the order of a realization; fixed ones, and those that were not
/// measured, are NaN.
struct SeenRun {
    std::size_t blocks = 0;
    std::vector<double> time_s; ///< (nt)
    std::vector<double> base_m; ///< (nt) displacement of the base
    /// (nt x blocks) x and y of the centre [m], rotation [rad]
    std::array<std::vector<double>, coordinate_count> seen;
    /// (nt x blocks) smoothed, and its rate [m, m/s, rad, rad/s]
    std::array<std::vector<double>, coordinate_count> smooth;
    std::array<std::vector<double>, coordinate_count> rate;
    std::array<double, coordinate_count> noise_sd{}; ///< of a sample
    std::vector<double> standing_x_m; ///< (blocks) where it stood, against its place in the plan; NaN: not measured
    double quiet_s = 0;               ///< before this the base hardly moves
    double end_s = 0;                 ///< after this nothing is to be predicted: a collapse, or the end
};

/// How long and how strongly, for a specimen of this size: all times go with the pendulum time sqrt(size / g).
struct TrackingScales {
    double smoothing_s = 0; ///< half width of the smoothing
    double nudge_rad_s = 0; ///< w
    double window_s = 0;    ///< length of a free window
    double lag_s = 0;       ///< error in time that a good prediction may have: the scale of a residual is the noise and
                            ///< this x the local speed
};

/// @param size_m of a drum (its width); drums of 48 mm: nudging 60 rad/s, windows of 0.2 s, lag 20 ms; of 1.5 m: 24
/// rad/s,
///        1.1 s, 0.11 s. (The nudging grows more slowly than 1 / time as drums shrink: their noise is larger in
///        comparison.)
TrackingScales tracking_scales(double size_m, double gravity_m_s2);

/// @param base      the base motion that drives the model, from the run's first sample on
/// @param order     (blocks of the specimen) their places in the realization
/// @param plan_x_m  (blocks of the realization) where they stand in the plan
/// @return a run without any block in it (`blocks` == 0) where nothing was measured that the model could track
SeenRun seen_run(const MeasuredRun& run, const Motion& base, const std::vector<int>& order,
                 const std::vector<double>& plan_x_m, double smoothing_s);

/// The smoothed motion as targets; evenly spaced at the mean rate of the cameras.
Targets targets_of(const SeenRun& run);

/// A window and the samples it is compared with.
struct SeenWindow {
    FreeWindow window;             ///< read at the times of `rows`
    std::vector<std::size_t> rows; ///< samples: the middle and the end
};

/// The window of this length from a time on; nothing where the run has too few samples there.
std::optional<SeenWindow> window_at(const SeenRun& run, double start_s, double length_s);

/// Windows one after the other from the end of the quiet part to `end_s`.
std::vector<SeenWindow> windows_of(const SeenRun& run, double length_s);

} // namespace stylobate
