/// The files of comparisons and risk estimates: what is written is read, whole or not at all, and damaged files
/// are refused.

#include "ensemble/model/input_error.hpp"
#include "io/files/temporary_folder.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/decisions/compare/comparison_file.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/risk/risk_file.hpp"
#include "studies/decisions/risk/risk_text.hpp"
#include "tests/studies/decisions/decision_samples.hpp"

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
        EXPECT_EQ(risk_text(read), risk_text(risk));
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
        EXPECT_EQ(recognise(file).kind, FileKind::comparison);
        write_comparison(read, folder / "again.h5");
        EXPECT_EQ(bytes_in(folder / "again.h5"), bytes_in(file));
    }
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
