#pragma once
/// How well free windows predict what was seen: the logarithmic score of Student's t, whose long tails forgive the few
/// windows in which an impact went the other way.
///
///   score = sum over residuals of  log t_4(r / (k s)) - log(k s),   s = noise + lag x |local speed|
///
/// s is known before any model runs; k, one for each block, coordinate and state (rocking or quiet), is fitted.

#include "ensemble/tracking/tracking_targets.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

inline constexpr double student_degrees = 4;

/// Log density of Student's t with these degrees of freedom at `t`.
double log_student(double t, double degrees);

/// The k that makes the t density of z / k likeliest: the root of k2 = (degrees + 1) / n sum z2 / (degrees + z2 / k2).
/// NaN without any z.
double student_scale(const std::vector<double>& z, double degrees);

/// One number that a window is scored by.
struct SeenValue {
    std::size_t time = 0;  ///< which of the window's
    std::size_t block = 0; ///< of the realization
    BlockCoordinate coordinate = BlockCoordinate::x;
    double value = 0;     ///< as seen
    double scale = 0;     ///< s, in the unit of the coordinate
    std::size_t kind = 0; ///< of k: (block x coordinate_count + coordinate) x 2 + rocking
};

/// The residuals that score a window: every block and coordinate at every time of it that was seen. Noise that nobody
/// knows is none.
std::vector<std::vector<SeenValue>> seen_values(const SeenRun& run, const std::vector<SeenWindow>& windows,
                                                double lag_s);
/// Number of kinds of k for a number of blocks.
inline std::size_t residual_kinds(std::size_t blocks)
{
    return blocks * coordinate_count * 2;
}

/// Model less measurement, over s; where the model was no longer finite a residual that no good model has (1e4).
/// @param rest_y_m (blocks) heights at which the model stands, from which its rise counts
std::vector<double> residuals(const std::vector<SeenValue>& seen, const Readings& readings, std::size_t blocks,
                              const std::vector<double>& rest_y_m);

/// Residuals over s of many windows, by kind.
class ResidualScales {
public:
    ResidualScales() = default;
    explicit ResidualScales(std::size_t kinds) : z_(kinds), k_(kinds, 1) {}

    void add(const std::vector<SeenValue>& seen, const std::vector<double>& z);
    /// Kinds with fewer than 12 residuals share one k with all of their coordinate and state.
    void fit();
    double k(std::size_t kind) const { return k_[kind]; }

    /// Score of one window.
    double score(const std::vector<SeenValue>& seen, const std::vector<double>& z) const;

private:
    std::vector<std::vector<double>> z_; ///< (kinds)
    std::vector<double> k_;              ///< (kinds)
};

} // namespace stylobate
