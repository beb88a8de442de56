/// `drop` by a body that bounces with a constant restitution: parabolas.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

namespace stylobate::joint_sample {
namespace {

// 5.5 standard deviations of a mean of three samples; 10 ms are added to all times
const double seen_as_rest_m = 5.5 * camera_m / std::sqrt(3.0);
constexpr double added_s = 0.01;

/// Height above the place at a time after the release; from 3 mm.
double height_at(double restitution, double t)
{
    const double fall = std::sqrt(2 * drop_height_m / gravity);
    if (t < fall)
        return drop_height_m - gravity * t * t / 2;
    double speed = gravity * fall * restitution, since = t - fall;
    for (int bounce = 0; bounce < 200 && since > 2 * speed / gravity; ++bounce) {
        since -= 2 * speed / gravity;
        speed *= restitution;
    }
    return speed < 1e-6 ? 0 : std::max(0.0, speed * since - gravity * since * since / 2);
}

/// From the first impact until the height stays below what counts as rest, and 10 ms: the last bounce that is higher,
/// by hand.
double time_of(double restitution)
{
    double speed = std::sqrt(2 * gravity * drop_height_m) * restitution, passed = 0, last = 0;
    for (; speed * speed / (2 * gravity) > seen_as_rest_m; speed *= restitution) {
        last = passed + speed / gravity + std::sqrt(2 * (speed * speed / (2 * gravity) - seen_as_rest_m) / gravity);
        passed += 2 * speed / gravity;
    }
    return last + added_s;
}

/// @param spread of the logarithm of the restitution from repeat to repeat
std::vector<MeasuredRun> dropped(double restitution, double spread, unsigned seed)
{
    std::vector<MeasuredRun> runs = plan(RunKind::drop);
    double sign = 1;
    for (MeasuredRun& run : runs) {
        Path path;
        const double own = restitution * std::exp(sign * spread);
        sign = -sign;
        for (const double t : run.time_s) {
            path.x.push_back(0);
            path.y.push_back(t <= *run.released_s ? drop_height_m : height_at(own, t - *run.released_s));
        }
        see(run, path, seed++);
    }
    return runs;
}

TEST(Drop, GivesTheTimeUntilRest)
{
    for (const double restitution : {0.4, 0.5, 0.7, 0.8}) {
        const auto all = estimates(column(), dropped(restitution, 0, 10));
        expect_estimate(all, "drop.time", std::log(time_of(restitution)), 0.06, 0.05);
        const auto scatter = find(all, "drop.scatter");
        ASSERT_TRUE(scatter);
        EXPECT_LT(scatter->value, 0.15) << "nothing differs but the noise";
    }
    EXPECT_GT(time_of(0.7), 1.8 * time_of(0.4)) << "damping is what it is about";
}

TEST(Drop, GivesTheScatterOfRepeats)
{
    // three repeats of each restitution: the standard deviation of six values +-d is d sqrt(6 / 5)
    const double upper = time_of(0.7 * std::exp(0.1)), lower = time_of(0.7 * std::exp(-0.1));
    const auto all = estimates(column(), dropped(0.7, 0.1, 30));
    const double half = std::log(upper / lower) / 2;
    expect_estimate(all, "drop.scatter", half * std::sqrt(1.2), 0.2, 0.03);
    expect_estimate(all, "drop.time", std::log(upper * lower) / 2, half, 0.03);
}

TEST(Drop, EstimatesNothingFromSpoiltRuns)
{
    std::vector<MeasuredRun> one = dropped(0.5, 0, 50);
    one.resize(1);
    EXPECT_TRUE(estimates(column(), one).empty()) << "one repeat has no scatter";
    std::vector<MeasuredRun> aside = dropped(0.5, 0, 60); // it fell beside its place, by another height
    std::vector<MeasuredRun> swinging = dropped(0.5, 0, 70);
    std::vector<MeasuredRun> unseen = dropped(0.5, 0, 80);
    for (int r = 0; r < drop_repeats; ++r)
        for (std::size_t i = 0; i < aside.front().time_s.size(); ++i) {
            const auto k = static_cast<std::size_t>(r);
            const double t = aside.front().time_s[i];
            aside[k].blocks.y_m.values[3 * i + 1] -= t > test_start_s ? 0.004 : 0;
            swinging[k].blocks.theta_rad.values[3 * i + 1] += 0.05 * std::sin(40 * t);
            if (t > 0.25 && t < 0.5)
                unseen[k].blocks.y_m.values[3 * i + 1] = none;
        }
    EXPECT_TRUE(estimates(column(), aside).empty());
    EXPECT_TRUE(estimates(column(), swinging).empty()) << "it never came to rest";
    EXPECT_TRUE(estimates(column(), unseen).empty());
}

TEST(DropStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return estimates(column(), dropped(0.55, 0, seed)); });
}

} // namespace
} // namespace stylobate::joint_sample
