/// `slide` by a block that slides under Coulomb's friction and drag, in steps of 10 us.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

namespace stylobate::joint_sample {
namespace {

struct ShakenBlock {
    double mu = 0.6, wear_per_m = 0, direction = 0;
    double quadratic_per_m = 0, linear_per_s = 0; ///< drag over mass
};

MeasuredRun shaken(const ShakenBlock& block, unsigned seed)
{
    MeasuredRun run = plan(RunKind::slide).front();
    const std::vector<double>& table = run.base_displacement_m.values;
    constexpr int steps = 200;
    const double dt = 1 / run.rate_hz / steps;
    Path path;
    double x = 0, v = 0, slipped = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        path.x.push_back(x);
        // the table's velocity between samples, by a parabola
        const double before = table[i > 0 ? i - 1 : 0], now = table[i], next = table[std::min(i + 1, table.size() - 1)];
        for (int k = 0; k < steps; ++k) {
            const double part = (k + 0.5) / steps;
            const double base = ((next - before) / 2 + part * (next - 2 * now + before)) * run.rate_hz;
            const double sign = v > base ? 1 : -1;
            const double mu = block.mu * std::max(0.0, 1 - block.wear_per_m * slipped) * (1 + block.direction * sign);
            const double drag = -block.quadratic_per_m * std::fabs(v) * v - block.linear_per_s * v;
            const double most = mu * gravity * dt, wanted = base - v - drag * dt; // to go with the table
            v += drag * dt + std::clamp(wanted, -most, most);
            x += v * dt;
            slipped += std::fabs(v - base) * dt;
        }
    }
    see(run, path, seed);
    return run;
}

std::vector<Estimate> slide_estimates(const ShakenBlock& block, unsigned seed)
{
    return estimates(column(), std::vector{shaken(block, seed)});
}

void expect_slide(const ShakenBlock& block, unsigned seed, bool drags = false)
{
    const auto all = slide_estimates(block, seed);
    if (block.linear_per_s == 0) {
        expect_estimate(all, "slide.friction", std::log(block.mu), 0.015, 0.01);
        expect_estimate(all, "slide.wear", block.wear_per_m, 0.02, 0.02);
        expect_estimate(all, "slide.direction", -2 * block.direction, 0.015, 0.005);
        expect_estimate(all, "slide.drag", block.quadratic_per_m, 1.5, 0.5);
    }
    if (!drags || block.linear_per_s != 0)
        expect_estimate(all, "slide.viscous", block.linear_per_s, 0.3, 0.1);
}

TEST(Slide, GivesTheFriction)
{
    for (const unsigned seed : {1U, 2U, 3U})
        expect_slide({}, seed);
    expect_slide({.mu = 0.4}, 4);
}

TEST(Slide, TellsDragFromWearAndDirection)
{
    expect_slide({.quadratic_per_m = 15}, 5, true);
    expect_slide({.linear_per_s = 3}, 6, true);
    expect_slide({.wear_per_m = 0.2}, 7);
    expect_slide({.direction = 0.05}, 8);
}

TEST(Slide, EstimatesNothingWhereNothingSlid)
{
    const auto stayed = slide_estimates({.mu = 1.3}, 9); // it goes with the table, whose largest acceleration it has
    expect_estimate(stayed, "slide.friction", std::log(10.7 / gravity), 0.01, 0.08);
    EXPECT_FALSE(find(stayed, "slide.drag"));
    MeasuredRun fallen = shaken({}, 10);
    fallen.collapsed = true;
    EXPECT_TRUE(estimates(column(), std::vector{fallen}).empty());
    fallen.collapse_time_s = 3.0; // what was before counts
    expect_estimate(estimates(column(), std::vector{fallen}), "slide.friction", std::log(0.6), 0.02, 0.01);
    MeasuredRun turning = shaken({}, 11);
    for (std::size_t i = 0; i < turning.time_s.size(); ++i)
        turning.blocks.theta_rad.values[3 * i + 1] += turning.time_s[i] > 0.4 ? 0.2 : 0;
    EXPECT_TRUE(estimates(column(), std::vector{turning}).empty());
}

TEST(SlideStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return slide_estimates({}, seed); });
}

} // namespace
} // namespace stylobate::joint_sample
