/// `drop` by a body whose lower corner bounces with a constant restitution while it turns: parabolas and geometry.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

namespace stylobate::joint_sample {
namespace {

const double fall_s = std::sqrt(2 * drop_height_m / gravity);

/// Height of the corner at a time after the release; from 3 mm.
double height_at(double restitution, double t)
{
    if (t < fall_s)
        return drop_height_m - gravity * t * t / 2;
    double speed = gravity * fall_s * restitution, since = t - fall_s;
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
    for (std::size_t r = 0; r < runs.size(); ++r) {
        MeasuredRun& run = runs[r];
        const double own = restitution * std::exp(r / 2 == 1 ? 0 : r / 2 == 0 ? spread : -spread);
        const double side = r % 2 == 0 ? -1 : 1; // of the lower corner
        Path path;
        for (const double time : run.time_s) {
            const double t = time - *run.released_s;
            const double z = t <= 0 ? drop_height_m : height_at(own, t);
            const double lean = std::max(0.0, drop_lean_rad - std::max(0.0, 1.5 * (t - fall_s)));
            path.theta.push_back(-side * lean);
            path.x.push_back(side * half_height * std::sin(drop_lean_rad) / 2);
            path.y.push_back(z + half_width * std::sin(lean) - half_height * (1 - std::cos(lean)));
        }
        see(run, path, seed++);
    }
    return runs;
}

/// Mean height of the corner over the time of the fall, from the impact on, over the height of the fall.
double mean_bounce(double restitution)
{
    double sum = 0;
    constexpr int parts = 20000;
    for (int i = 0; i < parts; ++i)
        sum += height_at(restitution, fall_s * (1 + (i + 0.5) / parts)) / (drop_height_m * parts);
    return sum;
}

double bounce_of(const std::vector<MeasuredRun>& runs)
{
    const auto found = find(estimates(column(), runs), "drop.bounce");
    EXPECT_TRUE(found);
    return found ? found->value : none;
}

TEST(Drop, GivesTheBounceOfTheCornerThatLandsFirst)
{
    EXPECT_NEAR(mean_bounce(0.5), 2 * std::pow(0.5, 3) * 2 / 3, 0.01) << "one flight fills the window";
    for (const double restitution : {0.1, 0.3, 0.5, 0.7, 0.95})
        expect_estimate(estimates(column(), dropped(restitution, 0, 110)), "drop.bounce",
                        std::log(mean_bounce(restitution) + 0.01), 0.2, 0.06);
}

TEST(Drop, EitherSideCountsHalf)
{
    std::vector<MeasuredRun> runs = dropped(0.7, 0, 120), other = dropped(0.3, 0, 130);
    for (std::size_t r = 1; r < runs.size(); r += 2)
        runs[r] = other[r];
    EXPECT_NEAR(bounce_of(runs), (std::log(mean_bounce(0.7) + 0.01) + std::log(mean_bounce(0.3) + 0.01)) / 2, 0.08);
}

TEST(Drop, OneOddLandingChangesLittle)
{
    std::vector<MeasuredRun> runs = dropped(0.7, 0, 140), odd = dropped(0.2, 0, 150);
    runs[3] = odd[3];
    EXPECT_NEAR(bounce_of(runs), bounce_of(dropped(0.7, 0, 140)), 0.05);
    EXPECT_GT(find(estimates(column(), runs), "drop.bounce")->sd,
              3 * find(estimates(column(), dropped(0.7, 0, 140)), "drop.bounce")->sd)
        << "it knows less";
}

TEST(Drop, GivesTheMedianOfRepeats)
{
    const auto all = estimates(column(), dropped(0.6, 0.1, 30));
    expect_estimate(all, "drop.bounce", bounce_of(dropped(0.6, 0, 30)), 0.4, 0.02);
    EXPECT_GT(find(all, "drop.bounce")->sd, 2 * find(estimates(column(), dropped(0.6, 0, 30)), "drop.bounce")->sd);
}

TEST(Drop, EstimatesNothingFromSpoiltRuns)
{
    std::vector<MeasuredRun> one = dropped(0.5, 0, 50);
    one.resize(3);
    EXPECT_TRUE(estimates(column(), one).empty()) << "one repeat to the right has no scatter";
    std::vector<MeasuredRun> aside = dropped(0.5, 0, 60); // it fell beside its place, by another height
    std::vector<MeasuredRun> unseen = dropped(0.5, 0, 80);
    for (int r = 0; r < drop_repeats; ++r)
        for (std::size_t i = 0; i < aside.front().time_s.size(); ++i) {
            const auto k = static_cast<std::size_t>(r);
            const double t = aside.front().time_s[i];
            aside[k].blocks.y_m.values[3 * i + 1] -= t > test_start_s ? 0.004 : 0;
            if (t > 0.2 && t < 0.26)
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
