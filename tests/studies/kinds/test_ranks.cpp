/// Studies that several ranks run together have the bytes of one that a process runs alone.

#include "studies/cluster/shared_round.hpp"
#include "tests/ensemble/run/thread_ranks.hpp"
#include "tests/studies/verify/results_made.hpp"

#include <atomic>

namespace stylobate {
namespace {

std::string bytes_of(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// As `stylobate run --mpi`.
/// @param observer of a rank @return whether the run was completed
template <class MakeObserver>
bool run_by(int size, const LoadedStudy& loaded, const std::string& file, const MakeObserver& observer)
{
    std::atomic<int> complete = 0;
    test::ThreadRanks(size).run([&](Ranks& ranks) {
        StudyRun run(loaded, loaded.result_header(), file, file, &ranks);
        run.agree();
        RunOptions options{best_isa(), 1};
        options.ranks = &ranks;
        const auto told = observer(ranks);
        complete += run.run(options, *told).complete;
    });
    EXPECT_TRUE(complete == 0 || complete == size) << "the ranks do not agree on whether all is done";
    return complete == size;
}

std::unique_ptr<Observer> patient(Ranks&)
{
    return std::make_unique<Observer>();
}

class StudiesOnRanks : public MadeResults {
protected:
    void have_the_bytes_of_one(const LoadedStudy& loaded)
    {
        fs::remove(file);
        make_results(loaded, file);
        for (const int size : {1, 2, 4}) {
            const std::string by_ranks = (folder / ("by_" + std::to_string(size) + ".h5")).string();
            fs::remove(by_ranks);
            EXPECT_TRUE(run_by(size, loaded, by_ranks, patient));
            EXPECT_TRUE(bytes_of(by_ranks) == bytes_of(file)) << size << " ranks";
        }
    }
};

TEST_F(StudiesOnRanks, OfASurfaceWithRowsAndWithCounts)
{
    have_the_bytes_of_one(ready_study("small_scale_column", two_cells(40)));
    have_the_bytes_of_one(ready_study("small_scale_column", two_cells(40, {"output.realizations=none"})));
}

TEST_F(StudiesOnRanks, WhoseRoundsDependOnTheRows)
{
    have_the_bytes_of_one(ready_study("small_scale_column_adaptive", two_cells(200, {"surface.adaptive.budget=300"})));
    have_the_bytes_of_one(ready_study("rare_collapse", {"rare.samples=200", "rare.repeats=5"}));
}

/// Stopped by a rank on its way, and continued by another number of them, and by a process alone.
TEST_F(StudiesOnRanks, AreContinuedByAnyNumberOfThem)
{
    for (const LoadedStudy& loaded : {ready_study("small_scale_column", two_cells(200)),
                                      ready_study("rare_collapse", {"rare.samples=200", "rare.repeats=5"})}) {
        const std::string whole = (folder / "whole.h5").string(), part = (folder / "part.h5").string();
        fs::remove(whole);
        make_results(loaded, whole);
        for (const int who : {0, 2}) {
            fs::remove(part);
            EXPECT_FALSE(run_by(3, loaded, part, [who](Ranks& ranks) -> std::unique_ptr<Observer> {
                if (ranks.rank() == who)
                    return std::make_unique<Impatient>(2);
                return std::make_unique<Observer>();
            }));
            EXPECT_TRUE(run_by(2, loaded, part, patient));
            EXPECT_TRUE(bytes_of(part) == bytes_of(whole)) << "stopped by rank " << who;
        }
    }
}

/// Ranks whose decisions differ, as on machines whose numbers do, end with an error instead of a mixture.
TEST_F(StudiesOnRanks, ThatHaveOtherRoundsBeforeThemAreRefused)
{
    const LoadedStudy loaded = ready_study("small_scale_column", two_cells(10));
    const ResultHeader header = loaded.result_header();
    std::atomic<int> refused = 0;
    test::ThreadRanks(3).run([&](Ranks& ranks) {
        const std::vector<std::uint64_t> indices = {0, 1, ranks.rank() == 1 ? 3U : 2U};
        RunPlan plan;
        plan.indices = indices;
        plan.total = indices.size();
        RunOptions options{best_isa(), 1};
        options.ranks = &ranks;
        Observer own;
        try {
            run_on_ranks(
                loaded.experiment(), options, plan, header, true, [](const ResultRow&) {}, own);
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("rank 1: 3 realizations"), std::string::npos) << error.what();
            ++refused;
        }
    });
    EXPECT_EQ(refused, 3);
}

/// Rank 0 tells of all ranks, and the last it tells is the end.
TEST_F(StudiesOnRanks, TellTheProgressOfAllOfThem)
{
    class Last : public Observer {
    public:
        explicit Last(Progress& last) : last_(last) {}
        void progress(const Progress& progress) override { last_ = progress; }

    private:
        Progress& last_;
    };
    const LoadedStudy loaded = ready_study("small_scale_column", two_cells(100));
    Progress told;
    EXPECT_TRUE(run_by(3, loaded, file, [&](Ranks& ranks) -> std::unique_ptr<Observer> {
        if (ranks.leads())
            return std::make_unique<Last>(told);
        return std::make_unique<Observer>();
    }));
    EXPECT_EQ(told.done, 200U);
    EXPECT_EQ(told.total, 200U);
    const ResultReader reader(file);
    std::uint64_t collapsed = 0;
    reader.for_each_row([&](const ResultRow& row) { collapsed += row.outcome.state == State::collapsed; });
    EXPECT_EQ(told.collapsed, collapsed);
    EXPECT_GT(collapsed, 0U);
}

} // namespace
} // namespace stylobate
