#pragma once
/// Times of many realizations in bounded memory.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stylobate {

/// How often each time came. As long as few different times have come they are kept as they are; then all of them, and
/// those that follow, are rounded to the middles of intervals whose ends are 4096 to an octave. What is held depends on
/// which times came alone, not on their order, nor on where a run was interrupted.
class TimeCounts {
public:
    /// Each time and how often it came, in the order of the times.
    using Counts = std::vector<std::pair<double, std::uint64_t>>;

    /// Different times that are kept exactly.
    static constexpr std::size_t most_exact = 4096;
    /// A rounded time is off by at most this part of it.
    static constexpr double rounding = 0x1p-13;

    TimeCounts() = default;
    /// As `counts()` and `exact()` were.
    TimeCounts(Counts counts, bool exact) : counts_(std::move(counts)), exact_(exact) {}

    /// @pre time_s >= 0 and finite
    void add(double time_s);
    /// All times of another: as if they had been added one by one.
    void add(const TimeCounts& other);

    const Counts& counts() const { return counts_; }
    bool exact() const { return exact_; }
    /// Times in all.
    std::uint64_t total() const;
    /// The mean of the two middle ones where they are even in number; NaN without any. Where the times are rounded it
    /// is off by at most `rounding` of it.
    double median() const;

private:
    /// Rounds all times where there are too many different ones, or if it is asked for.
    void limit(bool round);

    Counts counts_;
    bool exact_ = true;
};

} // namespace stylobate
