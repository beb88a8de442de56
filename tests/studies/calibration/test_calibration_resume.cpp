/// An interrupted calibration goes on where it was, with the same bits.

#include "tests/io/measured/measured_samples.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/calibration/calibration.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;

namespace stylobate {
namespace {

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

    Calibration run(Observer& observer, const fs::path& kept, int threads = 2) const
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

    // a byte in the first record: nothing is believed
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
