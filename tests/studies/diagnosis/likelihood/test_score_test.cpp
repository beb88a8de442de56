/// The verdict from scores, in a world whose truth is known: variants of unlike noise, correlated, with heavy tails.

#include "studies/diagnosis/likelihood/score_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace stylobate {
namespace {

constexpr int planted_mechanisms = 6, planted_places = 4, unknown_forces = 10;
constexpr int planted = planted_mechanisms * planted_places, all_variants = planted + unknown_forces;

/// Scores of a campaign: noise of one size for each variant, with three hidden factors, and what a cause adds.
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
    /// @param cause -1: none   @param strength in units of the variant's noise
    Eigen::VectorXd campaign(int cause = -1, double strength = 0)
    {
        std::student_t_distribution<double> tails(5);
        const double hidden[3] = {normal_(random_), normal_(random_), normal_(random_)};
        Eigen::VectorXd out(all_variants);
        for (int v = 0; v < all_variants; ++v) {
            const auto k = static_cast<std::size_t>(v);
            out(v) = tails(random_);
            for (std::size_t f = 0; f < 3; ++f)
                out(v) += factors_[3 * k + f] * hidden[f];
            if (v == cause)
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

ScoreEvidence evidence_of(ScoreWorld& world, int nulls)
{
    ScoreEvidence evidence;
    for (int v = 0; v < all_variants; ++v) {
        evidence.variants.mechanism.push_back(v < planted ? v / planted_places : -1);
        evidence.variants.sign.push_back(v < planted && v / planted_places > 1 ? 1 : 0);
    }
    evidence.nulls.resize(nulls, all_variants);
    for (int i = 0; i < nulls; ++i)
        evidence.nulls.row(i) = world.campaign().transpose();
    evidence.labelled.resize(planted * 6, all_variants);
    for (int i = 0; i < planted * 6; ++i) {
        evidence.labelled_mechanism.push_back(i % planted / planted_places);
        evidence.labelled.row(i) = world.campaign(i % planted, 4.0 + 3 * (i / planted)).transpose();
    }
    return evidence;
}

class ScoreTestStatistics : public testing::Test {
protected:
    ScoreTestStatistics() : world_(5), evidence_(evidence_of(world_, 330)) {}
    ScoreVerdict judge(const Eigen::VectorXd& campaign)
    {
        evidence_.campaign = campaign;
        return score_test(evidence_);
    }
    ScoreWorld world_;
    ScoreEvidence evidence_;
};

TEST_F(ScoreTestStatistics, PValuesOfHealthyCampaignsAreUniform)
{
    int named = 0, tenth = 0, half = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        const ScoreVerdict verdict = judge(world_.campaign());
        named += verdict.named ? 1 : 0;
        tenth += verdict.cause.p_value <= 0.1 ? 1 : 0;
        half += verdict.unknown.p_value <= 0.5 ? 1 : 0;
    }
    EXPECT_LE(named, 10) << "3 of 400 are expected";
    EXPECT_NEAR(tenth, 40, 25) << "3 standard deviations, with that of the nulls";
    EXPECT_NEAR(half, 200, 55);
}

TEST_F(ScoreTestStatistics, APlantedCauseIsNamedWithAProbabilityThatHolds)
{
    int named = 0, right = 0, quiet = 0, noisy = 0;
    double stated = 0;
    const int n = 3 * planted;
    for (int i = 0; i < n; ++i) {
        const int cause = i % planted;
        const ScoreVerdict verdict = judge(world_.campaign(cause, 16));
        if (!verdict.named)
            continue;
        ++named;
        stated += verdict.probability;
        right += verdict.cause.variant / planted_places == cause / planted_places ? 1 : 0;
        (world_.noise(cause) < 1 ? quiet : noisy) += 1;
    }
    EXPECT_GE(named, 0.8 * n);
    EXPECT_GE(right, 0.93 * named);
    EXPECT_NEAR(stated / named, static_cast<double>(right) / named, 0.1);
    int quiet_ones = 0;
    for (int c = 0; c < planted; ++c)
        quiet_ones += world_.noise(c) < 1 ? 1 : 0;
    EXPECT_GE(quiet, 0.7 * 3 * quiet_ones) << "a quiet variant is not judged by the noisiest one";
}

TEST_F(ScoreTestStatistics, AForceOfNoKnownKindIsNoCause)
{
    const ScoreVerdict verdict = judge(world_.campaign(planted + 3, 15));
    EXPECT_EQ(verdict.unknown.variant, planted + 3);
    EXPECT_LE(verdict.unknown.p_value, 0.0075);
    EXPECT_GT(verdict.unknown.score, verdict.cause.score);
}

TEST_F(ScoreTestStatistics, ACauseOfOneSignDoesNotActTheOtherWay)
{
    const int two_sided = 2, one_sided = planted - 1;
    EXPECT_TRUE(judge(world_.campaign(two_sided, -15)).named);
    EXPECT_EQ(judge(world_.campaign(one_sided, -15)).scores[one_sided], 0);
}

TEST_F(ScoreTestStatistics, WhatACampaignDoesNotShowIsNotJudged)
{
    Eigen::VectorXd campaign = world_.campaign(7, 15);
    campaign(7) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(judge(campaign).scores[7], 0);
    // that a campaign shows what healthy ones do not show says something
    for (Eigen::Index i = 0; i < evidence_.nulls.rows(); ++i)
        evidence_.nulls(i, 7) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(judge(world_.campaign(7, 40)).cause.variant, 7);
    campaign.setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(judge(campaign).cause.variant, -1);
    EXPECT_FALSE(judge(campaign).named);
}

TEST_F(ScoreTestStatistics, CampaignsThatAreUnlikeDoNotCount)
{
    // half of the healthy campaigns have a law that makes all scores large
    const Eigen::VectorXd campaign = world_.campaign(7, 30);
    for (Eigen::Index i = 0; i < evidence_.nulls.rows(); i += 2)
        evidence_.nulls.row(i) *= 30;
    EXPECT_FALSE(judge(campaign).named);
    for (Eigen::Index i = 0; i < evidence_.nulls.rows(); ++i)
        evidence_.likeness.push_back(i % 2 == 0 ? 1e-4 : 1);
    EXPECT_TRUE(judge(campaign).named);
}

} // namespace
} // namespace stylobate
