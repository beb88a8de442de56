/// The loop as a whole, in a laboratory that has callipers and a thread alone, so that little is simulated.

#include "studies/measured/loop/laboratory_loop.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "kernels/isa.hpp"
#include "studies/measured/diagnosis/findings/story_document.hpp"
#include "tests/studies/measured/small_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

/// Three small blocks in a laboratory without gauge, and whose table and board hardly move.
Campaign callipers_alone()
{
    Campaign campaign;
    campaign.source = "three.h5";
    campaign.specimen = small_blocks(3, 0.7);
    campaign.specimen.centre_of_mass_m = {0, 0, 0};
    campaign.specimen.bearing_left_m = campaign.specimen.bearing_right_m = {2e-4, 2e-4, 2e-4};
    campaign.laboratory.stroke_m = 1e-4;
    campaign.laboratory.tilt_rad = 0.01;
    campaign.laboratory.force_n = 0;
    return campaign;
}

Study stone_contacts()
{
    Study study;
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 5e6;
    study.contact.friction = 0.7;
    return study;
}

LoopOptions small_plan(const fs::path& cache)
{
    LoopOptions options;
    options.plan.healthy = 40;
    options.plan.of_each_cause = 6;
    options.cache = cache;
    options.run = {best_isa(), 2};
    return options;
}

class LaboratoryLoop : public testing::Test {
protected:
    std::optional<TestStory> told(const Campaign& campaign)
    {
        return laboratory_loop(campaign, stone_contacts(), {}, small_plan(folder / "tests.txt"), observer);
    }

    TemporaryFolder folder;
    Observer observer;
};

TEST_F(LaboratoryLoop, NamesAShiftedCentreByCallipersAloneAndNothingOfAHealthySpecimen)
{
    Campaign campaign = callipers_alone();
    const std::optional<TestStory> healthy = told(campaign);
    ASSERT_TRUE(healthy);
    EXPECT_EQ(healthy->verdict, SequenceVerdict::none) << healthy->text;
    ASSERT_EQ(healthy->steps.size(), 1U);
    EXPECT_EQ(healthy->steps[0].test, "rest");
    EXPECT_EQ(healthy->steps[0].joints, "0, 1, 2");
    for (const std::string& test : healthy->next)
        EXPECT_TRUE(test == "drop" || test == "rest") << test << " cannot be done";
    const auto pull = std::ranges::find(healthy->options, "pull", &StoryOption::test);
    ASSERT_NE(pull, healthy->options.end());
    EXPECT_NE(pull->left_out, "");

    // simulated by itself: what healthy specimens give must not be what was measured of this one
    campaign.specimen.centre_of_mass_m[1] = 0.003;
    fs::remove(folder / "tests.txt");
    const std::optional<TestStory> shifted = told(campaign);
    ASSERT_TRUE(shifted);
    EXPECT_EQ(shifted->verdict, SequenceVerdict::named) << shifted->text;
    ASSERT_EQ(shifted->named.size(), 1U);
    const StoryCause& named = shifted->named.front();
    EXPECT_EQ(named.mechanism, "eccentricity");
    EXPECT_EQ(named.place, "block 1");
    ASSERT_TRUE(named.low && named.high);
    EXPECT_NEAR(named.size, 0.003, 0.0004);
    EXPECT_LT(*named.low, 0.003);
    EXPECT_GT(*named.high, 0.003);
    EXPECT_TRUE(shifted->next.empty());

    Document document;
    add_story(*shifted, document);
    const std::string text = console_text(document);
    for (const char* words : {"eccentricity at block 1", "Test 1: rest at joints 0, 1, 2", "rest.centre"})
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

/// Asks to stop once it has been told to.
struct StoppedInTheMiddle : Observer {
    bool stop = false;
    bool stop_requested() override { return stop; }
};

TEST_F(LaboratoryLoop, ContinuesWhereItWasStoppedAndKeepsItsSimulations)
{
    const Campaign campaign = callipers_alone();
    StoppedInTheMiddle stopping;
    std::vector<std::uint64_t> rows;
    LoopOptions options = small_plan(folder / "stopped.txt");
    options.plan.of_each_cause = 2; // the verdict does not matter here
    options.progress = [&](std::uint64_t done, std::uint64_t) {
        rows.push_back(done);
        stopping.stop = true;
    };
    const auto run = [&](const Campaign& of, Observer& seen_by) {
        rows.clear();
        stopping.stop = false;
        std::optional<TestStory> story = laboratory_loop(of, stone_contacts(), {}, options, seen_by);
        if (story) { // what each call takes for itself
            story->simulations = 0;
            story->seconds = 0;
        }
        return story;
    };
    EXPECT_FALSE(run(campaign, stopping));
    ASSERT_EQ(rows.size(), 1U);
    const std::uint64_t kept = rows.front();
    const std::optional<TestStory> continued = run(campaign, observer);
    ASSERT_FALSE(rows.empty());
    EXPECT_GT(rows.front(), kept) << "what was kept is not simulated again";
    EXPECT_EQ(run(campaign, observer), continued);
    EXPECT_TRUE(rows.empty()) << "all rows are in the file";

    // another specimen is simulated anew, not taken from the file
    Campaign heavier = campaign;
    heavier.specimen.mass_kg = {0.2, 0.2, 0.2};
    EXPECT_FALSE(run(heavier, stopping));
    EXPECT_FALSE(rows.empty());

    options.cache = folder / "whole.txt";
    const std::optional<TestStory> whole = run(campaign, observer);
    ASSERT_TRUE(whole);
    EXPECT_EQ(continued, whole);

    std::ofstream(folder / "notes.txt") << "my notes\n";
    options.cache = folder / "notes.txt";
    try {
        run(campaign, observer);
        ADD_FAILURE() << "the notes would be overwritten";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("no file of simulated tests"), std::string::npos) << error.what();
    }
}

TEST_F(LaboratoryLoop, ToldWhatItCouldNotUse)
{
    Campaign campaign = callipers_alone();
    MeasuredRun run;
    run.name = "mystery";
    run.test = RunKind::drop;
    campaign.tests.push_back(run);                      // names no joint
    campaign.tests.emplace_back().test = RunKind::rest; // names none either, and its numbers are the specimen's
    run.name = "unseen";
    run.joint = 1;
    campaign.tests.push_back(run); // has no series
    const std::optional<TestStory> story = told(campaign);
    ASSERT_TRUE(story);
    ASSERT_EQ(story->notes.size(), 2U);
    EXPECT_NE(story->notes[0].find("Run mystery is left out: it names no joint"), std::string::npos) << story->notes[0];
    EXPECT_NE(story->notes[1].find("drop at joint 1 gave no estimate"), std::string::npos) << story->notes[1];
}

TEST(LaboratorySheet, SaysWhatIsDone)
{
    const Campaign campaign = callipers_alone();
    const Campaign plan = planned_campaign(campaign, {"push", "rest"});
    ASSERT_EQ(plan.tests.size(), 9U) << "to both sides of three joints, and each of them at rest";
    EXPECT_EQ(plan.tests[5].joint, 2);
    EXPECT_TRUE(plan.tests[0].blocks.empty()) << "nothing is measured yet";
    EXPECT_EQ(plan.tests[8].test, RunKind::rest);
    EXPECT_EQ(plan.tests[8].run_order, 8) << "in the order in which they are proposed";
    const std::vector<std::string> lines = sheet_of(campaign.specimen, {}, RunKind::push, {0, 1, 2});
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_NE(lines[0].find("joints 0, 1, 2"), std::string::npos);
    EXPECT_NE(lines[2].find("Tape 2 blocks"), std::string::npos);
    EXPECT_NE(lines[3].find("mm/s"), std::string::npos);
    EXPECT_NE(lines[4].find("--test push"), std::string::npos);
}

TEST(PriorOfTheLoop, IsThatOfTheFirstDiagnosis)
{
    Diagnosis d;
    d.candidates.resize(2);
    d.candidates[0].mechanism = "dowel";
    d.candidates[0].place = "joint 1";
    d.candidates[1].mechanism = "drag";
    d.candidates[1].place = "all";
    d.candidates[0].gain_nats = 8;
    d.candidates[1].gain_nats = 0;
    const std::vector<PriorShare> by_gain = prior_shares(d);
    ASSERT_EQ(by_gain.size(), 2U);
    EXPECT_NEAR(by_gain[0].weight, 0.7, 1e-12) << "a gain of 0 says nothing";
    EXPECT_EQ(by_gain[1].weight, 0);
    d.candidates[1].probability = 0.4;
    const std::vector<PriorShare> by_probability = prior_shares(d);
    EXPECT_EQ(by_probability[0].weight, 0);
    EXPECT_EQ(by_probability[1].weight, 0.4);
}

} // namespace
} // namespace stylobate
