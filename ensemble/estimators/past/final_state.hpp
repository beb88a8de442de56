#pragma once
/// The final state of a realization against the state that was observed.
///
/// Their distance is the largest difference of a value over its tolerance; they agree where it is at most 1 (the
/// uniform kernel of `past_likelihood.hpp`). Where the sense of the shaking is unknown, the smaller one of the
/// distances from the observed state and from its mirror image (`mirror_image.hpp`).

#include <cstddef>
#include <span>
#include <vector>

namespace stylobate {

struct MeasuredState {
    std::vector<double> value;     ///< displacements and rotations; empty: nothing was measured, all agree
    std::vector<double> tolerance; ///< of each, > 0
    bool mirrored = false;
    /// Where a state has the value that is in the place of each in the mirror image; empty: in its own.
    std::vector<std::size_t> counterpart = {};
};

struct StateDistance {
    double value = 0;      ///< in tolerances
    std::size_t worst = 0; ///< the number of the value that differs most
    double found = 0;      ///< that value, of the mirror image where that is nearer
    bool agrees() const { return value <= 1; }
};

/// From the mirror image of the observed state. @param state as of `distance`
StateDistance mirror_distance(const MeasuredState& measured, std::span<const double> state);
/// @param state as many values as were measured, and behind them further ones that are counterparts alone
StateDistance distance(const MeasuredState& measured, std::span<const double> state);

} // namespace stylobate
