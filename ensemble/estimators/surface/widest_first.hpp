#pragma once
/// Which cells of a surface proceed to their next look: those that are undecided, the widest intervals first, until the
/// budget is spent.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace stylobate {

/// @param open   undecided cells, each with the width of its interval
/// @param budget of all cells together
/// @param after  trials of a cell at its next look, from those that it was asked for
/// @param asked  (cells) trials of each, which grow   @return whether any did
template <class After>
bool proceed_widest_first(std::vector<std::pair<double, std::size_t>> open, std::uint64_t budget, const After& after,
                          std::vector<std::uint64_t>& asked)
{
    std::stable_sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::uint64_t left = budget - std::accumulate(asked.begin(), asked.end(), std::uint64_t{0});
    bool more = false;
    for (const auto& [width, cell] : open) {
        const std::uint64_t add = after(asked[cell]) - asked[cell];
        if (add > left)
            break;
        asked[cell] += add;
        left -= add;
        more = true;
    }
    return more;
}

} // namespace stylobate
