#pragma once
/// The ends of an interval, and whether there is an estimate inside it.

#include <cstdint>
#include <limits>

namespace stylobate {

struct Limits {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// How a likelihood is shaped.
enum class Maximum : std::uint8_t {
    inside,    ///< it has its maximum at finite coefficients
    separated, ///< it grows for ever: a plane parts what reached the limit state from what did not
    none,      ///< nothing reached it
    all        ///< everything did
};

} // namespace stylobate
