/// The test for forces of no known kind, in a world whose truth is known: scores of unlike noise, correlated, with
/// heavy tails.

#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace stylobate {
namespace {

constexpr int all_variants = 34;

/// Scores of a campaign: noise of one size for each variant, with three hidden factors, and what acts.
class ScoreWorld {
public:
    explicit ScoreWorld(unsigned seed) : random_(seed)
    {
        for (int v = 0; v < all_variants; ++v) {
            noise_.push_back(std::exp(1.2 * normal_(random_))); // the noisiest are ten times the quietest
            for (int k = 0; k < 3; ++k)
                factors_.push_back(0.4 * normal_(random_));
        }
    }
    /// @param acting a variant; -1: none   @param strength in units of the variant's noise
    Eigen::VectorXd campaign(int acting = -1, double strength = 0)
    {
        std::student_t_distribution<double> tails(5);
        const double hidden[3] = {normal_(random_), normal_(random_), normal_(random_)};
        Eigen::VectorXd out(all_variants);
        for (int v = 0; v < all_variants; ++v) {
            const auto k = static_cast<std::size_t>(v);
            out(v) = tails(random_);
            for (std::size_t f = 0; f < 3; ++f)
                out(v) += factors_[3 * k + f] * hidden[f];
            if (v == acting)
                out(v) += strength;
            out(v) *= noise_[k];
        }
        return out;
    }
    double noise(int variant) const { return noise_[static_cast<std::size_t>(variant)]; }

private:
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::vector<double> noise_, factors_;
};

ForceEvidence evidence_of(ScoreWorld& world, int nulls)
{
    ForceEvidence evidence;
    evidence.nulls.resize(nulls, all_variants);
    for (int i = 0; i < nulls; ++i)
        evidence.nulls.row(i) = world.campaign().transpose();
    return evidence;
}

class ForceTestStatistics : public testing::Test {
protected:
    ForceTestStatistics() : world_(5), evidence_(evidence_of(world_, 330)) {}
    ForceTest judge(const Eigen::VectorXd& campaign)
    {
        evidence_.campaign = campaign;
        return force_test(evidence_);
    }
    ScoreWorld world_;
    ForceEvidence evidence_;
};

TEST_F(ForceTestStatistics, PValuesOfHealthyCampaignsAreUniform)
{
    int hundredth = 0, tenth = 0, half = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        const ForceTest test = judge(world_.campaign());
        hundredth += test.p_value <= 0.01 ? 1 : 0;
        tenth += test.p_value <= 0.1 ? 1 : 0;
        half += test.p_value <= 0.5 ? 1 : 0;
    }
    EXPECT_LE(hundredth, 12) << "4 of 400 are expected";
    EXPECT_NEAR(tenth, 40, 25) << "3 standard deviations, with that of the nulls";
    EXPECT_NEAR(half, 200, 55);
}

TEST_F(ForceTestStatistics, AForceIsFoundWhateverTheNoiseOfTheOthers)
{
    int found = 0;
    for (int v = 0; v < all_variants; ++v) {
        const ForceTest test = judge(world_.campaign(v, 20));
        found += test.variant == v && test.p_value <= 0.0075;
    }
    EXPECT_GE(found, all_variants - 2) << "a quiet one is not judged by the noisiest one";
}

TEST_F(ForceTestStatistics, AForceActsEitherWay)
{
    EXPECT_EQ(judge(world_.campaign(2, -25)).variant, 2);
}

TEST_F(ForceTestStatistics, WhatACampaignDoesNotShowIsNotJudged)
{
    const int force = 27;
    Eigen::VectorXd campaign = world_.campaign(force, 15);
    campaign(force) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(judge(campaign).variant, force);
    // that a campaign shows what healthy ones do not show says something
    for (Eigen::Index i = 0; i < evidence_.nulls.rows(); ++i)
        evidence_.nulls(i, force) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(judge(world_.campaign(force, 40)).variant, force);
    campaign.setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(judge(campaign).variant, -1);
    EXPECT_EQ(judge(campaign).p_value, 1);
}

TEST_F(ForceTestStatistics, CampaignsThatAreUnlikeDoNotCount)
{
    // half of the healthy campaigns have a law that makes all scores large
    const Eigen::VectorXd campaign = world_.campaign(27, 30);
    for (Eigen::Index i = 0; i < evidence_.nulls.rows(); i += 2)
        evidence_.nulls.row(i) *= 30;
    EXPECT_GT(judge(campaign).p_value, 0.0075);
    for (Eigen::Index i = 0; i < evidence_.nulls.rows(); ++i)
        evidence_.likeness.push_back(i % 2 == 0 ? 1e-4 : 1);
    EXPECT_LE(judge(campaign).p_value, 0.0075);
}

} // namespace
} // namespace stylobate
