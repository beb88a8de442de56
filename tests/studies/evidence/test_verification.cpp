/// The verification cases of `studies/evidence/verification`, one test for each: quick ones and long ones under names
/// of their own, so that CTest can label them.

#include "studies/evidence/verification/case.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

Cases cases_of(Duration duration)
{
    Cases some;
    for (Case& one : all_cases())
        if (one.duration == duration)
            some.push_back(std::move(one));
    return some;
}

class Verification : public testing::TestWithParam<Case> {};

TEST_P(Verification, AgreesWithItsOracle)
{
    const Finding finding = GetParam().run();
    ASSERT_FALSE(finding.checks.empty());
    for (const Check& check : finding.checks)
        EXPECT_TRUE(check.passed()) << fmt::format("{}: expected {:.10g}, measured {:.10g}, allowed {:.2g}", check.what,
                                                   check.expected, check.measured, check.tolerance);
}

const auto name = [](const auto& which) { return which.param.name; };

} // namespace

void PrintTo(const Case& c, std::ostream* out)
{
    *out << c.name;
}

INSTANTIATE_TEST_SUITE_P(Quick, Verification, testing::ValuesIn(cases_of(Duration::quick)), name);
INSTANTIATE_TEST_SUITE_P(Long, Verification, testing::ValuesIn(cases_of(Duration::slow)), name);

} // namespace stylobate::verification
