/// Limits of claims' numbers by hand.

#include "studies/evidence/claims/sample.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace stylobate::claims {
namespace {

/// What 180 of 200 do is done by 20 less: the limits of the minority are those of the 20, in their order.
TEST(ClaimEstimate, AMinorityAboveOneHalfIsTheRest)
{
    std::vector<Observation> many(200), few(200);
    for (std::size_t i = 0; i < 200; ++i) {
        many[i].rocked = i < 180;
        few[i].rocked = i < 20;
    }
    Measure m;
    m.event = Event::rocked;
    const Estimate of_many = minority(many, m, 0.95), of_few = probability(few, m, 0.95);
    EXPECT_NEAR(of_many.value, 0.1, 1e-12);
    EXPECT_NEAR(of_many.lower, of_few.lower, 1e-12);
    EXPECT_NEAR(of_many.upper, of_few.upper, 1e-12);
}

} // namespace
} // namespace stylobate::claims
