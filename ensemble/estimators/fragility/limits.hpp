#pragma once
/// The limits of an interval, and the kinds of maximum of a likelihood.

#include <cstdint>
#include <limits>

namespace stylobate {

struct Limits {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// Where the maximum of a likelihood is.
enum class Maximum : std::uint8_t {
    inside,    ///< it has its maximum at finite coefficients
    separated, ///< unbounded: a plane separates the runs that reached the limit state from the others
    none,      ///< nothing reached it
    all        ///< everything did
};

} // namespace stylobate
