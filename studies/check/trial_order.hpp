#pragma once
/// Which realizations a trial runs: an order of all of them, always the same, of which every beginning is spread evenly
/// over the study, however short it is. (`RunOrder` is fair in whole blocks only, which a trial of a slow study does
/// not reach.)
///
/// Point n of the order is the n-th point of an additive recurrence over rows, columns and the realizations of a cell,
/// frac(1/2 + n / g), frac(1/2 + n / g^2), ... with g the real root of g^(d+1) = g + 1, d the number of these that are
/// more than one: the golden ratio for one, the plastic number for two (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018; for one dimension Knuth, "The Art of Computer Programming", volume 3, section 6.4). A
/// realization that has been taken is replaced by the next one of its cell, in a full cell by one of the next cell.

#include "ensemble/model/study.hpp"

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace stylobate {

class TrialOrder {
public:
    /// @param begin, end indices: all realizations of the study, or a range of whole cells of it (`TwinRange`)
    TrialOrder(const Study& study, std::uint64_t begin, std::uint64_t end);

    /// The next ones, ascending; fewer where fewer are left.
    std::vector<std::uint64_t> next(std::uint64_t count);
    std::uint64_t taken() const { return taken_.size(); }
    std::uint64_t total() const { return end_ - begin_; }

private:
    std::uint64_t begin_, end_;
    std::array<std::uint64_t, 3> counts_{1, 1, 1}; ///< rows, columns, realizations of a cell
    std::array<double, 3> step_{0, 0, 0};
    std::uint64_t point_ = 0;
    std::unordered_set<std::uint64_t> taken_;
};

} // namespace stylobate
