/// What is said of the agreement with rigid blocks, of tables made by hand, and that docs/rigid_limit.md has the text
/// of its own table.

#include "bench/rigid_agreement.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace stylobate {
namespace {

std::string table(const std::string& plastic, const std::string& rebound, const std::string& restitution)
{
    return "Text before.\n\n| contacts | step [s], K_N [N/m2] | monolith | six drums |\n|---|---|---|---|\n"
           "| two_corner, damping ratio 0.1 | 1e8 | " +
           rebound + " | 0.700 ± 0.030 |\n| 1 | 1e8 | " + plastic +
           " | 0.500 ± 0.030 |\n| 4 | 1e9 | | 0.470 ± 0.040 |\n| **rigid, e = 0** | 1/960 | **0.800 ± 0.000** | "
           "**0.400 ± 0.040** |\n| rigid, e = 0.3 | 1/960 | " +
           restitution + " | 0.400 ± 0.030 |\n\nText after.\n";
}

void expect_part(const std::string& text, const std::string& part)
{
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

/// By hand: 0.84 - 0.80 is 2 of 0.020, 0.85 is 2.5; of the drums 0.5 - 0.4 is 2 of hypot(0.03, 0.04) = 0.05, 0.7 is 6,
/// 0.47 is 0.07 of 0.0566.
TEST(RigidAgreement, CountsWhatAgrees)
{
    const std::string text = agreement_text(table("0.840 ± 0.020", "0.850 ± 0.020", "0.790 ± 0.010"));
    expect_part(text,
                "| two corners, damping ratio below 1 | 0 of 1 probabilities agree; the differences are +0.050 ± "
                "0.020 (ratio 0.1, monolith) to +0.050 ± 0.020 (ratio 0.1, monolith) | 0 of 1 probabilities agree");
    expect_part(text, "| two corners, damping ratio of 1 and more | 1 of 1 probabilities agree; the differences are "
                      "+0.040 ± 0.020 (ratio 1, monolith)");
    expect_part(text,
                "| 2 of 2 probabilities agree; the differences are +0.070 ± 0.057 (ratio 4, six drums) to +0.100 ± "
                "0.050 (ratio 1, six drums) |");
    expect_part(text, "**One block.** Rigid blocks with e = 0 are the limit of contacts with a damping ratio of 1 and "
                      "more, and not of contacts that rebound. A restitution up to that of the table does not change "
                      "their probabilities.");
}

/// The sentences follow the numbers.
TEST(RigidAgreement, SentencesFollowTheNumbers)
{
    expect_part(agreement_text(table("0.840 ± 0.020", "0.810 ± 0.020", "0.770 ± 0.010")),
                "**One block.** Rigid blocks with e = 0 are the limit of stiff contacts at every damping ratio of the "
                "table. A restitution above 0 changes their probabilities.");
    expect_part(
        agreement_text(table("0.850 ± 0.020", "0.850 ± 0.020", "0.790 ± 0.010")),
        "**One block.** Rigid blocks with e = 0 are not the limit of all contacts with a damping ratio of 1 and "
        "more, and not of contacts that rebound.");
}

TEST(RigidAgreement, WantsATableWithTheLimit)
{
    EXPECT_THROW(agreement_text("no table"), std::runtime_error);
    std::string text = table("0.840 ± 0.020", "0.850 ± 0.020", "0.790 ± 0.010");
    text.erase(text.find("| **rigid, e = 0**"), text.find("| rigid, e = 0.3") - text.find("| **rigid, e = 0**"));
    EXPECT_THROW(agreement_text(text), std::runtime_error);
}

/// The page states what its table shows: scripts/tables.sh rigid_limit writes it.
TEST(RigidAgreement, ThePageHasTheTextOfItsTable)
{
    std::ifstream file(std::string(STYLOBATE_SOURCE_DIR) + "/docs/rigid_limit.md");
    std::stringstream page;
    page << file.rdbuf();
    const std::string text = agreement_text(page.str());
    EXPECT_NE(page.str().find(text), std::string::npos) << text;
    for (const char* claim : {"*the* limit", "all restitutions agree"}) // which the table contradicts
        EXPECT_EQ(page.str().find(claim), std::string::npos) << claim;
}

} // namespace
} // namespace stylobate
