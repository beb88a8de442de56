/// Calibrations of campaigns under contact laws that the model does not have: what is said to be determined is true,
/// and the diagnosis says the same.

#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/pipeline.hpp"
#include "tests/hidden/virtual_campaign.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace stylobate {
namespace {

constexpr int threads = 2;

/// Few points, and windows of two runs: the friction is judged by all runs, and depends on neither.
/// @param friction_alone the other parameters are held
Calibration calibrated(const Campaign& campaign, bool friction_alone)
{
    const Study start = default_study(campaign);
    CalibrationOptions options;
    if (friction_alone)
        for (const FitKey& key : contact_keys(start))
            if (key.key == "contact.friction")
                options.keys.push_back(key);
    options.scan = 6;
    options.refine = 4;
    options.surface = 18;
    options.profile = 0;
    options.held_out = false;
    options.runs = {0, 1};
    Observer observer;
    Calibration found = calibrate(campaign, start, options, {best_isa(), threads}, observer);
    EXPECT_TRUE(found.complete);
    return found;
}

const FittedParameter& parameter(const Calibration& calibration, const std::string& key)
{
    const std::vector<FittedParameter>& all = calibration.forms.front().parameters;
    const auto found = std::find_if(all.begin(), all.end(), [&](const FittedParameter& p) { return p.key == key; });
    EXPECT_NE(found, all.end()) << key;
    return *found;
}

double true_friction(const hidden::VirtualCampaign& made)
{
    double sum = 0;
    for (int j = 0; j < made.model.bed_count; ++j)
        sum += made.model.beds[static_cast<std::size_t>(j)].friction;
    return sum / made.model.bed_count;
}

/// The diagnosis' word of the friction is the calibration's.
void expect_the_same(const Campaign& campaign, const FittedParameter& friction)
{
    DiagnosisOptions options;
    options.plan = EnsemblePlan::with(0);
    options.run = {best_isa(), threads};
    Observer observer;
    const std::optional<Diagnosis> d = diagnose(
        campaign, default_study(campaign), options, [](const std::string&) {}, observer);
    ASSERT_TRUE(d);
    const auto said = std::find_if(d->baseline.begin(), d->baseline.end(),
                                   [](const CalibratedParameter& p) { return p.name == "contact.friction"; });
    ASSERT_NE(said, d->baseline.end());
    EXPECT_EQ(said->determined, friction.determined);
    EXPECT_EQ(said->value, friction.value);
    EXPECT_EQ(said->low.has_value(), friction.determined);
    if (friction.determined) {
        EXPECT_EQ(*said->low, friction.low);
        EXPECT_EQ(*said->high, friction.high);
    }
    EXPECT_NE(friction.note.find(said->note), std::string::npos) << friction.note << " | " << said->note;
}

} // namespace

TEST(CalibrationHiddenStatistics, WhereLittleSlidesTheFrictionIsNotDeterminedLong)
{
    // the friction that windows of this campaign like best is 0.41, with an interval of 4 % to either side; of its
    // first three runs alone, for time
    hidden::VirtualCampaign made = hidden::make_campaign(4);
    made.campaign.runs.resize(3);
    const Calibration found = calibrated(made.campaign, false);
    const FittedParameter& friction = parameter(found, "contact.friction");
    EXPECT_NEAR(true_friction(made), 0.68, 0.03);
    EXPECT_FALSE(friction.determined) << friction.low << " to " << friction.high;
    EXPECT_FALSE(friction.bounded_below || friction.bounded_above);
    EXPECT_NE(friction.note.find("not determined by these data, held at the study's: "), std::string::npos)
        << friction.note;
    EXPECT_EQ(friction.value, *made.campaign.specimen.friction_nominal);
    EXPECT_EQ(found.forms.front().study.contact.friction, friction.value) << "it keeps the study's value";
    for (const char* key : {"contact.normal_stiffness_n_m2", "contact.tangential_stiffness_n_m",
                            "contact.normal_damping_ratio", "contact.tangential_damping_ratio"}) {
        const FittedParameter& p = parameter(found, key);
        EXPECT_FALSE(p.determined) << key << ": the specimen has no such number";
        EXPECT_TRUE(p.effective) << key;
        EXPECT_FALSE(p.note.empty()) << key;
    }
    expect_the_same(made.campaign, friction);
}

TEST(CalibrationHiddenStatistics, WhereJointsSlideTheIntervalHoldsTheTruth)
{
    struct Case {
        std::uint64_t seed;
        hidden::Law law;
    };
    for (const Case& c : {Case{22047, hidden::Law::compliant}, Case{21026, hidden::Law::nonsmooth}}) {
        hidden::Wish wish;
        wish.law = c.law;
        wish.effects.emplace();
        wish.friction = {0.4, 1.2};
        const hidden::VirtualCampaign made = hidden::make_campaign(c.seed, wish);
        const FittedParameter friction = parameter(calibrated(made.campaign, true), "contact.friction");
        const double truth = true_friction(made);
        SCOPED_TRACE(fmt::format("seed {}: {} ({} to {}), is {}; {}", c.seed, friction.value, friction.low,
                                 friction.high, truth, friction.note));
        EXPECT_TRUE(friction.determined);
        EXPECT_FALSE(friction.effective);
        EXPECT_LE(friction.low, truth);
        EXPECT_GE(friction.high, truth);
        EXPECT_LT(friction.high / friction.low, 1.4);
        EXPECT_LT(friction.high, 0.8 * *made.campaign.specimen.friction_nominal) << "the nominal friction is not used";
        if (c.law == hidden::Law::nonsmooth)
            expect_the_same(made.campaign, friction);
    }
}

} // namespace stylobate
