/// The speed guard: its verdicts on ratios whose answer is known, and the program on two builds that are scripts.

#include "bench/results_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

using namespace stylobate;

namespace {

std::vector<double> noisy(double ratio, double spread, int pairs, std::mt19937_64& random)
{
    std::student_t_distribution<double> noise(2); // heavy tails, as neighbours make them
    std::vector<double> ratios;
    for (int i = 0; i < pairs; ++i)
        ratios.push_back(ratio * std::exp(spread * noise(random)));
    return ratios;
}

/// How often each verdict is given.
std::array<int, 4> verdicts(double ratio, double spread, int pairs)
{
    std::mt19937_64 random(7);
    std::array<int, 4> count{};
    for (int i = 0; i < 2000; ++i)
        ++count[static_cast<std::size_t>(compare(noisy(ratio, spread, pairs, random)).verdict)];
    return count;
}

} // namespace

TEST(Pairs, IntervalIsBetweenOrderStatistics)
{
    // of 6 pairs the smallest and the largest hold the median with 1 - 2 / 64
    const Comparison c = compare({1.1, 1.2, 1.3, 1.4, 1.5, 1.6});
    EXPECT_NEAR(c.confidence, 1 - 2.0 / 64, 1e-12);
    EXPECT_EQ(c.low, 1.1);
    EXPECT_EQ(c.high, 1.6);
    EXPECT_NEAR(c.ratio, std::sqrt(1.3 * 1.4), 1e-12);
    EXPECT_EQ(c.verdict, Verdict::faster);
    // of 5 they do not with 95 %
    EXPECT_EQ(compare({1.1, 1.2, 1.3, 1.4, 1.5}).verdict, Verdict::open);
    // of 15: 4th smallest and largest, 1 - 2 (1 + 15 + 105 + 455) / 2^15
    std::vector<double> many;
    for (int i = 1; i <= 15; ++i)
        many.push_back(i / 8.0);
    const Comparison m = compare(many);
    EXPECT_EQ(m.low, 4 / 8.0);
    EXPECT_EQ(m.high, 12 / 8.0);
    EXPECT_NEAR(m.confidence, 1 - 2 * 576.0 / 32768, 1e-12);
    EXPECT_EQ(m.verdict, Verdict::open);
    EXPECT_THROW(compare({}), std::invalid_argument);
    EXPECT_THROW(compare({1, 0}), std::invalid_argument);
}

TEST(Pairs, SaysWhatIsSoAndRarelyWhatIsNot)
{
    const auto index = [](Verdict v) { return static_cast<std::size_t>(v); };
    const auto equal = verdicts(1, 0.02, 15);
    EXPECT_LT(equal[index(Verdict::faster)] + equal[index(Verdict::slower)], 2000 * 0.05);
    const auto faster = verdicts(1.1, 0.02, 15);
    EXPECT_GT(faster[index(Verdict::faster)], 2000 * 0.98);
    const auto slower = verdicts(0.95, 0.01, 15);
    EXPECT_GT(slower[index(Verdict::slower)], 2000 * 0.98);
    const auto quiet = verdicts(1.001, 0.001, 15);
    EXPECT_GT(quiet[index(Verdict::same)], 2000 * 0.98);
    const auto loud = verdicts(1.02, 0.2, 7);
    EXPECT_GT(loud[index(Verdict::open)], 2000 * 0.9);
}

TEST(SpeedGuard, TellsTwoBuildsApart)
{
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "stylobate_speed_guard_test";
    std::filesystem::create_directories(folder);
    // a "build" writes fixed rates where the guard asks it to
    const auto build = [&](const char* name, double rate) {
        const std::filesystem::path path = folder / name;
        std::ofstream(path)
            << "#!/bin/sh\nfor a in \"$@\"; do case $a in --benchmark_out=*) out=${a#*=};; esac; done\n"
            << "echo '{\"context\": {\"processor\": \"P\", \"stylobate\": \"C\"}, \"benchmarks\": [{\"name\": "
               "\"BM_Step/x/7\", \"run_type\": \"iteration\", \"block_steps_per_second\": "
            << rate << "}]}' > \"$out\"\n";
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path.string();
    };
    const auto guard = [&](const std::string& arguments, std::string& said) {
        std::FILE* pipe = popen((std::string(STYLOBATE_SPEED_GUARD) + " " + arguments + " 2>&1").c_str(), "r");
        std::array<char, 256> part{};
        said.clear();
        while (std::fgets(part.data(), part.size(), pipe) != nullptr)
            said += part.data();
        return WEXITSTATUS(pclose(pipe));
    };
    const std::string slow = build("slow build", 1e8), fast = build("fast", 2e8);
    std::string said;
    EXPECT_EQ(guard("'" + slow + "' '" + fast + "' --pairs 7", said), 0);
    EXPECT_NE(said.find("| BM_Step/x/7 | 2.000 | 2.000 to 2.000 (98.4 %) | faster |"), std::string::npos) << said;
    EXPECT_EQ(guard("'" + fast + "' '" + slow + "' --pairs 7", said), 1);
    EXPECT_NE(said.find("| 0.500 |"), std::string::npos) << said;
    EXPECT_NE(said.find("slower"), std::string::npos) << said;
    EXPECT_EQ(guard("'" + fast + "' '" + fast + "' --pairs 7", said), 0);
    EXPECT_NE(said.find("the same"), std::string::npos) << said;
    EXPECT_EQ(guard("/nowhere '" + fast + "'", said), 2);
    EXPECT_EQ(guard("/bin/false '" + fast + "'", said), 2);
    EXPECT_NE(said.find("/bin/false failed"), std::string::npos) << said;
    std::filesystem::remove_all(folder);
}

TEST(ResultsFile, SaysWhatIsWrong)
{
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "stylobate_results_file.json";
    std::ofstream(path) << "{ \"context\": 1 }";
    EXPECT_THROW(read_results(path.string()), std::runtime_error);
    std::ofstream(path) << "{";
    try {
        read_results(path.string());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("line 1"), std::string::npos) << error.what();
    }
    std::ofstream(path) << R"({"context": {"processor": "P"}, "benchmarks": [
        {"name": "a/1", "run_type": "iteration", "block_steps_per_second": 3e6, "iterations": 5},
        {"name": "a/1", "run_type": "iteration", "block_steps_per_second": 4e6},
        {"name": "a/1_mean", "run_type": "aggregate", "block_steps_per_second": 9e6}]})";
    const ResultsFile file = read_results(path.string());
    EXPECT_EQ(file.runs.size(), 2U);
    EXPECT_EQ(file.processor, "P");
    EXPECT_EQ(file.best("a/1", "block_steps_per_second"), 4e6);
    EXPECT_EQ(file.best("b", "block_steps_per_second"), 0);
    std::filesystem::remove(path);
}
