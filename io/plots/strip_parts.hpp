#pragma once
/// What the pictures of one realization share, in the plane and in space.

#include "ensemble/model/trajectory.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace stylobate {

/// What a length is drawn in.
struct Unit {
    const char* name;
    double per_metre;
};

/// mm below 1 m, else m. @param largest length to be drawn [m]
Unit unit_for(double largest);

/// The largest of 1, 2, 5, 10, 20... that is not above `length` (> 0).
double round_step(double length);

/// Whether a block has fallen by then. @param fall_time_s of the blocks, as in `Outcome`; empty: not known
bool has_fallen(const std::vector<double>& fall_time_s, std::size_t block, double time_s);

/// @throws InputError if the lists of the trajectory do not fit each other, or the fall times its blocks
void check_trajectory(const Trajectory& t, const std::vector<double>& fall_time_s);
/// @param good samples before the first that is not finite   @throws InputError if nothing can be drawn
void check_some_sample(const Trajectory& t, std::size_t good);

/// The samples of snapshots, as `snapshot_samples` describes.
/// @param samples number of them   @param departure how far the blocks are at a sample from where they are at another
/// @throws InputError if the number of snapshots is out of range
std::vector<std::size_t> choose_samples(std::size_t samples, std::size_t snapshots,
                                        const std::function<double(std::size_t sample, std::size_t from)>& departure);

} // namespace stylobate
