#pragma once
/// One realization over time, for pictures, pages, films and other programs; and the pictures that the results of every
/// kind have: that of a realization, and the order of falls.

#include "io/plots/figure.hpp"
#include "io/plots/plot_order.hpp"
#include "kernels/isa.hpp"
#include "studies/experiment/motions.hpp"
#include "studies/results/results.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// A realization over time, wherever it comes from; its number is that of the trajectory.
struct TracedMotion {
    Trajectory trajectory;
    std::vector<double> fall_time_s; ///< (blocks)
    State state = State::stood;
    double frequency_hz = 0, pga_m_s2 = 0;
    double azimuth_rad = std::numeric_limits<double>::quiet_NaN(); ///< of the fall, in space; NaN: there is none
};
/// The trajectory that the file holds, or else the realization run again.
/// @throws InputError if there is no such realization, or if none can be run again
TracedMotion traced_motion(const Results& results, Isa isa, std::uint64_t index);

/// Of a study of motions, under which one a realization was: "motion pulse_3 at PGV 0.8 m/s"; of others nothing.
std::optional<std::string> motion_words(const Results& results, const ResultRow& row);
/// The shaking of a realization: `motion_words`, or "2.5 Hz, 4 m/s²", with the direction where there are several; ""
/// where there is no frequency.
std::string shaking_words(const Results& results, const ResultRow& row);
/// "column, realization 7: motion pulse_3 at PGV 0.8 m/s".
std::string realization_title(const Results& results, std::uint64_t index);

/// One realization over time.
/// @param title nullopt: from the results, the realization and its outcome
/// @throws InputError as `plot_strip` does
void strip_picture(const Results& results, const TracedMotion& motion, const std::optional<std::string>& title,
                   const std::filesystem::path& file);

/// One realization over time as curves of a page: displacement of the base, and of blocks against the base and their
/// place in the reference stack. Of a structure of many blocks: the top of each column, and the epistyles, as many as
/// have colours. One figure for each horizontal direction of the model: x, and in space z.
std::vector<Figure> history_figures(const Results& results, const TracedMotion& motion);

/// Which blocks fell, in which order and when, for its picture.
/// @param names of the blocks, as many as each row has fall times
FallOrder fall_order(const std::vector<std::string>& names, const std::vector<ResultRow>& rows,
                     const MotionGroups& motions = {});

/// Which blocks fall, in which order and when.
/// @param cell of a surface; -1: all realizations
/// @param title nullopt: by the results and the cell
/// @throws InputError if there is no such cell, if the run is not complete, and as `plot_order` does
void order_picture(const Results& results, long long cell, const std::optional<std::string>& title,
                   const std::filesystem::path& file);

} // namespace stylobate
