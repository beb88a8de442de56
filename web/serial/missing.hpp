#pragma once
// Of the standard library of C++20 what that of Debian's Emscripten (3.1.6) lacks. Included before everything else.

#include <bit>
#include <version>

#if !defined(__cpp_lib_bit_cast)
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept
{
    return __builtin_bit_cast(To, from);
}
} // namespace std
#endif
