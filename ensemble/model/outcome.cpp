#include "ensemble/model/outcome.hpp"

#include <array>
#include <cstddef>

namespace stylobate {

const char* to_string(State state)
{
    constexpr std::array names = {"stood", "rocked", "slid", "collapsed", "invalid"};
    const auto i = static_cast<std::size_t>(state);
    return i < names.size() ? names[i] : "unknown";
}

const char* to_string(InvalidReason reason)
{
    constexpr std::array names = {"none", "not_finite", "energy"};
    const auto i = static_cast<std::size_t>(reason);
    return i < names.size() ? names[i] : "unknown";
}

} // namespace stylobate
