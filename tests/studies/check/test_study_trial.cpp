/// The trial before a run: which realizations it takes, that they are the same on every machine, and what is made of
/// it.

#include "studies/check/run_cost.hpp"
#include "studies/check/study_trial.hpp"
#include "studies/results/kinds.hpp"
#include "tests/studies/check/ready_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace stylobate {
namespace {

/// Of a run that keeps no trajectories.
RunSize size_of(const LoadedStudy& loaded)
{
    const ResultHeader header = loaded.result_header();
    return size_of_run(loaded, *make_kind(loaded.study(), header), nullptr);
}

TEST(TrialOrder, TakesEachOnceAndEvenly)
{
    const LoadedStudy loaded = ready("small_scale_monolith", {"study.realizations=16"}); // 8 x 8 cells
    TrialOrder order(loaded.study(), 0, 1024);
    std::set<std::uint64_t> all;
    std::vector<int> of_row(8), of_column(8);
    int taken = 0;
    for (const std::uint64_t count : {7, 57, 100, 2000}) {
        const std::vector<std::uint64_t> next = order.next(count);
        EXPECT_TRUE(std::is_sorted(next.begin(), next.end()));
        for (const std::uint64_t index : next) {
            EXPECT_TRUE(all.insert(index).second) << index << " comes twice";
            EXPECT_LT(index, 1024U);
            ++of_row[index / 16 / 8];
            ++of_column[index / 16 % 8];
            ++taken;
        }
        for (const auto& counts : {of_row, of_column})
            for (const int n : counts)
                EXPECT_NEAR(n, taken / 8.0, 4) << "after " << taken;
    }
    EXPECT_EQ(all.size(), 1024U);
}

TEST(TrialOrder, OfARangeStaysInIt)
{
    const LoadedStudy loaded =
        ready("twins_column", {"study.realizations=1", "twins.followed=1"}); // 256 cells, eight replicas of each
    TrialOrder order(loaded.study(), 512, 1024);
    const std::vector<std::uint64_t> all = order.next(10000);
    ASSERT_EQ(all.size(), 512U);
    EXPECT_EQ(all.front(), 512U);
    EXPECT_EQ(all.back(), 1023U);
}

/// A realization of 1e9 steps does not end in a trial: its time is that of its steps.
TEST(StudyTrial, TheTimeOfALongRealizationIsThatOfItsSteps)
{
    const LoadedStudy loaded = ready("free_rocking", {"excitation.duration_s=10000"});
    Observer nobody;
    const Trial trial = try_study(loaded.experiment(), {best_isa(), 1}, 0.01, 0, nobody);
    ASSERT_TRUE(trial.unfinished);
    ASSERT_GT(trial.lane_s_per_step, 0);
    const RunSize size = size_of(loaded);
    const RunTime time = longest_time_of_run(trial, size);
    EXPECT_TRUE(time.at_most);
    EXPECT_EQ(time.threads, 1);
    EXPECT_DOUBLE_EQ(time.processor_s, trial.lane_s_per_step * size.longest_steps.high);
}

/// What a trial has simulated.
std::vector<std::tuple<std::uint64_t, State, std::uint64_t>> seen(const Trial& trial)
{
    std::vector<std::tuple<std::uint64_t, State, std::uint64_t>> all;
    for (const TrialPart& part : trial.parts)
        for (const TrialRealization& r : part.run)
            all.emplace_back(r.index, r.state, r.steps);
    return all;
}

TEST(StudyTrial, IsTheWholeOfASmallStudyWhateverRunsIt)
{
    Observer nobody;
    for (const char* name : {"small_scale_monolith", "doric_column"}) {
        const LoadedStudy loaded = ready(name, {"study.realizations=1", "surface.frequency_hz.count=3",
                                                "surface.pga_m_s2.count=2", "surface.frequency_hz.from=2"});
        const Trial wide = try_study(loaded.experiment(), {best_isa(), 2}, 1e6, 0, nobody);
        const Trial narrow = try_study(loaded.experiment(), {Isa::scalar, 1}, 1e6, 0, nobody);
        EXPECT_EQ(wide.count(), 6U);
        EXPECT_TRUE(wide.whole());
        EXPECT_FALSE(wide.unfinished);
        EXPECT_EQ(seen(wide), seen(narrow)) << name;
    }
}

/// The n-th realization of a short trial is that of a long one.
TEST(StudyTrial, TakesTheFirstOfItsOrder)
{
    Observer nobody;
    const LoadedStudy loaded = ready("small_scale_monolith");
    const Trial trial = try_study(loaded.experiment(), {best_isa(), 1}, 0.01, 0, nobody);
    TrialOrder order(loaded.study(), 0, loaded.study().total());
    std::vector<std::uint64_t> indices;
    for (const TrialRealization& r : trial.parts.at(0).run)
        indices.push_back(r.index);
    EXPECT_GT(indices.size(), 0U);
    EXPECT_EQ(indices, order.next(indices.size()));
}

TEST(StudyTrial, EndsWhenItIsAskedTo)
{
    struct : Observer {
        bool stop_requested() override { return true; }
    } impatient;
    for (const char* name : {"small_scale_column", "mechanisms"}) {
        const Trial trial = try_study(ready(name).experiment(), {best_isa(), 1}, 1e6, 0, impatient);
        EXPECT_TRUE(trial.unfinished) << name;
        EXPECT_FALSE(trial.whole()) << name;
    }
}

TEST(RunTime, IsThatOfTheTrialTimesWhatThereIs)
{
    const LoadedStudy loaded = ready("small_scale_monolith"); // 8192 realizations of one block
    const RunSize size = size_of(loaded);
    EXPECT_EQ(size.realizations, 8192U);
    EXPECT_EQ(size.free_blocks, 1);
    Trial trial;
    trial.threads = 2;
    TrialPart part{.total = 8192, .run = {}, .processor_s = 0.5, .processor_sd = 0.01};
    for (std::uint64_t i = 0; i < 4; ++i)
        part.run.push_back({.index = i, .steps = 1000 + 200 * i});
    trial.parts.push_back(part);
    const RunTime time = time_of_run(loaded, trial, size, 0);
    EXPECT_NEAR(time.seconds(), 8192 * 0.5 / 2, 5);
    EXPECT_NEAR(time.block_steps, 8192 * 1300.0, 1);
    EXPECT_EQ(time.steps.low, 1000);
    EXPECT_EQ(time.steps.high, 1600);
    EXPECT_LT(time.range_s().low, time.seconds() - 2 * 8192 * 0.01 / 2);
    EXPECT_GT(time.range_s().high, time.seconds() + 2 * 8192 * 0.01 / 2);
    EXPECT_FALSE(time.at_most);
}

/// The dearest cells, each as often as there are realizations, until the budget is spent.
TEST(RunTime, OfAnAdaptiveSurfaceIsBoundedByItsDearestCells)
{
    const LoadedStudy loaded =
        ready("small_scale_column_adaptive", {"study.realizations=100", "surface.frequency_hz.count=2",
                                              "surface.pga_m_s2.count=2", "surface.adaptive.budget=250"});
    Trial trial;
    TrialPart part{.total = 400, .run = {}, .processor_s = 1, .processor_sd = 0};
    for (std::uint64_t cell = 0; cell < 4; ++cell)
        part.run.push_back({.index = 100 * cell, .cell = cell, .steps = 1000 * (cell + 1)});
    trial.parts.push_back(part);
    const RunSize size = size_of(loaded);
    const RunTime time = time_of_run(loaded, trial, size, 0);
    EXPECT_TRUE(time.at_most);
    EXPECT_EQ(size.realizations, 250U);
    // 100 of 4000 steps, 100 of 3000, 50 of 2000, where 250 of 2500 in the mean take 250 s
    const double dearest = 250 * (100 * 4000 + 100 * 3000 + 50 * 2000) / (250 * 2500.0);
    EXPECT_GT(time.processor_range_s.high, dearest);
    EXPECT_LT(time.processor_range_s.high, 1.4 * dearest);
}

} // namespace
} // namespace stylobate
