#pragma once
/// Result of a pair of twins that was followed step by step (ensemble/replicas/twins.hpp): plain data.

#include "ensemble/model/fields.hpp"

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

template <class F>
void visit_fields(std::type_identity<FollowedTwin>, F&& f)
{
    f("original", &FollowedTwin::original);
    f("kind", &FollowedTwin::kind);
    f("start", &FollowedTwin::start);
    f("exponent_per_s", &FollowedTwin::exponent_per_s);
    f("horizon_s", &FollowedTwin::horizon_s);
    f("followed_s", &FollowedTwin::followed_s);
    f("original_end_s", &FollowedTwin::original_end_s);
}

} // namespace stylobate
