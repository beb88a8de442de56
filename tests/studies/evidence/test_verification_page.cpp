/// The tools of the verification, by themselves: a check that fails fails, a limit is found, the page says what failed,
/// and the oracles know cases that can be done by hand.

#include "ensemble/planar/structure/limit_analysis.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>

namespace stylobate::verification {

namespace {

TEST(Check, PassesWithinItsToleranceOnly)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE((Check{"", 1, 1.1, 0.11, Relation::equals}.passed()));
    EXPECT_FALSE((Check{"", 1, 1.1, 0.09, Relation::equals}.passed()));
    EXPECT_FALSE((Check{"", 1, nan, 1, Relation::equals}.passed()));
    EXPECT_TRUE((Check{"", 1, 2, 0, Relation::at_least}.passed()));
    EXPECT_FALSE((Check{"", 1, 0.9, 0, Relation::at_least}.passed()));
    EXPECT_FALSE((Check{"", 1, nan, 0, Relation::at_least}.passed()));
    EXPECT_FALSE((Check{"", 1, 1.1, 0, Relation::at_most}.passed()));
    EXPECT_FALSE((Check{"", 1, nan, 0, Relation::at_most}.passed()));
}

TEST(Finding, WithoutChecksHasNotPassed)
{
    EXPECT_FALSE(Finding{}.passed());
}

TEST(Convergence, FindsOrderAndLimit)
{
    std::vector<double> at, value;
    for (double K : {1e6, 1e8, 1e10}) {
        at.push_back(K);
        value.push_back(3 + 50 / std::sqrt(K));
    }
    EXPECT_NEAR(convergence("K", "v", at, value, 3).order, -0.5, 1e-9);
    EXPECT_NEAR(aitken(value), 3, 1e-12);
    EXPECT_NEAR(richardson({value[0], value[1]}, 100, {0.5}), 3, 1e-12);
    for (std::size_t i = 0; i < at.size(); ++i)
        value[i] -= 7 / std::cbrt(at[i]);
    EXPECT_NEAR(richardson(value, 100, {0.5, 1 / 3.0}), 3, 1e-12);
    EXPECT_GT(std::fabs(aitken(value) - 3), 1e-4) << "two powers are no geometric series";
}

TEST(Page, PutsFailuresFirstAndCountsThem)
{
    Case good{"Good", "B", "right", "o", "t", [] {
                  Finding f;
                  f.equals("one", 1, 1, 0.1);
                  return f;
              }};
    Case bad{"Bad", "C", "wrong", "o", "t", [] {
                 Finding f;
                 f.equals("two | three", 1, 2, 0.1);
                 return f;
             }};
    Case broken{"Broken", "C", "no", "o", "t", []() -> Finding { throw std::runtime_error("it broke"); }};
    const auto runs = run_cases({good, bad, broken});
    EXPECT_TRUE(runs[0].passed());
    EXPECT_FALSE(runs[1].passed());
    EXPECT_FALSE(runs[2].passed());
    const std::string text = page(runs, "images/", "Made here.");
    EXPECT_NE(text.find("1 of 2 comparisons in 3 cases"), std::string::npos) << text;
    EXPECT_LT(text.find("## Failed"), text.find("### Bad: failed"));
    EXPECT_LT(text.find("### Bad: failed"), text.find("### Good: passed"));
    EXPECT_NE(text.find("it broke"), std::string::npos);
    EXPECT_NE(text.find("two \\| three"), std::string::npos) << "a bar would end the cell";
}

TEST(Page, GivesTheLimitOfAGeometricSeries)
{
    const auto text = [](const std::vector<double>& at) {
        Case converging{"Converging", "B", "right", "o", "t", [=] {
                            Finding f;
                            std::vector<double> value;
                            for (double K : at)
                                value.push_back(3 + 50 / std::sqrt(K));
                            f.convergences.push_back(convergence("K", "v", at, value, 3.001));
                            return f;
                        }};
        return page(run_cases({converging}), "images/", "Made here.");
    };
    const std::string geometric = text({1e6, 1e8, 1e10});
    EXPECT_NE(geometric.find("| limit of the last three | exact |"), std::string::npos) << geometric;
    EXPECT_NE(geometric.find("| -0.001 | order"), std::string::npos) << geometric;
    EXPECT_EQ(text({1e6, 1e8, 1e9}).find("limit of"), std::string::npos) << "no one factor";
}

TEST(Cases, HaveNamesOfTheirOwnAndSayWhatTheyAre)
{
    std::set<std::string> names;
    for (const Case& c : all_cases()) {
        EXPECT_TRUE(names.insert(c.name).second) << c.name;
        EXPECT_FALSE(c.subject.empty() || c.compares.empty() || c.oracle.empty() || c.tolerance.empty()) << c.name;
    }
}

// ---------------------------------------------------------------- oracles

TEST(LinearProgramme, ByHand)
{
    // x + 2 y <= 4, 3 x + y <= 6: the maximum of x + y is 2.8 at (1.6, 1.2)
    const auto x = maximise({1, 2, 1, 0, 3, 1, 0, 1}, {4, 6}, {1, 1, 0, 0});
    EXPECT_NEAR(static_cast<double>(x[0]), 1.6, 1e-15);
    EXPECT_NEAR(static_cast<double>(x[1]), 1.2, 1e-15);
    EXPECT_THROW(maximise({1, 1}, {-1}, {1, 1}), std::runtime_error) << "nothing fulfils it";
    EXPECT_THROW(maximise({1, -1}, {1}, {1, 1}), std::runtime_error) << "it has no bound";
}

TEST(LimitAnalysis, OfOneBlock)
{
    const auto limit = [](double mu) {
        return limit_acceleration(model::single(model::mono_stone, {1, 0, mu}, 1, 0.1));
    };
    EXPECT_NEAR(limit(1).acceleration_m_s2, 9.81 * 48 / 174, 1e-12);
    EXPECT_NEAR(limit(0.2).acceleration_m_s2, 1.962, 1e-12);
    EXPECT_NEAR(limit(1).pressure_n[0], 0.813 * 9.81, 1e-12);
    EXPECT_NEAR(std::fabs(limit(1).at[0]), 1, 1e-12) << "on its edge";
}

TEST(Shenton, Corners)
{
    EXPECT_EQ(shenton(0.2, 0.3, 0.25), Regime::rest);
    EXPECT_EQ(shenton(0.5, 0.2, 0.25), Regime::slide);
    EXPECT_EQ(shenton(0.3, 0.9, 0.25), Regime::rock);
    EXPECT_EQ(shenton(5, 0.3, 0.25), Regime::slide_rock);
}

TEST(RigidBlock, SmallMotionsAboutItsBalanceAreExponential)
{
    // near alpha: theta'' = p2 (theta - alpha), so from alpha (1 - x) the time is acosh(1 / x) / p for a slender block
    const RigidBlock block{0.01L, 2};
    EXPECT_NEAR(static_cast<double>(quarter_period(block, 0.009L)), std::acosh(10.0) / 2, 1e-4);
    EXPECT_FALSE(respond(block, 0.99L, 3, 0.5L, 0).overturned);
    EXPECT_TRUE(respond(block, 50, 3, 0.5L, 0).overturned);
}

/// Section 8 of kernels/THEORY.md has the table of the case StiffnessEffect.
TEST(StiffnessEffect, TheTheoryHasItsTableLong)
{
    std::ifstream file(std::string(STYLOBATE_SOURCE_DIR) + "/kernels/THEORY.md");
    const std::string theory{std::istreambuf_iterator<char>(file), {}};
    const Cases all = all_cases();
    const std::vector<std::string> remarks =
        std::ranges::find(all, std::string("StiffnessEffect"), &Case::name)->run().remarks;
    ASSERT_FALSE(remarks.empty());
    EXPECT_NE(theory.find(remarks.front()), std::string::npos) << remarks.front();
}

} // namespace

} // namespace stylobate::verification
