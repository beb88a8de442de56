#pragma once
/// The order in which realizations are run, and which places of that order are done.
///
/// Indices are systematic: cell by cell, frequency by frequency. In that order a part of a study is a corner of it.
/// Realizations are therefore run in B blocks of nearly the same size. Block b has the indices
///
///   c, c + B, c + 2 B, ... below n,   c = a b mod B,   B prime and no divisor of n,   a / B near 1 / golden ratio
///
/// one after the other. Every block is spread evenly over all indices, and so is a sequence of blocks: the first m
/// residues c leave gaps that differ by a small factor only (three-gap theorem, multiplicative method with the golden
/// ratio: Knuth, "The Art of Computer Programming", volume 3, section 6.4; the factor is small because the continued
/// fraction of a / B has small quotients, which is how a is chosen). B divides no period of the indices, because it
/// does not divide n. So the first blocks of a run are a fair sample of the whole. Within a block neighbours stay
/// neighbours: lanes that step similar realizations take the same branches, which is worth a twentieth of the speed.
/// Indices and outcomes do not depend on the order. The combination is an own derivation.

#include <charconv>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

// A part of a study for one machine of several.

/// Together the shards of a study are all its realizations, each once; `RunOrder::places` assigns them.
struct Shard {
    std::uint64_t number = 1; ///< from 1
    std::uint64_t of = 1;     ///< how many shards there are

    static constexpr std::uint64_t most = 1'000'000;

    /// "3/8"; nothing if it is no such text, or if the number is not within 1 and the number of shards.
    static std::optional<Shard> from_text(std::string_view text)
    {
        Shard shard;
        const char* const end = text.data() + text.size();
        const auto number = std::from_chars(text.data(), end, shard.number);
        if (number.ec != std::errc{} || number.ptr == end || *number.ptr != '/')
            return std::nullopt;
        const auto of = std::from_chars(number.ptr + 1, end, shard.of);
        if (of.ec != std::errc{} || of.ptr != end || shard.of > most || shard.number < 1 || shard.number > shard.of)
            return std::nullopt;
        return shard;
    }
    std::string text() const { return std::to_string(number) + "/" + std::to_string(of); }

    /// Whether it is all of the study.
    bool whole() const { return of == 1; }
    bool operator==(const Shard&) const = default;
};

class RunOrder {
public:
    /// @param total n; 0: an order of nothing
    explicit RunOrder(std::uint64_t total);
    std::uint64_t index(std::uint64_t place) const;
    std::uint64_t place(std::uint64_t index) const;
    /// First place of the block that a place is in, and the one behind it. @pre place < n
    std::uint64_t block_begin(std::uint64_t place) const;
    std::uint64_t block_end(std::uint64_t place) const;
    /// Number of the first places that form a fair sample: the whole blocks among them.
    std::uint64_t fair(std::uint64_t places) const;

    struct Places {
        std::uint64_t begin = 0, end = 0;
        std::uint64_t size() const { return end - begin; }
        bool has(std::uint64_t place) const { return begin <= place && place < end; }
    };
    /// The places of a shard: a sequence of blocks where there are many of them for each shard, so that it is a fair
    /// sample and takes as long as the others; else a sequence of places.
    Places places(const Shard& shard) const;

private:
    std::size_t block_of(std::uint64_t place) const;
    std::uint64_t total_;
    std::uint64_t blocks_ = 0;                                  ///< B
    std::uint64_t step_ = 1, back_ = 1;                         ///< a, and its inverse mod B
    std::shared_ptr<const std::vector<std::uint64_t>> begin_{}; ///< (B + 1) first place of each block, and n
};

/// Places that are done, with the number of collapsed and invalid realizations, as intervals. There are few intervals:
/// whole blocks without a gap between them are one interval, and completed parts of others are intervals of their own.
class DoneSet {
public:
    struct Part {
        std::uint64_t end = 0; ///< first place behind it
        std::uint64_t collapsed = 0, invalid = 0;
        std::uint64_t done(std::uint64_t begin) const { return end - begin; }
        bool operator==(const Part&) const = default;
    };

    /// @param order of the places; one of nothing holds no place
    explicit DoneSet(RunOrder order = RunOrder(0)) : order_(std::move(order)) {}

    bool has(std::uint64_t place) const;
    /// @pre !has(place)
    void add(std::uint64_t place, bool collapsed, bool invalid);
    /// All places of another set of the same order. @pre they have none in common
    void add(const DoneSet& other);
    /// A place that both have.
    std::optional<std::uint64_t> common(const DoneSet& other) const;
    /// By their beginning, in order.
    const std::map<std::uint64_t, Part>& parts() const { return parts_; }
    /// Adds an interval behind all others.
    /// @returns false if it is not, if it belongs to the one before, or if its counts do not fit
    bool append(std::uint64_t begin, const Part& part);

    /// Sum of all parts; `end` is the number of places.
    Part all() const;
    /// The completed blocks from the one on that begins at a place: a fair sample, not biased towards short
    /// realizations. Nothing if no block begins there, or if it is not complete. `end` is the place behind them.
    Part sample(std::uint64_t from = 0) const;

private:
    using At = std::map<std::uint64_t, Part>::iterator;
    /// Joins a part with the next one if they belong together. @returns whether they did
    bool join(At part);
    /// Adds a part that no other one has places of.
    void insert(std::uint64_t begin, const Part& part);

    RunOrder order_;
    std::map<std::uint64_t, Part> parts_;
};

} // namespace stylobate
