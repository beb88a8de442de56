/// The library's comparisons, risk estimates, pasts and pages are the program's.

#include "stylobate/stylobate.hpp"
#include "tests/library/inputs.hpp"
#include "tests/program/program.hpp"

#include "studies/decisions/compare/comparison.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {
namespace {

class LibraryAnswers : public Program {
protected:
    const std::string hazard = "k0=1e-3,k=3,measure=pga,sigma_ln=0.4";

    /// frag.toml, with two variants, compared by the program: frag.h5, frag_slender.h5, frag_comparison.h5.
    void compare_by_program()
    {
        fs::copy(STYLOBATE_SOURCE_DIR "/tests/library/small_fragility.toml", folder / "frag.toml");
        said = run(Words{"compare", "frag.toml", "--json"});
        ASSERT_EQ(said.status, 0) << testing::PrintToString(said);
    }
    /// What the program prints as JSON, without the names of its files.
    static std::string without_files(const Ended& ended, const std::string& end)
    {
        std::string text = ended.out;
        return text.substr(0, text.rfind(end)) + "}";
    }

    Ended said;
};

TEST_F(LibraryAnswers, AComparisonHasTheNumbersOfTheProgram)
{
    compare_by_program();
    fs::create_directory(folder / "own");
    std::size_t lines = 0;
    const auto found = api::compare(
        {folder / "frag.toml"}, {.folder = folder / "own", .threads = 2, .tell = [&](const std::string&) { ++lines; }});
    ASSERT_TRUE(found);
    EXPECT_GE(lines, 3U) << "one for each study";
    EXPECT_EQ(found->json(), without_files(said, ", \"comparison\""));
    EXPECT_EQ(read_bytes(folder / "own/frag_slender.h5"), bytes("frag_slender.h5"));

    const api::Table& rows = found->rows();
    const std::vector<std::string>& variants = rows.texts("variant");
    const std::vector<double> difference = rows.numbers("difference"), lower = rows.numbers("difference_lower"),
                              both = rows.numbers("both");
    const JsonValue json = json_of(said);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < variants.size(); ++i)
        for (const JsonValue& variant : json["variants"].items)
            if (variant["name"].text == variants[i] && rows.texts("place")[i] == "all") {
                const JsonValue& overall = variant["limit_states"][rows.texts("limit_state")[i]]["overall"];
                EXPECT_EQ(difference[i], overall["difference"].number);
                EXPECT_EQ(lower[i], overall["lower"].number);
                EXPECT_EQ(both[i], overall["both"].number);
                ++compared;
            }
    EXPECT_EQ(compared, 2 * json["variants"].items.front()["limit_states"].members.size());
    EXPECT_THROW(rows.column("differences"), std::out_of_range);
    EXPECT_THROW(rows.numbers("variant"), std::out_of_range);
    EXPECT_THROW(rows.texts("both"), std::out_of_range);

    found->write(folder / "own.h5");
    EXPECT_EQ(bytes("own.h5"), bytes("frag_comparison.h5"));
    EXPECT_EQ(api::Comparison::from_file(folder / "own.h5").text(), found->text());
    EXPECT_EQ(api::Comparison::from_file(folder / "own.h5").tables().size(),
              tables_of(read_comparison(folder / "own.h5")).size());
    found->draw(folder / "own.svg", "collapse");
    ASSERT_EQ(run(Words{"export", "frag_comparison.h5", "--limit", "collapse", "-o", "program.svg"}).status, 0);
    EXPECT_EQ(bytes("own.svg"), bytes("program.svg"));
}

TEST_F(LibraryAnswers, ARiskHasTheNumbersOfTheProgram)
{
    compare_by_program();
    const Ended one = run(Words{"risk", "frag.h5", "--hazard", hazard, "--json"});
    ASSERT_EQ(one.status, 0) << testing::PrintToString(one);
    const auto risk = api::risk(folder / "frag.h5", {hazard});
    ASSERT_TRUE(risk);
    EXPECT_EQ(risk->json(), without_files(one, ", \"written\""));
    risk->write(folder / "own.h5");
    EXPECT_EQ(bytes("own.h5"), bytes("frag_risk.h5"));
    EXPECT_EQ(api::Risk::from_file(folder / "own.h5").text(), risk->text());
    const std::vector<double> frequency = risk->rows().numbers("annual_frequency"),
                              over = risk->rows().numbers("probability_50_years"),
                              upper = risk->rows().numbers("probability_100_years_upper"),
                              most = risk->rows().numbers("annual_frequency_upper");
    ASSERT_FALSE(frequency.empty());
    for (std::size_t i = 0; i < frequency.size(); ++i) {
        EXPECT_NEAR(over[i], 1 - std::exp(-50 * frequency[i]), 1e-15); // Poisson's process
        EXPECT_NEAR(upper[i], 1 - std::exp(-100 * most[i]), 1e-15);
    }

    const Ended change = run(Words{"risk", "frag_comparison.h5", "--hazard", hazard, "--json"});
    ASSERT_EQ(change.status, 0) << testing::PrintToString(change);
    const auto changed = api::risk(folder / "frag_comparison.h5", {hazard});
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->json(), without_files(change, ", \"written\""));
    const api::Table& rows = changed->rows();
    const auto base = rows.numbers("base_annual_frequency"), variant = rows.numbers("variant_annual_frequency"),
               difference = rows.numbers("annual_frequency_change");
    for (std::size_t i = 0; i < base.size(); ++i) {
        EXPECT_NEAR(difference[i], variant[i] - base[i], 1e-12) << rows.texts("limit_state")[i];
        if (rows.texts("variant")[i] == "neutral") {
            EXPECT_EQ(difference[i], 0);
        }
    }
    EXPECT_THROW(api::risk(folder / "frag.h5", {hazard}, {.years = {-1}}), api::InputError);
}

/// Names of files are those of the program only in its folder.
class InFolder {
public:
    explicit InFolder(const fs::path& folder) { fs::current_path(folder); }
    ~InFolder() { fs::current_path(before_); }
    InFolder(const InFolder&) = delete;
    InFolder& operator=(const InFolder&) = delete;

private:
    const fs::path before_ = fs::current_path();
};

class LibraryPast : public ColumnProgram {};

TEST_F(LibraryPast, HasTheNumbersOfTheProgram)
{
    const std::vector<std::string> survival =
        with(short_surface(12), {"study.kind=survival", "survival.events=2", "survival.pause_s=0.5",
                                 "survival.monuments=20", "survival.observed={tolerance_m=0.001}"});
    ASSERT_EQ(run(words(survival, "a.h5", "2")).status, 0);
    ASSERT_EQ(run(words(with(survival, {"structure.drum_width_m=0.06", "survival.structure=2"}), "b.h5", "2")).status,
              0);
    const Ended said = run(Words{"past", "a.h5", "b.h5", "--json"});
    ASSERT_EQ(said.status, 0) << testing::PrintToString(said);
    const InFolder here(folder);
    const api::Past past = api::past({"a.h5", "b.h5"});
    EXPECT_EQ(past.json() + "\n", said.out);
    EXPECT_EQ(past.rows().texts("structure"), (std::vector<std::string>{"a.h5", "b.h5", "together", "together"}));
    EXPECT_EQ(past.rows().numbers("events"), (std::vector<double>{1, 1, 1, 2}));
    const JsonValue all = json_of(said);
    const JsonValue& alone = all["structures"].items.front()["exclusion"]["weaker_m_s2"];
    EXPECT_EQ(past.rows().numbers("weaker_m_s2").front(), alone["value"].number);
    const api::Table& likelihood = past.table("likelihood");
    EXPECT_EQ(likelihood.numbers("pga_m_s2").size(), 4 * 4U) << "four intensities of each";
    for (const double value : likelihood.numbers("likelihood"))
        EXPECT_TRUE(value >= 0 && value <= 1) << value;
    past.draw("own.svg");
    ASSERT_EQ(run(Words{"past", "a.h5", "b.h5", "-o", "program.svg"}).status, 0);
    EXPECT_EQ(bytes("own.svg"), bytes("program.svg"));
    EXPECT_THROW(past.write("past.h5"), api::InputError);
}

TEST_F(LibraryAnswers, APageIsThatOfTheProgram)
{
    compare_by_program();
    ASSERT_EQ(run(Words{"report", "frag_comparison.h5", "-o", "program.html"}).status, 0);
    const InFolder here(folder);
    const auto page = api::report("frag_comparison.h5");
    ASSERT_TRUE(page);
    page->write("own.html");
    EXPECT_EQ(bytes("own.html"), bytes("program.html"));
    EXPECT_EQ(page->html, bytes("own.html"));
    EXPECT_THROW(api::report("frag_comparison.h5", {.animate = 1}), api::InputError);
    EXPECT_THROW(api::report("frag.toml"), api::InputError);
}

TEST_F(LibraryAnswers, StopsAndRefusesAsTheProgram)
{
    compare_by_program();
    fs::create_directory(folder / "own");
    EXPECT_FALSE(api::compare({folder / "frag.toml"}, {.folder = folder / "own", .go_on = [] { return false; }}));
    EXPECT_THROW(api::compare({}), api::InputError);
    EXPECT_THROW(api::compare({folder / "frag.toml"}, {.level = 1}), api::InputError);
    const Ended refused = run(Words{"past", "frag.h5", "frag_slender.h5"});
    try {
        api::past({"frag.h5", "frag_slender.h5"});
        FAIL() << "these are no survival studies";
    } catch (const api::InputError&) {
        EXPECT_EQ(refused.status, 2);
    }
}

} // namespace
} // namespace stylobate
