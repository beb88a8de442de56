#pragma once
/// How a value of a file is compared with what it should be, and shown.

#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <type_traits>

namespace stylobate {

/// Of numbers: bit by bit, so that NaN is NaN, and 0 is not -0.
template <class Value>
bool same_value(const Value& a, const Value& b)
{
    if constexpr (std::is_same_v<Value, double>)
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    else
        return a == b;
}

template <class Value>
std::string shown(const Value& value)
{
    if constexpr (std::is_enum_v<Value>)
        return to_string(value);
    else
        return fmt::format("{}", value);
}

} // namespace stylobate
