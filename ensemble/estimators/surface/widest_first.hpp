#pragma once
/// Rounds of trials of the cells of a surface: those that are undecided proceed to their next look, the widest
/// intervals first, until the budget is spent.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

/// The first of ascending looks with more trials than these; the last one if there is none.
inline std::uint64_t next_look(const std::vector<std::uint64_t>& looks, std::uint64_t trials)
{
    const auto next = std::upper_bound(looks.begin(), looks.end(), trials);
    return next == looks.end() ? looks.back() : *next;
}

class WidestFirst {
public:
    /// @param budget trials of all cells together, enough for the first look of each
    WidestFirst(std::uint64_t budget, std::size_t cells) : budget_(budget), asked_(cells, 0) {}

    /// Trials of each cell after the next round: the first look of each, then more of those that are undecided. If they
    /// are the same as before, the rounds are finished.
    /// @param looks trials of a cell at each of its looks, ascending
    /// @param width of the interval of cell i; none where it is decided
    template <class Width>
    const std::vector<std::uint64_t>& next(const std::vector<std::uint64_t>& looks, const Width& width)
    {
        if (rounds_ == 0) {
            std::fill(asked_.begin(), asked_.end(), looks.front());
            ++rounds_;
            return asked_;
        }
        std::vector<std::pair<double, std::size_t>> open;
        for (std::size_t cell = 0; cell < asked_.size(); ++cell)
            if (asked_[cell] < looks.back())
                if (const std::optional<double> wide = width(cell))
                    open.emplace_back(*wide, cell);
        std::stable_sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        std::uint64_t left = budget_ - std::accumulate(asked_.begin(), asked_.end(), std::uint64_t{0});
        bool more = false;
        for (const auto& [wide, cell] : open) {
            const std::uint64_t add = next_look(looks, asked_[cell]) - asked_[cell];
            if (add > left)
                break;
            asked_[cell] += add;
            left -= add;
            more = true;
        }
        rounds_ += more;
        return asked_;
    }
    const std::vector<std::uint64_t>& asked() const { return asked_; }
    std::uint64_t rounds() const { return rounds_; }

private:
    std::uint64_t budget_;
    std::vector<std::uint64_t> asked_; ///< (cells)
    std::uint64_t rounds_ = 0;
};

} // namespace stylobate
