#pragma once
/// The final states of realizations against one that was observed, and which of them agree with it.
///
/// The distance of two states is the largest difference of a value over its tolerance; they agree where it is at most 1
/// (the uniform kernel of `past_likelihood.hpp`). Where the sense of the shaking is unknown, it is the smaller one of
/// the distances from the observed state and from its mirror image (`mirror_image`).

#include "ensemble/model/structure.hpp"

#include <cstddef>
#include <functional>
#include <optional>
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

/// The realizations that stand.
struct StandingStates {
    std::vector<std::size_t> cell; ///< of each
    std::vector<double> value;     ///< (realizations x values) of the states

    std::size_t width() const { return cell.empty() ? 0 : value.size() / cell.size(); }
    std::span<const double> state(std::size_t r) const { return std::span(value).subspan(r * width(), width()); }
};

/// States sorted by their first value: only those near a given one are compared, so that thousands of simulated
/// monuments can be judged by all realizations.
class AgreeingStates {
public:
    /// @param measured whose tolerances and counterparts hold for all that is looked for
    /// @pre at least one value is measured; both outlive this object
    AgreeingStates(const StandingStates& standing, const MeasuredState& measured);

    /// Calls f(r) once for each state that agrees with these values, or whose mirror image does.
    /// @param seen (measured values)
    void each(const std::vector<double>& seen, const std::function<void(std::size_t r)>& f) const;

private:
    /// States in the order of one of their values.
    struct Order {
        std::size_t value = 0;
        std::vector<std::size_t> states;
    };
    Order sorted_by(std::size_t value) const;
    std::span<const std::size_t> between(const Order& order, double from, double to) const;

    const StandingStates& standing_;
    MeasuredState measured_;
    Order as_is_, mirrored_;
};

// A structure seen from behind: shaking of the other sense leaves it in the mirror image of the state.
//
// The state of a block or joint is then that of the one in its place on the other side, with the other sign. Of one
// column it is its own; of a colonnade the columns change places.

/// The block and the bed that stand in the place of each.
struct MirrorImage {
    std::vector<std::size_t> blocks, beds; ///< of `Layout`
};

/// Sizes, masses and places have to be alike to 1e-6; offsets of drums within a column do not count. Nothing: seen from
/// behind it is another structure.
std::optional<MirrorImage> mirror_image(const Layout& layout);

} // namespace stylobate
