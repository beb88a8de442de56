/// The comparison with other engines: restitution over the phase of an impact, and collapse probabilities.

#include "bench/peers/collapse/convergence.hpp"
#include "bench/peers/column.hpp"
#include "bench/peers/restitution.hpp"
#include "bench/peers/rocking.hpp"
#include "bench/peers/table.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

using namespace stylobate;
using namespace stylobate::peers;

namespace {

constexpr double alpha = 0.269167493; // of the monolith

/// The monolith along a path of its rotation over time.
struct Rocker final : World {
    Rocker(double step_s, std::function<double(double)> path) : step_s_(step_s), path_(std::move(path)) {}
    void step(double) override { time_ += step_s_; }
    Pose pose(std::size_t body) const override { return {0, 0, body == 0 ? 0 : path_(time_)}; }
    double step_s_, time_ = 0;
    std::function<double(double)> path_;
};

/// Where a block turns round that was let go at `start` and whose impact leaves e of its rate.
double turning_point(double start, double e)
{
    return alpha - std::acos(std::cos(alpha) + e * e * (std::cos(alpha - start) - std::cos(alpha)));
}

/// Leaves e, and turns round at a time that is no multiple of a step.
BlockRun made_up_block(double start, double e, double step_s)
{
    const double peak = turning_point(start, e);
    const auto path = [start, peak](double t) {
        return t < 0.15 ? start * (1 - t / 0.15) : -peak * (1 - std::pow((t - 0.3123) / 0.1623, 2));
    };
    return {std::make_unique<Rocker>(step_s, path), step_s, 0};
}

} // namespace

TEST(Restitution, OracleHasItsDigits)
{
    EXPECT_NEAR(exact_restitution(), 0.893922652, 1e-9);
    EXPECT_NEAR(lean_of_quarter_period(0.146168) / alpha, 0.5, 0.003) << "the exact integral's";
    EXPECT_NEAR(lean_of_quarter_period(1e-3) / alpha, 0.5 * std::pow(9.029056 * 1e-3, 2), 1e-6);
}

TEST(Restitution, IsThatOfTheTurningPoint)
{
    for (const double e : {0.8, 0.9, 1.0})
        for (const double step_s : {0.01, 0.007, 0.001}) {
            BlockRun block = made_up_block(0.5 * alpha, e, step_s);
            EXPECT_NEAR(restitution(block, 0.5 * alpha), e, 1e-6) << step_s;
        }
    BlockRun never{std::make_unique<Rocker>(0.01, [](double) { return 0.1; }), 0.01, 0};
    EXPECT_TRUE(std::isnan(restitution(never, 0.1)));
}

TEST(Restitution, AClockThatIsAheadComesFromFurtherOut)
{
    const double start = 0.5 * alpha, step_s = 0.01, p2 = 9.029056 * 9.029056;
    const double out = start + p2 * std::sin(alpha - start) * std::pow(0.5 * step_s, 2) / 2;
    for (const double ahead : {0.5, -0.5}) {
        BlockRun block = made_up_block(start, 0.9, step_s);
        block.ahead_steps = ahead;
        EXPECT_NEAR(turning_point(out, restitution(block, start)), turning_point(start, 0.9), 1e-6);
    }
}

TEST(Restitution, ErrorsAreThoseOfAllPhases)
{
    Contender c;
    int calls = 0;
    std::vector<double> leans;
    c.block = [&](double step_s, double lean) {
        leans.push_back(lean);
        return made_up_block(lean, exact_restitution() * (++calls % 2 == 0 ? 1.02 : 0.99), step_s);
    };
    const Impacts all = impacts(c, 0.004);
    EXPECT_NEAR(all.mean, 0.005, 1e-6);
    EXPECT_NEAR(all.scatter(), 0.03, 1e-6);
    EXPECT_NEAR(all.worst(), 0.02, 1e-6);
    ASSERT_EQ(leans.size(), impact_phases + 1U);
    // the impact comes later by a step from the first to one past the last
    const double later = std::acosh(1 / (1 - leans.back() / alpha)) - std::acosh(1 / (1 - leans[1] / alpha));
    EXPECT_NEAR(later / 9.029056, 0.004 * (impact_phases - 1) / impact_phases, 1e-6);
}

TEST(Restitution, FirstWithinAtEveryPhaseAndAtTheNextTwo)
{
    const auto with = [](std::initializer_list<double> worst) {
        std::vector<Impacts> all;
        for (const double w : worst)
            all.push_back({0, -w, w / 2});
        return all;
    };
    EXPECT_EQ(first_within(with({0.02, 0.009, 0.012, 0.008, 0.004, 0.002}), 0.01), 3U);
    EXPECT_EQ(first_within(with({0.02, 0.009, 0.008}), 0.01), 1U);
    EXPECT_FALSE(first_within(with({0.02, 0.015, 0.008}), 0.01)) << "nothing confirms the last one";
}

/// Steps and tolerances as each engine needs them; Box2D's contacts begin within its slop, before the faces meet.
TEST(Restitution, OnTheMeanEveryEngineLosesWhatHousnerSays)
{
    for (const Engine& engine : engines()) {
        const Contender first = contenders(engine).at(engine.name == "MuJoCo" ? 1 : 0);
        const Impacts all = impacts(first, 1.0 / 1920);
        EXPECT_NEAR(all.mean, 0, engine.name == "Box2D" ? 0.012 : 0.002) << engine.name;
        EXPECT_LT(all.scatter(), 0.02) << engine.name;
    }
    const Impacts ours = impacts(own_contenders().back(), 1.0 / 240);
    EXPECT_LT(ours.worst(), 0.003);
}

TEST(Friction, FactorsOfNeighboursMultiplyToThatOfTheirBed)
{
    Scene scene;
    for (const double mu : {0.0, 0.6, 0.2, 0.9})
        scene.bodies.push_back({1, 1, 1, 1, {}, mu == 0, mu});
    const std::vector<double> f = friction_factors(scene);
    ASSERT_EQ(f.size(), 4U);
    EXPECT_DOUBLE_EQ(f[0] * f[1], 0.6);
    EXPECT_DOUBLE_EQ(f[1] * f[2], 0.2);
    EXPECT_DOUBLE_EQ(f[2] * f[3], 0.9);
    EXPECT_DOUBLE_EQ(f[0], f[1]);
}

/// Of two flat slabs on a ground that is accelerated, the one on the smoother bed is left behind, alone or with what
/// lies on it.
TEST(Friction, EachBedHasItsOwn)
{
    constexpr double b = 0.2, h = 0.02, acceleration = 4, time = 0.2, step = 1e-3;
    for (const Engine& engine : engines())
        for (const auto& [low, high] : {std::pair{0.6, 0.2}, {0.2, 0.6}}) {
            const Scene scene{{{10 * b, h, 1, 1, {0, -h, 0}, true},
                               {b, h, 0.4, 1, {0, h, 0}, false, low},
                               {b, h, 0.4, 1, {0, 3 * h, 0}, false, high}}};
            const auto world = engine.make(scene, engine.name == "MuJoCo" ? 2 : 0, step);
            for (int n = 0; n * step < time; ++n)
                world->step(acceleration);
            const double slip = -(acceleration - 0.2 * 9.81) * time * time / 2;
            EXPECT_NEAR(world->pose(1).x_m, low < high ? slip : 0, 0.02 * std::fabs(slip)) << engine.name << low;
            EXPECT_NEAR(world->pose(2).x_m, slip, 0.02 * std::fabs(slip)) << engine.name << low;
        }
}

TEST(Cells, ATiltedBaseTurnsGravity)
{
    Realization r;
    r.gravity_m_s2 = 9.81;
    r.base_tilt_rad = 0.01;
    r.blocks = {{0.1, 0.1, 1, 1, 0, -0.1, true}, {0.1, 0.2, 1, 1, 0, 0.2, false}};
    r.joints.resize(1);
    r.joints[0].upper = 1;
    r.joints[0].friction = 0.4;
    // what falls along the base to the right falls as on a ground that is accelerated to the left
    EXPECT_NEAR(leaning_acceleration(r), -9.81 * 0.01, 1e-5);
    const Scene scene = scene_of(Study{}, r);
    EXPECT_NEAR(scene.gravity_m_s2, 9.81 * (1 - 0.01 * 0.01 / 2), 1e-7);
    EXPECT_EQ(scene.bodies[1].friction, 0.4);
}

namespace {

/// The first draw of the monolith's cell in an engine that moves it along a path.
DrawEnd follow(std::function<Pose(Pose, double)> path)
{
    struct Puppet final : World {
        Puppet(Scene scene, double step_s, std::function<Pose(Pose, double)> path)
            : scene_(std::move(scene)), step_s_(step_s), path_(std::move(path))
        {
        }
        void step(double) override { time_ += step_s_; }
        Pose pose(std::size_t body) const override
        {
            const Pose start = scene_.bodies[body].start;
            return body == 1 ? path_(start, time_) : start;
        }
        Scene scene_;
        double step_s_, time_ = 0;
        std::function<Pose(Pose, double)> path_;
    };
    Engine engine;
    engine.make = [path](const Scene& scene, std::size_t, double step_s) -> std::unique_ptr<World> {
        return std::make_unique<Puppet>(scene, step_s, path);
    };
    Law law;
    law.step_s = 1.0 / 480;
    const Study study = cell_study(rocking_cells().front(), law, 8);
    return run_draw(engine, 0, law.step_s, study, Sampler(study, nullptr).realization(0));
}

} // namespace

TEST(Cells, DrawsCollapseByTheCriterionOfStudies)
{
    // the block's height above its base is 0.087 m, its slenderness 0.269
    const auto down = [](Pose at, double part) { return Pose{at.x_m, at.y_m - (1 - part) * 0.087, 0}; };
    const DrawEnd stood = follow([](Pose at, double) { return at; });
    EXPECT_FALSE(stood.collapsed);
    EXPECT_NEAR(stood.time_s, 11, 0.05) << "10 s of shaking and one after it";
    const DrawEnd dropped = follow([&](Pose at, double t) { return down(at, t < 4 ? 1 : 0.58); });
    EXPECT_TRUE(dropped.collapsed);
    EXPECT_NEAR(dropped.time_s, 4, 0.05);
    EXPECT_FALSE(follow([&](Pose at, double) { return down(at, 0.62); }).collapsed);
    // a lean beyond the slenderness from which it comes back, and one from which it does not
    EXPECT_FALSE(follow([](Pose at, double t) { return Pose{at.x_m, at.y_m, t > 4 && t < 4.05 ? 0.3 : 0}; }).collapsed);
    EXPECT_TRUE(follow([](Pose at, double t) { return Pose{at.x_m, at.y_m, t > 4 ? 0.3 : 0}; }).collapsed);
    EXPECT_TRUE(follow([](Pose at, double t) { return Pose{at.x_m, t > 1 ? std::nan("") : at.y_m, 0}; }).collapsed);
}

TEST(Differences, ArePaired)
{
    const Difference d = paired_difference({1, 1, 0, 0}, {1, 0, 0, 0});
    EXPECT_DOUBLE_EQ(d.value, 0.25);
    EXPECT_DOUBLE_EQ(d.error, std::sqrt((0.25 - 0.0625) / 4));
    EXPECT_EQ(paired_difference({1, 0, 1, 0, 0}, {1, 0, 1, 0}).value, 0) << "of those that both have";
    EXPECT_DOUBLE_EQ(paired_difference({1, 0, 1, 0}, {1, 0, 1, 0}).error, 0.25);
    EXPECT_DOUBLE_EQ(paired_difference({1, 1}, {0, 0}).error, std::sqrt(0.25 / 2)) << "all differ alike";
}

TEST(Differences, PooledWithoutThePartOfTheSampling)
{
    EXPECT_NEAR(pooled({{0.05, 0.03}, {-0.05, 0.03}}).value, 0.04, 1e-12);
    EXPECT_EQ(pooled({{0.02, 0.03}, {-0.01, 0.03}}).value, 0);
    // mean square 0.0016, its variance (4 0.0016 0.0009 + 2 0.0009^2) / 2
    EXPECT_NEAR(pooled({{0.05, 0.03}, {-0.05, 0.03}}).bound,
                std::sqrt(0.0016 + 2 * std::sqrt((4 * 0.0016 * 0.0009 + 2 * 0.0009 * 0.0009) / 2)), 1e-12);
}

namespace {

/// Runs of so many draws of which so many collapse at each level, in a time that doubles.
CellRun made_up_run(std::initializer_list<int> collapsed, int draws)
{
    CellRun run;
    double processor_s = 1;
    for (const int count : collapsed) {
        Level level;
        level.step_s = processor_s;
        level.draws.collapsed.assign(static_cast<std::size_t>(draws), 0);
        std::fill_n(level.draws.collapsed.begin(), count, 1);
        level.draws.simulated_s = 10.0 * draws;
        level.draws.processor_s = processor_s;
        processor_s *= 2;
        run.levels.push_back(level);
    }
    return run;
}

} // namespace

TEST(Converged, FromTheStepOnFromWhichTheErrorStaysWithin)
{
    constexpr int n = 100000;
    const auto found = converged({made_up_run({n / 2, 60000, 54000, 51500, 51000, n / 2}, n)}, 0.05);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->level, 2U) << "the first one is within by chance";
    EXPECT_NEAR(found->error.value, 0.04, 1e-4);
    EXPECT_DOUBLE_EQ(found->rate, n / 4.0);
    EXPECT_TRUE(found->resolved);
    EXPECT_EQ(converged({made_up_run({n / 2, 60000, 54000, 51500, 51000, n / 2}, n)}, 0.02)->level, 3U);
    EXPECT_FALSE(converged({made_up_run({n / 2, 60000, 54000, 52500, 51000, n / 2}, n)}, 0.02))
        << "the last two are not judged";
    EXPECT_FALSE(converged({made_up_run({n / 2, n / 2}, n)}, 0.05)) << "too few steps";
}

TEST(Converged, OverAllCellsAndAsFarAsTheSamplingAllows)
{
    constexpr int n = 100000;
    const CellRun exact = made_up_run({n / 2, n / 2, n / 2, n / 2}, n);
    const CellRun off = made_up_run({57000, 53000, n / 2, n / 2}, n);
    EXPECT_EQ(converged({exact, off}, 0.05)->level, 0U) << "0.07 / sqrt(2)";
    EXPECT_EQ(converged({exact, off}, 0.03)->level, 1U);
    EXPECT_FALSE(converged({made_up_run({5, 6, 5, 5}, 10)}, 0.05)->resolved) << "with ten draws";
}

namespace {

/// Draw i collapses where i is a multiple of level + 2. A level takes twice the time of the one before.
CellContender made_up_contender(double second_per_draw)
{
    CellContender c;
    c.engine = "made up";
    c.setting = "one";
    c.levels = 6;
    c.step_s = [](const Cell&, int level) { return std::ldexp(0.01, -level); };
    c.run = [second_per_draw](const Cell&, int level, std::uint64_t begin, std::uint64_t end) {
        Draws draws;
        for (std::uint64_t i = begin; i < end; ++i)
            draws.collapsed.push_back(i % static_cast<std::uint64_t>(level + 2) == 0);
        draws.simulated_s = 10 * static_cast<double>(end - begin);
        draws.processor_s = std::ldexp(second_per_draw * static_cast<double>(end - begin), level);
        return draws;
    };
    return c;
}

} // namespace

TEST(Forked, DrawsAreThoseOfOneProcess)
{
    const CellContender c = made_up_contender(1);
    const Draws one = run_forked(c, {}, 1, 5, 22, 1), three = run_forked(c, {}, 1, 5, 22, 3);
    EXPECT_EQ(one.collapsed, three.collapsed);
    EXPECT_DOUBLE_EQ(one.simulated_s, three.simulated_s);
    EXPECT_DOUBLE_EQ(one.processor_s, three.processor_s);
    EXPECT_EQ(run_forked(c, {}, 0, 0, 2, 5).collapsed, (std::vector<char>{1, 0})) << "more processes than draws";
}

TEST(Forked, AProcessWithoutAResultIsAnError)
{
    CellContender c = made_up_contender(1);
    c.run = [](const Cell&, int, std::uint64_t begin, std::uint64_t) -> Draws {
        if (begin > 0)
            throw std::runtime_error("this one is meant to fail");
        return {};
    };
    EXPECT_THROW(run_forked(c, {}, 0, 0, 8, 2), std::runtime_error);
}

TEST(CollapseScan, RefinesThenAddsDrawsAsTheBudgetAllows)
{
    CollapseOptions options;
    options.batch = 10;
    options.draws = 25;
    options.budget_s = 95;
    // a batch takes 3, 6, 12, 24 s: the next one would take more than a third of the budget
    int lines = 0;
    const auto scans = scan_collapses({made_up_contender(0.3), made_up_contender(0.01)}, rocking_cells(), options,
                                      [&](const std::string&) { ++lines; });
    ASSERT_EQ(scans.size(), 2U);
    for (const CellRun& run : scans[0].cells) {
        EXPECT_EQ(run.levels.size(), 4U);
        EXPECT_EQ(run.draws(), 20U) << "a third batch would take more than is left";
    }
    for (const CellRun& run : scans[1].cells) {
        EXPECT_EQ(run.levels.size(), 6U) << "all that there are";
        EXPECT_EQ(run.draws(), 25U);
        for (const Level& level : run.levels)
            EXPECT_EQ(level.draws.collapsed.size(), 25U) << "the same draws at every step";
        EXPECT_NEAR(run.levels[1].probability(), 9.0 / 25, 1e-12);
    }
    EXPECT_EQ(lines, 6 * (4 * 2 + 6 * 3));
    const std::string table = collapse_markdown(scans, rocking_cells(), "a processor");
    EXPECT_NE(table.find("1/800: 0.200"), std::string::npos) << table;
}
