/// Parts of a study, each run by itself, and joined: the same bytes as one run.

#include "tests/program/program.hpp"

#include <random>

namespace stylobate {
namespace {

const std::string inputs = STYLOBATE_SOURCE_DIR "/studies/inputs/";

class Shards : public Program {
protected:
    /// Runs all shards on different machines. @returns their files, shuffled
    Words run_shards(const std::string& study, const Words& settings, int of, const std::string& name = "part") const
    {
        Words files;
        for (int k = 1; k <= of; ++k) {
            const std::string file = name + std::to_string(k) + ".h5";
            const std::string shard = std::to_string(k) + "/" + std::to_string(of);
            const Ended ended = run(run_words(study, settings,
                                              {"--shard", shard, "-o", file, "--threads", k % 2 == 0 ? "1" : "3",
                                               "--simd", k % 3 == 0 ? "scalar" : "auto"}));
            EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
            EXPECT_NE(ended.out.find("of shard " + shard), std::string::npos) << ended.out;
            files.push_back(file);
        }
        std::shuffle(files.begin(), files.end(), std::mt19937_64(static_cast<unsigned>(of)));
        return files;
    }

    Ended merge(const Words& files, const std::string& to, const Words& more = {}) const
    {
        return run(with(with({"merge"}, files), with({"-o", to}, more)));
    }

    void expect_same_bytes(const std::string& study, const Words& settings, std::initializer_list<int> numbers) const
    {
        fs::remove(folder / "whole.h5");
        const Ended whole = run(run_words(study, settings, {"-o", "whole.h5"}));
        ASSERT_EQ(whole.status, 0) << testing::PrintToString(whole);
        for (const int of : numbers) {
            const Words files = run_shards(study, settings, of);
            const Ended merged = merge(files, "merged.h5", {"--force"});
            ASSERT_EQ(merged.status, 0) << testing::PrintToString(merged);
            EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "merged.h5")) << study << ' ' << of;
            EXPECT_EQ(without_first_line(merged.out), without_first_line(whole.out));
            for (const std::string& file : files)
                fs::remove(folder / file);
        }
    }
};

TEST_F(Shards, OfASurfaceAreItsBytes)
{
    expect_same_bytes(column_study, short_surface(20), {2, 4, 37});
}

TEST_F(Shards, OfCountsAreItsBytes)
{
    expect_same_bytes(column_study, with(short_surface(20), {"output.realizations=none"}), {4, 37});
}

TEST_F(Shards, OfOtherKindsAreTheirBytesLong)
{
    expect_same_bytes(inputs + "free_rocking.toml", {"study.realizations=5"}, {3});
    expect_same_bytes(inputs + "twins_column.toml",
                      {"study.realizations=4", "twins.followed=2", "surface.frequency_hz={from=2.0,to=4.0,count=2}",
                       "surface.pga_m_s2={from=2.0,to=9.0,count=2}"},
                      {3});
    expect_same_bytes(inputs + "fragility_column.toml",
                      {"study.realizations=2", "fragility.motions=8", "fragility.contacts=1"}, {3});
    expect_same_bytes(inputs + "sensitivity_column.toml", {"sensitivity.samples=16"}, {3});
    expect_same_bytes(round_column, short_surface_in_space(8), {3});
}

/// A run without shards is the only file that `merge` needs no others for; `run --shard 1/1` is such a run.
TEST_F(Shards, OneOfOneIsTheStudy)
{
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"-o", "whole.h5"})).status, 0);
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"--shard", "1/1", "-o", "one.h5"})).status, 0);
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "one.h5"));
    expect_refused({"merge", "whole.h5", "-o", "all.h5"}, {"whole.h5", "already complete"});
}

TEST_F(Shards, AreContinuedAndJoinedInAnyGrouping)
{
    const Words settings = short_surface(slow_build ? 64 : 320);
    ASSERT_EQ(run(run_words(column_study, settings, {"-o", "whole.h5"})).status, 0);
    const Words files = run_shards(column_study, settings, 5);
    // one of them once more, killed and interrupted on its way
    fs::remove(folder / "part3.h5");
    const Words words =
        run_words(column_study, settings, {"--shard", "3/5", "-o", "part3.h5", "--threads", "1", "--simd", "scalar"});
    const Ended killed =
        run(ProgramRun{.arguments = words, .terminal = true, .signal = SIGKILL, .when = when_done(20)});
    EXPECT_EQ(killed.signal, SIGKILL);
    const Ended stopped = run(
        ProgramRun{.arguments = words, .terminal = true, .signal = SIGINT, .when = when_done(slow_build ? 60 : 200)});
    EXPECT_EQ(stopped.status, 130) << testing::PrintToString(stopped);

    expect_refused({"merge", "part1.h5", "part3.h5", "part4.h5", "-o", "all.h5"},
                   {"realizations are missing", "part3.h5 lacks", "--shard 3/5 -o part3.h5", "shard 2/5 has no file",
                    "--shard 5/5", "--partial"});
    // what there is of 1, 3 and 4, and the rest of 3 by itself
    const Ended partial = merge({"part4.h5", "part3.h5", "part1.h5"}, "some.h5", {"--partial"});
    ASSERT_EQ(partial.status, 0) << testing::PrintToString(partial);
    EXPECT_NE(partial.out.find("Partial"), std::string::npos) << partial.out;
    EXPECT_FALSE(ResultReader(folder / "some.h5").complete());
    ASSERT_EQ(run(words).status, 0);
    const Ended again = run(words); // nothing is left to do
    EXPECT_EQ(again.status, 0) << testing::PrintToString(again);
    expect_refused({"merge", "some.h5", "part3.h5", "part2.h5", "part5.h5", "-o", "all.h5"},
                   {"some.h5 and part3.h5 both have realization"});

    const Ended rest = merge({"part2.h5", "part5.h5"}, "others.h5", {"--partial", "--json"});
    ASSERT_EQ(rest.status, 0);
    EXPECT_FALSE(json_of(rest)["complete"].boolean);
    ASSERT_EQ(merge({"part4.h5", "others.h5", "part1.h5", "part3.h5"}, "all.h5").status, 0);
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "all.h5"));
    // a partial merge is continued as a run that was interrupted
    ASSERT_EQ(run(run_words(column_study, settings, {"-o", "some.h5"})).status, 0);
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "some.h5"));
}

TEST_F(Shards, BadInputIsRefused)
{
    for (const char* shard : {"0/4", "5/4", "2", "a/b", "2/4/8"})
        expect_refused(run_words(column_study, eight_realizations, {"--shard", shard}), {"--shard", shard, "3/8"});
    expect_refused(run_words(inputs + "small_scale_column_adaptive.toml", {}, {"--shard", "1/2"}),
                   {"--shard 1/2", "chosen by what others did"});
    expect_refused(run_words(inputs + "rare_collapse.toml", {}, {"--shard", "1/2"}), {"chosen by what others did"});

    const Words files = run_shards(column_study, eight_realizations, 2, "a");
    expect_refused(run_words(column_study, eight_realizations, {"--shard", "2/2", "-o", "a1.h5"}),
                   {"a1.h5", "shard 1/2"});
    expect_refused(run_words(column_study, eight_realizations, {"-o", "a1.h5"}), {"a1.h5", "--shard 1/2"});
    run_shards(column_study, with(eight_realizations, {"study.seed=7"}), 2, "b");
    expect_refused({"merge", "a1.h5", "b2.h5", "-o", "all.h5"}, {"b2.h5", "another study", "seed"});
    run_shards(column_study, with(eight_realizations, {"output.realizations=none"}), 2, "c");
    expect_refused({"merge", "a1.h5", "c2.h5", "-o", "all.h5"}, {"c2.h5", "another study"});
    expect_refused({"merge", "a1.h5", "a1.h5", "-o", "all.h5"}, {"both have realization"});
    expect_refused({"merge", "c1.h5", "c1.h5", "-o", "all.h5"}, {"both have realization"});
    expect_refused({"merge", "a1.h5", "-o", "a2.h5"}, {"a2.h5", "--force"});
    expect_refused({"merge", "a1.h5", "nowhere.h5", "-o", "all.h5"}, {"nowhere.h5"});
    expect_refused({"merge", column_study, "-o", "all.h5"}, {"stylobate merge takes"});
    const Ended info = run({"info", "a2.h5"});
    EXPECT_NE(info.out.find("shard 2/2"), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("--shard 2/2 -o a2.h5"), std::string::npos) << info.out;
    EXPECT_EQ(json_of(run({"info", "a2.h5", "--json"}))["shard"].text, "2/2");
}

} // namespace
} // namespace stylobate
