/// The library's diagnosis of a campaign is the program's.

#include "stylobate/diagnosis.hpp"
#include "stylobate/error.hpp"
#include "tests/program/program.hpp"

namespace stylobate {
namespace {

using LibraryDiagnosis = Program;

TEST_F(LibraryDiagnosis, HasTheVerdictTheSizesAndTheFileOfTheProgramLong)
{
    const std::string campaign = STYLOBATE_HIDDEN_CAMPAIGNS "/campaign_4.h5"; // a pitching table
    const JsonValue said =
        json_of(run({"diagnose", campaign, "-o", "program.h5", "--nulls", "6", "--threads", "1", "--json", "--quiet"}));

    std::size_t lines = 0;
    const std::optional<api::Diagnosis> found = api::diagnose(
        campaign,
        {.nulls = 6, .threads = 1, .cache = folder / "chance.txt", .tell = [&](const std::string&) { ++lines; }});
    ASSERT_TRUE(found);
    EXPECT_GT(lines, 0U);
    EXPECT_EQ(found->verdict(), api::Verdict::named);
    EXPECT_EQ(found->verdict_text(), said["text"].text);
    ASSERT_EQ(found->causes().size(), 1U);
    const api::Cause cause = found->causes().front();
    const JsonValue& want = said["causes"].items.front();
    EXPECT_EQ(cause.mechanism, want["name"].text);
    EXPECT_EQ(cause.place, want["place"].text);
    EXPECT_EQ(cause.size.value(), want["size"].number);
    EXPECT_EQ(cause.probability.value(), want["probability"].number);
    EXPECT_EQ(cause.lower.value(), want["low"].number);
    EXPECT_EQ(cause.upper.value(), want["high"].number);
    ASSERT_TRUE(found->gain());
    EXPECT_EQ(found->gain()->error_after.value(), said["gain"]["error_after"].number);
    EXPECT_EQ(found->extended_study(), read_bytes(folder / "program_extended.toml"));
    EXPECT_NE(found->text().find("table_pitch"), std::string::npos);

    found->write(folder / "library.h5");
    const Ended page = run({"report", "library.h5", "--quiet"});
    EXPECT_EQ(page.status, 0) << testing::PrintToString(page);

    // stopped, it says nothing; chance is kept
    const std::optional<api::Diagnosis> stopped =
        api::diagnose(campaign, {.nulls = 6, .seed = 2, .threads = 1, .go_on = [] { return false; }});
    EXPECT_FALSE(stopped);
}

} // namespace
} // namespace stylobate
