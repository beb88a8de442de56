#pragma once
/// Checks of measured data, and the estimates from samples alone that they need: noise, how long nothing moves, and
/// where the blocks are meanwhile.

#include "ensemble/model/campaign.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace stylobate {

/// All checks: the specimen, then run by run clocks, units, missing values, noise, saturation, offsets, rest places and
/// collapses, then repeats against each other. Adds to the findings of a campaign. @pre its shapes are right
/// @throws InputError for what cannot be used
void check_campaign(Campaign& campaign);

/// Standard deviation of white noise upon a signal that is smooth from sample to sample: the p-th difference of noise
/// has the deviation sqrt((2p)! / (p!)2) sd, while that of the signal goes down with p. The smallest of p = 1 ... 8, by
/// the median of absolute values, so that knocks and gaps (NaN) do not count. 0 where there are fewer than 32
/// neighbouring samples.
/// @param stride  from one sample to the next, for a column of a table
double noise_of(std::span<const double> values, std::size_t stride = 1);

/// Mean of a column of a table over its first samples, as far as they were observed. NaN: none was
/// @param stride  from one sample to the next
double mean_seen(std::span<const double> values, std::size_t samples, std::size_t column, std::size_t stride);

/// How many samples a run begins with before its base moves: half of those whose acceleration stays what it was in the
/// first ten, as slow beginnings are seen late. 0 where these are fewer than 20, or no acceleration was measured.
std::size_t samples_at_rest(const MeasuredRun& run);

/// (blocks) Where each block lies before the base moves, beside its nominal place [m]: from the table where the cameras
/// see it, else from their own zero. Means of the first samples. NaN: not seen
/// @param samples that are counted   @pre the places of the blocks were measured
std::vector<double> places_at_rest(const Specimen& specimen, const MeasuredRun& run, std::size_t samples);

} // namespace stylobate
