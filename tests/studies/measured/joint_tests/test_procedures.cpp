/// What is planned, against the numbers of the procedures; what a laboratory lacks; floors and contrasts by hand.

#include "ensemble/model/input_error.hpp"
#include "tests/studies/measured/joint_tests/joint_sample.hpp"

#include <array>
#include <set>

namespace stylobate::joint_sample {
namespace {

constexpr std::array test_kinds = {RunKind::pull, RunKind::board, RunKind::tilt, RunKind::push,
                                   RunKind::drop, RunKind::slide, RunKind::rest};

/// Peak displacement, speed and acceleration of a table.
std::array<double, 3> peaks_of(const MeasuredRun& run, double from_s = 0, double to_s = 1e9)
{
    std::array<double, 3> peaks{};
    const std::vector<double>& x = run.base_displacement_m.values;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
        if (run.time_s[i] >= from_s && run.time_s[i] < to_s) {
            peaks[0] = std::max(peaks[0], std::fabs(x[i]));
            peaks[1] = std::max(peaks[1], std::fabs(x[i + 1] - x[i - 1]) * 250);
            peaks[2] = std::max(peaks[2], std::fabs(x[i + 1] - 2 * x[i] + x[i - 1]) * 250000);
        }
    return peaks;
}

TEST(Procedures, ClampWhatIsBelowAndRemoveWhatIsAbove)
{
    for (const RunKind kind : test_kinds)
        for (const MeasuredRun& run : plan(kind)) {
            EXPECT_EQ(run.test, kind);
            EXPECT_EQ(run.joint, 1);
            EXPECT_EQ(run.present, (std::vector{0, 1})) << run.name;
            EXPECT_EQ(run.clamped, std::vector{0}) << run.name;
            const bool tall = kind == RunKind::tilt || kind == RunKind::push || kind == RunKind::drop;
            EXPECT_EQ(run.dummies.size(), tall ? 2U : 0U) << run.name;
            EXPECT_EQ(run.base_displacement_m.values.size(), run.time_s.size());
            EXPECT_EQ(run.rate_hz, 500);
        }
    EXPECT_TRUE(plan(RunKind::pull, 0).front().clamped.empty());
    std::set<int> motions;
    for (const RunKind kind : test_kinds)
        for (int joint = 0; joint < 3; ++joint)
            for (const MeasuredRun& run : plan(kind, joint))
                EXPECT_TRUE(motions.insert(run.motion_id).second == (run.repeat == 0)) << run.name;
    const TestedBody body = tested_body(column(), 1, plan(RunKind::push).front().dummies);
    EXPECT_DOUBLE_EQ(body.mass_kg, 3 * mass);
    EXPECT_DOUBLE_EQ(body.centre_m, 3 * half_height);
    EXPECT_DOUBLE_EQ(body.height_m, 6 * half_height);
    EXPECT_NEAR(body.inertia_m2, (half_width * half_width + 9 * half_height * half_height) / 3, 1e-15); // of the whole
}

TEST(Procedures, CycleTheTableAsPlanned)
{
    const MeasuredRun pull = plan(RunKind::pull).front();
    // the turns of the slow cycles round off (1/2 - 1/pi) 20 ms of their way
    EXPECT_NEAR(peaks_of(pull)[0], 0.008 - 0.014 * 0.020 * (0.5 - 1 / M_PI), 3e-6);
    EXPECT_NEAR(peaks_of(pull)[1], 0.060, 1e-6);
    EXPECT_LT(peaks_of(pull)[2], 0.12 / 0.020 * M_PI / 2 * 1.001); // from -60 to 60 mm/s in 20 ms, half a cosine
    EXPECT_EQ(peaks_of(pull, 0, 0.98)[0], 0) << "at rest";
    EXPECT_NEAR(peaks_of(pull, 1.02, 1.98)[1], 0.00025, 1e-9) << "the first slip is approached slowly";
    EXPECT_NEAR(pull.base_displacement_m.values.back(), 0, 1e-12);
    EXPECT_NEAR(pull.time_s.back(), 13, 0.5);
    EXPECT_EQ(pull.forces.front().height_m, half_height / 2);
    EXPECT_NEAR(pull.forces.front().stiffness_n_m, 2e4, 1e-9);
    EXPECT_TRUE(pull.forces.front().to_laboratory);
    double path = 0; // two, three and two cycles of 32 mm
    for (std::size_t i = 1; i < pull.time_s.size(); ++i)
        path += std::fabs(pull.base_displacement_m.values[i] - pull.base_displacement_m.values[i - 1]);
    EXPECT_NEAR(path, 7 * 0.032, 0.02 * 7 * 0.032) << "less what the turns round off";

    const MeasuredRun slide = plan(RunKind::slide).front();
    EXPECT_NEAR(peaks_of(slide)[0], 10.7 / std::pow(8 * M_PI, 2), 1e-5);
    EXPECT_NEAR(peaks_of(slide, 1, 3.5)[2], 10.7, 0.02);
    EXPECT_EQ(slide.base_displacement_m.values.back(), 0);
}

TEST(Procedures, TiltPushAndDropAsPlanned)
{
    for (const RunKind kind : {RunKind::board, RunKind::tilt}) {
        const auto runs = plan(kind);
        ASSERT_EQ(runs.size(), 2U);
        EXPECT_NEAR(runs[0].base_tilt_rad.values.back(), 40 * M_PI / 180, 1e-5) << "to the left: counter-clockwise";
        EXPECT_NEAR(runs[1].base_tilt_rad.values.back(), -40 * M_PI / 180, 1e-5);
        const std::vector<double>& tilt = runs[0].base_tilt_rad.values;
        EXPECT_NEAR((tilt[5000] - tilt[4999]) * 500, 2 * M_PI / 180, 1e-9);
    }
    const auto push = plan(RunKind::push);
    ASSERT_EQ(push.size(), 2U);
    EXPECT_NEAR(push[0].forces.front().speed_m_s, -0.004, 1e-15);
    EXPECT_NEAR(push[1].forces.front().speed_m_s, 0.004, 1e-15);
    EXPECT_NEAR(push[0].forces.front().height_m, 0.9 * 6 * half_height, 1e-15);
    EXPECT_FALSE(push[0].forces.front().to_laboratory);
    const auto drop = plan(RunKind::drop);
    ASSERT_EQ(drop.size(), 6U);
    const MeasuredRun& first = drop.front();
    EXPECT_EQ(first.released_s, 0.2);
    EXPECT_NEAR(first.time_s.back(), 1.2, 1e-9);
    for (const int r : {0, 1}) { // the lower corner 3 mm above the joint, held until then
        const SeenMotion& held = drop[static_cast<std::size_t>(r)].blocks;
        const double turn = held.theta_rad.values[3 * 100 + 1], side = r == 0 ? -1 : 1;
        EXPECT_NEAR(turn, -side * 0.1, 1e-15) << "counter-clockwise: the left corner is below";
        const double corner =
            held.y_m.values[3 * 100 + 1] + side * half_width * std::sin(turn) - half_height * std::cos(turn);
        EXPECT_NEAR(corner, 2 * half_height + 0.003, 1e-15);
        const double inside = held.x_m.values[3 * 100 + 1] - column().rest_x_m[1] + side * half_width * std::cos(turn) +
                              half_height * std::sin(turn);
        EXPECT_LT(side * inside, half_width) << "on the block below";
    }
    EXPECT_NEAR(first.blocks.y_m.values[3 * 100 + 0], half_height, 1e-15);
    EXPECT_TRUE(std::isnan(first.blocks.y_m.values[3 * 101 + 1]));
    EXPECT_TRUE(std::isnan(first.blocks.y_m.values[2])) << "not present";
    EXPECT_TRUE(plan(RunKind::shake).empty());
    EXPECT_NEAR(plan(RunKind::rest).front().time_s.back(), 0.5, 1e-9) << "for the cameras";
    EXPECT_THROW(plan(RunKind::pull, 3), InputError);
}

TEST(Procedures, GrowWithTheBlocks)
{
    Specimen large = column(); // four times as large: speeds and times twice, lengths four times
    for (auto* lengths : {&large.half_width_m, &large.half_height_m, &large.rest_y_m})
        for (double& length : *lengths)
            length *= 4;
    for (double& each : large.mass_kg)
        each *= 64;
    const MeasuredRun pull = planned_runs(large, {}, RunKind::pull, 1).front();
    EXPECT_NEAR(peaks_of(pull)[0], 0.032, 3e-4);
    EXPECT_NEAR(peaks_of(pull)[1], 0.120, 1e-6);
    EXPECT_NEAR(pull.time_s.back(), 26, 1);
    EXPECT_NEAR(pull.forces.front().stiffness_n_m, 2e4 * 64 / 4, 1e-6) << "the same stretch under the weight, times s";
    EXPECT_NEAR(peaks_of(planned_runs(large, {}, RunKind::slide, 1).front(), 2, 7)[2], 10.7, 0.02);
}

TEST(Procedures, SayWhatALaboratoryLacks)
{
    const Specimen s = column();
    for (const RunKind kind : test_kinds) {
        EXPECT_FALSE(cannot_do(s, {}, kind));
        EXPECT_GT(default_cost(kind), 0);
        Laboratory whole;
        whole.may_dismantle = false;
        EXPECT_TRUE(cannot_do(s, whole, kind));
    }
    Laboratory small;
    small.stroke_m = 0.01;
    EXPECT_FALSE(cannot_do(s, small, RunKind::pull));
    EXPECT_TRUE(cannot_do(s, small, RunKind::slide)) << "17 mm";
    Laboratory slow;
    slow.speed_m_s = 0.05;
    EXPECT_TRUE(cannot_do(s, slow, RunKind::pull));
    EXPECT_FALSE(cannot_do(s, slow, RunKind::push));
    Laboratory gentle;
    gentle.acceleration_m_s2 = 10;
    EXPECT_TRUE(cannot_do(s, gentle, RunKind::slide));
    EXPECT_FALSE(cannot_do(s, gentle, RunKind::pull));
    Laboratory flat;
    flat.tilt_rad = 0.45;
    EXPECT_TRUE(cannot_do(s, flat, RunKind::board)) << "friction of 0.6 needs 0.54";
    EXPECT_TRUE(cannot_do(s, flat, RunKind::tilt)) << "24 over 43.5 mm is 0.504";
    flat.tilt_rad = 0.65;
    EXPECT_FALSE(cannot_do(s, flat, RunKind::board));
    EXPECT_NEAR(planned_runs(s, flat, RunKind::board, 0).front().base_tilt_rad.values.back(), 0.65, 1e-5);
    Laboratory blind;
    blind.force_n = 0;
    EXPECT_TRUE(cannot_do(s, blind, RunKind::pull));
    EXPECT_TRUE(cannot_do(s, blind, RunKind::push));
    EXPECT_FALSE(cannot_do(s, blind, RunKind::drop));
    Specimen gate = column(); // a beam on two blocks
    gate.joints = {{-1, 0}, {-1, 1}, {0, 2}, {1, 2}};
    EXPECT_TRUE(planned_runs(gate, {}, RunKind::pull, 2).empty()) << "the beam stands on two joints";
    EXPECT_FALSE(planned_runs(gate, {}, RunKind::pull, 1).empty());
    gate.joints = {{-1, 0}, {-1, 0}};
    EXPECT_TRUE(cannot_do(gate, {}, RunKind::pull));
}

TEST(Estimates, HaveNamesOfTheirTest)
{
    std::set<std::string> all;
    for (const RunKind kind : test_kinds)
        for (const EstimatorName& name : estimator_names(kind)) {
            EXPECT_TRUE(all.insert(name.name).second) << name.name;
            EXPECT_FALSE(name.what.empty() || name.blind_to.empty()) << name.name;
        }
    EXPECT_TRUE(estimator_names(RunKind::shake).empty());
    EXPECT_TRUE(estimates(column(), {}).empty());
    std::vector<MeasuredRun> mixed = {plan(RunKind::drop).front(), plan(RunKind::push).front()};
    EXPECT_THROW(estimates(column(), mixed), InputError);
}

TEST(Estimates, OfRestAreWhatWasMeasured)
{
    Specimen s = column();
    s.centre_of_mass_m = {0, 0.0012, none};
    s.bearing_left_m = {0, 0.002, 0};
    s.bearing_right_m = {0, 0.0005, 0};
    std::vector<MeasuredRun> runs = plan(RunKind::rest);
    const auto all = estimates(s, runs);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(find(all, "rest.centre")->value, 0.0012);
    EXPECT_EQ(find(all, "rest.bearing_left")->value, 0.002);
    EXPECT_EQ(find(all, "rest.bearing_right")->value, 0.0005);
    EXPECT_EQ(find(all, "rest.bearing_right")->joint, 1);
    EXPECT_FALSE(find(estimates(s, plan(RunKind::rest, 2)), "rest.centre")) << "not measured";
    MeasuredRun& seen = runs.front();
    Path path;
    path.x.assign(seen.time_s.size(), 0);
    path.theta.assign(seen.time_s.size(), 0.004);
    see(seen, path, 5);
    expect_estimate(estimates(s, runs), "rest.wedge", 0.004, 1e-4);
}

TEST(Estimates, FloorIsThatOfTheLaboratory)
{
    Specimen s = column();
    s.centre_of_mass_m = {0, 0.001, 0};
    MeasuredRun run = plan(RunKind::rest).front();
    const auto floor_at = [&](double geometry_m) {
        LaboratoryFloor floor;
        floor.geometry_m = geometry_m;
        return find(estimates(s, std::vector<MeasuredRun>{run}, floor), "rest.centre")->floor_sd;
    };
    EXPECT_DOUBLE_EQ(floor_at(1e-4), 1e-4);
    EXPECT_DOUBLE_EQ(floor_at(5e-4), 5e-4);
}

} // namespace
} // namespace stylobate::joint_sample
