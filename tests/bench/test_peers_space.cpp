/// The comparison with other engines in space: that each is built and driven as it should be, and that the trials
/// measure what they name.

#include "bench/peers/space/space_oracles.hpp"
#include "bench/peers/space/space_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace stylobate;
using namespace stylobate::peers;

namespace {

/// Each engine in the setting with which it is most accurate, and the error of its quarter period.
struct HeldInSpace {
    const char* engine;
    std::size_t setting;
    double dial, quarter_period;
};
constexpr HeldInSpace held_in_space[]{{"Bullet", 1, 1.0 / 3840, 0.01},
                                      {"MuJoCo", 1, 1.0 / 3840, 0.002},
                                      {"ODE", 0, 1.0 / 3840, 0.002},
                                      {"Stylobate", 0, 5e12, 0.002}};

class EachEngineInSpace : public testing::TestWithParam<HeldInSpace> {
protected:
    void SetUp() override
    {
        std::size_t setting = 0;
        for (SpaceContender& c : space_contenders())
            if (c.engine == GetParam().engine && setting++ == GetParam().setting)
                contender_ = std::move(c);
        if (contender_.engine.empty())
            GTEST_SKIP() << GetParam().engine << " is not installed (scripts/install_peers.sh)";
    }
    SpaceRun make(const SpaceScene& scene) const { return contender_.make(scene, GetParam().dial); }
    SpaceContender contender_;
};

std::string name_of_engine(const testing::TestParamInfo<HeldInSpace>& info)
{
    return info.param.engine;
}

/// One drum of 48 x 29 mm upright on a plane.
SpaceScene one_drum(double friction)
{
    SpaceScene scene;
    scene.friction = friction;
    Drum drum{flat_drum.radius_m, flat_drum.half_height_m, 0.1};
    drum.centre_m = {0, flat_drum.half_height_m, 0};
    scene.drums.push_back(drum);
    return scene;
}

SpaceVector turned(const SpaceAttitude& q, const SpaceVector& own)
{
    return rotated(spatial::minus_identity(q), own);
}

} // namespace

TEST_P(EachEngineInSpace, DrumsAtRestStay)
{
    SpaceScene scene = space_column();
    const SpaceRun run = make(scene);
    for (int n = 0; n * run.step_s < 0.5; ++n)
        run.world->step({0, 0, 0});
    for (std::size_t i = 0; i < scene.drums.size(); ++i) {
        const SpaceVector off = run.world->pose(i).centre_m - scene.drums[i].centre_m;
        EXPECT_LT(std::sqrt(dot(off, off)), 0.01 * flat_drum.radius_m) << i;
        EXPECT_GT(turned(run.world->pose(i).attitude, {0, 1, 0}).y, 1 - 1e-4) << i;
    }
}

/// High above the plane: signs, units and frames of all axes, and of the rotation.
TEST_P(EachEngineInSpace, WhatTouchesNothingFallsAndTurnsFreely)
{
    SpaceScene scene = one_drum(0.5);
    Drum& drum = scene.drums.front();
    drum.centre_m = {0.01, 2, 0.02};
    const double half = 0.5 * 0.4; // leaned by 0.4 rad about x, and turning about its own axis
    drum.attitude = {std::cos(half), std::sin(half), 0, 0};
    const SpaceVector axis = turned(drum.attitude, {0, 1, 0});
    drum.omega_rad_s = 3.0 * axis;
    drum.velocity_m_s = {0.1, 0.2, -0.3};
    if (contender_.own)
        GTEST_SKIP() << "Stylobate's drums begin on their beds";
    const SpaceRun run = make(scene);
    const double time_s = 0.2;
    const int steps = static_cast<int>(std::lround(time_s / run.step_s));
    for (int n = 0; n < steps; ++n)
        run.world->step({0.5, 0, 1});
    const double fall = time_s * (time_s + run.step_s) / 2; // with the new velocity, half a step ahead
    const SpacePose at = run.world->pose(0);
    EXPECT_NEAR(at.centre_m.x, 0.01 + 0.1 * time_s - 0.5 * fall, 1e-4);
    EXPECT_NEAR(at.centre_m.y, 2 + 0.2 * time_s - scene.gravity_m_s2 * fall, 1e-4);
    EXPECT_NEAR(at.centre_m.z, 0.02 - 0.3 * time_s - fall, 1e-4);
    const SpaceVector now = turned(at.attitude, {0, 1, 0});
    EXPECT_NEAR(dot(now, axis), 1, 1e-5);
    const SpaceVector side = turned(at.attitude, {1, 0, 0});
    EXPECT_NEAR(std::atan2(dot(side, cross(axis, SpaceVector{1, 0, 0})), side.x), 3 * time_s, 2e-3);
}

/// At a friction below the acceleration of the ground a drum is left behind with the difference. Along the axes: ODE
/// limits the friction along each of them alone.
TEST_P(EachEngineInSpace, FlatDrumSlidesWithTheFrictionOfItsScene)
{
    const double friction = 0.1, acceleration = 3, time_s = 0.1;
    for (const SpaceVector& along : {SpaceVector{1, 0, 0}, SpaceVector{0, 0, 1}}) {
        const SpaceRun run = make(one_drum(friction));
        const int steps = static_cast<int>(std::lround(time_s / run.step_s));
        for (int n = 0; n < steps; ++n)
            run.world->step(acceleration * along);
        const double slipped = (acceleration - friction * space_gravity_m_s2) * time_s * time_s / 2;
        const SpaceVector at = run.world->pose(0).centre_m;
        EXPECT_NEAR(at.x, -slipped * along.x, 0.05 * slipped);
        EXPECT_NEAR(at.z, -slipped * along.z, 0.05 * slipped);
    }
}

TEST_P(EachEngineInSpace, DrumHasTheRigidQuarterPeriod)
{
    const auto block = rocking_drum(tall_drum);
    const double exact = static_cast<double>(verification::quarter_period(block, block.alpha / 2));
    for (const bool on_plane : {true, false})
        EXPECT_NEAR(space_quarter_period_s(contender_, GetParam().dial, on_plane, 0.3), exact,
                    GetParam().quarter_period * exact)
            << on_plane;
}

INSTANTIATE_TEST_SUITE_P(Peers, EachEngineInSpace, testing::ValuesIn(held_in_space), name_of_engine);

TEST(PeersInSpace, EveryEngineThatIsBuiltInIsTested)
{
    for (const SpaceContender& c : space_contenders())
        EXPECT_TRUE(std::any_of(std::begin(held_in_space), std::end(held_in_space), [&](const HeldInSpace& h) {
            return c.engine == h.engine;
        })) << c.engine;
}

// Computed by an independent program, to all digits given.
TEST(PeersInSpace, OraclesHaveTheirDigits)
{
    const auto block = rocking_drum(tall_drum);
    EXPECT_NEAR(static_cast<double>(block.p), 9.049076451, 1e-9);
    EXPECT_NEAR(drum_restitution(tall_drum), 0.893451720, 1e-9);
    EXPECT_NEAR(static_cast<double>(verification::quarter_period(block, block.alpha / 2)), 0.14584489, 1e-8);
    EXPECT_NEAR(first_turn_back(tall_drum, static_cast<double>(block.alpha) / 2), 0.734, 5e-4);
    EXPECT_NEAR(rolling_rate(flat_drum, 0.1), 66.37395833, 1e-8);
    EXPECT_NEAR(rolling_rate(tall_drum, 0.1), 11.86245972, 1e-8);
    EXPECT_NEAR(wobble_rate(flat_drum, 0.1), 106.14599097, 1e-8);
    EXPECT_NEAR(wobble_rate(tall_drum, 0.1), 24.20013657, 1e-8);
    EXPECT_NEAR(spin_down_s(0.5, 10, 0.6), 0.637105, 1e-6);
}

namespace {

/// Drums that stay where they are put, but for the last one, which moves along a path of the time.
struct SpacePuppet final : SpaceWorld {
    using Path = std::function<SpacePose(const Drum& start, double time_s)>;
    SpacePuppet(const SpaceScene& scene, double step_s, Path path)
        : scene_(scene), step_s_(step_s), path_(std::move(path))
    {
    }
    void step(const SpaceVector&) override { time_s_ += step_s_; }
    SpacePose pose(std::size_t drum) const override
    {
        const Drum& d = scene_.drums[drum];
        return drum + 1 == scene_.drums.size() ? path_(d, time_s_) : SpacePose{d.centre_m, d.attitude};
    }
    SpaceScene scene_;
    double step_s_, time_s_ = 0;
    Path path_;
};

SpaceContender puppets(SpacePuppet::Path path)
{
    SpaceContender c;
    c.engine = "puppet";
    c.make = [path](const SpaceScene& scene, double step_s) {
        return SpaceRun{std::make_unique<SpacePuppet>(scene, step_s, path), step_s};
    };
    return c;
}

std::vector<double> errors_of(const std::string& trial, const SpacePuppet::Path& path)
{
    for (const SpaceTrial& t : space_trials())
        if (t.name == trial)
            return t.errors(puppets(path), 1e-3);
    ADD_FAILURE() << "no trial " << trial;
    return {};
}

SpaceAttitude about(const SpaceVector& axis, double angle)
{
    const SpaceVector v = std::sin(angle / 2) * axis;
    return {std::cos(angle / 2), v.x, v.y, v.z};
}

} // namespace

TEST(SpaceTrials, SpinDownIsTheTimeOfALinearDecay)
{
    for (const double part : {1.0, 2.0 / 3}) { // of the exact time; contacts on the rim have two thirds
        const double stops = part * spin_down_s(0.5, 10, 0.6);
        const auto errors = errors_of("spin-down", [stops](const Drum& d, double t) {
            const double s = std::min(t, stops);
            return SpacePose{d.centre_m, about({0, 1, 0}, 10 * s * (1 - s / (2 * stops)))};
        });
        EXPECT_NEAR(errors.at(0), part - 1, 2e-3);
    }
    EXPECT_TRUE(std::isnan(errors_of("spin-down",
                                     [](const Drum& d, double t) {
                                         return SpacePose{d.centre_m, about({0, 1, 0}, 10 * t)};
                                     })
                               .at(0)))
        << "it never stops";
}

TEST(SpaceTrials, WaysAreThoseFromTheAxisAndOutOfThePlane)
{
    const auto crept = errors_of("creep at rest", [](const Drum& d, double t) {
        return SpacePose{d.centre_m + SpaceVector{3e-5 * t, -1e-3 * t, 4e-5 * t}, d.attitude};
    });
    EXPECT_NEAR(crept.at(0), 5e-4 / 0.048, 1e-5) << "sinking is no creep";
    const auto fled = errors_of("shaken below uplift", [](const Drum& d, double t) {
        return SpacePose{{t < 5 ? d.centre_m.x : std::nan(""), 0, 0}, d.attitude};
    });
    EXPECT_TRUE(std::isinf(fled.at(0)));
    const auto left = errors_of("out of plane", [](const Drum& d, double t) {
        const double away = 1e-3 * std::min(t, 1.0); // across and along the direction of the rocking, 0.3 rad
        return SpacePose{d.centre_m + SpaceVector{-away * std::sin(0.3) + t * std::cos(0.3), 0,
                                                  away * std::cos(0.3) + t * std::sin(0.3)},
                         d.attitude};
    });
    EXPECT_NEAR(left.at(0), 1e-3 / 0.024, 1e-6);
}

TEST(SpaceTrials, MotionOnTheRimIsItsRateAndItsLean)
{
    const double rate = 1.02 * rolling_rate(flat_drum, 0.1);
    const auto errors = errors_of("rolling on a plane", [rate](const Drum& d, double t) {
        return SpacePose{d.centre_m, about({-std::sin(rate * t), 0, std::cos(rate * t)}, 0.097)};
    });
    EXPECT_NEAR(errors.at(0), 0.02, 2e-3);
    EXPECT_NEAR(errors.at(1), -0.03, 1e-6);
}

TEST(SpaceTables, HaveTheCheapestThatPasses)
{
    std::vector<SpaceResult> results;
    for (const auto& [engine, error, cost] :
         {std::tuple{"one", 0.02, 1.0}, {"one", 0.005, 3.0}, {"one", -0.005, 2.0}, {"other", 0.011, 0.1}}) {
        SpaceResult r;
        r.contender.engine = engine;
        r.contender.setting = "made up";
        r.step_s = 1e-3;
        r.cost_s = cost;
        for (const SpaceTrial& t : space_trials())
            r.errors.push_back(std::vector<double>(t.columns.size(), error));
        results.push_back(r);
    }
    ASSERT_NE(cheapest(results, "one", {0, 1}), nullptr);
    EXPECT_EQ(cheapest(results, "one", {0, 1})->cost_s, 2);
    EXPECT_EQ(cheapest(results, "other", {0}), nullptr);
    results[2].errors[1].back() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(cheapest(results, "one", {0, 1})->cost_s, 3) << "no result is no pass";
    const std::string table = space_markdown(results, "a processor");
    EXPECT_NE(table.find("| spin-down | 2 (made up; 1/1000 s) | none |"), std::string::npos) << table;
    EXPECT_NE(table.find("Stylobate never passes quarter period"), std::string::npos) << table;
}
