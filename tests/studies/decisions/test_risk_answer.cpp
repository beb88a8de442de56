/// What a risk estimate comes to in sentences.

#include "studies/decisions/risk/risk_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

namespace stylobate {
namespace {

RiskNumber number(double value, double lower, double upper, double fragility_part)
{
    RiskNumber n;
    n.value = value;
    n.total = n.fragility = n.hazard = {lower, upper};
    n.fragility_part = fragility_part;
    return n;
}

/// A fall once in a thousand years, from intensities 1 to 4.
Risk risk(double fragility_part)
{
    Risk r;
    r.level = 0.9;
    r.years = {50, 100};
    r.hazard.measure = "pgv_m_s";
    r.hazard.fractiles = {{0.05, {}}, {0.95, {}}};
    StateRisk s;
    s.state = "collapse";
    s.meaning = "a block falls";
    s.estimate.frequency = number(1e-3, 5e-4, 2e-3, fragility_part);
    for (const auto& [from, to, share] :
         {std::tuple{0.0, 1.0, 0.05}, std::tuple{1.0, 2.0, 0.6}, std::tuple{2.0, 4.0, 0.3},
          std::tuple{4.0, std::numeric_limits<double>::infinity(), 0.05}})
        s.estimate.parts.push_back({from, to, number(1e-3 * share, 0, 1, 0.5)});
    r.states.push_back(s);
    return r;
}

TEST(RiskAnswer, IsOneSentenceWithItsInterval)
{
    // 1 - exp(-0.1), of 0.05 and of 0.2
    EXPECT_EQ(risk_answer(risk(0.2)),
              "In 100 years the limit state 'a block falls' is reached with a probability of 9.52 "
              "% (4.88 to 18.1; 90 % interval), on average once in 1000 years.");
    Risk with_mean = risk(0.2); // 1 - exp(-0.12)
    with_mean.states.front().estimate.by_mean_hazard = 1.2e-3;
    EXPECT_TRUE(risk_answer(with_mean).ends_with(
        "in 1000 years. By the mean hazard, the mean over its fractiles, the probability is 11.3 %."))
        << risk_answer(with_mean);
    Risk open = risk(0.2);
    open.states.front().determined = false;
    open.states.front().estimate.bounds = {1e-4, 0.02};
    open.states.front().note = "Too much comes from above.";
    EXPECT_EQ(risk_answer(open), "How often the limit state 'a block falls' is reached is not determined: 0.0001 to "
                                 "0.02 times a year. Too much comes from above.");
    EXPECT_EQ(risk_grounds(open), "");
    const std::string text = risk_text(open);
    EXPECT_NE(text.find("  - collapse: 0.0001 to 0.02 a year by any curve that rises. Too much comes from above.\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("Contributing intensities"), std::string::npos) << text;
    open.states.front().estimate.bounds.upper = std::numeric_limits<double>::infinity();
    EXPECT_NE(risk_answer(open).find("is not determined: at least 0.0001 times a year."), std::string::npos)
        << risk_answer(open);
}

TEST(RiskAnswer, OfNoFallIsItsUpperLimit)
{
    Risk none = risk(0.2);
    none.states.front().estimate.frequency = number(0, 0, 1e-3, std::nan(""));
    EXPECT_EQ(risk_answer(none), "No run of the study reached the limit state 'a block falls'. By shaking as strong as "
                                 "the strongest of the runs, or stronger, its probability in 100 years is at most 9.52 "
                                 "% (90 % interval from 0).");
    EXPECT_EQ(risk_grounds(none), "");
}

TEST(RiskAnswer, SaysWhereItComesFromAndWhatWouldNarrowIt)
{
    const std::string by_hazard = risk_grounds(risk(0.2)), by_fragility = risk_grounds(risk(0.8)),
                      by_both = risk_grounds(risk(0.4));
    EXPECT_NE(by_hazard.find("At least 80 % of the risk comes from PGV between 1 and 4 m/s. "), std::string::npos)
        << by_hazard;
    EXPECT_NE(by_hazard.find("Of the uncertainty (the interval's squared width) 80 % is due to the hazard and 20 % due "
                             "to the fragility. A "
                             "better hazard"),
              std::string::npos)
        << by_hazard;
    EXPECT_NE(by_hazard.find("more motions hardly would"), std::string::npos) << by_hazard;
    EXPECT_NE(by_fragility.find("More motions in the study would narrow it; a better hazard curve hardly"),
              std::string::npos);
    EXPECT_NE(by_both.find("would both narrow it"), std::string::npos) << by_both;
    EXPECT_NE(risk_grounds(risk(std::nan(""))).find("no finite width"), std::string::npos);
    Risk certain = risk(1);
    certain.hazard.fractiles.clear();
    EXPECT_NE(risk_grounds(certain).find("of the fragility alone"), std::string::npos);
}

TEST(RiskAnswer, NamesTheMiddleOfTheIntensities)
{
    const auto where = [](const std::vector<double>& shares) {
        Risk r = risk(0.2);
        for (std::size_t i = 0; i < shares.size(); ++i)
            r.states.front().estimate.parts[i].frequency.value = 1e-3 * shares[i];
        const std::string text = risk_grounds(r);
        const std::size_t from = text.find("comes from ") + 11;
        return text.substr(from, text.find(". ", from) - from);
    };
    EXPECT_EQ(where({0.05, 0.6, 0.3, 0.05}), "PGV between 1 and 4 m/s");
    EXPECT_EQ(where({0.2, 0.5, 0.3, 0}), "PGV below 4 m/s");
    EXPECT_EQ(where({0.05, 0.05, 0.7, 0.2}), "PGV above 2 m/s");
    EXPECT_EQ(where({0.2, 0.3, 0.3, 0.2}), "PGV at all intensities");
}

} // namespace
} // namespace stylobate
