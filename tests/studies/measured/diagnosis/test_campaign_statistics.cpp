/// Statistics of campaigns whose motions are known by formula: slides of known path, rigid rocking, noise.

#include "tests/ensemble/motion/formula_motions.hpp"

#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"
#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <algorithm>
#include <numbers>

namespace stylobate {
namespace {

constexpr double pi = std::numbers::pi;

Campaign campaign_of(const Specimen& specimen, std::vector<MeasuredRun> runs)
{
    Campaign campaign;
    campaign.specimen = specimen;
    campaign.runs = std::move(runs);
    return campaign;
}

CampaignStatistics statistics(const Campaign& campaign)
{
    std::vector<std::vector<double>> base;
    for (const MeasuredRun& run : campaign.runs)
        base.push_back(run.base_displacement_m.values);
    const CampaignStatistics all = statistics_of(campaign, campaign_scales(campaign), base);
    EXPECT_EQ(all.values.size(), statistic_labels(campaign).size());
    EXPECT_EQ(all.descriptors.size(), descriptor_labels(campaign).size());
    return all;
}

double value(const Campaign& campaign, const std::string& name, int side = 0, int joint = -1, int motion = -1)
{
    const CampaignStatistics all = statistics(campaign);
    const std::vector<StatisticLabel> labels = statistic_labels(campaign);
    for (std::size_t k = 0; k < labels.size(); ++k)
        if (labels[k].name == name && labels[k].side == side && (joint < 0 || labels[k].joint == joint) &&
            (motion < 0 || labels[k].motion == motion))
            return all.values[k];
    ADD_FAILURE() << name;
    return 0;
}

double descriptor(const Campaign& campaign, const std::string& name)
{
    const CampaignStatistics all = statistics(campaign);
    const std::vector<StatisticLabel> labels = descriptor_labels(campaign);
    for (std::size_t k = 0; k < labels.size(); ++k)
        if (labels[k].name == name)
            return all.descriptors[k];
    ADD_FAILURE() << name;
    return 0;
}

/// One block that slides to and fro, by 3 mm to either side, once a second.
constexpr double swing_m = 0.003;
Campaign swinging(int seconds, double noise_m, double noise_rad, unsigned seed)
{
    const Specimen s = one_block();
    const auto pose = [&](int b, int i) {
        Pose at = at_rest(s, b);
        at.x += swing_m * std::sin(2 * pi * i / formula_rate_hz);
        return at;
    };
    return campaign_of(s, {formula_run(s, seconds * 1000, pose, noise_m, noise_rad, seed)});
}

/// Slip path from its logarithm, without the floor that keeps it finite.
double path_of(const Campaign& campaign)
{
    const Specimen& s = campaign.specimen;
    const CampaignScales scales = campaign_scales(campaign);
    const MeasuredRun& run = campaign.runs.front();
    const CoarseRun coarse = coarse_run(s, run, scales, run.base_displacement_m.values);
    const JointFaces faces = joint_faces(s, 0);
    const RigidRocking rigid = rigid_rocking(s, 0, {0});
    return joint_sums(faces, joint_series(faces, coarse), coarse, rigid, scales.rotation_rad, scales.time_s)
        .slip_path_m;
}

TEST(CampaignStatistics, NoiseAloneHasNoSize)
{
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    const double sd = 0.7;
    const auto mean = [&](double increment) {
        double sum = 0;
        for (int i = 0; i < 200000; ++i)
            sum += noiseless_size(increment + sd * normal(random), sd);
        return sum / 200000;
    };
    EXPECT_NEAR(mean(0), 0, 5 * 1.25 * sd / std::sqrt(200000.0));
    EXPECT_NEAR(mean(4 * sd), 4 * sd, 0.01 * sd);
    EXPECT_NEAR(mean(-4 * sd), 4 * sd, 0.01 * sd);
    for (const double z : {0.5, 1.0, 1.5, 2.0, 2.5}) {
        EXPECT_LT(mean(z * sd), z * sd);
        EXPECT_GT(mean(z * sd), (z - 0.41) * sd);
    }
    EXPECT_EQ(noiseless_size(-0.3, 0), 0.3);
}

TEST(CampaignStatistics, ASlideOfKnownPath)
{
    const Campaign campaign = swinging(8, 0, 0, 1);
    const double b = 0.03, path = 8 * 4 * swing_m, floor = 1e-3 * b;
    EXPECT_NEAR(value(campaign, "slip_path"), std::log((path + floor) / b), 5e-3);
    EXPECT_NEAR(value(campaign, "half_ratio"), 0, 5e-3);
    EXPECT_NEAR(value(campaign, "net_slip"), 0, 0.01); // a bin is not an instant
    EXPECT_NEAR(value(campaign, "range_over_path"), 2 * swing_m / (path + floor), 5e-4);
    EXPECT_EQ(value(campaign, "open_time", -1), 0);
    EXPECT_TRUE(std::isnan(value(campaign, "closure_speed")));
    EXPECT_TRUE(std::isnan(value(campaign, "turning_offset", 1)));
    EXPECT_TRUE(std::isnan(value(campaign, "order_slope")));
    EXPECT_NEAR(descriptor(campaign, "common_slip_path"), std::log((path + floor) / b), 5e-3);

    // 12 mm to the right in the second half alone
    const Specimen s = one_block();
    const auto late = [&](int b_, int i) {
        Pose at = at_rest(s, b_);
        at.x += 0.012 * std::clamp((i - 3000) / 500.0, 0.0, 1.0);
        return at;
    };
    const Campaign shifted = campaign_of(s, {formula_run(s, 4000, late, 0, 0, 1)});
    EXPECT_NEAR(value(shifted, "net_slip"), 0.4, 1e-9);
    EXPECT_NEAR(value(shifted, "range_over_path"), 0.012 / (0.012 + floor), 1e-9);
    EXPECT_NEAR(value(shifted, "half_ratio"), std::log((0.012 + floor) / floor), 1e-9);
}

TEST(CampaignStatistics, PathsAreThoseWithoutNoise)
{
    const double exact = path_of(swinging(5, 0, 0, 1));
    EXPECT_NEAR(exact, 5 * 4 * swing_m, 3e-4);
    const auto mean_path = [](auto&& campaign) {
        double sum = 0;
        for (unsigned seed = 1; seed <= 24; ++seed)
            sum += path_of(campaign(seed)) / 24;
        return sum;
    };
    const double noisy = mean_path([](unsigned seed) { return swinging(5, camera_m, camera_rad, seed); });
    EXPECT_NEAR(noisy, exact, 0.02 * exact); // 9 mm more without the correction: 15 %
    const Specimen s = one_block();
    const double still = mean_path([&](unsigned seed) {
        const auto pose = [&](int b, int) { return at_rest(s, b); };
        return campaign_of(s, {formula_run(s, 5000, pose, camera_m, camera_rad, seed)});
    });
    EXPECT_NEAR(still, 0, 2.5e-4);
}

TEST(CampaignStatistics, FrictionIsItsWorkOverThePathOfTheNormalForce)
{
    const Specimen s = one_block();
    const double mu = 0.4, v = 1.2;
    for (const double sign : {1.0, -1.0}) {
        const auto pose = [&](int b, int i) {
            const double t = std::min(i / formula_rate_hz, v / (mu * formula_gravity));
            Pose at = at_rest(s, b);
            at.x += sign * (v * t - mu * formula_gravity * t * t / 2);
            return at;
        };
        const Campaign campaign = campaign_of(s, {formula_run(s, 500, pose, 0, 0, 1)});
        EXPECT_NEAR(value(campaign, "friction_fast"), mu, 1e-3);
        EXPECT_NEAR(value(campaign, "friction"), mu, 0.01);
        EXPECT_NEAR(descriptor(campaign, "common_friction"), mu, 0.01);
    }
}

/// A slender block.
Specimen slender()
{
    Specimen s = one_block();
    s.half_width_m = {0.02};
    s.half_height_m = {0.1};
    s.rest_y_m = {0.1};
    return s;
}

Specimen slender_on_slab()
{
    Specimen s = block_on_slab();
    s.half_width_m = {0.04, 0.02};
    s.half_height_m[1] = 0.1;
    s.rest_y_m[1] = 0.2;
    return s;
}

struct Rocking {
    double restitution = 0.8;
    double most_rad = 0.1;
    double inside_m = 0; ///< where it turns
    double eccentricity_m = 0;
    double drag = 0; ///< over the mass [1/m]
    double noise_m = 0, noise_rad = 0;
    double floor_rad = 0.02; ///< of the last excursion
    bool on_slab = false;    ///< it stands on a slab that keeps still, and not on the table
};

/// A block that rocks from corner to corner: its equation of motion about the corner, integrated in small steps, with
/// what a closure leaves of the speed. @param speeds after the closures
Campaign rocking_block(const Rocking& how, std::vector<double>* tops = nullptr)
{
    const Specimen s = how.on_slab ? slender_on_slab() : slender();
    const double b = s.half_width_m.back(), h = s.half_height_m.back(), g = formula_gravity;
    std::vector<double> angle;
    double theta = 1e-9, rate = 0, most = 0, top = 0;
    { // speed that just reaches the wanted angle: energy about the corner
        const double inertia = (b * b + h * h) / 3 + b * b + h * h;
        const auto lifted = [&](double t) { return b * std::sin(t) + h * std::cos(t) - h; };
        rate = std::sqrt(2 * g * lifted(how.most_rad) / inertia);
    }
    const double dt = 1e-5;
    for (int step = 0;; ++step) {
        if (step % 100 == 0)
            angle.push_back(theta);
        const double left = theta > 0 ? 1 : -1, t = std::fabs(theta), w = left * rate;
        // the centre of mass lies to the right of the middle: farther from the left corner
        const double arm = b - how.inside_m + left * how.eccentricity_m;
        const double inertia = (b * b + h * h) / 3 + arm * arm + h * h;
        const double reach = b - how.inside_m;
        const double speed = w * std::hypot(reach, h);
        const double moment =
            -g * (arm * std::cos(t) - h * std::sin(t)) - how.drag * std::fabs(speed) * speed * std::hypot(reach, h);
        rate += left * dt * moment / inertia;
        const double before = theta;
        theta += dt * rate;
        most = std::max(most, std::fabs(theta));
        if (theta * before < 0) {
            rate *= how.restitution;
            if (tops)
                tops->push_back(most);
            top = most;
            most = 0;
            if (top < how.floor_rad)
                break;
        }
    }
    const std::size_t rest = 200;
    const auto pose = [&](int block, int i) {
        const auto k = static_cast<std::size_t>(i);
        Pose at = at_rest(s, block);
        if (k < rest || k - rest >= angle.size() || block + 1 < s.blocks())
            return at;
        const Pose moved = rocked_pose(b, h, angle[k - rest], how.inside_m);
        return Pose{moved.x, at.y + moved.y - h, moved.theta};
    };
    return campaign_of(
        s, {formula_run(s, static_cast<int>(angle.size() + 2 * rest), pose, how.noise_m, how.noise_rad, 7)});
}

TEST(CampaignStatistics, ARigidBlockThatRocks)
{
    const double b = 0.02, h = 0.1;
    for (const double restitution : {0.9, 0.8}) {
        std::vector<double> tops;
        const Campaign campaign = rocking_block({.restitution = restitution}, &tops);
        ASSERT_GT(tops.size(), 3u);
        // squares of speeds by the energy of the angles reached; after the last closure it stands still
        double before = 0, after = 0;
        for (std::size_t k = 0; k < tops.size(); ++k) {
            const double square = b * std::sin(tops[k]) + h * std::cos(tops[k]) - h;
            before += square;
            after += k + 1 < tops.size() ? restitution * restitution * square : 0;
        }
        EXPECT_NEAR(value(campaign, "closure_speed"), std::log(after / before) / 2, 0.03);
        EXPECT_NEAR(descriptor(campaign, "decay_fast"), std::log(restitution), 0.04);
        EXPECT_NEAR(descriptor(campaign, "period_high"), 0, 0.05);
        double path = 0;
        for (const double top : tops)
            path += 2 * top;
        const double alpha = std::atan2(0.02, 0.1);
        EXPECT_NEAR(value(campaign, "rotation_path"), std::log(path / alpha + 1e-3), 0.05);
        EXPECT_NEAR(value(campaign, "turning_offset", -1), 0, 1e-3);
        EXPECT_NEAR(value(campaign, "turning_offset", 1), 0, 1e-3);
        EXPECT_LT(descriptor(campaign, "hop_share"), std::log(2e-3));
        EXPECT_LT(std::exp(value(campaign, "slip_path")), 0.1); // it turns, and does not slip
    }
}

TEST(CampaignStatistics, WhereTheCornersLie)
{
    const Campaign campaign = rocking_block({.inside_m = 0.001});
    EXPECT_NEAR(value(campaign, "turning_offset", -1), 0.05, 2e-3);
    EXPECT_NEAR(value(campaign, "turning_offset", 1), 0.05, 2e-3);
    const Campaign noisy = rocking_block({.inside_m = 0.001, .noise_m = 3e-5, .noise_rad = 1e-3});
    EXPECT_NEAR(value(noisy, "turning_offset", -1), 0.05, 5e-3);
    EXPECT_NEAR(value(noisy, "turning_offset", 1), 0.05, 5e-3);
}

TEST(CampaignStatistics, ScoresOfDragAndEccentricity)
{
    const auto score = [](const char* name, Rocking how) {
        how.noise_m = 1e-5;
        how.noise_rad = 1e-4;
        return value(rocking_block(how), name);
    };
    EXPECT_LT(std::fabs(score("eccentricity_score", {.restitution = 0.97})), 4);
    EXPECT_LT(std::fabs(score("drag_score", {.restitution = 0.97})), 4);
    EXPECT_GT(score("eccentricity_score", {.restitution = 0.97, .eccentricity_m = 0.002}), 8);
    EXPECT_LT(score("eccentricity_score", {.restitution = 0.97, .eccentricity_m = -0.002}), -8);
    EXPECT_GT(score("drag_score", {.restitution = 0.97, .drag = 30}), 8);
    // each shows in its own score
    EXPECT_LT(std::fabs(score("drag_score", {.restitution = 0.97, .eccentricity_m = 0.002})), 5);
    EXPECT_LT(std::fabs(score("eccentricity_score", {.restitution = 0.97, .drag = 30})), 5);
}

TEST(CampaignStatistics, ScoresAreOfTheJointThatRocks)
{
    const Campaign campaign = rocking_block(
        {.restitution = 0.97, .eccentricity_m = 0.002, .noise_m = 1e-5, .noise_rad = 1e-4, .on_slab = true});
    EXPECT_TRUE(std::isnan(value(campaign, "eccentricity_score", 0, 0)));
    EXPECT_GT(value(campaign, "eccentricity_score", 0, 1), 8);
    EXPECT_LT(std::fabs(value(campaign, "drag_score", 0, 1)), 5);
    EXPECT_NEAR(value(campaign, "turning_offset", 1, 1), 0, 0.01);
}

/// A stack of equal blocks, run by run with other motions.
Campaign stack(int blocks, int motions, int repeats)
{
    Specimen s = one_block();
    s.half_width_m.assign(static_cast<std::size_t>(blocks), 0.03);
    s.half_height_m.assign(static_cast<std::size_t>(blocks), 0.05);
    s.depth_m.assign(static_cast<std::size_t>(blocks), 0.06);
    s.mass_kg.assign(static_cast<std::size_t>(blocks), 0.9);
    s.rest_x_m.assign(static_cast<std::size_t>(blocks), 0);
    s.rest_y_m.clear();
    s.joints.clear();
    for (int b = 0; b < blocks; ++b) {
        s.rest_y_m.push_back(0.05 + 0.1 * b);
        s.joints.emplace_back(b - 1, b);
    }
    std::vector<MeasuredRun> runs;
    for (int r = 0; r < motions * repeats; ++r) {
        // joint 0 slides twice as far in each run as in the one before, whatever the motion
        const auto pose = [&](int b, int i) {
            Pose at = at_rest(s, b);
            at.x += 0.001 * std::pow(2, r) * (1 + r % motions) * std::clamp((i - 300) / 300.0, 0.0, 1.0);
            return at;
        };
        MeasuredRun run = formula_run(s, 1000, pose, 0, 0, 1);
        run.motion_id = 10 + r % motions;
        run.run_order = r;
        runs.push_back(std::move(run));
    }
    return campaign_of(s, std::move(runs));
}

TEST(CampaignStatistics, AtMostTwoHundred)
{
    for (const int blocks : {1, 2, 5, 8})
        for (const int motions : {1, 2, 6, 12}) {
            const Campaign campaign = stack(blocks, motions, 1);
            EXPECT_LE(statistic_labels(campaign).size(), most_statistics) << blocks << ' ' << motions;
            EXPECT_GE(statistic_labels(campaign).size(), static_cast<std::size_t>(18 * blocks));
        }
    // few motions keep apart
    const Campaign few = stack(2, 2, 1);
    const std::vector<StatisticLabel> labels = statistic_labels(few);
    EXPECT_EQ(std::count_if(labels.begin(), labels.end(),
                            [](const StatisticLabel& l) { return l.name == "friction_fast" && l.motion >= 10; }),
              4);
}

TEST(CampaignStatistics, MeansOverRepeatsAndSlopeWithTheirOrder)
{
    const Campaign campaign = stack(2, 2, 2);
    // motion 10: runs 0 and 2 with 1 and 4 mm; motion 11: runs 1 and 3 with 4 and 16 mm
    const double b = 0.03, floor = 1e-3 * b;
    EXPECT_NEAR(value(campaign, "slip_path", 0, 0, 10), std::log((0.0025 + floor) / b), 1e-9);
    EXPECT_NEAR(value(campaign, "slip_path", 0, 0, 11), std::log((0.010 + floor) / b), 1e-9);
    EXPECT_NEAR(value(campaign, "slip_path", 0, 1, 11), std::log(1e-3), 1e-9); // the upper block stays on the lower
    EXPECT_NEAR(value(campaign, "order_slope", 0, 0), std::log(2), 0.01);
    EXPECT_NEAR(value(campaign, "order_slope", 0, 1), 0, 1e-9);
    // repeats: two of each motion, ln 4 apart at joint 0 and alike at joint 1; four degrees of freedom
    const auto apart = [&](double one_m, double other_m) { return std::log((other_m + floor) / (one_m + floor)); };
    EXPECT_NEAR(descriptor(campaign, "repeat_spread"),
                std::sqrt((std::pow(apart(0.001, 0.004), 2) + std::pow(apart(0.004, 0.016), 2)) / 2 / 4), 1e-9);
}

TEST(CampaignStatistics, WhatIsNotSeenIsMissing)
{
    Campaign campaign = swinging(2, 0, 0, 1);
    MeasuredRun& run = campaign.runs.front();
    const CampaignScales scales = campaign_scales(campaign);
    const auto slip_path = [&](const std::vector<std::vector<double>>& base) {
        return statistics_of(campaign, scales, base).values.front();
    };
    EXPECT_TRUE(std::isfinite(slip_path({run.base_displacement_m.values})));
    EXPECT_TRUE(std::isnan(slip_path({{}}))); // the base is not known: nor is the slip on it
    for (double& x : run.blocks.y_m.values)
        x = std::nan("");
    EXPECT_TRUE(std::isnan(slip_path({run.base_displacement_m.values})));
}

TEST(Summaries, ByHand)
{
    const std::vector<StatisticLabel> labels = {
        {"slip_path", 0, -1, 7, 0}, {"slip_path", 0, -1, 9, 0}, {"slip_path", 1, -1, 7, 0},
        {"slip_path", 1, -1, 9, 0}, {"slip_path", 2, -1, 7, 0}, {"open_time", 0, -1, 7, -1},
    };
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> values = {1, 3, none, 5, 40, none};
    const Summary motions = over_motions(labels), joints = over_joints(labels);
    ASSERT_EQ(motions.labels.size(), 4U);
    EXPECT_EQ(motions.labels[1], (StatisticLabel{"slip_path", 1, -1, -1, 0}));
    const std::vector<double> by_joint = means(motions, values);
    EXPECT_EQ(by_joint[0], 2);
    EXPECT_EQ(by_joint[1], 5) << "what is missing does not count";
    EXPECT_TRUE(std::isnan(by_joint[3]));
    ASSERT_EQ(joints.labels.size(), 3U) << "by motion and side";
    EXPECT_EQ(medians(joints, values)[0], 40) << "upper median of two";
    EXPECT_EQ(medians(joints, values)[1], 5);
}

} // namespace
} // namespace stylobate
