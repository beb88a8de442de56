#pragma once
/// The order in which the places of a run are started.
///
/// The longest realization decides how long a run takes whose other realizations are stepped beside it, so it must not
/// be started last. A run on devices therefore starts its longest places first, then all others in their own order. Few
/// places are moved, so that the share of the whole can still be stated from the completed blocks (`DoneSet::sample`):
/// a block counts once all of it is done, whenever its places were started.

#include "ensemble/numerics/run_order.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace stylobate {

/// So many places are looked at: the first ones of a longer run.
inline constexpr std::uint64_t most_looked_at = 1 << 20;
/// Runs whose longest place is at most so many times the mean have no longest places: their order makes no difference.
inline constexpr double equally_long = 1.1;

/// Places by how many steps they may take, the longest first; of equally long ones the first in the run order.
/// @param places of which those that are not done are looked at
/// @param most   so many are returned
/// @param most_steps (place) about the most steps of its realization; called from several threads at once
/// @throws what `most_steps` throws
std::vector<std::uint64_t> longest_places(RunOrder::Places places, const DoneSet& done, std::size_t most,
                                          const std::function<double(std::uint64_t place)>& most_steps);

/// Gives the places of a run one by one. Its functions may be called from several threads at once.
class StartOrder {
public:
    using Next = std::function<std::optional<std::uint64_t>()>;

    /// @param next gives all places that are to be run in their order; called from several threads at once, may wait
    explicit StartOrder(Next next) : next_(std::move(next)) {}

    /// Before the first place is given: these are started before all others.
    /// @param longest the longest one first   @param apart so many of them are given by `next_apart` alone
    void start_first(std::vector<std::uint64_t> longest, std::size_t apart);

    /// The next place: what was given back, then the longest ones that are not kept apart, then the others.
    std::optional<std::uint64_t> next();
    /// The longest of those that are kept apart.
    std::optional<std::uint64_t> next_apart();
    /// A place that was begun in vain: it is started anew.
    void give_back(std::uint64_t place);

private:
    Next next_;
    std::mutex mutex_;                   ///< guards what follows
    std::vector<std::uint64_t> longest_; ///< the longest one first
    std::vector<std::uint64_t> moved_;   ///< the same places in their order
    std::size_t apart_begin_ = 0, apart_end_ = 0, longest_begin_ = 0;
    std::vector<std::uint64_t> returned_;
};

} // namespace stylobate
