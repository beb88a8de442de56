/// Set-up, files, sensors and refusals of tests on single joints in the virtual laboratory.

#include "ensemble/model/input_error.hpp"
#include "io/measured/campaign_writer.hpp"
#include "io/measured/measured_file.hpp"
#include "tests/hidden/joint_setup.hpp"
#include "tests/hidden/joint_test_plans.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace stylobate::hidden {

namespace {

/// Three equal blocks, or a block with two dummies like it, are one rectangle of thrice the height; an eccentric one
/// shifts the common centre by a third.
TEST(JointSetups, OneBodyHasTheMassAndInertiaOfItsParts)
{
    VirtualCampaign made = a_column(Law::nonsmooth);
    const Specimen& s = made.planned.specimen;
    const double w = s.half_width_m[0], h = s.half_height_m[0], m = s.mass_kg[0];
    for (std::size_t i = 0; i < 3; ++i) {
        made.model.bodies[i].half_width_m = w;
        made.model.bodies[i].mass_kg = m;
        made.model.bodies[i].inertia_kg_m2 = m * (w * w + h * h) / 3;
    }
    MeasuredRun taped = plan_of(made, RunKind::pull, 0, 0.1);
    taped.present = {0, 1, 2};
    taped.taped = {{0, 1, 2}};
    MeasuredRun dummies = plan_of(made, RunKind::push, 0, 0.1);
    tape_dummies(made, dummies);
    for (const double off : {0.0, 0.003}) {
        made.model.effects.bodies[0].eccentricity_m = off;
        for (const MeasuredRun& plan : {taped, dummies}) {
            const JointSetup setup = set_up(made, plan, 0, nullptr);
            const Body& body = setup.model.bodies[0];
            EXPECT_NEAR(body.mass_kg, 3 * m, 1e-12);
            EXPECT_NEAR(body.mass_x_m, off / 3, 1e-12);
            EXPECT_NEAR(body.mass_y_m, 2 * h, 1e-12);
            // three masses, one of them by two thirds of its offset from the common centre and two by a third
            EXPECT_NEAR(body.inertia_kg_m2, 3 * m * (w * w + 9 * h * h) / 3 + m * off * off * 2 / 3, 1e-12);
            double x = 0, y = 0;
            geometric_centre(setup.model, 0, setup.start.bodies[0], x, y);
            EXPECT_NEAR(x, s.rest_x_m[0], 1e-12);
            EXPECT_NEAR(y, s.rest_y_m[0], 1e-12);
        }
    }
}

TEST(JointTests, AreTheirSeedsAndNumbers)
{
    VirtualCampaign made = a_column(Law::compliant);
    made.planned.camera_m = 5e-5;
    made.planned.specimen.placement_tolerance_m = 2e-4;
    const MeasuredRun plan = drop_of(made);
    const auto places = [&](int number) { return performed(made, plan, number, nullptr, nullptr).blocks.y_m.values; };
    const std::vector<double> one = places(1), again = places(1), other = places(2);
    const std::size_t at = 100 * static_cast<std::size_t>(made.model.body_count) + 1;
    EXPECT_EQ(one[at], again[at]);
    EXPECT_NE(one[at], other[at]);
    EXPECT_EQ(made.planned.camera_m, performed(made, plan, 1, nullptr, nullptr).blocks.y_m.noise_sd);
}

TEST(JointTests, CallipersMeasureCentresAndBearings)
{
    VirtualCampaign made = a_column(Law::nonsmooth);
    made.model.effects.beds[1].chip_left_m = 0.002;
    made.model.effects.beds[2].chip_right_m = 0.003;
    made.model.effects.bodies[0].eccentricity_m = -0.001;
    const Specimen exactly = measured_at_rest(made, 0);
    EXPECT_NEAR(exactly.bearing_left_m[1], 0.002, 2e-4); // and what the scatter of the widths makes
    EXPECT_NEAR(exactly.bearing_right_m[1], 0, 2e-4);
    EXPECT_NEAR(exactly.bearing_right_m[2], 0.003, 2e-4);
    EXPECT_EQ(exactly.centre_of_mass_m[0], -0.001);
    made.planned.camera_m = 5e-5;
    double squares = 0;
    for (int number = 0; number < 400; ++number)
        squares += std::pow(measured_at_rest(made, number).centre_of_mass_m[0] + 0.001, 2);
    EXPECT_NEAR(std::sqrt(squares / 400), 1e-4, 1.5e-5); // four standard deviations
}

/// A plan goes through its file, and what was measured through another one.
TEST(JointTests, GoThroughFiles)
{
    VirtualCampaign made = a_column(Law::nonsmooth);
    made.planned.camera_m = 5e-5;
    made.planned.camera_rad = 1e-3;
    made.planned.sensor_m = 2e-5;
    Campaign plans;
    plans.specimen = made.planned.specimen;
    MeasuredRun rest;
    rest.name = "rest";
    rest.test = RunKind::rest;
    plans.tests = {drop_of(made), pull_of(made, 1, 0.06, 1), rest};
    plans.tests[0].name = "a_drop";
    plans.tests[1].name = "b_pull";
    const std::filesystem::path folder = testing::TempDir(), plan_file = folder / "joint_test_plan.h5",
                                done_file = folder / "joint_test_done.h5";
    write_campaign(plans, plan_file);
    const Campaign read = read_campaign(plan_file);
    ASSERT_EQ(read.tests.size(), 3U);
    const Campaign done = tested(made, read);
    write_campaign(done, done_file);
    const Campaign again = read_campaign(done_file);
    ASSERT_EQ(again.tests.size(), 3U);
    EXPECT_EQ(again.tests[1].forces[0].value_n.values, done.tests[1].forces[0].value_n.values);
    EXPECT_EQ(again.tests[1].run_order, 1);
    EXPECT_EQ(again.specimen.bearing_left_m.size(), made.planned.specimen.joints.size());
    EXPECT_EQ(again.specimen.centre_of_mass_m, done.specimen.centre_of_mass_m);
    for (const Finding& finding : again.findings)
        EXPECT_EQ(finding.severity, Severity::note) << finding.place << ": " << finding.text;
    EXPECT_THROW(tested(made, again), InputError) << "measured already";
    EXPECT_THROW(tested(a_column(Law::nonsmooth, SpecimenKind::two_drums), read), InputError) << "another specimen";
}

TEST(JointTests, RefuseAPlanThatContradictsItself)
{
    const VirtualCampaign made = a_column(Law::nonsmooth);
    const MeasuredRun good = pull_of(made, 1, 0.06, 0.2);
    const auto refused = [&](auto change) {
        MeasuredRun plan = good;
        change(plan);
        EXPECT_THROW(do_test(made, plan), InputError);
    };
    refused([](MeasuredRun& run) { run.test = RunKind::shake; });
    refused([](MeasuredRun& run) { run.present = {0, 99}; });
    refused([](MeasuredRun& run) { run.present = {0}; });
    refused([](MeasuredRun& run) { run.base_displacement_m.values.pop_back(); });
    refused([](MeasuredRun& run) { run.time_s[5] += 0.001; });
    refused([](MeasuredRun& run) { run.released_s = 0.1; });
    refused([](MeasuredRun& run) { run.forces[0].to_laboratory = false; });
    EXPECT_NO_THROW(do_test(made, good));
}

} // namespace

} // namespace stylobate::hidden
