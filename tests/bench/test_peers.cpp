/// The comparison with general engines: that each is built and driven as it should be, and that the scan is not misled.

#include "bench/peers/contender.hpp"
#include "bench/peers/engine.hpp"
#include "bench/peers/rocking.hpp"
#include "bench/peers/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace stylobate;
using namespace stylobate::peers;

namespace {

/// Each engine in the setting with which it is most accurate, and the errors to which it holds at a fine step.
struct Held {
    const char* engine;
    std::size_t setting;
    double step_s, quarter_period, overturning;
};
constexpr Held held[]{
    {"Box2D", 0, 1e-3, 0.002, 0.002},  {"Chipmunk", 1, 1e-4, 0.002, 0.002}, {"Bullet", 1, 2.5e-4, 0.002, 0.002},
    {"MuJoCo", 2, 1e-3, 0.002, 0.002}, {"ODE", 2, 1e-3, 0.002, 0.002},
};

class EachEngine : public testing::TestWithParam<Held> {
protected:
    void SetUp() override
    {
        for (Engine& e : engines())
            if (e.name == GetParam().engine)
                engine_ = std::move(e);
        if (engine_.name.empty())
            GTEST_SKIP() << GetParam().engine << " is not installed (scripts/install_peers.sh)";
    }
    Engine engine_;
};

std::string name_of(const testing::TestParamInfo<Held>& info)
{
    return info.param.engine;
}

} // namespace

TEST_P(EachEngine, BlockAtRestStaysWhereItRests)
{
    const auto world = engine_.make(monolith_scene(0), GetParam().setting, GetParam().step_s);
    for (int n = 0; n * GetParam().step_s < 2; ++n)
        world->step(0);
    const Pose at = world->pose(1);
    EXPECT_NEAR(at.x_m, 0, 0.002 * Monolith::width_m);
    EXPECT_NEAR(at.y_m, Monolith::height_m / 2, 0.002 * Monolith::height_m);
    EXPECT_NEAR(at.theta_rad, 0, 0.002);
    EXPECT_NEAR(world->pose(0).y_m, -Monolith::height_m / 2, 1e-6) << "the ground";
}

TEST_P(EachEngine, FreeRockingHasHousnersQuarterPeriod)
{
    const double exact = exact_quarter_period();
    EXPECT_NEAR(quarter_period(engine_, GetParam().setting, GetParam().step_s), exact,
                GetParam().quarter_period * exact);
}

TEST_P(EachEngine, HalfASineOverturnsFromTheRigidBlocksAmplitudeOn)
{
    const double exact = exact_overturning_eta();
    EXPECT_NEAR(overturning_eta(engine_, GetParam().setting, GetParam().step_s), exact, GetParam().overturning * exact);
}

/// A free fall beside the ground, which is accelerated: signs and units of all axes, against the parabola.
TEST_P(EachEngine, WhatTouchesNothingFallsAlongTheParabola)
{
    Scene scene = monolith_scene(0);
    scene.bodies[1].start = {0, 1, 0.3};
    const double step = 1e-3, time = 0.2, acceleration = 3;
    const auto world = engine_.make(scene, GetParam().setting, step);
    for (int n = 0; n < 200; ++n)
        world->step(acceleration);
    const Pose at = world->pose(1);
    // the engine's motion is that of a time earlier or later by what its clock is wrong
    const double fall = time * (time + 2 * engine_.ahead_steps * step) / 2;
    EXPECT_NEAR(at.x_m, -acceleration * fall, 1e-5);
    EXPECT_NEAR(at.y_m, 1 - scene.gravity_m_s2 * fall, 1e-5);
    EXPECT_NEAR(at.theta_rad, 0.3, 1e-6);
}

/// On the ground at a friction below the acceleration, a flat block is left behind with the difference.
TEST_P(EachEngine, FlatBlockSlidesWithTheFrictionOfItsScene)
{
    Scene scene = monolith_scene(0);
    std::swap(scene.bodies[1].half_width_m, scene.bodies[1].half_height_m);
    scene.bodies[1].start.y_m = scene.bodies[1].half_height_m;
    scene.bodies[1].friction = 0.3;
    const double step = GetParam().step_s, time = 0.3, acceleration = 5;
    const auto world = engine_.make(scene, GetParam().setting, step);
    for (int n = 0; n * step < time; ++n)
        world->step(acceleration);
    const double slipped = (acceleration - scene.bodies[1].friction * scene.gravity_m_s2) * time * time / 2;
    EXPECT_NEAR(world->pose(1).x_m, -slipped, 0.02 * slipped);
}

INSTANTIATE_TEST_SUITE_P(Peers, EachEngine, testing::ValuesIn(held), name_of);

TEST(Peers, EveryEngineThatIsBuiltInIsTested)
{
    for (const Engine& engine : engines())
        EXPECT_TRUE(std::any_of(std::begin(held), std::end(held), [&](const Held& h) {
            return engine.name == h.engine;
        })) << engine.name;
}

TEST(Peers, OraclesHaveTheirDigits)
{
    EXPECT_NEAR(4 * exact_quarter_period(), 0.58467309, 1e-8);
    EXPECT_NEAR(exact_overturning_eta(), 2.798592, 1e-6);
}

TEST(Peers, GroundAccelerationIsThatOfThePulse)
{
    Realization r;
    r.step_s = 1e-4;
    r.frequency_hz = 5;
    r.pga_m_s2 = 2;
    ExcitationSpec half_sine;
    half_sine.kind = ExcitationKind::half_sine;
    const BaseMotion base(half_sine, r, nullptr);
    EXPECT_NEAR(mean_acceleration(base, 300, 1e-4), 2 * std::sin(2 * std::numbers::pi * 5 * 0.03), 1e-5);
    EXPECT_NEAR(mean_acceleration(base, 1200, 1e-4), 0, 1e-5) << "after the pulse";
}

namespace {

/// Bodies that stay where they are put, but for the last one, which moves along a path of the time.
struct Puppet final : World {
    Puppet(const Scene& scene, double step_s, std::function<Pose(Pose, double)> path)
        : scene_(scene), step_s_(step_s), path_(std::move(path))
    {
    }
    void step(double) override { time_ += step_s_; }
    Pose pose(std::size_t body) const override
    {
        const Pose start = scene_.bodies[body].start;
        return body + 1 == scene_.bodies.size() ? path_(start, time_) : start;
    }
    Scene scene_;
    double step_s_, time_ = 0;
    std::function<Pose(Pose, double)> path_;
};

Columns puppets(std::function<Pose(Pose, double)> path)
{
    Engine engine;
    engine.make = [path](const Scene& scene, std::size_t, double step_s) -> std::unique_ptr<World> {
        EXPECT_EQ(scene.bodies.size(), 7u);
        EXPECT_TRUE(scene.bodies.front().fixed);
        EXPECT_NE(scene.bodies.back().start.x_m, 0) << "perturbed";
        return std::make_unique<Puppet>(scene, step_s, path);
    };
    return run_columns(engine, 0, 1e-3, true, 1e-3);
}

} // namespace

TEST(Columns, AreCountedAsTheyFare)
{
    const Columns still = puppets([](Pose at, double) { return at; });
    EXPECT_GE(still.count, 3);
    EXPECT_EQ(still.collapsed + still.moved, 0);
    EXPECT_GT(still.realizations_per_second, 0);

    const Columns crept = puppets([](Pose at, double t) { return Pose{at.x_m + 5e-5 * t, at.y_m, 0}; });
    EXPECT_EQ(crept.collapsed, 0);
    EXPECT_EQ(crept.moved, crept.count) << "by .5 mm, which is 1 % of 48 mm";

    const Columns fell = puppets([](Pose at, double t) { return Pose{at.x_m, t < 4.5 ? at.y_m : 0, 0}; });
    EXPECT_EQ(fell.collapsed, fell.count);
    EXPECT_EQ(fell.moved, fell.count);

    const Columns flew = puppets([](Pose at, double t) { return Pose{at.x_m, t < 0.5 ? at.y_m : std::nan(""), 0}; });
    EXPECT_EQ(flew.collapsed, flew.count) << "what is no number has not stood";
}

/// Against the second solver of the verification cases (docs/verification.md: QuarterPeriod 0.14803 s,
/// HalfSine 2.5912), whose dashpots are in proportion to the contact length: within what this moves.
TEST(Own, ErrsAsACompliantContactDoes)
{
    const Contender area = own_contenders().front();
    EXPECT_NEAR(area.quarter_period_s(1e8), 0.14803, 0.003 * 0.14803);
    EXPECT_NEAR(area.overturning_eta(1e8), 2.5912, 2e-3);
    EXPECT_EQ(area.dials.at(12), area.customary);
}

TEST(Own, ColumnsAtRestStand)
{
    for (const Contender& c : own_contenders()) {
        const Columns rest = c.columns(c.customary, false, 0.01);
        EXPECT_GE(rest.count, 1) << c.setting;
        EXPECT_EQ(rest.moved, 0) << c.setting;
        EXPECT_GT(rest.realizations_per_second, 0) << c.setting;
    }
}

namespace {

/// Errors by a formula, and columns that cost what they are told to.
Contender made_up(const std::string& engine, const std::function<double(double)>& error, double rate, int moved)
{
    Contender c;
    c.engine = engine;
    c.setting = "made up";
    c.dials = {0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.00125, 0.0006, 0.0003};
    c.customary = 0.08;
    c.step_s = [](double dial) { return dial; };
    c.quarter_period_s = [error](double dial) { return exact_quarter_period() * (1 + error(dial)); };
    c.overturning_eta = [](double) { return exact_overturning_eta(); };
    c.columns = [rate, moved](double dial, bool, double) { return Columns{3, 0, moved, rate * dial}; };
    return c;
}

} // namespace

TEST(Scan, FindsTheCoarsestDialFromWhichTheErrorStaysWithin)
{
    const Result r = scan(made_up(
                              "a", [](double dial) { return -0.99 * dial; }, 100, 0),
                          1, 10);
    ASSERT_TRUE(r.reached[0]);
    EXPECT_EQ(r.reached[0]->errors.dial, 0.01);
    EXPECT_NEAR(r.reached[0]->errors.quarter_period, -0.0099, 1e-9);
    EXPECT_FALSE(r.reached[1]) << "four dials are within, and that is one too few";
    EXPECT_EQ(r.customary.errors.dial, 0.08);
}

TEST(Scan, IsNotMisledByAnErrorThatPassesThroughZero)
{
    const Result r = scan(made_up(
                              "a", [](double dial) { return dial - 0.02; }, 100, 0),
                          1, 10);
    EXPECT_FALSE(r.reached[0]) << "within at .02 alone";
}

TEST(Scan, WhatHasNoResultReachesNothing)
{
    const Result r = scan(made_up(
                              "a", [](double) { return std::numeric_limits<double>::quiet_NaN(); }, 1, 0),
                          1, 10);
    EXPECT_FALSE(r.reached[0]);
    EXPECT_TRUE(std::isinf(r.scanned.front().worst()));
}

TEST(Scan, GoesOnUntilColumnsStand)
{
    Contender c = made_up(
        "a", [](double dial) { return dial / 10; }, 100, 0);
    c.columns = [](double dial, bool shaken, double) {
        return Columns{3, 0, dial > (shaken ? 0.03 : 0.015) ? 2 : 0, 1};
    };
    const Result rest = scan(c, 1, 10);
    EXPECT_EQ(rest.customary.shaken.moved, 2);
    ASSERT_TRUE(rest.reached[0]);
    EXPECT_EQ(rest.reached[0]->errors.dial, 0.01);

    c.columns = [](double dial, bool shaken, double) { return Columns{3, 0, shaken && dial > 0.015 ? 3 : 0, 1}; };
    const Result shaken = scan(c, 1, 10);
    ASSERT_TRUE(shaken.reached[0]);
    EXPECT_EQ(shaken.reached[0]->errors.dial, 0.01)
        << "what walks, and neither falls nor creeps at rest, does not stand";
}

TEST(Scan, ColumnsStandAtFinerStepsToo)
{
    Contender c = made_up(
        "a", [](double dial) { return dial / 10; }, 100, 0);
    c.columns = [](double dial, bool shaken, double) { return Columns{3, 0, shaken && dial == 0.04 ? 3 : 0, 1}; };
    const Result r = scan(c, 1, 10);
    ASSERT_TRUE(r.reached[0]);
    EXPECT_EQ(r.reached[0]->errors.dial, 0.02) << "at .08 they stand, and not at .04";
}

TEST(Scan, FastestAndItsRatio)
{
    const auto error = [](double dial) { return dial / 10; };
    std::vector<Result> results;
    for (const auto& [name, rate, moved] : {std::tuple{"slow", 10, 0}, {"falls", 99, 1}, {"fast", 20, 0}})
        results.push_back(scan(made_up(name, error, rate, moved), 1, 10));
    EXPECT_EQ(fastest(results, false, 0)->contender.engine, "fast");
    EXPECT_EQ(fastest(results, true, 0), nullptr);
    Contender own = made_up("Stylobate", error, 60, 0);
    own.own = true;
    results.push_back(scan(own, 1, 10));
    const std::string table = markdown(results, "a processor");
    EXPECT_NE(table.find("At 1 %: Stylobate (made up) does 3 times"), std::string::npos) << table;
    EXPECT_NE(table.find("| falls | not reached | 1 % |"), std::string::npos) << table;
}
