/// `stylobate check`, as its user runs it.

#include "tests/program/program.hpp"

namespace stylobate {
namespace {

class Check : public Program {
protected:
    Ended check(const Words& settings) const
    {
        const std::string study = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/rigid_column.toml";
        Words words{"check", study, "--quiet", "--json", "--pilot", "16"};
        for (const std::string& setting : settings)
            words.insert(words.end(), {"--set", setting});
        return run(words);
    }
};

TEST_F(Check, ReportsWhatAnAccuracyHasChosen)
{
    // the file gives its form; two corners need a stiffness, and it does not
    const Ended rigid = check({"run.accuracy=0.2"}),
                corners = check({"contact.form=\"two_corner\"", "run.accuracy=0.2"});
    EXPECT_EQ(rigid.status, 0) << testing::PrintToString(rigid);
    EXPECT_EQ(json_of(rigid)["form"].text, "rigid");
    EXPECT_EQ(rigid.out.find("\"key\": \"contact."), std::string::npos) << rigid.out;
    EXPECT_NE(rigid.out.find("\"key\": \"run.precision\""), std::string::npos) << rigid.out;
    EXPECT_EQ(json_of(corners)["form"].text, "two_corner");
    EXPECT_NE(corners.out.find("\"key\": \"contact.normal_stiffness_n_m2\""), std::string::npos) << corners.out;
}

TEST_F(Check, RefusesAnAccuracyThatNoChoiceReaches)
{
    const Ended ended = check({"contact.form=\"two_corner\"", "run.accuracy=0.01"});
    EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
    EXPECT_NE(ended.err.find("is not reached by any stiffness"), std::string::npos) << ended.err;
}

} // namespace
} // namespace stylobate
