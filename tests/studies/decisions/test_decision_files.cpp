/// The files of comparisons and risk estimates: what is written is read, whole or not at all, and damaged files
/// are refused.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/risk/risk_text.hpp"
#include "studies/workflow/file_kind.hpp"
#include "tests/studies/decisions/decision_samples.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

std::string bytes_in(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void put_bytes(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

std::string refusal_of(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Every line of a text but its title is in the page too.
void expect_in_page(const std::string& text, const Document& page)
{
    const std::string shown = console_text(page);
    for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1) {
        const std::string line = text.substr(at, text.find('\n', at) + 1 - at);
        EXPECT_NE(shown.find(line), std::string::npos) << line << "is not in\n" << shown;
    }
}

class DecisionFiles : public testing::Test {
protected:
    TemporaryFolder folder;
    fs::path file = folder / "file.h5";

    /// Every byte of some hundred, and every length of some.
    template <class Read>
    void expect_damage_is_found(const Read& read)
    {
        const std::string good = bytes_in(file);
        ASSERT_GT(good.size(), 5000U);
        ASSERT_NO_THROW(read(file));
        const fs::path bad_file = folder / "bad.h5";
        for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 300) {
            std::string bad = good;
            bad[at] = static_cast<char>(bad[at] ^ 0x10);
            put_bytes(bad_file, bad);
            const std::string message = refusal_of([&] { read(bad_file); });
            EXPECT_NE(message.find("bad.h5"), std::string::npos) << "byte " << at << ": " << message;
        }
        for (const std::size_t size : {std::size_t{0}, std::size_t{100}, std::size_t{600}, good.size() - 1}) {
            put_bytes(bad_file, good.substr(0, size));
            EXPECT_NE(refusal_of([&] { read(bad_file); }), "") << size << " bytes";
        }
    }
};

TEST_F(DecisionFiles, ARiskEstimateReadsBackEqual)
{
    for (const bool sequences : {false, true}) {
        const Risk risk = sample_risk(sequences);
        write_risk(risk, file);
        const Risk read = read_risk(file);
        const std::string text = risk_text(risk);
        EXPECT_EQ(risk_text(read), text);
        expect_in_page(text, risk_page(risk, "risk.h5", std::nullopt));
        EXPECT_NE(text.find("The answer\n  " + risk_answer(risk) + "\n  " + risk_grounds(risk) + "\n"),
                  std::string::npos)
            << text;
        EXPECT_NE(text.find("it, and in no interval: 1e-06 a year.\n"), std::string::npos) << text;
        EXPECT_NE(text.find("Any curve that rises through the shares of the stripes gives at least 0.0001 a year.\n"),
                  std::string::npos)
            << text;
        EXPECT_NE(text.find("  - collapse: why\n  - 1 invalid realization is left out.\n"), std::string::npos) << text;
        EXPECT_EQ(text.find("1 fall that had stood, 0 stand that had fallen") != std::string::npos, sequences) << text;
        EXPECT_EQ(risk_json(read).text(), risk_json(risk).text());
        EXPECT_EQ(risk_csv(read), risk_csv(risk));
        EXPECT_EQ(read.study_text, risk.study_text);
        EXPECT_EQ(read.code_version, risk.code_version);
        EXPECT_EQ(read.fragility_level, risk.fragility_level);
        EXPECT_EQ(read.most_outside, risk.most_outside);
        EXPECT_EQ(recognise(file).kind, FileKind::risk);
        write_risk(read, folder / "again.h5");
        EXPECT_EQ(bytes_in(folder / "again.h5"), bytes_in(file));
    }
}

TEST_F(DecisionFiles, AComparisonReadsBackEqual)
{
    for (const bool motions : {false, true}) {
        const Comparison comparison = sample_comparison(motions);
        write_comparison(comparison, file);
        const Comparison read = read_comparison(file);
        EXPECT_EQ(comparison_text(read), comparison_text(comparison));
        for (std::size_t limit = 0; limit < 2; ++limit)
            EXPECT_EQ(read.variants[1].limits[limit].by_motion, comparison.variants[1].limits[limit].by_motion);
        EXPECT_EQ(recognise(file).kind, FileKind::comparison);
        write_comparison(read, folder / "again.h5");
        EXPECT_EQ(bytes_in(folder / "again.h5"), bytes_in(file));
    }
}

TEST_F(DecisionFiles, ARiskOfAComparisonReadsBackEqual)
{
    const RiskChange change = sample_risk_change();
    write_risk(change, file);
    const RiskChange read = read_risk_change(file);
    EXPECT_EQ(risk_text(read), risk_text(change));
    EXPECT_EQ(risk_json(read).text(), risk_json(change).text());
    EXPECT_EQ(risk_csv(read), risk_csv(change));
    EXPECT_EQ(recognise(file).kind, FileKind::risk);
    EXPECT_EQ(recognise(file).detail, risk_of_comparison);
    write_risk(read, folder / "again.h5");
    EXPECT_EQ(bytes_in(folder / "again.h5"), bytes_in(file));
    expect_damage_is_found([](const fs::path& path) { read_risk_change(path); });

    const std::string text = risk_text(change);
    expect_in_page(text, risk_page(change, "risk.h5", std::nullopt));
    const std::string answer = risk_change_answer(change, change.variants[0]);
    EXPECT_NE(text.find("The answer\n  " + answer + "\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  -0.0003 (-0.0006 to -0.0001)       not determined  lower           what it is\n"),
              std::string::npos)
        << text;
    EXPECT_NE(
        text.find("in 100 years  9.52 % (3.28 to 33)        6.76 % (2.31 to 24.4)        -2 (-6 to -1) percentage "
                  "points\n"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("not determined  what it is\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  - tendon, peak_0.35: why\n  - A note.\n"), std::string::npos) << text;
    // 1 - exp(-0.1) and 1 - exp(-0.07)
    EXPECT_NE(answer.find("a probability of 9.52 % (3.28 to 33) in column and of 6.76 % (2.31 to 24.4) with dowels: a "
                          "change of -2 (-6 to -1) percentage points (90 % interval). The risk is lower."),
              std::string::npos)
        << answer;
}

/// Damage may be written with a valid seal: what has no meaning is refused.
TEST_F(DecisionFiles, ARiskOfAComparisonWithoutMeaningIsRefused)
{
    const auto refused = [&](const auto& edit, const char* why) {
        RiskChange change = sample_risk_change();
        edit(change);
        write_risk(change, file);
        const std::string message = refusal_of([&] { read_risk_change(file); });
        EXPECT_NE(message.find(why), std::string::npos) << message;
    };
    refused([](RiskChange& c) { c.years = {50, NAN}; }, "its years");
    refused([](RiskChange& c) { c.level = 0; }, "a level of its intervals");
    refused([](RiskChange& c) { c.variants[1].states.clear(); }, "a variant has no limit state");
    refused([](RiskChange& c) { c.variants.clear(); }, "it has no variant");
    refused([](RiskChange& c) { c.hazard.frequency[1] = 1; }, "its hazard is none");
}

TEST_F(DecisionFiles, OnlyComparisonsOfFragilityStudiesHaveARisk)
{
    HazardModel hazard = sample_risk_change().hazard;
    hazard.measure = "pgv_m_s";
    const auto refusal = [&](const Comparison& comparison, const RiskOptions& options = {}) {
        return refusal_of([&] { risk_change_of(comparison, "c.h5", hazard, options); });
    };
    EXPECT_NE(refusal(sample_comparison(false)).find("is a comparison of studies of kind 'surface'"),
              std::string::npos);
    Comparison cloud = sample_comparison(true);
    cloud.intensity.clear();
    EXPECT_NE(refusal(cloud).find("compares clouds"), std::string::npos);
    Comparison old = sample_comparison(true);
    for (LimitComparison& limit : old.variants[0].limits)
        limit.by_motion.clear();
    EXPECT_NE(refusal(old).find("Compare the results again"), std::string::npos) << refusal(old);
    RiskOptions options;
    options.state = "colapse";
    EXPECT_NE(refusal(sample_comparison(true), options).find("Did you mean collapse?"), std::string::npos);
    options.state = "collapse";
    options.most_outside = 1;
    const RiskChange change = risk_change_of(sample_comparison(true), "c.h5", hazard, options);
    ASSERT_EQ(change.variants.size(), 2U);
    ASSERT_EQ(change.variants[0].states.size(), 1U);
    EXPECT_EQ(change.variants[0].states[0].change.probability.size(), 2U);
}

TEST_F(DecisionFiles, EveryChangedByteOfARiskEstimateIsFound)
{
    write_risk(sample_risk(true), file);
    expect_damage_is_found([](const fs::path& path) { read_risk(path); });
}

TEST_F(DecisionFiles, EveryChangedByteOfAComparisonIsFound)
{
    write_comparison(sample_comparison(false), file);
    expect_damage_is_found([](const fs::path& path) { read_comparison(path); });
}

TEST_F(DecisionFiles, AreWrittenWholeAndLeaveNothingElse)
{
    put_bytes(file, "what was there before");
    write_risk(sample_risk(false), file);
    EXPECT_EQ(read_risk(file).states.size(), 3U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
    EXPECT_NE(refusal_of([&] { write_risk(sample_risk(false), folder / "no" / "r.h5"); }), "");
}

TEST_F(DecisionFiles, OneIsNotTheOther)
{
    write_risk(sample_risk(false), file);
    EXPECT_NE(refusal_of([&] { read_comparison(file); }).find("contains no comparison"), std::string::npos);
    write_comparison(sample_comparison(true), file);
    EXPECT_NE(refusal_of([&] { read_risk(file); }).find("contains no risk estimate"), std::string::npos);
}

/// A seal holds of what a faulty program writes too: then the numbers speak.
TEST_F(DecisionFiles, ARiskEstimateWithoutMeaningIsRefused)
{
    const auto refused = [&](const auto& change, const char* why) {
        Risk risk = sample_risk(false);
        change(risk);
        write_risk(risk, file);
        const std::string message = refusal_of([&] { read_risk(file); });
        EXPECT_NE(message.find("file.h5"), std::string::npos) << message;
        EXPECT_NE(message.find(why), std::string::npos) << message;
    };
    refused([](Risk& risk) { risk.years.clear(); }, "its years");
    refused([](Risk& risk) { risk.years = {50, NAN}; }, "its years");
    refused([](Risk& risk) { risk.level = 1; }, "a level of its intervals");
    refused([](Risk& risk) { risk.states.clear(); }, "it has no limit state");
    refused([](Risk& risk) { risk.states[1].estimate.parts.pop_back(); }, "a limit state has no parts");
    refused([](Risk& risk) { risk.hazard.frequency[1] = 1; }, "its hazard is none");
}

} // namespace
} // namespace stylobate
