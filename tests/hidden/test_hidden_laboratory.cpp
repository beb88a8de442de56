/// The virtual laboratory of the hidden-effect tests: its two contact laws against closed forms of rigid blocks, its
/// table, its effects and what it calls detectable.

#include "io/study/study_file.hpp"
#include "tests/hidden/score/detectability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>

namespace stylobate::hidden {

namespace {

constexpr double g = 9.81;

/// Rigid rectangles on one another; corners so stiff that they sink by a hundred thousandth of the width.
Model stack(Law law, const std::vector<std::pair<double, double>>& sizes, double density, double friction)
{
    Model model;
    model.law = law;
    model.body_count = model.bed_count = static_cast<int>(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        Body& body = model.bodies[i];
        body.half_width_m = sizes[i].first / 2;
        body.half_height_m = sizes[i].second / 2;
        body.mass_kg = density * sizes[i].first * sizes[i].second;
        body.inertia_kg_m2 =
            body.mass_kg * (body.half_width_m * body.half_width_m + body.half_height_m * body.half_height_m) / 3;
        model.beds[i] = {static_cast<int>(i) - 1, static_cast<int>(i), friction};
    }
    LawParameters& p = model.parameters;
    const double depth = 1e-5 * sizes[0].first, clock = std::sqrt(depth / (1.5 * g));
    p.reference_m = p.bristle_m = depth;
    p.stiffness_n_m = 0.5 * model.bodies[0].mass_kg * g / (depth * std::sqrt(depth));
    p.damping_s_m = 1 / std::sqrt(0.02 * g * sizes[0].first);
    p.bristle_time_s = 0.2 * clock;
    model.step_s = frame_s / std::ceil(frame_s / (law == Law::compliant ? 0.15 * clock : 1e-4));
    return model;
}

State at_rest(const Model& model)
{
    Specimen specimen;
    specimen.placement_tolerance_m = 0;
    return put_on_table(model, specimen, Draws(1, Draw::placement));
}

/// A table whose motion is a function of time: displacement and velocity.
template <class Function>
TableMotion table_of(const Model& model, double duration_s, Function motion)
{
    std::vector<BaseState> states;
    const long steps = std::lround(duration_s / model.step_s);
    for (long i = 0; i <= 2 * steps; ++i) {
        const auto [u, v] = motion(0.5 * model.step_s * static_cast<double>(i));
        BaseState state;
        state.x = u;
        state.vx = v;
        states.push_back(state);
    }
    return TableMotion(states);
}

class LawOf : public testing::TestWithParam<Law> {};

INSTANTIATE_TEST_SUITE_P(Healthy, LawOf, testing::Values(Law::nonsmooth, Law::compliant),
                         [](const auto& law) { return law.param == Law::nonsmooth ? "nonsmooth" : "compliant"; });

// ---- closed forms ---------------------------------------------------------------------------------------------------

/// Housner (1963): from half its critical angle a block 48 x 174 mm is upright again after 0.146168 s, one of
/// 1 x 4 m after 0.698343 s; without restitution it goes on with 1 - 1.5 sin2 alpha of its angular velocity.
TEST_P(LawOf, FreeRockingTakesHousnersTime)
{
    struct Case {
        double width, height, quarter_s, kept;
    };
    for (const Case& of : {Case{0.048, 0.174, 0.14616827, 0.893922652}, Case{1, 4, 0.69834320, 0.911764706}}) {
        const Model model = stack(GetParam(), {{of.width, of.height}}, 2000, 5);
        const TableMotion still = table_of(model, 0.01, [](double) { return std::pair{0.0, 0.0}; });
        const Table table{&still, 0, {}, 0.5 * model.step_s};
        const double alpha = std::atan(of.width / of.height), theta = -0.5 * alpha;
        // on its lower right corner, which stays where it was
        State state = at_rest(model);
        BodyState& body = state.bodies[0];
        const double b = of.width / 2, h = of.height / 2;
        body.x = b + std::cos(theta) * -b - std::sin(theta) * h;
        body.y += std::sin(theta) * -b + std::cos(theta) * h - h;
        body.theta = theta;
        double before = 0;
        while (body.theta < 0 && state.step < 100000) {
            before = body.omega;
            step(model, table, state);
        }
        const double time = static_cast<double>(state.step) * model.step_s;
        EXPECT_NEAR(time, of.quarter_s, 0.01 * of.quarter_s);
        const double landed = time + 0.05 * of.quarter_s;
        while (static_cast<double>(state.step) * model.step_s < landed)
            step(model, table, state);
        // what gravity has taken since: p2 sin alpha, p2 = 3 g / 4 R
        const double past = static_cast<double>(state.step) * model.step_s - time;
        const double kept = (body.omega + 0.75 * g / std::hypot(b, h) * std::sin(alpha) * past) / before;
        // corners without restitution are Housner's own assumption; those that give a little back come near
        EXPECT_NEAR(kept, of.kept, GetParam() == Law::nonsmooth ? 0.01 : 0.08);
    }
}

/// A wide block on a table that is pushed once, a = eta mu g sin wt for half a period: total slip in units of
/// mu g / w2.
TEST_P(LawOf, SlidingCoversItsClosedForm)
{
    const double w = 2 * std::numbers::pi * 4, mu = 0.3;
    for (const auto& [eta, slip] : {std::pair{1.5, 0.80925349}, {2.0, 2.72811386}, {3.0, 9.58001414}}) {
        const Model model = stack(GetParam(), {{0.1, 0.02}}, 2000, mu);
        const double a = eta * mu * g;
        const TableMotion motion = table_of(model, 1.5, [&](double t) {
            if (t * w < std::numbers::pi)
                return std::pair{a / (w * w) * (w * t - std::sin(w * t)), a / w * (1 - std::cos(w * t))};
            return std::pair{a / (w * w) * std::numbers::pi + 2 * a / w * (t - std::numbers::pi / w), 2 * a / w};
        });
        const History history = shake(model, motion, at_rest(model));
        const double want = slip * mu * g / (w * w);
        const double residual = history.table.back().x - history.places.back().x;
        EXPECT_NEAR(residual, want, 0.01 * want + 2e-5) << eta;
        EXPECT_NEAR(history.slip_m, want, 0.02 * want) << eta;
        EXPECT_LT(history.tilt_rad, 1e-3);
    }
}

/// The acceleration at which a slowly growing push lifts an edge.
double lifting_acceleration(const Model& model, int body)
{
    const double rate = 1.0; // m/s2 per s
    const TableMotion motion = table_of(model, 5, [&](double t) {
        return std::pair{rate * t * t * t / 6, rate * t * t / 2};
    });
    const Table table{&motion, 0, {}, 0.5 * model.step_s};
    State state = at_rest(model);
    while (static_cast<double>(state.step) * model.step_s < 5) {
        step(model, table, state);
        // little enough that it does not matter how long the block takes to get there
        const BedEnds ends = ends_of_bed(model, body, state, table.at(2 * state.step));
        if (std::max(ends.end[0].gap, ends.end[1].gap) > 2e-5 * ends.width)
            break;
    }
    return rate * static_cast<double>(state.step) * model.step_s;
}

TEST_P(LawOf, EdgesLiftWhereStaticsSay)
{
    // g b / h of one block and of two equal ones that rise together
    EXPECT_NEAR(lifting_acceleration(stack(GetParam(), {{0.048, 0.174}}, 2000, 2), 0), 2.706207, 0.015 * 2.706207);
    EXPECT_NEAR(lifting_acceleration(stack(GetParam(), {{0.048, 0.087}, {0.048, 0.087}}, 2000, 2), 0), 2.706207,
                0.015 * 2.706207);
    // upon 1 x 1 m one of 0.5 x 2 m of the same mass: the upper one at 2.4525, long before both
    EXPECT_NEAR(lifting_acceleration(stack(GetParam(), {{1, 1}, {0.5, 2}}, 2000, 2), 1), 2.4525, 0.04 * 2.4525);
}

TEST_P(LawOf, RestIsRest)
{
    for (const SpecimenKind kind : {SpecimenKind::small_column, SpecimenKind::frame_of_drums}) {
        Draws plan(3, Draw::plan);
        const Planned planned = plan_specimen(kind, plan);
        const Model model = make_specimen(planned, GetParam(), Draws(3, Draw::making), Draws(3, Draw::law));
        const State state = put_on_table(model, planned.specimen, Draws(3, Draw::placement));
        const TableMotion still = table_of(model, 1, [](double) { return std::pair{0.0, 0.0}; });
        const History history = shake(model, still, state);
        ASSERT_FALSE(history.collapsed);
        const auto blocks = static_cast<std::size_t>(model.body_count);
        for (std::size_t i = 0; i < blocks; ++i) {
            const BodyState& first = history.places[i];
            const BodyState& last = history.places[history.places.size() - blocks + i];
            EXPECT_NEAR(first.x, last.x, 2e-6);
            EXPECT_NEAR(first.y, last.y, 2e-6);
            EXPECT_NEAR(first.theta, 0, 1e-4);
        }
        EXPECT_EQ(history.slip_m, 0);
    }
}

TEST_P(LawOf, HalfTheStepChangesLittle)
{
    Draws plan(4, Draw::plan), draws(4, Draw::motion);
    const Planned planned = plan_specimen(SpecimenKind::two_drums, plan);
    Model model = make_specimen(planned, GetParam(), Draws(4, Draw::making), Draws(4, Draw::law));
    Shaking shaking = draw_shaking("harmonic", planned.band, draws);
    shaking.scale_to(1.3 * planned.rocking_m_s2);
    std::vector<double> tilt;
    for (int halved = 0; halved < 2; ++halved) {
        const History history = shake(model, TableMotion(shaking, {}, model.step_s),
                                      put_on_table(model, planned.specimen, Draws(4, Draw::placement)));
        tilt.push_back(history.tilt_rad);
        model.step_s /= 2;
    }
    EXPECT_GT(tilt[1], 0.005);
    EXPECT_NEAR(tilt[0], tilt[1], 0.15 * tilt[1]);
}

// ---- the table ------------------------------------------------------------------------------------------------------

TEST(Table, MovesAsItsVelocitySays)
{
    for (const char* kind : {"harmonic", "sweep", "quake"}) {
        Draws draws(9, Draw::motion);
        Shaking shaking = draw_shaking(kind, {3, 7, 4}, draws);
        shaking.scale_to(5);
        double peak = 0;
        for (double t = 0.05; t < 4; t += 0.0137) {
            const double d = 1e-5;
            const Jet before = shaking.at(t - d), now = shaking.at(t), after = shaking.at(t + d);
            EXPECT_NEAR((after.u - before.u) / (2 * d), now.v, 1e-5) << kind << t;
            EXPECT_NEAR((after.v - before.v) / (2 * d), now.a, 1e-3) << kind << t;
            peak = std::max(peak, std::abs(now.a));
        }
        EXPECT_NEAR(peak, 5, 0.5) << kind;
        EXPECT_EQ(shaking.at(0.1).u, 0);
        EXPECT_EQ(shaking.at(3.99).u, 0);
    }
}

/// Fourier amplitude of the table's displacement at a frequency, over whole periods of the steady part.
double amplitude_at(const TableMotion& motion, double half_step, double hz, double from, double to)
{
    std::complex<double> sum = 0;
    long n = 0;
    for (double t = from; t < to; t += half_step, ++n)
        sum += motion.at(std::lround(t / half_step)).x * std::polar(1.0, -2 * std::numbers::pi * hz * t);
    return 2 * std::abs(sum) / static_cast<double>(n);
}

TEST(Table, DistortsByTheStatedHarmonic)
{
    Shaking shaking;
    shaking.kind = "harmonic";
    shaking.sines = {{0.01, 4, 0, 0}};
    for (const int order : {2, 3}) {
        BaseEffect effect;
        effect.distortion_order = order;
        effect.distortion_ratio = 0.2;
        const TableMotion motion(shaking, effect, 1e-4);
        const double first = amplitude_at(motion, 5e-5, 4, 1, 2.5);
        EXPECT_NEAR(first, 0.01, 1e-4);
        // acceleration goes with the square of the frequency
        EXPECT_NEAR(order * order * amplitude_at(motion, 5e-5, 4 * order, 1, 2.5) / first, 0.2, 4e-3) << order;
    }
}

TEST(Table, IsReportedWithTheFilesClockAndGain)
{
    Draws draws(9, Draw::motion);
    Shaking shaking = draw_shaking("quake", {3, 7, 4}, draws);
    shaking.scale_to(5);
    BaseEffect effect;
    effect.time_offset_s = 0.01;
    effect.gain = 1.1;
    const TableMotion motion(shaking, effect, 1e-4);
    for (double t = 0.6; t < 3; t += 0.1) // true motion at t = gain times what the file says for t + tau
        EXPECT_NEAR(motion.at(std::lround(t / 5e-5)).x, 1.1 * reported(shaking, effect, true, t + 0.01).u, 1e-9);
}

// ---- effects --------------------------------------------------------------------------------------------------------

TEST(HiddenEffects, HaveTheNamesOfVerdicts)
{
    const std::vector<std::string> names = {
        "stribeck",        "joint_friction",      "drag",          "corner_loss", "hertz",
        "rate_damping",    "face_damping",        "friction_wear", "corner_wear", "table_pitch",
        "vertical_motion", "harmonic_distortion", "time_offset",   "sensor_gain", "dowel",
        "adhesion",        "eccentricity",        "wedge",         "drum_offset"};
    EXPECT_EQ(listed_names(), names);
    EXPECT_EQ(together({}), Effects{});
}

/// Every effect at its drawn strength moves the blocks otherwise, or changes what the file says of the table.
TEST(HiddenEffects, EachMakesADifference)
{
    std::vector<std::string> names = listed_names();
    names.insert(names.end(), outside_names().begin(), outside_names().end());
    for (const Law law : {Law::nonsmooth, Law::compliant}) {
        Draws plan(5, Draw::plan), draws(5, Draw::motion);
        const Planned planned = plan_specimen(SpecimenKind::two_drums, plan);
        const Model healthy = make_specimen(planned, law, Draws(5, Draw::making), Draws(5, Draw::law));
        Shaking shaking = draw_shaking("harmonic", planned.band, draws);
        shaking.scale_to(1.4 * planned.rocking_m_s2);
        const auto last_place = [&](const Model& model) {
            const History history = shake(model, TableMotion(shaking, model.effects.base, model.step_s),
                                          put_on_table(model, planned.specimen, Draws(5, Draw::placement)));
            return history.collapsed ? 1.0 : history.places.back().x;
        };
        const double without = last_place(healthy);
        EXPECT_EQ(last_place(healthy), without);
        for (const std::string& name : names) {
            if (!applies(name, law))
                continue;
            Draws strength(5, Draw::effect);
            const HiddenEffect effect = draw_effect(name, planned, healthy, strength);
            EXPECT_EQ(effect.name, name);
            EXPECT_NE(effect.effects, Effects{}) << name;
            EXPECT_NE(effect.size, 0) << name;
            EXPECT_FALSE(effect.place.empty() || effect.parameter.empty()) << name;
            Model model = healthy;
            model.effects = together({effect});
            EXPECT_EQ(model.effects, effect.effects) << name;
            if (effect.effects.base.time_offset_s != 0)
                EXPECT_NE(reported(shaking, model.effects.base, true, 1.5).u, shaking.at(1.5).u);
            else
                EXPECT_NE(last_place(model), without) << name;
        }
    }
}

TEST(HiddenEffects, ABondIsAdhesionThatHoldsTension)
{
    Draws plan(5, Draw::plan), strength(5, Draw::effect);
    const Planned planned = plan_specimen(SpecimenKind::two_drums, plan);
    const Model healthy = make_specimen(planned, Law::nonsmooth, Draws(5, Draw::making), Draws(5, Draw::law));
    ASSERT_EQ(variant_names(), std::vector<std::string>{"bond"});
    const HiddenEffect bond = draw_effect("bond", planned, healthy, strength);
    EXPECT_EQ(bond.name, "adhesion");
    EXPECT_TRUE(bond.listed);
    const Effects all = together({bond});
    double tension = 0, shear = 0;
    for (const BedEffect& bed : all.beds) {
        tension += bed.tension_n_m;
        shear += bed.adhesion_n_m;
    }
    EXPECT_GT(tension, 0);
    EXPECT_EQ(shear, bond.size);
}

// ---- campaigns and what can be seen in them -------------------------------------------------------------------------

TEST(Detectability, NoiseIsThatOfTwoSlopes)
{
    // a straight line through the frames of a window, and of the next, by least squares, of noise alone
    Draws draws(1, Draw::cameras);
    const double sd = 5e-5;
    double sum = 0;
    const int trials = 4000;
    for (int trial = 0; trial < trials; ++trial) {
        double slopes[2];
        for (double& slope : slopes) {
            double up = 0, squares = 0;
            for (int k = 0; k < window_frames; ++k) {
                const double t = (k - 0.5 * (window_frames - 1)) * frame_s;
                up += t * sd * draws.normal();
                squares += t * t;
            }
            slope = up / squares;
        }
        sum += (slopes[1] - slopes[0]) * (slopes[1] - slopes[0]);
    }
    EXPECT_NEAR(velocity_change_noise(sd), std::sqrt(sum / trials), 0.05 * velocity_change_noise(sd));
}

TEST(Detectability, NothingIsSeenOfNothingAndMoreOfMore)
{
    for (const Law law : {Law::nonsmooth, Law::compliant}) {
        Wish wish;
        wish.law = law;
        wish.specimen = SpecimenKind::two_drums;
        wish.effects = {"joint_friction"};
        wish.most_motions = 1;
        VirtualCampaign made = make_campaign(2, wish);
        std::vector<double> strengths;
        for (const double ratio : {1.0, 0.9, 0.5}) {
            made.effects[0].effects = {};
            made.effects[0].effects.beds[0].friction_ratio = made.effects[0].size = ratio;
            made.model.effects = together(made.effects);
            for (TrueRun& run : made.runs)
                run.history = shake(made.model, TableMotion(run.shaking, {}, made.model.step_s), run.start);
            strengths.push_back(detectability_of(made)[0].snr_noise);
        }
        EXPECT_LT(strengths[0], 1e-6) << "a twin that differs by nothing differs by nothing";
        EXPECT_GT(strengths[2], strengths[1]);
        EXPECT_GT(strengths[2], least_snr_noise);
    }
}

TEST(Detectability, WhatAHealthyLawMakesIsNoEffect)
{
    // by hand: an effect along one law and across it
    const std::vector<double> along = {3, 4, 0}, across = {0, 0, 5}, both = {3, 4, 5};
    EXPECT_NEAR(share_of_laws(both, {along}, 3), 0.5, 1e-12);
    EXPECT_NEAR(share_of_laws(both, {along, across}, 3), 1, 1e-12);
    EXPECT_NEAR(share_of_laws(across, {along}, 3), 0, 1e-12);
    EXPECT_NEAR(share_of_laws({6, 8, 0}, {along}, 1), 0.75, 1e-12) << "taken once at the most";
    Detectability found{40, 2, 0.5};
    EXPECT_TRUE(found.detectable());
    found.law_share = 0.8;
    EXPECT_FALSE(found.detectable()) << "what is left is below the scatter";
    found = {40, 20, 0.9};
    EXPECT_FALSE(found.detectable()) << "what is left is below the noise";

    // friction that is a little less everywhere is a law, a shifted centre of mass is none
    Wish wish;
    wish.law = Law::compliant;
    wish.specimen = SpecimenKind::two_drums;
    wish.effects = {"joint_friction"};
    wish.most_motions = 1;
    VirtualCampaign made = make_campaign(2, wish);
    const auto share = [&](const Effects& effects) {
        made.effects[0].effects = effects;
        made.model.effects = together(made.effects);
        for (TrueRun& run : made.runs)
            run.history = shake(made.model, TableMotion(run.shaking, {}, made.model.step_s), run.start);
        return detectability_of(made)[0].law_share;
    };
    Effects everywhere, one_block;
    everywhere.beds[0].friction_ratio = everywhere.beds[1].friction_ratio = 0.98;
    one_block.bodies[1].eccentricity_m = 0.003;
    EXPECT_GT(share(everywhere), 0.8);
    EXPECT_LT(share(one_block), 0.5);

    // an exponent is that of all joints: a law, whatever its size
    wish.effects = {"hertz"};
    EXPECT_FALSE(detectability_of(make_campaign(2, wish))[0].detectable());
}

TEST(Campaigns, AreTheirSeeds)
{
    Wish wish;
    wish.specimen = SpecimenKind::two_drums;
    wish.most_motions = 1;
    const VirtualCampaign one = make_campaign(11, wish), again = make_campaign(11, wish),
                          other = make_campaign(12, wish);
    const auto& seen = one.campaign.runs.at(0).blocks;
    EXPECT_EQ(seen.x_m.values, again.campaign.runs.at(0).blocks.x_m.values);
    EXPECT_EQ(seen.theta_rad.values, again.campaign.runs.at(0).blocks.theta_rad.values);
    EXPECT_NE(seen.x_m.values, other.campaign.runs.at(0).blocks.x_m.values);
    ASSERT_EQ(seen.x_m.values.size(), one.campaign.runs[0].time_s.size() * 2);
}

/// The study that goes with a campaign lays out the same blocks and joints, by the reader of study files.
TEST(Campaigns, AreRepeatedWithOtherSpecimensAndTheSameLaw)
{
    Wish wish;
    wish.most_motions = 2;
    wish.effects = std::vector<std::string>{"drag"};
    const VirtualCampaign made = make_campaign(5, wish);
    const VirtualCampaign with = another_like(made, 3, true), again = another_like(made, 3, true);
    const VirtualCampaign without = another_like(made, 3, false), other = another_like(made, 4, true);
    EXPECT_EQ(with.campaign.runs.front().blocks.x_m.values, again.campaign.runs.front().blocks.x_m.values);
    EXPECT_EQ(with.model.effects, made.model.effects);
    EXPECT_EQ(without.model.effects, Effects());
    EXPECT_EQ(without.model.beds[0].friction, with.model.beds[0].friction) << "the same specimen, but for the effect";
    EXPECT_NE(other.model.beds[0].friction, with.model.beds[0].friction);
    EXPECT_NE(made.model.beds[0].friction, with.model.beds[0].friction);
    EXPECT_EQ(with.model.parameters, made.model.parameters);
    ASSERT_EQ(with.runs.size(), made.runs.size());
    for (std::size_t i = 0; i < made.runs.size(); ++i) {
        EXPECT_EQ(with.runs[i].shaking.peak_m_s2, made.runs[i].shaking.peak_m_s2);
        EXPECT_EQ(with.campaign.runs[i].motion_id, made.campaign.runs[i].motion_id);
        EXPECT_EQ(with.campaign.runs[i].repeat, made.campaign.runs[i].repeat);
    }
}

TEST(Campaigns, HaveAStudyOfTheirSpecimen)
{
    for (int kind = 0; kind < 5; ++kind) {
        Draws plan(6, Draw::plan);
        const Planned planned = plan_specimen(static_cast<SpecimenKind>(kind), plan);
        const Specimen& s = planned.specimen;
        const Study study = parse_study(study_text_of(planned), "campaign.toml");
        const Layout layout = lay_out(study.structure);
        ASSERT_EQ(layout.beds.size(), s.joints.size()) << s.name;
        const int fixed = s.base_block_half_width_m ? 1 : 0;
        for (std::size_t j = 0; j < s.joints.size(); ++j) {
            EXPECT_EQ(layout.beds[j].lower - fixed, fixed == 0 && layout.beds[j].lower < 0 ? -1 : s.joints[j].first);
            EXPECT_EQ(layout.beds[j].upper - fixed, s.joints[j].second);
        }
        for (std::size_t i = 0; i < s.mass_kg.size(); ++i) {
            const PlacedBlock& block = layout.blocks[i + static_cast<std::size_t>(fixed)];
            EXPECT_NEAR(block.x_m(), s.rest_x_m[i], 1e-12);
            EXPECT_NEAR(block.y_m, s.rest_y_m[i], 1e-12);
            EXPECT_NEAR(block.width_m, 2 * s.half_width_m[i], 1e-12);
            EXPECT_NEAR(block.height_m, 2 * s.half_height_m[i], 1e-12);
            EXPECT_EQ(block.mass_kg, s.mass_kg[i]);
        }
        EXPECT_EQ(study.structure.depth_m, s.depth_m[0]);
    }
}

TEST(Campaigns, TwoThirdsHideNothing)
{
    int nothing = 0;
    Wish wish;
    wish.most_motions = 0; // plans alone
    for (std::uint64_t seed = 1; seed <= 600; ++seed)
        nothing += make_campaign(seed, wish).effects.empty() ? 1 : 0;
    EXPECT_NEAR(nothing, 0.68 * 600, 40); // three and a half standard deviations
}

TEST(Laboratory, SharesNoContactCodeWithTheKernel)
{
    const std::filesystem::path folder = std::filesystem::path(STYLOBATE_SOURCE_DIR) / "tests/hidden";
    const std::regex include(R"re(#include "([^"]+)")re");
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string kind = entry.path().extension().string();
        if ((kind != ".hpp" && kind != ".cpp") || entry.path().filename().string().starts_with("test_") ||
            entry.path().parent_path().filename() == "assess") // the program that is assessed is no laboratory
            continue;
        ++files;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            std::smatch match;
            if (!std::regex_search(line, match, include))
                continue;
            const std::string header = match[1];
            const bool plain = header.starts_with("tests/") || header.starts_with("io/") ||
                               header.starts_with("ensemble/numerics/") || header == "ensemble/model/campaign.hpp" ||
                               header == "ensemble/model/input_error.hpp";
            EXPECT_TRUE(plain) << entry.path().filename() << " includes " << header;
        }
    }
    EXPECT_GT(files, 15);
}

} // namespace

} // namespace stylobate::hidden
