#pragma once
/// What "the same outcome" means in tests: every number of it, as bits.

#include "ensemble/model/outcome.hpp"

#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace stylobate {

/// Every number of an outcome, as bits.
inline std::vector<std::uint64_t> outcome_bits(const Outcome& o)
{
    std::vector<std::uint64_t> bits;
    visit_fields(std::type_identity<Outcome>(), [&](auto, auto field, auto) {
        if constexpr (std::is_same_v<decltype(field), double Outcome::*>)
            bits.push_back(std::bit_cast<std::uint64_t>(o.*field));
        else
            bits.push_back(static_cast<std::uint64_t>(o.*field));
    });
    for (const double time : o.fall_time_s)
        bits.push_back(std::bit_cast<std::uint64_t>(time));
    return bits;
}

} // namespace stylobate
