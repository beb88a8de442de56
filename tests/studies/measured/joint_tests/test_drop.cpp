/// `drop` by a body that bounces with a constant restitution: parabolas.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

namespace stylobate::joint_sample {
namespace {

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

/// Energy over that of the fall at a time after the first impact: e^2 in the first bounce, e^4 in the second one.
double energy_at(double restitution, double since)
{
    double energy = restitution * restitution, flight = 2 * std::sqrt(2 * drop_height_m / gravity) * restitution;
    for (; since > flight && energy > 1e-6; energy *= restitution * restitution, flight *= restitution)
        since -= flight;
    return energy;
}

double mean_energy(double restitution, double from, double to)
{
    double sum = 0;
    constexpr int parts = 2000;
    for (int i = 0; i < parts; ++i)
        sum += energy_at(restitution, from + (to - from) * (i + 0.5) / parts) / parts;
    return sum;
}

TEST(Drop, GivesTheEnergyThatIsLeft)
{
    const double flight = std::sqrt(2 * drop_height_m / gravity);
    for (const double restitution : {0.5, 0.7, 0.9, 0.97}) {
        const auto all = estimates(column(), dropped(restitution, 0, 110));
        const double early = mean_energy(restitution, 0.005, 2 * flight), late = mean_energy(restitution, 0.15, 0.25);
        const auto found_early = find(all, "drop.early"), found_late = find(all, "drop.late");
        ASSERT_TRUE(found_early && found_late) << restitution;
        // the speed is that of five samples, which an impact blurs
        EXPECT_NEAR(found_early->value, std::log(early + 0.003), 0.12) << restitution;
        if (late > 0.01) {
            EXPECT_NEAR(found_late->value, std::log(late + 0.003), 0.35) << restitution;
        } else {
            EXPECT_LT(found_late->value, std::log(0.013)) << restitution;
        }
    }
}

TEST(Drop, OneOddLandingChangesLittle)
{
    std::vector<MeasuredRun> runs = dropped(0.7, 0, 140);
    runs[3] = dropped(0.2, 0, 150)[3];
    const auto all = estimates(column(), runs), even = estimates(column(), dropped(0.7, 0, 140));
    EXPECT_NEAR(find(all, "drop.early")->value, find(even, "drop.early")->value, 0.05);
    EXPECT_GT(find(all, "drop.early")->sd, 3 * find(even, "drop.early")->sd) << "it knows less";
}

TEST(Drop, GivesTheMedianOfRepeats)
{
    // three repeats of each restitution: e^2 in a first flight that fills the window
    const auto all = estimates(column(), dropped(0.95, 0.02, 30)), even = estimates(column(), dropped(0.95, 0, 30));
    expect_estimate(all, "drop.early", find(even, "drop.early")->value, 0.05, 0.01);
    EXPECT_GT(find(all, "drop.early")->sd, 2 * find(even, "drop.early")->sd);
}

TEST(Drop, EstimatesNothingFromSpoiltRuns)
{
    std::vector<MeasuredRun> one = dropped(0.5, 0, 50);
    one.resize(1);
    EXPECT_TRUE(estimates(column(), one).empty()) << "one repeat has no scatter";
    std::vector<MeasuredRun> aside = dropped(0.5, 0, 60); // it fell beside its place, by another height
    std::vector<MeasuredRun> unseen = dropped(0.5, 0, 80);
    for (int r = 0; r < drop_repeats; ++r)
        for (std::size_t i = 0; i < aside.front().time_s.size(); ++i) {
            const auto k = static_cast<std::size_t>(r);
            const double t = aside.front().time_s[i];
            aside[k].blocks.y_m.values[3 * i + 1] -= t > test_start_s ? 0.004 : 0;
            if (t > 0.25 && t < 0.5)
                unseen[k].blocks.y_m.values[3 * i + 1] = none;
        }
    EXPECT_TRUE(estimates(column(), aside).empty());
    EXPECT_TRUE(estimates(column(), unseen).empty());
}

TEST(DropStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return estimates(column(), dropped(0.55, 0, seed)); });
}

} // namespace
} // namespace stylobate::joint_sample
