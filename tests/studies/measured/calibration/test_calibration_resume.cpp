/// An interrupted calibration goes on where it was, with the same bits.

#include "tests/io/measured/measured_samples.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "tests/ensemble/run/thread_ranks.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

namespace fs = std::filesystem;

namespace stylobate {
namespace {

using test::ThreadRanks;

/// Asks to stop once so many parameter sets are done.
class StopAfter : public Observer {
public:
    explicit StopAfter(std::uint64_t sets) : sets_(sets) {}
    void progress(const Progress& p) override { done_ = p.done; }
    bool stop_requested() override { return done_ >= sets_; }

private:
    const std::uint64_t sets_;
    std::uint64_t done_ = 0;
};

class CalibrationResume : public testing::Test {
protected:
    CalibrationResume() : folder_("calibration_resume")
    {
        SyntheticCampaign c;
        c.runs = 2;
        campaign_ = measure(c);
        start_ = default_study(campaign_);
        options_.keys = {fit_key(start_, "contact.friction=0.25:0.95"),
                         fit_key(start_, "contact.normal_stiffness_n_m2=2e6:5e7")};
        options_.scan = 20;
        options_.refine = 8;
        options_.surface = 12;
        options_.profile = 3;
        options_.kept_key = "crc32 of the data";
        sets_ = folder_ / "c_sets.bin";
    }

    Calibration run(Observer& observer, const std::optional<fs::path>& kept, int threads = 2) const
    {
        CalibrationOptions options = options_;
        options.kept = kept;
        return calibrate(campaign_, start_, options, {best_isa(), threads}, observer);
    }

    static void expect_same(const Calibration& a, const Calibration& b)
    {
        ASSERT_EQ(a.forms.size(), b.forms.size());
        for (std::size_t i = 0; i < a.forms[0].parameters.size(); ++i) {
            const FittedParameter &p = a.forms[0].parameters[i], &q = b.forms[0].parameters[i];
            EXPECT_EQ(p.value, q.value) << p.key;
            EXPECT_EQ(p.low, q.low) << p.key;
            EXPECT_EQ(p.high, q.high) << p.key;
            EXPECT_EQ(p.note, q.note) << p.key;
        }
        EXPECT_EQ(a.forms[0].score, b.forms[0].score);
        EXPECT_EQ(a.forms[0].held_out.total, b.forms[0].held_out.total);
        EXPECT_EQ(a.forms[0].study.text, b.forms[0].study.text);
        EXPECT_EQ(a.parameter_sets, b.parameter_sets);
        EXPECT_EQ(a.simulations, b.simulations);
        EXPECT_EQ(a.window_simulations, b.window_simulations);
        EXPECT_EQ(a.block_steps, b.block_steps);
    }

    MeasuredFolder folder_;
    Campaign campaign_;
    Study start_;
    CalibrationOptions options_;
    fs::path sets_;
};

TEST_F(CalibrationResume, TheBitsAreThoseOfOneGo)
{
    Observer patient;
    const Calibration one_go = run(patient, {});
    ASSERT_TRUE(one_go.complete);

    StopAfter soon(17), later(30);
    const Calibration first = run(soon, sets_);
    EXPECT_FALSE(first.complete);
    EXPECT_GE(first.kept_sets, 17u);
    EXPECT_LT(first.kept_sets, one_go.parameter_sets);
    ASSERT_TRUE(fs::exists(sets_));

    const Calibration second = run(later, sets_, 1);
    EXPECT_FALSE(second.complete);
    EXPECT_GT(second.kept_sets, first.kept_sets);

    const Calibration last = run(patient, sets_);
    ASSERT_TRUE(last.complete);
    EXPECT_EQ(last.restored_sets, second.kept_sets);
    expect_same(last, one_go);
    EXPECT_FALSE(fs::exists(sets_)) << "what is complete needs it no longer";
}

/// Begun by one process, continued by three ranks, of which rank 0 alone has the file.
TEST_F(CalibrationResume, RanksHaveTheBitsOfOneProcess)
{
    Observer patient;
    const Calibration alone = run(patient, {});
    StopAfter soon(17);
    const Calibration begun = run(soon, sets_);
    ASSERT_FALSE(begun.complete);
    ThreadRanks(3).run([&](Ranks& ranks) {
        CalibrationOptions options = options_;
        if (ranks.leads())
            options.kept = sets_;
        RunOptions how{best_isa(), 1};
        how.ranks = &ranks;
        Observer own;
        const Calibration found = calibrate(campaign_, start_, options, how, own);
        EXPECT_EQ(found.complete, ranks.leads());
        if (!ranks.leads())
            return;
        EXPECT_EQ(found.restored_sets, begun.kept_sets);
        expect_same(found, alone);
    });
}

/// Whichever of them is asked to stop: rank 0 keeps what is whole, and the others end.
TEST_F(CalibrationResume, AnyRankStopsAllOfThem)
{
    for (const int who : {0, 2}) {
        ThreadRanks(3).run([&](Ranks& ranks) {
            CalibrationOptions options = options_;
            RunOptions how{best_isa(), 1};
            how.ranks = &ranks;
            StopAfter stop(ranks.rank() == who ? 0 : ~std::uint64_t{0});
            EXPECT_FALSE(calibrate(campaign_, start_, options, how, stop).complete) << "stopped by rank " << who;
        });
    }
}

TEST_F(CalibrationResume, WhatIsCutOrDamagedIsMadeAnew)
{
    Observer patient;
    const Calibration one_go = run(patient, {});
    StopAfter stop(30);
    const Calibration first = run(stop, sets_);
    ASSERT_FALSE(first.complete);

    // a record that a kill has cut
    const std::uintmax_t whole = fs::file_size(sets_);
    fs::resize_file(sets_, whole - 5);
    StopAfter at_once(1);
    const Calibration cut = run(at_once, sets_);
    EXPECT_LT(cut.kept_sets, first.kept_sets);
    EXPECT_GT(cut.kept_sets, 0u);

    // a byte in the first record: nothing is restored
    {
        std::fstream file(sets_, std::ios::binary | std::ios::in | std::ios::out);
        file.seekp(200);
        const char wrong = 0x5a;
        file.write(&wrong, 1);
    }
    const Calibration last = run(patient, sets_);
    ASSERT_TRUE(last.complete);
    EXPECT_EQ(last.restored_sets, 0u);
    expect_same(last, one_go);
}

TEST_F(CalibrationResume, OtherDataBeginAnew)
{
    StopAfter stop(17);
    ASSERT_GT(run(stop, sets_).kept_sets, 0u);
    options_.kept_key = "crc32 of other data";
    Observer patient;
    const Calibration last = run(patient, sets_);
    EXPECT_TRUE(last.complete);
    EXPECT_EQ(last.restored_sets, 0u);
}

} // namespace
} // namespace stylobate
