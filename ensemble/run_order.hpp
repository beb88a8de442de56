#pragma once
/// In which order realizations are run, and which places of that order are done.
///
/// Indices are systematic: cell by cell, frequency by frequency. Run in that order, a part of a study is a corner of
/// it. Here any first part is spread evenly over all indices: place p has the index
///
///   i(p) = a p mod n,   a / n near the golden ratio's inverse, a and n without a common divisor
///
/// The first m places leave gaps between neighbouring indices that differ by a small factor only (the three-gap
/// theorem; the factor is small because the continued fraction of a / n has small quotients, which is how a is chosen).
/// So the first part of a run is a fair sample of the whole. Indices and outcomes do not depend on the order.

#include <cstdint>
#include <map>

namespace stylobate {

class RunOrder {
public:
    /// @param total n; 0: an order of nothing
    explicit RunOrder(std::uint64_t total);
    std::uint64_t index(std::uint64_t place) const;
    std::uint64_t place(std::uint64_t index) const;

private:
    std::uint64_t total_;
    std::uint64_t step_ = 1, back_ = 1; ///< a, and its inverse mod n
};

/// Places that are done, and how many of their realizations collapsed or are invalid, as intervals: as many as there
/// are gaps, which are as many at most as realizations are stepped at the same time.
class DoneSet {
public:
    struct Part {
        std::uint64_t end = 0; ///< first place behind it
        std::uint64_t collapsed = 0, invalid = 0;
        std::uint64_t done(std::uint64_t begin) const { return end - begin; }
        bool operator==(const Part&) const = default;
    };

    bool has(std::uint64_t place) const;
    /// @pre !has(place)
    void add(std::uint64_t place, bool collapsed, bool invalid);
    /// By their beginning, in order, apart from each other.
    const std::map<std::uint64_t, Part>& parts() const { return parts_; }
    /// Adds an interval behind all others. @returns false if it is not, or if its counts do not fit
    bool append(std::uint64_t begin, const Part& part);

    /// Sum of all parts; `end` is the number of places.
    Part all() const;
    /// The part from place 0 on without a gap: no realization of it is missing because it takes long.
    Part first() const;

private:
    std::map<std::uint64_t, Part> parts_;
};

} // namespace stylobate
