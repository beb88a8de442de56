#pragma once
/// Pairs of trials: the same realization of two studies, and whether each reached a limit state.

#include <cstdint>

namespace stylobate {

struct PairedCounts {
    std::uint64_t both = 0;         ///< reached in both
    std::uint64_t base_only = 0;    ///< discordant: reached in the base alone
    std::uint64_t variant_only = 0; ///< discordant: reached in the variant alone
    std::uint64_t neither = 0;

    void add(bool base, bool variant) { ++(base ? (variant ? both : base_only) : (variant ? variant_only : neither)); }
    PairedCounts& operator+=(const PairedCounts& more)
    {
        both += more.both;
        base_only += more.base_only;
        variant_only += more.variant_only;
        neither += more.neither;
        return *this;
    }
    std::uint64_t pairs() const { return both + base_only + variant_only + neither; }
    std::uint64_t base() const { return both + base_only; }
    std::uint64_t variant() const { return both + variant_only; }
    std::uint64_t discordant() const { return base_only + variant_only; }
    bool operator==(const PairedCounts&) const = default;
};

} // namespace stylobate
