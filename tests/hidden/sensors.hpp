#pragma once
/// What cameras and sensors give of a run: values with noise.

#include "ensemble/model/campaign.hpp"
#include "tests/hidden/specimen.hpp"

#include <vector>

namespace stylobate::hidden {

inline constexpr double sensor_m_s2 = 0.02; ///< noise of the table's accelerometer, 1 sigma

/// Adds normal noise to a series, and states it there.
void add_noise(Series& series, double sd, Draws& draws);

/// What the cameras see of bodies.
/// @param places (nt x bodies) x, y and rotation; a null pointer where a body is not seen: NaN there
/// @param zero_m where the table stood that day, added to x
SeenMotion by_cameras(const std::vector<const BodyState*>& places, double zero_m, const Planned& planned,
                      Draws& cameras);

} // namespace stylobate::hidden
