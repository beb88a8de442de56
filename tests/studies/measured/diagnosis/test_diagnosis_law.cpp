/// Samples of the joints' laws, from motions that are known by formula.

#include "tests/ensemble/motion/formula_motions.hpp"

#include "studies/measured/diagnosis/evidence/law_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stylobate {
namespace {

std::vector<LawSample> samples_of(const Campaign& campaign, double friction)
{
    const std::vector<std::vector<double>> base = {campaign.runs.front().base_displacement_m.values};
    return law_samples(campaign, campaign_scales(campaign), base, friction).front();
}

Campaign campaign_of(const Specimen& specimen, int samples, const std::function<Pose(int, int)>& pose)
{
    Campaign campaign;
    campaign.specimen = specimen;
    campaign.runs = {formula_run(specimen, samples, pose, 0, 0, 1)};
    return campaign;
}

/// x(t) = v t - sign mu g t^2 / 2, until it stops.
double slid(double velocity, double mu, int sample)
{
    const double g = formula_gravity, t = std::min(sample / formula_rate_hz, std::fabs(velocity) / (mu * g));
    return velocity * t - (velocity > 0 ? 1 : -1) * mu * g * t * t / 2;
}

TEST(LawSamples, ABlockThatSlidesOnTheTable)
{
    const Specimen s = one_block();
    const double mu = 0.4;
    for (const double velocity : {1.2, -1.2}) {
        const Campaign campaign = campaign_of(s, 500, [&](int b, int i) {
            Pose pose = at_rest(s, b);
            pose.x += slid(velocity, mu, i);
            return pose;
        });
        for (const double assumed : {0.4, 0.3, 0.55}) {
            const std::vector<LawSample> samples = samples_of(campaign, assumed);
            ASSERT_GT(samples.size(), 5u);
            for (const LawSample& sample : samples) {
                EXPECT_NEAR(sample.value, mu - assumed, 1e-9) << sample.time_s;
                ASSERT_EQ(sample.terms.size(), 1u);
                const LawTerm& term = sample.terms.front();
                EXPECT_EQ(term.law, Law::sliding);
                EXPECT_EQ(term.joint, 0);
                EXPECT_EQ(term.sign, velocity > 0 ? 1 : -1);
                EXPECT_NEAR(term.normal, 1, 1e-9);
                EXPECT_NEAR(term.rest_weight_n, 0.9 * 9.81, 1e-12);
                EXPECT_NEAR(term.slip_m_s, velocity - term.sign * mu * 9.81 * sample.time_s, 1e-9);
                EXPECT_LT(sample.time_s, 1.2 / (mu * 9.81)); // none where it has stopped
            }
        }
    }
}

TEST(LawSamples, NoiseOfTheSamplesIsThatOfTheCameras)
{
    // 60 noisy runs: the spread of the values over their stated sd
    const Specimen s = one_block();
    double squares = 0;
    std::size_t count = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        Campaign campaign;
        campaign.specimen = s;
        campaign.runs = {formula_run(
            s, 300,
            [&](int b, int i) {
                Pose pose = at_rest(s, b);
                pose.x += slid(1.2, 0.4, i);
                return pose;
            },
            3e-5, 3e-4, seed)};
        for (const LawSample& sample : samples_of(campaign, 0.4)) {
            squares += std::pow(sample.value / sample.sd, 2);
            ++count;
        }
    }
    ASSERT_GT(count, 200u);
    // windows that follow each other share some samples: three standard errors of half as many
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), 1, 3 / std::sqrt(static_cast<double>(count)));
}

TEST(LawSamples, OneOfTwoJointsSlides)
{
    const Specimen s = block_on_slab();
    const double mu = 0.35;
    const Campaign campaign = campaign_of(s, 500, [&](int b, int i) {
        Pose pose = at_rest(s, b);
        pose.x += b == 1 ? slid(1.5, mu, i) : 0;
        return pose;
    });
    const std::vector<LawSample> samples = samples_of(campaign, 0.5);
    ASSERT_GT(samples.size(), 5u);
    for (const LawSample& sample : samples) {
        ASSERT_EQ(sample.terms.size(), 1u);
        EXPECT_EQ(sample.terms.front().joint, 1);
        EXPECT_NEAR(sample.value, mu - 0.5, 1e-9);
        EXPECT_NEAR(sample.terms.front().rest_weight_n, 0.9 * 9.81, 1e-12);
    }
}

TEST(LawSamples, BothJointsCarryWhatStandsOnThem)
{
    const Specimen s = block_on_slab();
    const Campaign campaign = campaign_of(s, 500, [&](int b, int i) {
        Pose pose = at_rest(s, b);
        pose.x += slid(1.5, 0.35, i);
        return pose;
    });
    for (const LawSample& sample : samples_of(campaign, 0.5)) {
        EXPECT_EQ(sample.terms.front().joint, 0);
        EXPECT_NEAR(sample.value, 0.35 - 0.5, 1e-9);
        EXPECT_NEAR(sample.terms.front().rest_weight_n, 20.9 * 9.81, 1e-9);
    }
}

TEST(LawSamples, ABlockThatRocks)
{
    const Specimen s = one_block();
    const double b = 0.03, h = 0.05;
    for (const double inside : {0.0, 0.002})
        for (const int sign : {1, -1}) {
            const std::vector<double> theta = rocking(b - inside, h, (b * b + h * h) / 3, 0.3, 0.1);
            const Campaign campaign = campaign_of(s, static_cast<int>(theta.size()), [&](int, int i) {
                return rocked_pose(b, h, sign * theta[static_cast<std::size_t>(i)], inside);
            });
            int seen = 0;
            for (const LawSample& sample : samples_of(campaign, 0.5)) {
                for (const LawTerm& term : sample.terms) {
                    if (term.law != Law::rocking)
                        continue;
                    ++seen;
                    EXPECT_EQ(sample.terms.size(), 1u);
                    EXPECT_EQ(term.sign, sign);
                    EXPECT_NEAR(term.half_width_m, b, 1e-12);
                    // windows of 40 ms take 1e-3 of a block that falls. A sharp corner carries no moment; one that is
                    // lost for some length carries that far inside (with the horizontal force below it, d sin theta
                    // F_x: a tenth of that)
                    EXPECT_NEAR(sample.value, term.normal * inside / b, 1e-3 + 0.15 * inside / b) << sample.time_s;
                }
            }
            EXPECT_GT(seen, 5);
        }
}

TEST(LawSamples, BlocksThatHopGiveNone)
{
    const Specimen s = one_block();
    for (const double jump_m : {0.0, 0.006}) {
        const Campaign campaign = campaign_of(s, 300, [&](int b, int i) {
            Pose pose = at_rest(s, b);
            const double omega = 63; // 0.006 m: 2.4 g
            pose.x += slid(1.2, 0.4, i);
            pose.y += jump_m * (1 - std::cos(omega * i / formula_rate_hz));
            return pose;
        });
        const std::size_t count = samples_of(campaign, 0.4).size();
        if (jump_m == 0)
            EXPECT_GT(count, 5u);
        else
            EXPECT_EQ(count, 0u);
    }
}

TEST(LawSamples, BlocksAtRestGiveNone)
{
    const Specimen s = block_on_slab();
    EXPECT_TRUE(samples_of(campaign_of(s, 500, [&](int b, int) { return at_rest(s, b); }), 0.5).empty());
}

Specimen two_columns_and_an_epistyle()
{
    Specimen s = one_block();
    s.half_width_m = {0.03, 0.03, 0.09};
    s.half_height_m = {0.05, 0.05, 0.03};
    s.depth_m = {0.06, 0.06, 0.06};
    s.mass_kg = {0.9, 0.9, 1.6};
    s.rest_x_m = {-0.06, 0.06, 0};
    s.rest_y_m = {0.05, 0.05, 0.13};
    s.joints = {{-1, 0}, {-1, 1}, {0, 2}, {1, 2}};
    return s;
}

TEST(LawSamples, OfTwoColumnsUnderAnEpistyleOnlyTheSumIsKnown)
{
    const Specimen s = two_columns_and_an_epistyle();
    const std::vector<double> weights = rest_weights(s);
    ASSERT_EQ(weights.size(), 4u);
    EXPECT_NEAR(weights[0], 1.7 * 9.81, 1e-12); // half of the epistyle on each
    EXPECT_NEAR(weights[3], 0.8 * 9.81, 1e-12);
    const double mu = 0.4, assumed = 0.5;
    const Campaign campaign = campaign_of(s, 400, [&](int b, int i) {
        Pose pose = at_rest(s, b);
        pose.x += slid(1.4, mu, i);
        return pose;
    });
    const std::vector<LawSample> samples = samples_of(campaign, assumed);
    ASSERT_GT(samples.size(), 5u);
    for (const LawSample& sample : samples) {
        ASSERT_EQ(sample.terms.size(), 2u);
        EXPECT_EQ(sample.terms[0].joint, 0);
        EXPECT_EQ(sample.terms[1].joint, 1);
        EXPECT_NEAR(sample.terms[0].weight, sample.terms[1].weight, 1e-9);
        // both weights w: w (mu - assumed) (N_0 + N_1) / W, and N_0 + N_1 = 2 W
        EXPECT_NEAR(sample.value, sample.terms[0].weight * 2 * (mu - assumed), 1e-9);
        EXPECT_NEAR(sample.terms[0].normal + sample.terms[1].normal, 2, 1e-9);
    }
}

TEST(LawSamples, AJointThatBeginsAloneDoesNotHideWhatFollows)
{
    // One column slides first, under an epistyle that stays: both its joints carry unknown forces.
    const Specimen s = two_columns_and_an_epistyle();
    const double mu = 0.4, assumed = 0.5;
    for (int later = 1; later < 60; later += 4) {
        const Campaign campaign = campaign_of(s, 400, [&](int b, int i) {
            Pose pose = at_rest(s, b);
            pose.x += b == 0 ? slid(1.4, mu, i) : slid(1.4, mu, std::max(i, later)) - slid(1.4, mu, later);
            return pose;
        });
        int both = 0;
        for (const LawSample& sample : samples_of(campaign, assumed)) {
            if (sample.terms.size() != 2 || sample.terms[0].joint != 0 || sample.terms[1].joint != 1 ||
                sample.time_s < 0.15) // the smoothing has left the jolts behind
                continue;
            ++both;
            EXPECT_NEAR(sample.value, sample.terms[0].weight * 2 * (mu - assumed), 1e-9) << later;
        }
        EXPECT_GE(both, 3) << later;
    }
}

} // namespace
} // namespace stylobate
