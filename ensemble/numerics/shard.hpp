#pragma once
/// A part of a study for one machine of several.

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stylobate {

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

} // namespace stylobate
