/// Malformed files of every kind, through the targets of the fuzzers: their seeds, what they have found, and some
/// mutations of both with a fixed seed. Each is refused with one message, or read and right.

#include "tests/fuzz/target.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

namespace stylobate::fuzz {
namespace {

namespace fs = std::filesystem;

/// In one order on every file system.
std::map<fs::path, std::string> inputs_in(const fs::path& folder)
{
    std::map<fs::path, std::string> inputs;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.is_regular_file())
            inputs[entry.path()] = file_content(entry.path());
    return inputs;
}

class ReaderFuzz : public testing::TestWithParam<const Target*> {
protected:
    static fs::path room() { return fs::path(STYLOBATE_SOURCE_DIR) / "tests/fuzz"; }
    std::map<fs::path, std::string> seeds() const { return inputs_in(room() / "corpus" / GetParam()->name); }
    std::map<fs::path, std::string> findings() const { return inputs_in(room() / "findings" / GetParam()->name); }

    /// Fails the test where a reader does anything but refuse or read rightly.
    static Verdict judge(std::string_view input, const std::string& what)
    {
        try {
            return GetParam()->judge(input);
        } catch (const std::exception& error) {
            ADD_FAILURE() << GetParam()->name << ", " << what << ": " << error.what();
            return Verdict::refused;
        }
    }
};

TEST_P(ReaderFuzz, SeedsAreReadAndSmall)
{
    ASSERT_FALSE(seeds().empty());
    std::size_t accepted = 0;
    for (const auto& [path, input] : seeds()) {
        EXPECT_LE(input.size(), GetParam()->most_bytes) << path;
        accepted += judge(input, path.filename().string()) == Verdict::accepted;
    }
    EXPECT_GE(accepted, 2u);
}

TEST_P(ReaderFuzz, FindingsStayMended)
{
    for (const auto& [path, input] : findings())
        judge(input, path.filename().string());
}

TEST_P(ReaderFuzz, MutationsAreRefusedOrRight)
{
    std::vector<std::string> all;
    for (const auto& inputs : {seeds(), findings()})
        for (const auto& [path, input] : inputs)
            all.push_back(input);
    Random random(20261125);
    const int trials = GetParam()->trials;
    int accepted = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::string input = all[below(random, all.size())];
        for (std::size_t n = below(random, 4); n > 0; --n)
            input = GetParam()->mutated(input, random);
        input.resize(std::min(input.size(), GetParam()->most_bytes));
        accepted += judge(input, "trial " + std::to_string(trial)) == Verdict::accepted;
    }
    EXPECT_GT(accepted, trials / 100); // a test whose every input is refused would show little
    EXPECT_LT(accepted, trials * 95 / 100);
}

INSTANTIATE_TEST_SUITE_P(All, ReaderFuzz,
                         testing::Values(&record_target, &study_target, &results_target, &campaign_target,
                                         &table_target, &hazard_target, &decision_target),
                         [](const auto& info) { return std::string(info.param->name); });

} // namespace
} // namespace stylobate::fuzz
