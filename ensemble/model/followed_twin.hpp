#pragma once
/// Result of a pair of twins that was followed step by step (ensemble/replicas/twins.hpp): plain data.

#include <cstdint>

namespace stylobate {

struct FollowedTwin {
    std::uint64_t original = 0; ///< its index
    std::uint64_t kind = 0;     ///< in `TwinsSpec::kinds`
    double start = 0;           ///< separation at rest
    double exponent_per_s = 0;  ///< NaN: too few checks
    double horizon_s = 0;       ///< when the separation had reached the tolerance; NaN: not while it was followed
    double followed_s = 0;      ///< until when it was
    double original_end_s = 0;  ///< when the original ended
};

} // namespace stylobate
