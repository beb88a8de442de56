/// What the loop keeps: tables and sequences come back as they were, and those of another specimen do not.

#include "ensemble/model/input_error.hpp"
#include "studies/measured/loop/loop_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace stylobate {
namespace {

/// A file in a folder of its own, which goes with the test.
struct LoopFolder {
    LoopFolder()
    {
        path = std::filesystem::path(testing::TempDir()) /
               ("loop_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    ~LoopFolder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

std::string whole_text(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void put_text(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

Specimen two_blocks()
{
    Specimen s;
    s.name = "two";
    s.half_width_m = {0.024, 0.024};
    s.half_height_m = {0.0145, 0.0145};
    s.depth_m = {0.05, 0.05};
    s.mass_kg = {0.135, 0.135};
    s.rest_x_m = {0, 0};
    s.rest_y_m = {0.0145, 0.0435};
    s.joints = {{-1, 0}, {0, 1}};
    return s;
}

SimulatedTests small_tables()
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    SimulatedTests t;
    t.columns = {{RunKind::push, 0, "plateau", "N", "", 0.01}, {RunKind::pull, 1, "slope", "1/(m/s)", "speed", 0.1}};
    t.healthy = (Eigen::MatrixXd(3, 2) << 1.0 / 3, 2, none, 4, 5, 1e-300).finished();
    t.causes = {{{"corner_loss", "joint 0", 0.002, "m"}, (Eigen::MatrixXd(2, 2) << 7, 8, none, 10).finished(), {2, 0}},
                {{"stribeck", "all", -0.1, ""}, (Eigen::MatrixXd(1, 2) << 0.1, -0.0).finished(), {}}};
    return t;
}

bool equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    if (a.rows() != b.rows() || a.cols() != b.cols())
        return false;
    for (Eigen::Index i = 0; i < a.size(); ++i)
        if (!(a.data()[i] == b.data()[i] || (std::isnan(a.data()[i]) && std::isnan(b.data()[i]))))
            return false;
    return true;
}

TEST(LoopFile, SimulatedTestsComeBackAsTheyWere)
{
    const LoopFolder folder;
    const auto file = folder.path / "tests.tsv";
    EXPECT_FALSE(kept_tests(file, "a")) << "no file";
    const SimulatedTests tests = small_tables();
    keep_tests(file, "a", tests);
    const std::optional<SimulatedTests> found = kept_tests(file, "a");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->columns, tests.columns);
    EXPECT_TRUE(equal(found->healthy, tests.healthy));
    ASSERT_EQ(found->causes.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(found->causes[i].cause, tests.causes[i].cause);
        EXPECT_TRUE(equal(found->causes[i].rows, tests.causes[i].rows));
        EXPECT_EQ(found->causes[i].pairs, tests.causes[i].pairs);
    }
}

TEST(LoopFile, SimulatedTestsOfSomethingElseAreMadeAnew)
{
    const LoopFolder folder;
    const auto file = folder.path / "tests.tsv";
    keep_tests(file, "a", small_tables());
    EXPECT_FALSE(kept_tests(file, "b"));
    const std::string text = whole_text(file);
    for (std::size_t length = text.find('\n') + 1; length + 1 < text.size(); length += 7) {
        put_text(file, text.substr(0, length));
        EXPECT_FALSE(kept_tests(file, "a")) << "cut after " << length;
    }
    std::string damaged = text;
    damaged.replace(damaged.find("with\t2"), 6, "with\t7");
    put_text(file, damaged);
    EXPECT_FALSE(kept_tests(file, "a")) << "a pair that is not there";
    put_text(file, "name\tvalue\n");
    try {
        kept_tests(file, "a");
        FAIL() << "a file of something else would be overwritten";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("tests.tsv:1: keeps no simulated tests"), std::string::npos);
    }
}

TEST(LoopFile, FingerprintsDependOnSpecimenAndProcedure)
{
    Specimen s = two_blocks();
    const std::string specimen = specimen_fingerprint(s), tests = tests_fingerprint(s, "push 0.02 m/s");
    EXPECT_NE(tests, tests_fingerprint(s, "push 0.03 m/s"));
    s.name = "the same";
    s.centre_of_mass_m = {0, 0.001}; // measured at rest, between two tests
    EXPECT_EQ(specimen_fingerprint(s), specimen);
    s.mass_kg[1] = 0.136;
    EXPECT_NE(specimen_fingerprint(s), specimen);
    EXPECT_NE(tests_fingerprint(s, "push 0.02 m/s"), tests);
    s = two_blocks();
    s.joints[1] = {-1, 1};
    EXPECT_NE(specimen_fingerprint(s), specimen);
}

TEST(LoopFile, ASequenceIsContinued)
{
    const LoopFolder folder;
    const auto file = folder.path / "sequence.tsv";
    EXPECT_TRUE(kept_sequence(file, two_blocks()).tests.empty());
    TestSequence sequence;
    sequence.shares = {{"friction", std::nullopt, 0.4}, {"corner_loss", "joint 1", 0.1}};
    sequence.tests = {{RunKind::push, std::nullopt, {{"plateau", 0, 1.0 / 3}, {"plateau", 1, 0.2}}},
                      {RunKind::drop, 1, {{"time until at rest", 1, 0.31}}}};
    keep_sequence(file, two_blocks(), sequence);
    const TestSequence found = kept_sequence(file, two_blocks());
    EXPECT_EQ(found.tests, sequence.tests);
    ASSERT_EQ(found.shares.size(), 2U);
    EXPECT_EQ(found.shares[0].place, std::nullopt);
    EXPECT_EQ(found.shares[1].place, "joint 1");
    EXPECT_EQ(found.shares[1].weight, 0.1);
}

TEST(LoopFile, ASequenceOfAnotherSpecimenIsRefused)
{
    const LoopFolder folder;
    const auto file = folder.path / "sequence.tsv";
    keep_sequence(file, two_blocks(), {{}, {{RunKind::push, 0, {{"plateau", 0, 1}}}}});
    Specimen other = two_blocks();
    other.name = "other";
    other.half_width_m[0] = 0.03;
    const std::string before = whole_text(file);
    try {
        kept_sequence(file, other);
        FAIL() << "tests of another specimen";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what())
                      .find("keeps the tests of another specimen than 'other': sizes, masses or "
                            "joints differ.\n  Name another file"),
                  std::string::npos)
            << error.what();
    }
    EXPECT_EQ(whole_text(file), before);
    put_text(file, before + "estimate\tplateau\tone\t3\n");
    EXPECT_THROW(kept_sequence(file, two_blocks()), InputError);
    put_text(file, "# another file\n");
    EXPECT_THROW(kept_sequence(file, two_blocks()), InputError);
}

TEST(DoneTest, FindsItsColumns)
{
    Signatures s;
    s.columns = small_tables().columns;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::vector<SeenEstimate> seen = seen_estimates(
        s, std::vector<DoneTest>{{RunKind::pull, 1, {{"slope", 1, 4}}}, {RunKind::push, {}, {{"plateau", 0, none}}}});
    ASSERT_EQ(seen.size(), 1U) << "what gave no value does not count";
    EXPECT_EQ(seen[0].column, 1);
    EXPECT_EQ(seen[0].value, 4);
    EXPECT_THROW(seen_estimates(s, DoneTest{RunKind::pull, 0, {{"slope", 0, 4}}}), InputError);
    EXPECT_EQ(test_words(RunKind::pull, 1), "pull at joint 1");
    EXPECT_EQ(test_words(RunKind::drop, std::nullopt), "drop at all joints");
}

} // namespace
} // namespace stylobate
