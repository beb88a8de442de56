/// What a campaign determines of the friction, against slides by formula and a jackknife by hand.

#include "tests/ensemble/motion/formula_motions.hpp"

#include "studies/measured/diagnosis/direct/friction_judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace stylobate {
namespace {

/// A block that coasts on the table from these velocities, with the friction of each run, by formula.
Campaign coasting_campaign(const std::vector<double>& velocities_m_s, const std::vector<double>& friction)
{
    Campaign campaign;
    campaign.specimen = one_block(); // whose nominal friction is 0.5
    for (std::size_t r = 0; r < velocities_m_s.size(); ++r) {
        const std::vector<double> x =
            coasting(velocities_m_s[r], [&](double) { return friction[r] * formula_gravity; });
        campaign.runs.push_back(formula_run(
            campaign.specimen, static_cast<int>(x.size()),
            [&](int b, int i) {
                Pose pose = at_rest(campaign.specimen, b);
                pose.x += x[static_cast<std::size_t>(i)];
                return pose;
            },
            camera_m, camera_rad, static_cast<unsigned>(r + 1)));
    }
    return campaign;
}

FrictionJudgement judged(const Campaign& campaign)
{
    std::vector<std::vector<double>> base;
    for (const MeasuredRun& run : campaign.runs)
        base.push_back(run.base_displacement_m.values);
    return judge_friction(campaign, campaign_scales(campaign), base);
}

/// Windows of slides in which the balance says these frictions, without noise.
std::vector<LawSample> samples_of(const std::vector<double>& slides, int windows, double written_with)
{
    std::vector<LawSample> samples;
    for (std::size_t s = 0; s < slides.size(); ++s)
        for (int w = 0; w < windows; ++w) {
            LawSample sample;
            sample.run = static_cast<int>(s);
            sample.time_s = 0.01 * w;
            sample.value = slides[s] - written_with;
            sample.sd = 0.05; // beside which slides differ little: no sample is an outlier
            LawTerm term;
            term.sign = 1;
            term.normal = 1;
            term.half_width_m = 0.03;
            term.rest_weight_n = 8.8;
            sample.terms = {term};
            sample.coefficients.assign(3, 0.0);
            for (auto& derivative : sample.motion)
                for (auto& coordinate : derivative)
                    coordinate.assign(1, 0.0);
            samples.push_back(sample);
        }
    return samples;
}

} // namespace

TEST(FrictionJudgement, SlidesByFormulaGiveTheirFriction)
{
    for (const double friction : {0.25, 0.5, 0.8}) { // whatever is nominal
        const FrictionJudgement j =
            judged(coasting_campaign({1.0, -1.5, 2.0, -2.5, 3.0, -1.2}, std::vector<double>(6, friction)));
        SCOPED_TRACE(j.note);
        EXPECT_TRUE(j.determined) << friction;
        EXPECT_LT(j.low, friction);
        EXPECT_GT(j.high, friction);
        EXPECT_NEAR(j.value, friction, 0.05 * friction);
        EXPECT_LT(j.high / j.low, 1.5);
        EXPECT_EQ(j.slides, 6u);
        EXPECT_NE(j.note.find("6 slides in 6 runs"), std::string::npos);
    }
}

TEST(FrictionJudgement, WithoutSlidesThereIsNone)
{
    Campaign campaign;
    campaign.specimen = one_block();
    campaign.runs.push_back(formula_run(
        campaign.specimen, 400, [&](int b, int) { return at_rest(campaign.specimen, b); }, camera_m, camera_rad, 1));
    const FrictionJudgement j = judged(campaign);
    EXPECT_FALSE(j.determined);
    EXPECT_EQ(j.windows, 0u);
    EXPECT_TRUE(std::isnan(j.value)) << "the nominal friction is no finding";
    EXPECT_EQ(j.low, 0);
    EXPECT_TRUE(std::isinf(j.high));
    EXPECT_NE(j.note.find("no joint slides"), std::string::npos) << j.note;
}

TEST(FrictionJudgement, OneSlideDoesNotShowHowFarItErrs)
{
    const FrictionJudgement j = judged(coasting_campaign({2.0}, {0.4}));
    EXPECT_GT(j.windows, 3u);
    EXPECT_FALSE(j.determined);
    EXPECT_NE(j.note.find("of 1 slide in 1 run"), std::string::npos) << j.note;
}

TEST(FrictionJudgement, SlidesThatDisagreeDetermineNothing)
{
    const FrictionJudgement j = judged(coasting_campaign({1.5, -1.5, 2.0, -2.0}, {0.3, 0.6, 0.3, 0.6}));
    EXPECT_FALSE(j.determined) << j.low << ' ' << j.high;
    EXPECT_NE(j.note.find("determine it only between"), std::string::npos) << j.note;
}

TEST(FrictionJudgement, TheErrorIsAJackknifeOverSlides)
{
    // the mean of the slides; leaving one out moves it as Quenouille's jackknife of a mean says: deviation / sqrt(n)
    const std::vector<double> slides = {0.505, 0.495, 0.505, 0.495, 0.505, 0.495};
    const Specimen specimen = one_block();
    Campaign campaign;
    campaign.specimen = specimen;
    campaign.runs.push_back(formula_run(
        specimen, 100, [&](int b, int) { return at_rest(specimen, b); }, camera_m, camera_rad, 1));
    const CampaignScales scales = campaign_scales(campaign);
    const FrictionJudgement j = judge_friction(specimen, scales, samples_of(slides, 20, 0.5), 0.5, 6);
    EXPECT_EQ(j.windows, 120u);
    EXPECT_EQ(j.slides, 6u);
    EXPECT_NEAR(j.value, 0.5, 1e-4);
    // the fit's own: 120 samples of a weight of 5 / (4 + 0.2^2) and half of their noise, hypot(0.05, 0.01); beside it
    // the one joint may differ by 4 % from all joints together
    const double information = 120 * 5 / (4 + 0.0385) * 0.25 / (0.25 * 0.0026);
    EXPECT_NEAR(j.fit, std::sqrt(1 / information + 0.04 * 0.04), 1e-4);
    const double deviation = 0.005 * std::sqrt(6.0 / 5); // of the six about their mean
    EXPECT_NEAR(j.leaving_out * j.value, deviation / std::sqrt(6.0), 0.05 * deviation / std::sqrt(6.0));
    // many windows do not make an interval narrower that the slides have
    const FrictionJudgement more = judge_friction(specimen, scales, samples_of(slides, 80, 0.5), 0.5, 6);
    EXPECT_NEAR(more.leaving_out, j.leaving_out, 0.1 * j.leaving_out);
    EXPECT_NEAR(std::log(j.high / j.value), 1.96 * std::hypot(j.fit, j.leaving_out), 1e-12);
    EXPECT_NEAR(std::log(j.value / j.low), 1.96 * std::hypot(j.fit, j.leaving_out), 1e-12);
}

} // namespace stylobate
