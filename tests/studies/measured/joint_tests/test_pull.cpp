/// `pull` by the quasi-static balance of a rod's spring, a joint's spring with Coulomb friction, and a dowel.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

#include <functional>
#include <limits>

namespace stylobate::joint_sample {
namespace {

struct PulledJoint {
    double mu = 0.6;
    double stiffness_n_m = 2e5;                                          // of the joint before it slips
    std::function<double(double)> of_speed = [](double) { return 1.0; }; // factors of the friction
    std::function<double(double)> of_place = [](double) { return 1.0; };
    double wear_per_m = 0, direction = 0, per_s = 0;
    double bond_n = 0;
    double dowel_n_m = 0, dowel_n = 0, gap_m = 0;
};

/// The force of the dowel on the block at an offset, and its plastic offset.
double dowel_at(const PulledJoint& joint, double offset, double& set, bool keep)
{
    const double beyond = offset - set, free = std::clamp(beyond, -joint.gap_m, joint.gap_m);
    const double trial = joint.dowel_n_m * (beyond - free), force = std::clamp(trial, -joint.dowel_n, joint.dowel_n);
    if (keep && joint.dowel_n_m > 0)
        set += (trial - force) / joint.dowel_n_m;
    return -force;
}

MeasuredRun pulled(const PulledJoint& joint, unsigned seed)
{
    MeasuredRun run = plan(RunKind::pull).front();
    const std::vector<double>& table = run.base_displacement_m.values;
    const double k = run.forces.front().stiffness_n_m;
    Path path;
    double set = 0, dowel_set = 0, slipped = 0, before = 0, last = 0;
    bool whole = joint.bond_n > 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double speed = i > 0 ? std::fabs(table[i] - table[i - 1]) * run.rate_hz : 0;
        const double going = i > 0 && table[i] > table[i - 1] ? -1 : 1; // of the block's slip
        const double mu = std::max(0.0, joint.mu * (1 - joint.wear_per_m * slipped)) * joint.of_speed(speed) *
                          joint.of_place(last) * (1 + joint.direction * going) * (1 + joint.per_s * run.time_s[i]);
        const double limit = mu * weight + (whole ? joint.bond_n : 0);
        const auto friction = [&](double x) { return -joint.stiffness_n_m * (x - table[i] - set); };
        double low = -1, high = 1; // of the block's place: all forces push it back
        for (int bisection = 0; bisection < 60; ++bisection) {
            const double x = (low + high) / 2;
            const double sum =
                -k * x + std::clamp(friction(x), -limit, limit) + dowel_at(joint, x - table[i], dowel_set, false);
            (sum > 0 ? low : high) = x;
        }
        last = low - table[i];
        dowel_at(joint, last, dowel_set, true);
        const double excess = friction(low) - std::clamp(friction(low), -limit, limit);
        set += -excess / joint.stiffness_n_m;
        whole = whole && std::fabs(excess) < 1e-9;
        slipped += std::fabs(set - before);
        before = set;
        path.x.push_back(low);
        run.forces.front().value_n.values.push_back(-k * low);
    }
    see(run, path, seed);
    disturb(run.forces.front().value_n, gauge_n, seed);
    return run;
}

std::vector<Estimate> pull_estimates(const MeasuredRun& run)
{
    return estimates(column(), std::vector{run});
}

/// What a healthy joint gives, but for what a cause changes.
void expect_healthy_but(const std::vector<Estimate>& all, const std::vector<std::string>& changed)
{
    const std::vector<std::tuple<std::string, double, double, double>> healthy = {
        {"pull.friction", std::log(0.6), 0.004, 1e-4},
        {"pull.speed", 0, 0.003, 1e-4},
        {"pull.wear", 0, 0.04, 2e-3},
        {"pull.direction", 0, 0.004, 1e-4},
        {"pull.time", 0, 1e-3, 1e-5},
        {"pull.place", 0, 0.004, 0},
        {"pull.width", 0.6 * weight / 2e5, 4e-6, 2e-6},
        {"pull.compliance", 5e-6, 5e-6, 1e-6},
        {"pull.first", 0.04, 0.06, 0.02}}; // the largest of many samples
    for (const auto& [name, value, sd, tolerance] : healthy)
        if (std::ranges::count(changed, name) == 0)
            expect_estimate(all, name, value, sd, tolerance);
}

TEST(Pull, GivesTheFrictionAndTheStiffnessOfAJoint)
{
    for (const unsigned seed : {1U, 2U, 3U})
        expect_healthy_but(pull_estimates(pulled({}, seed)), {});
    PulledJoint slippery;
    slippery.mu = 0.3;
    const auto all = pull_estimates(pulled(slippery, 4));
    expect_estimate(all, "pull.friction", std::log(0.3), 0.008, 1e-4);
    expect_estimate(all, "pull.width", 0.3 * weight / 2e5, 6e-6, 2e-6);
}

TEST(Pull, NeedsNoZeroOfTheTablesSensorAndBearsItsNoise)
{
    MeasuredRun run = pulled({}, 20);
    for (double& x : run.base_displacement_m.values)
        x -= 0.005;
    disturb(run.base_displacement_m, 20e-6, 20);
    run.base_source = BaseSource::table_sensor;
    // smoothed turns: the loop is wider by some micrometres
    const auto all = pull_estimates(run);
    expect_healthy_but(all, {"pull.width", "pull.compliance"});
    EXPECT_NEAR(find(all, "pull.width")->value, 0, 2e-5);
}

TEST(Pull, TellsFrictionThatFallsWithSpeed)
{
    PulledJoint joint;
    joint.of_speed = [](double v) { return 1 - 0.2 * (1 - std::exp(-v / 0.02)); };
    const double slow = joint.of_speed(pull_slow_m_s), fast = joint.of_speed(pull_fast_m_s);
    const auto all = pull_estimates(pulled(joint, 5));
    expect_estimate(all, "pull.speed", (slow - fast) / ((slow + fast) / 2), 0.003, 5e-4);
    expect_estimate(all, "pull.friction", std::log(0.6 * (slow + fast) / 2), 0.004, 5e-4);
    expect_healthy_but(all, {"pull.speed", "pull.friction", "pull.width", "pull.compliance", "pull.first"});
}

TEST(Pull, TellsWearFromTimeAndSpeed)
{
    PulledJoint worn;
    worn.wear_per_m = 2;
    const auto all = pull_estimates(pulled(worn, 6));
    expect_estimate(all, "pull.wear", 2, 0.03, 0.01);
    expect_healthy_but(all, {"pull.wear", "pull.width", "pull.compliance"});
    PulledJoint drifting;
    drifting.per_s = -0.01;
    const auto drift = pull_estimates(pulled(drifting, 7));
    expect_healthy_but(drift, {"pull.time", "pull.friction", "pull.width", "pull.compliance"});
    expect_estimate(drift, "pull.time", -0.01 / (1 - 0.01 * 7.4), 1e-3, 2e-4); // over the friction at the middle
}

TEST(Pull, SeesFrictionWearAwayAtOnce)
{
    PulledJoint worn;
    worn.wear_per_m = 40; // nothing is left after 25 mm
    const auto all = pull_estimates(pulled(worn, 8));
    expect_estimate(all, "pull.wear", 40, 1.5, 0.5);
    expect_estimate(all, "pull.friction", std::log(0.6), 0.02, 0.005);
    EXPECT_FALSE(find(all, "pull.speed")) << "nothing was left for the fast cycles";
    EXPECT_FALSE(find(all, "pull.time"));
}

TEST(Pull, TellsDirectionAndPlace)
{
    PulledJoint one_way;
    one_way.direction = 0.06; // more to the right
    const auto directed = pull_estimates(pulled(one_way, 9));
    expect_estimate(directed, "pull.direction", -0.12, 0.004, 2e-4);
    expect_healthy_but(directed, {"pull.direction", "pull.width", "pull.compliance"});
    PulledJoint patchy;
    patchy.of_place = [](double x) { return 1 - 0.4 * std::exp(-std::pow((x - 0.001) / 0.0005, 2)); };
    const auto patched = pull_estimates(pulled(patchy, 10));
    const auto place = find(patched, "pull.place");
    ASSERT_TRUE(place);
    // the patch has the mean 0.4 sqrt(pi) 0.5 mm = 0.354 mm over some 16 mm, and 0.4^2 sqrt(pi / 2) 0.5 mm of squares
    const double mean = 0.4 * std::sqrt(M_PI) * 0.5 / 16, square = 0.16 * std::sqrt(M_PI / 2) * 0.5 / 16;
    EXPECT_NEAR(place->value, std::sqrt(square - mean * mean), 0.02);
    EXPECT_GT(place->value, 10 * place->sd);
    for (const char* name : {"pull.speed", "pull.wear", "pull.direction", "pull.time"})
        expect_estimate(patched, name, 0, name == std::string("pull.wear") ? 0.5 : 0.03, 2e-3);
}

TEST(Pull, TellsADowelByTheLoopAfterAReversal)
{
    PulledJoint dowelled;
    dowelled.gap_m = 0.0003;
    dowelled.dowel_n = 0.3;
    dowelled.dowel_n_m = 3000;
    const auto all = pull_estimates(pulled(dowelled, 11));
    const double full = 0.6 * weight + 0.3;
    expect_estimate(all, "pull.friction", std::log(full / weight), 0.004, 2e-3);
    // f comes back by areas: the dowel lets go over 0.3 N / 3000 N/m (half of 0.3 N is missing on the mean), then 2
    // gaps without it, then it takes up again; the friction turns at once
    const double let_go = 0.3 / 3000, missing = 0.3 / (2 * full);
    const double width = 2 * 0.0003 * missing + let_go * missing / 2 + let_go * (missing + 0.3 / (4 * full));
    const auto found = find(all, "pull.width");
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, width, 0.2 * width);
    EXPECT_GT(found->value, 15 * found->sd);
    expect_healthy_but(all, {"pull.friction", "pull.width", "pull.compliance", "pull.first"});
}

TEST(Pull, TellsABondByTheFirstPeakAlone)
{
    PulledJoint bonded;
    bonded.bond_n = 0.4;
    const auto all = pull_estimates(pulled(bonded, 12));
    expect_estimate(all, "pull.first", std::log((0.6 * weight + 0.4) / (0.6 * weight)), 0.06, 0.02);
    expect_healthy_but(all, {"pull.first"});
}

TEST(Pull, EstimatesNothingFromSpoiltRuns)
{
    MeasuredRun loose = pulled({}, 13); // the rod came off: the block rides on the table
    for (std::size_t i = 0; i < loose.time_s.size(); ++i) {
        loose.blocks.x_m.values[3 * i + 1] = 0.25 + loose.base_displacement_m.values[i];
        loose.forces.front().value_n.values[i] = 0;
    }
    EXPECT_TRUE(pull_estimates(loose).empty());
    MeasuredRun fallen = pulled({}, 14);
    fallen.collapsed = true;
    EXPECT_TRUE(pull_estimates(fallen).empty());
    MeasuredRun unseen = pulled({}, 15);
    std::ranges::fill(unseen.blocks.x_m.values, none);
    EXPECT_TRUE(pull_estimates(unseen).empty());
    MeasuredRun no_gauge = pulled({}, 16);
    no_gauge.forces.clear();
    EXPECT_TRUE(pull_estimates(no_gauge).empty());
    MeasuredRun gaps = pulled({}, 17); // one second in four is missing: what is left is right
    for (std::size_t i = 1600; i < gaps.time_s.size(); ++i)
        if (i / 500 % 4 == 0)
            gaps.forces.front().value_n.values[i] = none;
    const auto left = pull_estimates(gaps);
    expect_estimate(left, "pull.friction", std::log(0.6), 0.005, 1e-4);
    expect_estimate(left, "pull.speed", 0, 0.005, 1e-4);
}

// A root mean square that is nearly nothing does not scatter as one that is something.
TEST(PullStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return pull_estimates(pulled({}, seed)); }, {"pull.place", "pull.first"});
}

} // namespace
} // namespace stylobate::joint_sample
