#pragma once
/// Result of a pair of replicas that was followed step by step (ensemble/replicas/replicas.hpp): plain data.

#include "ensemble/model/fields.hpp"

#include <cstdint>

namespace stylobate {

struct ReplicaSeparation {
    std::uint64_t original = 0; ///< its index
    std::uint64_t kind = 0;     ///< in `ReplicasSpec::kinds`
    double start = 0;           ///< separation at rest
    double exponent_per_s = 0;  ///< NaN: too few checks
    double horizon_s = 0;       ///< when the separation had reached the tolerance; NaN: not while it was followed
    double followed_s = 0;      ///< until when it was
    double original_end_s = 0;  ///< when the original ended
};

template <class F>
void visit_fields(std::type_identity<ReplicaSeparation>, F&& f)
{
    f("original", &ReplicaSeparation::original);
    f("kind", &ReplicaSeparation::kind);
    f("start", &ReplicaSeparation::start);
    f("exponent_per_s", &ReplicaSeparation::exponent_per_s);
    f("horizon_s", &ReplicaSeparation::horizon_s);
    f("followed_s", &ReplicaSeparation::followed_s);
    f("original_end_s", &ReplicaSeparation::original_end_s);
}

} // namespace stylobate
