/// Healthy laws: their draws, and what they make of a specimen.

#include "tests/ensemble/tracking/synthetic_campaign.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"
#include "studies/measured/windows/window_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace stylobate {
namespace {

std::vector<HealthyLaw> draw_laws(const LawFamily& family, std::uint64_t seed, std::uint64_t first, std::uint64_t count)
{
    std::vector<HealthyLaw> laws;
    for (std::uint64_t n = 0; n < count; ++n)
        laws.push_back(draw_law(family, seed, first + n));
    return laws;
}

TEST(LawFamily, DrawsFillItsRanges)
{
    const LawFamily family;
    const std::vector<HealthyLaw> laws = draw_laws(family, 1, 0, 2400);
    std::set<std::pair<ContactForm, DampingKind>> seen;
    double stiff = 0, shear = 0, strongest = 0;
    for (const HealthyLaw& law : laws) {
        seen.emplace(law.form, law.kind);
        EXPECT_TRUE(law.stiffness > 0.1 && law.stiffness < 3);
        EXPECT_TRUE(law.shear > 0.1 && law.shear < 1);
        EXPECT_TRUE(law.exponent > 0.7 && law.exponent < 1.6);
        EXPECT_TRUE(law.inset > 0 && law.inset < 0.03);
        EXPECT_TRUE(law.face_share > 0 && law.face_share <= 1);
        EXPECT_EQ(law.rate == 0, law.kind == DampingKind::light);
        stiff += std::log10(law.stiffness) / 2400;
        shear += std::log10(law.shear) / 2400;
        strongest = std::max(strongest, law.damping);
    }
    EXPECT_EQ(seen.size(), 12u);
    // uniform in their logarithms: 5 standard errors
    EXPECT_NEAR(stiff, std::log10(0.1 * 3) / 2, 5 * std::log10(3 / 0.1) / std::sqrt(12 * 2400.0));
    EXPECT_NEAR(shear, -0.5, 5 * 1 / std::sqrt(12 * 2400.0));
    EXPECT_GT(strongest, 0.95);
}

TEST(LawFamily, ADrawIsAFunctionOfItsNumber)
{
    const LawFamily family;
    const std::vector<HealthyLaw> laws = draw_laws(family, 3, 10, 4);
    for (std::uint64_t k = 0; k < 4; ++k)
        EXPECT_EQ(laws[k], draw_law(family, 3, 10 + k));
    EXPECT_NE(laws[0], draw_law(family, 4, 10));
    // what is left out changes nothing else
    LawFamily without_area = family;
    without_area.forms = {ContactForm::two_corner, ContactForm::points};
    const HealthyLaw other = draw_law(without_area, 3, 10);
    EXPECT_EQ(other.stiffness, laws[0].stiffness);
    EXPECT_EQ(other.shear, laws[0].shear);
    EXPECT_EQ(other.friction, laws[0].friction);
}

/// What is measured while nothing shakes.
Campaign still_campaign(int drums)
{
    SyntheticCampaign how{.runs = 1, .drums = drums, .strong_s = 0.4};
    Campaign campaign = measure(how);
    for (MeasuredRun& run : campaign.runs) {
        for (Series* series : {&run.base_displacement_m, &run.base_acceleration_m_s2})
            for (double& value : series->values)
                value = 0;
        for (Series* series : {&run.blocks.x_m, &run.blocks.y_m, &run.blocks.theta_rad})
            series->noise_sd = 0;
    }
    campaign.specimen.placement_tolerance_m = 0;
    return campaign;
}

TEST(LawFamily, EveryLawStands)
{
    const Campaign campaign = still_campaign(3);
    const Study study = default_study(campaign);
    HealthyScatter scatter;
    scatter.laws = draw_laws({}, 5, 0, 24);
    Observer observer;
    const VirtualCampaigns made =
        virtual_campaigns(VirtualLaboratory(campaign), study, 5, 0, 24, scatter, {}, {best_isa(), 1}, observer);
    ASSERT_TRUE(made.complete);
    const auto moved = [](const Series& series, std::size_t blocks) {
        double most = 0;
        for (std::size_t i = 0; i < series.values.size(); ++i)
            most = std::max(most, std::fabs(series.values[i] - series.values[i % blocks]));
        return most;
    };
    for (std::size_t c = 0; c < made.campaigns.size(); ++c) {
        const SeenMotion& seen = made.campaigns[c].runs[0].blocks;
        const std::size_t blocks = campaign.specimen.half_width_m.size();
        EXPECT_FALSE(made.campaigns[c].runs[0].collapsed.value_or(true)) << c;
        EXPECT_LT(moved(seen.x_m, blocks), 1e-6) << c;
        EXPECT_LT(moved(seen.y_m, blocks), 1e-6) << c;
        EXPECT_LT(moved(seen.theta_rad, blocks), 1e-5) << c;
    }
}

TEST(LawFamily, ASofteningLawOfPointsIsSteppedSafely)
{
    // it fell in the first tenth of a second with a step for small loads alone
    Campaign campaign = still_campaign(4);
    HealthyScatter scatter;
    HealthyLaw law;
    law.form = ContactForm::points;
    law.shear = 0.2;
    law.stiffness = 0.2;
    law.exponent = 0.8;
    law.damping = 0.005;
    scatter.laws = {law};
    Observer observer;
    MeasuredRun& run = campaign.runs.front();
    for (std::size_t i = 0; i < run.time_s.size(); ++i) // a jolt
        run.base_displacement_m.values[i] = 0.002 * std::sin(std::min(30 * run.time_s[i], std::numbers::pi));
    run.base_acceleration_m_s2.values.clear();
    const VirtualCampaigns made = virtual_campaigns(VirtualLaboratory(campaign), default_study(campaign), 1, 0, 1,
                                                    scatter, {}, {best_isa(), 1}, observer);
    EXPECT_FALSE(made.campaigns[0].runs[0].collapsed.value_or(true));
}

TEST(LawFamily, PutsItsNumbersIntoTheJoints)
{
    const Campaign campaign = still_campaign(2);
    const Study study = default_study(campaign);
    const SpecimenStructure built = build_specimen(campaign.specimen);
    HealthyLaw law;
    law.form = ContactForm::two_corner;
    law.stiffness = 3;
    law.shear = 0.2;
    law.exponent = 1.5;
    law.inset = 0.02;
    law.friction = 0.9;
    law.rate = 2;
    Study contacts = study;
    apply_law(law, contacts);
    Realization r = nominal_realization(contacts, built.structure);
    const Joint& joint = r.joints[static_cast<std::size_t>(built.bed[0])];
    EXPECT_DOUBLE_EQ(joint.normal_stiffness_n_m2, 3 * study.contact.normal_stiffness_n_m2);
    EXPECT_DOUBLE_EQ(joint.tangential_stiffness_n_m, 0.6 * study.contact.tangential_stiffness_n_m);
    EXPECT_DOUBLE_EQ(joint.friction, 0.9 * study.contact.friction);
    EXPECT_EQ(r.form, ContactForm::two_corner);
    // a corner that a cause took stays lost
    r.joints[static_cast<std::size_t>(built.bed[0])].mechanisms.chip_left_m = 0.001;
    apply_law(law, campaign.specimen, built, 0.9, r);
    const double inset = 0.02 * campaign.specimen.half_width_m[0];
    EXPECT_NEAR(joint.mechanisms.chip_left_m, 0.001 + inset, 1e-12);
    EXPECT_NEAR(joint.mechanisms.chip_right_m, inset, 1e-12);
    EXPECT_EQ(joint.mechanisms.force_exponent, 1.5);
    EXPECT_DOUBLE_EQ(r.step_s, 0.9 * step_bound(r).dt_s);
    // a softening law is no stiffer than the linear one under large loads, and stiffer under small ones
    Realization soft = nominal_realization(contacts, built.structure);
    law.exponent = 0.8;
    apply_law(law, campaign.specimen, built, 0.9, soft);
    Realization linear = soft;
    for (Joint& j : linear.joints)
        j.mechanisms.force_exponent = 1;
    EXPECT_LE(soft.step_s, 0.9 * step_bound(soft).dt_s);
    EXPECT_LE(soft.step_s, 0.9 * step_bound(linear).dt_s);
}

/// What stands still for 20 samples, then block 1 is moved; block 1 was put 1 mm to the right of block 0, block 2 2 mm
/// to the left.
Campaign put_askew()
{
    Campaign campaign = still_campaign(3);
    campaign.specimen.placement_tolerance_m = 0.002;
    MeasuredRun& run = campaign.runs[0];
    run.base_acceleration_m_s2.values.clear();               // how long it rests is not known
    const std::vector<double> placed = {0.03, 0.031, 0.028}; // the cameras' zero is 30 mm off
    for (std::size_t i = 0; i < run.blocks.x_m.values.size(); ++i)
        run.blocks.x_m.values[i] =
            campaign.specimen.rest_x_m[i % 3] + placed[i % 3] + (i >= 60 && i % 3 == 1 ? 0.5 : 0);
    return campaign;
}

TEST(SeenPlaces, AreThoseOfTheFirstSamplesFromWhatStandsOnTheBase)
{
    Campaign campaign = put_askew();
    MeasuredRun& run = campaign.runs[0];
    run.blocks.x_m.noise_sd = 0.0005;
    const SeenPlaces seen = seen_places(campaign.specimen, run);
    ASSERT_EQ(seen.offset_m.size(), 3U);
    EXPECT_NEAR(seen.offset_m[0], 0, 1e-12);
    EXPECT_NEAR(seen.offset_m[1], 0.001, 1e-12);
    EXPECT_NEAR(seen.offset_m[2], -0.002, 1e-12);
    EXPECT_DOUBLE_EQ(seen.sd_m, 0.0005 / std::sqrt(20.0));
    // from the table where that is seen
    run.table.x_m.values.assign(run.time_s.size(), 0.02);
    EXPECT_NEAR(seen_places(campaign.specimen, run).offset_m[0], 0.01, 1e-12);
    // where a block is not seen, nothing is known
    for (std::size_t i = 2; i < 60; i += 3)
        run.blocks.x_m.values[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(seen_places(campaign.specimen, run).offset_m.empty());
    EXPECT_TRUE(seen_places(campaign.specimen, {}).offset_m.empty());
}

TEST(VirtualCampaigns, PutTheBlocksWhereTheyWereSeen)
{
    Campaign campaign = put_askew();
    HealthyScatter scatter;
    Observer observer;
    constexpr std::size_t count = 24;
    /// (campaigns) of block b against block 0, mean over the samples
    const auto offsets = [&](bool as_seen, std::size_t b) {
        scatter.placed_as_seen = as_seen;
        std::vector<double> out;
        for (const Campaign& c : virtual_campaigns(VirtualLaboratory(campaign), default_study(campaign), 1, 0, count,
                                                   scatter, {}, {best_isa(), 1}, observer)
                                     .campaigns) {
            const std::vector<double>& x = c.runs[0].blocks.x_m.values;
            double sum = 0;
            for (std::size_t i = 0; i < x.size(); i += 3)
                sum += x[i + b] - x[i];
            out.push_back(sum / static_cast<double>(x.size() / 3));
        }
        return out;
    };
    const auto mean_and_sd = [](const std::vector<double>& values) {
        double mean = 0, square = 0;
        for (const double v : values)
            mean += v / count;
        for (const double v : values)
            square += (v - mean) * (v - mean) / (count - 1);
        return std::pair(mean, std::sqrt(square));
    };
    const auto [first, first_sd] = mean_and_sd(offsets(true, 1));
    EXPECT_NEAR(first, 0.001, 1e-5); // (beds give way under what stands askew)
    EXPECT_LT(first_sd, 1e-5);
    EXPECT_NEAR(mean_and_sd(offsets(true, 2)).first, -0.002, 1e-5);
    // else with the tolerance, of both blocks
    const double drawn_sd = mean_and_sd(offsets(false, 1)).second;
    EXPECT_NEAR(drawn_sd, 0.002 * std::sqrt(2.0), 0.002);
    // and where cameras are noisy the places are known no better; the means over all samples are
    Series& x = campaign.runs[0].blocks.x_m;
    x.noise_sd = 0.0005;
    const double known_to = 0.0005 * std::sqrt(2 / 20.0);
    const auto [noisy, noisy_sd] = mean_and_sd(offsets(true, 1));
    EXPECT_NEAR(noisy, 0.001, 5 * known_to / std::sqrt(double{count}));
    EXPECT_GT(noisy_sd, 0.6 * known_to);
    EXPECT_LT(noisy_sd, 1.6 * known_to);
    EXPECT_LT(0.0005 * std::sqrt(2.0 / static_cast<double>(x.values.size() / 3)), 0.4 * known_to);
}

TEST(LawFamily, CampaignsAreTheSameForEveryNumberOfThreads)
{
    const Campaign campaign = measure({.runs = 2, .drums = 2, .strong_s = 0.6});
    const Study study = default_study(campaign);
    HealthyScatter scatter;
    scatter.laws = draw_laws({}, 1, 0, 4);
    Observer observer;
    const auto seen = [&](std::uint64_t first, std::uint64_t count, const HealthyScatter& how, const RunOptions& run) {
        std::vector<double> all;
        for (const Campaign& c :
             virtual_campaigns(VirtualLaboratory(campaign), study, 1, first, count, how, {}, run, observer).campaigns)
            for (const MeasuredRun& r : c.runs)
                for (const double x : r.blocks.x_m.values)
                    all.push_back(std::isfinite(x) ? x : 1e9); // after a collapse

        return all;
    };
    const std::vector<double> together = seen(0, 4, scatter, {best_isa(), 1});
    EXPECT_EQ(together, seen(0, 4, scatter, {Isa::scalar, 3}));
    HealthyScatter last = scatter;
    last.laws = {scatter.laws[3]};
    const std::vector<double> alone = seen(3, 1, last, {best_isa(), 1});
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), together.end() - static_cast<std::ptrdiff_t>(alone.size())));
}

} // namespace
} // namespace stylobate
