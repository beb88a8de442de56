/// Every kind of study prints what its model leaves out, in its summaries and on its page.

#include "tests/program/program.hpp"

#include "studies/report/left_out.hpp"

namespace stylobate {
namespace {

struct SmallStudy {
    const char* name; ///< of the test
    const char* kind;
    int dimensions;
    std::vector<std::string> settings; ///< as few realizations as the kind allows
};

void PrintTo(const SmallStudy& study, std::ostream* to)
{
    *to << study.name;
}

const std::vector<std::string> one_cell = {"study.realizations=1", "surface.frequency_hz.count=1",
                                           "surface.frequency_hz.from=2", "surface.pga_m_s2.count=1",
                                           "surface.pga_m_s2.from=8"};
const std::vector<std::string> eight_motions = {"study.realizations=1", "fragility.motions=8",
                                                "fragility.intensity.count=2"};

class LeftOutProgram : public Program, public testing::WithParamInterface<SmallStudy> {};

TEST_P(LeftOutProgram, StandsInEverySummaryAndOnThePage)
{
    const SmallStudy& small = GetParam();
    const std::string sentence = left_out_text(small.dimensions);
    const Ended made =
        run({"new", small.kind, "--dimensions", std::to_string(small.dimensions), "-o", "study.toml", "--quiet"});
    ASSERT_EQ(made.status, 0) << testing::PrintToString(made);
    Words of_study = run_words("study.toml", small.settings);
    const auto told = [&](Words words, const Words& more = {}) {
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        return ended;
    };
    const auto expect_told = [&](const Words& words, const Words& more = {}) {
        const Ended text = told(words, more);
        EXPECT_NE(text.out.find(sentence + "\n"), std::string::npos) << testing::PrintToString(text);
        Words json = more;
        json.emplace_back("--json");
        EXPECT_EQ(json_of(told(words, json))["left_out"].text, sentence) << words.front();
    };
    expect_told(of_study, {"-o", "results.h5"});
    of_study.front() = "info";
    expect_told(of_study);
    of_study.front() = "check";
    expect_told(of_study, {"--trial-seconds", "0", "--law-seconds", "0"});
    expect_told({"info", "results.h5"});
    told({"report", "results.h5", "-o", "page.html", "--animate", "0"});
    EXPECT_EQ(count_of(read_page(folder / "page.html"), sentence), 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LeftOutProgram,
    testing::Values(SmallStudy{"single", "single", 2, {}}, SmallStudy{"surface", "surface", 2, one_cell},
                    SmallStudy{"fragility", "fragility", 2, eight_motions},
                    SmallStudy{"sensitivity", "sensitivity", 2, {"sensitivity.samples=2"}},
                    SmallStudy{"rare", "rare", 2, {"rare.samples=200", "rare.repeats=5", "excitation.pga_m_s2=8"}},
                    SmallStudy{"survival",
                               "survival",
                               2,
                               {"study.realizations=1", "surface.frequency_hz.count=1", "surface.frequency_hz.from=2",
                                "surface.pga_m_s2.count=3", "surface.pga_m_s2.from=6"}},
                    SmallStudy{"single_in_space", "single", 3, {}},
                    SmallStudy{"surface_in_space", "surface", 3, one_cell},
                    SmallStudy{"fragility_in_space", "fragility", 3, eight_motions}),
    [](const testing::TestParamInfo<SmallStudy>& info) { return std::string(info.param.name); });

} // namespace
} // namespace stylobate
