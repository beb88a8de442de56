/// Tables of outcomes: what they mean, and what is refused.

#include "io/measured/measured_file.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

TEST(MeasuredOutcomes, AreRead)
{
    const MeasuredFolder folder("outcomes");
    write_content(folder / "a.csv", "# by hand\r\npga_g, pgv_over_pga_s, Toppled, toppled\r\n"
                                    "0.5,0.1,x,Y\n0.5,0.1,x,n\n1,0.1,x,\n0.25,,x,stood\n");
    const OutcomeTable table = read_outcomes(folder / "a.csv");
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_NEAR(*table.rows[0].pga_m_s2, 4.903325, 1e-12);
    EXPECT_EQ(table.rows[0].pgv_over_pga_s, 0.1);
    EXPECT_FALSE(table.rows[2].pgv_over_pga_s);
    EXPECT_TRUE(table.rows[0].fell);
    EXPECT_FALSE(table.rows[1].fell || table.rows[2].fell);
    EXPECT_EQ(table.rows[1].motion_id, table.rows[0].motion_id);
    EXPECT_EQ(table.rows[1].repeat, 1);
    EXPECT_NE(table.rows[2].motion_id, table.rows[0].motion_id);
    EXPECT_EQ(table.rows[2].line, 6);
    ASSERT_EQ(table.findings.size(), 2u); // the column that is not read, the row without an outcome
    EXPECT_NE(table.findings[0].text.find("Did you mean toppled?"), std::string::npos);
    EXPECT_EQ(table.findings[1].place, "line 5");

    write_content(folder / "b.csv", "motion_file,amplitude_mm,frequency_hz,pga_m_s2,pgv_m_s,motion_id,repeat,fell\n"
                                    "a.at2,,,4,0.5,7,3,1\n,10,2,1.579,,8,0,0\n,10,2,9,,8,1,0\n");
    const OutcomeTable other = read_outcomes(folder / "b.csv");
    EXPECT_EQ(other.rows[0].motion_file, "a.at2");
    EXPECT_EQ(other.rows[0].motion_id, 7);
    EXPECT_EQ(other.rows[0].repeat, 3);
    EXPECT_DOUBLE_EQ(*other.rows[0].pgv_over_pga_s, 0.125);
    EXPECT_DOUBLE_EQ(*other.rows[1].amplitude_m, 0.01);
    ASSERT_EQ(other.findings.size(), 1u); // 0.01 (4 pi)2 = 1.579
    EXPECT_NE(other.findings[0].text.find("make 1.58 m/s2"), std::string::npos);
}

TEST(MeasuredOutcomes, BadTablesAreRefused)
{
    const MeasuredFolder folder("bad_outcomes");
    const auto expect_refused = [&](const std::string& text, const std::string& part) {
        write_content(folder / "a.csv", text);
        const std::string message = refusal([&] { read_outcomes(folder / "a.csv"); });
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect_refused("", "no line of column names");
    expect_refused("pga_g\n1\n", "no column gives the outcome");
    expect_refused("fell\n1\n", "no column gives the motion");
    expect_refused("fell,collapsed,pga_g\n", "duplicates another one");
    expect_refused("fell,pga_g\nmaybe,1\n", "a.csv:2: fell = \"maybe\"");
    expect_refused("fell,pga_g\n1\n", "a.csv:2: has 1 fields");
    expect_refused("fell,pga_m_s2\n1,300\n", "outside (0, 100]");
    expect_refused("fell,pga_m_s2\n1,-3\n", "outside (0, 100]");
    expect_refused("fell,pga_m_s2\n1,x\n", "a.csv:2: pga_m_s2 = \"x\" is not a number");
    expect_refused("fell,pga_m_s2,pgv_m_s\n1,0.001,1\n", "a.csv:2: the peak velocity 1 m/s is 1000 s");
    expect_refused("fell,pga_m_s2,pgv_m_s\n1,100,1e-323\n", "outside (0, 20]");
    expect_refused("fell,pga_g,motion_id\n1,1,0.5\n", "is not a whole number");
}

TEST(MeasuredOutcomes, MutationsAreRefusedOrRead)
{
    const MeasuredFolder folder("outcome_mutations");
    std::string whole = "motion_file,amplitude_m,frequency_hz,pga_g,pgv_over_pga_s,repeat,fell\n";
    for (int i = 0; i < 20; ++i)
        whole +=
            "r" + std::to_string(i) + ".at2,0.01,2,0.16,0.08," + std::to_string(i) + (i % 2 == 0 ? ",yes\n" : ",no\n");
    std::mt19937 random(4);
    int refusals = 0;
    for (int trial = 0; trial < 500; ++trial) {
        std::string text = whole;
        for (auto changes = 1 + random() % 3; changes > 0; --changes)
            text[random() % text.size()] ^= static_cast<char>(1 << random() % 8);
        write_content(folder / "mutation.csv", text);
        const std::string message = refusal([&] { read_outcomes(folder / "mutation.csv"); });
        EXPECT_TRUE(message.empty() || message.find("mutation.csv") != std::string::npos) << message;
        refusals += !message.empty();
    }
    EXPECT_GT(refusals, 50);
    EXPECT_LT(refusals, 495);
}

} // namespace
} // namespace stylobate
